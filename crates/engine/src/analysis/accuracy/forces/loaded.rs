//! A mechanism whose sources are off, and what it carries then: the answer of statics, or of inverse dynamics.

use super::{Making, Posed};
use crate::analysis::accuracy::source::Play;
use crate::analysis::clearance_link::forces;
use crate::analysis::readings::JointReading;
use crate::analysis::sample::Sample;
use crate::element::Measure;
use crate::mechanism::driven::Driven;
use crate::system::{Inputs, System};
use linkdyn_output::{DriverQuantity, JointQuantity};
use std::collections::HashMap;
use std::sync::Arc;

/// Newton's contraction up to which a position belongs to its start (Kantorovich: ½ of its constant).
const SAFE_CONTRACTION: f64 = 0.25;
/// A pin or guide whose force is below this part of the largest has no side that it presses.
const UNLOADED: f64 = 1e-8;
/// Most steps to the time at which a driver has a value.
const MOST_STEPS: usize = 40;
/// Systems that are kept.
const MOST_SYSTEMS: usize = 2000;

/// A force that is asked about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::analysis::accuracy) struct Force {
    pub owner: Owner,
    /// `N` or `N*m`.
    pub unit: &'static str,
}

/// Whose force it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::analysis::accuracy) enum Owner {
    /// Effort of a driver.
    Driver(usize, DriverQuantity),
    /// What a joint exerts on its second body.
    Joint(usize, JointQuantity),
}

/// By how much each source is off: a zone by both coordinates in the frame of its body, all others by the first number.
pub(super) type Offs = Vec<[f64; 2]>;

/// What a mechanism carries at a pose.
#[derive(Debug, Clone)]
pub(super) struct Carried {
    /// Of the forces that are asked about there.
    pub values: Vec<f64>,
    /// Coordinates (n).
    pub q: Vec<f64>,
    /// The gaps that a unit of clearance makes in the first rows of each source: where the load presses it.
    pub sides: Vec<[f64; 2]>,
    /// Largest force \[N\].
    pub largest: f64,
}

/// Why nothing is carried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Without {
    /// No position, or a singular one.
    Position,
    /// A joint locks itself by this friction.
    Locked(usize),
}

/// Systems with parameters and zones off.
pub(super) struct Systems<'f> {
    pub nominal: Arc<System>,
    pub plays: &'f [Play],
    making: &'f Making<'f>,
    made: HashMap<Vec<u64>, Option<Arc<System>>>,
}

impl<'f> Systems<'f> {
    pub fn new(nominal: &System, plays: &'f [Play], making: &'f Making<'f>) -> Self {
        Systems {
            nominal: Arc::new(nominal.clone()),
            plays,
            making,
            made: HashMap::new(),
        }
    }

    /// The system with its parameters and zones off; none where that is no legal model.
    pub fn with(&mut self, offs: &[[f64; 2]]) -> Option<Arc<System>> {
        let (mut parameters, mut zones) = (Vec::new(), Vec::new());
        for (play, off) in self.plays.iter().zip(offs) {
            match play {
                Play::Parameter { .. } => parameters.push(off[0]),
                Play::Zone { .. } => zones.push(*off),
                Play::Pin { .. }
                | Play::Sides { .. }
                | Play::Guided { .. }
                | Play::Driver { .. } => {}
            }
        }
        let all = parameters.iter().chain(zones.as_flattened());
        if all.clone().all(|off| *off == 0.0) {
            return Some(Arc::clone(&self.nominal));
        }
        let key: Vec<u64> = all.map(|off| off.to_bits()).collect();
        if self.made.len() > MOST_SYSTEMS {
            self.made.clear();
        }
        let making = self.making;
        let entry = self.made.entry(key);
        entry
            .or_insert_with(|| making(&parameters, &zones).map(Arc::new))
            .clone()
    }
}

/// Coordinates of another system with the frames of its bodies where those of this are.
pub(super) fn carried_over(from: &System, to: &System, q: &[f64]) -> Vec<f64> {
    let mut moved = q.to_vec();
    let bodies = from.bodies.iter().zip(&to.bodies);
    for ((own, other), columns) in bodies.zip(from.layout.bodies()) {
        let [.., theta] = columns.read(q);
        let (sin, cos) = theta.sin_cos();
        let off = own.origin - other.origin;
        moved[columns.x()] += cos * off.x - sin * off.y;
        moved[columns.y()] += sin * off.x + cos * off.y;
    }
    moved
}

/// Where each source is pressed by what the rows carry: the gaps of a unit of its clearance.
fn sides(system: &System, plays: &[Play], lambda: &[f64]) -> (Vec<[f64; 2]>, f64) {
    let force = |row: usize| match system.measures[row] {
        Measure::Length => lambda[row].abs(),
        Measure::Angle => lambda[row].abs() / system.size,
    };
    let largest = (0..lambda.len()).map(force).fold(0.0, f64::max);
    let side = |play: &Play| {
        let (row, most, rows) = match play {
            Play::Pin { row, clearance } => (*row, clearance[1], 2),
            Play::Guided { row, half, .. } => (*row, half[1], 2),
            Play::Sides { row, half } => (*row, half[1], 1),
            Play::Driver { .. } | Play::Zone { .. } | Play::Parameter { .. } => return [0.0; 2],
        };
        let own = (row..row + rows).map(force).fold(0.0, f64::max);
        if own <= UNLOADED * largest {
            return [0.0; 2];
        }
        let second = if rows == 2 { lambda[row + 1] } else { 0.0 };
        // The journal presses the bearing against the force that it feels.
        play.extreme([lambda[row], second], -1.0)
            .map(|gap| gap / most)
    };
    (plays.iter().map(side).collect(), largest)
}

