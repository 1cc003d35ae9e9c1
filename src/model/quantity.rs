//! Numbers with units: a plain number in the unit that `units` names for its dimension, or text that brings its own.

use super::dimension::{Dimension, Powers};
use super::node::{Kind, Node};
use super::source::Source;
use super::units::{Unit, UnitFault, split_quantity};
use super::validate::{Walk, wrong_kind};
use crate::error::Complaint;

/// What a motion drives, or a sample samples.
#[derive(Debug, Clone, Copy)]
pub(super) enum Driven {
    Nothing,
    Dimension(Dimension),
    /// Coefficient of t^order.
    Coefficient(Dimension, usize),
    /// That fault is complained about elsewhere.
    Unknown,
}

impl Driven {
    /// Of the coefficient of t^order.
    pub fn derivative(self, order: usize) -> Driven {
        match self {
            Driven::Dimension(dimension) => Driven::Coefficient(dimension, order),
            Driven::Nothing | Driven::Coefficient(..) | Driven::Unknown => self,
        }
    }
}

/// Units of plain numbers.
pub(super) struct Units {
    /// In the order of `Dimension::NAMED`; none: SI.
    named: [Option<Unit>; Dimension::NAMED.len()],
    /// First plain number, other than zero, of each dimension.
    plain: [Option<String>; Dimension::NAMED.len()],
}

/// What is expected at one place.
struct Wanted {
    powers: Powers,
    /// Of a plain number.
    plain: Unit,
    /// In words.
    name: String,
    /// SI unit, as text.
    si: String,
    dimension: Option<Dimension>,
}

impl Units {
    /// Reads `units`; what is wrong there is complained about when its turn comes.
    pub fn read(node: Option<&Node>) -> Units {
        let named = Dimension::NAMED.map(|dimension| {
            let text = node?.get(dimension.name())?.as_str()?;
            Unit::parse(text).ok().filter(|unit| dimension.powers().accepts(unit.powers))
        });
        Units { named, plain: Default::default() }
    }

    fn of(&self, dimension: Dimension) -> Unit {
        let named = dimension.index().and_then(|index| self.named[index]);
        named.unwrap_or_else(|| Unit::si(dimension.powers()))
    }

    /// Warns of plain numbers in radians where angles are not.
    pub fn warnings(&self, source: &Source) -> Vec<String> {
        let angle = Dimension::Angle;
        if self.of(angle) == Unit::si(angle.powers()) {
            return Vec::new();
        }
        let angular = [
            Dimension::AngularVelocity,
            Dimension::AngularAcceleration,
            Dimension::AngularStiffness,
            Dimension::AngularDamping,
        ];
        let mut warnings = Vec::new();
        for dimension in angular {
            let Some(index) = dimension.index().filter(|&index| self.named[index].is_none()) else { continue };
            let Some(path) = &self.plain[index] else { continue };
            let (name, si) = (dimension.name(), dimension.si());
            let message = format!("a plain {name} is in {si}, although \"angle\" has another unit");
            let hint = format!("name a unit for {name:?} in units, or write it with its unit");
            warnings.push(source.place(Complaint::new(path.as_str(), message).hint(hint)).to_string());
        }
        warnings
    }

    /// What a keyword `x-dimension` wants here; none where that is not known.
    fn wanted(&self, keyword: &str, driven: Driven) -> Option<Wanted> {
        let (dimension, order) = match (keyword, driven) {
            ("driven", Driven::Dimension(dimension)) => (dimension, 0),
            ("driven velocity", Driven::Dimension(dimension)) => return Some(self.rate(dimension, 1)),
            ("driven acceleration", Driven::Dimension(dimension)) => return Some(self.rate(dimension, 2)),
            ("driven coefficient", Driven::Coefficient(dimension, order)) => (dimension, order),
            _ => (Dimension::from_name(keyword)?, 0),
        };
        Some(self.derivative(dimension, order))
    }

    /// A derivative by time, a plain number of it in the unit of its own dimension where it has one.
    fn rate(&self, dimension: Dimension, order: usize) -> Wanted {
        match dimension.rate(order) {
            Some(rate) => self.derivative(rate, 0),
            None => self.derivative(dimension, order),
        }
    }

