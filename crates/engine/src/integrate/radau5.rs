//! RADAU5: the implicit Runge–Kutta method Radau IIA of order 5, for stiff problems.
//!
//! ```text
//! Z = h A F(y + Z)                          3 stages; the last one is the end of the step
//! (Λ/h − J) ΔW = T⁻¹ F − Λ W / h            Newton's iteration for W = T⁻¹ Z, one real and one complex system
//! (γ/h − J) e = f(t, y) + Σ Eᵢ Zᵢ / h       error, of order 3
//! h′ = h · 0.9 e^(−1/4) · min(1, (h/h₋) (e₋/e)^(1/4))     predictive control, within h/5 … 8 h
//! ```
//!
//! The error is overestimated (order 3, not 5), so tolerances are transformed inside: rtol′ = 0.1 rtol^(3/4), atol in
//! proportion. J is made by differences of f, n evaluations, and kept while Newton's iteration converges well; the
//! factors are kept while h changes little. The continuous extension is the collocation polynomial, of order 3; it
//! also starts the next iteration.
//!
//! Source: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., Springer 1996, §IV.8.

use super::control::{
    ATTEMPTS, Probe, Rejection, failure, first_step, fit, fourth_root, shortest, weigh,
};
use super::radau5_tableau::C;
use super::{Counters, Limits, Ode, Refused, StepFailure, Stepper, Tolerance};
use linkdyn_linear::small::SmallLu;

mod stages;

/// Safety factor of the step-size control [-].
const SAFETY: f64 = 0.9;
/// A step changes by factors within these [-].
const SHRINK: f64 = 0.2;
const GROW: f64 = 8.0;
/// Newton iterations per attempt.
const ITERATIONS: u32 = 7;
/// J is kept when iterations shrink the error by this or when two are enough [-].
const KEEP_RATE: f64 = 1e-3;
const KEEP_ITERATIONS: u32 = 2;
/// A step that would grow by less keeps its length, and the factors [-].
const KEEP_STEP: f64 = 1.2;

/// Implicit method of order 5 with continuous extension of order 3.
#[derive(Debug, Clone)]
pub struct Radau5 {
    given: Tolerance,
    /// Tolerance of the error estimate.
    tolerance: Tolerance,
    pub(super) limits: Limits,
    counters: Counters,
    n: usize,
    /// Components that f depends on.
    asked: usize,
    t: f64,
    previous: f64,
    /// Length proposed for the next step.
    h: f64,
    /// The last accepted step, with its sign; zero where there is none.
    taken: f64,
    /// Error of the last accepted step.
    error: f64,
    /// Newton's iteration stops at corrections below this [-].
    converged: f64,
    /// θ / (1 − θ) of Newton's last iteration, θ its rate of convergence.
    eta: f64,
    y: Vec<f64>,
    /// f(t, y).
    slope: Vec<f64>,
    /// Room for an argument and a slope.
    stage: Vec<f64>,
    room: Vec<f64>,
    weights: Vec<f64>,
    /// Stages (3 × n), their transforms, their slopes or corrections.
    z: Vec<f64>,
    w: Vec<f64>,
    f: Vec<f64>,
    /// Divided differences of the collocation polynomial (3 × n).
    dense: Vec<f64>,
    /// ∂f/∂y (n × m) by rows; the other columns are zero.
    jacobian: Vec<f64>,
    /// Real and imaginary parts of the components that f depends on (2 × m).
    pair: Vec<f64>,
    age: Age,
    /// The signed step that the factors belong to; NaN where there are none.
    factored: f64,
    real: SmallLu,
    /// The complex system, by its real and imaginary parts.
    complex: SmallLu,
}

/// How good J is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Age {
    /// Made at (t, y).
    Fresh,
    /// Made earlier, and good enough.
    Kept,
    /// To be made.
    Stale,
}

/// How Newton's iteration went.
struct Converged {
    iterations: u32,
    rate: f64,
}

