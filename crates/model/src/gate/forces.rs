//! Forces act on what can move; times of tables increase.

use super::Rules;
use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::response::Catalogue;
use crate::{ForceKind, GROUND, Motion, Value};

/// Warns of a force or a torque that acts on nothing that can move.
pub(super) fn forces(rules: &mut Rules<'_>) {
    let model = rules.model;
    for (name, force) in &model.forces {
        let path = format!("forces.{name}");
        let known = |key: &str| !rules.holes.has(&format!("{path}.{key}"));
        let idle = match &force.kind {
            ForceKind::Load { at, .. } if at.body == GROUND && known("at") => {
                Some(("at", "ground is fixed: the force moves nothing"))
            }
            ForceKind::Torque {
                body, relative_to, ..
            } if known("body") && known("relative_to") => {
                match relative_to.as_deref().unwrap_or(GROUND) {
                    other if body != other => None,
                    GROUND => Some(("body", "ground is fixed: the torque moves nothing")),
                    _ => {
                        let message = "the same body takes the opposite: the torque moves nothing";
                        Some(("body", message))
                    }
                }
            }
            ForceKind::Spring { .. }
            | ForceKind::Actuator { .. }
            | ForceKind::TorsionSpring { .. }
            | ForceKind::Load { .. }
            | ForceKind::Torque { .. } => None,
        };
        if let Some((key, message)) = idle.filter(|_| known("type")) {
            let warning = Complaint::new(format!("{path}.{key}"), message);
            rules
                .warnings
                .push(warning.hint("name a body that it is to move"));
        }
    }
}

/// Complains about the first time of each table that is not later than the one before, and about formulas that can't be
/// evaluated.
pub(super) fn motions(rules: &mut Rules<'_>) {
    let model = rules.model;
    let mut catalogue = None;
    for (name, driver) in &model.drivers {
        motion(rules, &driver.motion, &format!("drivers.{name}.motion"));
    }
    for (name, force) in &model.forces {
        let path = format!("forces.{name}");
        match &force.kind {
            ForceKind::Spring { free_length, .. } => {
                value(rules, free_length, &format!("{path}.free_length"));
                formula(
                    rules,
                    &mut catalogue,
                    (free_length, None),
                    &format!("{path}.free_length"),
                );
            }
            ForceKind::TorsionSpring { free_angle, .. } => {
                value(rules, free_angle, &format!("{path}.free_angle"));
                formula(
                    rules,
                    &mut catalogue,
                    (free_angle, None),
                    &format!("{path}.free_angle"),
                );
            }
            ForceKind::Load { vector, .. } => {
                for (index, part) in vector.iter().enumerate() {
                    let path = format!("{path}.vector[{index}]");
                    value(rules, part, &path);
                    formula(rules, &mut catalogue, (part, Some(Dimension::Force)), &path);
                }
            }
            ForceKind::Torque { value: torque, .. } => {
                let path = format!("{path}.value");
                value(rules, torque, &path);
                formula(
                    rules,
                    &mut catalogue,
                    (torque, Some(Dimension::Torque)),
                    &path,
                );
            }
            ForceKind::Actuator { force, .. } => {
                let path = format!("{path}.force");
                value(rules, force, &path);
                formula(
                    rules,
                    &mut catalogue,
                    (force, Some(Dimension::Force)),
                    &path,
                );
            }
        }
    }
}

fn value(rules: &mut Rules<'_>, value: &Value, path: &str) {
    match value {
        Value::Constant(_) | Value::Formula(_) => {}
        Value::Motion(of_time) => motion(rules, of_time, path),
    }
}

/// Complains about a formula that can't be evaluated, or is not of the dimension that is wanted; about any where none is.
fn formula(
    rules: &mut Rules<'_>,
    catalogue: &mut Option<Catalogue>,
    (value, wanted): (&Value, Option<Dimension>),
    path: &str,
) {
    let Value::Formula(formula) = value else {
        return;
    };
    // a name that is faulty elsewhere is not blamed once more
    if !rules.complaints.is_empty() || !rules.holes.is_empty() {
        return;
    }
    let Some(wanted) = wanted else {
        let message = "this follows a law of time, and not what moves";
        rules.complain(
            path,
            message,
            "an \"actuator\" or a \"torque\" takes a formula",
        );
        return;
    };
    let catalogue = catalogue.get_or_insert_with(|| Catalogue::of(rules.model));
    if let Some(complaint) = formula.fault(catalogue, wanted) {
        let path = path.to_owned();
        rules.complaints.push(Complaint { path, ..complaint });
    }
}

fn motion(rules: &mut Rules<'_>, motion: &Motion, path: &str) {
    let points = match motion {
        Motion::Table { points } => points,
        Motion::Polynomial { .. }
        | Motion::Harmonic { .. }
        | Motion::ConstantVelocity { .. }
        | Motion::ConstantAcceleration { .. } => return,
    };
    let place = |index: usize| format!("{path}.points[{index}][0]");
    for (index, pair) in points.windows(2).enumerate() {
        let known = !rules.holes.has(&place(index)) && !rules.holes.has(&place(index + 1));
        if known && pair[1][0] <= pair[0][0] {
            let message = "the time is not later than that of the point before";
            rules.complain(place(index + 1), message, "the times of a table increase");
            return;
        }
    }
}
