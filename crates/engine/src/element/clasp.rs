//! A joint that closes and opens: all its rows come into force at once, and go at once.
//!
//! ```text
//! open        no rows
//! closed      φ = 0 of the joint, from a position in which φ = 0 is met; λ as there
//! ```
//!
//! It is no contact that could touch: an event closes it, whatever its rate J v is then (see `analysis/dynamics/impulses/closing`).

use super::touch::Reading;
use super::{Constraint, Kinematics, Measure};
use linkdyn_linear::math::Vec2;
use std::fmt;
use std::sync::Arc;

/// Rows that a joint has at most.
pub const MOST_ROWS: usize = 3;

/// A joint that closes and opens.
#[derive(Clone)]
pub struct Clasp {
    /// It, while it is closed.
    pub constraint: Arc<dyn Constraint>,
    /// What its gap is measured against \[m\].
    pub size: f64,
}

impl fmt::Debug for Clasp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Clasp").field("size", &self.size).finish()
    }
}

impl Clasp {
    /// Nothing is near while it is open, and nothing overlaps while it is closed.
    pub fn read(&self) -> Reading {
        Reading::default()
    }

    /// Force that it carries, by its multipliers \[N\].
    pub fn transmitted(&self, at: &Kinematics, lambda: &[f64]) -> f64 {
        let (force, _): (Vec2, f64) = self.constraint.reaction(at, lambda);
        force.norm()
    }

    /// How far apart the joint is: gap \[m\] and angle \[rad\].
    pub fn apart(&self, at: &Kinematics) -> [f64; 2] {
        let mut phi = [0.0; MOST_ROWS];
        let rows = self.constraint.rows();
        self.constraint.position(at, &mut phi[..rows.len()]);
        sizes(rows, &phi)
    }
}

/// Sizes of what is measured in lengths, and of what is measured in angles.
pub fn sizes(rows: &[Measure], values: &[f64]) -> [f64; 2] {
    let mut squares = [0.0; 2];
    for (measure, value) in rows.iter().zip(values) {
        squares[usize::from(*measure == Measure::Angle)] += value * value;
    }
    squares.map(f64::sqrt)
}
