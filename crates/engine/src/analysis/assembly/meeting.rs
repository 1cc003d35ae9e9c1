//! Racks whose teeth are not where their wheels are.

use crate::element::rack::Rack;
use crate::system::{Evaluation, Inputs, JointData, JointRole, System};

/// How far the pitch line may be off the rack's point, against the radius [–]: places are written with some digits.
const APART: f64 = 1e-3;

/// What is said of racks whose pitch line, as the radius has it, does not go through their point.
pub(super) fn apart(system: &System, q: &[f64], inputs: &Inputs) -> Vec<String> {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    let at = evaluation.kinematics(inputs);
    let text = |joint: &JointData| {
        let JointRole::Rack { axis, radius } = joint.role else {
            return None;
        };
        let [first, second] = joint.points;
        let rack = Rack {
            first,
            second,
            axis,
            radius,
            offset: 0.0,
        };
        let height = rack.height(&at);
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
