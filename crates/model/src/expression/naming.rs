//! What quantities are called in messages.

use super::number::Number;
use super::quantity::{Quantity, whole};
use crate::dimension::{Dimension, Powers, powers};

/// Of power, which no number of a model is a measure of.
const POWER: Powers = powers(2, 1, -3, 0);

impl Powers {
    /// Their unit in SI, such as `m` or `N*m/rad`; empty where all are zero.
    pub fn unit(self) -> String {
        Quantity::si(1.0, self).unit()
    }
}

impl<N: Number> Quantity<N> {
    /// Its dimension, where that has a name.
    pub fn dimension(&self) -> Option<Dimension> {
        let named = Dimension::NAMED.into_iter().chain([Dimension::Frequency]);
        named
            .into_iter()
            .find(|dimension| whole(dimension.powers()) == self.exponents)
    }

    /// Its powers, where they are whole.
    pub fn whole_powers(&self) -> Option<Powers> {
        let powers = self
            .exponents
            .map(|twelfths| (twelfths % 12 == 0).then_some(twelfths / 12));
        let [Some(length), Some(mass), Some(time), Some(angle)] = powers else {
            return None;
        };
        Some(Powers {
            length,
            mass,
            time,
            angle,
        })
    }

    /// Its unit in SI; empty where it is pure.
    pub fn unit(&self) -> String {
        if let Some(dimension) = self.dimension() {
            return dimension.si().to_owned();
        }
        if self.exponents == whole(POWER) {
            return "W".to_owned();
        }
        let symbols = [(1, "kg"), (0, "m"), (2, "s"), (3, "rad")];
        let part = |sign: i32| {
            let factors = symbols
                .iter()
                .filter(|(index, _)| sign * self.exponents[*index] > 0);
            let factors = factors.map(|&(index, symbol)| {
                match f64::from(sign * self.exponents[index]) / 12.0 {
                    1.0 => symbol.to_owned(),
                    power => format!("{symbol}^{}", (power * 1e4).round() / 1e4),
                }
            });
            factors.collect::<Vec<_>>()
        };
        let (above, below) = (part(1).join("*"), part(-1));
        let above = if above.is_empty() && !below.is_empty() {
            "1".to_owned()
        } else {
            above
        };
        below
            .iter()
            .fold(above, |text, factor| format!("{text}/{factor}"))
    }

    /// What it is, in words: `a length [m]`, `a plain number`.
    pub fn words(&self) -> String {
        if self.is_pure() {
            return "a plain number".into();
        }
        match self.dimension() {
            Some(dimension) => with_article(dimension.name(), dimension.si()),
            None => format!("a quantity in {}", self.unit()),
        }
    }

    /// The factor, a power of the radian, with which it would fit.
    pub fn radians_to(&self, wanted: Powers) -> Option<String> {
        let wanted = whole(wanted);
        let lacking = f64::from(wanted[3] - self.exponents[3]) / 12.0;
        (self.exponents[..3] == wanted[..3] && !self.is_pure()).then(|| match lacking {
            1.0 => "* 1 rad".to_owned(),
            -1.0 => "/ 1 rad".to_owned(),
            power => format!(
                "* (1 rad)^{}",
                if power < 0.0 {
                    format!("({power})")
                } else {
                    format!("{power}")
                }
            ),
        })
    }
}

/// `an angular velocity [rad/s]`.
pub fn with_article(name: &str, unit: &str) -> String {
    let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) {
        "an"
    } else {
        "a"
    };
    format!("{article} {} [{unit}]", name.replace('_', " "))
}
