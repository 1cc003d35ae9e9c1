//! Numbers with units: a plain number in the unit that `units` names for its dimension, text that brings its own, or an
//! expression, whose result is in SI where it has a dimension, and counts as a plain number where it has none.

use super::units::{Driven, Wanted};
use super::{Walk, wrong_kind};
use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::expression::{Misfit, Pure, Quantity, Recorded, is_expression, with_article};
use crate::node::{Kind, Node, excerpt};
use crate::shape::Measure;
use crate::units::{Unit, UnitFault, split_quantity, with_decimal_point};

impl Walk<'_> {
    /// The quantity in SI units, or none and a complaint.
    pub(super) fn quantity(
        &mut self,
        node: &Node,
        measure: Measure,
        path: &str,
        driven: Driven,
    ) -> Option<f64> {
        let wanted = self.units.wanted(measure, driven);
        match &node.kind {
            Kind::Number(number) => {
                let text = number.to_string();
                self.plain(node, &text, &wanted?, path)
            }
            Kind::String(text) if is_expression(text) => {
                let result = self.expression(node, text, path)?;
                let wanted = wanted?;
                let value = self.fit(node, result, &wanted, path)?;
                self.record(text, path, || match result.is_pure() {
                    true => wanted.plain.to_si("1"),
                    false => 1.0,
                });
                Some(value)
            }
            Kind::String(text) => {
                if self.decimal_comma(node, text, path) {
                    return None;
                }
                let wanted = wanted?;
                let Some((number, unit)) = split_quantity(text) else {
                    let hint = format!("a number, or text such as \"5 {}\"", wanted.si);
                    self.complain(
                        node,
                        Complaint::new(path, "this does not begin with a number").hint(hint),
                    );
                    return None;
                };
                let unit = self.checked_unit(node, unit, &wanted, path)?;
                self.finite(node, unit.to_si(number), path)
            }
            Kind::Null | Kind::Bool(_) | Kind::Array(_) | Kind::Object(_) => {
                let mut complaint = wrong_kind(path, "a number", node);
                complaint.hint = wanted
                    .map(|wanted| format!("or text with a unit, such as \"5 {}\"", wanted.si));
                self.complain(node, complaint);
                None
            }
        }
    }

    /// A number that has no unit.
    pub(super) fn plain_number(&mut self, node: &Node, path: &str) -> Option<f64> {
        match &node.kind {
            Kind::Number(number) => number.as_f64(),
            Kind::String(text) if is_expression(text) => {
                let result = self.expression(node, text, path)?;
                if result.is_pure() {
                    self.record(text, path, || 1.0);
                    return Some(result.value);
                }
                let complaint = Complaint::new(
                    path,
                    format!("this is {}, where a plain number is wanted", result.words()),
                );
                self.complain(
                    node,
                    complaint.hint(format!("divide it by 1 {}", result.unit())),
                );
                None
            }
            Kind::String(text) if self.decimal_comma(node, text, path) => None,
            Kind::Null | Kind::Bool(_) | Kind::String(_) | Kind::Array(_) | Kind::Object(_) => {
                self.complain(node, wrong_kind(path, "a plain number", node));
                None
            }
        }
    }

    /// Complains about a decimal comma, where there is one.
    fn decimal_comma(&mut self, node: &Node, text: &str, path: &str) -> bool {
        let Some(meant) = with_decimal_point(text) else {
            return false;
        };
        let hint = format!("a decimal point is a point: {:?}", excerpt(&meant));
        self.complain(
            node,
            Complaint::new(path, "a number has no comma").hint(hint),
        );
        true
    }

    /// Complains about a unit of plain numbers, where it is none.
    pub(super) fn unit(&mut self, node: &Node, text: &str, dimension: Dimension, path: &str) {
        let wanted = self.units.derivative(dimension, 0);
        self.checked_unit(node, text, &wanted, path);
    }

    fn checked_unit(
        &mut self,
        node: &Node,
        text: &str,
        wanted: &Wanted,
        path: &str,
    ) -> Option<Unit> {
        let text = excerpt(text);
        let such = if wanted.powers == Dimension::AngularVelocity.powers() {
            "such as \"rad/s\", \"deg/s\" or \"rpm\"".to_owned()
        } else {
            format!("such as {:?}", wanted.si)
        };
        let (message, hint) = match Unit::parse(&text) {
            Ok(unit) if wanted.powers.accepts(unit.powers) => return Some(unit),
            Ok(_) => (format!("{text:?} is not a unit of {}", wanted.name), such),
            Err(UnitFault::Missing) => (
                format!("the unit is missing, a unit of {}", wanted.name),
                such,
            ),
            Err(fault @ UnitFault::Unknown { .. }) => {
                let wanted = || format!("{} is wanted, {such}", wanted.name);
                (fault.message(&text), fault.hint().unwrap_or_else(wanted))
            }
            Err(fault) => (fault.message(&text), such),
        };
        self.complain(node, Complaint::new(path, message).hint(hint));
        None
    }

    /// What an expression gives, or none and a complaint here or at a parameter.
    pub(super) fn expression(&mut self, node: &Node, text: &str, path: &str) -> Option<Quantity> {
        match self.parameters.evaluate(text) {
            Ok(result) => result,
            Err(Misfit { at, fault }) => {
                self.complain_at(node, Some(at), fault.at(path));
                None
            }
        }
    }

    /// Keeps an expression and where it stands, if that is requested.
    pub(super) fn record(&mut self, text: &str, path: &str, factor: impl FnOnce() -> f64) {
        if let Some(record) = &mut self.record {
            record.push(Recorded {
                path: path.to_owned(),
                text: text.to_owned(),
                factor: factor(),
            });
        }
    }

    /// The result of an expression where a quantity is wanted: in SI where it has a dimension, else a plain number.
    fn fit(&mut self, node: &Node, result: Quantity, wanted: &Wanted, path: &str) -> Option<f64> {
        let place = with_article(&wanted.name, &wanted.si);
        let in_radians = wanted.powers.angle == 0 || wanted.plain == Unit::si(wanted.powers);
        let complaint = match result.pure {
            _ if !result.is_pure() && result.fits(wanted.powers) => return Some(result.value),
            _ if !result.is_pure() => {
                let complaint = Complaint::new(
                    path,
                    format!("this is {}, where {place} is wanted", result.words()),
                );
                let radians = result.radians_to(wanted.powers);
                Complaint {
                    hint: radians.map(|factor| format!("write it {factor}, if that is meant")),
                    ..complaint
                }
            }
            Pure::Plain => return self.plain(node, &result.value.to_string(), wanted, path),
            Pure::Circular if in_radians => {
                return self.plain(node, &result.value.to_string(), wanted, path);
            }
            Pure::Circular => {
                let message = format!(
                    "a plain number made with pi, where {place} is wanted that is not in radians here"
                );
                Complaint::new(path, message).hint("write it * 1 rad, or in deg")
            }
            Pure::Ratio => {
                let message = format!("this is a ratio without unit, where {place} is wanted");
                Complaint::new(path, message).hint(format!(
                    "multiply it by a quantity, such as 1 {}",
                    wanted.si
                ))
            }
        };
        self.complain(node, complaint);
        None
    }

    /// A number in the unit that `units` names.
    fn plain(&mut self, node: &Node, number: &str, wanted: &Wanted, path: &str) -> Option<f64> {
        let value = wanted.plain.to_si(number);
        if let Some(index) = wanted.dimension.and_then(Dimension::index)
            && value != 0.0
        {
            self.units.plain[index].get_or_insert_with(|| path.to_owned());
        }
        self.finite(node, value, path)
    }

    fn finite(&mut self, node: &Node, number: f64, path: &str) -> Option<f64> {
        if number.is_finite() {
            return Some(number);
        }
        self.complain(
            node,
            Complaint::new(path, "the number is too large for a double"),
        );
        None
    }
}
