//! Racks whose teeth are not where their wheels are, and belts whose pulleys overlap.

use crate::analysis::control::Stop;
use crate::element::Kinematics;
use crate::element::rack::Rack;
use crate::system::{Evaluation, Inputs, JointData, JointRole, System};
use linkdyn_model::error::Complaint;

/// How far the pitch line may be off the rack's point, against the radius [–]: places are written with some digits.
const APART: f64 = 1e-3;

/// What is said of what rolls.
///
/// # Errors
/// Pulleys that leave no room for the strands of their belt.
pub(super) fn doubts(system: &System, q: &[f64], inputs: &Inputs) -> Result<Vec<String>, Stop> {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    let at = evaluation.kinematics(inputs);
    let mut overlaps = system
        .joints
        .iter()
        .filter_map(|joint| overlap(system, joint, &at));
    match overlaps.next() {
        Some(complaint) => Err(Stop::Input(vec![complaint])),
        None => Ok(apart(system, &at)),
    }
}

/// Pulleys between which their belt has no strands.
fn overlap(system: &System, joint: &JointData, at: &Kinematics) -> Option<Complaint> {
    let belt = joint.extras().belt.as_deref()?;
    let (span, least) = (belt.span(at), belt.lean().abs());
    if span > least {
        return None;
    }
    let length = |value: f64| system.display.length(value);
    let strands = if belt.crossed { "crossed" } else { "open" };
    let message = format!(
        "the pulleys' centres are {} apart, and {strands} strands between these radii need more than {}",
        length(span),
        length(least)
    );
    let hint = "look at the radii, and at the places of the pulleys";
    Some(Complaint::new(format!("joints.{}.radii", joint.name), message).hint(hint))
}

/// What is said of racks whose pitch line, as the radius has it, does not go through their point.
fn apart(system: &System, at: &Kinematics) -> Vec<String> {
    let text = |joint: &JointData| {
        let JointRole::Rack { axis, radius } = joint.role() else {
            return None;
        };
        let [first, second] = joint.points();
        let rack = Rack {
            first,
            second,
            axis,
            radius,
            offset: 0.0,
        };
        let height = rack.height(at);
        let is_off = |height: f64| (height - radius).abs() > APART * radius.abs();
        if !is_off(height) {
            return None;
        }
        let length = |value: f64| system.display.length(value);
        let mend = match is_off(-height) {
            true => {
                "move the wheel or the rack's point, or give this distance as \"radius\"".to_owned()
            }
            false => format!(
                "the line lies on its other side: write \"radius\": {}",
                quoted(&length(height))
            ),
        };
        Some(format!(
            "joint \"{}\": the wheel's centre is {} from the line through the rack's point, and rolls at {} from it; {mend}",
            joint.name,
            length(height),
            length(radius),
        ))
    };
    system.joints.iter().filter_map(text).collect()
}

fn quoted(text: &str) -> String {
    format!("\"{text}\"")
}
