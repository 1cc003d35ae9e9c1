//! Names of columns, written and read back.
//!
//! ```text
//! time                    energy.kinetic          transmission.ratio
//! crank.x                 shaking.fx              transmission.b.angle
//! crank.A.x               joint.b.fx              driver.motor.effort     force.spring.length
//! output.leverage         joint.guide.slide       measure.grip            measure.grip.rate
//! section.rod.stress      section.rod.axial_force_1
//! ```
//!
//! Names of owners have no dot, and no quantity of a body or a point is one of what else begins with the same word: the body
//! `energy` has `energy.x`, and no output is called like a quantity of a body. So each name is that of one channel.

use super::{
    BodyQuantity, Channel, DriverQuantity, EnergyQuantity, JointQuantity, LoadQuantity,
    PointQuantity, RelativeQuantity, SectionQuantity, ShakingQuantity, StateQuantity,
    TransmissionQuantity,
};
use crate::TIME;

impl Channel {
    /// The name of the column, `joint.b.fx`; `owner` is the name of its owner, which energy and shaking do not have.
    pub fn name(self, owner: &str) -> String {
        match self {
            Channel::Time => TIME.into(),
            Channel::Body(_, quantity) => format!("{owner}.{}", quantity.name()),
            Channel::Point(_, quantity) => format!("{owner}.{}", quantity.name()),
            Channel::Joint(_, quantity) => format!("joint.{owner}.{}", quantity.name()),
            Channel::Relative(_, quantity) => format!("joint.{owner}.{}", quantity.name()),
            Channel::Driver(_, quantity) => format!("driver.{owner}.{}", quantity.name()),
            Channel::Energy(quantity) => format!("energy.{}", quantity.name()),
            Channel::Load(_, quantity) => format!("force.{owner}.{}", quantity.name()),
            Channel::Shaking(quantity) => format!("shaking.{}", quantity.name()),
            Channel::Transmission(TransmissionQuantity::Angle(_)) => {
                format!("transmission.{owner}.angle")
            }
            Channel::Transmission(quantity) => format!("transmission.{}", quantity.name()),
            Channel::Output(_) => format!("{OUTPUT}.{owner}"),
            Channel::State(_, StateQuantity::Value) => format!("{STATE}.{owner}"),
            Channel::State(_, StateQuantity::Rate) => format!("{STATE}.{owner}.rate"),
            Channel::Measure(_, StateQuantity::Value) => format!("{MEASURE}.{owner}"),
            Channel::Measure(_, StateQuantity::Rate) => format!("{MEASURE}.{owner}.rate"),
            Channel::Section(_, quantity) => format!("{SECTION}.{owner}.{}", quantity.name()),
        }
    }

    /// The channel that a column's name stands for, of the first owner, and the name of its owner; none of other names.
    pub fn read(name: &str) -> Option<(Channel, &str)> {
        if name == TIME {
            return Some((Channel::Time, ""));
        }
        let (owner, word) = name.rsplit_once('.')?;
        match owner.split_once('.') {
            None => match (of_all(owner, word), find(&BodyQuantity::ALL, word)) {
                (Some(channel), _) => Some((channel, "")),
                (None, Some(quantity)) => Some((Channel::Body(0, quantity), owner)),
                (None, None) if owner == OUTPUT && !word.is_empty() => {
                    Some((Channel::Output(0), word))
                }
                (None, None) if owner == STATE && !word.is_empty() => {
                    Some((Channel::State(0, StateQuantity::Value), word))
                }
                (None, None) if owner == MEASURE && !word.is_empty() => {
                    Some((Channel::Measure(0, StateQuantity::Value), word))
                }
                (None, None) => None,
            },
            Some((_, rest)) if rest.contains('.') => None,
            Some((kind, own)) => match of_one(kind, word) {
                Some(channel) => Some((channel, own)),
                None => Some((Channel::Point(0, find(&PointQuantity::ALL, word)?), owner)),
            },
        }
    }

