//! Outputs: ratios of velocities, `"leverage": "d(axle.y)/d(force.shock.length)"`, and instant centres.
//!
//! Named are places, angles, lengths and slides, which a mechanism with one degree of freedom moves together, however fast.

use crate::dimension::{Powers, powers};
use crate::formula::{Argument, Coordinate};

/// A ratio of the velocities of two quantities.
#[derive(Debug, Clone, PartialEq)]
pub struct Ratio {
    /// What is divided, and by what.
    pub quantities: [Argument; 2],
    /// Whether each is an angle.
    pub angles: [bool; 2],
}

/// A coordinate of the instant centre of two bodies, `centre(coupler, ground).x`.
#[derive(Debug, Clone, PartialEq)]
pub struct Centre {
    /// The bodies, which turn about each other there.
    pub bodies: [String; 2],
    /// Its coordinate.
    pub coordinate: Coordinate,
}

/// What an output is.
#[derive(Debug, Clone, PartialEq)]
pub enum OutputText {
    /// A ratio of velocities.
    Ratio(Ratio),
    /// Of an instant centre.
    Centre(Centre),
}

impl OutputText {
    /// Its SI unit, as columns write it.
    pub fn unit(&self) -> &'static str {
        match self {
            OutputText::Ratio(ratio) => ratio.unit(),
            OutputText::Centre(_) => "m",
        }
    }

    /// Its dimension.
    pub(crate) fn powers(&self) -> Powers {
        match self {
            OutputText::Ratio(ratio) => ratio.powers(),
            OutputText::Centre(_) => powers(1, 0, 0, 0),
        }
    }
}

impl Ratio {
    /// Its SI unit, as columns write it.
    pub fn unit(&self) -> &'static str {
        match self.angles {
            [false, true] => "m/rad",
            [true, false] => "rad/m",
            [false, false] | [true, true] => "1",
        }
    }

    /// Its dimension.
    pub(crate) fn powers(&self) -> Powers {
        let [first, second] = self.angles.map(i32::from);
        powers(second - first, 0, 0, first - second)
    }
}
