//! The tension of a cable that goes over points without friction.
//!
//! ```text
//! L = Σ lᵢ,  T = max(0, k (L − L₀(t)) + c L̇)      lᵢ distances of neighbouring points      [N]
//! ```
//!
//! Each stretch pulls its two points together with T ([`super::actuator`]). Slack is a side of the kink of T, so that a motion is
//! integrated taut or slack, and the change is an event. The work of the cable counts with that of loads.

use super::formula::Function;
use crate::motion::Law;

/// −T of stretches; inputs are the lengths of all, their rates, and time.
#[derive(Debug, Clone)]
pub struct Tension {
    /// How many.
    pub stretches: usize,
    /// [N/m]
    pub stiffness: f64,
    /// [N·s/m]
    pub damping: f64,
    /// L₀ \[m\]
    pub free_length: Law,
}

impl Tension {
    /// k (L − L₀) + c L̇ \[N\].
    fn pull(&self, inputs: &[f64]) -> f64 {
        let sum = |from: usize| inputs[from..from + self.stretches].iter().sum::<f64>();
        let free = self.free_length.jet(inputs[2 * self.stretches])[0];
        self.stiffness * (sum(0) - free) + self.damping * sum(self.stretches)
    }

    fn is_taut(&self, inputs: &[f64], held: Option<&[i32]>) -> bool {
        held.map_or_else(|| self.pull(inputs) >= 0.0, |held| held[0] > 0)
    }
}

impl Function for Tension {
    fn value(&self, inputs: &[f64], held: Option<&[i32]>) -> f64 {
        match self.is_taut(inputs, held) {
            true => -self.pull(inputs),
            false => 0.0,
        }
    }

    fn slope(&self, inputs: &[f64], index: usize, held: Option<&[i32]>) -> f64 {
        match self.is_taut(inputs, held) {
            false => 0.0,
            true if index < self.stretches => -self.stiffness,
            true => -self.damping,
        }
    }

    fn kinks(&self) -> usize {
        1
    }

    fn take_sides(&self, inputs: &[f64], sides: &mut [i32]) {
        sides[0] = if self.pull(inputs) >= 0.0 { 1 } else { -1 };
    }

    fn beyond(&self, inputs: &[f64], held: &[i32], scales: &[f64]) -> f64 {
        -f64::from(held[0]) * self.pull(inputs) / scales[0]
    }
}
