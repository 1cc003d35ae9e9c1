//! The force of a gas spring.
//!
//! ```text
//! F = F₁ (1 − a s)^(−n) − c l̇,   a = (1 − x^(−1/n))/H,   s = L₁ − l compression, H stroke, x progression      [N]
//! ```
//!
//! from pVⁿ = constant on the area of the rod: the gas fills V₁ at full extension, and V₁ − A s at a compression s; x = F(H)/F₁
//! gives A/V₁ = a. n is 1 where heat flows, 1.4 where none does. Beyond its stroke, where stops are, the force goes on along its
//! tangent, and has a value everywhere.

use super::formula::Function;

/// Inputs are the length and its rate.
#[derive(Debug, Clone)]
pub struct GasLaw {
    /// F₁ \[N\]
    pub force: f64,
    /// L₁ \[m\]
    pub extended: f64,
    /// H \[m\]
    pub stroke: f64,
    /// x [–]
    pub progression: f64,
    /// n [–]
    pub exponent: f64,
    /// c [N·s/m]
    pub damping: f64,
}

impl GasLaw {
    /// Force of the gas at a length \[N\], and its derivative by the length [N/m].
    fn gas(&self, length: f64) -> [f64; 2] {
        let a = (1.0 - self.progression.powf(-1.0 / self.exponent)) / self.stroke;
        let s = self.extended - length;
        let inside = s.clamp(0.0, self.stroke);
        let room = 1.0 - a * inside;
        let force = self.force * room.powf(-self.exponent);
        let by_s = force * self.exponent * a / room;
        [force + by_s * (s - inside), -by_s]
    }
}

impl Function for GasLaw {
    fn value(&self, inputs: &[f64], _held: Option<&[i32]>) -> f64 {
        self.gas(inputs[0])[0] - self.damping * inputs[1]
    }

    fn slope(&self, inputs: &[f64], index: usize, _held: Option<&[i32]>) -> f64 {
        match index {
            0 => self.gas(inputs[0])[1],
            _ => -self.damping,
        }
    }
}
