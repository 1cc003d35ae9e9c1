//! Strengths of loads: laws of time, and functions of what moves.
//!
//! ```text
//! f = f(s₁ … s_k)          s quantities of the motion (see [`super::quantity`])
//! ∂f/∂q = Σ ∂f/∂s ∂s/∂q,   ∂f/∂v = Σ ∂f/∂s ∂s/∂v
//! ```
//!
//! A function may have kinks and jumps, and is smooth on either **side** of each. That side holds which [`Kinematics::sides`]
//! says, in a motion between its events, else the one on which the values are.

use super::quantity::{Measured, Quantity};
use super::span::BOTH;
use super::{Axis, BodyId, Kinematics};
use crate::motion::Law;
use std::fmt::Debug;
use std::ops::Range;
use std::sync::Arc;

/// Inputs that a formula takes at most.
pub const MOST_ARGUMENTS: usize = 16;

/// A function of some numbers with kinks, evaluated without allocation. `held` has a side for each kink; with none the values
/// say which.
pub trait Function: Debug + Send + Sync {
    /// f
    fn value(&self, inputs: &[f64], held: Option<&[i32]>) -> f64;
    /// ∂f/∂s of the input with this index.
    fn slope(&self, inputs: &[f64], index: usize, held: Option<&[i32]>) -> f64;
    /// Number of kinks: none of a smooth function.
    fn kinks(&self) -> usize {
        0
    }
    /// The sides on which the kinks are.
    fn take_sides(&self, _inputs: &[f64], _sides: &mut [i32]) {}
    /// How far beyond the sides that are held the kinks are, by their scales: the largest [–].
    fn beyond(&self, _inputs: &[f64], _held: &[i32], _scales: &[f64]) -> f64 {
        0.0
    }
    /// The name of a table that is looked at beyond all of its points; empty of one without a name.
    fn outside(&self, _inputs: &[f64]) -> Option<&str> {
        None
    }
}

/// A function of what moves.
#[derive(Debug, Clone)]
pub struct Formula {
    /// Its arithmetic.
    pub function: Arc<dyn Function>,
    /// What it takes: with the index of its input each quantity, of which an input is the sum.
    pub arguments: Vec<(usize, Quantity)>,
    /// Index of its first kink in [`Kinematics::sides`].
    pub first: usize,
    /// Index of the force that it is of; behind all forces those of states.
    pub force: usize,
}

/// A law of time, or a function of what moves.
#[derive(Debug, Clone)]
pub enum Strength {
    /// f(t)
    OfTime(Law),
    /// f(t, q, v)
    OfMotion(Arc<Formula>),
    /// Σ cᵢ fᵢ
    Sum(Vec<(f64, Strength)>),
}

impl Strength {
    /// Its value in SI.
    pub fn value(&self, at: &Kinematics) -> f64 {
        match self {
            Strength::OfTime(law) => law.jet(at.time)[0],
            Strength::OfMotion(formula) => formula.value(at),
            Strength::Sum(parts) => parts.iter().map(|(by, part)| by * part.value(at)).sum(),
        }
    }

    /// Its value in SI, where time alone says it.
    pub fn of_time(&self, time: f64) -> Option<f64> {
        match self {
            Strength::OfTime(law) => Some(law.jet(time)[0]),
            Strength::OfMotion(_) => None,
            Strength::Sum(parts) => {
                let values = parts
                    .iter()
                    .map(|(by, part)| Some(by * part.of_time(time)?));
                values.sum()
            }
        }
    }

    /// The coordinates that change it.
    pub fn columns(&self) -> Vec<(BodyId, Axis)> {
        match self {
            Strength::OfTime(_) => Vec::new(),
            Strength::OfMotion(formula) => formula.columns(),
            Strength::Sum(parts) => parts.iter().flat_map(|(_, part)| part.columns()).collect(),
        }
    }

    /// Tells its derivatives by these coordinates and by their rates, one by one.
    pub fn each_slope(&self, at: &Kinematics, mut tell: impl FnMut([f64; 2])) {
        self.tell_slopes(at, 1.0, &mut tell);
    }

