//! Singular positions: whether a position is one, and which motions lead away from it.
//!
//! ```text
//! J̃ N = 0,  L̃ᵀ J̃ = 0                N (n, f), L̃ (m, k): both null spaces of the scaled J, orthonormal
//! q̃ = q̃₀ + ε N u + ε² w + …         φ = 0 at second order: b(u) = 0
//! b_l(u) = L̃_lᵀ φ̃″(N u, N u)        (k), quadratic; φ″(v, v) = −γ(v) with inputs at rest
//! C(u) w = ½ (∂b/∂u) w              (k, f); at a root the tangents w with C w = 0 stay on its branch
//! ```
//!
//! Rows that are redundant everywhere have b ≡ 0, and every motion N u can go on: the position is regular. Otherwise the
//! real roots u of b are the directions of the branches that cross here, where C has its full rank there (the cone of
//! Connelly and Whiteley 1996; Müller 2019). Where b has no root but 0, nothing leads away.
//!
//! Roots are found by Newton's steps of least norm from directions spread over the null space, so that of many branches
//! (2^k of k flat loops) some may be missed, but not those near the direction wanted.

use crate::system::{Evaluation, Inputs, System};
use linkdyn_linear::dense::{Dense, DenseFault, least_norm_solve, svd_rank};
use linkdyn_linear::math::{dot, max_abs};

/// Singular values below this, by the largest, are those of a position so near to a singular one that it is meant [–].
const NEAR: f64 = 1e-7;
/// A quadratic form below this is none: it comes from the null spaces' error [–].
const FLAT: f64 = 1e-5;
/// Seeds from which roots are looked for, besides the wanted direction itself.
const SEEDS: usize = 24;
const ITERATIONS: usize = 60;
/// Largest form at a root [–].
const ROOT: f64 = 1e-11;
/// Singular values of C below this, by the largest, are none [–].
const TANGENT: f64 = 1e-5;
/// A root that C of another takes to less than this, by its largest entry, is on the branch of that one [–].
const SAME: f64 = 1e-3;
/// Branches that differ by less are equally wanted [–].
const TIE: f64 = 1e-6;
/// Part of a direction's square that may lie off a branch that holds it: it comes from positions around.
const HELD: f64 = 1e-5;
/// Part of a branch's own direction that goes with the wanted one: what nobody pulls at leaves the position, too.
const ASIDE: f64 = 0.3;

/// Both null spaces at a position.
pub struct Singularity<'s> {
    system: &'s System,
    inputs: Inputs,
    evaluation: Evaluation,
    /// N by columns (f × n) and L by columns (k × m, of the rows that count), scaled.
    tangents: Vec<Vec<f64>>,
    stresses: Vec<Vec<f64>>,
}

/// A branch that leads away from a singular position.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Its tangents there, scaled: orthonormal vectors (n), as many as its degrees of freedom.
    pub tangents: Vec<Vec<f64>>,
    /// Scaled direction in which it leaves (n), a unit vector; away is also the opposite way.
    pub direction: Vec<f64>,
    /// Its degrees of freedom.
    pub freedom: usize,
    /// Part of the wanted direction that lies in it [as that direction].
    pub along: f64,
}

impl Branch {
    /// Whether a scaled direction (n) is one of its tangents.
    pub fn holds(&self, direction: &[f64]) -> bool {
        let shares = self.tangents.iter().map(|t| dot(t, direction).powi(2));
        shares.sum::<f64>() > (1.0 - HELD) * dot(direction, direction)
    }
}

impl<'s> Singularity<'s> {
    /// At `q`, where that is a singular position of the first `m` rows; `None` if it is regular.
    ///
    /// # Errors
    /// Where the Jacobian is not finite.
    pub fn at(
        system: &'s System,
        q: &[f64],
        inputs: &Inputs,
        m: usize,
    ) -> Result<Option<Self>, DenseFault> {
        let n = system.n();
        let mut inputs = inputs.clone();
        inputs.drive.iter_mut().for_each(|jet| jet[1..].fill(0.0));
        let mut evaluation = Evaluation::new(system);
        evaluation.set_position(q);
        evaluation.eval_jacobian(system, &inputs);
        let mut rows = system.dense_scaled(&evaluation.jacobian);
        rows.truncate(m * n);
        let spaces = svd_rank(&Dense::new(m, n, rows), NEAR)?;
        let columns = |space: &Dense| -> Vec<Vec<f64>> {
            (0..space.columns()).map(|k| space.column(k)).collect()
        };
        let mut here = Singularity {
            system,
            inputs,
            evaluation,
            tangents: columns(&spaces.right_null),
            stresses: columns(&spaces.left_null),
        };
        if here.tangents.is_empty() || here.stresses.is_empty() {
            return Ok(None);
        }
        let seeds = here.seeds(&vec![0.0; n]);
        let curved = seeds.iter().any(|u| max_abs(&here.forms(u)) > FLAT);
        Ok(curved.then_some(here))
    }

