//! The one table of result columns of a system and an analysis: headings, rows and gaps come from it.
//!
//! A channel says whose quantity a column is. [`Channels::new`] lists those of a system in the order of results, and from that
//! list come the headings, and stretches of channels with one owner. For a row each stretch reads its owner once
//! (`readings`) and writes the quantities that it lists.

use super::readings::{BodyReading, JointReading, PointReading, energy, stroke, strokes};
use super::sample::Sample;
use super::section::{self, Actions, SectionReading};
use crate::element::Measure;
use crate::system::{BodyPart, Evaluation, Inputs, JointData, System};
use linkdyn_output::{
    BodyQuantity, Channel, Column, DriverQuantity, EnergyQuantity, JointQuantity, LoadQuantity,
    PointQuantity, SectionQuantity, StateQuantity,
};
use std::sync::Arc;

/// What an analysis computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contents {
    /// Rates of positions.
    pub velocities: bool,
    /// Rates of velocities.
    pub accelerations: bool,
    /// Forces in joints and efforts of drivers.
    pub reactions: bool,
    /// Friction of joints, which is none at rest.
    pub friction: bool,
}

/// The result columns of a system and an analysis.
#[derive(Debug, Clone)]
pub struct Channels {
    columns: Arc<[Column]>,
    stretches: Vec<ColumnGroup>,
}

/// The larger of each two.
pub fn larger([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a.max(c), b.max(d)]
}

/// Neighbouring columns of one owner.
#[derive(Debug, Clone)]
enum ColumnGroup {
    Time,
    Body(usize, Vec<BodyQuantity>),
    Point(usize, Vec<PointQuantity>),
    Joint(usize, Vec<JointQuantity>),
    Driver(usize, Vec<DriverQuantity>),
    /// Of the stops of a force.
    Stroke(usize),
    State(usize, Vec<StateQuantity>),
    Measure(usize, Vec<StateQuantity>),
    Energy(Vec<EnergyQuantity>),
    /// Of a body.
    Section(usize, Vec<SectionQuantity>),
}

const POSES: [BodyQuantity; 3] = [BodyQuantity::X, BodyQuantity::Y, BodyQuantity::Angle];
const TWISTS: [BodyQuantity; 3] = [BodyQuantity::Vx, BodyQuantity::Vy, BodyQuantity::Omega];
const CHANGES: [BodyQuantity; 3] = [BodyQuantity::Ax, BodyQuantity::Ay, BodyQuantity::Alpha];
const PLACES: [PointQuantity; 2] = [PointQuantity::X, PointQuantity::Y];
const VELOCITIES: [PointQuantity; 2] = [PointQuantity::Vx, PointQuantity::Vy];
const ACCELERATIONS: [PointQuantity; 2] = [PointQuantity::Ax, PointQuantity::Ay];
const FORCES: [JointQuantity; 2] = [JointQuantity::Fx, JointQuantity::Fy];
const ECCENTRICITIES: [JointQuantity; 2] = [JointQuantity::Ex, JointQuantity::Ey];
const TENSIONS: [JointQuantity; 2] = [JointQuantity::Tight, JointQuantity::Slack];
const CONTACT: [JointQuantity; 6] = [
    JointQuantity::Eccentricity,
    JointQuantity::Penetration,
    JointQuantity::NormalForce,
    JointQuantity::TangentialForce,
    JointQuantity::SlidingSpeed,
    JointQuantity::State,
];

const TOUCH: [JointQuantity; 3] = [
    JointQuantity::ContactX,
    JointQuantity::ContactY,
    JointQuantity::Curvature,
];

impl Channels {
    /// All columns of a system, in the order of results; nothing is computed for them.
    pub fn new(system: &System, contents: Contents) -> Self {
        Channels::of(contents.columns(system))
    }

    /// Some of these columns, in the same order.
    pub fn of(columns: Vec<Column>) -> Self {
        let mut stretches: Vec<ColumnGroup> = Vec::new();
        for channel in columns.iter().filter_map(|column| column.channel) {
            let goes_on = stretches.last_mut().is_some_and(|last| last.take(channel));
            if !goes_on {
                stretches.extend(ColumnGroup::begin(channel));
            }
        }
        Channels {
            columns: columns.into(),
            stretches,
        }
    }

