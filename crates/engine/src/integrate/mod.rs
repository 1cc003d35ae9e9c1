//! Integration of y′ = f(t, y) in time, for few y and a costly f that can refuse a point.
//!
//! ```text
//! method    kind                        order   dense   costs per step                 use
//! dop853    explicit Runge–Kutta           8       7    12 f (15 with output)           smooth motion: the first choice
//! radau     implicit Runge–Kutta,      2 s − 1     s    s f per Newton iteration,       stiff springs and dampers: where
//!           s = 3, 5 or 7 stages                        n f per Jacobian by differences dop853 takes far too short steps
//! auto      dop853, then radau                          as above                        changes over once, when stiff
//! ```
//!
//! The linear systems of Newton's iteration are solved by the equations themselves where they can ([`Implicit`]), by differences and dense
//! matrices otherwise.
//!
//! A step from t₀ to t₁ is accepted when the estimated local error e satisfies
//! √(Σ (eᵢ / (atolᵢ + rtol · max(|yᵢ(t₀)|, |yᵢ(t₁)|)))² / n) ≤ 1. All roots in the step-size control are square roots
//! (rounded correctly everywhere) or cube roots of one library, so that a run depends on nothing but its input. `step` and `interpolate` allocate
//! nothing.
//!
//! Sources: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. 1993 (dop853);
//! E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed. 1996 (radau).

use thiserror::Error;

mod auto;
mod control;
mod dop853;
mod dop853_tableau;
mod method;
mod radau;
mod radau_tableau;
mod stiffness;

pub use auto::Auto;
pub use dop853::Dop853;
pub use method::{Method, UnknownMethod};
pub use radau::Radau;

/// A point where the right-hand side can't be evaluated: the step was too bold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("the equations can't be evaluated there")]
pub struct Refused;

/// The ordinary differential equations y′ = f(t, y).
pub trait Ode {
    /// Number n of components of y.
    fn dimension(&self) -> usize;

    /// Number m of leading components of y that f depends on; what stands behind them is integrated, and asked by nothing.
    fn asked(&self) -> usize {
        self.dimension()
    }

    /// dy = f(t, y). Values that are not finite count as refused.
    fn eval(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused>;

    /// (t, y) is now the end of an accepted step (or the start): whatever helps to predict may be kept.
    ///
    /// The last evaluation before was at exactly this point.
    fn accept(&mut self, t: f64, y: &[f64]);

    /// These equations as such that solve an implicit method's linear systems themselves; `None` where the method has to, by
    /// differences and dense matrices. It stays what it is while a stepper goes on.
    fn implicit(&mut self) -> Option<&mut dyn Implicit> {
        None
    }
}

/// Equations that solve the linear systems with their J = ∂f/∂y by means of their own.
pub trait Implicit {
    /// Takes J at the last accepted point for what follows, until the next call.
    fn linearise(&mut self) -> Result<(), Refused>;

    /// Makes ready to solve with s − J, of one real s and of complex ones (real and imaginary parts); false where it can't.
    fn factor(&mut self, real: f64, complex: &[[f64; 2]]) -> bool;

    /// Overwrites b with the x of (s − J) x = b, of the real s.
    fn solve(&mut self, b: &mut [f64]);

    /// The same of a complex s by its number; real and imaginary parts of b, and of x.
    fn solve_complex(&mut self, number: usize, b: [&mut [f64]; 2]);

    /// dy = f(t, y) for a stage of the step that begins at the last accepted point: by its number, and whether this is the step's
    /// first call for it. What is known of the stage, or of the point, may be used.
    fn eval_stage(
        &mut self,
        stage: (usize, bool),
        t: f64,
        y: &[f64],
        dy: &mut [f64],
    ) -> Result<(), Refused>;
}

/// Bound of the estimated local error per step, atolᵢ + rtol · |yᵢ|.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerance {
    /// Relative [-], above zero.
    pub rtol: f64,
    /// Absolute, in units of the component (n), above zero where it can vanish.
    pub atol: Vec<f64>,
    /// Largest |yᵢ| that rtol is taken of (n), for components whose differences matter more than they do; or empty.
    pub cap: Vec<f64>,
}

