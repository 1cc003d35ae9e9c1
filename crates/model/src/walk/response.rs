//! Responses of a file: their texts, checked against the names that the model has, and their limits.

use indexmap::IndexMap;

use crate::tree::Tree;

use super::{Driven, Walk, wrong_kind};
use crate::error::Complaint;
use crate::expression::{Misfit, Quantity, is_expression, quantity};
use crate::node::{Kind, Node, join, members};
use crate::response::{Catalogue, Constant};
use crate::shape::Shape;
use crate::words;

impl Walk<'_> {
    /// Lets responses name the results of a model.
    pub fn knowing(self, catalogue: Catalogue) -> Self {
        Walk {
            catalogue: Some(catalogue),
            ..self
        }
    }

    /// All responses; none is called like a parameter.
    pub(super) fn responses(&mut self, node: &Node, path: &str, driven: Driven) -> Option<Tree> {
        for (name, member) in members(Some(node)) {
            if self.parameters.has(name) {
                let complaint = Complaint::new(join(path, name), "a parameter has this name");
                let hint = "give the response another name";
                self.complain_key(member.key, name, complaint.hint(hint));
            }
        }
        self.map(node, &Shape::Response, path, driven)
    }

    /// A text, or one with limits and the unit in which it is shown.
    pub(super) fn response(&mut self, node: &Node, path: &str) -> Option<Tree> {
        let (text_node, text_path) = match &node.kind {
            Kind::String(_) => (Some(node), path.to_owned()),
            Kind::Object(_) => (node.get("value"), join(path, "value")),
            Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::Array(_) => {
                let complaint = wrong_kind(path, "text", node);
                let hint = r#"as in "stroke": "max(piston.x) - min(piston.x)""#;
                self.complain(node, complaint.hint(hint));
                return None;
            }
        };
        let read = text_node.and_then(|node| Some((node, node.as_str()?)));
        let found = read.and_then(|(node, text)| self.response_text(node, text, &text_path));
        let mut out = match &node.kind {
            Kind::Object(_) => {
                let driven = match &found {
                    Some((quantity, _)) => Driven::Parameter(*quantity),
                    None => Driven::Unknown,
                };
                match self.object(node, words::object("Response"), None, path, driven)? {
                    Tree::Map(out) => out,
                    _ => IndexMap::new(),
                }
            }
            _ => IndexMap::from([(
                "value".to_owned(),
                Tree::from(node.as_str().unwrap_or_default()),
            )]),
        };
        let (_, constants) = found?;
        if !constants.is_empty() {
            let constants = constants
                .into_iter()
                .map(|(name, value)| (name, Tree::of(&Constant::new(value))));
            out.insert("parameters".to_owned(), Tree::Map(constants.collect()));
        }
        Some(Tree::Map(out))
    }

    /// What a text measures, and the parameters that it names.
    fn response_text(
        &mut self,
        node: &Node,
        text: &str,
        path: &str,
    ) -> Option<(Quantity, Vec<(String, Quantity)>)> {
        if text.trim().is_empty() {
            let complaint = Complaint::new(path, "the text is empty");
            self.complain(
                node,
                complaint.hint("as in \"max(piston.x) - min(piston.x)\""),
            );
            return None;
        }
        let root = &self.source.root;
        let catalogue = self
            .catalogue
            .take()
            .unwrap_or_else(|| Catalogue::of_file(root));
        let read = self.parameters.response(text, &catalogue);
        self.catalogue = Some(catalogue);
        match read {
            Ok(found) => found,
            Err(Misfit { at, fault }) => {
                self.complain_at(node, Some(at), fault.at(path));
                None
            }
        }
    }

    /// What a text measures, where it can be read.
    pub fn measure_of(&mut self, text: &str) -> Option<Quantity> {
        let catalogue = self.catalogue.take()?;
        let read = self.parameters.response(text, &catalogue);
        self.catalogue = Some(catalogue);
        read.ok().flatten().map(|(quantity, _)| quantity)
    }

    /// The unit of a parameter in SI; empty of a plain number, and where there is none.
    pub fn unit_of(&self, parameter: &str) -> String {
        let value = self.parameters.value(parameter);
        value.map_or_else(String::new, |value| value.unit())
    }

    /// A limit, in SI; a plain number is in the file's unit.
    pub(super) fn limit(&mut self, node: &Node, path: &str, driven: Driven) -> Option<f64> {
        self.alike_to(node, path, driven, "as the response is")
    }

    /// A number in SI, of the dimension of something else; a plain number is in the file's unit.
    pub(super) fn alike_to(
        &mut self,
        node: &Node,
        path: &str,
        driven: Driven,
        why: &str,
    ) -> Option<f64> {
        let found = match &node.kind {
            Kind::Number(number) => {
                let Driven::Parameter(wanted) = driven else {
                    return None;
                };
                let text = number.to_string();
                return match wanted.dimension() {
                    Some(dimension) => Some(self.units.derivative(dimension, 0).plain.to_si(&text)),
                    None => number.as_f64(),
                };
            }
            Kind::String(text) if is_expression(text) => self.expression(node, text, path)?,
            Kind::String(text) => match quantity(text) {
                Ok(found) => found,
                Err(fault) => {
                    self.complain(node, fault.at(path));
                    return None;
                }
            },
            Kind::Null | Kind::Bool(_) | Kind::Array(_) | Kind::Object(_) => {
                self.complain(node, wrong_kind(path, "a number", node));
                return None;
            }
        };
        let Driven::Parameter(wanted) = driven else {
            return None;
        };
        if found.is_like(&wanted) {
            return Some(found.value);
        }
        let message = format!(
            "this is {}, where {} is wanted, {why}",
            found.words(),
            wanted.words()
        );
        self.complain(node, Complaint::new(path, message));
        None
    }
}
