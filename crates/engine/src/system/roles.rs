//! What joints, drivers and forces are, as far as results beside the equations ask: no words, numbers only.

use super::{DriverId, JointId};
use crate::element::formula::Strength;
use crate::element::quantity::Measured;
use crate::element::{Axis, BodyId, Marker, Measure};
use linkdyn_linear::math::Vec2;

/// What a joint is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointRole {
    /// A pin, ideal or with clearance.
    Revolute,
    /// A slide along an axis of the first body.
    Prismatic {
        /// Direction in the first body's frame, length one.
        axis: Vec2,
        /// Angle of the second body in the first \[rad\].
        angle: f64,
    },
    /// A pin in a slot of the first body.
    Slot {
        /// Direction in the first body's frame, length one.
        axis: Vec2,
    },
    /// Two wheels that mesh.
    Gear,
    /// A wheel that rolls on a line of the second body.
    Rack {
        /// Direction of the line in the second body's frame, length one.
        axis: Vec2,
        /// Radius of the wheel \[m\], signed by the side on which the line lies.
        radius: f64,
    },
    /// A pin in rubber.
    Bushing,
    /// An elastic bar.
    Beam,
    /// Two bodies as one.
    Fixed,
    /// What holds the parts of an elastic link together.
    Inner,
    /// A tip that may touch an outline.
    Contact,
    /// Any other kind: its constraint says all that results need.
    Other,
}

/// What only some joints have: one that is not named here has none of it.
impl JointRole {
    /// Direction of the guide in the first body's frame, where there is one.
    pub fn axis(self) -> Option<Vec2> {
        match self {
            JointRole::Prismatic { axis, .. } | JointRole::Slot { axis } => Some(axis),
            _ => None,
        }
    }
}

/// What a driver moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DriverRole {
    /// It turns a body against another.
    Rotation {
        /// The body that is turned.
        body: BodyId,
        /// The body that the angle is measured from.
        relative_to: BodyId,
    },
    /// It moves the second body along the guide of a joint.
    Translation {
        /// The joint with the guide.
        joint: JointId,
    },
    /// It holds two points at a distance.
    Length {
        /// Its ends.
        between: [Marker; 2],
    },
    /// It moves a point of a body along an axis of the ground, or turns the body, as on the way from the drawing to the start.
    Coordinate {
        /// The point.
        origin: Marker,
        /// Its coordinate.
        axis: Axis,
    },
}

/// What a force element is.
#[derive(Debug, Clone)]
pub enum ForceRole {
    /// A spring, damper or actuator between two bodies.
    Spring {
        /// Its two bodies.
        between: [BodyId; 2],
        /// Its length or angle.
        measured: Measured,
        /// Its columns are among the results without being requested.
        is_actuator: bool,
    },
    /// A cable, of which this is the first stretch.
    Cable {
        /// Its two bodies.
        between: [BodyId; 2],
        /// Lengths of all stretches.
        path: Vec<Measured>,
        /// −T \[N\]
        pull: Strength,
    },
    /// Another stretch of a cable.
    Stretch {
        /// Its two points.
        between: [Marker; 2],
    },
    /// A force from outside at a point.
    Load {
        /// The point.
        at: Marker,
        /// Components \[N\].
        vector: [Strength; 2],
        /// The body whose axes the components are in.
        frame: BodyId,
    },
    /// A torque on a body.
    Torque {
        /// [N·m]
        value: Strength,
        /// The body.
        body: BodyId,
        /// The body, and the one that exerts the torque; `None` if it comes from outside.
        between: Option<[BodyId; 2]>,
        /// Of a motor, its torque by the current [N·m/A].
        by_current: Option<f64>,
    },
}

impl ForceRole {
    /// Whether it is a given force or torque.
    pub(crate) fn is_applied(&self) -> bool {
        match self {
            ForceRole::Load { .. } | ForceRole::Torque { .. } => true,
            ForceRole::Spring { .. } | ForceRole::Cable { .. } | ForceRole::Stretch { .. } => false,
        }
    }

    /// Whether it is an actuator.
    pub(crate) fn is_actuator(&self) -> bool {
        match self {
            ForceRole::Spring { is_actuator, .. } => *is_actuator,
            ForceRole::Cable { .. } => true,
            ForceRole::Load { .. } | ForceRole::Torque { .. } | ForceRole::Stretch { .. } => false,
        }
    }

    /// The bodies that exert the force on each other; `None` if it comes from outside.
    pub(crate) fn between(&self) -> Option<[BodyId; 2]> {
        match self {
            ForceRole::Spring { between, .. } | ForceRole::Cable { between, .. } => Some(*between),
            ForceRole::Stretch { between } => Some(between.map(|end| end.body)),
            ForceRole::Torque { between, .. } => *between,
            ForceRole::Load { .. } => None,
        }
    }
}

/// A force's numbers beyond its element.
#[derive(Debug, Clone)]
pub struct ForceData {
    /// Its name in the model.
    pub name: String,
    /// What it is.
    pub(crate) role: ForceRole,
}

/// Where the friction of an ideal joint stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct JointFriction {
    /// Index into [`System::dependent_forces`].
    pub(crate) force: usize,
    /// What it brakes: a slide or a rotation.
    pub(crate) measure: Measure,
}

/// A massless equivalent clearance link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClearanceLink {
    /// Index into [`Inputs::offset`].
    pub(crate) offset: usize,
    /// Its length: the radial clearance \[m\].
    pub(crate) radius: f64,
}

/// A length or an angle among the results.
#[derive(Debug, Clone)]
pub(crate) struct MeasuredColumn {
    /// As the file names it.
    pub name: String,
    /// What it is.
    pub measured: Measured,
}

impl MeasuredColumn {
    /// SI units of itself and of its rate.
    pub fn units(&self) -> [&'static str; 2] {
        match self.measured {
            Measured::Turn { .. } => ["rad", "rad/s"],
            Measured::Distance { .. } | Measured::Along { .. } => ["m", "m/s"],
        }
    }
}

/// What the velocities of an instant say.
#[derive(Debug, Clone)]
pub enum OutputKind {
    /// A ratio of two: what is divided, and by what, sums.
    Ratio([Vec<Measured>; 2]),
    /// A coordinate of the instant centre of two bodies.
    Centre {
        /// The bodies.
        bodies: [BodyId; 2],
        /// Its coordinate.
        axis: Axis,
    },
}

/// An output among the results.
#[derive(Debug, Clone)]
pub struct OutputRatio {
    /// As the file names it.
    pub name: String,
    /// What it is.
    pub(crate) kind: OutputKind,
    /// The driver by which it is divided, where it is one: beside others, these are held.
    pub(crate) by: Option<DriverId>,
    /// Of the ratio, in SI.
    pub(crate) unit: &'static str,
}
