//! Drivers: prescribed coordinates.

use serde::{Deserialize, Serialize};

use crate::motion::Motion;
use crate::point::PointRef;

/// A prescribed coordinate.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Driver {
    /// Which coordinate it prescribes.
    #[serde(flatten)]
    pub kind: DriverKind,
    /// The law of time that the coordinate follows.
    pub motion: Motion,
    /// How far the coordinate may be from what the motion says, to either side \[rad or m\].
    pub tolerance: Option<f64>,
    /// Its part of the work beside other drivers, where these are more than the degrees of freedom \[–\]; left out: 1.
    pub share: Option<f64>,
}

/// Which coordinate is prescribed.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum DriverKind {
    /// Angle of `body`, relative to another body where given (default ground).
    Rotation {
        /// The driven body.
        body: String,
        /// The body from which the angle counts.
        relative_to: Option<String>,
    },
    /// Slide of a prismatic joint or a slot, along its axis, first point to second.
    Translation {
        /// Name of the prismatic joint or slot.
        joint: String,
    },
    /// Distance of two points of two bodies, as a hydraulic cylinder has it.
    Length {
        /// Its ends.
        between: [PointRef; 2],
    },
    /// A coordinate of a point, in the ground's frame.
    Point {
        /// The point.
        point: PointRef,
        /// Its coordinate.
        axis: PointAxis,
    },
}

/// A coordinate of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PointAxis {
    /// Along the ground's x axis.
    X,
    /// Along the ground's y axis.
    Y,
}
