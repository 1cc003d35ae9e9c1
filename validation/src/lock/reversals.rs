//! Where the hinge forces of the ideal lock turn: there a clearance link swings round with them.

use super::document::broken;
use super::models::{JOINTS, Stroke};
use crate::CaseError;
use linkdyn_linear::math::Vec2;

/// Slowest turn that is listed, degrees per degree of θ6.
pub const FAST: f64 = 10.0;

/// A local maximum of the rate at which a hinge force turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// \[deg\]
    pub theta6: f64,
    /// Degrees per degree of θ6.
    pub rate: f64,
    /// Size of the force there \[N\].
    pub force: f64,
}

/// The fast turns of every hinge's force, between neighbouring outputs of an ideal run.
///
/// # Errors
/// When the run has no forces.
pub fn turns(stroke: &Stroke) -> Result<[Vec<Turn>; 7], CaseError> {
    let mut found: [Vec<Turn>; 7] = Default::default();
    for (found, joint) in found.iter_mut().zip(JOINTS) {
        let forces = stroke.joint_force(joint)?;
        let rates: Vec<f64> = (1..forces.len())
            .map(|row| turn(&stroke.theta6, &forces, row))
            .collect();
        for (index, &rate) in rates.iter().enumerate() {
            let neighbours = [index.wrapping_sub(1), index + 1]
                .map(|other| rates.get(other).copied().unwrap_or(0.0));
            if rate >= FAST && rate > neighbours[0] && rate >= neighbours[1] {
                let row = index + 1;
                found.push(Turn {
                    theta6: stroke.theta6[row],
                    rate,
                    force: forces[row].norm(),
                });
            }
        }
    }
    Ok(found)
}

/// Turn of a force from the output before to this one, degrees per degree.
pub fn turn(theta6: &[f64], forces: &[Vec2], row: usize) -> f64 {
    let (before, now) = (forces[row - 1], forces[row]);
    before.perp(&now).atan2(before.dot(&now)).to_degrees().abs() / (theta6[row] - theta6[row - 1])
}

impl Stroke {
    /// Force of a hinge, first body on second, row by row \[N\].
    ///
    /// # Errors
    /// When the run has no forces.
    pub fn joint_force(&self, joint: &str) -> Result<Vec<Vec2>, CaseError> {
        let column = |axis: &str| {
            let name = format!("joint.{joint}.{axis}");
            self.trajectory
                .values(&name)
                .ok_or_else(|| broken(format!("no column {name}")))
        };
        Ok(column("fx")?
            .into_iter()
            .zip(column("fy")?)
            .map(|(x, y)| Vec2::new(x, y))
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_is_measured_in_degrees() {
        let forces = [Vec2::new(1.0, 0.0), Vec2::new(0.0, 3.0)];
        assert!((turn(&[10.0, 12.0], &forces, 1) - 45.0).abs() < 1e-12);
    }
}
