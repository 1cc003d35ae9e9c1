//! The linear complementarity problem of unilateral contacts.
//!
//! ```text
//! x ≥ 0,   w = b − W x ≤ 0,   x_k w_k = 0          W (k, k), b (k); b_k = −∞: x_k = 0
//! ```
//!
//! Principal pivoting by least index (Murty 1974), which ends with the only solution where all principal minors of W are
//! positive, as without friction. With it W can be another one: of many solutions then the first that is found counts, and there
//! may be none (Painlevé 1895).

use crate::small::SmallLu;
use nalgebra::DMatrix;

/// Parts of the largest b that are round-off.
const EVEN: f64 = 1e-12;
/// Most unknowns of which all choices are tried before it is said that there is no solution.
const FEW: usize = 12;

/// Which x are not zero, and x; `None` if there is no solution.
pub fn complementary(mass: &DMatrix<f64>, free: &[f64]) -> Option<(Vec<bool>, Vec<f64>)> {
    let size = free.len();
    let mut pressing = vec![false; size];
    for _ in 0..4 * size + 1 {
        match attempt(mass, free, &pressing) {
            Attempt::Solved(x) => return Some((pressing, x)),
            Attempt::Wrong(k) => pressing[k] = !pressing[k],
            Attempt::Singular => break,
        }
    }
    // It went round in a circle, or W is not such a matrix: then what is not tried is not known.
    let candidates: Vec<usize> = (0..size).filter(|&k| free[k].is_finite()).collect();
    for choice in 0..1usize << candidates.len().min(FEW) {
        pressing.fill(false);
        candidates
            .iter()
            .enumerate()
            .for_each(|(bit, &k)| pressing[k] = bit < FEW && choice >> bit & 1 == 1);
        if let Attempt::Solved(x) = attempt(mass, free, &pressing) {
            return Some((pressing, x));
        }
    }
    None
}

enum Attempt {
    Solved(Vec<f64>),
    /// The first that contradicts.
    Wrong(usize),
    Singular,
}

/// x of those that press, and whether all agree.
fn attempt(mass: &DMatrix<f64>, free: &[f64], pressing: &[bool]) -> Attempt {
    let size = free.len();
    let chosen: Vec<usize> = (0..size).filter(|&k| pressing[k]).collect();
    let mut part = SmallLu::new(chosen.len());
    let cells = chosen
        .iter()
        .flat_map(|&i| chosen.iter().map(move |&j| (i, j)));
    for (value, cell) in part.values().iter_mut().zip(cells) {
        *value = mass[cell];
    }
    if !part.factor() {
        return Attempt::Singular;
    }
    let mut forces: Vec<f64> = chosen.iter().map(|&k| free[k]).collect();
    part.solve(&mut forces);
    let mut x = vec![0.0; size];
    chosen
        .iter()
        .zip(&forces)
        .for_each(|(&k, force)| x[k] = *force);
    let scale = free
        .iter()
        .filter(|b| b.is_finite())
        .fold(0.0, |most: f64, b| most.max(b.abs()));
    let wrong = (0..size).find(|&k| {
        let held: f64 = chosen
            .iter()
            .map(|&other| mass[(k, other)] * x[other])
            .sum();
        if pressing[k] {
            x[k] < 0.0
        } else {
            free[k] - held > EVEN * scale
        }
    });
    wrong.map_or(Attempt::Solved(x), Attempt::Wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(size: usize, cells: &[f64]) -> DMatrix<f64> {
        DMatrix::from_row_slice(size, size, cells)
    }

    #[test]
    fn one_presses_or_not() {
        let mass = matrix(1, &[2.0]);
        assert_eq!(complementary(&mass, &[3.0]), Some((vec![true], vec![1.5])));
        assert_eq!(
            complementary(&mass, &[-3.0]),
            Some((vec![false], vec![0.0]))
        );
        assert_eq!(
            complementary(&mass, &[f64::NEG_INFINITY]),
            Some((vec![false], vec![0.0]))
        );
        // a jam, and one that leaves
        assert_eq!(complementary(&matrix(1, &[-2.0]), &[3.0]), None);
        assert_eq!(
            complementary(&matrix(1, &[-2.0]), &[-3.0]),
            Some((vec![false], vec![0.0]))
        );
    }

    #[test]
    fn one_takes_the_load_of_another() {
        // The second presses so that the first lets go, where each by itself would press.
        let mass = matrix(2, &[1.0, 2.0, 2.0, 5.0]);
        assert_eq!(
            complementary(&mass, &[1.0, 4.0]),
            Some((vec![false, true], vec![0.0, 0.8]))
        );
    }

    /// All matrices of small whole numbers: what is found solves it, and where nothing is found no choice does.
    #[test]
    fn what_is_found_solves_it() {
        let mut none = 0;
        for code in 0..5_i32.pow(6) {
            let cell = |place: u32| f64::from(code / 5_i32.pow(place) % 5 - 2);
            let (mass, free) = (
                matrix(2, &[cell(0), cell(1), cell(2), cell(3)]),
                [cell(4), cell(5)],
            );
            let solves = |x: &[f64]| {
                (0..2).all(|k| {
                    let w = free[k] - mass[(k, 0)] * x[0] - mass[(k, 1)] * x[1];
                    x[k] >= 0.0 && w < 1e-9 && (x[k] * w).abs() < 1e-9
                })
            };
            match complementary(&mass, &free) {
                Some((pressing, x)) => {
                    assert!(solves(&x), "{mass} {free:?} {x:?}");
                    assert!((0..2).all(|k| pressing[k] || x[k] == 0.0));
                }
                None => {
                    none += 1;
                    let one = |k: usize| {
                        let mut x = [0.0; 2];
                        x[k] = free[k] / mass[(k, k)];
                        x
                    };
                    let determinant = mass[(0, 0)] * mass[(1, 1)] - mass[(0, 1)] * mass[(1, 0)];
                    let both = [
                        (free[0] * mass[(1, 1)] - free[1] * mass[(0, 1)]) / determinant,
                        (free[1] * mass[(0, 0)] - free[0] * mass[(1, 0)]) / determinant,
                    ];
                    for x in [[0.0; 2], one(0), one(1), both] {
                        assert!(
                            x.iter().any(|x| !x.is_finite()) || !solves(&x),
                            "{mass} {free:?} {x:?}"
                        );
                    }
                }
            }
        }
        assert!(none > 1000, "{none}");
    }
}
