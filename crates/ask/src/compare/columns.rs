//! What is compared: the columns requested, or the usual ones.

use super::ladder::{Rung, ran};
use linkdyn_model::{DriverKind, GROUND, Model};
use linkdyn_output::comparison::{Comparison, Run};
use linkdyn_output::{Column, Trajectory};

/// What changes by less than this is round-off \[SI\].
const STILL: f64 = 1e-10;
/// Quantities of the last body that are compared if no columns are requested.
const MOTION: [&str; 9] = ["x", "y", "angle", "vx", "vy", "omega", "ax", "ay", "alpha"];

/// Compares the runs that there are.
pub fn compare(
    model: &Model,
    joints: &[String],
    rungs: &[Rung],
    patterns: &[String],
) -> Comparison {
    let tables: Vec<(&str, Trajectory)> = ran(rungs)
        .map(|(name, outcome)| (name, with_forces(outcome.trajectory.clone(), joints)))
        .collect();
    let runs: Vec<Run> = tables
        .iter()
        .map(|(name, trajectory)| Run { name, trajectory })
        .collect();
    if !patterns.is_empty() {
        return Comparison::new(&runs, patterns);
    }
    let mut usual = vec!["driver.*.effort".to_string()];
    usual.extend(joints.iter().flat_map(|joint| {
        ["force", "fx", "fy"].map(|quantity| format!("joint.{joint}.{quantity}"))
    }));
    if let Some(last) = last_body(model) {
        // A slider does not turn, a body on the ground's pin stays in place.
        let moves = |name: &String| {
            let values = || {
                runs.iter()
                    .filter_map(|run| run.trajectory.values(name))
                    .flatten()
            };
            let (low, high) = (
                values().fold(f64::INFINITY, f64::min),
                values().fold(f64::NEG_INFINITY, f64::max),
            );
            high - low > STILL
        };
        usual.extend(
            MOTION
                .map(|quantity| format!("{last}.{quantity}"))
                .into_iter()
                .filter(moves),
        );
    }
    // Kinematics has no forces, `analysis.columns` may have left out any.
    Comparison {
        unmatched: Vec::new(),
        ..Comparison::new(&runs, &usual)
    }
}

/// What each model's curves are drawn from: its outputs, and the rows of peaks between them.
pub fn curves(joints: &[String], rungs: &[Rung]) -> Vec<(&'static str, Trajectory)> {
    ran(rungs)
        .map(|(model, outcome)| (model, with_forces(outcome.curves().into_owned(), joints)))
        .collect()
}

/// The last body that no driver turns by itself, or the last.
fn last_body(model: &Model) -> Option<&String> {
    let turned = |name: &String| {
        model
            .drivers
            .values()
            .any(|driver| matches!(&driver.kind, DriverKind::Rotation { body, .. } if body == name))
    };
    let mut bodies = model.bodies.keys().filter(|name| *name != GROUND);
    bodies
        .clone()
        .rfind(|name| !turned(name))
        .or(bodies.next_back())
}

/// The table with the magnitude of the joints' forces.
fn with_forces(mut table: Trajectory, joints: &[String]) -> Trajectory {
    for joint in joints {
        let components =
            ["fx", "fy"].map(|quantity| table.values(&format!("joint.{joint}.{quantity}")));
        if let [Some(fx), Some(fy)] = components {
            let magnitudes: Vec<f64> = fx.iter().zip(&fy).map(|(x, y)| x.hypot(*y)).collect();
            table.push_column(
                Column::new(format!("joint.{joint}.force"), "N"),
                &magnitudes,
            );
        }
    }
    table
}