    /// The same quantity of the owner with this number; that itself where there is no owner.
    pub fn with_owner(self, number: usize) -> Channel {
        match self {
            Channel::Body(_, quantity) => Channel::Body(number, quantity),
            Channel::Point(_, quantity) => Channel::Point(number, quantity),
            Channel::Joint(_, quantity) => Channel::Joint(number, quantity),
            Channel::Relative(_, quantity) => Channel::Relative(number, quantity),
            Channel::Output(_) => Channel::Output(number),
            Channel::State(_, quantity) => Channel::State(number, quantity),
            Channel::Measure(_, quantity) => Channel::Measure(number, quantity),
            Channel::Section(_, quantity) => Channel::Section(number, quantity),
            Channel::Driver(_, quantity) => Channel::Driver(number, quantity),
            Channel::Load(_, quantity) => Channel::Load(number, quantity),
            Channel::Transmission(TransmissionQuantity::Angle(_)) => {
                Channel::Transmission(TransmissionQuantity::Angle(number))
            }
            Channel::Time
            | Channel::Energy(_)
            | Channel::Shaking(_)
            | Channel::Transmission(
                TransmissionQuantity::Ratio | TransmissionQuantity::Advantage,
            ) => self,
        }
    }
}

/// The first word of the names of outputs, of states, of measures, and of cross-sections.
const OUTPUT: &str = "output";
const STATE: &str = "state";
const MEASURE: &str = "measure";
const SECTION: &str = "section";

/// Channels of the whole mechanism, by the first word and the quantity.
fn of_all(kind: &str, word: &str) -> Option<Channel> {
    match kind {
        "energy" => find(&EnergyQuantity::ALL, word).map(Channel::Energy),
        "shaking" => find(&ShakingQuantity::ALL, word).map(Channel::Shaking),
        "transmission" => find(&TransmissionQuantity::OF_ALL, word).map(Channel::Transmission),
        _ => None,
    }
}

/// Channels of one owner, by the first word and the quantity.
fn of_one(kind: &str, word: &str) -> Option<Channel> {
    match kind {
        "joint" => match find(&JointQuantity::ALL, word) {
            Some(quantity) => Some(Channel::Joint(0, quantity)),
            None => Some(Channel::Relative(0, find(&RelativeQuantity::ALL, word)?)),
        },
        "driver" => Some(Channel::Driver(0, find(&DriverQuantity::ALL, word)?)),
        STATE => (word == "rate").then_some(Channel::State(0, StateQuantity::Rate)),
        MEASURE => (word == "rate").then_some(Channel::Measure(0, StateQuantity::Rate)),
        "force" => Some(Channel::Load(0, find(&LoadQuantity::ALL, word)?)),
        SECTION => Some(Channel::Section(0, SectionQuantity::read(word)?)),
        "transmission" => find(&[TransmissionQuantity::Angle(0)], word).map(Channel::Transmission),
        _ => None,
    }
}

/// A quantity, as the last word of a name says it.
trait Quantity: Copy {
    fn word(self) -> &'static str;
}

fn find<Q: Quantity>(all: &[Q], word: &str) -> Option<Q> {
    all.iter().copied().find(|quantity| quantity.word() == word)
}

impl BodyQuantity {
    /// Every one.
    const ALL: [BodyQuantity; 9] = [
        BodyQuantity::X,
        BodyQuantity::Y,
        BodyQuantity::Angle,
        BodyQuantity::Vx,
        BodyQuantity::Vy,
        BodyQuantity::Omega,
        BodyQuantity::Ax,
        BodyQuantity::Ay,
        BodyQuantity::Alpha,
    ];

    /// The last word of the column's name.
    pub fn name(self) -> &'static str {
        match self {
            BodyQuantity::X => "x",
            BodyQuantity::Y => "y",
            BodyQuantity::Angle => "angle",
            BodyQuantity::Vx => "vx",
            BodyQuantity::Vy => "vy",
            BodyQuantity::Omega => "omega",
            BodyQuantity::Ax => "ax",
            BodyQuantity::Ay => "ay",
            BodyQuantity::Alpha => "alpha",
        }
    }
}

impl Quantity for BodyQuantity {
    fn word(self) -> &'static str {
        self.name()
    }
}

impl PointQuantity {
    /// Every one.
    const ALL: [PointQuantity; 6] = [
        PointQuantity::X,
        PointQuantity::Y,
        PointQuantity::Vx,
        PointQuantity::Vy,
        PointQuantity::Ax,
        PointQuantity::Ay,
    ];

    /// The last word of the column's name.
    pub fn name(self) -> &'static str {
        self.of_body().name()
    }
}

impl Quantity for PointQuantity {
    fn word(self) -> &'static str {
        self.name()
    }
}

