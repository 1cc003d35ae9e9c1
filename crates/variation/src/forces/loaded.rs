//! A mechanism whose sources are off, and what it carries then: the answer of statics, or of inverse dynamics.

use super::question::{Force, ForceQuestion, Making, Owner, Posed};
use crate::limits::{MOST_PASSES, SAME};
use crate::source::{Acts, Kind, Pair, Source};
use linkdyn_engine::analysis::clearance_link::forces;
use linkdyn_engine::analysis::readings::JointReading;
use linkdyn_engine::analysis::sample::Sample;
use linkdyn_engine::element::Measure;
use linkdyn_engine::mechanism::driven::Driven;
use linkdyn_engine::motion::Law;
use linkdyn_engine::system::{Inputs, System};
use linkdyn_output::DriverQuantity;
use std::collections::HashMap;
use std::sync::Arc;

/// Newton's contraction up to which a position belongs to its start (Kantorovich: ½ of its constant).
const SAFE_CONTRACTION: f64 = 0.25;
/// A pin or guide whose force is below this part of the largest has no side that it presses: it is round-off.
const UNLOADED: f64 = 1e-8;

/// What a mechanism carries at a pose.
#[derive(Debug, Clone)]
pub(super) struct Carried {
    /// Of the forces that are asked about there.
    pub values: Vec<f64>,
    /// Coordinates (n).
    pub q: Vec<f64>,
    /// The gaps that a unit of clearance makes in the first rows of each source: where the load presses it.
    pub sides: Vec<Pair>,
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

/// Systems with parameters and zones off, by the bits of these.
pub(super) struct Systems<'f> {
    pub nominal: Arc<System>,
    pub sources: &'f [Source],
    pub question: &'f ForceQuestion<'f>,
    made: HashMap<Vec<u64>, Option<Arc<System>>>,
}

impl<'f> Systems<'f> {
    pub fn new(nominal: &System, sources: &'f [Source], question: &'f ForceQuestion<'f>) -> Self {
        Systems {
            nominal: Arc::new(nominal.clone()),
            sources,
            question,
            made: HashMap::new(),
        }
    }

    /// The system with its sources off: parameters by their number, zones by both coordinates in the frame of their body; none
    /// where that is no legal model.
    pub fn with(&mut self, e: &[Pair]) -> Option<Arc<System>> {
        let (mut parameters, mut zones) = (Vec::new(), Vec::new());
        for (source, e) in self.sources.iter().zip(e) {
            match source.kind {
                Kind::Parameter(_) => parameters.push(e[0]),
                Kind::Zone => zones.push(*e),
                Kind::Clearance { .. } | Kind::Driver => {}
            }
        }
        let all = parameters.iter().chain(zones.as_flattened());
        if all.clone().all(|off| *off == 0.0) {
            return Some(Arc::clone(&self.nominal));
        }
        let key = all.map(|off| off.to_bits()).collect();
        let making: &Making = self.question.making;
        let made = self.made.entry(key);
        made.or_insert_with(|| making(&parameters, &zones).map(Arc::new))
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

/// A system at work: where its positions and forces are found.
pub(super) struct Loaded<'s> {
    system: &'s System,
    nominal: Arc<System>,
    sources: &'s [Source],
    driven: Driven<'s>,
    sample: Sample,
    at_rest: bool,
}

impl<'s> Loaded<'s> {
    /// `None` if its equations have no solution near the pose.
    pub fn new(systems: &Systems<'s>, system: &'s System, posed: &Posed) -> Option<Self> {
        let q = carried_over(&systems.nominal, system, &posed.stand.q);
        Some(Loaded {
            system,
            nominal: Arc::clone(&systems.nominal),
            sources: systems.sources,
            driven: Driven::new(system, &q, &posed.stand.inputs).ok()?,
            sample: Sample::new(system),
            at_rest: systems.question.at_rest,
        })
    }