impl Radau5 {
    /// A stepper that has not started.
    pub fn new(tolerance: Tolerance, limits: Limits) -> Self {
        Radau5 {
            given: tolerance.clone(),
            tolerance,
            limits,
            counters: Counters::default(),
            n: 0,
            asked: 0,
            t: 0.0,
            previous: 0.0,
            h: 0.0,
            taken: 0.0,
            error: 1.0,
            converged: 0.0,
            eta: 1.0,
            y: Vec::new(),
            slope: Vec::new(),
            stage: Vec::new(),
            room: Vec::new(),
            weights: Vec::new(),
            z: Vec::new(),
            w: Vec::new(),
            f: Vec::new(),
            dense: Vec::new(),
            jacobian: Vec::new(),
            pair: Vec::new(),
            age: Age::Stale,
            factored: f64::NAN,
            real: SmallLu::default(),
            complex: SmallLu::default(),
        }
    }

    /// Makes room for n components, of which f depends on the first m.
    pub(super) fn reserve(&mut self, n: usize, m: usize) {
        (self.n, self.asked) = (n, m);
        for vector in [
            &mut self.y,
            &mut self.slope,
            &mut self.stage,
            &mut self.room,
            &mut self.weights,
        ] {
            vector.resize(n, 0.0);
        }
        for vector in [&mut self.z, &mut self.w, &mut self.f, &mut self.dense] {
            vector.resize(3 * n, 0.0);
        }
        self.jacobian.resize(n * m, 0.0);
        self.pair.resize(2 * m, 0.0);
        self.real.resize(m);
        self.complex.resize(2 * m);
    }

    /// An attempt by h that ends at t: its error, once f accepts its end, too (the slope is left in `room`).
    fn attempt(
        &mut self,
        ode: &mut dyn Ode,
        h: f64,
        t: f64,
        careful: bool,
    ) -> Result<(f64, Converged), Rejection> {
        if self.age == Age::Stale {
            self.differentiate(ode, h)?;
        }
        if self.factored != h {
            self.factor(h)?;
        }
        let converged = self.iterate(ode, h)?;
        let n = self.n;
        let mut error = self.estimate(h, false);
        if error > 1.0 && careful {
            for ((to, y), error) in self.stage.iter_mut().zip(&self.y).zip(&self.f) {
                *to = y + error;
            }
            self.eval(ode, self.t)?;
            error = self.estimate(h, true);
        }
        if !error.is_finite() {
            return Err(Rejection::Error);
        }
        if error <= 1.0 {
            for ((to, y), z) in self.stage.iter_mut().zip(&self.y).zip(&self.z[2 * n..]) {
                *to = y + z;
            }
            self.eval(ode, t)?;
        }
        Ok((error, converged))
    }

    /// Factor for the next step after one with this error.
    fn factor_for(&self, h: f64, error: f64, iterations: u32) -> f64 {
        let effort = f64::from(1 + 2 * ITERATIONS) / f64::from(iterations + 2 * ITERATIONS);
        let factor = (SAFETY * effort.min(1.0) / fourth_root(error)).clamp(SHRINK, GROW);
        if error > 1.0 || self.taken == 0.0 {
            return factor;
        }
        let predicted =
            SAFETY * (h / self.taken).abs() * fourth_root(self.error / error) / fourth_root(error);
        factor.min(predicted.clamp(SHRINK, GROW))
    }

    /// Makes the attempt by h to t, with `stage` and `room` its end and slope, the last accepted step.
    fn finish(&mut self, ode: &mut dyn Ode, h: f64, t: f64, error: f64) {
        let n = self.n;
        for i in 0..n {
            let [a, b, c] = [self.z[i], self.z[n + i], self.z[2 * n + i]];
            let last = (b - c) / (C[1] - 1.0);
            let inner = (a - b) / (C[0] - C[1]);
            let second = (inner - last) / (C[0] - 1.0);
            self.dense[i] = last;
            self.dense[n + i] = second;
            self.dense[2 * n + i] = second - (inner - a / C[0]) / C[1];
        }
        std::mem::swap(&mut self.y, &mut self.stage);
        std::mem::swap(&mut self.slope, &mut self.room);
        (self.previous, self.t, self.taken, self.error) = (self.t, t, h, error.max(1e-2));
        self.counters.steps += 1;
        ode.accept(self.t, &self.y);
    }
}

