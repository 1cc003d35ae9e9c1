//! Springs, torsion springs, forces and torques.

use serde::{Deserialize, Serialize};

use super::dimension::Dimension;
use super::formula::Formula;
use super::motion::Motion;
use super::point::PointRef;

/// A value that may vary with time.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A value that does not vary.
    Constant(f64),
    /// A law of time.
    Motion(Motion),
    /// A function of what moves; `free_length` and `free_angle` are none.
    Formula(Formula),
}

impl Default for Value {
    fn default() -> Self {
        Value::Constant(0.0)
    }
}

fn one() -> f64 {
    1.0
}

/// Frame of a force vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Frame {
    /// The vector keeps its direction in space.
    #[default]
    Ground,
    /// The vector turns with the body.
    Body,
}

/// A force element.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Force {
    /// What acts.
    #[serde(flatten)]
    pub kind: ForceKind,
    /// Where the stroke of a spring or an actuator ends.
    #[serde(flatten)]
    pub stroke: Stroke,
}

/// The ends of the stroke of a spring or an actuator: nothing where it has none.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
pub struct Stroke {
    /// Least and greatest length \[m\]; `None` if the stroke has no end.
    pub limits: Option<[Option<f64>; 2]>,
    /// Coefficient of restitution of rigid stops, 0 to 1 [–]; left out: 0.
    pub restitution: Option<f64>,
    /// Stiffness of stops that yield [N/m]; left out: they are rigid.
    pub stop_stiffness: Option<f64>,
    /// Damping of the same [N·s/m]; left out: none.
    pub stop_damping: Option<f64>,
}

/// What acts.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ForceKind {
    /// Along the line of two points: stiffness [N/m], damping [N·s/m], free length \[m\].
    Spring {
        /// Two points, `body.point`.
        between: [PointRef; 2],
        /// [N/m]; may be left out where `damping` is given.
        #[serde(default)]
        stiffness: f64,
        /// [N·s/m]
        #[serde(default)]
        damping: f64,
        /// \[m\]
        #[serde(default)]
        free_length: Value,
    },
    /// Along the line of two points: a force that pushes them apart \[N\].
    Actuator {
        /// Two points, `body.point`.
        between: [PointRef; 2],
        /// \[N\]
        force: Value,
    },
    /// A gas spring, which pushes two points apart.
    GasSpring {
        /// Two points, `body.point`.
        between: [PointRef; 2],
        /// At full extension \[N\].
        force: f64,
        /// Distance of its points at full extension \[m\].
        extended: f64,
        /// How far it is compressed at most \[m\].
        stroke: f64,
        /// Force at full compression by that at full extension [–].
        #[serde(default = "one")]
        progression: f64,
        /// n of pVⁿ = constant [–].
        #[serde(default = "one")]
        exponent: f64,
        /// [N·s/m]
        #[serde(default)]
        damping: f64,
    },
    /// A hydraulic or pneumatic cylinder, or that of an engine.
    Cylinder {
        /// Of the cylinder and of the rod, `body.point`.
        between: [PointRef; 2],
        /// Diameter of the piston \[m\].
        bore: f64,
        /// Diameter of the rod \[m\].
        #[serde(default)]
        rod: f64,
        /// On the full face of the piston \[Pa\].
        pressure: Value,
        /// On its other face, around the rod \[Pa\].
        #[serde(default)]
        rod_pressure: Value,
    },
    /// A direct-current motor with a gear.
    DcMotor {
        /// The body that it turns.
        body: String,
        /// The body that it stands on.
        relative_to: Option<String>,
        /// At its terminals \[V\].
        voltage: Value,
        /// [N·m/A]
        torque_constant: f64,
        /// \[Ω\]
        resistance: f64,
        /// \[H\]; 0: the current follows at once.
        #[serde(default)]
        inductance: f64,
        /// Turns of its shaft for one turn of the body [–].
        #[serde(default = "one")]
        gear: f64,
    },
    /// Over points: a tension k(L − L₀) + c L̇ of its whole length, zero where that is negative \[N\].
    Cable {
        /// Points in their order, `body.point`, two at least.
        through: Vec<PointRef>,
        /// [N/m]
        stiffness: f64,
        /// [N·s/m]
        #[serde(default)]
        damping: f64,
        /// \[m\]
        free_length: Value,
    },
    /// Between two bodies: torque on the first k(θ₂ − θ₁ − θ₀) + c(ω₂ − ω₁), the opposite on the second.
    TorsionSpring {
        /// Two bodies.
        between: [String; 2],
        /// [N·m/rad]; may be left out where `damping` is given.
        #[serde(default)]
        stiffness: f64,
        /// [N·m·s/rad]
        #[serde(default)]
        damping: f64,
        /// \[rad\]
        #[serde(default)]
        free_angle: Value,
    },
    /// A force at a point, vector in the ground's or the body's frame \[N\].
    #[serde(rename = "force")]
    Load {
        /// The point, `body.point`.
        at: PointRef,
        /// \[N\]
        vector: [Value; 2],
        /// Whose frame the vector is in.
        #[serde(default)]
        frame: Frame,
    },
    /// A torque [N·m] on a body; `relative_to` takes the opposite.
    Torque {
        /// The body.
        body: String,
        /// [N·m]
        value: Value,
        /// The body that takes the opposite.
        relative_to: Option<String>,
    },
}

