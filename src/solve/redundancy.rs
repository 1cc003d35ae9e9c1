//! Directions that no row forbids, and rows chosen for good condition: dense, for the few mechanisms that need them.
//!
//! Both are Gram–Schmidt with every projection done twice ("twice is enough", Giraud et al. 2005).

use super::rank::SparseRows;
use crate::math::dot;

/// A row whose remainder is below this is taken for dependent. Rows are scaled to the mechanism's size and positions are
/// known to 1e-13, so that a true dependence leaves 1e-12 at most, and a mechanism this close to a singular position
/// can't be told from one in it.
pub const DEPENDENT: f64 = super::rank::DEPENDENCE_TOLERANCE;

/// Orthonormal basis of the directions that none of `rows` (those listed, independent) forbids, each (n).
pub fn free_directions(rows: &SparseRows, independent: &[usize]) -> Vec<Vec<f64>> {
    let n = rows.columns();
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(n);
    for &row in independent {
        let mut dense = vec![0.0; n];
        rows.row(row).for_each(|(column, value)| dense[column] = value);
        orthonormalise(&basis, &mut dense);
        basis.push(dense);
    }
    complement(basis, n)
}

/// Takes the part along an orthonormal `basis` out of `x` and scales the rest to length 1.
fn orthonormalise(basis: &[Vec<f64>], x: &mut [f64]) {
    for _ in 0..2 {
        for e in basis {
            let along = dot(e, x);
            x.iter_mut().zip(e).for_each(|(x, e)| *x -= along * e);
        }
    }
    let length = dot(x, x).sqrt();
    x.iter_mut().for_each(|x| *x /= length);
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
        orthonormalise(&basis, &mut z);
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
    fn what_is_free_is_orthogonal_to_all_rows() {
        let entries = [(0, 0, 1.0), (1, 1, 2.0), (2, 2, 1.0), (2, 3, 1.0)];
        let rows = SparseRows::from_triplets(3, 4, &entries).expect("finite");
        let free = free_directions(&rows, &[0, 1, 2]);
        assert_eq!(free.len(), 1);
        let z = &free[0];
        assert!((z[2] + z[3]).abs() < 1e-15 && (z[2].abs() - 0.5_f64.sqrt()).abs() < 1e-15, "{z:?}");
    }

    #[test]
    fn chooses_the_larger_of_two_parallel_rows_but_keeps_the_first_ones() {
        let dense = [1.0, 0.0, 0.0, 0.5, 0.0, 2.0];
        assert_eq!(well_conditioned_rows(&dense, 3, 2, &[]), [2, 0]);
        assert_eq!(well_conditioned_rows(&dense, 3, 2, &[1]), [1, 0]);
    }
}
