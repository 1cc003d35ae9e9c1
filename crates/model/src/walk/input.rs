//! Inputs: a number each, whose unit gives it its dimension.

use super::{Walk, wrong_kind};
use crate::error::Complaint;
use crate::expression::{Quantity, is_expression, quantity};
use crate::input::ModelInput;
use crate::node::{Kind, Node, join, members};
use crate::tree::Tree;

impl Walk<'_> {
    /// Reads the inputs, which formulas anywhere may name.
    pub(super) fn read_inputs(&mut self, node: Option<&Node>) {
        let members =
            members(node).filter(|(key, one)| *key != "note" || one.node.as_str().is_none());
        let members: Vec<_> = members
            .map(|(name, one)| (name.clone(), &one.node))
            .collect();
        for (name, node) in members {
            let input = self.input_of(node, &join("inputs", &name));
            self.inputs.push((name, input));
        }
    }

    /// An input that was read before.
    pub(super) fn input(&mut self, node: &Node, path: &str) -> Option<Tree> {
        let known = path.strip_prefix("inputs.").and_then(|name| {
            let mut inputs = self.inputs.iter();
            inputs.find(|one| one.0 == name)
        });
        let input = match known {
            Some((_, input)) => input.clone()?,
            // a printer looks at one alone
            None => self.input_of(node, path)?,
        };
        Some(Tree::of(&input))
    }

    fn input_of(&mut self, node: &Node, path: &str) -> Option<ModelInput> {
        let value = match &node.kind {
            Kind::Number(number) => Quantity::plain(number.as_f64().unwrap_or(f64::INFINITY)),
            Kind::String(text) if is_expression(text) => {
                let value = self.expression(node, text, path)?;
                self.record(text, &format!("{path}.start"), || 1.0);
                value
            }
            Kind::String(text) => match quantity(text) {
                Ok(value) => value,
                Err(fault) => {
                    self.complain(node, fault.at(path));
                    return None;
                }
            },
            Kind::Null | Kind::Bool(_) | Kind::Array(_) | Kind::Object(_) => {
                let complaint = wrong_kind(path, "a number", node);
                let hint = "its value until it is set, with its unit, as in \"2 N*m\"";
                self.complain(node, complaint.hint(hint));
                return None;
            }
        };
        let Some(powers) = value.whole_powers() else {
            let message = format!("this is {}, which no input is", value.words());
            self.complain(node, Complaint::new(path, message));
            return None;
        };
        if !value.value.is_finite() {
            let complaint = Complaint::new(path, "the number is too large for a double");
            self.complain(node, complaint);
            return None;
        }
        Some(ModelInput {
            start: value.value,
            unit: Quantity::si(0.0, powers).unit(),
        })
    }
}