    /// The branches, first the one in which most of the scaled direction `wanted` (n) lies; of equal ones that whose bodies
    /// turn most alike.
    pub fn branches(&mut self, wanted: &[f64]) -> Vec<Branch> {
        let pull: Vec<f64> = self
            .tangents
            .iter()
            .map(|tangent| dot(tangent, wanted))
            .collect();
        let mut found: Vec<(Branch, f64, Dense)> = Vec::new();
        for seed in self.seeds(wanted) {
            let Some(u) = self.root(seed) else { continue };
            let gradient = self.gradient(&u);
            if found.iter().any(|(.., other)| lies_in(other, &u)) {
                continue;
            }
            if let Some(branch) = self.branch(&u, &gradient, &pull) {
                let apart = self.apart(&branch.direction);
                found.push((branch, apart, gradient));
            }
        }
        let most = found
            .iter()
            .fold(0.0, |most: f64, (branch, ..)| most.max(branch.along));
        let tie = |along: f64| {
            if along >= (1.0 - TIE) * most {
                f64::INFINITY
            } else {
                along
            }
        };
        found.sort_by(|(a, apart_a, _), (b, apart_b, _)| {
            let coarse = |x: f64| (x / TIE).round();
            tie(b.along)
                .total_cmp(&tie(a.along))
                .then(coarse(*apart_a).total_cmp(&coarse(*apart_b)))
        });
        found.into_iter().map(|(branch, ..)| branch).collect()
    }

    /// The branch through a root: its tangent space, what of `pull` (f) lies in it, and a direction in which all of it leaves.
    fn branch(&mut self, u: &[f64], gradient: &Dense, pull: &[f64]) -> Option<Branch> {
        let tangents = svd_rank(gradient, TANGENT).ok()?.right_null;
        let freedom = tangents.columns();
        let mut part = vec![0.0; u.len()];
        for k in 0..freedom {
            let tangent = tangents.column(k);
            let share = dot(&tangent, pull);
            part.iter_mut()
                .zip(&tangent)
                .for_each(|(p, t)| *p += share * t);
        }
        let along = dot(&part, &part).sqrt();
        let sign = if dot(u, &part) < 0.0 { -1.0 } else { 1.0 };
        let mut root: Vec<f64> = u.iter().map(|x| sign * x).collect();
        if along > NEAR * max_abs(pull) {
            root = self.root(
                part.iter()
                    .zip(&root)
                    .map(|(p, x)| p / along + ASIDE * x)
                    .collect(),
            )?;
        }
        let spread = |k: usize| self.spread(&tangents.column(k));
        Some(Branch {
            tangents: (0..freedom).map(spread).collect(),
            direction: self.spread(&root),
            freedom,
            along,
        })
    }

    /// Directions (f) to look from.
    fn seeds(&self, wanted: &[f64]) -> Vec<Vec<f64>> {
        let n = self.system.n();
        let onto = |x: &[f64]| -> Vec<f64> {
            self.tangents
                .iter()
                .map(|tangent| dot(tangent, x))
                .collect()
        };
        let size = dot(wanted, wanted).sqrt();
        let mut seeds = Vec::with_capacity(4 * SEEDS + 1);
        if size > 0.0 {
            seeds.push(onto(&wanted.iter().map(|x| x / size).collect::<Vec<_>>()));
        }
        for k in 0..SEEDS {
            // Angles alone first: they are the same for a model that is turned or mirrored, up to the sign.
            let pattern: Vec<f64> = (0..n)
                .map(|column| {
                    if k % 2 == 0 && !self.system.layout.is_angle(column) {
                        0.0
                    } else {
                        spread_evenly(k * n + column)
                    }
                })
                .collect();
            let seed = onto(&pattern);
            let norm = dot(&seed, &seed).sqrt();
            if norm < NEAR {
                continue;
            }
            let unit: Vec<f64> = seed.iter().map(|x| x / norm).collect();
            if size > 0.0 {
                let beside = |sign: f64| {
                    seeds[0]
                        .iter()
                        .zip(&unit)
                        .map(|(a, b)| a + sign * ASIDE * b)
                        .collect()
                };
                let (one, other) = (beside(1.0), beside(-1.0));
                seeds.extend([one, other]);
            }
            seeds.push(unit);
        }
        seeds
    }

