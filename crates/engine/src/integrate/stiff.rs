//! The implicit method, by who solves its linear systems: RADAU5 with dense matrices of its own, or Radau IIA of orders 5 to 13
//! where the equations solve them.

use super::{Counters, Limits, Ode, Radau, Radau5, Refused, StepFailure, Stepper, Tolerance};

/// Implicit.
#[derive(Debug, Clone)]
pub struct Stiff {
    dense: Radau5,
    sparse: Radau,
    is_sparse: bool,
}

impl Stiff {
    /// A stepper that has not started.
    pub fn new(tolerance: Tolerance, limits: Limits) -> Self {
        Stiff {
            dense: Radau5::new(tolerance.clone(), limits),
            sparse: Radau::new(tolerance, limits),
            is_sparse: false,
        }
    }

    /// Bounds of the steps from the next start on.
    pub(super) fn set_limits(&mut self, limits: Limits) {
        (self.dense.limits, self.sparse.limits) = (limits, limits);
    }

    /// Makes room for the equations.
    pub(super) fn reserve(&mut self, ode: &mut dyn Ode) {
        let n = ode.dimension();
        self.is_sparse = ode.implicit().is_some();
        if self.is_sparse {
            self.sparse.reserve(n);
        } else {
            self.dense.reserve(n, ode.asked());
        }
    }

    fn current(&self) -> &dyn Stepper {
        if self.is_sparse {
            &self.sparse
        } else {
            &self.dense
        }
    }

    fn current_mut(&mut self) -> &mut dyn Stepper {
        if self.is_sparse {
            &mut self.sparse
        } else {
            &mut self.dense
        }
    }
}

impl Stepper for Stiff {
    fn start(&mut self, ode: &mut dyn Ode, t: f64, y: &[f64], end: f64) -> Result<(), StepFailure> {
        self.is_sparse = ode.implicit().is_some();
        self.current_mut().start(ode, t, y, end)
    }

    fn step(&mut self, ode: &mut dyn Ode, end: f64) -> Result<(), StepFailure> {
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
        self.dense.counters() + self.sparse.counters()
    }

    fn stiff(&self) -> bool {
        false
    }
}
