//! Lemke's algorithm for linear complementarity problems that have no definite matrix.
//!
//! ```text
//! w = q + M z ≥ 0,   z ≥ 0,   z_k w_k = 0                              M (k, k), q (k)
//! w = q + M z + d z₀ ≥ 0   (d > 0) is solved for z₀ large, and z₀ goes to zero: one pivot after the other, where what has left w makes room for its z
//! ```
//!
//! Where M is copositive, zᵀ M z ≥ 0 for z ≥ 0, and qᵀz ≥ 0 for all z ≥ 0 with M z ≥ 0 and zᵀ M z = 0, it finds a solution. Among these problems is
//! Coulomb's friction with velocities (D. E. Stewart, J. C. Trinkle 1996), where principal pivoting may go round in circles. Ties go to the row
//! that is least in the lexicographic order of (q, B⁻¹), so that it ends.
//!
//! C. E. Lemke 1965; R. W. Cottle, J.-S. Pang, R. E. Stone, *The Linear Complementarity Problem*, 1992, ch. 4.4.

use nalgebra::DMatrix;

/// Pivots and ratios below this part of the largest number of their column are round-off.
const EVEN: f64 = 1e-12;
/// Pivots, per unknown, after which it goes on for ever by round-off.
const MOST: usize = 20;
/// What d grows by from one unknown to the next, in turn.
const COVERS: [f64; 3] = [0.0, 0.3, -0.1];

/// z; `None` if the algorithm ends on a ray, as where there is no solution.
pub fn lemke(matrix: &DMatrix<f64>, free: &[f64]) -> Option<Vec<f64>> {
    let size = free.len();
    if free.iter().all(|q| *q >= 0.0) {
        return Some(vec![0.0; size]);
    }
    // Another d leads another way, where round-off has made a ray of one.
    COVERS.iter().find_map(|more| {
        let cover = (0..size).map(|k| 1.0 + more * (k % size.min(7)) as f64);
        covered(matrix, free, &cover.collect::<Vec<f64>>())
    })
}

/// The same with one d.
fn covered(matrix: &DMatrix<f64>, free: &[f64], cover: &[f64]) -> Option<Vec<f64>> {
    let size = free.len();
    let mut tableau = Tableau::new(matrix, free, cover);
    // z₀ comes in for the w that is most negative, and all others are positive then.
    let (mut row, mut entering) = (tableau.lowest(), 2 * size);
    for _ in 0..MOST * size {
        let leaving = tableau.pivot(row, entering);
        if leaving == 2 * size {
            return Some(tableau.solution());
        }
        entering = if leaving < size {
            leaving + size
        } else {
            leaving - size
        };
        row = tableau.blocking(entering)?;
    }
    None
}

/// w, z, z₀ and the right side, by rows of what is in the basis.
struct Tableau {
    cells: DMatrix<f64>,
    /// The unknown of each row: w_k is k, z_k is size + k, z₀ is 2 size.
    basis: Vec<usize>,
}

impl Tableau {
    fn new(matrix: &DMatrix<f64>, free: &[f64], cover: &[f64]) -> Self {
        let size = free.len();
        let cells = DMatrix::from_fn(size, 2 * size + 2, |i, j| match j {
            _ if j < size => f64::from(u8::from(i == j)),
            _ if j < 2 * size => -matrix[(i, j - size)],
            _ if j == 2 * size => -cover[i],
            _ => free[i],
        });
        Tableau {
            cells,
            basis: (0..size).collect(),
        }
    }

    fn size(&self) -> usize {
        self.basis.len()
    }

    /// The row whose right side z₀ lifts last.
    fn lowest(&self) -> usize {
        let size = self.size();
        let lifted = |row: usize| self.cells[(row, 2 * size + 1)] / -self.cells[(row, 2 * size)];
        let least = |&a: &usize, &b: &usize| lifted(a).total_cmp(&lifted(b));
        (0..size).min_by(least).unwrap_or(0)
    }

