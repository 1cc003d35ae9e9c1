//! A simulation that is stepped by the program.

use std::sync::Arc;

use linkdyn_engine::analysis::{Control, Snapshot, Stepped, Stop};
use linkdyn_model::error::Complaint;
use linkdyn_output::Event;

use crate::error::Error;
use crate::handles::Column;
use crate::mechanism::{Mechanism, unknown};

/// The motion of a [`Mechanism`] at an instant, which the program steps on: by a controller, beside another simulation, or as
/// long as it wants.
///
/// ```text
/// M a + Jᵀ λ = Q + F        F (n): forces from outside, by default zero
/// ```
///
/// The coordinates q are x and y of the centre of mass \[m\] and the angle \[rad\] of each body; F holds per body a force at its centre of
/// mass \[N\] and a torque \[N·m\]. A force f at a point that stands (dx, dy) from the centre of mass has the torque dx f_y − dy f_x.
///
/// # Examples
/// A brake of a pendulum, whose torque changes a hundred times a second:
/// ```
/// use linkdyn::prelude::*;
///
/// let mechanism = Mechanism::bundled("pendulum")?;
/// let mut pendulum = mechanism.simulation()?;
/// let angle = pendulum.coordinate("rod.angle")?;
/// while pendulum.time() < 1.0 {
///     let rate = pendulum.velocity()[angle];
///     pendulum.set_force(angle, -0.5 * rate);
///     pendulum.step_to(pendulum.time() + 0.01)?;
/// }
/// # Ok::<(), linkdyn::Error>(())
/// ```
pub struct Simulation {
    mechanism: Mechanism,
    stepped: Stepped,
    coordinates: Vec<String>,
    /// F (n), where it is held.
    force: Vec<f64>,
}

/// A point to which a [`Simulation`] can go back; what it needs for that is kept as long as there is a copy of it.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    snapshot: Snapshot,
    force: Vec<f64>,
}

impl Mechanism {
    /// The motion that the model's `dynamics` describes, at t = 0, to be stepped by the program. The model's `end` is
    /// ignored.
    ///
    /// # Errors
    /// [`Error::Model`] where the model's analysis is not `dynamics`, lacks what it needs, or drivers prescribe the whole motion;
    /// [`Error::Early`] where it can't start.
    pub fn simulation(&self) -> Result<Simulation, Error> {
        self.steered_simulation(&[])
    }

    /// The same with drivers whose acceleration the program sets ([`Simulation::set_acceleration`]); until then each follows its motion.
    ///
    /// # Errors
    /// As [`Mechanism::simulation`]; [`Error::Unknown`] where there is no such driver.
    pub fn steered_simulation(&self, drivers: &[&str]) -> Result<Simulation, Error> {
        let known = &self.model().drivers;
        let index = |name: &&str| {
            let found = known.get_index_of(*name);
            found.ok_or_else(|| unknown("driver", name, known.keys().map(String::as_str)))
        };
        let steered: Vec<usize> = drivers.iter().map(index).collect::<Result<_, _>>()?;
        let stepped = self.prepared()?.begin(&steered);
        let stepped = stepped.map_err(|stop| self.stopped(stop))?;
        let coordinates = stepped.system().coordinates();
        Ok(Simulation {
            mechanism: self.clone(),
            force: vec![0.0; coordinates.len()],
            coordinates,
            stepped,
        })
    }

    fn stopped(&self, stop: Stop) -> Error {
        match stop {
            Stop::Input(complaints) => self.place(complaints.into()),
            Stop::Failed { status, message } => Error::Early { status, message },
        }
    }
}

/// Where it is.
impl Simulation {
    /// The instant \[s\].
    pub fn time(&self) -> f64 {
        self.stepped.time()
    }

    /// Names of the coordinates (n): `body.x`, `body.y` of the centre of mass, `body.angle`.
    pub fn coordinates(&self) -> &[String] {
        &self.coordinates
    }

