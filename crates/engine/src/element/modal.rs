//! What the modes of an elastic link exert on their amplitudes.
//!
//! ```text
//! Q = −K q − D q̇        V = ½ qᵀ K q        (n) by the amplitudes [N]
//! ```

use super::station::Amplitude;
use super::{Applied, Axis, Force, Kinematics, Slope};
use linkdyn_linear::math::Vec2;

/// Stiffness and damping of the modes of a link.
#[derive(Debug, Clone)]
pub struct ModalStiffness {
    /// The amplitudes (n).
    pub amplitudes: Vec<Amplitude>,
    /// K (n × n by rows) [N/m].
    pub stiffness: Vec<f64>,
    /// D (n × n by rows) [N·s/m].
    pub damping: Vec<f64>,
}

impl ModalStiffness {
    /// Σ row · (values of the amplitudes).
    fn product(&self, matrix: &[f64], row: usize, value: impl Fn(Amplitude) -> f64) -> f64 {
        let n = self.amplitudes.len();
        let row = matrix[row * n..(row + 1) * n].iter();
        row.zip(&self.amplitudes).map(|(k, q)| k * value(*q)).sum()
    }
}

impl Force for ModalStiffness {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        for (row, own) in self.amplitudes.iter().enumerate() {
            let force = -self.product(&self.stiffness, row, |q| q.value(at))
                - self.product(&self.damping, row, |q| q.rate(at));
            let direction = match own.axis {
                Axis::X => Vec2::x(),
                Axis::Y | Axis::Theta => Vec2::y(),
            };
            to.add(own.body, direction * force, 0.0);
        }
    }

    fn slopes(&self) -> Vec<Slope> {
        let of = |q: &Amplitude| (q.body, q.axis);
        let all = || self.amplitudes.iter().map(of);
        all()
            .flat_map(|row| all().map(move |column| [row, column]))
            .collect()
    }

    fn slope(&self, _at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        let both = [(position, &self.stiffness), (velocity, &self.damping)];
        for (to, from) in both {
            to.iter_mut().zip(from).for_each(|(to, from)| *to = -from);
        }
    }

    fn potential(&self, at: &Kinematics) -> f64 {
        let rows = self.amplitudes.iter().enumerate();
        0.5 * rows
            .map(|(row, q)| q.value(at) * self.product(&self.stiffness, row, |q| q.value(at)))
            .sum::<f64>()
    }

    fn is_conservative(&self) -> bool {
        self.damping.iter().all(|d| *d == 0.0)
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        let rows = self.amplitudes.iter().enumerate();
        -rows
            .map(|(row, q)| q.rate(at) * self.product(&self.damping, row, |q| q.rate(at)))
            .sum::<f64>()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::element::BodyId;

    /// Two amplitudes with damping, for the shared checks.
    pub(in crate::element) fn modes() -> ModalStiffness {
        ModalStiffness {
            amplitudes: [Axis::X, Axis::Y]
                .map(|axis| Amplitude {
                    body: BodyId(2),
                    axis,
                })
                .to_vec(),
            stiffness: vec![3.0, 0.5, 0.5, 4.0],
            damping: vec![0.2, 0.1, 0.1, 0.3],
        }
    }
}
