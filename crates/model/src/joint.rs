//! Joints between two body points.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::clearance::{Clearance, Friction};
use super::schema;

/// `body.point`, split.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct PointRef {
    pub body: String,
    pub point: String,
}

impl TryFrom<String> for PointRef {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        match text.split_once('.') {
            Some((body, point)) => Ok(PointRef {
                body: body.into(),
                point: point.into(),
            }),
            None => Err(format!("{text:?} is not body.point")),
        }
    }
}

impl fmt::Display for PointRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.body, self.point)
    }
}

impl JsonSchema for PointRef {
    fn schema_name() -> Cow<'static, str> {
        "PointRef".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "string",
            "description": "A point of a body: `body.point`.",
            "pattern": "^[^.]+\\.[^.]+$",
            "x-reference": "point"
        })
    }
}

/// A joint from the first point to the second.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
pub struct Joint {
    /// Two points `body.point`, first → second.
    pub between: [PointRef; 2],
    #[serde(flatten)]
    pub kind: JointKind,
}

/// What the joint lets move.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum JointKind {
    /// The points coincide; with `clearance` the first body holds the bearing, the second the journal.
    Revolute {
        #[serde(default)]
        #[schemars(with = "Clearance")]
        clearance: Option<Box<Clearance>>,
        /// Friction of the ideal joint, from its own reaction; that of a clearance stands in the clearance. Left out: none.
        #[serde(default)]
        #[schemars(with = "Friction")]
        friction: Option<Box<Friction>>,
        /// Radius of the pin \[m\] on which `friction` acts, and which it needs.
        #[serde(default)]
        #[schemars(schema_with = "schema::length", extend("exclusiveMinimum" = 0))]
        pin_radius: Option<f64>,
    },
    /// The second point stays on the line through the first along `axis` (first body's frame, any length but zero); relative angle fixed \[rad\].
    #[schemars(extend("x-refused" = {"clearance": "only a revolute joint can have clearance"}))]
    Prismatic {
        /// A direction fixed in the first body; its length does not matter.
        #[schemars(extend("not" = {"const": [0, 0]}))]
        axis: [f64; 2],
        /// Angle of the second body relative to the first \[rad\].
        #[serde(default)]
        #[schemars(schema_with = "schema::angle")]
        angle: f64,
        /// Friction along the axis, from the joint's own reaction; left out: none.
        #[serde(default)]
        #[schemars(with = "Friction")]
        friction: Option<Box<Friction>>,
        /// Length of the slider on its guide \[m\], centred at the second point: with it the joint's torque presses, too.
        #[serde(default)]
        #[schemars(schema_with = "schema::length", extend("exclusiveMinimum" = 0))]
        guide_length: Option<f64>,
    },
    /// The second point stays on the line through the first along `axis` (first body's frame, any length but zero); the bodies may turn against each other.
    #[schemars(extend("x-refused" = {"clearance": "only a revolute joint can have clearance", "friction": "only revolute and prismatic joints can have friction", "angle": "the angle in a slot is free; a prismatic joint fixes it"}))]
    Slot {
        /// A direction fixed in the first body; its length does not matter.
        #[schemars(extend("not" = {"const": [0, 0]}))]
        axis: [f64; 2],
    },
    /// Two wheels, each held at its point by a revolute joint to a common carrier, mesh: θ₂ − θ_c = ratio·(θ₁ − θ_c) + angle.
    #[schemars(extend("x-refused" = {"clearance": "only a revolute joint can have clearance", "friction": "only revolute and prismatic joints can have friction"}))]
    Gear {
        /// Turns of the second wheel per turn of the first, seen from the carrier: −z₁/z₂ for an external mesh, z₁/z₂ for an internal one.
        #[schemars(extend("not" = {"const": 0}))]
        ratio: f64,
        /// The body on which both wheels turn; left out: found from the joints.
        #[serde(default)]
        #[schemars(with = "String", extend("x-reference" = "body"))]
        carrier: Option<String>,
        /// θ₂ − θ_c − ratio·(θ₁ − θ_c) \[rad\]; left out: as drawn, that of the angles in `pose`.
        #[serde(default)]
        #[schemars(schema_with = "schema::angle")]
        angle: Option<f64>,
    },
    /// The points coincide, relative angle fixed \[rad\].
    #[schemars(extend("x-refused" = {"clearance": "only a revolute joint can have clearance", "friction": "only revolute and prismatic joints can have friction"}))]
    Fixed {
        /// Angle of the second body relative to the first \[rad\].
        #[serde(default)]
        #[schemars(schema_with = "schema::angle")]
        angle: f64,
    },
}
