//! Rows chosen for good condition: dense, for the few mechanisms that need them.
//!
//! Gram–Schmidt with every projection done twice ("twice is enough", Giraud et al. 2005).

use crate::math::dot;

/// A row whose remainder is below this is taken for dependent. Rows are scaled to the mechanism's size and positions are
/// known to 1e-13, so that a true dependence leaves 1e-12 at most, and a mechanism this close to a singular position
/// can't be told from one in it.
pub const DEPENDENT: f64 = super::rank::DEPENDENCE_TOLERANCE;

/// n rows (or as many as are independent) chosen for good condition from a dense row-major m × n matrix: those of `first`,
/// then always the row with the largest remainder.
pub fn well_conditioned_rows(dense: &[f64], m: usize, n: usize, first: &[usize]) -> Vec<usize> {
    let mut rest: Vec<Vec<f64>> = (0..m)
        .map(|row| dense[row * n..(row + 1) * n].to_vec())
        .collect();
    let mut chosen = Vec::with_capacity(n);
    while chosen.len() < n.min(m) {
        let candidate = first.iter().copied().find(|row| !chosen.contains(row));
        let length = |row: usize| dot(&rest[row], &rest[row]);
        let row = candidate.or_else(|| {
            (0..m)
                .filter(|row| !chosen.contains(row))
                .max_by(|&a, &b| length(a).total_cmp(&length(b)).then(b.cmp(&a)))
        });
        let Some(row) = row else { break };
        let size = length(row).sqrt();
        if size < DEPENDENT {
            break;
        }
        let e: Vec<f64> = rest[row].iter().map(|x| x / size).collect();
        chosen.push(row);
        for other in &mut rest {
            for _ in 0..2 {
                let along = dot(&e, other);
                other.iter_mut().zip(&e).for_each(|(o, e)| *o -= along * e);
            }
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chooses_the_larger_of_two_parallel_rows_but_keeps_the_first_ones() {
        let dense = [1.0, 0.0, 0.0, 0.5, 0.0, 2.0];
        assert_eq!(well_conditioned_rows(&dense, 3, 2, &[]), [2, 0]);
        assert_eq!(well_conditioned_rows(&dense, 3, 2, &[1]), [1, 0]);
    }
}
