//! What is said of the way from the drawing to the start.

use super::values::Values;
use crate::analysis::in_line::{singular_text, stressed_rows};
use crate::element::Constraint;
use crate::mechanism::continuation::SingularPosition;
use crate::system::{Inputs, Origin, System};

/// What settles a choice.
const SETTLES: &str = "draw the bodies (\"pose\") where they start to say which assembly is meant";

/// Where on the way a singular position lies: it, and the part of the way up to it.
type PlaceOnPath<'p> = (&'p SingularPosition, f64);

/// Of a way that passes a singular position.
pub(super) fn passed(system: &System, led: &System, values: &Values, place: PlaceOnPath) -> String {
    format!(
        "on the way from the drawing to {} the mechanism passes a singular position at {}{}, from which more than one branch of motion \
         leads on; taken is the assembly on the branch that goes straight on. If another is meant, {SETTLES}",
        start(system, values),
        value(system, values, place.1),
        what(led, place.0),
    )
}

/// Of a way that does not go on.
pub(super) fn ended(system: &System, led: &System, values: &Values, place: PlaceOnPath) -> String {
    format!(
        "{} can't be reached by moving there from the drawing: the way ends at {}{}, in a dead centre; taken is the assembly nearest to \
         the drawing, which may be another one than is meant: {SETTLES}",
        start(system, values),
        value(system, values, place.1),
        what(led, place.0),
    )
}

/// Of a way that can't be followed.
pub(super) fn stuck(system: &System, values: &Values) -> String {
    format!(
        "{} can't be reached by moving there from the drawing, on which the way is singular; taken is the assembly nearest to the \
         drawing, which may be another one than is meant: {SETTLES}",
        start(system, values),
    )
}

/// Of a way from a drawing that does not close.
pub(super) fn undrawn(system: &System, values: &Values) -> String {
    format!(
        "{} can't be reached by moving there from the drawing, which does not close where it is drawn; taken is the assembly nearest to \
         the drawing, which may be another one than is meant: {SETTLES}",
        start(system, values),
    )
}

/// Of a way that is too long.
pub(super) fn too_far(system: &System, values: &Values) -> String {
    format!(
        "{} is too far from the drawing to be reached by moving there; taken is the assembly nearest to the drawing, which may be \
         another one than is meant: {SETTLES}",
        start(system, values),
    )
}

/// `, where "coupler" and "rocker" are in line`.
fn what(led: &System, position: &SingularPosition) -> String {
    let rows = stressed_rows(led, &position.self_stress);
    let what = singular_text(led, &rows);
    what.map_or_else(String::new, |what| format!(", where {what}"))
}

/// The value that has farthest to go: `the start value l.angle = 85 deg`.
fn start(system: &System, values: &Values) -> String {
    format!("the start value {}", value(system, values, 1.0))
}

/// The same value after a part of the way.
fn value(system: &System, values: &Values, part: f64) -> String {
    let Some((farthest, _)) = values.farthest(system) else {
        return String::new();
    };
    let left = 1.0 - part;
    match farthest.checked_sub(system.drivers.len()) {
        None => {
            let asked = Inputs::at_time(system, 0.0).drive[farthest][0];
            let there = asked - left * values.drivers[farthest];
            let driver = &system.drivers[farthest];
            let text = system.driver_value(farthest, there);
            format!("{text} of driver \"{}\"", driver.name)
        }
        Some(k) => {
            let start = &system.starts[k];
            let there = start.value - left * values.starts[k];
            let text = match start.rows()[0] {
                crate::element::Measure::Angle => system.display.angle(there),
                crate::element::Measure::Length => system.display.length(there),
            };
            let name = match &system.initial[k].origin {
                Origin::Initial(name) => name.as_str(),
                Origin::Joint(_) | Origin::Driver(_) | Origin::Stop(_) => "",
            };
            format!("{name} = {text}")
        }
    }
}
