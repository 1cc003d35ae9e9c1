//! What can be asked of a mechanism: a run, a diagnosis, its modes.

use linkdyn_ask::run::{limited, warned};
use linkdyn_engine::analysis::{self, Check, Control, Linearised};

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
        let outcome = self.prepared()?.run(&limited(self.model(), control));
        let outcome = outcome.map_err(|found| self.place(found))?;
        Ok(Run::new(self.clone(), warned(outcome, self.warnings())))
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
