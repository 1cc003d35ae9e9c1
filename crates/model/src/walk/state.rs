//! Integrated states: their rates may name each other, so their dimensions are found one after the other.

use crate::tree::Tree;

use super::table::EntryColumn;
use super::{Early, Walk};
use crate::dimension::{Dimension, Powers};
use crate::error::Complaint;
use crate::expression::{Binary, Misfit, Quantity, is_expression};
use crate::node::{Node, join, members};
use crate::state::State;
use crate::units::{Unit, split_quantity};
use crate::words;

impl Walk<'_> {
    /// Reads the states, which formulas anywhere may name.
    pub(super) fn read_states(&mut self, node: Option<&Node>) {
        let members = members(node).filter(|(_, one)| one.node.as_str().is_none());
        let members: Vec<_> = members.map(|(name, one)| (name, &one.node)).collect();
        for (name, node) in &members {
            self.states.push(Early {
                name: (*name).clone(),
                powers: self.said(node),
                state: None,
            });
        }
        // each round finds what follows from those before
        loop {
            let mut found = false;
            for (index, (_, node)) in members.iter().enumerate() {
                if self.states[index].powers.is_some() {
                    continue;
                }
                self.catalogue = None;
                let rate = node.get("rate").and_then(Node::as_str).unwrap_or_default();
                if let Ok(Some((moving, _))) = self.moving(rate) {
                    let powers = by_time(&moving.quantity.with_value(0.0));
                    found |= powers.is_some();
                    self.states[index].powers = powers;
                }
            }
            if !found {
                break;
            }
        }
        self.catalogue = None;
        for (index, (name, node)) in members.iter().enumerate() {
            let state = self.state_of(node, &join("states", name));
            self.states[index].state = state;
        }
    }

    /// The dimension that a start with a unit says.
    fn said(&self, node: &Node) -> Option<Powers> {
        let text = node.get("start")?.as_str()?;
        if is_expression(text) {
            return None;
        }
        Some(Unit::parse(split_quantity(text)?.1).ok()?.powers)
    }

    /// A state that was read before.
    pub(super) fn state(&mut self, node: &Node, path: &str) -> Option<Tree> {
        let known = path.strip_prefix("states.").and_then(|name| {
            let mut states = self.states.iter();
            states.find(|one| one.name == name)
        });
        let state = match known {
            Some(early) => early.state.clone()?,
            // a printer looks at one alone
            None => self.state_of(node, path)?,
        };
        Some(Tree::of(&state))
    }

    fn state_of(&mut self, node: &Node, path: &str) -> Option<State> {
        let before = self.faults();
        self.object(
            node,
            words::object("State"),
            None,
            path,
            super::Driven::Nothing,
        )?;
        let (rate, place) = (node.get("rate")?, join(path, "rate"));
        let text = rate.as_str()?;
        if !is_expression(text) {
            let complaint = Complaint::new(place, "the rate of a state is an expression");
            self.complain(
                rate,
                complaint.hint("as in \"rate\": \"=target - rotor.omega\""),
            );
            return None;
        }
        let (moving, constants) = match self.moving(text) {
            Ok(read) => read?,
            Err(_) if self.names_unknown(text) => {
                let complaint = Complaint::new(place, "the dimension of this state is not known");
                let hint = "write \"start\" with its unit, as in \"0 rad\"";
                self.complain(rate, complaint.hint(hint));
                return None;
            }
            Err(Misfit { at, fault }) => {
                self.complain_at(rate, Some(at), fault.at(place));
                return None;
            }
        };
        let whole = moving.quantity.with_value(0.0);
        let Some(powers) = by_time(&whole) else {
            let message = format!("this is {}, which no state has for its rate", whole.words());
            self.complain(rate, Complaint::new(place, message));
            return None;
        };
        let unit = Quantity::si(0.0, powers);
        let plain = unit
            .dimension()
            .map(|one: Dimension| self.units().derivative(one, 0).plain);
        let column = EntryColumn {
            powers,
            plain: Some(plain.unwrap_or(Unit::si(powers))),
        };
        let start = match node.get("start") {
            Some(start) => self.entry(start, column, &join(path, "start")),
            None => Some(0.0),
        };
        let mut formula = crate::Formula::new(text);
        formula.parameters = self.constants(constants, &place);
        let state = State {
            rate: formula,
            start: start.unwrap_or_default(),
            unit: unit.unit(),
        };
        (self.faults() == before).then_some(state)
    }

    /// Whether a text names a state whose dimension is not known.
    fn names_unknown(&self, text: &str) -> bool {
        let mut unknown = self.states.iter().filter(|one| one.powers.is_none());
        unknown.any(|one| text.contains(&format!("state.{}", one.name)))
    }
}

/// The dimension of what has this rate.
fn by_time(rate: &Quantity) -> Option<Powers> {
    let second = Quantity::si(1.0, Dimension::Time.powers());
    rate.two(&second, Binary::Multiply).ok()?.whole_powers()
}
