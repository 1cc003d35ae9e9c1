//! Lengths and angles that can't be computed with.

use crate::system::{Block, Evaluation, Inputs, Origin, System};
use linkdyn_model::error::Complaint;

/// Lengths up to which squares, and what is made of them, do not overflow \[m\].
const LONGEST: f64 = 1e60;

/// Complains of lengths that can't be computed with.
pub(super) fn too_long(system: &System) -> Option<Complaint> {
    let far = system
        .guess
        .iter()
        .chain([&system.size, &system.reach])
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    (far > LONGEST).then(|| {
        Complaint::new(
            "bodies",
            format!(
                "the mechanism is larger than {}, where numbers overflow",
                system.display.length(LONGEST)
            ),
        )
        .hint("look for a length with a wrong exponent or unit")
    })
}

/// Complains of a joint, driver or initial value that is further from the drawing than can be computed with.
pub(super) fn too_far(system: &System, inputs: &Inputs) -> Option<Complaint> {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(&system.guess);
    let at = evaluation.kinematics(inputs);
    let is_far = |block: &&Block| {
        let mut phi = vec![0.0; block.rows];
        block.constraint.position(&at, &mut phi);
        phi.iter().any(|x| x.is_nan() || x.abs() > LONGEST)
    };
    let block = system.blocks.iter().chain(&system.initial).find(is_far)?;
    let path = match &block.origin {
        Origin::Joint(id) => format!("joints.{}", system.joints[id.0].name),
        Origin::Driver(id) => format!("drivers.{}", system.drivers[id.0].name),
        Origin::Initial(name) => format!("initial.{name}"),
    };
    Some(
        Complaint::new(
            path,
            format!("it wants bodies further than {LONGEST:e} m or rad from the drawing, where numbers overflow"),
        )
        .hint("look for an angle or a length with a wrong exponent or unit"),
    )
}
