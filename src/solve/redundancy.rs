//! Which constraint rows are independent, which follow from others, and what motion is left free.
//!
//! Rows are taken one after the other; what is left of a row after its part in the span of the rows kept so far is taken
//! out (Gram–Schmidt, twice: "twice is enough", Giraud et al. 2005) decides whether it is kept.

use crate::math::dot;

/// A row that follows from rows before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependent {
    pub row: usize,
    /// The rows it is made of.
    pub on: Vec<usize>,
}

/// Rank of a set of scaled rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Rank {
    pub rank: usize,
    pub dependent: Vec<Dependent>,
    /// Orthonormal basis of the directions that no row forbids, each (n).
    pub null_vectors: Vec<Vec<f64>>,
}

/// A row whose remainder is below this part of its length is taken for dependent. Rows are scaled to the mechanism's
/// size and positions are known to 1e-13, so that a true dependence leaves 1e-12 at most, and a mechanism this close to
/// a singular position can't be told from one in it.
pub const DEPENDENT: f64 = 1e-9;
/// A part below this of a row's length does not take part in a dependence.
const TAKES_PART: f64 = 1e-7;

/// Rank of sparse rows (column, value) over n columns.
pub fn rank(rows: &[Vec<(usize, f64)>], n: usize) -> Rank {
    let mut kept: Vec<(usize, Vec<f64>)> = Vec::new();
    // Each orthonormal vector as a combination of the original rows kept.
    let mut recipes: Vec<Vec<f64>> = Vec::new();
    let mut dependent = Vec::new();
    for (row, entries) in rows.iter().enumerate() {
        let mut dense = vec![0.0; n];
        entries.iter().for_each(|&(column, value)| dense[column] += value);
        let length = dot(&dense, &dense).sqrt();
        let mut recipe = vec![0.0; kept.len() + 1];
        recipe[kept.len()] = 1.0;
        for _ in 0..2 {
            for ((_, e), made_of) in kept.iter().zip(&recipes) {
                let along = dot(e, &dense);
                dense.iter_mut().zip(e).for_each(|(d, e)| *d -= along * e);
                recipe.iter_mut().zip(made_of).for_each(|(r, m)| *r -= along * m);
            }
        }
        let rest = dot(&dense, &dense).sqrt();
        if rest <= DEPENDENT * length || length == 0.0 {
            let on =
                kept.iter().zip(&recipe).filter(|(_, part)| part.abs() > TAKES_PART).map(|((k, _), _)| *k).collect();
            dependent.push(Dependent { row, on });
        } else {
            dense.iter_mut().for_each(|d| *d /= rest);
            recipe.iter_mut().for_each(|r| *r /= rest);
            kept.push((row, dense));
            recipes.push(recipe);
        }
    }
    let rank = kept.len();
    let null_vectors = complement(kept.into_iter().map(|(_, e)| e).collect(), n);
    Rank { rank, dependent, null_vectors }
}

/// Orthonormal basis of what is orthogonal to `basis` (orthonormal): unit vectors by largest remainder.
fn complement(mut basis: Vec<Vec<f64>>, n: usize) -> Vec<Vec<f64>> {
    let first = basis.len();
    let mut remainder = vec![1.0; n];
    for e in &basis {
        remainder.iter_mut().zip(e).for_each(|(r, e)| *r -= e * e);
    }
    while basis.len() < n {
        let largest = (0..n).max_by(|&a, &b| remainder[a].total_cmp(&remainder[b])).unwrap_or(0);
        let mut z = vec![0.0; n];
        z[largest] = 1.0;
        for _ in 0..2 {
            for e in &basis {
                let along = dot(e, &z);
                z.iter_mut().zip(e).for_each(|(z, e)| *z -= along * e);
            }
        }
        let length = dot(&z, &z).sqrt();
        z.iter_mut().for_each(|z| *z /= length);
        remainder.iter_mut().zip(&z).for_each(|(r, z)| *r -= z * z);
        basis.push(z);
    }
    basis.split_off(first)
}

/// n rows (or as many as are independent) chosen for good condition from a dense row-major m × n matrix: those of `first`,
/// then always the row with the largest remainder.
pub fn well_conditioned_rows(dense: &[f64], m: usize, n: usize, first: &[usize]) -> Vec<usize> {
    let mut rest: Vec<Vec<f64>> = (0..m).map(|row| dense[row * n..(row + 1) * n].to_vec()).collect();
    let mut chosen = Vec::with_capacity(n);
    while chosen.len() < n.min(m) {
        let candidate = first.iter().copied().find(|row| !chosen.contains(row));
        let length = |row: usize| dot(&rest[row], &rest[row]);
        let row = candidate.or_else(|| {
            (0..m).filter(|row| !chosen.contains(row)).max_by(|&a, &b| length(a).total_cmp(&length(b)).then(b.cmp(&a)))
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
    fn names_what_a_row_depends_on() {
        let rows = vec![vec![(0, 1.0)], vec![(1, 2.0)], vec![(2, 1.0), (3, 1.0)], vec![(0, 3.0), (1, 1.0)]];
        let found = rank(&rows, 4);
        assert_eq!(found.rank, 3);
        assert_eq!(found.dependent, [Dependent { row: 3, on: vec![0, 1] }]);
        let z = &found.null_vectors[0];
        assert!((z[2] + z[3]).abs() < 1e-15 && (z[2].abs() - 0.5_f64.sqrt()).abs() < 1e-15, "{z:?}");
    }

    #[test]
    fn chooses_the_larger_of_two_parallel_rows_but_keeps_the_first_ones() {
        let dense = [1.0, 0.0, 0.0, 0.5, 0.0, 2.0];
        assert_eq!(well_conditioned_rows(&dense, 3, 2, &[]), [2, 0]);
        assert_eq!(well_conditioned_rows(&dense, 3, 2, &[1]), [1, 0]);
    }
}