    fn tell_slopes(&self, at: &Kinematics, by: f64, tell: &mut impl FnMut([f64; 2])) {
        match self {
            Strength::OfTime(_) => {}
            Strength::OfMotion(formula) => {
                formula.each_slope(at, &mut |slopes: [f64; 2]| tell(slopes.map(|one| by * one)));
            }
            Strength::Sum(parts) => {
                for (own, part) in parts {
                    part.tell_slopes(at, by * own, tell);
                }
            }
        }
    }
}

impl Formula {
    fn inputs(&self, at: &Kinematics) -> [f64; MOST_ARGUMENTS] {
        // what adds nothing at all, not even the sign of a zero
        let mut inputs = [-0.0; MOST_ARGUMENTS];
        for (input, quantity) in &self.arguments {
            inputs[*input] += quantity.value(at);
        }
        inputs
    }

    /// Its kinks among all.
    pub fn kinks(&self) -> Range<usize> {
        self.first..self.first + self.function.kinks()
    }

    fn held<'a>(&self, at: &Kinematics<'a>) -> Option<&'a [i32]> {
        (!at.sides.is_empty()).then(|| &at.sides[self.kinks()])
    }

    /// Its value in SI.
    pub fn value(&self, at: &Kinematics) -> f64 {
        self.function.value(&self.inputs(at), self.held(at))
    }

    fn columns(&self) -> Vec<(BodyId, Axis)> {
        let quantities = self.arguments.iter().map(|(_, quantity)| quantity);
        quantities.flat_map(Quantity::columns).collect()
    }

    fn each_slope(&self, at: &Kinematics, tell: &mut impl FnMut([f64; 2])) {
        let (inputs, held) = (self.inputs(at), self.held(at));
        for (input, quantity) in &self.arguments {
            if matches!(
                quantity,
                Quantity::Time | Quantity::Drive(_) | Quantity::State(_)
            ) {
                continue;
            }
            let by = self.function.slope(&inputs, *input, held);
            let (mut position, mut velocity) = ([0.0; BOTH], [0.0; BOTH]);
            quantity.slopes(at, &mut position, &mut velocity);
            for (position, velocity) in position.iter().zip(&velocity) {
                tell([by * position, by * velocity]);
            }
        }
    }

    /// The name of a table that is looked at beyond all of its points; empty of one without a name.
    pub fn outside(&self, at: &Kinematics) -> Option<&str> {
        self.function.outside(&self.inputs(at))
    }

    /// Takes the sides on which its kinks are.
    pub fn take_sides(&self, at: &Kinematics, sides: &mut [i32]) {
        let own = &mut sides[self.kinks()];
        self.function.take_sides(&self.inputs(at), own);
    }

    /// How far beyond the sides that are held it is, by the scales of all kinks [–].
    pub fn beyond(&self, at: &Kinematics, scales: &[f64]) -> f64 {
        let (held, scales) = (&at.sides[self.kinks()], &scales[self.kinks()]);
        self.function.beyond(&self.inputs(at), held, scales)
    }

    /// What its arguments are at an instant, as functions that are as smooth as the motion: of distances the squares, each with its
    /// rate where that is known.
    pub fn levels(&self, at: &Kinematics, levels: &mut [[f64; 2]]) {
        for ((_, quantity), level) in self.arguments.iter().zip(levels) {
            *level = match quantity {
                Quantity::Time => [at.time, 1.0],
                Quantity::Drive(driver) => [at.drive[*driver][0], at.drive[*driver][1]],
                Quantity::Value(measured) => {
                    let [value, rate] = measured.value(at);
                    match measured {
                        Measured::Distance { .. } => [value * value, 2.0 * value * rate],
                        _ => [value, rate],
                    }
                }
                Quantity::State(_) | Quantity::Rate(_) => [quantity.value(at), f64::NAN],
            };
        }
    }

    /// How far beyond the sides that are held it is where its arguments have these levels [–].
    pub fn beyond_at(&self, levels: &[f64], sides: &[i32], scales: &[f64]) -> f64 {
        let mut inputs = [-0.0; MOST_ARGUMENTS];
        for ((input, quantity), level) in self.arguments.iter().zip(levels) {
            inputs[*input] += match quantity {
                Quantity::Value(Measured::Distance { .. }) => level.max(0.0).sqrt(),
                _ => *level,
            };
        }
        let (held, scales) = (&sides[self.kinks()], &scales[self.kinks()]);
        self.function.beyond(&inputs, held, scales)
    }
}