    /// Drivers and time at a pose: where its driver's value says which it is, the time is that of the value.
    fn inputs(&self, posed: &Posed) -> Inputs {
        let mut inputs = posed.stand.inputs.clone();
        let laws = self.system.drivers.iter().zip(&self.nominal.drivers);
        if laws.clone().any(|(own, nominal)| own.law != nominal.law) {
            let time = inputs.time;
            let time = posed.exact.map_or(time, |(driver, value)| {
                passage(&self.system.drivers[driver].law, value, time)
            });
            inputs.set_time(self.system, time);
            if let Some((driver, value)) = posed.exact {
                inputs.drive[driver][0] = value;
            }
        }
        if self.at_rest {
            let drive = inputs.drive.iter_mut();
            drive.for_each(|jet| *jet = [jet[0], 0.0, 0.0]);
        }
        inputs
    }

    /// What it carries at a pose, from coordinates near it, with sources off and gaps to the sides given.
    ///
    /// # Errors
    /// [`Without`].
    pub fn carry(
        &mut self,
        posed: &Posed,
        from: &[f64],
        e: &[Pair],
        sides: &[Pair],
    ) -> Result<Carried, Without> {
        let mut inputs = self.inputs(posed);
        inputs.gaps = vec![0.0; self.system.m()];
        for ((source, e), side) in self.sources.iter().zip(e).zip(sides) {
            if let Acts::Row(row) = source.acts {
                let by = match source.kind {
                    Kind::Clearance { .. } => side.map(|side| e[0] * side),
                    Kind::Driver | Kind::Zone | Kind::Parameter(_) => *e,
                };
                let own = inputs.gaps[row..].iter_mut().zip(by);
                own.take(source.room.numbers())
                    .for_each(|(row, by)| *row += by);
            }
        }
        self.sample.q = from.to_vec();
        let corrected = self.driven.correct(&mut self.sample.q, &inputs);
        if !corrected.is_ok_and(|found| found.contraction <= SAFE_CONTRACTION) {
            return Err(Without::Position);
        }
        self.balance(&inputs)?;
        if !self.sample.lambda.iter().all(|l| l.is_finite()) {
            return Err(Without::Position);
        }
        let (sides, largest) = self.sides();
        let forces = posed.forces.iter();
        Ok(Carried {
            values: forces.map(|(_, force)| self.read(force, &inputs)).collect(),
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

    /// Where each clearance is pressed by what the rows carry: the gaps of a unit of it; and the largest force.
    fn sides(&self) -> (Vec<Pair>, f64) {
        let lambda = &self.sample.lambda;
        let force = |row: usize| match self.system.measures[row] {
            Measure::Length => lambda[row].abs(),
            Measure::Angle => lambda[row].abs() / self.system.size,
        };
        let largest = (0..lambda.len()).map(force).fold(0.0, f64::max);
        let side = |source: &Source| {
            let (Acts::Row(row), Some([_, most])) = (&source.acts, source.clearance()) else {
                return [0.0; 2];
            };
            let rows = *row..row + source.room.numbers();
            if rows.clone().map(force).fold(0.0, f64::max) <= UNLOADED * largest {
                return [0.0; 2];
            }
            // The journal presses the bearing against the force that it feels.
            let mut against = [0.0; 2];
            against
                .iter_mut()
                .zip(&lambda[rows])
                .for_each(|(own, l)| *own = -l);
            let gap = source.room.extreme(against).unwrap_or_default();
            gap.map(|gap| gap / most)
        };
        (self.sources.iter().map(side).collect(), largest)
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

/// The time near `time` at which a law has a value, where it passes it; at a turning point it is as near as it gets.
fn passage(law: &Law, value: f64, time: f64) -> f64 {
    let mut at = time;
    for _ in 0..MOST_PASSES {
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
    let is_near = (law.jet(at)[0] - value).abs() <= 10.0 * SAME * value.abs().max(1.0);
    if is_near { at } else { time }
}
