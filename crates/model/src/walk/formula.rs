//! Expressions of what moves, where forces are wanted.

use indexmap::IndexMap;

use crate::tree::Tree;

use super::{Driven, Walk};
use crate::compiled_formula::{Arguments, misfit};
use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::event::{Event, Sides};
use crate::expression::{Fault, Misfit, Moved, Quantity, is_expression};
use crate::formula::Formula;
use crate::node::{Kind, Node};
use crate::response::{Catalogue, Constant};
use crate::shape::Measure;
use crate::words;

impl Walk<'_> {
    /// A quantity, or a motion of it.
    pub(super) fn varying(&mut self, node: &Node, of: Dimension, path: &str) -> Option<Tree> {
        let driven = Driven::Dimension(of);
        match node.kind {
            Kind::Object(_) => self.tagged(node, words::kinds("Motion"), path, driven),
            _ => {
                let value = self.quantity(node, Measure::Of(of), path, driven);
                value.map(Tree::Number)
            }
        }
    }

    /// A formula, or its fault; nothing where a text names nothing that moves.
    pub(super) fn formula(
        &mut self,
        node: &Node,
        wanted: Dimension,
        path: &str,
    ) -> Option<Option<Tree>> {
        if matches!(node.kind, Kind::Object(_)) && node.get("of").is_some() {
            return Some(self.table_of(node, wanted, path));
        }
        let Kind::String(text) = &node.kind else {
            return None;
        };
        if !is_expression(text) {
            return None;
        }
        let read = self.moving(text);
        match read {
            Ok(Some((moving, _))) if !moving.has_arguments() => None,
            Ok(Some((moving, constants))) => {
                if let Some(complaint) = misfit(&moving, wanted) {
                    if self.is_of_parameters(text, wanted) {
                        return None;
                    }
                    let path = path.to_owned();
                    self.complain(node, Complaint { path, ..complaint });
                    return Some(None);
                }
                let parameters = self.constants(constants, path);
                let formula = text.clone();
                Some(Some(Tree::of(&Formula {
                    formula,
                    parameters,
                    table: None,
                })))
            }
            Ok(None) => None,
            // what is wrong with a table is reported there
            Err(_) if self.has_faulty_function() => Some(None),
            Err(_) if self.parameters.evaluate(text).is_ok() => None,
            Err(Misfit { at, fault }) if names_a_part(text) || self.names_time(text) => {
                self.complain_at(node, Some(at), fault.at(path));
                Some(None)
            }
            Err(_) => None,
        }
    }

    /// Whether a text that has no meaning as a formula has one where `t` is the tonne, as in `=9.81 kN/t*mass`.
    fn is_of_parameters(&mut self, text: &str, wanted: Dimension) -> bool {
        let value = self.parameters.evaluate(text);
        let fits = |value: Quantity| !value.is_pure() && value.fits(wanted.powers());
        value.is_ok_and(|value| value.is_some_and(fits))
    }

    /// Whether a text names time.
    fn names_time(&self, text: &str) -> bool {
        let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
        words.any(|word| ["t", "time"].contains(&word) && !self.parameters.has(word))
    }

    /// An event, or nothing where it is faulty.
    pub(super) fn event(&mut self, node: &Node, path: &str) -> Option<Tree> {
        let text = self.text(node, path)?;
        let said = |complaint: Complaint| Complaint {
            path: path.to_owned(),
            ..complaint
        };
        let sides = match Sides::of(&text) {
            Ok(sides) => sides,
            Err(complaint) => {
                self.complain(node, said(complaint));
                return None;
            }
        };
        match self.moving(&sides.step()) {
            Ok(Some((moving, _))) if !moving.has_arguments() => {
                let complaint = Complaint::new(path, "nothing in this event moves");
                let hint = "it names what moves, or time, as in \"time >= 1 s\"";
                self.complain(node, complaint.hint(hint));
                None
            }
            Ok(Some((_, constants))) => {
                let parameters = self.constants(constants, path);
                let event = text;
                Some(Tree::of(&Event { event, parameters }))
            }
            Ok(None) => None,
            // what is wrong with a table is reported there
            Err(_) if self.has_faulty_function() => None,
            Err(Misfit { at, fault }) => {
                // The sides of an event are compared by their difference.
                let message = fault.message.replace("be subtracted", "be compared");
                let fault = Fault { message, ..fault };
                self.complain_at(node, Some(sides.place(at)), fault.at(path));
                None
            }
        }
    }

    /// An expression of what moves, and the parameters that it names; `None` if one of these has no value.
    pub(super) fn moving(&mut self, text: &str) -> Result<Moved, Misfit> {
        let root = &self.source.root;
        let (tables, inputs, states) = (&self.tables, &self.inputs, &self.states);
        let catalogue = self.catalogue.take().unwrap_or_else(|| {
            let known = tables.iter();
            let known = known.map(|(name, table, _)| {
                let columns = table.as_ref().and_then(|table| table.columns().ok());
                (name.clone(), columns.unwrap_or_default())
            });
            let inputs = inputs.iter().filter_map(|(name, input)| {
                let powers = crate::table::unit(&input.as_ref()?.unit).ok()?.powers;
                Some((name.clone(), powers))
            });
            let states = states.iter();
            let states = states.filter_map(|one| Some((one.name.clone(), one.powers?)));
            Catalogue::of_file(root)
                .with_tables(known.collect())
                .with_inputs(inputs.collect())
                .with_states(states.collect())
        });
        let read = self.parameters.moving(text, &Arguments::of(&catalogue));
        self.catalogue = Some(catalogue);
        if let Ok(Some((moving, _))) = &read {
            for table in moving.program.tables() {
                if let Some((.., is_used)) = self.tables.get_mut(table) {
                    *is_used = true;
                }
            }
        }
        read
    }

    /// The parameters of a formula, which are numbers of the model like any other.
    pub(super) fn constants(
        &mut self,
        constants: Vec<(String, Quantity)>,
        path: &str,
    ) -> IndexMap<String, Constant> {
        for (name, _) in &constants {
            let place = format!("{path}.parameters.{name}");
            self.record(&format!("={name}"), &place, || 1.0);
        }
        let constants = constants.into_iter();
        constants
            .map(|(name, value)| (name, Constant::new(value)))
            .collect()
    }
}

/// Whether a text names something by its owner, as in `crank.angle`, which no parameter is.
fn names_a_part(text: &str) -> bool {
    let is_letter = |c: Option<char>| c.is_some_and(|c| c.is_alphabetic() || c == '_');
    let dotted = text.match_indices('.').any(|(at, _)| {
        let before = text[..at].chars().rev();
        let word: Vec<char> = before
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect();
        is_letter(word.last().copied()) && is_letter(text[at + 1..].chars().next())
    });
    dotted || text.contains('\'')
}
