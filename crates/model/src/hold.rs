//! Whether anything holds the mechanism to ground.

use super::{ForceKind, GROUND, Model};
use crate::error::Complaint;

/// What people call a body that is fixed.
const FIXED: [&str; 16] = [
    "ground",
    "base",
    "frame",
    "fixed",
    "chassis",
    "housing",
    "casing",
    "stand",
    "bed",
    "foundation",
    "support",
    "wall",
    "world",
    "stator",
    "earth",
    "gestell",
];

/// What to say where joints connect bodies, and neither a joint nor a spring connects one of them to ground.
pub fn unheld(model: &Model) -> Option<Complaint> {
    let on_joints = || {
        model
            .joints
            .values()
            .flat_map(|joint| &joint.between)
            .map(|end| end.body.as_str())
    };
    let by_spring = model.forces.values().any(|force| match &force.kind {
        ForceKind::Spring { between, .. }
        | ForceKind::Actuator { between, .. }
        | ForceKind::GasSpring { between, .. }
        | ForceKind::Cylinder { between, .. } => between.iter().any(|end| end.body == GROUND),
        ForceKind::Cable { through, .. } => through.iter().any(|end| end.body == GROUND),
        ForceKind::TorsionSpring { between, .. } => between.iter().any(|body| body == GROUND),
        ForceKind::Load { .. } | ForceKind::Torque { .. } | ForceKind::DcMotor { .. } => false,
    });
    if model.joints.is_empty() || by_spring || on_joints().any(|body| body == GROUND) {
        return None;
    }
    let message = if model.bodies.contains_key(GROUND) {
        "nothing holds the mechanism: no joint or spring is on \"ground\""
    } else {
        "nothing holds the mechanism: no body is called \"ground\", which is the name of the fixed one"
    };
    let rename = match likely(model) {
        Some(body) => format!("rename the fixed body, probably {body:?}, to \"ground\""),
        None => "rename the fixed body to \"ground\"".to_string(),
    };
    Some(
        Complaint::new("bodies", message)
            .hint(format!("{rename}, unless all of it is to move freely")),
    )
}

/// The body that was probably meant to be fixed: by its name, or as the only one without mass.
fn likely(model: &Model) -> Option<&str> {
    let moving = || model.bodies.iter().filter(|(name, _)| *name != GROUND);
    let is_word = |word: &str| FIXED.iter().any(|fixed| fixed.eq_ignore_ascii_case(word));
    let mut named =
        moving().filter(|(name, _)| name.split(|c: char| !c.is_alphabetic()).any(is_word));
    if let Some((name, _)) = named.next() {
        return Some(name);
    }
    let mut massless = moving().filter(|(_, body)| body.mass.is_none_or(|mass| mass == 0.0));
    match (massless.next(), massless.next()) {
        (Some((name, _)), None) => Some(name),
        (Some(_), Some(_)) | (None, _) => None,
    }
}