    /// Headings: name, unit and channel of each column.
    pub fn columns(&self) -> &Arc<[Column]> {
        &self.columns
    }

    /// Whether a position is all that they need.
    pub fn are_positions(&self) -> bool {
        self.stretches.iter().all(|stretch| match stretch {
            ColumnGroup::Time => true,
            ColumnGroup::Body(_, wanted) => wanted.iter().all(|one| POSES.contains(one)),
            ColumnGroup::Point(_, wanted) => wanted.iter().all(|one| PLACES.contains(one)),
            ColumnGroup::Driver(_, wanted) => {
                wanted.iter().all(|one| *one == DriverQuantity::Value)
            }
            ColumnGroup::Measure(_, wanted) => !wanted.contains(&StateQuantity::Rate),
            ColumnGroup::Joint(..)
            | ColumnGroup::Stroke(_)
            | ColumnGroup::State(..)
            | ColumnGroup::Section(..)
            | ColumnGroup::Energy(_) => false,
        })
    }

    /// Whether they need what joints and drivers carry.
    pub fn have_forces(&self) -> bool {
        self.stretches.iter().any(|stretch| match stretch {
            ColumnGroup::Joint(..) | ColumnGroup::Stroke(_) | ColumnGroup::Section(..) => true,
            ColumnGroup::Driver(_, wanted) => wanted.contains(&DriverQuantity::Effort),
            ColumnGroup::Time
            | ColumnGroup::Body(..)
            | ColumnGroup::Point(..)
            | ColumnGroup::State(..)
            | ColumnGroup::Measure(..)
            | ColumnGroup::Energy(_) => false,
        })
    }

    /// Appends the row of a sample, at whose position and velocity the evaluation is; forces that are left over on links with a
    /// cross-section, and the size of all on them \[N\].
    pub fn push_row(
        &self,
        system: &System,
        evaluation: &Evaluation,
        inputs: &Inputs,
        sample: &Sample,
        row: &mut Vec<f64>,
    ) -> [f64; 2] {
        let at = evaluation.kinematics(inputs);
        let mut actions = None;
        let mut unbalanced = [0.0; 2];
        for stretch in &self.stretches {
            match stretch {
                ColumnGroup::Time => row.push(inputs.time),
                ColumnGroup::Body(body, wanted) => {
                    let reading = BodyReading::new(system, &at, *body, sample);
                    row.extend(wanted.iter().map(|&quantity| reading.value(quantity)));
                }
                ColumnGroup::Point(point, wanted) => {
                    let reading = PointReading::new(system, &at, *point, sample);
                    row.extend(wanted.iter().map(|&quantity| reading.value(quantity)));
                }
                ColumnGroup::Joint(joint, wanted) => {
                    let reading = JointReading::new(system, &at, inputs, *joint, sample);
                    row.extend(wanted.iter().map(|&quantity| reading.value(quantity)));
                }
                ColumnGroup::Driver(driver, wanted) => {
                    row.extend(wanted.iter().map(|quantity| match quantity {
                        DriverQuantity::Value => inputs.drive[*driver][0],
                        DriverQuantity::Effort => sample.lambda[system.joint_rows() + driver],
                    }));
                }
                ColumnGroup::Stroke(force) => row.push(stroke(system, *force, sample)),
                ColumnGroup::State(state, wanted) => {
                    row.extend(wanted.iter().map(|quantity| match quantity {
                        StateQuantity::Value => inputs.states[system.inputs.len() + *state],
                        StateQuantity::Rate => system.states[*state].rate.value(&at),
                    }));
                }
                ColumnGroup::Measure(measure, wanted) => {
                    let [value, rate] = system.measured[*measure].measured.value(&at);
                    row.extend(wanted.iter().map(|quantity| match quantity {
                        StateQuantity::Value => value,
                        StateQuantity::Rate => rate,
                    }));
                }
                ColumnGroup::Energy(wanted) => row.extend(
                    wanted
                        .iter()
                        .map(|&quantity| energy(system, evaluation, inputs, sample, quantity)),
                ),
                ColumnGroup::Section(body, wanted) => {
                    let Some(data) = system.sections.get(body) else {
                        continue;
                    };
                    let actions = actions
                        .get_or_insert_with(|| Actions::new(system, evaluation, inputs, sample));
                    let of = (*body, sample.a.as_slice());
                    let reading = SectionReading::new((system, data), &at, of, actions);
                    row.extend(wanted.iter().map(|&quantity| reading.value(quantity)));
                    unbalanced = larger(unbalanced, reading.unbalanced());
                }
            }
        }
        unbalanced
    }

