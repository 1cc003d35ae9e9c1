//! Measures: `"grip": { "distance": ["left.tip", "right.tip"] }`, lengths and angles among the results, of points that no spring or
//! joint need connect.

use serde::{Deserialize, Serialize};

use crate::point::PointRef;

/// A length or an angle of points of the mechanism, with its rate.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(from = "MeasurementWords", into = "MeasurementWords")]
pub enum Measurement {
    /// From one point to the other \[m\].
    Distance([PointRef; 2]),
    /// From the direction of the first two points, of one body, to that of the last two, of another \[rad\].
    Angle(Vec<PointRef>),
    /// Of the first point from the line through the other two, of one body, positive on the left of their direction \[m\].
    DistanceToLine(Vec<PointRef>),
}

impl Measurement {
    /// Whether it is an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self, Measurement::Angle(_))
    }

    /// Its key in a file.
    pub fn key(&self) -> &'static str {
        match self {
            Measurement::Distance(_) => "distance",
            Measurement::Angle(_) => "angle",
            Measurement::DistanceToLine(_) => "distance_to_line",
        }
    }
}

/// A measure as a file has it: with one of the keys, or it is refused.
#[derive(Clone, Default, Deserialize, Serialize)]
#[serde(default)]
struct MeasurementWords {
    distance: Option<[PointRef; 2]>,
    angle: Option<Vec<PointRef>>,
    distance_to_line: Option<Vec<PointRef>>,
}

impl From<MeasurementWords> for Measurement {
    fn from(words: MeasurementWords) -> Self {
        match (words.distance, words.angle, words.distance_to_line) {
            (Some(points), ..) => Measurement::Distance(points),
            (None, Some(points), _) => Measurement::Angle(points),
            (None, None, Some(points)) => Measurement::DistanceToLine(points),
            (None, None, None) => Measurement::Distance([PointRef::default(), PointRef::default()]),
        }
    }
}

impl From<Measurement> for MeasurementWords {
    fn from(measure: Measurement) -> Self {
        let mut words = MeasurementWords::default();
        match measure {
            Measurement::Distance(points) => words.distance = Some(points),
            Measurement::Angle(points) => words.angle = Some(points),
            Measurement::DistanceToLine(points) => words.distance_to_line = Some(points),
        }
        words
    }
}
