//! What no schema can say of forces and of motions.

use serde_json::Value;

use super::GROUND;
use super::check::{Checked, members};
use super::node::join;
use crate::error::Complaint;

/// Springs have a stiffness or a damping; a free length of zero should be meant. Loads act on what can move.
pub(super) fn forces(checked: &mut Checked<'_>) {
    let model = checked.model;
    for (name, force) in members(&model["forces"]) {
        let path = join("forces", name);
        if let Some((key, message)) = idle(force) {
            let warning = Complaint::new(format!("{path}.{key}"), message);
            checked
                .warnings
                .push(warning.hint("name a body that it is to move"));
        }
        let Some(kind @ ("spring" | "torsion_spring")) = force["type"].as_str() else {
            continue;
        };
        if force.get("stiffness").is_none() && force.get("damping").is_none() {
            checked.complain(path, "\"stiffness\" is missing").hint =
                Some("with \"damping\" alone it would be a damper".into());
            continue;
        }
        let stiff = force["stiffness"]
            .as_f64()
            .is_some_and(|stiffness| stiffness != 0.0);
        if kind == "spring" && stiff && force.get("free_length").is_none() {
            let warning = Complaint::new(path, "\"free_length\" is left out and taken as 0");
            checked
                .warnings
                .push(warning.hint("write it, even if it is 0"));
        }
    }
}

/// Where a force or a torque acts on nothing that can move.
fn idle(force: &Value) -> Option<(&'static str, &'static str)> {
    let text = |key: &str| force[key].as_str();
    match text("type")? {
        "force" => {
            let (body, _) = text("at")?.split_once('.')?;
            (body == GROUND).then_some(("at", "ground is fixed: the force moves nothing"))
        }
        "torque" => {
            let other = if force.get("relative_to").is_some() {
                text("relative_to")?
            } else {
                GROUND
            };
            (text("body")? == other).then_some((
                "body",
                match other {
                    GROUND => "ground is fixed: the torque moves nothing",
                    _ => "the same body takes the opposite: the torque moves nothing",
                },
            ))
        }
        _ => None,
    }
}

/// Times of tables increase.
pub(super) fn motions(checked: &mut Checked<'_>) {
    let model = checked.model;
    for (name, driver) in members(&model["drivers"]) {
        motion(
            checked,
            &driver["motion"],
            &format!("drivers.{name}.motion"),
        );
    }
    for (name, force) in members(&model["forces"]) {
        let path = join("forces", name);
        for key in ["free_length", "free_angle", "value"] {
            motion(checked, &force[key], &format!("{path}.{key}"));
        }
        for index in [0, 1] {
            motion(
                checked,
                &force["vector"][index],
                &format!("{path}.vector[{index}]"),
            );
        }
    }
}

fn motion(checked: &mut Checked<'_>, motion: &Value, path: &str) {
    let Some(points) = motion["points"].as_array() else {
        return;
    };
    let times: Vec<Option<f64>> = points.iter().map(|point| point[0].as_f64()).collect();
    for (index, pair) in times.windows(2).enumerate() {
        if let [Some(before), Some(after)] = pair
            && after <= before
        {
            let path = format!("{path}.points[{}][0]", index + 1);
            checked
                .complain(path, "the time is not later than that of the point before")
                .hint = Some("the times of a table increase".into());
            return;
        }
    }
}
