//! Forces from outside the model.
//!
//! ```text
//! M a + Jᵀ λ = Q + F       F (n): per body a force at its centre of mass [N], and a torque [N·m]
//! ```

use std::fmt;
use std::sync::Arc;

/// F as a function of time, position and velocity (n); the last argument is F, which is zero before.
pub type ForceLaw = dyn Fn(f64, &[f64], &[f64], &mut [f64]) + Send + Sync;

/// Forces F that are added to those of the model.
#[derive(Clone, Default)]
pub enum Pushes {
    /// There are none.
    #[default]
    None,
    /// They are constant (n).
    Held(Arc<[f64]>),
    /// They are a function of the state.
    Law(Arc<ForceLaw>),
}

impl fmt::Debug for Pushes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Pushes::None => f.write_str("None"),
            Pushes::Held(force) => f.debug_tuple("Held").field(force).finish(),
            Pushes::Law(_) => f.write_str("Law"),
        }
    }
}

impl PartialEq for Pushes {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Pushes::None, Pushes::None) => true,
            (Pushes::Held(a), Pushes::Held(b)) => a == b,
            (Pushes::Law(a), Pushes::Law(b)) => Arc::ptr_eq(a, b),
            (Pushes::None | Pushes::Held(_) | Pushes::Law(_), _) => false,
        }
    }
}

impl Pushes {
    /// Adds F at a position and velocity (n), which only a law asks for, to Q (n).
    pub(super) fn add(&self, state: impl FnOnce() -> [Vec<f64>; 2], time: f64, force: &mut [f64]) {
        match self {
            Pushes::None => {}
            Pushes::Held(held) => force.iter_mut().zip(&**held).for_each(|(q, f)| *q += f),
            Pushes::Law(law) => {
                let [q, v] = state();
                let mut own = vec![0.0; q.len()];
                law(time, &q, &v, &mut own);
                force.iter_mut().zip(own).for_each(|(q, f)| *q += f);
            }
        }
    }

    /// The power of F at a position and velocity (n) \[W\].
    pub(super) fn power(&self, state: impl FnOnce() -> [Vec<f64>; 2], time: f64) -> f64 {
        if matches!(self, Pushes::None) {
            return 0.0;
        }
        let [q, v] = state();
        let mut force = vec![0.0; v.len()];
        self.add(|| [q, v.clone()], time, &mut force);
        linkdyn_linear::math::dot(&force, &v)
    }
}