    /// Appends a row at an instant without solution: time and driver values only.
    pub fn push_gap(&self, inputs: &Inputs, row: &mut Vec<f64>) {
        row.extend(self.columns.iter().map(|column| match column.channel {
            Some(Channel::Time) => inputs.time,
            Some(Channel::Driver(driver, DriverQuantity::Value)) => inputs.drive[driver][0],
            Some(
                Channel::Driver(_, DriverQuantity::Effort)
                | Channel::Body(..)
                | Channel::Point(..)
                | Channel::Joint(..)
                | Channel::Energy(_)
                | Channel::Load(..)
                | Channel::Shaking(_)
                | Channel::Transmission(_)
                | Channel::Relative(..)
                | Channel::State(..)
                | Channel::Measure(..)
                | Channel::Section(..)
                | Channel::Output(_),
            )
            | None => f64::NAN,
        }));
    }
}

impl ColumnGroup {
    /// The stretch that begins with a channel; `None` if it is not computed with the rows.
    fn begin(channel: Channel) -> Option<ColumnGroup> {
        match channel {
            Channel::Time => Some(ColumnGroup::Time),
            Channel::Body(body, quantity) => Some(ColumnGroup::Body(body, vec![quantity])),
            Channel::Point(point, quantity) => Some(ColumnGroup::Point(point, vec![quantity])),
            Channel::Joint(joint, quantity) => Some(ColumnGroup::Joint(joint, vec![quantity])),
            Channel::Driver(driver, quantity) => Some(ColumnGroup::Driver(driver, vec![quantity])),
            Channel::State(state, quantity) => Some(ColumnGroup::State(state, vec![quantity])),
            Channel::Measure(measure, quantity) => {
                Some(ColumnGroup::Measure(measure, vec![quantity]))
            }
            Channel::Energy(quantity) => Some(ColumnGroup::Energy(vec![quantity])),
            Channel::Load(force, LoadQuantity::Stop) => Some(ColumnGroup::Stroke(force)),
            Channel::Section(body, quantity) => Some(ColumnGroup::Section(body, vec![quantity])),
            Channel::Relative(..)
            | Channel::Load(..)
            | Channel::Shaking(_)
            | Channel::Transmission(_)
            | Channel::Output(_) => None,
        }
    }

    /// Takes the next channel where it has the same owner.
    fn take(&mut self, channel: Channel) -> bool {
        match (self, channel) {
            (ColumnGroup::Body(own, wanted), Channel::Body(body, quantity)) if *own == body => {
                wanted.push(quantity);
                true
            }
            (ColumnGroup::Point(own, wanted), Channel::Point(point, quantity)) if *own == point => {
                wanted.push(quantity);
                true
            }
            (ColumnGroup::Joint(own, wanted), Channel::Joint(joint, quantity)) if *own == joint => {
                wanted.push(quantity);
                true
            }
            (ColumnGroup::Driver(own, wanted), Channel::Driver(driver, quantity))
                if *own == driver =>
            {
                wanted.push(quantity);
                true
            }
            (ColumnGroup::State(own, wanted), Channel::State(state, quantity)) if *own == state => {
                wanted.push(quantity);
                true
            }
            (ColumnGroup::Measure(own, wanted), Channel::Measure(measure, quantity))
                if *own == measure =>
            {
                wanted.push(quantity);
                true
            }
            (ColumnGroup::Section(own, wanted), Channel::Section(body, quantity))
                if *own == body =>
            {
                wanted.push(quantity);
                true
            }
            (ColumnGroup::Energy(wanted), Channel::Energy(quantity)) => {
                wanted.push(quantity);
                true
            }
            _ => false,
        }
    }
}

