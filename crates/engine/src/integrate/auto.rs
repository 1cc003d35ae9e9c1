//! DOP853 until the problem proves stiff, Radau IIA from there on where that is cheaper.
//!
//! The change is made at the start of the step after the fifteenth that speaks for stiffness, and is on trial for some steps:
//! where Radau IIA takes more evaluations of f for the same time than those fifteen did, DOP853 goes on, and twice as many steps
//! must speak for the next trial. A contact is stiff by the first measure, for its frequency bounds the steps of an explicit
//! method; but it is to be followed through each of its periods, which the method of higher order does with fewer evaluations.
//! A stepper that is started again stays with what it has found.

use super::{Counters, Dop853, Limits, Ode, Radau, Refused, StepFailure, Stepper, Tolerance};

/// Implicit steps until their length is their own, not the explicit method's.
const WARM: u32 = 6;
/// Implicit steps of a trial.
const TRIAL: u32 = 16;

/// A point of the integration, and the work until then.
#[derive(Debug, Clone, Copy)]
struct WorkMark {
    t: f64,
    evaluations: u64,
}

impl WorkMark {
    fn of(stepper: &dyn Stepper) -> Self {
        WorkMark {
            t: stepper.t(),
            evaluations: stepper.counters().evaluations,
        }
    }

    /// Evaluations per time from here to there.
    fn price(self, there: WorkMark) -> f64 {
        (there.evaluations - self.evaluations) as f64 / (there.t - self.t).abs()
    }
}

/// Which method is at work.
#[derive(Debug, Clone, Copy)]
enum ActiveMethod {
    /// The explicit one; since when steps speak for stiffness.
    Explicit(Option<WorkMark>),
    /// The implicit one on trial: its steps, where its own began, and what the explicit one cost.
    Trial {
        steps: u32,
        from: WorkMark,
        price: f64,
    },
    /// The implicit one.
    Implicit,
}

/// Explicit, then implicit.
#[derive(Debug, Clone)]
pub struct Auto {
    limits: Limits,
    explicit: Dop853,
    implicit: Radau,
    mode: ActiveMethod,
}

impl Auto {
    /// A stepper that has not started.
    pub fn new(tolerance: Tolerance, limits: Limits) -> Self {
        Auto {
            limits,
            explicit: Dop853::new(tolerance.clone(), limits),
            implicit: Radau::new(tolerance, limits),
            mode: ActiveMethod::Explicit(None),
        }
    }

    fn is_explicit(&self) -> bool {
        matches!(self.mode, ActiveMethod::Explicit(_))
    }

    /// The stepper at work.
    fn current(&self) -> &dyn Stepper {
        if self.is_explicit() {
            &self.explicit
        } else {
            &self.implicit
        }
    }

    fn current_mut(&mut self) -> &mut dyn Stepper {
        if self.is_explicit() {
            &mut self.explicit
        } else {
            &mut self.implicit
        }
    }

    /// Changes the method where that is due.
    fn choose(&mut self, ode: &mut dyn Ode, end: f64) -> Result<(), StepFailure> {
        match self.mode {
            ActiveMethod::Explicit(since) if self.explicit.stiff() && self.explicit.t() != end => {
                let now = WorkMark::of(&self.explicit);
                self.implicit.limits = Limits {
                    initial_step: Some(self.explicit.proposal()),
                    ..self.limits
                };
                self.implicit.start(ode, now.t, self.explicit.y(), end)?;
                self.mode = ActiveMethod::Trial {
                    steps: 0,
                    from: now,
                    price: since.map_or(f64::INFINITY, |since| since.price(now)),
                };
            }
            ActiveMethod::Trial { steps, from, price }
                if steps >= TRIAL && self.implicit.t() != end =>
            {
                let now = WorkMark::of(&self.implicit);
                self.mode = ActiveMethod::Implicit;
                if from.price(now) > price {
                    self.explicit.limits.initial_step = Some(self.explicit.proposal());
                    self.explicit.start(ode, now.t, self.implicit.y(), end)?;
                    self.explicit.stiffness.doubt();
                    self.mode = ActiveMethod::Explicit(None);
                }
            }
            ActiveMethod::Explicit(_) | ActiveMethod::Trial { .. } | ActiveMethod::Implicit => {}
        }
        Ok(())
    }

    /// Notes a step.
    fn note(&mut self) {
        match &mut self.mode {
            ActiveMethod::Explicit(since) => {
                let is_suspected = self.explicit.stiffness.is_suspected();
                *since =
                    is_suspected.then(|| since.unwrap_or_else(|| WorkMark::of(&self.explicit)));
            }
            ActiveMethod::Trial { steps, from, .. } => {
                *steps += 1;
                if *steps == WARM {
                    *from = WorkMark::of(&self.implicit);
                }
            }
            ActiveMethod::Implicit => {}
        }
    }
}

impl Stepper for Auto {
    fn start(&mut self, ode: &mut dyn Ode, t: f64, y: &[f64], end: f64) -> Result<(), StepFailure> {
        self.explicit.limits = self.limits;
        self.implicit.limits = self.limits;
        self.implicit.reserve(ode);
        // What is on trial is tried anew.
        self.mode = match self.mode {
            ActiveMethod::Explicit(_) | ActiveMethod::Trial { .. } => ActiveMethod::Explicit(None),
            ActiveMethod::Implicit => ActiveMethod::Implicit,
        };
        self.current_mut().start(ode, t, y, end)
    }

    fn step(&mut self, ode: &mut dyn Ode, end: f64) -> Result<(), StepFailure> {
        self.choose(ode, end)?;
        self.current_mut().step(ode, end)?;
        self.note();
        Ok(())
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
        self.explicit.counters() + self.implicit.counters()
    }

    fn stiff(&self) -> bool {
        self.explicit.stiff()
    }
}