impl Force {
    /// Least and greatest length \[m\], where its stroke has ends.
    pub fn limits(&self) -> Option<[Option<f64>; 2]> {
        match self.kind {
            ForceKind::GasSpring {
                extended, stroke, ..
            } => Some([Some(extended - stroke), Some(extended)]),
            _ => self.stroke.limits,
        }
    }
}

impl ForceKind {
    /// Its values that may vary, each with its key in a file and the dimension of a formula there; `None` if there can be none.
    pub fn values(&self) -> Vec<(String, &Value, Option<Dimension>)> {
        let one = |key: &str, value, of| vec![(key.to_owned(), value, of)];
        match self {
            ForceKind::Spring { free_length, .. } | ForceKind::Cable { free_length, .. } => {
                one("free_length", free_length, None)
            }
            ForceKind::TorsionSpring { free_angle, .. } => one("free_angle", free_angle, None),
            ForceKind::Load { vector, .. } => {
                let parts = vector.iter().enumerate();
                let key = |index| format!("vector[{index}]");
                let parts = parts.map(|(index, part)| (key(index), part, Some(Dimension::Force)));
                parts.collect()
            }
            ForceKind::Torque { value, .. } => one("value", value, Some(Dimension::Torque)),
            ForceKind::Actuator { force, .. } => one("force", force, Some(Dimension::Force)),
            ForceKind::GasSpring { .. } => Vec::new(),
            ForceKind::Cylinder {
                pressure,
                rod_pressure,
                ..
            } => {
                let parts = [("pressure", pressure), ("rod_pressure", rod_pressure)];
                let parts = parts.into_iter();
                parts
                    .flat_map(|(key, value)| one(key, value, Some(Dimension::Stress)))
                    .collect()
            }
            ForceKind::DcMotor { voltage, .. } => one("voltage", voltage, Some(Dimension::Voltage)),
        }
    }

    /// The points that it acts along the line of; none of what has no length.
    pub fn ends(&self) -> Option<&[PointRef; 2]> {
        match self {
            ForceKind::Spring { between, .. }
            | ForceKind::Actuator { between, .. }
            | ForceKind::GasSpring { between, .. }
            | ForceKind::Cylinder { between, .. } => Some(between),
            ForceKind::Cable { .. }
            | ForceKind::TorsionSpring { .. }
            | ForceKind::Load { .. }
            | ForceKind::Torque { .. }
            | ForceKind::DcMotor { .. } => None,
        }
    }
}
