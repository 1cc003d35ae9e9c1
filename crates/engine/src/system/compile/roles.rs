//! What joints, drivers and forces are, kept beside their equations.

use super::Compiler;
use crate::element::{Axis, BodyId};
use crate::system::{DriverRole, JointId, JointRole};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::{DriverKind, JointKind, PointAxis};

/// What a joint is.
pub(super) fn joint_role(kind: &JointKind) -> JointRole {
    match kind {
        JointKind::Revolute { .. } => JointRole::Revolute,
        JointKind::Prismatic { axis, angle, .. } => JointRole::Prismatic {
            axis: unit(Vec2::from(*axis)),
            angle: *angle,
        },
        JointKind::Slot { axis, .. } => JointRole::Slot {
            axis: unit(Vec2::from(*axis)),
        },
        JointKind::Gear { .. } => JointRole::Gear,
        JointKind::Rack { axis, radius, .. } => JointRole::Rack {
            axis: unit(Vec2::from(*axis)),
            radius: *radius,
        },
        JointKind::Bushing(_) => JointRole::Bushing,
        JointKind::Beam(_) => JointRole::Beam,
        JointKind::Fixed { .. } => JointRole::Fixed,
        JointKind::Contact { .. } => JointRole::Contact,
        _ => JointRole::Other,
    }
}

/// A coordinate of a point as those of bodies.
pub(super) fn axis_of(axis: PointAxis) -> Axis {
    match axis {
        PointAxis::X => Axis::X,
        PointAxis::Y => Axis::Y,
    }
}

impl Compiler<'_> {
    /// What a driver moves.
    pub(super) fn driver_role(&self, kind: &DriverKind) -> DriverRole {
        match kind {
            DriverKind::Rotation { body, relative_to } => DriverRole::Rotation {
                body: self.body(body),
                relative_to: relative_to
                    .as_deref()
                    .map_or(BodyId::GROUND, |name| self.body(name)),
            },
            DriverKind::Length { between } => DriverRole::Length {
                between: between.each_ref().map(|end| self.marker(end)),
            },
            DriverKind::Point { point, axis } => DriverRole::Coordinate {
                origin: self.marker(point),
                axis: axis_of(*axis),
            },
            DriverKind::Translation { joint } => DriverRole::Translation {
                // The loader knows each joint that a driver names.
                joint: JointId(self.model.joints.get_index_of(joint).unwrap_or_default()),
            },
        }
    }
}