impl JointQuantity {
    /// Every one.
    const ALL: [JointQuantity; 19] = [
        JointQuantity::Fx,
        JointQuantity::Fy,
        JointQuantity::Torque,
        JointQuantity::Friction,
        JointQuantity::Ex,
        JointQuantity::Ey,
        JointQuantity::Eccentricity,
        JointQuantity::Penetration,
        JointQuantity::NormalForce,
        JointQuantity::TangentialForce,
        JointQuantity::SlidingSpeed,
        JointQuantity::State,
        JointQuantity::Stop,
        JointQuantity::ContactX,
        JointQuantity::ContactY,
        JointQuantity::Curvature,
        JointQuantity::PressureAngle,
        JointQuantity::Tight,
        JointQuantity::Slack,
    ];

    /// The last word of the column's name.
    pub fn name(self) -> &'static str {
        match self {
            JointQuantity::Fx => "fx",
            JointQuantity::Fy => "fy",
            JointQuantity::Torque => "torque",
            JointQuantity::Friction => "friction",
            JointQuantity::Ex => "ex",
            JointQuantity::Ey => "ey",
            JointQuantity::Eccentricity => "eccentricity",
            JointQuantity::Penetration => "penetration",
            JointQuantity::NormalForce => "normal_force",
            JointQuantity::TangentialForce => "tangential_force",
            JointQuantity::SlidingSpeed => "sliding_speed",
            JointQuantity::State => "state",
            JointQuantity::Stop => "stop",
            JointQuantity::ContactX => "contact_x",
            JointQuantity::ContactY => "contact_y",
            JointQuantity::Curvature => "curvature",
            JointQuantity::PressureAngle => "pressure_angle",
            JointQuantity::Tight => "tight",
            JointQuantity::Slack => "slack",
        }
    }
}

impl Quantity for JointQuantity {
    fn word(self) -> &'static str {
        self.name()
    }
}

impl DriverQuantity {
    /// Every one.
    const ALL: [DriverQuantity; 2] = [DriverQuantity::Value, DriverQuantity::Effort];

    /// The last word of the column's name.
    pub fn name(self) -> &'static str {
        match self {
            DriverQuantity::Value => "value",
            DriverQuantity::Effort => "effort",
        }
    }
}

impl Quantity for DriverQuantity {
    fn word(self) -> &'static str {
        self.name()
    }
}

impl EnergyQuantity {
    /// Every one.
    const ALL: [EnergyQuantity; 4] = [
        EnergyQuantity::Kinetic,
        EnergyQuantity::Potential,
        EnergyQuantity::Contact,
        EnergyQuantity::Dissipated,
    ];

    /// The last word of the column's name.
    pub fn name(self) -> &'static str {
        match self {
            EnergyQuantity::Kinetic => "kinetic",
            EnergyQuantity::Potential => "potential",
            EnergyQuantity::Contact => "contact",
            EnergyQuantity::Dissipated => "dissipated",
        }
    }
}

impl Quantity for EnergyQuantity {
    fn word(self) -> &'static str {
        self.name()
    }
}

impl LoadQuantity {
    /// Every one, in the order of results.
    pub const ALL: [LoadQuantity; 11] = {
        use LoadQuantity::{Angle, Current, F, Fx, Fy, Length, Omega, Power, Rate, Stop, Torque};
        [
            Length, Rate, Angle, Omega, F, Fx, Fy, Torque, Power, Stop, Current,
        ]
    };

    /// The last word of the column's name.
    pub fn name(self) -> &'static str {
        match self {
            LoadQuantity::Fx => "fx",
            LoadQuantity::Fy => "fy",
            LoadQuantity::Torque => "torque",
            LoadQuantity::Length => "length",
            LoadQuantity::Rate => "rate",
            LoadQuantity::F => "f",
            LoadQuantity::Angle => "angle",
            LoadQuantity::Omega => "omega",
            LoadQuantity::Power => "power",
            LoadQuantity::Stop => "stop",
            LoadQuantity::Current => "current",
        }
    }
}

impl Quantity for LoadQuantity {
    fn word(self) -> &'static str {
        self.name()
    }
}

