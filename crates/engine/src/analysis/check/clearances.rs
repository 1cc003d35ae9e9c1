//! Joints with clearance, by the model of it.

use linkdyn_model::{ClearanceModel, JointKind, Model};

/// Joints whose clearance is modelled.
pub fn clearances(model: &Model) -> impl Iterator<Item = (&str, ClearanceModel)> {
    model
        .joints
        .iter()
        .filter_map(|(name, joint)| match &joint.kind {
            JointKind::Revolute {
                clearance: Some(clearance),
                ..
            } if clearance.model != ClearanceModel::Ideal => Some((name.as_str(), clearance.model)),
            JointKind::Revolute { .. }
            | JointKind::Prismatic { .. }
            | JointKind::Slot { .. }
            | JointKind::Gear { .. }
            | JointKind::Fixed { .. }
            | JointKind::Contact { .. }
            | JointKind::Cam(_)
            | JointKind::Rack { .. }
            | JointKind::Belt { .. }
            | JointKind::Bushing(_) => None,
        })
}

/// Whether journals move freely in their bearings with this model.
pub fn is_open(model: ClearanceModel) -> bool {
    match model {
        ClearanceModel::Ideal | ClearanceModel::MasslessLink => false,
        ClearanceModel::TwoState | ClearanceModel::ThreeState | ClearanceModel::Contact => true,
    }
}

/// Whether journals move freely in their bearings, however the mechanism is driven.
pub fn journals_move(model: &Model) -> bool {
    clearances(model).any(|(_, model)| is_open(model))
}