impl Stepper for Radau5 {
    fn start(&mut self, ode: &mut dyn Ode, t: f64, y: &[f64], end: f64) -> Result<(), StepFailure> {
        let n = ode.dimension();
        assert!(
            y.len() == n && self.given.atol.len() == n,
            "y and atol have the dimension of the equations"
        );
        self.reserve(n, ode.asked());
        let rtol = 0.1 * self.given.rtol.sqrt() * fourth_root(self.given.rtol);
        self.tolerance.rtol = rtol;
        for (inner, given) in self.tolerance.atol.iter_mut().zip(&self.given.atol) {
            *inner = given * rtol / self.given.rtol;
        }
        self.converged = (10.0 * f64::EPSILON / rtol).max(rtol.sqrt().min(0.03));
        (self.t, self.previous, self.taken, self.error, self.eta) = (t, t, 0.0, 1.0, 1.0);
        (self.age, self.factored) = (Age::Stale, f64::NAN);
        self.y.copy_from_slice(y);
        self.stage.copy_from_slice(y);
        self.eval(ode, t)
            .map_err(|rejection| failure(rejection, t, 0.0))?;
        self.slope.copy_from_slice(&self.room);
        ode.accept(t, y);
        weigh(&self.tolerance, y, &mut self.weights);
        let probe = Probe {
            root: fourth_root,
            weights: &self.weights,
            y: &mut self.stage,
            dy: &mut self.room,
        };
        let (h, evaluations) = first_step(ode, t, y, &self.slope, end, &self.limits, probe);
        self.h = h;
        self.counters.evaluations += evaluations;
        Ok(())
    }

    fn step(&mut self, ode: &mut dyn Ode, end: f64) -> Result<(), StepFailure> {
        if self.t == end {
            return Ok(());
        }
        let proposed = self.h.min(self.limits.max_step.unwrap_or(f64::INFINITY));
        let shortest = shortest(self.t, &self.limits);
        let mut h = proposed.max(shortest);
        let mut rejection = Rejection::Error;
        let mut first = true;
        for _ in 0..ATTEMPTS {
            let (signed, last) = fit(self.t, h, end, &self.limits);
            let t = if last { end } else { self.t + signed };
            match self.attempt(ode, signed, t, !first || self.taken == 0.0) {
                Ok((error, converged)) if error <= 1.0 => {
                    let factor = self
                        .factor_for(signed, error, converged.iterations)
                        .min(if first { GROW } else { 1.0 });
                    let keep =
                        converged.iterations <= KEEP_ITERATIONS || converged.rate <= KEEP_RATE;
                    self.age = if keep { Age::Kept } else { Age::Stale };
                    let stay = keep && (1.0..=KEEP_STEP).contains(&factor);
                    let cut = if first && signed.abs() < proposed {
                        proposed
                    } else {
                        0.0
                    };
                    self.h = (if stay { 1.0 } else { factor } * signed.abs()).max(cut);
                    self.finish(ode, signed, t, error);
                    return Ok(());
                }
                Ok((error, converged)) => {
                    rejection = Rejection::Error;
                    h = signed.abs() * self.factor_for(signed, error, converged.iterations);
                }
                Err(Rejection::Error) => {
                    rejection = Rejection::Error;
                    // poor convergence may be for a poor J
                    match self.age {
                        Age::Kept => self.age = Age::Stale,
                        Age::Fresh | Age::Stale => h = 0.5 * signed.abs(),
                    }
                }
                Err(Rejection::Refused) => {
                    rejection = Rejection::Refused;
                    h = 0.5 * signed.abs();
                }
            }
            first = false;
            self.counters.rejected += 1;
            if h < shortest {
                break;
            }
        }
        (self.h, self.previous, self.taken) = (h, self.t, 0.0);
        Err(failure(rejection, self.t, h))
    }

    fn t(&self) -> f64 {
        self.t
    }

    fn y(&self) -> &[f64] {
        &self.y
    }

    fn previous(&self) -> f64 {
        self.previous
    }

    fn interpolate(&mut self, _: &mut dyn Ode, t: f64, y: &mut [f64]) -> Result<(), Refused> {
        let s = if self.taken == 0.0 {
            0.0
        } else {
            (t - self.t) / self.taken
        };
        for (i, y) in y.iter_mut().enumerate() {
            *y = self.y[i] + self.polynomial(i, s);
        }
        Ok(())
    }

    fn counters(&self) -> Counters {
        self.counters
    }

    fn stiff(&self) -> bool {
        false
    }
}
