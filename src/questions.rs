//! What can be asked of a mechanism.

use linkdyn_ask::run::{limited, warned};
use linkdyn_engine::analysis::Control;

use crate::ask::{
    Accuracy, Allocate, Allocation, Assemblies, AssembliesFound, Check, Circuits, CircuitsFound,
    Compare, Compared, Deviations, Diagnosis, FastestMotion, Linearisation, Modes, Optimise,
    Optimised, PathTime, Question, SmallMotions, StateSpace, Studied, Study, Synthesise,
    Synthesised, Workspace, WorkspaceFound,
};
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

    /// Asks any question of the mechanism, under outside control: [`Compare`], [`Study`] and so on.
    ///
    /// # Errors
    /// Why it has no answer.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::ask::Modes;
    /// use linkdyn::prelude::*;
    ///
    /// let pendulum = Mechanism::bundled("double-pendulum")?;
    /// let modes = pendulum.ask(&Modes { pose: true }, &Control::default())?;
    /// println!("{}", modes.text());
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn ask<Q: Question>(&self, question: &Q, control: &Control) -> Result<Q::Answer, Error> {
        Ok(question.answer(&self.as_file()?, control)?)
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
    /// assert_eq!((check.found.bodies, check.found.mobility.rank), (3, 1));
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn check(&self) -> Result<Diagnosis, Error> {
        self.ask(&Check, &Control::default())
    }

    /// Natural frequencies, damping ratios and shapes of small motions about the equilibrium.
    ///
    /// # Errors
    /// [`Error::Model`] where it can't be compiled.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let pendulum = Mechanism::bundled("double-pendulum")?;
    /// assert_eq!(pendulum.modes()?.found.modes.len(), 2);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn modes(&self) -> Result<SmallMotions, Error> {
        self.ask(&Modes::default(), &Control::default())
    }

    /// The mechanism as a linear system ẋ = A x + B w, y = C x + D w, about rest or at instants of its motion.
    ///
    /// # Errors
    /// [`Error::Model`] where it can't be compiled, [`Error::Question`] where there are no such inputs, outputs or instants.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::ask::StateSpace;
    /// use linkdyn::prelude::*;
    ///
    /// let four_bar = Mechanism::bundled("four-bar")?;
    /// let found = four_bar.linearise(&StateSpace {
    ///     inputs: vec!["driver.motor".into()],
    ///     outputs: vec!["rocker.angle".into()],
    ///     at: vec![0.3],
    ///     ..StateSpace::default()
    /// })?;
    /// let system = &found.systems[0];
    /// assert_eq!((system.a.len(), system.b[0].len(), system.c.len()), (2, 1, 1));
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn linearise(&self, question: &StateSpace) -> Result<Linearisation, Error> {
        self.ask(question, &Control::default())
    }

    /// Runs the model with each model of a joint's clearance, and compares the results.
    ///
    /// # Errors
    /// [`Error::Question`] where there are no such joints, models or columns.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::ask::Compare;
    /// use linkdyn::prelude::*;
    ///
    /// let worn = Mechanism::bundled("slider-crank-clearance")?;
    /// let compared = worn.compare(&Compare {
    ///     joints: vec!["wristpin".into()],
    ///     models: vec!["ideal".into(), "massless_link".into()],
    ///     ..Compare::default()
    /// })?;
    /// assert_eq!(compared.rungs.len(), 2);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn compare(&self, question: &Compare) -> Result<Compared, Error> {
        self.ask(question, &Control::default())
    }

    /// What tolerances and clearances do to the outputs of the model's `accuracy`.
    ///
    /// # Errors
    /// [`Error::Model`] where there are no such outputs, [`Error::Failed`] where the mechanism has no position.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::ask::{Accuracy, Levels};
    /// use linkdyn::prelude::*;
    ///
    /// let first = Accuracy { levels: Some(Levels::First), ..Accuracy::default() };
    /// let deviations = Mechanism::bundled("lock")?.accuracy(&first)?;
    /// assert!(deviations.found.outputs[0].poses[0].nominal.is_finite());
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn accuracy(&self, question: &Accuracy) -> Result<Deviations, Error> {
        self.ask(question, &Control::default())
    }

    /// The cheapest tolerances that keep the limits of outputs.
    ///
    /// # Errors
    /// [`Error::Model`] where nothing has limits or costs, [`Error::Failed`] where the limits can't be kept.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::ask::Allocate;
    /// use linkdyn::prelude::*;
    ///
    /// let refused = Mechanism::bundled("four-bar")?.allocate(&Allocate::default());
    /// assert!(refused.is_err(), "it says no accuracy");
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn allocate(&self, question: &Allocate) -> Result<Allocation, Error> {
        self.ask(question, &Control::default())
    }

    /// Many variants, and what comes out of them; all processors share the work.
    ///
    /// # Errors
    /// [`Error::Question`] where nothing is varied, or the model has no responses.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::ask::{Study, Varied};
    /// use linkdyn::prelude::*;
    ///
    /// let press = Mechanism::bundled("slider-crank")?.set("responses.stroke", "max(piston.x) - min(piston.x)")?;
    /// let varied = vec![Varied::new("crank", "40 mm:60 mm:5")];
    /// let studied = press.study(&Study { varied, ..Study::default() })?;
    /// let stroke = &studied.totals.responses["stroke"].summary;
    /// assert!((stroke.max.unwrap_or_default() - 0.12).abs() < 1e-9);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn study(&self, question: &Study) -> Result<Studied, Error> {
        self.ask(question, &Control::default())
    }

    /// Values of parameters with which goals are met, an objective is least or greatest, or a point takes a path.
    ///
    /// # Errors
    /// [`Error::Model`] or [`Error::Question`] where the question does not fit the model.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::ask::Optimise;
    /// use linkdyn::prelude::*;
    ///
    /// let press = Mechanism::bundled("slider-crank")?;
    /// let found = press.optimise(&Optimise {
    ///     vary: vec!["parameters.crank".into()],
    ///     goals: vec!["max(piston.x) - min(piston.x) = 80 mm".into()],
    ///     ..Optimise::default()
    /// })?;
    /// assert!(found.is_found());
    /// let (name, crank) = found.values().next().expect("a parameter");
    /// assert!(name == "crank" && (crank - 0.04).abs() < 1e-9);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn optimise(&self, question: &Optimise) -> Result<Optimised, Error> {
        self.ask(question, &Control::default())
    }

    /// All ways in which the mechanism closes.
    ///
    /// # Errors
    /// [`Error::Model`] or [`Error::Question`] where the question does not fit the model.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::ask::Assemblies;
    /// use linkdyn::prelude::*;
    ///
    /// let four_bar = Mechanism::bundled("four-bar")?;
    /// let found = four_bar.assemblies(&Assemblies::default())?;
    /// assert_eq!(found.found.found.len(), 2);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn assemblies(&self, question: &Assemblies) -> Result<AssembliesFound, Error> {
        self.ask(question, &Control::default())
    }

    /// Which assemblies are connected by motion of a driver.
    ///
    /// # Errors
    /// As [`Mechanism::assemblies`].
    pub fn circuits(&self, question: &Circuits) -> Result<CircuitsFound, Error> {
        self.ask(question, &Control::default())
    }

    /// Where two drivers can stand, where assemblies meet, and where a point gets.
    ///
    /// # Errors
    /// As [`Mechanism::assemblies`].
    pub fn workspace(&self, question: &Workspace) -> Result<WorkspaceFound, Error> {
        self.ask(question, &Control::default())
    }

    /// Linkages for the task of the file, its `synthesise`.
    ///
    /// # Errors
    /// Where it has no task.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let task: Mechanism = r#"{ "format": "linkdyn/1", "units": { "angle": "deg" }, "synthesise": {
    ///     "function": [[0, 0], [20, 9], [40, 21], [60, 36], [80, 55]] } }"#.parse()?;
    /// let found = task.synthesise()?;
    /// println!("{}", found.text());
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn synthesise(&self) -> Result<Synthesised, Error> {
        self.ask(&Synthesise, &Control::default())
    }

    /// The fastest motion of a driver along a stroke, under limits of effort, speed and joint forces.
    ///
    /// # Errors
    /// [`Error::Model`] or [`Error::Question`] where the question does not fit the model, [`Error::Failed`] where no motion keeps the
    /// limits.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::ask::PathTime;
    /// use linkdyn::prelude::*;
    ///
    /// let press = Mechanism::bundled("slider-crank")?;
    /// let found = press.path_time(&PathTime {
    ///     from: Some("0 deg".into()),
    ///     to: Some("90 deg".into()),
    ///     acceleration: Some("8 rad/s^2".into()),
    ///     ..PathTime::default()
    /// })?;
    /// // At 8 rad/s² up to the middle, and back to rest: T = 2 √(Δ/a).
    /// let time = 2.0 * (90_f64.to_radians() / 8.0).sqrt();
    /// assert!((found.time() / time - 1.0).abs() < 1e-9);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn path_time(&self, question: &PathTime) -> Result<FastestMotion, Error> {
        self.ask(question, &Control::default())
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
