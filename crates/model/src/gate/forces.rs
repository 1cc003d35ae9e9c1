//! Forces act on what can move.

use super::Rules;
use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::response::Catalogue;
use crate::{ForceKind, GROUND, PointRef, Value};

/// Points that a cable goes over at most.
const MOST_POINTS: usize = 8;

/// Warns of a force or a torque that acts on nothing that can move.
pub(super) fn forces(rules: &mut Rules<'_>) {
    let model = rules.model;
    for (name, force) in &model.forces {
        let path = format!("forces.{name}");
        if let ForceKind::Cable { through, .. } = &force.kind {
            cable(rules, through, &path);
        }
        super::stops::stroke(rules, force, &path);
        super::parts::part(rules, &force.kind, &path);
        let known = |key: &str| !rules.holes.has(&format!("{path}.{key}"));
        let idle = match &force.kind {
            ForceKind::Load { at, .. } if at.body == GROUND && known("at") => {
                Some(("at", "ground is fixed: the force moves nothing"))
            }
            ForceKind::Torque {
                body, relative_to, ..
            }
            | ForceKind::DcMotor {
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
            | ForceKind::GasSpring { .. }
            | ForceKind::Cylinder { .. }
            | ForceKind::DcMotor { .. }
            | ForceKind::Cable { .. }
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

/// A cable goes over a few points, and on from each.
fn cable(rules: &mut Rules<'_>, through: &[PointRef], path: &str) {
    let at = format!("{path}.through");
    if rules.holes.has(&at) {
        return;
    }
    if through.len() > MOST_POINTS {
        let message = format!(
            "a cable goes over at most {MOST_POINTS} points, here {}",
            through.len()
        );
        return rules.complain(at, message, "a longer one is two, joined at a body");
    }
    let again = through.windows(2).position(|pair| pair[0] == pair[1]);
    if let Some(index) = again.filter(|index| !rules.holes.has(&format!("{at}[{}]", index + 1))) {
        let message = "the same point twice, one after the other";
        rules.complain(
            format!("{at}[{}]", index + 1),
            message,
            "leave one of them out",
        );
    }
}

/// Complains about formulas that can't be evaluated.
pub(super) fn formulas(rules: &mut Rules<'_>) {
    let model = rules.model;
    let mut catalogue = None;
    for (name, force) in &model.forces {
        for (key, value, wanted) in force.kind.values() {
            let path = format!("forces.{name}.{key}");
            formula(rules, &mut catalogue, (value, wanted), path);
        }
    }
}

/// Complains about a formula that can't be evaluated, or is not of the dimension that is wanted; about any where none is.
fn formula(
    rules: &mut Rules<'_>,
    catalogue: &mut Option<Catalogue>,
    (value, wanted): (&Value, Option<Dimension>),
    path: String,
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
        let hint = "an \"actuator\" or a \"torque\" takes a formula";
        return rules.complain(path, message, hint);
    };
    let catalogue = catalogue.get_or_insert_with(|| Catalogue::of(rules.model));
    if let Some(complaint) = formula.fault(catalogue, wanted) {
        rules.complaints.push(Complaint { path, ..complaint });
    }
}
