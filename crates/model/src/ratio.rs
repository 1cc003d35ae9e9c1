//! Outputs: ratios of velocities, `"leverage": "d(axle.y)/d(force.shock.length)"`.
//!
//! Named are places, angles, lengths and slides, which a mechanism with one degree of freedom moves together, however fast.

use crate::dimension::{Powers, powers};
use crate::formula::Argument;

/// A ratio of the velocities of two quantities.
#[derive(Debug, Clone, PartialEq)]
pub struct Ratio {
    /// What is divided, and by what.
    pub quantities: [Argument; 2],
    /// Whether each is an angle.
    pub angles: [bool; 2],
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