    /// A derivative by time, a plain number of it in the unit of the dimension per second^order.
    fn derivative(&self, dimension: Dimension, order: usize) -> Wanted {
        let seconds = i32::try_from(order).unwrap_or(i32::MAX / 2);
        let name = match (dimension.rate(order), order) {
            (Some(rate), _) => rate.name().replace('_', " "),
            (None, 1) => format!("{} per second", dimension.name()),
            (None, _) => format!("{} per second^{order}", dimension.name()),
        };
        let si = match (dimension.rate(order), order) {
            (Some(rate), _) => rate.si().to_owned(),
            (None, 1) => format!("{}/s", dimension.si()),
            (None, _) => format!("{}/s^{order}", dimension.si()),
        };
        Wanted {
            powers: dimension.powers().per_second(seconds),
            plain: self.of(dimension).per_second(seconds),
            name,
            si,
            dimension: (order == 0).then_some(dimension),
        }
    }
}

impl Walk<'_> {
    /// The quantity in SI units, or none and a complaint.
    pub(super) fn quantity(&mut self, node: &Node, keyword: &str, path: &str, driven: Driven) -> Option<f64> {
        let wanted = self.units.wanted(keyword, driven);
        match &node.kind {
            Kind::Number(number) => {
                let wanted = wanted?;
                let text = number.to_string();
                if let Some(index) = wanted.dimension.and_then(Dimension::index)
                    && number.as_f64() != Some(0.0)
                {
                    self.units.plain[index].get_or_insert_with(|| path.to_owned());
                }
                self.finite(node, wanted.plain.to_si(&text), path)
            }
            Kind::String(text) if is_expression(text) => self.reserved(node, path),
            Kind::String(text) => {
                let wanted = wanted?;
                let Some((number, unit)) = split_quantity(text) else {
                    let hint = format!("a number, or text such as \"5 {}\"", wanted.si);
                    self.complain(node, Complaint::new(path, "this does not begin with a number").hint(hint));
                    return None;
                };
                let unit = self.checked_unit(node, unit, &wanted, path)?;
                self.finite(node, unit.to_si(number), path)
            }
            Kind::Null | Kind::Bool(_) | Kind::Array(_) | Kind::Object(_) => {
                let mut complaint = wrong_kind(path, "a number", node);
                complaint.hint = wanted.map(|wanted| format!("or text with a unit, such as \"5 {}\"", wanted.si));
                self.complain(node, complaint);
                None
            }
        }
    }

    /// A number that has no unit.
    pub(super) fn plain_number(&mut self, node: &Node, path: &str) -> Option<f64> {
        match &node.kind {
            Kind::Number(number) => number.as_f64(),
            Kind::String(text) if is_expression(text) => self.reserved(node, path),
            Kind::Null | Kind::Bool(_) | Kind::String(_) | Kind::Array(_) | Kind::Object(_) => {
                self.complain(node, wrong_kind(path, "a plain number", node));
                None
            }
        }
    }

    /// Complains about a unit of plain numbers, where it is none.
    pub(super) fn unit(&mut self, node: &Node, text: &str, dimension: Dimension, path: &str) {
        let wanted = self.units.derivative(dimension, 0);
        self.checked_unit(node, text, &wanted, path);
    }

    fn checked_unit(&mut self, node: &Node, text: &str, wanted: &Wanted, path: &str) -> Option<Unit> {
        let text = super::node::excerpt(text);
        let such = format!("such as {:?}", wanted.si);
        let (message, hint) = match Unit::parse(&text) {
            Ok(unit) if wanted.powers.accepts(unit.powers) => return Some(unit),
            Ok(_) => (format!("{text:?} is not a unit of {}", wanted.name), such),
            Err(UnitFault::Missing) => (format!("the unit is missing, a unit of {}", wanted.name), such),
            Err(UnitFault::Unknown { symbol, nearest }) => {
                let near = nearest.map(|near| format!("did you mean {near:?}?"));
                (
                    format!("unknown unit {symbol:?}"),
                    near.unwrap_or_else(|| format!("{} is wanted, {such}", wanted.name)),
                )
            }
            Err(UnitFault::Malformed) => (format!("{text:?} cannot be read as a unit"), such),
            Err(UnitFault::TooLarge) => (format!("{text:?} is too much of a unit"), such),
        };
        self.complain(node, Complaint::new(path, message).hint(hint));
        None
    }

    fn reserved(&mut self, node: &Node, path: &str) -> Option<f64> {
        let message = "text that begins with \"=\" is reserved for expressions, which are not built yet";
        self.complain(node, Complaint::new(path, message).hint("write a number, or text with a unit"));
        None
    }

    fn finite(&mut self, node: &Node, number: f64, path: &str) -> Option<f64> {
        if number.is_finite() {
            return Some(number);
        }
        self.complain(node, Complaint::new(path, "the number is too large for a double"));
        None
    }
}

fn is_expression(text: &str) -> bool {
    text.trim_start().starts_with('=')
}
