//! The balance of powers of a run: how far drivers and forces are from what the kinetic energy takes.
//!
//! ```text
//! P_d + P_f − Ṫ = 0       P_d = Σ effort · rate, P_f = Qᵀ v, Ṫ = vᵀ M a      [W]
//! imbalance               largest |P_d + P_f − Ṫ|
//! whole                   largest |P_d|, |P_f|, |Ṫ| of the run, and no less than a millionth of the gross power
//! gross power             Σ |Q_k v_k| + Σ m_k |v_k a_k| + Σ |effort · rate| + (Σ |Q_k| ℓ_k + vᵀ M v) |ṽ|
//! ```
//!
//! with ℓ_k the scale of a coordinate and |ṽ| the fastest scaled rate [1/s]. Where no power flows, as in a balanced wheel that
//! turns evenly, the first three are round-off of the last, which is what the imbalance is measured against then; it is worked out at
//! instants at which they are not balanced.

use crate::system::System;
use linkdyn_linear::math::dot;

/// Part of the gross power below which a power is none.
const FLOWS: f64 = 1e-6;

/// Imbalance by the flowing power above which the gross power is worth its cost.
const BALANCED: f64 = 1e-9;

/// Largest powers of a run so far \[W\].
#[derive(Debug, Clone, Copy, Default)]
pub struct Powers {
    flowing: f64,
    gross: f64,
    imbalance: f64,
}

impl Powers {
    /// One instant: velocities, accelerations and forces (n), and efforts with rates of the drivers.
    pub fn note(
        &mut self,
        system: &System,
        [v, a, force]: [&[f64]; 3],
        drivers: impl Iterator<Item = (f64, f64)> + Clone,
    ) {
        let driven: f64 = drivers.clone().map(|(effort, rate)| effort * rate).sum();
        // Of efforts that do not exist nothing is counted: `max` passes NaN over.
        let applied = dot(force, v);
        let kinetic = system.mass.product(v, a);
        self.flowing = self
            .flowing
            .max(driven.abs())
            .max(applied.abs())
            .max(kinetic.abs());
        self.imbalance = self.imbalance.max((driven + applied - kinetic).abs());
        // Where powers flow they are balanced far better than this, and what could flow does not matter.
        if self.imbalance > BALANCED * self.flowing {
            self.gross = self.gross.max(gross(system, [v, a, force], drivers));
        }
    }

    /// The largest imbalance by the largest power [–].
    pub fn relative_imbalance(&self) -> f64 {
        let whole = self.flowing.max(FLOWS * self.gross);
        if whole > 0.0 {
            self.imbalance / whole
        } else {
            0.0
        }
    }
}

/// The gross power of an instant \[W\].
fn gross(
    system: &System,
    [v, a, force]: [&[f64]; 3],
    drivers: impl Iterator<Item = (f64, f64)>,
) -> f64 {
    let mut gross: f64 = drivers.map(|(effort, rate)| (effort * rate).abs()).sum();
    let mut acting = 0.0;
    for (k, ((v, a), (force, mass))) in v
        .iter()
        .zip(a)
        .zip(force.iter().zip(system.mass.diagonal()))
        .enumerate()
    {
        gross += (force * v).abs() + mass * (v * a).abs();
        acting += force.abs() * system.column_scale(k) + mass * v * v;
    }
    gross + acting * system.scaled_norm(v)
}