    /// Brings an unknown into the basis; what it takes the place of.
    fn pivot(&mut self, row: usize, entering: usize) -> usize {
        let pivot = self.cells[(row, entering)];
        for cell in self.cells.row_mut(row).iter_mut() {
            *cell /= pivot;
        }
        for column in 0..self.cells.ncols() {
            let by = self.cells[(row, column)];
            if by == 0.0 || column == entering {
                continue;
            }
            for other in (0..self.size()).filter(|&other| other != row) {
                let part = self.cells[(other, entering)] * by;
                self.cells[(other, column)] -= part;
            }
        }
        for other in (0..self.size()).filter(|&other| other != row) {
            self.cells[(other, entering)] = 0.0;
        }
        std::mem::replace(&mut self.basis[row], entering)
    }

    /// The row whose unknown is the first to become zero as `entering` grows; `None` if none does.
    fn blocking(&self, entering: usize) -> Option<usize> {
        let (size, right) = (self.size(), 2 * self.size() + 1);
        let column = self.cells.column(entering);
        let least = EVEN * column.amax();
        let mut rows: Vec<usize> = (0..size).filter(|&row| column[row] > least).collect();
        // By the right side, and equal ones by B⁻¹, which stands where w was.
        for by in std::iter::once(right).chain(0..size) {
            let ratio = |row: usize| self.cells[(row, by)] / column[row];
            let lowest = rows
                .iter()
                .map(|&row| ratio(row))
                .fold(f64::INFINITY, f64::min);
            let most = rows.iter().map(|&row| ratio(row).abs()).fold(0.0, f64::max);
            rows.retain(|&row| ratio(row) <= lowest + EVEN * most);
            // Where z₀ can go it goes.
            if let Some(&last) = rows.iter().find(|&&row| self.basis[row] == 2 * size) {
                return Some(last);
            }
            if rows.len() <= 1 {
                break;
            }
        }
        rows.first().copied()
    }

    fn solution(&self) -> Vec<f64> {
        let (size, right) = (self.size(), 2 * self.size() + 1);
        let mut found = vec![0.0; size];
        for (row, &unknown) in self.basis.iter().enumerate() {
            if (size..2 * size).contains(&unknown) {
                found[unknown - size] = self.cells[(row, right)].max(0.0);
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest violation of w ≥ 0 and z w = 0.
    fn violation(matrix: &DMatrix<f64>, free: &[f64], found: &[f64]) -> f64 {
        let rows = (0..free.len()).map(|i| {
            let w = free[i]
                + (0..free.len())
                    .map(|j| matrix[(i, j)] * found[j])
                    .sum::<f64>();
            (-w).max((found[i] * w).abs()).max(-found[i])
        });
        rows.fold(0.0, f64::max)
    }

    #[test]
    fn small_problems_by_hand() {
        let matrix = DMatrix::from_row_slice(2, 2, &[2.0, 1.0, 1.0, 2.0]);
        assert_eq!(lemke(&matrix, &[1.0, 0.0]), Some(vec![0.0, 0.0]));
        let found = lemke(&matrix, &[-5.0, -6.0]).expect("it is definite");
        assert!((found[0] - 4.0 / 3.0).abs() < 1e-14 && (found[1] - 7.0 / 3.0).abs() < 1e-14);
        // w = −1 − z has no solution.
        assert_eq!(lemke(&DMatrix::from_element(1, 1, -1.0), &[-1.0]), None);
    }

    /// Friction of one point, z = (p_n, β₊, β₋, λ): copositive, and principal pivoting from nothing finds no pivot in the last row.
    #[test]
    fn copositive_problems_have_solutions() {
        let mut seed = 5_u64;
        let mut number = || {
            seed = seed
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (seed >> 33) as f64 / f64::from(1_u32 << 31) * 2.0 - 1.0
        };
        for round in 0..2000 {
            let (normal, tangential) = (0.1 + number().abs(), 0.1 + number().abs());
            let coupling = 0.99 * number() * (normal * tangential).sqrt();
            let friction = 3.0 * number().abs();
            let cells = [
                [normal, coupling, -coupling, 0.0],
                [coupling, tangential, -tangential, 1.0],
                [-coupling, -tangential, tangential, 1.0],
                [friction, -1.0, -1.0, 0.0],
            ];
            let matrix = DMatrix::from_fn(4, 4, |i, j| cells[i][j]);
            let (nearer, slides) = (number(), number());
            let free = [nearer, slides, -slides, 0.0];
            let found = lemke(&matrix, &free).unwrap_or_else(|| panic!("round {round}"));
            let off = violation(&matrix, &free, &found);
            assert!(off < 1e-9, "round {round}: {off:e}");
        }
    }
}
