//! Springs, torsion springs, forces and torques.

use schemars::JsonSchema;
use serde::Deserialize;

use super::driver::Motion;
use super::joint::PointRef;
use super::schema;

/// A value that may vary with time.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Value {
    Constant(f64),
    Motion(Motion),
}

impl Default for Value {
    fn default() -> Self {
        Value::Constant(0.0)
    }
}

/// Frame of a force vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Frame {
    /// The vector keeps its direction in space.
    #[default]
    Ground,
    /// The vector turns with the body.
    Body,
}

/// A force element.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
pub struct Force {
    #[serde(flatten)]
    pub kind: ForceKind,
}

/// What acts.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ForceKind {
    /// Along the line of two points: stiffness [N/m], damping [N·s/m], free length \[m\].
    #[schemars(extend("anyOf" = [{"required": ["stiffness"]}, {"required": ["damping"]}]))]
    Spring {
        /// Two points, `body.point`.
        between: [PointRef; 2],
        /// [N/m]; may be left out where `damping` is given.
        #[serde(default)]
        #[schemars(schema_with = "schema::stiffness", extend("minimum" = 0))]
        stiffness: f64,
        /// [N·s/m]
        #[serde(default)]
        #[schemars(schema_with = "schema::damping", extend("minimum" = 0))]
        damping: f64,
        /// \[m\]
        #[serde(default)]
        #[schemars(schema_with = "schema::length_or_motion")]
        free_length: Value,
    },
    /// Between two bodies: torque on the first k(θ₂ − θ₁ − θ₀) + c(ω₂ − ω₁), the opposite on the second.
    #[schemars(extend("anyOf" = [{"required": ["stiffness"]}, {"required": ["damping"]}]))]
    TorsionSpring {
        /// Two bodies.
        #[schemars(schema_with = "schema::body_pair")]
        between: [String; 2],
        /// [N·m/rad]; may be left out where `damping` is given.
        #[serde(default)]
        #[schemars(schema_with = "schema::angular_stiffness", extend("minimum" = 0))]
        stiffness: f64,
        /// [N·m·s/rad]
        #[serde(default)]
        #[schemars(schema_with = "schema::angular_damping", extend("minimum" = 0))]
        damping: f64,
        /// \[rad\]
        #[serde(default)]
        #[schemars(schema_with = "schema::angle_or_motion")]
        free_angle: Value,
    },
    /// A force at a point, vector in the ground's or the body's frame \[N\].
    #[serde(rename = "force")]
    Load {
        /// The point, `body.point`.
        at: PointRef,
        /// \[N\]
        #[schemars(schema_with = "schema::force_or_motion_pair")]
        vector: [Value; 2],
        #[serde(default)]
        frame: Frame,
    },
    /// A torque [N·m] on a body; `relative_to` takes the opposite.
    Torque {
        #[schemars(extend("x-reference" = "body"))]
        body: String,
        /// [N·m]
        #[schemars(schema_with = "schema::torque_or_motion")]
        value: Value,
        /// The body that takes the opposite.
        #[serde(default)]
        #[schemars(with = "String", extend("x-reference" = "body"))]
        relative_to: Option<String>,
    },
}
