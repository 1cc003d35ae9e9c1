//! Σ fᵢ sᵢ of quantities: what a motor's circuit is made of.

use super::formula::Function;

/// Σ fᵢ sᵢ.
#[derive(Debug, Clone)]
pub struct Weighted {
    /// The factor of each input, in SI.
    pub factors: Vec<f64>,
}

impl Function for Weighted {
    fn value(&self, inputs: &[f64], _held: Option<&[i32]>) -> f64 {
        let parts = self.factors.iter().zip(inputs);
        parts.map(|(factor, input)| factor * input).sum()
    }

    fn slope(&self, _inputs: &[f64], index: usize, _held: Option<&[i32]>) -> f64 {
        self.factors[index]
    }
}
