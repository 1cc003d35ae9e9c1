//! What can be asked of a mechanism: a run, a diagnosis, its modes.

use std::time::{Duration, Instant};

use linkdyn_engine::analysis::{self, Check, Control, Linearised};
use linkdyn_model::Model;

use crate::error::Error;
use crate::mechanism::Mechanism;
use crate::run::Run;

impl Mechanism {
    /// Runs the model's analysis.
    ///
    /// # Errors
    /// [`Error::Model`] where the model has no analysis, or lacks what it needs. How the run ended is told by the [`Run`].
    pub fn run(&self) -> Result<Run, Error> {
        self.run_under(&Control::default())
    }

    /// Runs the model's analysis under outside control: a deadline, an interrupt, an eye on progress.
    ///
    /// # Errors
    /// As [`Mechanism::run`].
    pub fn run_under(&self, control: &Control) -> Result<Run, Error> {
        let own = deadline(self.model(), Instant::now());
        let control = Control {
            deadline: [control.deadline, own].into_iter().flatten().min(),
            ..control.clone()
        };
        let outcome = self.prepared()?.run(&control);
        let mut outcome = outcome.map_err(|found| self.place(found))?;
        let warnings = self.warnings().iter().cloned();
        outcome.report.warnings.splice(0..0, warnings);
        Ok(Run::new(self.clone(), outcome))
    }

    /// Assembles and diagnoses the model without running it: mobility, loops, what is missing for which analysis.
    ///
    /// # Errors
    /// [`Error::Model`] where it can't be compiled.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let check = Mechanism::bundled("four-bar")?.check()?;
    /// assert_eq!((check.bodies, check.mobility.rank), (3, 1));
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn check(&self) -> Result<Check, Error> {
        analysis::check(self.model()).map_err(|found| self.place(found))
    }

    /// Natural frequencies, damping ratios and shapes of small motions about the equilibrium.
    ///
    /// # Errors
    /// [`Error::Model`] where it can't be compiled.
    pub fn modes(&self) -> Result<Linearised, Error> {
        let modes = analysis::modes(self.model(), false, &Control::default());
        modes.map_err(|found| self.place(found))
    }
}

/// When `max_wall_time` is over; none where there is no such setting, or no clock can tell that instant.
pub(crate) fn deadline(model: &Model, started: Instant) -> Option<Instant> {
    let seconds = model.analysis.as_ref()?.solver.max_wall_time?;
    started.checked_add(Duration::try_from_secs_f64(seconds).ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::mm;
    use linkdyn_engine::analysis::Prepared;

    #[test]
    fn a_mechanism_is_compiled_once() {
        fn compiled(mechanism: &Mechanism) -> *const Prepared {
            mechanism.prepared().expect("compiles")
        }
        let mechanism = Mechanism::bundled("four-bar").expect("bundled");
        let before = compiled(&mechanism);
        mechanism.run().expect("runs");
        assert_eq!(before, compiled(&mechanism));
        let crank = mechanism.parameter("crank").expect("there");
        let longer = mechanism.with([(crank, mm(90.0))]).expect("sound");
        assert_ne!(before, compiled(&longer), "other numbers");
        // What is made of it again has the same system, whoever compiled it.
        let twin = longer.clone();
        longer.run().expect("runs");
        assert_eq!(compiled(&longer), compiled(&twin));
    }
}
