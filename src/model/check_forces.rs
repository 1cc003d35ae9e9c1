//! What no schema can say of forces and of motions.

use serde_json::Value;

use super::check::{Checked, members};
use super::node::join;
use crate::error::Complaint;

/// Springs have a stiffness or a damping; a free length of zero should be meant.
pub(super) fn forces(checked: &mut Checked<'_>) {
    let model = checked.model;
    for (name, force) in members(&model["forces"]) {
        let path = join("forces", name);
        let Some(kind @ ("spring" | "torsion_spring")) = force["type"].as_str() else { continue };
        if force.get("stiffness").is_none() && force.get("damping").is_none() {
            checked.complain(path, "\"stiffness\" is missing").hint =
                Some("with \"damping\" alone it would be a damper".into());
            continue;
        }
        let stiff = force["stiffness"].as_f64().is_some_and(|stiffness| stiffness != 0.0);
        if kind == "spring" && stiff && force.get("free_length").is_none() {
            let warning = Complaint::new(path, "\"free_length\" is left out and taken as 0");
            checked.warnings.push(warning.hint("write it, even if it is 0"));
        }
    }
}

/// Times of tables increase.
pub(super) fn motions(checked: &mut Checked<'_>) {
    let model = checked.model;
    for (name, driver) in members(&model["drivers"]) {
        motion(checked, &driver["motion"], &format!("drivers.{name}.motion"));
    }
    for (name, force) in members(&model["forces"]) {
        let path = join("forces", name);
        for key in ["free_length", "free_angle", "value"] {
            motion(checked, &force[key], &format!("{path}.{key}"));
        }
        for index in [0, 1] {
            motion(checked, &force["vector"][index], &format!("{path}.vector[{index}]"));
        }
    }
}

fn motion(checked: &mut Checked<'_>, motion: &Value, path: &str) {
    let Some(points) = motion["points"].as_array() else { return };
    let times: Vec<Option<f64>> = points.iter().map(|point| point[0].as_f64()).collect();
    for (index, pair) in times.windows(2).enumerate() {
        if let [Some(before), Some(after)] = pair
            && after <= before
        {
            let path = format!("{path}.points[{}][0]", index + 1);
            checked.complain(path, "the time is not later than that of the point before").hint =
                Some("the times of a table increase".into());
            return;
        }
    }
}
