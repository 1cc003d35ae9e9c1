//! Reductions: how what changes along a run becomes one number.

use super::guess::Guess;
use super::number::Binary;
use super::quantity::Quantity;
use crate::dimension::Powers;

/// How many values become one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reduction {
    /// The greatest.
    Max,
    /// The smallest.
    Min,
    /// The mean over time; of contacts and events the plain one.
    Mean,
    /// The root of the mean square over time.
    Rms,
    /// The greatest minus the smallest.
    Range,
    /// The integral over time.
    Integral,
    /// The first.
    First,
    /// The last.
    Last,
    /// Where an equation first holds.
    At,
    /// The time of the greatest.
    ArgMax,
    /// The time of the smallest.
    ArgMin,
    /// How many contacts or events there are, or how often an equation holds.
    Count,
    /// The sum over contacts or events.
    Sum,
}

impl Reduction {
    /// Every one, in the order in which the documentation lists them.
    pub const ALL: [Reduction; 13] = [
        Reduction::Max,
        Reduction::Min,
        Reduction::Mean,
        Reduction::Rms,
        Reduction::Range,
        Reduction::Integral,
        Reduction::First,
        Reduction::Last,
        Reduction::At,
        Reduction::ArgMax,
        Reduction::ArgMin,
        Reduction::Count,
        Reduction::Sum,
    ];

    /// How it is written.
    pub const fn word(self) -> &'static str {
        self.row().0
    }

    /// Whether it can be taken of contacts and events.
    pub(super) fn is_of_lists(self) -> bool {
        self.row().1
    }

    const fn row(self) -> (&'static str, bool) {
        match self {
            Reduction::Max => ("max", true),
            Reduction::Min => ("min", true),
            Reduction::Mean => ("mean", true),
            Reduction::Rms => ("rms", false),
            Reduction::Range => ("range", true),
            Reduction::Integral => ("integral", false),
            Reduction::First => ("first", true),
            Reduction::Last => ("last", true),
            Reduction::At => ("at", false),
            Reduction::ArgMax => ("argmax", false),
            Reduction::ArgMin => ("argmin", false),
            Reduction::Count => ("count", true),
            Reduction::Sum => ("sum", true),
        }
    }

    /// The dimension of the result.
    pub(super) fn quantity(self, of: Quantity<Guess>) -> Quantity<Guess> {
        let time = Powers {
            time: 1,
            ..Powers::default()
        };
        let time = Quantity::si(1.0, time).with_value(Guess(None));
        match self {
            Reduction::Integral => of.two(&time, Binary::Multiply).unwrap_or(of),
            Reduction::ArgMax | Reduction::ArgMin => time,
            Reduction::Count => Quantity::plain(1.0).with_value(Guess(None)),
            Reduction::Max
            | Reduction::Min
            | Reduction::Mean
            | Reduction::Rms
            | Reduction::Range
            | Reduction::First
            | Reduction::Last
            | Reduction::At
            | Reduction::Sum => of.with_value(Guess(None)),
        }
    }
}