impl Tolerance {
    /// Bound of the error of component i where it is `y` large.
    pub(crate) fn bound(&self, i: usize, y: f64) -> f64 {
        let cap = self.cap.get(i).copied().unwrap_or(f64::INFINITY);
        self.atol[i] + self.rtol * y.abs().min(cap)
    }
}

/// Bounds of the step, all magnitudes in units of t.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Length of the first step; chosen from f where not given.
    pub initial_step: Option<f64>,
    /// Longest step; as long as the error allows where not given.
    pub max_step: Option<f64>,
    /// Where the error asks for less, integration fails; ten rounding units of t where not given.
    pub min_step: Option<f64>,
    /// In which y changes, in units of t, by its order of magnitude; 1 where not given. Where f tells little about it, a first
    /// step is chosen by it.
    pub pace: Option<f64>,
}

/// Why integration can't go on from `t`.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum StepFailure {
    /// The error estimate (or Newton's iteration) rejects even the step h.
    #[error("at t = {t}: the tolerances ask for steps shorter than {h:e}")]
    TooSmall {
        /// Where the steps end.
        t: f64,
        /// The step that was rejected last.
        h: f64,
    },
    /// The right-hand side refuses points however close.
    #[error("at t = {t}: the equations can't be evaluated any further")]
    Refused {
        /// Where the steps end.
        t: f64,
    },
}

/// Work since the stepper was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counters {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected attempts, for their error, for refused points or for want of convergence.
    pub rejected: u64,
    /// Evaluations of f, with those for Jacobians and dense output.
    pub evaluations: u64,
    /// Jacobians by differences.
    pub jacobians: u64,
    /// Factorisations of the stages' matrices.
    pub factorisations: u64,
}

impl std::ops::Add for Counters {
    type Output = Counters;

    fn add(self, other: Counters) -> Counters {
        Counters {
            steps: self.steps + other.steps,
            rejected: self.rejected + other.rejected,
            evaluations: self.evaluations + other.evaluations,
            jacobians: self.jacobians + other.jacobians,
            factorisations: self.factorisations + other.factorisations,
        }
    }
}

/// An integrator that goes step by step; forwards where end > t, backwards where end < t.
pub trait Stepper: Copied + Send {
    /// Starts (again) at (t, y); chooses an initial step where none is given.
    ///
    /// Panics where y or the absolute tolerances don't have the dimension of `ode`.
    fn start(&mut self, ode: &mut dyn Ode, t: f64, y: &[f64], end: f64) -> Result<(), StepFailure>;

    /// One accepted step, never beyond `end`, which the last step hits exactly; at `end` nothing happens.
    ///
    /// `end` may differ from step to step. After a failure t and y are still those of the last accepted step.
    fn step(&mut self, ode: &mut dyn Ode, end: f64) -> Result<(), StepFailure>;

    /// End of the last accepted step.
    fn t(&self) -> f64;

    /// y there.
    fn y(&self) -> &[f64];

    /// Start of the last accepted step; t after `start` and after a failure.
    fn previous(&self) -> f64;

    /// y at a `t` within the last accepted step, by the method's continuous extension.
    ///
    /// Whatever evaluations it needs are made once per step, at the first call.
    fn interpolate(&mut self, ode: &mut dyn Ode, t: f64, y: &mut [f64]) -> Result<(), Refused>;

    /// Work done so far.
    fn counters(&self) -> Counters;

    /// True once the explicit method has found the problem stiff.
    fn stiff(&self) -> bool;
}

/// A stepper that can be copied, whatever it is.
pub trait Copied {
    /// A copy, which goes on as this one does.
    fn copied(&self) -> Box<dyn Stepper>;
}

impl<T: Stepper + Clone + 'static> Copied for T {
    fn copied(&self) -> Box<dyn Stepper> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Stepper> {
    fn clone(&self) -> Self {
        (**self).copied()
    }
}