/// The gaps (m) of sources that are off.
fn gaps(plays: &[Play], offs: &[[f64; 2]], sides: &[[f64; 2]], rows: &mut [f64]) {
    rows.fill(0.0);
    for ((play, off), side) in plays.iter().zip(offs).zip(sides) {
        match play {
            Play::Pin { row, .. } | Play::Guided { row, .. } => {
                rows[*row] += off[0] * side[0];
                rows[row + 1] += off[0] * side[1];
            }
            Play::Sides { row, .. } => rows[*row] += off[0] * side[0],
            Play::Driver { row, .. } => rows[*row] += off[0],
            Play::Zone { .. } | Play::Parameter { .. } => {}
        }
    }
}

/// A system at work: where its positions and forces are found.
pub(super) struct Loaded<'s> {
    system: &'s System,
    nominal: &'s System,
    plays: &'s [Play],
    driven: Driven<'s>,
    sample: Sample,
    at_rest: bool,
}

impl<'s> Loaded<'s> {
    /// None where its equations have no solution near the pose.
    pub fn new(
        [nominal, system]: [&'s System; 2],
        plays: &'s [Play],
        posed: &Posed,
        at_rest: bool,
    ) -> Option<Self> {
        let q = carried_over(nominal, system, &posed.stand.q);
        Some(Loaded {
            system,
            nominal,
            plays,
            driven: Driven::new(system, &q, &posed.stand.inputs).ok()?,
            sample: Sample::new(system),
            at_rest,
        })
    }

    /// Drivers and time at a pose.
    fn inputs(&self, posed: &Posed) -> Inputs {
        let mut inputs = posed.stand.inputs.clone();
        let laws = self.system.drivers.iter().zip(&self.nominal.drivers);
        if !laws.clone().all(|(own, nominal)| own.law == nominal.law) {
            let held = posed.exact.map(|(driver, value)| {
                let law = &self.system.drivers[driver].law;
                (driver, value, passage(law, value, inputs.time))
            });
            inputs.set_time(self.system, held.map_or(inputs.time, |(.., time)| time));
            if let Some((driver, value, _)) = held {
                inputs.drive[driver][0] = value;
            }
        }
        if self.at_rest {
            let drive = inputs.drive.iter_mut();
            drive.for_each(|jet| *jet = [jet[0], 0.0, 0.0]);
        }
        inputs
    }

    /// What it carries at a pose, from coordinates near it (those of the pose where there are none), with sources off and
    /// gaps to the sides given.
    ///
    /// # Errors
    /// [`Without`].
    pub fn carry(
        &mut self,
        posed: &Posed,
        from: Option<&[f64]>,
        offs: &[[f64; 2]],
        held: &[[f64; 2]],
    ) -> Result<Carried, Without> {
        let mut inputs = self.inputs(posed);
        inputs.gaps = vec![0.0; self.system.m()];
        gaps(self.plays, offs, held, &mut inputs.gaps);
        let q = match from {
            Some(from) => from.to_vec(),
            None => carried_over(self.nominal, self.system, &posed.stand.q),
        };
        self.sample.q = q;
        let corrected = self.driven.correct(&mut self.sample.q, &inputs);
        if !corrected.is_ok_and(|found| found.contraction <= SAFE_CONTRACTION) {
            return Err(Without::Position);
        }
        self.balance(&inputs)?;
        if !self.sample.lambda.iter().all(|l| l.is_finite()) {
            return Err(Without::Position);
        }
        let (sides, largest) = sides(self.system, self.plays, &self.sample.lambda);
        let forces = posed.forces.iter();
        Ok(Carried {
            values: forces.map(|force| self.read(force, &inputs)).collect(),
            q: self.sample.q.clone(),
            sides,
            largest,
        })
    }

    /// Forces at the position of the sample.
    fn balance(&mut self, inputs: &Inputs) -> Result<(), Without> {
        let driven = &mut self.driven;
        if !self.at_rest {
            let found = forces(driven, inputs, &mut self.sample);
            let locked = driven.dependent_forces.locked();
            return found.map_err(|_| locked.map_or(Without::Position, Without::Locked));
        }
        // At rest there is no friction, as in statics.
        driven.factor(inputs).map_err(|_| Without::Position)?;
        driven.evaluation.set_velocity(&self.sample.v);
        let force = &mut self.sample.force;
        driven.evaluation.eval_force(self.system, inputs, force);
        driven.multipliers(force, &mut self.sample.lambda);
        Ok(())
    }

    fn read(&self, force: &Force, inputs: &Inputs) -> f64 {
        match force.owner {
            Owner::Driver(driver, DriverQuantity::Effort) => {
                self.sample.lambda[self.system.joint_rows() + driver]
            }
            Owner::Driver(driver, DriverQuantity::Value) => inputs.drive[driver][0],
            Owner::Joint(joint, quantity) => {
                let at = self.driven.evaluation.kinematics(inputs);
                JointReading::new(self.system, &at, inputs, joint, &self.sample).value(quantity)
            }
        }
    }
}

/// The time near `time` at which a law has a value, where it passes it.
fn passage(law: &crate::motion::Law, value: f64, time: f64) -> f64 {
    let mut at = time;
    for _ in 0..MOST_STEPS {
        let [now, rate, _] = law.jet(at);
        let step = (value - now) / rate;
        if !step.is_finite() {
            return time;
        }
        at += step;
        if step.abs() <= 4.0 * f64::EPSILON * at.abs() {
            return at;
        }
    }
    // At a turning point it is as near as it gets.
    if (law.jet(at)[0] - value).abs() <= 1e-9 * value.abs().max(1.0) {
        at
    } else {
        time
    }
}