    /// The number of a coordinate.
    ///
    /// # Errors
    /// [`Error::Unknown`] where there is none of that name.
    pub fn coordinate(&self, name: &str) -> Result<usize, Error> {
        let known = || self.coordinates.iter().map(String::as_str);
        let found = known().position(|known| known == name);
        found.ok_or_else(|| unknown("coordinate", name, known()))
    }

    /// Coordinates q (n) \[m, rad\].
    pub fn position(&self) -> &[f64] {
        self.stepped.position()
    }

    /// Their rates v (n) [m/s, rad/s].
    pub fn velocity(&self) -> &[f64] {
        self.stepped.velocity()
    }

    /// The value of a result column, such as `joint.b.fx`; NaN where it does not exist. Accelerations and reactions are those under
    /// the forces that acted until now.
    ///
    /// # Panics
    /// Where the handle is one of a mechanism with other columns.
    pub fn value(&self, column: Column) -> f64 {
        assert_eq!(
            column.table,
            self.mechanism.table(),
            "the column is one of a mechanism with other columns"
        );
        self.row()[column.id.index()]
    }

    /// The values of all result columns, in the order of [`Mechanism::columns`].
    pub fn row(&self) -> &[f64] {
        self.stepped.row()
    }

    /// The mechanism that moves.
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }
}

/// Forces from outside.
impl Simulation {
    /// Sets F of one coordinate [N or N·m]: constant from now on, until it is set again. It ends a law.
    pub fn set_force(&mut self, coordinate: usize, force: f64) {
        self.force[coordinate] = force;
        self.stepped.hold(&self.force);
    }

    /// Sets all of F (n) \[N, N·m\]: constant from now on, until it is set again. It ends a law.
    ///
    /// # Panics
    /// Where it does not have one number per coordinate.
    pub fn set_forces(&mut self, force: &[f64]) {
        self.force.copy_from_slice(force);
        self.stepped.hold(force);
    }

    /// F is a function of the time \[s\], position and velocity (n) from now on; its last argument is F, which is zero before. It is asked
    /// at every evaluation of the equations, within steps, too, and so must be a smooth function without memory.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let mut pendulum = Mechanism::bundled("pendulum")?.simulation()?;
    /// let angle = pendulum.coordinate("rod.angle")?;
    /// pendulum.set_law(move |_time, _q, v, force| force[angle] = -0.5 * v[angle]);
    /// pendulum.step_to(1.0)?;
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn set_law(
        &mut self,
        law: impl Fn(f64, &[f64], &[f64], &mut [f64]) + Send + Sync + 'static,
    ) {
        self.force.fill(0.0);
        self.stepped.follow(Arc::new(law));
    }
}

/// Inputs of the model, and drivers.
impl Simulation {
    /// Names of the model's inputs.
    pub fn inputs(&self) -> impl Iterator<Item = &str> {
        self.stepped.inputs()
    }

    /// The value of an input, in SI.
    ///
    /// # Errors
    /// [`Error::Unknown`] where there is none of that name.
    pub fn input(&self, name: &str) -> Result<f64, Error> {
        Ok(self.stepped.input(self.input_index(name)?))
    }

