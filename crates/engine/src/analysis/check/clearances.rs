//! Joints with clearance, by the model of it.

use linkdyn_model::{ClearanceModel, Model};

/// Joints whose clearance is modelled.
pub fn clearances(model: &Model) -> impl Iterator<Item = (&str, ClearanceModel)> {
    model.joints.iter().filter_map(|(name, joint)| {
        let model = joint.kind.clearance()?.model;
        (model != ClearanceModel::Ideal).then_some((name.as_str(), model))
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
