//! The way from a regular position back to the singular one in which a motion starts.

use super::Reduced;
use crate::mechanism::driven::Failure;

/// Steps of the way, so that each is predicted by those before.
const STEPS: u32 = 16;
/// How far a branch may miss the position and, by the fastest, the velocities [rad or sizes; –].
const MISSED: f64 = 1e-5;

impl Reduced<'_> {
    /// Goes from the position at hand along its branch to `q` with velocities `v`, and starts there, at t = 0.
    ///
    /// # Errors
    /// When the branch does not lead there.
    pub fn begin_at(&mut self, q: &[f64], v: &[f64]) -> Result<(), Failure> {
        let f = self.freedom();
        let mut from = vec![0.0; 2 * f];
        self.state(&mut from);
        let columns: Vec<usize> = self.independent_columns().collect();
        let to = columns.iter().map(|&column| q[column]);
        let to: Vec<f64> = to.chain(columns.iter().map(|&column| v[column])).collect();
        let mut y = from.clone();
        for step in 1..=STEPS {
            let part = f64::from(step) / f64::from(STEPS);
            for ((y, from), to) in y.iter_mut().zip(&from).zip(&to) {
                *y = from + part * (to - from);
            }
            if step == STEPS {
                y.copy_from_slice(&to);
            }
            self.evaluate_exactly(0.0, &y)?;
            self.keep(0.0);
        }
        let system = self.driven.system;
        let apart = |a: &[f64], b: &[f64]| {
            let between: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
            system.scaled_norm(&between)
        };
        let residual = apart(&self.q, q)
            .max(apart(&self.v, v) / system.scaled_norm(v).max(1.0 / system.scale.time));
        if residual > MISSED || residual.is_nan() {
            return Err(Failure::Diverged { residual });
        }
        Ok(())
    }
}
