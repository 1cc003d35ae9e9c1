//! DOP853 until the problem proves stiff, RADAU5 from there on.
//!
//! The change is made once, at the start of the step after the fifteenth that speaks for stiffness, and never back:
//! also a stepper that is started again stays with what it has found.

use super::{Counters, Dop853, Limits, Ode, Radau5, Refused, StepFailure, Stepper, Tolerance};

/// Explicit, then implicit.
#[derive(Debug, Clone)]
pub struct Auto {
    limits: Limits,
    explicit: Dop853,
    implicit: Radau5,
    changed: bool,
}

impl Auto {
    /// A stepper that has not started.
    pub fn new(tolerance: Tolerance, limits: Limits) -> Self {
        Auto {
            limits,
            explicit: Dop853::new(tolerance.clone(), limits),
            implicit: Radau5::new(tolerance, limits),
            changed: false,
        }
    }

    /// The stepper at work.
    fn current(&self) -> &dyn Stepper {
        if self.changed {
            &self.implicit
        } else {
            &self.explicit
        }
    }

    fn current_mut(&mut self) -> &mut dyn Stepper {
        if self.changed {
            &mut self.implicit
        } else {
            &mut self.explicit
        }
    }
}

impl Stepper for Auto {
    fn start(&mut self, ode: &mut dyn Ode, t: f64, y: &[f64], end: f64) -> Result<(), StepFailure> {
        self.implicit.limits = self.limits;
        self.implicit.reserve(ode.dimension());
        self.current_mut().start(ode, t, y, end)
    }

    fn step(&mut self, ode: &mut dyn Ode, end: f64) -> Result<(), StepFailure> {
        if !self.changed && self.explicit.stiff() && self.explicit.t() != end {
            let (t, h) = (self.explicit.t(), self.explicit.proposal());
            self.implicit.limits = Limits {
                initial_step: Some(h),
                ..self.limits
            };
            self.implicit.start(ode, t, self.explicit.y(), end)?;
            self.changed = true;
        }
        self.current_mut().step(ode, end)
    }

    fn t(&self) -> f64 {
        self.current().t()
    }

    fn y(&self) -> &[f64] {
        self.current().y()
    }

    fn previous(&self) -> f64 {
        self.current().previous()
    }

    fn interpolate(&mut self, ode: &mut dyn Ode, t: f64, y: &mut [f64]) -> Result<(), Refused> {
        self.current_mut().interpolate(ode, t, y)
    }

    fn counters(&self) -> Counters {
        let (a, b) = (self.explicit.counters(), self.implicit.counters());
        Counters {
            steps: a.steps + b.steps,
            rejected: a.rejected + b.rejected,
            evaluations: a.evaluations + b.evaluations,
            jacobians: a.jacobians + b.jacobians,
            factorisations: a.factorisations + b.factorisations,
        }
    }

    fn stiff(&self) -> bool {
        self.explicit.stiff()
    }
}