impl RelativeQuantity {
    /// Every one, in the order of results.
    pub const ALL: [RelativeQuantity; 5] = [
        RelativeQuantity::Angle,
        RelativeQuantity::Omega,
        RelativeQuantity::Slide,
        RelativeQuantity::Rate,
        RelativeQuantity::F,
    ];

    /// The last word of the column's name.
    pub fn name(self) -> &'static str {
        match self {
            RelativeQuantity::Angle => "angle",
            RelativeQuantity::Omega => "omega",
            RelativeQuantity::Slide => "slide",
            RelativeQuantity::Rate => "rate",
            RelativeQuantity::F => "f",
        }
    }
}

impl Quantity for RelativeQuantity {
    fn word(self) -> &'static str {
        self.name()
    }
}

impl ShakingQuantity {
    /// Every one.
    const ALL: [ShakingQuantity; 3] = [
        ShakingQuantity::Fx,
        ShakingQuantity::Fy,
        ShakingQuantity::Moment,
    ];

    /// The last word of the column's name.
    pub fn name(self) -> &'static str {
        match self {
            ShakingQuantity::Fx => "fx",
            ShakingQuantity::Fy => "fy",
            ShakingQuantity::Moment => "moment",
        }
    }
}

impl Quantity for ShakingQuantity {
    fn word(self) -> &'static str {
        self.name()
    }
}

impl SectionQuantity {
    /// Every one of a whole axis, in the order of results.
    pub const PEAKS: [SectionQuantity; 7] = [
        SectionQuantity::Tension,
        SectionQuantity::Compression,
        SectionQuantity::Shear,
        SectionQuantity::Bending,
        SectionQuantity::Stress,
        SectionQuantity::StressAt,
        SectionQuantity::Buckling,
    ];

    /// Those of a station, in the order of results.
    pub const fn of_station(station: usize) -> [SectionQuantity; 3] {
        [
            SectionQuantity::AxialForce(station),
            SectionQuantity::ShearForce(station),
            SectionQuantity::BendingMoment(station),
        ]
    }

    /// The last word of the column's name, which counts stations from 1.
    pub fn name(self) -> String {
        match self {
            SectionQuantity::AxialForce(station)
            | SectionQuantity::ShearForce(station)
            | SectionQuantity::BendingMoment(station) => {
                format!("{}_{}", self.kind(), station + 1)
            }
            SectionQuantity::Tension
            | SectionQuantity::Compression
            | SectionQuantity::Shear
            | SectionQuantity::Bending
            | SectionQuantity::Stress
            | SectionQuantity::StressAt
            | SectionQuantity::Buckling => self.kind().to_owned(),
        }
    }

    /// The same without the station.
    pub fn kind(self) -> &'static str {
        match self {
            SectionQuantity::AxialForce(_) => "axial_force",
            SectionQuantity::ShearForce(_) | SectionQuantity::Shear => "shear_force",
            SectionQuantity::BendingMoment(_) | SectionQuantity::Bending => "bending_moment",
            SectionQuantity::Tension => "tension",
            SectionQuantity::Compression => "compression",
            SectionQuantity::Stress => "stress",
            SectionQuantity::StressAt => "stress_at",
            SectionQuantity::Buckling => "buckling",
        }
    }

    /// The quantity of a word.
    fn read(word: &str) -> Option<SectionQuantity> {
        let station = || {
            let (kind, count) = word.rsplit_once('_')?;
            let station = count.parse::<usize>().ok()?.checked_sub(1)?;
            find(&SectionQuantity::of_station(station), kind)
        };
        // as written, without signs and zeros in front
        let station = || station().filter(|found| found.name() == word);
        find(&SectionQuantity::PEAKS, word).or_else(station)
    }
}

impl Quantity for SectionQuantity {
    fn word(self) -> &'static str {
        self.kind()
    }
}

impl TransmissionQuantity {
    /// Every one that has no owner.
    const OF_ALL: [TransmissionQuantity; 2] =
        [TransmissionQuantity::Ratio, TransmissionQuantity::Advantage];

    /// The last word of the column's name.
    pub fn name(self) -> &'static str {
        match self {
            TransmissionQuantity::Ratio => "ratio",
            TransmissionQuantity::Advantage => "advantage",
            TransmissionQuantity::Angle(_) => "angle",
        }
    }
}

impl Quantity for TransmissionQuantity {
    fn word(self) -> &'static str {
        self.name()
    }
}

#[cfg(test)]
mod tests;
