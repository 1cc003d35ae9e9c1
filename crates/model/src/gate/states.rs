//! Inputs, and integrated states: their rates, and where they are integrated.

use super::Rules;
use super::timed::not_free;
use crate::State;
use crate::error::Complaint;
use crate::expression::Quantity;
use crate::response::Catalogue;
use crate::table::unit;

/// All rules of inputs.
pub(super) fn inputs(rules: &mut Rules<'_>) {
    for (name, input) in &rules.model.inputs {
        let path = format!("inputs.{name}");
        if Catalogue::is_of_bodies(name) {
            let message = format!("input.{name} would be a column of a body called \"input\"");
            rules.complain(&path, message, "give the input another name");
        }
        if !input.start.is_finite() {
            rules.complain(&path, "a finite number is expected", "in SI");
        }
        if let Err(complaint) = unit(&input.unit) {
            rules.complaints.push(Complaint { path, ..complaint });
        }
    }
}

/// All rules of states.
pub(super) fn states(rules: &mut Rules<'_>) {
    let model = rules.model;
    if model.states.is_empty() {
        return;
    }
    let catalogue = Catalogue::of(model);
    for (name, state) in &model.states {
        let path = format!("states.{name}");
        if rules.holes.has(&path) {
            continue;
        }
        if Catalogue::is_of_bodies(name) {
            let message = format!("state.{name} would be a column of a body called \"state\"");
            rules.complain(&path, message, "give the state another name");
        }
        if !state.start.is_finite() {
            rules.complain(
                format!("{path}.start"),
                "a finite number is expected",
                "in SI",
            );
        }
        // a name that is faulty elsewhere is not blamed once more
        let is_whole = rules.complaints.is_empty() && rules.holes.is_empty();
        if is_whole && let Some(complaint) = fault(state, &catalogue) {
            let path = format!("{path}.rate");
            rules.complaints.push(Complaint { path, ..complaint });
        }
    }
    let kind = model.analysis.as_ref().map(|analysis| analysis.kind);
    if let Some(why) = kind.and_then(not_free) {
        let message = format!("states are integrated in a free motion, and {why}");
        let hint =
            "take \"dynamics\", where drivers may leave something free, or leave the states out";
        rules.complain("states", message, hint);
    }
}

fn fault(state: &State, catalogue: &Catalogue) -> Option<Complaint> {
    let powers = match unit(&state.unit) {
        Ok(unit) => unit.powers,
        Err(complaint) => return Some(complaint),
    };
    match state.rate.compile(catalogue) {
        Ok(compiled) if compiled.moving.fits(powers.per_second(1)) => None,
        Ok(compiled) => {
            let place = Quantity::si(0.0, powers.per_second(1)).words();
            let found = compiled.moving.quantity.words();
            Some(Complaint::new(
                "",
                format!("this is {found}, where {place} is wanted"),
            ))
        }
        Err(complaint) => Some(complaint),
    }
}