    /// The root of b, a unit vector (f), that Newton's iteration finds from `u`.
    fn root(&mut self, mut u: Vec<f64>) -> Option<Vec<f64>> {
        for _ in 0..ITERATIONS {
            let norm = dot(&u, &u).sqrt();
            if norm.is_nan() || norm < NEAR {
                return None;
            }
            u.iter_mut().for_each(|x| *x /= norm);
            let forms = self.forms(&u);
            if max_abs(&forms) <= ROOT {
                return Some(u);
            }
            // Across u alone: along it b = C u asks for nothing but a shorter u.
            let mut across = self.gradient(&u);
            for row in 0..across.rows() {
                let part = dot(across.row(row), &u);
                for (column, x) in u.iter().enumerate() {
                    across.set(row, column, across.get(row, column) - part * x);
                }
            }
            let step = least_norm_solve(&across, &forms, TANGENT * TANGENT).ok()?.x;
            // b is quadratic: its derivative is 2 C.
            u.iter_mut().zip(&step).for_each(|(x, d)| *x -= 0.5 * d);
        }
        None
    }

    /// b(u) (k).
    fn forms(&mut self, u: &[f64]) -> Vec<f64> {
        let mut v = self.spread(u);
        self.system.scale_columns(&mut v);
        let mut gamma = vec![0.0; self.system.m()];
        self.evaluation.set_velocity(&v);
        self.evaluation
            .eval_gamma(self.system, &self.inputs, &mut gamma);
        gamma
            .iter_mut()
            .enumerate()
            .for_each(|(row, gamma)| *gamma /= self.system.row_scale(row));
        self.stresses
            .iter()
            .map(|stress| dot(stress, &gamma[..stress.len()]))
            .collect()
    }

    /// C(u) (k, f), by polarisation: without error but round-off.
    fn gradient(&mut self, u: &[f64]) -> Dense {
        let (k, f) = (self.stresses.len(), u.len());
        let mut gradient = Dense::zeros(k, f);
        let mut beside = u.to_vec();
        for column in 0..f {
            beside[column] = u[column] + 1.0;
            let ahead = self.forms(&beside);
            beside[column] = u[column] - 1.0;
            let behind = self.forms(&beside);
            beside[column] = u[column];
            for (row, (a, b)) in ahead.iter().zip(&behind).enumerate() {
                gradient.set(row, column, 0.25 * (a - b));
            }
        }
        gradient
    }

    /// N u (n), scaled.
    fn spread(&self, u: &[f64]) -> Vec<f64> {
        let mut direction = vec![0.0; self.system.n()];
        for (tangent, u) in self.tangents.iter().zip(u) {
            direction
                .iter_mut()
                .zip(tangent)
                .for_each(|(d, x)| *d += u * x);
        }
        direction
    }

    /// How differently bodies, ground among them, turn in a direction: mean square of the rates' differences.
    fn apart(&self, direction: &[f64]) -> f64 {
        let layout = &self.system.layout;
        let rates: Vec<f64> = layout.angles(direction).chain([0.0]).collect();
        let mean = rates.iter().sum::<f64>() / rates.len() as f64;
        rates.iter().map(|rate| (rate - mean).powi(2)).sum::<f64>()
            / dot(&rates, &rates).max(f64::MIN_POSITIVE)
    }
}

/// Whether a root lies in the tangent space of the branch that has the gradient C.
fn lies_in(gradient: &Dense, u: &[f64]) -> bool {
    let row = |k: usize| gradient.row(k);
    let largest = (0..gradient.rows())
        .map(|k| max_abs(row(k)))
        .fold(0.0, f64::max);
    (0..gradient.rows()).all(|k| dot(row(k), u).abs() <= SAME * largest)
}

/// Numbers in [−1, 1], evenly spread and never alike.
fn spread_evenly(k: usize) -> f64 {
    2.0 * (0.618_033_988_749_895 * (k + 1) as f64).fract() - 1.0
}
