//! Eigenvalues of small matrices, given by rows.
//!
//! ```text
//! A x = λ x                        A symmetric (f, f): λ ascending, x orthonormal
//! (s² M + s C + K) x = 0           M symmetric, positive definite
//! ```
//!
//! The second with M = L Lᵀ, x = L⁻ᵀ y and time in units of the fastest motion: without damping, K symmetric, from
//! −s² y = L⁻¹ K L⁻ᵀ y; else from the companion matrix [0, I; −K̃, −C̃] (Tisseur and Meerbergen 2001, §3.4).

use crate::small::SmallLu;
use faer::Mat;
use nalgebra::{DMatrix, DVector};

/// A part of a matrix that is smaller than this, relative to the largest, is round-off [–].
const ROUND_OFF: f64 = 1e-11;
/// The same for roots of eigenvalues.
const ROUND_OFF_ROOT: f64 = 3e-6;

/// One solution of the quadratic eigenproblem; a pair of conjugate solutions is given once, with im ≥ 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Eigenpair {
    /// s: real and imaginary part [1/s, rad/s].
    pub value: [f64; 2],
    /// x (f): real and imaginary parts.
    pub vector: Vec<[f64; 2]>,
}

/// Why there are no eigenvalues.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EigenFault {
    /// M is not positive definite.
    Massless,
    /// The iteration does not end.
    NoConvergence,
}

/// Eigenvalues (ascending) and eigenvectors of the symmetric part of `a`.
pub fn symmetric(a: &[f64], f: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
    if f == 0 {
        return (Vec::new(), Vec::new());
    }
    let a = DMatrix::from_row_slice(f, f, a);
    let eigen = ((&a + a.transpose()) * 0.5).symmetric_eigen();
    let mut order: Vec<usize> = (0..f).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let vectors = order
        .iter()
        .map(|&k| eigen.eigenvectors.column(k).iter().copied().collect())
        .collect();
    (
        order.iter().map(|&k| eigen.eigenvalues[k]).collect(),
        vectors,
    )
}

/// x with A x = b; `None` if A is singular.
pub fn solve(a: &[f64], b: &[f64]) -> Option<Vec<f64>> {
    let mut lu = SmallLu::new(b.len());
    lu.values().copy_from_slice(a);
    if !lu.factor() {
        return None;
    }
    let mut x = b.to_vec();
    lu.solve(&mut x);
    x.iter().all(|x| x.is_finite()).then_some(x)
}

/// All s and x, slowest first.
///
/// # Errors
/// See [`EigenFault`].
pub fn quadratic(
    mass: &[f64],
    damping: &[f64],
    stiffness: &[f64],
    f: usize,
) -> Result<Vec<Eigenpair>, EigenFault> {
    if f == 0 {
        return Ok(Vec::new());
    }
    let square = |a: &[f64]| DMatrix::from_row_slice(f, f, a);
    let (mass, damping, stiffness) = (square(mass), square(damping), square(stiffness));
    // Rows and columns by the size of their diagonal, so that the pivots tell the rank.
    let scale = mass.diagonal().map(f64::sqrt);
    if scale.iter().any(|s| !s.is_normal()) {
        return Err(EigenFault::Massless);
    }
    let unit = DMatrix::from_fn(f, f, |i, j| mass[(i, j)] / (scale[i] * scale[j]));
    let lower = unit.cholesky().ok_or(EigenFault::Massless)?.l();
    if lower.diagonal().min() < ROUND_OFF.sqrt() {
        return Err(EigenFault::Massless);
    }
    let inverse = lower.clone().try_inverse().ok_or(EigenFault::Massless)?
        * DMatrix::from_diagonal(&scale.map(|s| 1.0 / s));
    let (damping, stiffness) = (
        &inverse * damping * inverse.transpose(),
        &inverse * stiffness * inverse.transpose(),
    );
    let rate = stiffness.amax().sqrt().max(damping.amax());
    let skew = (&stiffness - stiffness.transpose()).amax();
    let mut pairs =
        if rate == 0.0 || (damping.amax() <= ROUND_OFF * rate && skew <= 1e-9 * stiffness.amax()) {
            undamped(&stiffness)
        } else {
            companion(&damping, &stiffness, rate)?
        };
    for pair in &mut pairs {
        let part = |k: usize| {
            inverse.transpose() * DVector::from_iterator(f, pair.vector.iter().map(|x| x[k]))
        };
        let (re, im) = (part(0), part(1));
        pair.vector = re
            .iter()
            .zip(im.iter())
            .map(|(&re, &im)| [re, im])
            .collect();
    }
    let size = |pair: &Eigenpair| pair.value[0].hypot(pair.value[1]);
    pairs.sort_by(|a, b| {
        size(a)
            .total_cmp(&size(b))
            .then(b.value[0].total_cmp(&a.value[0]))
    });
    Ok(pairs)
}

/// s² = −κ for each eigenvalue κ of the stiffness.
fn undamped(stiffness: &DMatrix<f64>) -> Vec<Eigenpair> {
    let f = stiffness.nrows();
    let rows: Vec<f64> = stiffness.transpose().iter().copied().collect();
    let (values, vectors) = symmetric(&rows, f);
    let zero = ROUND_OFF * stiffness.amax();
    let mut pairs = Vec::new();
    for (kappa, vector) in values.into_iter().zip(vectors) {
        let vector: Vec<[f64; 2]> = vector.into_iter().map(|x| [x, 0.0]).collect();
        if kappa.abs() <= zero {
            pairs.push(Eigenpair {
                value: [0.0; 2],
                vector,
            });
        } else if kappa > 0.0 {
            pairs.push(Eigenpair {
                value: [0.0, kappa.sqrt()],
                vector,
            });
        } else {
            let root = (-kappa).sqrt();
            pairs.push(Eigenpair {
                value: [root, 0.0],
                vector: vector.clone(),
            });
            pairs.push(Eigenpair {
                value: [-root, 0.0],
                vector,
            });
        }
    }
    pairs
}

/// Eigenvalues of the companion matrix, in units of `rate`.
fn companion(
    damping: &DMatrix<f64>,
    stiffness: &DMatrix<f64>,
    rate: f64,
) -> Result<Vec<Eigenpair>, EigenFault> {
    let f = damping.nrows();
    let matrix = Mat::from_fn(2 * f, 2 * f, |i, j| match (i < f, j < f) {
        (true, _) => f64::from(u8::from(j == i + f)),
        (false, true) => -stiffness[(i - f, j)] / (rate * rate),
        (false, false) => -damping[(i - f, j - f)] / rate,
    });
    let eigen = matrix.eigen().map_err(|_| EigenFault::NoConvergence)?;
    let mut pairs = Vec::new();
    for k in 0..2 * f {
        let value = eigen.S()[k];
        let small = |x: f64| {
            if x.abs() <= ROUND_OFF_ROOT * ROUND_OFF_ROOT {
                0.0
            } else {
                x
            }
        };
        let (re, im) = (small(value.re), small(value.im));
        // Both of a double zero are off by the root of round-off.
        let (re, im) = if re.hypot(im) <= ROUND_OFF_ROOT.powf(1.3) {
            (0.0, 0.0)
        } else {
            (re, im)
        };
        if im < 0.0 {
            continue;
        }
        let vector = (0..f)
            .map(|i| [eigen.U()[(i, k)].re, eigen.U()[(i, k)].im])
            .collect();
        pairs.push(Eigenpair {
            value: [re * rate, im * rate],
            vector,
        });
    }
    Ok(pairs)
}
