//! Tolerances of parameters, in the dimension that each parameter turns out to have.

use crate::tree::Tree;

use super::{Driven, Walk, wrong_kind};
use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::expression::{Fault, Quantity, is_expression, quantity};
use crate::node::{Kind, Node, join, members};
use crate::shape::Bound;
use crate::tolerance::{Distribution, Tolerance};
use crate::units::split_quantity;
use crate::words;

impl Walk<'_> {
    /// Reads the tolerances of all parameters that have one.
    pub(super) fn tolerances(&mut self, node: &Node, path: &str) {
        for (name, member) in members(Some(node)) {
            if let Kind::Object(_) = member.node.kind {
                self.parameter(&member.node, name, &join(path, name));
            }
        }
    }

    fn parameter(&mut self, node: &Node, name: &str, path: &str) {
        let nominal = self.parameters.value(name);
        let driven = nominal.map_or(Driven::Unknown, Driven::Parameter);
        let before = self.complaints.len() + self.more;
        let value = self.object(node, words::object("Parameter"), None, path, driven);
        if self.complaints.len() + self.more > before {
            return;
        }
        let value = value.unwrap_or(Tree::Null);
        let number = |key: &str| value.get(key).and_then(Tree::number);
        let tolerance = value.get("tolerance").and_then(|both| {
            let at = |index: usize| both.entry(index).and_then(Tree::number);
            Some([at(0)?, at(1)?])
        });
        let Some(distribution) = self.distribution(node, &value, path) else {
            return;
        };
        let cost = number("cost");
        if tolerance.is_none() && cost.is_none() {
            let keys = ["distribution", "sigma"];
            if let Some(key) = keys.into_iter().find(|key| node.get(key).is_some()) {
                let message = format!("{key:?} is that of a tolerance, and there is none");
                let complaint = Complaint::new(join(path, key), message);
                let hint = "as in \"tolerance\": \"0.05 mm\"";
                self.complain(node.get(key).unwrap_or(node), complaint.hint(hint));
            }
            return;
        }
        let [lower, upper] = tolerance.unwrap_or_default();
        let tolerance = Tolerance {
            lower,
            upper,
            distribution,
            cost,
        };
        self.tolerances.insert(name.to_owned(), tolerance);
    }

    /// How parts are spread, `None` if that is faulty.
    fn distribution(&mut self, node: &Node, value: &Tree, path: &str) -> Option<Distribution> {
        let sigma = value.get("sigma").and_then(Tree::number);
        let word = value.get("distribution").and_then(Tree::text);
        let at = node.get("sigma").unwrap_or(node);
        let path = join(path, "sigma");
        let normal = match word {
            Some("uniform") => Distribution::Uniform,
            Some("triangular") => Distribution::Triangular,
            Some(_) | None => {
                let sigma = sigma.unwrap_or(3.0);
                if let Some(fault) = Bound::Above(0.0).fault(sigma) {
                    self.complain(at, Complaint::new(path, fault));
                    return None;
                }
                return Some(Distribution::Normal { sigma });
            }
        };
        if sigma.is_some() {
            let message = format!("{:?} has no sigma", word.unwrap_or_default());
            let complaint = Complaint::new(path, message);
            self.complain(at, complaint.hint("only \"normal\" has one"));
            return None;
        }
        Some(normal)
    }

    /// Lower and upper deviation: one to either side, or both.
    pub(super) fn deviations(&mut self, node: &Node, path: &str, driven: Driven) -> Option<Tree> {
        let both = match &node.kind {
            Kind::Array(items) if items.len() == 2 => {
                let [lower, upper] = [0, 1].map(|index| {
                    self.deviation(&items[index], &format!("{path}[{index}]"), driven)
                });
                let (lower, upper) = (lower?, upper?);
                if lower > upper {
                    let complaint = Complaint::new(path, "the deviations are the wrong way round");
                    let hint = "the lower one comes first, as in [\"-0.02 mm\", \"0.05 mm\"]";
                    self.complain(node, complaint.hint(hint));
                    return None;
                }
                [lower, upper]
            }
            Kind::Array(items) => {
                let message = crate::gate::length_fault(items.len(), 2, true);
                let complaint = Complaint::new(path, message);
                self.complain(
                    node,
                    complaint.hint("lower and upper deviation, or one for both"),
                );
                return None;
            }
            Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::String(_) | Kind::Object(_) => {
                let width = self.deviation(node, path, driven)?;
                if width < 0.0 {
                    let complaint = Complaint::new(path, "must not be negative");
                    let hint = "it goes to either side, or write [lower, upper]";
                    self.complain(node, complaint.hint(hint));
                    return None;
                }
                // a zero without a sign
                [0.0 - width, width]
            }
        };
        Some(both.map(Tree::Number).into_iter().collect())
    }

    /// A deviation, in SI or, with %, of the value.
    fn deviation(&mut self, node: &Node, path: &str, driven: Driven) -> Option<f64> {
        let percent = node.as_str().and_then(split_quantity);
        let Some((number, "%")) = percent else {
            return self.like_parameter(node, path, driven);
        };
        let Driven::Parameter(nominal) = driven else {
            return None;
        };
        if nominal.value == 0.0 {
            let complaint = Complaint::new(path, format!("{number} % of 0 is nothing"));
            self.complain(node, complaint.hint("write the tolerance itself"));
            return None;
        }
        let share: f64 = number.parse().ok()?;
        Some(share / 100.0 * nominal.value.abs())
    }

    /// A number above a bound, with the dimension of the parameter.
    pub(super) fn alike(
        &mut self,
        node: &Node,
        bound: Bound,
        path: &str,
        driven: Driven,
    ) -> Option<Tree> {
        let number = self.like_parameter(node, path, driven)?;
        if let Some(fault) = bound.fault(number) {
            self.complain(node, Complaint::new(path, fault));
            return None;
        }
        Some(Tree::Number(number))
    }

    /// A number with the dimension of the parameter.
    fn like_parameter(&mut self, node: &Node, path: &str, driven: Driven) -> Option<f64> {
        let found = match &node.kind {
            Kind::Number(number) => Quantity::plain(number.as_f64()?),
            Kind::String(text) if is_expression(text) => self.expression(node, text, path)?,
            Kind::String(text) => match quantity(text) {
                Ok(found) => found,
                Err(Fault { message, hint }) => {
                    let is_plain = text.trim().parse::<f64>().is_ok();
                    let hint = hint.filter(|_| !is_plain);
                    let hint = hint.or_else(|| is_plain.then(|| with_unit(driven)).flatten());
                    let complaint = Complaint {
                        hint,
                        ..Complaint::new(path, message)
                    };
                    self.complain(node, complaint);
                    return None;
                }
            },
            Kind::Null | Kind::Bool(_) | Kind::Array(_) | Kind::Object(_) => {
                self.complain(node, wrong_kind(path, "a number", node));
                return None;
            }
        };
        let Driven::Parameter(nominal) = driven else {
            return None;
        };
        // nothing is nothing in any unit
        if found.is_like(&nominal) || (found.is_pure() && found.value == 0.0) {
            return Some(found.value);
        }
        let message = format!(
            "this is {}, where {} is wanted, as the parameter is",
            found.words(),
            nominal.words()
        );
        let mut complaint = Complaint::new(path, message);
        if found.is_pure() {
            complaint.hint = with_unit(driven);
        }
        self.complain(node, complaint);
        None
    }
}

/// How to write a number in the dimension of a parameter.
fn with_unit(driven: Driven) -> Option<String> {
    let Driven::Parameter(nominal) = driven else {
        return None;
    };
    let unit = match nominal.dimension() {
        Some(Dimension::Length) => "mm".to_owned(),
        Some(Dimension::Angle) => "deg".to_owned(),
        Some(_) | None => nominal.unit(),
    };
    let plain = "write a plain number without quotes".to_owned();
    Some(if unit.is_empty() {
        plain
    } else {
        format!("give it a unit, as in \"0.1 {unit}\"")
    })
}
