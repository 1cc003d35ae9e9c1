//! Tolerances: how far a dimension may be from its nominal value, and how parts are spread between the limits.

use serde::{Deserialize, Serialize};

/// How far a parameter may be from its value, in its SI unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Least deviation; may be above zero, as that of a bore's upper field.
    pub lower: f64,
    /// Greatest deviation, not less than `lower`.
    pub upper: f64,
    /// How parts are spread between the limits.
    pub distribution: Distribution,
    /// Coefficient a of the cost a/t of a tolerance ±t [money times the parameter's SI unit].
    pub cost: Option<f64>,
}

impl Tolerance {
    /// Half of its width, the ± of a symmetric one.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.upper - self.lower)
    }

    /// Deviation of the middle of its field.
    pub fn middle(&self) -> f64 {
        0.5 * (self.lower + self.upper)
    }
}

/// How parts are spread between their limits, symmetrically about the middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distribution {
    /// Normal, cut off at the limits.
    Normal {
        /// Standard deviations, of the normal distribution that is not cut, from the middle to each limit.
        sigma: f64,
    },
    /// All values between the limits are equally frequent.
    Uniform,
    /// Most frequent in the middle, falling off to zero at the limits.
    Triangular,
}

impl Distribution {
    /// What it is where nothing is said.
    pub const DEFAULT: Distribution = Distribution::Normal { sigma: 3.0 };
}

/// Least and greatest play to either side of a guide \[m\].
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
#[serde(from = "Limits", into = "Limits")]
pub struct Play {
    /// Least.
    pub least: f64,
    /// Greatest.
    pub most: f64,
}

impl Play {
    /// The middle of both.
    pub fn mean(&self) -> f64 {
        0.5 * (self.least + self.most)
    }
}

/// A number, or its least and its greatest value, as a file has it.
#[derive(Clone, Copy, Deserialize, Serialize)]
#[serde(untagged)]
pub(crate) enum Limits {
    One(f64),
    Both([f64; 2]),
}

impl From<Limits> for Play {
    fn from(limits: Limits) -> Self {
        let [least, most] = match limits {
            Limits::One(one) => [one, one],
            Limits::Both(both) => both,
        };
        Play { least, most }
    }
}

impl From<Play> for Limits {
    fn from(play: Play) -> Self {
        if play.least == play.most {
            Limits::One(play.least)
        } else {
            Limits::Both([play.least, play.most])
        }
    }
}

#[cfg(test)]
mod tests;
