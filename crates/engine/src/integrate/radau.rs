//! Radau IIA of orders 5, 9 and 13: an implicit Runge–Kutta method, for stiff problems.
//!
//! ```text
//! Z = h A F(y + Z)                          s = 3, 5, 7 stages; the last one is the end of the step
//! (Λ/h − J) ΔW = T⁻¹ F − Λ W / h            Newton's iteration for W = T⁻¹ Z: one real and (s − 1)/2 complex systems
//! (γ/h − J) e = f(t, y) + Σ Eᵢ Zᵢ / h       error, of order s
//! h′ = h · 0.9 e^(−1/(s+1)) · min(1, (h/h₋) (e₋/e)^(1/(s+1)))     predictive control, within h/5 … 8 h
//! ```
//!
//! J is kept while Newton's iteration converges well, and the factors while h changes little. The systems with J are solved by the
//! equations themselves where they can ([`super::Implicit`], with sparse matrices); otherwise J is made by differences of f, n evaluations, and its factors
//! are dense, and the order stays 5: forces that differences are made for have kinks, which longer steps miss. The continuous extension is the collocation polynomial, of order s; it also starts the next iteration.
//!
//! The number of stages follows the convergence of Newton's iteration: what converges at once has steps that are
//! short for want of order, and gets two stages more; what hardly converges gets two less. Ψ = √(Θ Θ₋) of the last two rates
//! decides, below 0.002 and above 0.8; after a step down ten steps pass before the next one up, which is made only
//! where the step keeps its length.
//!
//! Why this one: of the implicit methods with error control that damp what is stiff, those of low order (BDF, generalised-α)
//! need hundreds of steps per period of the motion that matters for six digits, and BDF is unstable on the imaginary axis, where
//! mechanisms with little damping are. Rosenbrock methods want the exact J at every step. Radau IIA is L-stable at every order,
//! needs J only for convergence, and its systems are no larger than those of one step of an implicit Euler method. At order
//! 9 and 13 a motion takes a fourth to a tenth of the steps of order 5 at the same error.
//!
//! The error is overestimated (order s, not 2 s − 1), so tolerances are transformed inside: rtol′ = 0.1 rtol^(3/4), atol in proportion, as in RADAU5, whatever the order.
//! The power (s + 1)/(2 s), which the orders alone would allow, is too bold where what is stiff moves: there methods of every order
//! lose theirs, and a chain with stiff springs missed its tolerance twenty times.
//!
//! Sources: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., Springer 1996, §IV.8; *Stiff
//! differential equations solved by Radau methods*, J. Comput. Appl. Math. 111, 1999 (orders).

use super::control::{
    ATTEMPTS, Probe, Rejection, failure, first_step, fit, fourth_root, shortest, weigh,
};
use super::radau_tableau::{TABLEAUS, Tableau};
use super::{Counters, Limits, Ode, Refused, StepFailure, Stepper, Tolerance};

mod dense;
mod order;
mod stages;

use dense::Dense;

/// Newton iterations per attempt, by number of stages.
const ITERATIONS: [u32; 3] = [7, 12, 17];
/// Steps after a lower order until a higher one is tried.
const PATIENCE: u32 = 10;
/// Most stages.
const MOST: usize = 7;

/// Implicit method of orders 5 to 13 with continuous extensions of orders 3 to 7.
#[derive(Debug, Clone)]
pub struct Radau {
    given: Tolerance,
    /// Tolerance of the error estimate.
    tolerance: Tolerance,
    pub(super) limits: Limits,
    counters: Counters,
    n: usize,
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
    /// Which of the tableaus is in use, and which the last step was taken with.
    order: usize,
    /// The highest one that these equations may take.
    highest: usize,
    order_taken: usize,
    /// Steps until the order may be raised.
    patience: u32,
    y: Vec<f64>,
    /// f(t, y).
    slope: Vec<f64>,
    /// Room for an argument and a slope.
    stage: Vec<f64>,
    room: Vec<f64>,
    weights: Vec<f64>,
    /// Stages (s × n), their transforms, their slopes or corrections.
    z: Vec<f64>,
    w: Vec<f64>,
    f: Vec<f64>,
    /// Divided differences of the collocation polynomial (s × n).
    differences: Vec<f64>,
    age: Age,
    /// The signed step and the stages that the factors belong to.
    factored: Option<(f64, usize)>,
    /// The systems of equations that don't solve them themselves.
    dense: Dense,
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
#[derive(Debug, Clone, Copy)]
struct Converged {
    iterations: u32,
    rate: f64,
    /// Ψ.
    mean: f64,
}

impl Radau {
    /// A stepper that has not started.
    pub fn new(tolerance: Tolerance, limits: Limits) -> Self {
        Radau {
            given: tolerance.clone(),
            tolerance,
            limits,
            counters: Counters::default(),
            n: 0,
            t: 0.0,
            previous: 0.0,
            h: 0.0,
            taken: 0.0,
            error: 1.0,
            converged: 0.0,
            eta: 1.0,
            order: 0,
            highest: 0,
            order_taken: 0,
            patience: 0,
            y: Vec::new(),
            slope: Vec::new(),
            stage: Vec::new(),
            room: Vec::new(),
            weights: Vec::new(),
            z: Vec::new(),
            w: Vec::new(),
            f: Vec::new(),
            differences: Vec::new(),
            age: Age::Stale,
            factored: None,
            dense: Dense::default(),
        }
    }