impl Contents {
    /// Motions with forces and a joint with clearance, by whatever model, or with stops.
    fn has_contact_energy(self, system: &System) -> bool {
        self.reactions
            && self.velocities
            && (system.has_strokes() || system.joints.iter().any(JointData::touches))
    }

    /// Headings in the order of results.
    pub fn columns(self, system: &System) -> Vec<Column> {
        let mut columns = vec![Column::of(Channel::Time, "", "s")];
        for (body, data) in system.bodies.iter().enumerate() {
            match data.part() {
                BodyPart::Own | BodyPart::Node(_) | BodyPart::Section => {
                    columns.extend(self.of_body().map(|quantity| {
                        Column::of(Channel::Body(body, quantity), &data.name, quantity.unit())
                    }))
                }
                BodyPart::Amplitudes { first, count } => {
                    columns.extend(self.of_amplitudes(body, data.link(), first, count));
                }
                // These follow from the frame and the amplitudes.
                BodyPart::MassPoint => {}
            }
        }
        for (point, data) in system.points.iter().enumerate() {
            columns.extend(self.of_point().map(|quantity| {
                Column::of(Channel::Point(point, quantity), &data.name, quantity.unit())
            }));
        }
        let joints = system.joints.iter().enumerate();
        for (joint, data) in joints.filter(|(_, data)| data.is_own()) {
            columns.extend(self.of_joint(data).map(|quantity| {
                let unit = joint_unit(quantity, data);
                Column::of(Channel::Joint(joint, quantity), &data.name, unit)
            }));
        }
        for (driver, data) in system.drivers.iter().enumerate() {
            columns.extend(self.of_driver().map(|quantity| {
                let unit = driver_unit(quantity, data.measure);
                Column::of(Channel::Driver(driver, quantity), &data.name, unit)
            }));
        }
        columns.extend(strokes(system).filter(|_| self.reactions));
        let states = system.states.iter().filter(|_| self.velocities);
        for (state, data) in states.enumerate() {
            let units = [(StateQuantity::Value, 0), (StateQuantity::Rate, 1)];
            columns.extend(units.map(|(quantity, order)| {
                Column::of(
                    Channel::State(state, quantity),
                    &data.name,
                    data.units[order],
                )
            }));
        }
        for (measure, data) in system.measured.iter().enumerate() {
            let [unit, of_rate] = data.units();
            let rate = self.velocities.then_some((StateQuantity::Rate, of_rate));
            let own = [(StateQuantity::Value, unit)].into_iter().chain(rate);
            columns.extend(own.map(|(quantity, unit)| {
                Column::of(Channel::Measure(measure, quantity), &data.name, unit)
            }));
        }
        columns.extend(
            self.of_energy(system)
                .map(|quantity| Column::of(Channel::Energy(quantity), "", "J")),
        );
        columns.extend(section::headings(system).filter(|_| self.reactions));
        columns
    }

    fn of_body(self) -> impl Iterator<Item = BodyQuantity> {
        let rates = TWISTS.into_iter().filter(move |_| self.velocities);
        let changes = CHANGES.into_iter().filter(move |_| self.accelerations);
        POSES.into_iter().chain(rates).chain(changes)
    }

    /// Amplitudes of an elastic link, with rates and accelerations: `rod.q1`, `rod.q1_rate`, `rod.q1_acceleration`.
    fn of_amplitudes(self, body: usize, link: &str, first: usize, count: usize) -> Vec<Column> {
        let orders = [
            [BodyQuantity::X, BodyQuantity::Vx, BodyQuantity::Ax],
            [BodyQuantity::Y, BodyQuantity::Vy, BodyQuantity::Ay],
        ];
        let wanted = [true, self.velocities, self.accelerations];
        let of = |k: usize| {
            let orders = orders[k].into_iter().zip(["", "_rate", "_acceleration"]);
            let orders = orders.zip(wanted).filter(|(_, wanted)| *wanted);
            orders.map(move |((quantity, order), _)| Column {
                name: format!("{link}.q{}{order}", first + k + 1),
                owner: link.to_owned(),
                unit: quantity.unit(),
                channel: Some(Channel::Body(body, quantity)),
            })
        };
        (0..count).flat_map(of).collect()
    }

