//! Motions: laws of time.

use serde::{Deserialize, Serialize};

/// A law of time f(t), SI (driven dimension, s, Hz, rad).
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Motion {
    /// Σ c_k t^k.
    Polynomial {
        /// c₀, c₁, c₂ …; a plain c_k is in the driven dimension's unit per second^k.
        coefficients: Vec<f64>,
    },
    /// offset + amplitude·sin(2π·frequency·t + phase).
    Harmonic {
        /// Middle of the oscillation.
        #[serde(default)]
        offset: f64,
        /// Half of its width.
        amplitude: f64,
        /// \[Hz\]
        frequency: f64,
        /// \[rad\]
        #[serde(default)]
        phase: f64,
    },
    /// A curve through (t, value); times strictly increasing, at least two.
    Table {
        /// [[t, value], …]
        #[serde(default)]
        points: Vec<[f64; 2]>,
        /// What is between and beyond them.
        #[serde(default)]
        interpolation: Interpolation,
        /// The rates at the points, one each: cubics with these slopes, whatever the interpolation.
        velocities: Option<Vec<f64>>,
    },
    /// start + velocity·t.
    ConstantVelocity {
        /// Value at t = 0.
        #[serde(default)]
        start: f64,
        /// Rate at t = 0.
        velocity: f64,
    },
    /// start + velocity·t + acceleration·t²/2.
    ConstantAcceleration {
        /// Value at t = 0.
        #[serde(default)]
        start: f64,
        /// Rate at t = 0.
        #[serde(default)]
        velocity: f64,
        /// Rate of the rate.
        acceleration: f64,
    },
    /// A rise whose acceleration is a sine.
    Cycloidal(Rise),
    /// A rise by a polynomial of the fifth order.
    #[serde(rename = "polynomial_3_4_5")]
    Polynomial345(Rise),
    /// A rise by a polynomial of the seventh order.
    #[serde(rename = "polynomial_4_5_6_7")]
    Polynomial4567(Rise),
    /// A rise by sines of two paces.
    ModifiedSine(Rise),
    /// A rise by a trapezoid of acceleration with sines for its flanks.
    ModifiedTrapezoid(Rise),
    /// A rise with constant acceleration, velocity and deceleration.
    TrapezoidalVelocity(Paced),
    /// The same with limited jerk.
    SCurve(Paced),
    /// Rises and dwells, one after the other.
    Sequence {
        /// Value before.
        #[serde(default)]
        start: f64,
        /// When it begins \[s\].
        #[serde(default)]
        begin: f64,
        /// Rises and dwells in their order.
        segments: Vec<Segment>,
        /// How often all of them are gone through; once where nothing is said.
        repeat: Option<usize>,
    },
}

/// What is between the points of a table, and beyond them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Interpolation {
    /// Natural cubic spline, straight beyond the ends.
    #[default]
    Natural,
    /// Straight lines.
    Linear,
    /// Cubics that do not overshoot, straight beyond the ends.
    Monotone,
    /// Periodic cubic spline.
    Periodic,
}

/// The law of a rise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RiseLaw {
    /// Acceleration as a sine.
    Cycloidal,
    /// 10 z³ − 15 z⁴ + 6 z⁵.
    #[serde(rename = "polynomial_3_4_5")]
    Polynomial345,
    /// 35 z⁴ − 84 z⁵ + 70 z⁶ − 20 z⁷.
    #[serde(rename = "polynomial_4_5_6_7")]
    Polynomial4567,
    /// Sines of two paces.
    ModifiedSine,
    /// A trapezoid of acceleration with sines for its flanks.
    ModifiedTrapezoid,
    /// Constant acceleration, velocity, deceleration.
    TrapezoidalVelocity,
    /// The same with limited jerk.
    SCurve,
}

/// A rise between two dwells: from `start` by `rise`, or to `end`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Rise {
    /// Value before.
    pub start: f64,
    /// How far it goes.
    pub rise: Option<f64>,
    /// Value after, instead.
    pub end: Option<f64>,
    /// When it begins \[s\].
    pub begin: f64,
    /// How long it takes \[s\].
    pub duration: f64,
}

/// A rise of which is said how long it takes, or what it may reach.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Paced {
    /// Value before.
    pub start: f64,
    /// How far it goes.
    pub rise: Option<f64>,
    /// Value after, instead.
    pub end: Option<f64>,
    /// When it begins \[s\].
    pub begin: f64,
    /// How long it takes \[s\].
    pub duration: Option<f64>,
    /// Share of it in which it speeds up, and of that in which it slows down; a third.
    pub ramp: Option<f64>,
    /// Share of a ramp in which the acceleration changes, of an s-curve; a half.
    pub rounding: Option<f64>,
    /// The greatest speed, instead of a duration.
    pub velocity: Option<f64>,
    /// The greatest acceleration.
    pub acceleration: Option<f64>,
    /// The greatest jerk, of an s-curve.
    pub jerk: Option<f64>,
}

/// A part of a sequence: a rise by a law, or a dwell.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
pub struct Segment {
    /// How it rises.
    pub law: Option<RiseLaw>,
    /// How far it goes.
    pub rise: Option<f64>,
    /// Value after, instead.
    pub end: Option<f64>,
    /// How long it takes \[s\].
    pub duration: Option<f64>,
    /// As of [`Paced`].
    pub ramp: Option<f64>,
    /// As of [`Paced`].
    pub rounding: Option<f64>,
    /// How long it stays where it is \[s\].
    pub dwell: Option<f64>,
}

/// From `start` by `rise`, or to `end`.
fn height(start: f64, rise: Option<f64>, end: Option<f64>) -> f64 {
    match (rise, end) {
        (Some(rise), _) => rise,
        (None, Some(end)) => end - start,
        (None, None) => 0.0,
    }
}

impl Rise {
    /// How far it goes.
    pub fn height(&self) -> f64 {
        height(self.start, self.rise, self.end)
    }
}

impl Paced {
    /// How far it goes.
    pub fn height(&self) -> f64 {
        height(self.start, self.rise, self.end)
    }
}

impl Segment {
    /// How far it goes from a value.
    pub fn height(&self, from: f64) -> f64 {
        height(from, self.rise, self.end)
    }
}