    /// Makes room for the equations.
    pub(super) fn reserve(&mut self, ode: &mut dyn Ode) {
        let n = ode.dimension();
        self.n = n;
        for vector in [
            &mut self.y,
            &mut self.slope,
            &mut self.stage,
            &mut self.room,
            &mut self.weights,
        ] {
            vector.resize(n, 0.0);
        }
        for vector in [&mut self.z, &mut self.w, &mut self.f, &mut self.differences] {
            vector.resize(MOST * n, 0.0);
        }
        self.highest = match ode.implicit() {
            Some(_) => TABLEAUS.len() - 1,
            None => 0,
        };
        if self.highest == 0 {
            self.dense.reserve(n, ode.asked());
        }
    }

    fn tableau(&self) -> &'static Tableau {
        &TABLEAUS[self.order]
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
            self.linearise(ode, h)?;
        }
        if self.factored != Some((h, self.order)) {
            self.factor(ode, h)?;
        }
        let converged = self.iterate(ode, h)?;
        let mut error = self.estimate(ode, h, false);
        if error > 1.0 && careful {
            for ((to, y), error) in self.stage.iter_mut().zip(&self.y).zip(&self.f) {
                *to = y + error;
            }
            self.eval(ode, self.t)?;
            error = self.estimate(ode, h, true);
        }
        if !error.is_finite() {
            return Err(Rejection::Error);
        }
        if error <= 1.0 {
            let last = &self.z[(self.tableau().stages - 1) * self.n..];
            for ((to, y), z) in self.stage.iter_mut().zip(&self.y).zip(last) {
                *to = y + z;
            }
            self.eval(ode, t)?;
        }
        Ok((error, converged))
    }

    /// Makes the attempt by h to t, with `stage` and `room` its end and slope, the last accepted step.
    fn finish(&mut self, ode: &mut dyn Ode, h: f64, t: f64, error: f64) {
        self.interpolate_stages();
        self.order_taken = self.order;
        std::mem::swap(&mut self.y, &mut self.stage);
        std::mem::swap(&mut self.slope, &mut self.room);
        (self.previous, self.t, self.taken, self.error) = (self.t, t, h, error.max(1e-2));
        self.counters.steps += 1;
        ode.accept(self.t, &self.y);
    }
}

impl Stepper for Radau {
    fn start(&mut self, ode: &mut dyn Ode, t: f64, y: &[f64], end: f64) -> Result<(), StepFailure> {
        let n = ode.dimension();
        assert!(
            y.len() == n && self.given.atol.len() == n,
            "y and atol have the dimension of the equations"
        );
        self.reserve(ode);
        self.set_order(0);
        let rtol = 0.1 * self.given.rtol.sqrt() * fourth_root(self.given.rtol);
        self.tolerance.rtol = rtol;
        for (inner, given) in self.tolerance.atol.iter_mut().zip(&self.given.atol) {
            *inner = given * rtol / self.given.rtol;
        }
        self.converged = (10.0 * f64::EPSILON / rtol).max(rtol.sqrt().min(0.03));
        (self.t, self.previous, self.taken, self.error) = (t, t, 0.0, 1.0);
        (self.age, self.patience) = (Age::Stale, 0);
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
                    self.follow((signed, first, proposed), error, converged);
                    let factor = self.h / signed.abs();
                    self.finish(ode, signed, t, error);
                    self.choose_order(converged, factor);
                    return Ok(());
                }
                Ok((error, converged)) => {
                    rejection = Rejection::Error;
                    h = signed.abs() * self.factor_for(signed, error, converged.iterations);
                }
                Err(Rejection::Error) => {
                    rejection = Rejection::Error;
                    // poor convergence may be for a poor J, or for more stages than it bears
                    match self.age {
                        Age::Kept => self.age = Age::Stale,
                        Age::Fresh | Age::Stale if self.order > 0 => {
                            self.set_order(self.order - 1);
                            self.patience = PATIENCE;
                            h = 0.5 * signed.abs();
                        }
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
        self.polynomial(s, y);
        y.iter_mut().zip(&self.y).for_each(|(to, y)| *to += y);
        Ok(())
    }

    fn counters(&self) -> Counters {
        self.counters
    }

    fn stiff(&self) -> bool {
        false
    }
}
