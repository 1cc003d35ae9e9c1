//! Shaking forces and moments of derived columns.

mod slides;

use crate::models;
use linkdyn_engine::analysis::Outcome;
use linkdyn_engine::analysis::derived::derived;
use linkdyn_model::{ForceKind, Model};
use linkdyn_output::Trajectory;

/// Adds force and moment of each load from outside, row by row.
fn add_loads(model: &Model, derived: &Trajectory, outcome: &Outcome, sums: &mut [[f64; 3]]) {
    let of = |column: String| {
        outcome
            .trajectory
            .values(&column)
            .unwrap_or_else(|| panic!("no {column}"))
    };
    for (force, words) in &model.forces {
        match &words.kind {
            ForceKind::Load { at, .. } => {
                let [fx, fy] = ["fx", "fy"].map(|q| {
                    derived
                        .values(&format!("force.{force}.{q}"))
                        .expect("a load")
                });
                let [x, y, angle] = ["x", "y", "angle"].map(|q| of(format!("{}.{q}", at.body)));
                let point = model.bodies[&at.body].points[&at.point];
                for (row, sum) in sums.iter_mut().enumerate() {
                    let (sin, cos) = angle[row].sin_cos();
                    let px = x[row] + cos * point[0] - sin * point[1];
                    let py = y[row] + sin * point[0] + cos * point[1];
                    sum[0] += fx[row];
                    sum[1] += fy[row];
                    sum[2] += px * fy[row] - py * fx[row];
                }
            }
            ForceKind::Torque {
                relative_to: None, ..
            }
            | ForceKind::DcMotor {
                relative_to: None, ..
            } => {
                let torque = derived
                    .values(&format!("force.{force}.torque"))
                    .expect("a torque");
                sums.iter_mut()
                    .zip(torque)
                    .for_each(|(sum, torque)| sum[2] += torque);
            }
            ForceKind::Torque { .. }
            | ForceKind::DcMotor { .. }
            | ForceKind::GasSpring { .. }
            | ForceKind::Cylinder { .. }
            | ForceKind::Spring { .. }
            | ForceKind::Actuator { .. }
            | ForceKind::Cable { .. }
            | ForceKind::TorsionSpring { .. } => {}
        }
    }
}

/// What the mechanism does to the ground by Newton and Euler: weights and loads less the change of momentum, with nothing of joints.
#[test]
fn shaking_is_the_balance_of_momentum() {
    let mut tried = 0;
    for (name, sets) in [
        ("slider-crank", &[][..]),
        ("stephenson-iii", &[]),
        ("four-bar", &[]),
        ("geared-five-bar", &[]),
        ("scotch-yoke", &[]),
        ("quick-return", &[]),
        ("watt-i-lock", &["analysis.sample.to=115 deg"]),
        ("engine", &[]),
        ("quick-return", &["drivers={}", "analysis.type=dynamics"]),
    ] {
        let model = models::load_bundled(name, sets);
        let outcome = models::solve(&model);
        let (derived, _) = derived(&models::checked(&model), outcome.all());
        let ours = ["fx", "fy", "moment"]
            .map(|q| derived.values(&format!("shaking.{q}")).expect("shaking"));
        let of = |column: String| {
            outcome
                .trajectory
                .values(&column)
                .unwrap_or_else(|| panic!("no {column}"))
        };
        let mut sums = vec![[0.0; 3]; outcome.trajectory.len()];
        for (body, words) in model.bodies.iter().filter(|(body, _)| *body != "ground") {
            let columns = ["x", "y", "angle", "omega", "ax", "ay", "alpha"]
                .map(|q| of(format!("{body}.{q}")));
            let (m, inertia, com) = (
                words.mass.expect("m"),
                words.inertia.expect("I"),
                words.com.unwrap_or_default(),
            );
            for (row, sum) in sums.iter_mut().enumerate() {
                let [x, y, angle, omega, ax, ay, alpha] =
                    [0, 1, 2, 3, 4, 5, 6].map(|k| columns[k][row]);
                let (sin, cos) = angle.sin_cos();
                let (rx, ry) = (cos * com[0] - sin * com[1], sin * com[0] + cos * com[1]);
                let fx = m * (model.gravity[0] - (ax - alpha * ry - omega * omega * rx));
                let fy = m * (model.gravity[1] - (ay + alpha * rx - omega * omega * ry));
                sum[0] += fx;
                sum[1] += fy;
                sum[2] += (x + rx) * fy - (y + ry) * fx - inertia * alpha;
            }
        }
        add_loads(&model, &derived, &outcome, &mut sums);
        for k in 0..3 {
            let largest = sums
                .iter()
                .fold(1.0_f64, |largest, sum| largest.max(sum[k].abs()));
            for (row, sum) in sums.iter().enumerate() {
                let difference = (sum[k] - ours[k][row]).abs() / largest;
                assert!(
                    difference < 1e-9,
                    "{name} {sets:?}, row {row}, component {k}: {} and {}",
                    sum[k],
                    ours[k][row]
                );
                tried += 1;
            }
        }
    }
    assert!(tried > 5000, "{tried}");
    // The load of the slider-crank by hand: −600 + 500 sin(−90°).
    let model = models::load_bundled("slider-crank", &[]);
    let (derived, _) = derived(&models::checked(&model), models::solve(&model).all());
    assert!((derived.values("force.gas.fx").expect("the load")[0] + 1100.0).abs() < 1e-9);
}
