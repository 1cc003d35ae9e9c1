//! F12 of the ideal lock near the paper's −40°, for every choice of the centres of mass that it leaves open.
//!
//! The reaction passes a least size where its components change sign one after the other; there its direction swings
//! round. Where over θ6 that happens depends on the centres of mass of links 3 and 4.

use super::bounds::{ABRUPT, CLEAR, NEAR, NEAR_OTHER};
use super::centres::Centres;
use super::models::{Request, STEPS, Stroke};
use super::reversals::turn;
use crate::CaseError;
use linkdyn_engine::analysis::Control;

/// F12 clear of the change point, for one choice of centres of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceNear {
    pub centres: Centres,
    /// Smallest |F12| \[N\] and where \[deg\].
    pub least: [f64; 2],
    /// Fastest turn of its direction [deg/deg] and where \[deg\].
    pub turn: [f64; 2],
    /// The same by its median over the stroke [–].
    pub turn_most: f64,
    /// Largest change of the vector near −40° by its median over the stroke [–].
    pub change: f64,
    /// Largest turn of the direction near −40° by its median [–].
    pub turn_near: f64,
    /// |F12| at −40° \[N\].
    pub there: f64,
}

impl ForceNear {
    /// From an ideal run.
    ///
    /// # Errors
    /// When it has no forces.
    pub fn of(stroke: &Stroke) -> Result<Self, CaseError> {
        let forces = stroke.joint_force("a")?;
        let clear: Vec<usize> = (0..forces.len())
            .filter(|&row| stroke.theta6[row] <= CLEAR)
            .collect();
        let mut near = ForceNear {
            centres: stroke.request.centres,
            least: [f64::INFINITY, f64::NAN],
            turn: [0.0, f64::NAN],
            turn_most: 0.0,
            change: 0.0,
            turn_near: 0.0,
            there: f64::NAN,
        };
        let (mut changes, mut turns) = (Vec::new(), Vec::new());
        for &row in &clear {
            let (theta6, size) = (stroke.theta6[row], forces[row].norm());
            if size < near.least[0] {
                near.least = [size, theta6];
            }
            if (theta6 - NEAR_OTHER).abs() < 1e-6 {
                near.there = size;
            }
            if row == 0 {
                continue;
            }
            let (before, now) = (forces[row - 1], forces[row]);
            let turn = turn(&stroke.theta6, &forces, row);
            let change = (now - before).norm() / (theta6 - stroke.theta6[row - 1]);
            if turn > near.turn[0] {
                near.turn = [turn, theta6];
            }
            if (theta6 - NEAR_OTHER).abs() <= NEAR {
                near.change = near.change.max(change);
                near.turn_near = near.turn_near.max(turn);
            }
            changes.push(change);
            turns.push(turn);
        }
        near.change /= median(changes);
        let median_turn = median(turns);
        near.turn_near /= median_turn;
        near.turn_most = near.turn[0] / median_turn;
        Ok(near)
    }

    /// Whether it changes abruptly near −40°.
    pub fn abrupt(&self) -> bool {
        self.change >= ABRUPT || self.turn_near >= ABRUPT
    }
}

/// The map over all choices, each run up to [`CLEAR`] with outputs at the finest step.
///
/// # Errors
/// When one can't be run.
pub fn map(control: &Control) -> Result<Vec<ForceNear>, CaseError> {
    let near = |centres: Centres| {
        let request = Request {
            centres,
            ..Request::ideal(STEPS[3])
        };
        ForceNear::of(&request.run_to(CLEAR, control)?)
    };
    Centres::all().map(near).collect()
}

/// Middle value; the greater of the two in an even number.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
    }
}
