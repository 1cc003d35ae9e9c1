//! Accuracy: which outputs matter, and what is assumed of the pins.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use super::dimension::Dimension;
use super::{DriverKind, Model, PointRef};

/// What is asked of the mechanism's accuracy.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Accuracy {
    /// Outputs by their names.
    pub outputs: IndexMap<String, AccuracyOutput>,
    /// Where pins are within their clearances.
    pub pins: Pins,
    /// How much is worked out.
    pub levels: Levels,
}

/// How much is worked out; each level has those before it, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Levels {
    /// First order, contributions, spread and lost motion.
    First,
    /// And the worst found.
    Worst,
    /// And the certified bound.
    #[default]
    Certified,
}

/// Where pins are within their clearances.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Pins {
    /// Each where it moves the output most.
    #[default]
    Worst,
    /// On the side to which the load presses them.
    Load,
    /// On the rim, in any direction.
    Rim,
    /// Anywhere in the clearance.
    Disc,
    /// In the middle: clearances are ignored.
    None,
}

/// An output whose accuracy matters.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(from = "OutputWords", into = "OutputWords")]
pub struct AccuracyOutput {
    /// What it is.
    pub of: Measured,
    /// Where; left out: over the whole stroke.
    pub at: Option<At>,
    /// Lower and upper deviation from the nominal value that are allowed, in SI.
    pub limits: Option<[f64; 2]>,
}

/// What an output is.
#[derive(Debug, Clone, PartialEq)]
pub enum Measured {
    /// The quantity of a result column, by its name without unit.
    Column(String),
    /// The distance of two points.
    Distance([PointRef; 2]),
}

impl Measured {
    /// Its dimension; none of a column that no model can have.
    pub fn dimension(&self, model: &Model) -> Option<Dimension> {
        let effort = |driver: &str| match model.drivers.get(driver)?.kind {
            DriverKind::Rotation { .. } => Some(Dimension::Torque),
            DriverKind::Translation { .. }
            | DriverKind::Length { .. }
            | DriverKind::Point { .. } => Some(Dimension::Force),
        };
        match self {
            Measured::Column(column) => Column::read(column)?.dimension(effort),
            Measured::Distance(_) => Some(Dimension::Length),
        }
    }
}

/// A position of the mechanism.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct At {
    /// Name of the driver; may be left out where there is only one.
    pub driver: Option<String>,
    /// Value of the driver \[rad or m\].
    pub value: f64,
}

/// An output as a file has it.
#[derive(Clone, Deserialize, Serialize)]
struct OutputWords {
    column: Option<String>,
    distance: Option<[PointRef; 2]>,
    at: Option<At>,
    limits: Option<[f64; 2]>,
}

impl From<OutputWords> for AccuracyOutput {
    fn from(words: OutputWords) -> Self {
        // a file has just one of both, or is refused
        let of = match (words.column, words.distance) {
            (None, Some(points)) => Measured::Distance(points),
            (column, _) => Measured::Column(column.unwrap_or_default()),
        };
        AccuracyOutput {
            of,
            at: words.at,
            limits: words.limits,
        }
    }
}

impl From<AccuracyOutput> for OutputWords {
    fn from(output: AccuracyOutput) -> Self {
        let (column, distance) = match output.of {
            Measured::Column(column) => (Some(column), None),
            Measured::Distance(points) => (None, Some(points)),
        };
        OutputWords {
            column,
            distance,
            at: output.at,
            limits: output.limits,
        }
    }
}

/// A column whose accuracy can be asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Column<'c> {
    /// A coordinate of a body's frame, or its angle.
    Body(&'c str, Dimension),
    /// A coordinate of a point.
    Point {
        /// The body.
        body: &'c str,
        /// The point.
        point: &'c str,
    },
    /// A reaction.
    Joint(&'c str, Dimension),
    /// What a driver exerts.
    Driver(&'c str),
    /// How far the points of a spring or an actuator are apart.
    Length(&'c str),
}

impl<'c> Column<'c> {
    /// Reads the name of a column without unit; none of columns whose accuracy nobody can ask for.
    pub fn read(name: &'c str) -> Option<Column<'c>> {
        let parts: Vec<&str> = name.split('.').collect();
        match parts.as_slice() {
            [body, "x" | "y"] => Some(Column::Body(body, Dimension::Length)),
            [body, "angle"] => Some(Column::Body(body, Dimension::Angle)),
            ["joint", joint, "fx" | "fy"] => Some(Column::Joint(joint, Dimension::Force)),
            ["joint", joint, "torque"] => Some(Column::Joint(joint, Dimension::Torque)),
            ["driver", driver, "effort"] => Some(Column::Driver(driver)),
            ["force", force, "length"] => Some(Column::Length(force)),
            [body, point, "x" | "y"] => Some(Column::Point { body, point }),
            _ => None,
        }
    }

    /// What it is a measure of; `effort` says it of what a driver exerts.
    pub fn dimension(self, effort: impl Fn(&str) -> Option<Dimension>) -> Option<Dimension> {
        match self {
            Column::Body(_, dimension) | Column::Joint(_, dimension) => Some(dimension),
            Column::Point { .. } | Column::Length(_) => Some(Dimension::Length),
            Column::Driver(driver) => effort(driver),
        }
    }
}
