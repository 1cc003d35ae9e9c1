//! Events of the motion at which joints close and open: `"from": "door.angle >= 90 deg"`.
//!
//! ```text
//! a >= b, a <= b      true from where the one comes to the other      step(a − b), step(b − a)
//! a reaches b         where the one passes the other, from any side   step(a − b)
//! ```
//!
//! Both sides are expressions as forces have them. As a step it has a jump, which a motion locates like any other.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use crate::error::Complaint;
use crate::formula::Formula;
use crate::response::{Constant, self_contained};

/// An event of the motion.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Event {
    /// As the file writes it, `door.angle >= 90 deg`.
    pub event: String,
    /// The parameters that it names.
    #[serde(default)]
    pub parameters: IndexMap<String, Constant>,
}

/// How the sides of an event are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Comparison {
    AtLeast,
    AtMost,
    Reaches,
}

const RELATIONS: [(&str, Comparison); 5] = [
    (">=", Comparison::AtLeast),
    ("≥", Comparison::AtLeast),
    ("<=", Comparison::AtMost),
    ("≤", Comparison::AtMost),
    (" reaches ", Comparison::Reaches),
];

/// Before the first side, between both, and behind the second.
const STEP: [&str; 3] = ["=step((", ")-(", "))"];

/// The two sides of an event, as it is written.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sides<'t> {
    text: &'t str,
    /// Where the relation stands, and where it ends.
    relation: (usize, usize),
    is: Comparison,
}

impl<'t> Sides<'t> {
    /// Those of a text.
    ///
    /// # Errors
    /// Where there is not one relation.
    pub fn of(text: &'t str) -> Result<Self, Complaint> {
        let found = RELATIONS.iter().flat_map(|&(word, is)| {
            let places = text.match_indices(word);
            places.map(move |(at, word)| ((at, at + word.len()), is))
        });
        let found: Vec<_> = found.collect();
        let [(relation, is)] = found[..] else {
            let message = match found.len() {
                0 => "an event compares two expressions",
                _ => "an event compares two expressions once",
            };
            return Err(Complaint::new("", message)
                .hint("with >=, <= or reaches, as in \"door.angle >= 90 deg\""));
        };
        let sides = Sides { text, relation, is };
        if sides.sides().iter().any(|side| side.trim().is_empty()) {
            let said = Complaint::new("", "one side of this event is empty");
            return Err(said.hint("as in \"door.angle >= 90 deg\""));
        }
        Ok(sides)
    }

    fn sides(&self) -> [&'t str; 2] {
        [&self.text[..self.relation.0], &self.text[self.relation.1..]]
    }

    /// The expression that is 1 where the event has happened, else 0.
    pub fn step(&self) -> String {
        let [mut first, mut second] = self.sides();
        if self.is == Comparison::AtMost {
            std::mem::swap(&mut first, &mut second);
        }
        let [before, between, behind] = STEP;
        format!("{before}{first}{between}{second}{behind}")
    }

    /// Where a byte of that expression stands in the text.
    pub fn place(&self, at: usize) -> usize {
        let [before, between, _] = STEP;
        let [first, second] = self.sides().map(str::len);
        let (early, late) = match self.is {
            Comparison::AtMost => ((second, self.relation.1), (first, 0)),
            Comparison::AtLeast | Comparison::Reaches => ((first, 0), (second, self.relation.1)),
        };
        let at = at.saturating_sub(before.len());
        match at.checked_sub(early.0 + between.len()) {
            Some(at) => late.1 + at.min(late.0),
            None => early.1 + at.min(early.0),
        }
    }
}

impl Event {
    /// An event that names no parameters.
    pub fn new(event: impl Into<String>) -> Self {
        Event {
            event: event.into(),
            parameters: IndexMap::new(),
        }
    }

    /// Whether it happens from whichever side it is come to.
    pub fn is_either_way(&self) -> bool {
        Sides::of(&self.event).is_ok_and(|sides| sides.is == Comparison::Reaches)
    }

    /// The formula that is 1 where it has happened, else 0.
    ///
    /// # Errors
    /// What is wrong with the text, at no path.
    pub fn formula(&self) -> Result<Formula, Complaint> {
        Ok(Formula {
            formula: Sides::of(&self.event)?.step(),
            parameters: self.parameters.clone(),
            table: None,
        })
    }

    /// With the values of parameters in the place of their names.
    pub(crate) fn self_contained(&self) -> String {
        let Ok(sides) = Sides::of(&self.event) else {
            return self.event.clone();
        };
        let (from, to) = sides.relation;
        let [first, second] = sides
            .sides()
            .map(|side| self_contained(side, &self.parameters));
        format!("{first}{}{second}", &self.event[from..to])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_stand_where_they_are_written() {
        for text in ["a >= bcd", "a <= bcd", "ab reaches c", "a ≥ b"] {
            let sides = Sides::of(text).expect("one relation");
            let step = sides.step();
            for (at, letter) in text.char_indices().filter(|(_, c)| "abcd".contains(*c)) {
                if sides.relation.0 <= at && at < sides.relation.1 {
                    continue;
                }
                // behind the name of the function
                let found = step[7..].find(letter).expect("the same letters") + 7;
                assert_eq!(sides.place(found), at, "{letter} of {text} in {step}");
            }
        }
        assert!(Sides::of("a > b").is_err() && Sides::of("a >= b >= c").is_err());
    }
}