    fn of_point(self) -> impl Iterator<Item = PointQuantity> {
        let rates = VELOCITIES.into_iter().filter(move |_| self.velocities);
        let changes = ACCELERATIONS
            .into_iter()
            .filter(move |_| self.accelerations);
        PLACES.into_iter().chain(rates).chain(changes)
    }

    fn of_joint(self, joint: &JointData) -> impl Iterator<Item = JointQuantity> {
        let forces = FORCES.into_iter().filter(move |_| self.reactions);
        let torque = (self.reactions && joint.torque()).then_some(JointQuantity::Torque);
        let has_friction = self.friction && joint.extras().friction.is_some();
        let friction = has_friction.then_some(JointQuantity::Friction);
        let has_bearing = joint.extras().bearing.is_some();
        let contact_wanted = (has_bearing || joint.is_contact()) && self.reactions;
        let stop = (self.reactions && joint.has_stops()).then_some(JointQuantity::Stop);
        let closed =
            (self.reactions && joint.extras().clasp.is_some()).then_some(JointQuantity::State);
        let cam = joint.extras().cam.as_deref();
        let pushes = (self.reactions && cam.is_some()).then_some(JointQuantity::NormalForce);
        let way = cam.is_some_and(|cam| cam.way.is_some());
        let way = way.then_some(JointQuantity::PressureAngle);
        let touch = TOUCH.into_iter().filter(move |_| cam.is_some()).chain(way);
        let has_strands = self.reactions && joint.extras().belt.is_some();
        forces
            .chain(torque)
            .chain(friction)
            .chain(ECCENTRICITIES.into_iter().filter(move |_| has_bearing))
            .chain(CONTACT.into_iter().filter(move |quantity| {
                // Where a tip is has no bearing's centre to count from.
                contact_wanted && (has_bearing || *quantity != JointQuantity::Eccentricity)
            }))
            .chain(stop)
            .chain(closed)
            .chain(pushes)
            .chain(touch)
            .chain(TENSIONS.into_iter().filter(move |_| has_strands))
    }

    fn of_driver(self) -> impl Iterator<Item = DriverQuantity> {
        let effort = self.reactions.then_some(DriverQuantity::Effort);
        [DriverQuantity::Value].into_iter().chain(effort)
    }

    fn of_energy(self, system: &System) -> impl Iterator<Item = EnergyQuantity> {
        let known = system.masses_known;
        let in_contact = known && self.has_contact_energy(system);
        let moving = [EnergyQuantity::Kinetic, EnergyQuantity::Potential];
        let contact = [EnergyQuantity::Contact, EnergyQuantity::Dissipated];
        let moving = moving.into_iter().filter(move |_| known);
        moving.chain(contact.into_iter().filter(move |_| in_contact))
    }
}

fn joint_unit(quantity: JointQuantity, joint: &JointData) -> &'static str {
    match quantity {
        JointQuantity::Fx
        | JointQuantity::Fy
        | JointQuantity::NormalForce
        | JointQuantity::TangentialForce
        | JointQuantity::Tight
        | JointQuantity::Slack => "N",
        JointQuantity::Torque => "N*m",
        JointQuantity::Friction => match joint.extras().friction.map(|friction| friction.measure) {
            Some(Measure::Angle) => "N*m",
            Some(Measure::Length) | None => "N",
        },
        JointQuantity::Ex
        | JointQuantity::Ey
        | JointQuantity::Eccentricity
        | JointQuantity::Penetration
        | JointQuantity::ContactX
        | JointQuantity::ContactY => "m",
        JointQuantity::Curvature => "1/m",
        JointQuantity::PressureAngle => "rad",
        JointQuantity::Stop => match joint.role().axis() {
            Some(_) => "N",
            None => "N*m",
        },
        JointQuantity::SlidingSpeed => "m/s",
        JointQuantity::State => "1",
    }
}

fn driver_unit(quantity: DriverQuantity, measure: Measure) -> &'static str {
    match (quantity, measure) {
        (DriverQuantity::Value, Measure::Angle) => "rad",
        (DriverQuantity::Value, Measure::Length) => "m",
        (DriverQuantity::Effort, Measure::Angle) => "N*m",
        (DriverQuantity::Effort, Measure::Length) => "N",
    }
}
