//! Responses: texts that can be evaluated, limits with a width, units that fit.

use super::Rules;
use crate::Response;
use crate::error::Complaint;
use crate::expression::Quantity;
use crate::response::Catalogue;
use crate::units::{Unit, UnitFault};

/// All rules of responses.
pub(super) fn responses(rules: &mut Rules<'_>) {
    let model = rules.model;
    if model.responses.is_empty() {
        return;
    }
    let catalogue = Catalogue::of(model);
    // a name that is faulty elsewhere is not blamed once more
    let is_whole = rules.complaints.is_empty() && rules.holes.is_empty();
    for (name, response) in &model.responses {
        let path = format!("responses.{name}");
        if rules.holes.has(&path) {
            continue;
        }
        rules.width(&path, response.limits, "the lower limit", "[79, 81]");
        match response.compile(&catalogue) {
            Ok(compiled) => unit(rules, response, &compiled.quantity, &path),
            Err(complaint) if is_whole => rules.complaints.push(Complaint { path, ..complaint }),
            Err(_) => {}
        }
    }
}

/// The unit in which it is shown has its dimension.
fn unit(rules: &mut Rules<'_>, response: &Response, quantity: &Quantity, path: &str) {
    let path = format!("{path}.unit");
    let Some(text) = response.unit.as_ref().filter(|_| !rules.holes.has(&path)) else {
        return;
    };
    let such = match quantity.unit() {
        unit if unit.is_empty() => "a plain number has none".to_owned(),
        unit => format!("such as {unit:?}"),
    };
    let text = crate::node::excerpt(text);
    match Unit::parse(&text) {
        Ok(unit) if quantity.fits(unit.powers) => {}
        Ok(_) => {
            let message = format!("{text:?} is no unit of {}, which this is", quantity.words());
            rules.complain(path, message, such);
        }
        Err(UnitFault::TooLarge) => {
            rules.complain(path, UnitFault::Malformed.message(&text), such);
        }
        Err(fault) => {
            let hint = fault.hint().unwrap_or(such);
            rules.complain(path, fault.message(&text), hint);
        }
    }
}
