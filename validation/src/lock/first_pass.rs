//! The first pass of the paper's procedure: clearance links along the ideal hinge forces, positions from its two vector
//! loops (eqs 11, 12) alone. It needs no velocities, so no output step; what follows from it is the geometry near the change
//! point: where the lock with clearance can be assembled at all.

use super::equations::{Lock, Offsets};
use super::instant::angles_and_forces;
use super::models::{Request, intervals};
use crate::CaseError;
use linkdyn_engine::analysis::Control;
use linkdyn_linear::math::Vec2;

/// Output step \[deg\].
pub const STEP: f64 = 0.25;

/// Which way the journal lies in its bearing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// Where it presses the bearing: along the force of the journal on the bearing.
    Pressing,
    /// The other way.
    Opposite,
}

/// The first pass over the stroke.
#[derive(Debug, Clone)]
pub struct FirstPass {
    /// \[µm\]
    pub radius: f64,
    pub sign: Sign,
    /// \[deg\]
    pub theta6: Vec<f64>,
    /// Change of θ2 \[rad\]; NaN where there is no assembly.
    pub delta: Vec<f64>,
}

impl FirstPass {
    /// Intervals without assembly \[deg\].
    pub fn gaps(&self) -> Vec<[f64; 2]> {
        intervals(&self.theta6, |row| self.delta[row].is_nan())
    }

    /// |Δθ2| at an output \[rad\].
    pub fn at(&self, theta6: f64) -> f64 {
        let row = self.theta6.iter().position(|at| (at - theta6).abs() < 1e-9);
        row.map_or(f64::NAN, |row| self.delta[row].abs())
    }

    /// Largest and mean |Δθ2| over outputs `step` degrees apart \[rad\].
    pub fn statistics(&self, step: f64) -> [f64; 2] {
        let stride = (step / STEP).round() as usize;
        let values = self
            .delta
            .iter()
            .step_by(stride.max(1))
            .map(|delta| delta.abs())
            .filter(|delta| delta.is_finite());
        let (max, sum, count) = values.fold((0.0_f64, 0.0, 0.0), |(max, sum, count), d| {
            (max.max(d), sum + d, count + 1.0)
        });
        [max, sum / count]
    }
}

/// Goes over the stroke.
///
/// # Errors
/// When the ideal lock can't be run.
pub fn first_pass(radius: f64, sign: Sign, control: &Control) -> Result<FirstPass, CaseError> {
    let ideal = Request::ideal(STEP).run(control)?;
    let lock = Lock::new(&ideal.model)?;
    let along = match sign {
        Sign::Pressing => -1.0,
        Sign::Opposite => 1.0,
    };
    let length = along * radius * 1e-6;
    let mut delta = Vec::with_capacity(ideal.theta6.len());
    for row in 0..ideal.trajectory.len() {
        let (theta, forces) = angles_and_forces(&ideal.trajectory, row)?;
        let r: Offsets = forces.map(|f: Vec2| {
            if f.norm() > 0.0 {
                f * (length / f.norm())
            } else {
                Vec2::zeros()
            }
        });
        delta.push(
            lock.close(&theta, &r)
                .map_or(f64::NAN, |closed| closed[0] - theta[0]),
        );
    }
    Ok(FirstPass {
        radius,
        sign,
        theta6: ideal.theta6,
        delta,
    })
}