    /// Sets an input, in SI: constant from now on, until it is set again.
    ///
    /// # Errors
    /// [`Error::Unknown`] where there is none of that name, [`Error::Model`] where the value is not finite.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let mechanism: Mechanism = r#"{ "format": "linkdyn/1", "units": "SI",
    ///   "bodies": { "rotor": { "mass": 1, "inertia": 2, "com": [0, 0], "points": { "O": [0, 0] } }, "ground": { "points": { "O": [0, 0] } } },
    ///   "joints": { "pin": { "type": "revolute", "between": ["ground.O", "rotor.O"] } },
    ///   "inputs": { "torque": "0 N*m" },
    ///   "forces": { "motor": { "type": "torque", "body": "rotor", "value": "=input.torque" } },
    ///   "analysis": { "type": "dynamics", "end": 1, "outputs": 2 } }"#.parse()?;
    /// let mut rotor = mechanism.simulation()?;
    /// rotor.step_to(1.0)?;
    /// rotor.set_input("torque", 6.0)?;
    /// rotor.step_to(2.0)?;
    /// assert!((rotor.velocity()[2] - 3.0).abs() < 1e-12);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn set_input(&mut self, name: &str, value: f64) -> Result<(), Error> {
        let input = self.input_index(name)?;
        self.finite(&format!("inputs.{name}"), value)?;
        self.stepped.set_input(input, value);
        Ok(())
    }

    /// Sets the acceleration of a driver [rad/s² or m/s²]: it goes on from its present value and rate, with this acceleration from now on.
    ///
    /// # Errors
    /// [`Error::Unknown`] where there is no such driver; [`Error::Model`] where the simulation was not begun with it steered
    /// ([`Mechanism::steered_simulation`]), or the value is not finite.
    pub fn set_acceleration(&mut self, driver: &str, acceleration: f64) -> Result<(), Error> {
        let known = &self.mechanism.model().drivers;
        let index = known.get_index_of(driver);
        let index =
            index.ok_or_else(|| unknown("driver", driver, known.keys().map(String::as_str)))?;
        self.finite(&format!("drivers.{driver}"), acceleration)?;
        let set = self.stepped.set_acceleration(index, acceleration);
        set.map_err(|stop| self.mechanism.stopped(stop))
    }

    fn input_index(&self, name: &str) -> Result<usize, Error> {
        let found = self.inputs().position(|known| known == name);
        found.ok_or_else(|| unknown("input", name, self.inputs()))
    }

    fn finite(&self, path: &str, value: f64) -> Result<(), Error> {
        if value.is_finite() {
            return Ok(());
        }
        let complaint = Complaint::new(path, format!("{value} is not a finite number"));
        Err(self.mechanism.stopped(complaint.into()))
    }
}

/// Steps.
impl Simulation {
    /// Steps to a later instant \[s\], which is met exactly, with as many steps of the integrator as the tolerances ask for. Tells what
    /// happened on the way: an impact with its approach speed and impulse, a touch when it is over, changes between stick and slip.
    ///
    /// # Errors
    /// [`Error::Early`] where the motion can't go on; it stays where its last step ended. [`Error::Model`] where the instant has passed.
    pub fn step_to(&mut self, time: f64) -> Result<Vec<Event>, Error> {
        self.step_under(time, false, &Control::default())
    }

    /// The same, but stops at the first event: [`Simulation::time`] is when it happened. Tells nothing where it came to `time`.
    ///
    /// # Errors
    /// As [`Simulation::step_to`].
    pub fn step_to_event(&mut self, time: f64) -> Result<Vec<Event>, Error> {
        self.step_under(time, true, &Control::default())
    }

    /// The same under outside control: a deadline, an interrupt; with events to stop at or not.
    ///
    /// # Errors
    /// As [`Simulation::step_to`]; [`Error::Early`] where it was stopped.
    pub fn step_under(
        &mut self,
        time: f64,
        stops_at_events: bool,
        control: &Control,
    ) -> Result<Vec<Event>, Error> {
        let stepped = self.stepped.step_to(time, stops_at_events, control);
        stepped.map_err(|stop| self.mechanism.stopped(stop))
    }

    /// Keeps the motion as it is, with the forces that act.
    pub fn checkpoint(&mut self) -> Checkpoint {
        Checkpoint {
            snapshot: self.stepped.snapshot(),
            force: self.force.clone(),
        }
    }

    /// Goes back to where it was. The same steps lead to the same values from there, bit by bit.
    ///
    /// # Errors
    /// [`Error::Model`] where the checkpoint is one of another simulation.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let mut pendulum = Mechanism::bundled("pendulum")?.simulation()?;
    /// pendulum.step_to(0.3)?;
    /// let checkpoint = pendulum.checkpoint();
    /// pendulum.step_to(0.7)?;
    /// let there = pendulum.position().to_vec();
    /// pendulum.restore(&checkpoint)?;
    /// pendulum.step_to(0.7)?;
    /// assert_eq!(pendulum.position(), there);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), Error> {
        let restored = self.stepped.restore(&checkpoint.snapshot);
        restored.map_err(|stop| self.mechanism.stopped(stop))?;
        self.force.clone_from(&checkpoint.force);
        Ok(())
    }
}
