//! Friction of rigid surfaces that slide on each other.

use super::pair::{ContactId, Pair, Shape, Surface};
use super::{Applied, ConstraintDependentForce, Kinematics};
use linkdyn_linear::math::{Vec2, perp};
use std::sync::Arc;

/// Friction of rigid surfaces that slide on each other: T = −μ N s along t, at the contact on both bodies, with the way s = ±1 in
/// which they slide.
#[derive(Debug, Clone)]
pub struct SlidingFriction {
    /// What they are.
    pub shape: Shape,
    /// μ [–].
    pub coefficient: f64,
    /// Whose way of sliding it is.
    pub id: ContactId,
}

impl ConstraintDependentForce for SlidingFriction {
    fn apply_unit(&self, at: &Kinematics, to: &mut Applied) {
        let reading = self.shape.read(at);
        self.shape.press(at, &reading, [0.0, 1.0], to);
    }

    fn size(&self, at: &Kinematics, _memory: f64, lambda: &[f64], slope: &mut [f64]) -> f64 {
        slope[0] = -self.coefficient * f64::from(at.contacts[self.id.0].piece);
        slope[0] * lambda[0]
    }

    fn is_straight(&self) -> bool {
        true
    }

    fn reaction(&self, at: &Kinematics, size: f64) -> (Vec2, f64) {
        (perp(self.shape.read(at).towards) * size, 0.0)
    }

    fn memory_scale(&self) -> Option<f64> {
        None
    }

    fn memory_rate(&self, _at: &Kinematics, _memory: f64) -> f64 {
        0.0
    }
}

impl Pair {
    /// Friction of those that slide, where there is some.
    pub fn sliding(&self, id: ContactId) -> Option<Arc<dyn ConstraintDependentForce>> {
        let Surface::Rigid(rigid) = &self.surface else {
            return None;
        };
        (rigid.friction > 0.0).then(|| {
            let friction = SlidingFriction {
                shape: self.shape.clone(),
                coefficient: rigid.friction,
                id,
            };
            Arc::new(friction) as Arc<dyn ConstraintDependentForce>
        })
    }
}
