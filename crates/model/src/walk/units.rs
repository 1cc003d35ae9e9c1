//! Which units plain numbers of a file have, and what is wanted at each place.

use crate::dimension::{Dimension, Powers};
use crate::display::{DisplayUnits, Shown};
use crate::error::Complaint;
use crate::expression::Quantity;
use crate::node::Node;
use crate::shape::Measure;
use crate::source::Source;
use crate::units::Unit;

/// What a motion drives, or a sample samples.
#[derive(Debug, Clone, Copy)]
pub enum Driven {
    /// There is none around.
    Nothing,
    /// A quantity of a dimension.
    Dimension(Dimension),
    /// Coefficient of t^order.
    Coefficient(Dimension, usize),
    /// The value of the parameter around it.
    Parameter(Quantity),
    /// That fault is complained about elsewhere.
    Unknown,
}

impl Driven {
    /// Of the coefficient of t^order.
    pub fn derivative(self, order: usize) -> Driven {
        match self {
            Driven::Dimension(dimension) => Driven::Coefficient(dimension, order),
            Driven::Nothing | Driven::Coefficient(..) | Driven::Parameter(_) | Driven::Unknown => {
                self
            }
        }
    }
}

/// Units of plain numbers.
pub struct Units {
    /// In the order of `Dimension::NAMED`; none: SI.
    named: [Option<Unit>; Dimension::NAMED.len()],
    /// First plain number, other than zero, of each dimension.
    pub(super) plain: [Option<String>; Dimension::NAMED.len()],
}

/// The units in which messages speak: those of plain numbers.
pub fn display(node: Option<&Node>) -> DisplayUnits {
    let shown = |dimension: Dimension, otherwise: Shown| {
        let text = node
            .and_then(|node| node.get(dimension.name())?.as_str())
            .map(str::trim);
        let unit = text
            .and_then(|text| Unit::parse(text).ok())
            .filter(|unit| unit.powers == dimension.powers());
        let size = unit.and_then(|unit| unit.convert(1.0, Unit::si(dimension.powers())));
        match (text, size) {
            (Some("deg"), Some(size)) => Shown::new("°", size),
            (Some(text), Some(size)) => Shown::new(text, size),
            (_, None) | (None, Some(_)) => otherwise,
        }
    };
    let DisplayUnits {
        length,
        angle,
        mass,
        time,
    } = DisplayUnits::default();
    DisplayUnits {
        length: shown(Dimension::Length, length),
        angle: shown(Dimension::Angle, angle),
        mass: shown(Dimension::Mass, mass),
        time: shown(Dimension::Time, time),
    }
}

/// What is expected at one place.
pub struct Wanted {
    /// Its exponents.
    pub powers: Powers,
    /// Of a plain number.
    pub plain: Unit,
    /// In words.
    pub name: String,
    /// SI unit, as text.
    pub si: String,
    /// Its dimension, where that has a name.
    pub dimension: Option<Dimension>,
}

impl Units {
    /// Reads `units`; what is wrong there is complained about when its turn comes.
    pub fn read(node: Option<&Node>) -> Units {
        let named = Dimension::NAMED.map(|dimension| {
            let text = node?.get(dimension.name())?.as_str()?;
            Unit::parse(text)
                .ok()
                .filter(|unit| dimension.powers().accepts(unit.powers))
        });
        Units {
            named,
            plain: Default::default(),
        }
    }

    fn of(&self, dimension: Dimension) -> Unit {
        let named = dimension.index().and_then(|index| self.named[index]);
        named.unwrap_or_else(|| Unit::si(dimension.powers()))
    }

    /// Whether plain angles are in radians.
    pub fn in_radians(&self) -> bool {
        self.of(Dimension::Angle) == Unit::si(Dimension::Angle.powers())
    }

    /// Warns of plain numbers in radians where angles are not.
    pub fn warnings(&self, source: &Source) -> Vec<String> {
        if self.in_radians() {
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
            let Some(index) = dimension
                .index()
                .filter(|&index| self.named[index].is_none())
            else {
                continue;
            };
            let Some(path) = &self.plain[index] else {
                continue;
            };
            let (name, si) = (dimension.name(), dimension.si());
            let message = format!("a plain {name} is in {si}, although \"angle\" has another unit");
            let hint = format!("name a unit for {name:?} in units, or write it with its unit");
            warnings.push(
                source
                    .place(Complaint::new(path.as_str(), message).hint(hint))
                    .to_string(),
            );
        }
        warnings
    }

    /// What a measure wants here; `None` if that is not known.
    pub fn wanted(&self, measure: Measure, driven: Driven) -> Option<Wanted> {
        match (measure, driven) {
            (Measure::Of(dimension), _) => Some(self.derivative(dimension, 0)),
            // A plain stiffness of a contact is in SI whatever `units` names for springs.
            (Measure::LinearStiffness, _) => Some(Wanted {
                plain: Unit::si(Dimension::Stiffness.powers()),
                dimension: None,
                ..self.derivative(Dimension::Stiffness, 0)
            }),
            (Measure::Driven(order), Driven::Dimension(dimension)) => {
                Some(self.rate(dimension, order))
            }
            (Measure::DrivenCoefficient, Driven::Coefficient(dimension, order)) => {
                Some(self.derivative(dimension, order))
            }
            (Measure::Driven(_) | Measure::DrivenCoefficient, _) => None,
        }
    }

    /// A derivative by time, a plain number of it in the unit of its own dimension where it has one.
    fn rate(&self, dimension: Dimension, order: usize) -> Wanted {
        match dimension.rate(order) {
            Some(rate) => self.derivative(rate, 0),
            None => self.derivative(dimension, order),
        }
    }

    /// A derivative by time, a plain number of it in the unit of the dimension per second^order.
    pub fn derivative(&self, dimension: Dimension, order: usize) -> Wanted {
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
