//! Friction of ideal joints: against closed forms and equations written once more by hand, and where it locks.

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_output::Status;
use serde_json::{Value, json};

const G: f64 = 9.81;

fn coulomb(coefficient: f64, threshold: f64) -> Value {
    json!({ "law": "coulomb", "coefficient": coefficient, "threshold_velocity": threshold })
}

fn lugre(kinetic: f64, resting: f64) -> Value {
    json!({ "law": "lugre", "coefficient": kinetic, "static_coefficient": resting, "stribeck_velocity": 0.01,
            "bristle_stiffness": 1e4, "bristle_damping": 30.0 })
}

fn dynamics(end: f64, outputs: usize, rtol: f64) -> Value {
    json!({ "type": "dynamics", "end": end, "outputs": outputs, "solver": { "rtol": rtol, "atol": 1e-2 * rtol } })
}

#[track_caller]
fn completed(model: &Value) -> Outcome {
    let outcome = outcome(model);
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    assert!(
        outcome.report.quality.power_imbalance.expect("forces") < 1e-12,
        "{:?}",
        outcome.report.quality
    );
    outcome
}

#[track_caller]
fn close(found: f64, wanted: f64, tolerance: f64) {
    assert!(
        (found - wanted).abs() <= tolerance,
        "{found:e}, not {wanted:e}: off by {:e}",
        (found - wanted).abs()
    );
}

fn last(outcome: &Outcome, name: &str) -> f64 {
    *column(outcome, name).last().expect("rows")
}

/// A block of 2 kg on a plane that falls at `slope`, starting at rest.
fn incline(slope: f64, friction: &Value) -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": 2.0, "inertia": 0.01, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
                   "pose": { "position": [0.0, 0.0], "angle": -slope } },
    });
    let joints = json!({ "g": { "type": "prismatic", "between": ["ground.O", "block.C"],
        "axis": [slope.cos(), -slope.sin()], "angle": -slope, "friction": friction } });
    model(bodies, joints, json!({}))
}

/// v′ = g sin α − μ g cos α min(v/v_t, 1), by its closed form: beyond the ramp the acceleration is g(sin α − μ cos α).
#[test]
fn a_block_slides_down_an_incline() {
    let (slope, mu, threshold) = (0.6_f64, 0.3, 0.02);
    let mut model = incline(slope, &coulomb(mu, threshold));
    model["analysis"] = dynamics(1.0, 11, 1e-10);
    let run = completed(&model);
    let (pull, brake) = (G * slope.sin(), mu * G * slope.cos());
    let ramp = brake / threshold;
    let until = -(1.0 - threshold * ramp / pull).ln() / ramp;
    let within = pull / ramp * (until - threshold / pull);
    let after = 1.0 - until;
    let distance = within + threshold * after + 0.5 * (pull - brake) * after * after;
    let (x, y) = (last(&run, "block.x"), last(&run, "block.y"));
    close(x.hypot(y), distance, 1e-9);
    close(
        last(&run, "block.ax").hypot(last(&run, "block.ay")),
        G * (slope.sin() - mu * slope.cos()),
        1e-12,
    );
    close(
        last(&run, "joint.g.friction"),
        -mu * 2.0 * G * slope.cos(),
        1e-12,
    );
    // Across the plane and along it, as the plane presses and brakes.
    let (across, along) = ([slope.sin(), slope.cos()], [slope.cos(), -slope.sin()]);
    let (normal, brake) = (2.0 * G * slope.cos(), -mu * 2.0 * G * slope.cos());
    close(
        last(&run, "joint.g.fx"),
        normal * across[0] + brake * along[0],
        1e-11,
    );
    close(
        last(&run, "joint.g.fy"),
        normal * across[1] + brake * along[1],
        1e-11,
    );

    // Driven with this very acceleration it needs no effort.
    model["drivers"] = json!({ "hand": { "type": "translation", "joint": "g", "motion": {
        "type": "constant_acceleration", "start": 0.0, "velocity": 1.0, "acceleration": pull - mu * G * slope.cos() } } });
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 11 });
    let run = completed(&model);
    assert!(
        column(&run, "driver.hand.effort")
            .iter()
            .all(|effort| effort.abs() < 1e-12)
    );
    close(last(&run, "joint.g.friction"), brake, 1e-12);
}

/// A block whose weight hangs beside a guide of length L presses with both ends: N = 2 m g e/L, e the lever.
#[test]
fn a_guide_takes_the_torque_with_its_ends() {
    let (lever, length, mu) = (0.3, 0.2, 0.1);
    let mut model = incline(0.0, &coulomb(mu, 0.01));
    model["bodies"]["block"]["com"] = json!([lever, 0.0]);
    model["drivers"] = json!({ "hand": { "type": "translation", "joint": "g",
        "motion": { "type": "constant_velocity", "start": 0.0, "velocity": 1.0 } } });
    let effort = |model: &Value| last(&completed(model), "driver.hand.effort");
    close(effort(&model), mu * 2.0 * G, 1e-12);
    model["joints"]["g"]["guide_length"] = json!(length);
    close(effort(&model), mu * 2.0 * (2.0 * G) * lever / length, 1e-12);
    model["joints"]["g"]["guide_length"] = json!(2.5 * lever);
    close(effort(&model), mu * 2.0 * G, 1e-12);
}

/// A uniform bar on a pin of radius r.
fn pendulum(angle: f64, radius: f64, friction: &Value) -> Value {
    let bodies =
        json!({ "ground": { "points": { "O": [0.0, 0.0] } }, "bar": rod(1.0, [0.0, 0.0], angle) });
    let joints = json!({ "o": { "type": "revolute", "between": ["ground.O", "bar.A"], "friction": friction,
                                "pin_radius": radius } });
    let mut pendulum = model(bodies, joints, json!({}));
    pendulum["initial"] = json!({ "bar": { "angle": angle, "angular_velocity": 0.0 } });
    pendulum
}

/// θ″ of that pendulum, from the bar cut free: its pin force holds θ″, so that is found by repetition.
fn pendulum_acceleration(angle: f64, omega: f64, (radius, mu, threshold): (f64, f64, f64)) -> f64 {
    let (mass, lever, inertia) = (1.0, 0.5, 1.0 / 12.0 + 0.25);
    let (sin, cos) = angle.sin_cos();
    let part = (radius * omega / threshold).clamp(-1.0, 1.0);
    let mut alpha = 0.0;
    for _ in 0..40 {
        let x = mass * lever * (-alpha * sin - omega * omega * cos);
        let y = mass * (lever * (alpha * cos - omega * omega * sin) + G);
        alpha = (-mass * G * lever * cos - mu * radius * x.hypot(y) * part) / inertia;
    }
    alpha
}

#[test]
fn a_pendulum_loses_its_swing_as_its_equation_by_hand_says() {
    let (radius, mu, threshold) = (0.05, 0.3, 0.02);
    let mut model = pendulum(-0.2, radius, &coulomb(mu, threshold));
    model["analysis"] = dynamics(3.0, 7, 1e-10);
    let run = completed(&model);
    let f = |[angle, omega]: [f64; 2]| {
        [
            omega,
            pendulum_acceleration(angle, omega, (radius, mu, threshold)),
        ]
    };
    let go = |y: [f64; 2], k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
    let (mut y, h) = ([-0.2, 0.0], 1e-4);
    let (mut angles, mut omegas) = (
        column(&run, "bar.angle").into_iter(),
        column(&run, "bar.omega").into_iter(),
    );
    let mut compare = |y: [f64; 2]| {
        close(angles.next().expect("rows"), y[0], 2e-8);
        close(omegas.next().expect("rows"), y[1], 2e-7);
    };
    compare(y);
    for step in 1..=30_000 {
        let k1 = f(y);
        let k2 = f(go(y, k1, 0.5 * h));
        let k3 = f(go(y, k2, 0.5 * h));
        let k4 = f(go(y, k3, h));
        let mean = [0, 1].map(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
        y = go(y, mean, h);
        if step % 5000 == 0 {
            compare(y);
        }
    }
}

/// Small swings lose 2 μ r/l of amplitude per half swing, l the centre of mass from the pin.
#[test]
fn small_swings_shrink_by_the_same_amount_each() {
    let (radius, mu) = (0.01, 0.1);
    let down = -std::f64::consts::FRAC_PI_2;
    let mut model = pendulum(down + 0.05, radius, &coulomb(mu, 1e-6));
    model["analysis"] = dynamics(4.0, 4001, 1e-8);
    let run = completed(&model);
    let (angles, omegas) = (column(&run, "bar.angle"), column(&run, "bar.omega"));
    let turns: Vec<f64> = (1..angles.len() - 1)
        .filter(|&k| omegas[k] * omegas[k + 1] < 0.0)
        .map(|k| (angles[k] - down).abs().max((angles[k + 1] - down).abs()))
        .collect();
    assert!(turns.len() >= 4, "{turns:?}");
    let mut before = 0.05;
    for turn in &turns[..4] {
        close(before - turn, 2.0 * mu * radius / 0.5, 2e-5);
        before = *turn;
    }
}

/// A slider-crank without mass but in its slider, which is pulled with `pull`.
fn bare_slider_crank(mu: f64, pull: f64) -> Value {
    let mut model = slider_crank(
        0.08,
        0.1,
        0.4,
        false,
        &json!({ "type": "polynomial", "coefficients": [0.4, 2.0] }),
    );
    for body in ["crank", "rod"] {
        model["bodies"][body]["mass"] = json!(0.0);
        model["bodies"][body]["inertia"] = json!(0.0);
    }
    model["joints"]["g"]["friction"] = coulomb(mu, 1e-9);
    model["forces"] =
        json!({ "pull": { "type": "force", "at": "slider.B", "vector": [pull, 0.0] } });
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 3.0, "outputs": 302 });
    model
}

/// Rod force S, guide force N and friction T of that slider-crank by statics of the slider; none where it locks itself.
fn slider_by_hand(mu: f64, pull: f64, angle: f64, [v, a]: [f64; 2]) -> (Option<[f64; 3]>, f64) {
    let phi = (-0.08 * angle.sin() / 0.1).asin();
    // N without friction has the sign of N with it.
    let free = G - (a - pull) / phi.cos() * phi.sin();
    let against = mu * v.signum() * free.signum();
    let margin = 1.0 + against * phi.tan();
    let force = (a - pull + against * G) / (phi.cos() + against * phi.sin());
    let normal = G - force * phi.sin();
    let torque = 0.08 * force * (angle.cos() * phi.sin() - angle.sin() * phi.cos());
    (
        (margin > 0.0).then_some([
            normal,
            -against.signum() * mu * normal.abs() * free.signum(),
            torque,
        ]),
        margin,
    )
}

#[test]
fn a_slider_crank_needs_the_effort_of_its_statics() {
    let (mu, pull) = (0.4, -30.0);
    let run = completed(&bare_slider_crank(mu, pull));
    let names = [
        "driver.motor.value",
        "slider.vx",
        "slider.ax",
        "joint.g.fy",
        "joint.g.friction",
        "driver.motor.effort",
    ];
    let columns = names.map(|name| run.trajectory.column_index(name).expect("a column"));
    let mut compared = 0;
    for row in run.trajectory.rows() {
        let [angle, v, a, normal, friction, effort] = columns.map(|column| row[column]);
        let (Some(by_hand), _) = slider_by_hand(mu, pull, angle, [v, a]) else {
            panic!("locked at {angle}")
        };
        let [wanted_normal, wanted_friction, wanted_effort] = by_hand;
        close(normal, wanted_normal, 1e-11);
        close(friction, wanted_friction, 1e-11);
        close(effort, wanted_effort, 1e-11);
        // What the driver brings in, the slider and its friction take.
        close(effort * 2.0, (a - pull - friction) * v, 1e-11);
        compared += 1;
    }
    assert_eq!(compared, 302);
}

#[test]
fn where_a_slider_locks_itself_there_are_no_forces_but_an_event() {
    let (mu, pull) = (1.1, -30.0);
    let run = outcome(&bare_slider_crank(mu, pull));
    assert_eq!(run.report.status, Status::CompletedWithGaps);
    let names = [
        "driver.motor.value",
        "slider.vx",
        "slider.ax",
        "driver.motor.effort",
        "joint.g.friction",
    ];
    let columns = names.map(|name| run.trajectory.column_index(name).expect("a column"));
    let mut counts = [0, 0];
    for row in run.trajectory.rows() {
        let [angle, v, a, effort, friction] = columns.map(|column| row[column]);
        let (by_hand, margin) = slider_by_hand(mu, pull, angle, [v, a]);
        assert_eq!(
            by_hand.is_none(),
            effort.is_nan() && friction.is_nan(),
            "{angle}: {margin}"
        );
        if let Some([_, _, wanted]) = by_hand {
            close(effort, wanted, 1e-10 / margin);
        }
        counts[usize::from(by_hand.is_none())] += 1;
    }
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
    let event = run
        .report
        .events
        .iter()
        .find(|event| event.kind == "self_locking")
        .expect("an event");
    let note = event.note.as_deref().expect("a note");
    assert!(note.starts_with("joint \"g\" locks itself"), "{note}");
    assert!(
        run.report
            .warnings
            .iter()
            .any(|warning| warning.contains("locks itself")),
        "{:?}",
        run.report.warnings
    );
    assert!(run.report.quality.power_imbalance.expect("forces") < 1e-12);
}

/// A heavy crank drives the slider; the pull changes until the guide presses from the side on which friction wedges.
#[test]
fn motion_that_locks_itself_ends_with_the_joint_named() {
    let mut model = bare_slider_crank(1.1, 0.0);
    model.as_object_mut().expect("a map").remove("drivers");
    model["bodies"]["crank"]["inertia"] = json!(5.0);
    model["forces"]["pull"]["vector"][0] =
        json!({ "type": "polynomial", "coefficients": [-60.0, 100.0] });
    model["analysis"] = dynamics(2.0, 201, 1e-8);
    model["initial"] = json!({ "crank": { "angle": 1.3, "angular_velocity": 0.5 } });
    let run = outcome(&model);
    let message = run.report.message.clone().expect("why it ended");
    assert_eq!(run.report.status, Status::Singular, "{message}");
    assert!(message.contains("joint \"g\" locks itself"), "{message}");
    // Where the guide presses no more: 0 = m g − S sin φ with S cos φ = m a − P; rows until there are whole.
    let columns = ["time", "crank.angle", "slider.ax", "joint.g.fy"].map(|name| column(&run, name));
    let row = columns[0].len() - 1;
    let free = |row: usize| {
        let phi = (-0.8 * columns[1][row].sin()).asin();
        G - (columns[2][row] + 60.0 - 100.0 * columns[0][row]) * phi.tan()
    };
    assert!(
        columns[3].iter().all(|normal| *normal > 0.0) && columns[3][row] < 0.03 * columns[3][0],
        "{:?}",
        columns[3]
    );
    assert!(
        free(row) > 0.0 && free(row) + (free(row) - free(row - 1)) < 0.0,
        "{} {}",
        free(row - 1),
        free(row)
    );
    // And where it starts locked, at once.
    model["forces"]["pull"]["vector"][0] = json!(40.0);
    let run = outcome(&model);
    assert_eq!(run.report.status, Status::Singular);
    let message = run.report.message.expect("why it did not begin");
    assert!(
        message.starts_with("at the start joint \"g\" locks itself"),
        "{message}"
    );
}

/// The four-bar of the examples with friction in all its pins.
fn four_bar(mu: f64) -> Value {
    let text = linkdyn_model::bundled::find("four-bar")
        .expect("bundled")
        .text;
    let mut four_bar: Value = serde_json::from_str(text).expect("valid JSON");
    for joint in four_bar["joints"]
        .as_object_mut()
        .expect("a map")
        .values_mut()
    {
        joint["friction"] = coulomb(mu, 1e-3);
        joint["pin_radius"] = json!("8 mm");
    }
    four_bar["analysis"] = json!({ "type": "inverse_dynamics", "end": 0.5, "outputs": 51 });
    four_bar
}

#[test]
fn vanishing_friction_is_none_in_proportion() {
    let mut ideal = four_bar(0.0);
    for joint in ideal["joints"].as_object_mut().expect("a map").values_mut() {
        joint.as_object_mut().expect("a map").remove("friction");
    }
    let ideal = completed(&ideal);
    let off = |mu: f64| {
        let run = completed(&four_bar(mu));
        let pairs = column(&run, "driver.motor.effort")
            .into_iter()
            .zip(column(&ideal, "driver.motor.effort"));
        pairs.fold(0.0, |most: f64, (ours, without)| {
            most.max((ours - without).abs())
        })
    };
    let [full, half, quarter] = [4e-4, 2e-4, 1e-4].map(off);
    println!("{full:e} {half:e} {quarter:e}");
    assert!(
        quarter > 1e-6 && (full / half - 2.0).abs() < 1e-3 && (half / quarter - 2.0).abs() < 1e-3
    );
    assert_eq!(off(0.0), 0.0);
    assert!(
        ideal
            .trajectory
            .columns
            .iter()
            .all(|column| !column.name.ends_with(".friction"))
    );
}

/// Free motion from a state of the driven one has its accelerations when its driver's effort acts as a torque.
#[test]
fn forward_and_inverse_dynamics_agree() {
    let mut driven = four_bar(0.2);
    driven["drivers"]["motor"]["motion"] =
        json!({ "type": "polynomial", "coefficients": ["60 deg", "10 rad/s", "-2 rad/s^2"] });
    let run = completed(&driven);
    let mut free = driven.clone();
    free.as_object_mut().expect("a map").remove("drivers");
    let effort = column(&run, "driver.motor.effort")[0];
    free["forces"]["motor"] =
        json!({ "type": "torque", "body": "crank", "value": format!("{effort:e} N*m") });
    free["initial"] = json!({ "crank": { "angle": "60 deg", "angular_velocity": "10 rad/s" } });
    free["analysis"] = dynamics(0.01, 2, 1e-9);
    let start = completed(&free);
    for name in [
        "crank.alpha",
        "rocker.alpha",
        "joint.b.fx",
        "joint.c.fy",
        "joint.b.friction",
        "joint.d.friction",
    ] {
        let (ours, theirs) = (column(&start, name)[0], column(&run, name)[0]);
        assert!(
            (ours - theirs).abs() < 1e-9 * theirs.abs().max(1.0),
            "{name}: {ours} {theirs}"
        );
    }
}

/// Bristles hold a block that a regularised law would let creep, and let it go at the static coefficient.
#[test]
fn bristles_stick_and_break_away() {
    let mut model = incline(0.2, &lugre(0.15, 0.25));
    model["analysis"] = dynamics(2.0, 3, 1e-8);
    // Next to no power flows, so its balance is told in parts of nothing.
    let run = outcome(&model);
    assert_eq!(run.report.status, Status::Completed);
    let moved = column(&run, "block.x");
    // It gives way by some deflections of the bristles, and stays there.
    assert!(
        moved[2] > 0.2_f64.tan() / 1e4 && moved[2] < 1e-3,
        "{moved:?}"
    );
    close(moved[2], moved[1], 1e-8);
    close(
        last(&run, "joint.g.friction"),
        -2.0 * G * 0.2_f64.sin(),
        1e-4,
    );
    let mut model = incline(0.3, &lugre(0.15, 0.25));
    model["analysis"] = dynamics(2.0, 3, 1e-8);
    let run = completed(&model);
    let (sin, cos) = 0.3_f64.sin_cos();
    close(
        last(&run, "block.ax").hypot(last(&run, "block.ay")),
        G * (sin - 0.15 * cos),
        1e-6,
    );
}

/// Through change points: what exists is there, and power balances.
#[test]
fn a_parallelogram_passes_its_change_point() {
    let motion = json!({ "type": "polynomial", "coefficients": [0.5, 4.0] });
    for joint in ["o0", "p0"] {
        let mut model = parallelogram(1, false, 0.5, &motion);
        model["joints"][joint]["friction"] = coulomb(0.05, 1e-3);
        model["joints"][joint]["pin_radius"] = json!(0.004);
        model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.5, "outputs": 151 });
        let run = outcome(&model);
        let quality = &run.report.quality;
        println!(
            "{joint}: {:?} {quality:?} {:?} {:?}",
            run.report.status, run.report.events, run.report.warnings
        );
        assert!(
            quality.power_imbalance.expect("forces") < 1e-9,
            "{quality:?}"
        );
        let efforts = column(&run, "driver.motor.effort");
        assert!(
            efforts.iter().filter(|effort| effort.is_finite()).count() >= 149,
            "{efforts:?}"
        );
    }
}

/// Free motion through a change point is not without doubt, and says so; with much friction it locks there.
#[test]
fn free_motion_through_a_change_point_is_told() {
    let free = |mu: f64| {
        let mut model = parallelogram(1, false, 0.5, &json!(null));
        model.as_object_mut().expect("a map").remove("drivers");
        model["gravity"] = json!([0.0, 0.0]);
        for joint in model["joints"].as_object_mut().expect("a map").values_mut() {
            joint["friction"] = coulomb(mu, 1e-3);
            joint["pin_radius"] = json!(0.005);
        }
        model["initial"] = json!({ "c0": { "angle": 0.5, "angular_velocity": 10.0 } });
        model["analysis"] = dynamics(0.5, 501, 1e-8);
        outcome(&model)
    };
    let run = free(1e-6);
    assert_eq!(
        run.report.status,
        Status::Completed,
        "{:?}",
        run.report.message
    );
    assert!(
        run.report
            .warnings
            .iter()
            .any(|warning| warning.contains("passes a change point")),
        "{:?}",
        run.report
    );
    let run = free(0.3);
    println!(
        "{:?} {:?} {:?}",
        run.report.status, run.report.message, run.report.warnings
    );
    let message = run.report.message.expect("why it ended");
    assert!(message.contains("locks itself"), "{message}");
}

/// What slows a free mechanism down is what its pins turn into heat: Simpson's rule over the columns.
#[test]
fn lost_energy_is_the_work_of_friction() {
    let mut model = four_bar(0.0);
    model.as_object_mut().expect("a map").remove("drivers");
    model.as_object_mut().expect("a map").remove("forces");
    for joint in model["joints"].as_object_mut().expect("a map").values_mut() {
        joint["friction"] = json!({ "law": "stribeck", "coefficient": 0.1, "static_coefficient": 0.15,
            "stribeck_velocity": "50 mm/s", "threshold_velocity": "10 mm/s", "viscous": 0.2 });
    }
    model["initial"] = json!({ "crank": { "angle": "60 deg", "angular_velocity": "25 rad/s" } });
    model["analysis"] = dynamics(0.5, 4001, 1e-10);
    let run = completed(&model);
    let get = |name: &str| column(&run, name);
    let [crank, coupler, rocker] = ["crank.omega", "coupler.omega", "rocker.omega"].map(get);
    let [a, b, c, d] =
        ["a", "b", "c", "d"].map(|joint| column(&run, &format!("joint.{joint}.friction")));
    let power = |k: usize| {
        a[k] * crank[k]
            + b[k] * (coupler[k] - crank[k])
            + c[k] * (rocker[k] - coupler[k])
            + d[k] * rocker[k]
    };
    let (kinetic, potential) = (get("energy.kinetic"), get("energy.potential"));
    let step = get("time")[1];
    let (mut work, mut worst) = (0.0, 0.0_f64);
    for k in (2..kinetic.len()).step_by(2) {
        assert!(power(k) <= 0.0, "{k}");
        work += step / 3.0 * (power(k - 2) + 4.0 * power(k - 1) + power(k));
        worst = worst.max((kinetic[k] + potential[k] - kinetic[0] - potential[0] - work).abs());
    }
    println!("{worst:e} of {work} J");
    assert!(
        work < -0.5 && worst < 1e-6 * work.abs(),
        "{worst:e} of {work} J"
    );
}

/// A clearance that rattles beside a pin that rubs: the energy ledger holds both.
#[test]
fn contacts_and_friction_share_the_ledger() {
    let mut model = pendulum(-0.2, 0.02, &coulomb(0.2, 0.01));
    model["bodies"]["tip"] = rod(0.5, [0.98, -0.2], -0.3);
    model["joints"]["b"] = pin("bar.B", "tip.A");
    model["joints"]["b"]["clearance"] = json!({ "model": "contact", "radius": 0.001, "normal": {
        "law": "lankarani_nikravesh", "stiffness": 1e7, "exponent": 1.5, "restitution": 0.7 } });
    model["initial"]["tip"] = json!({ "angle": -0.9 });
    model["analysis"] = dynamics(0.5, 51, 1e-8);
    let run = outcome(&model);
    assert_eq!(
        run.report.status,
        Status::Completed,
        "{:?}",
        run.report.message
    );
    let quality = &run.report.quality;
    println!("{quality:?}");
    assert!(
        quality.energy_imbalance.expect("a ledger") < 1e-6,
        "{quality:?}"
    );
    assert!(
        column(&run, "joint.o.friction")
            .iter()
            .any(|friction| friction.abs() > 0.02)
    );
}

/// Friction beside a massless clearance link: the link follows the force that friction has changed.
#[test]
fn friction_and_clearance_links_share_the_fixed_point() {
    let mut model = four_bar(0.2);
    model["joints"]["c"] = json!({ "type": "revolute", "between": model["joints"]["c"]["between"],
        "clearance": { "model": "massless_link", "radius": "0.1 mm" } });
    let run = outcome(&model);
    assert_eq!(
        run.report.status,
        Status::Completed,
        "{:?}",
        run.report.message
    );
    for row in 0..run.trajectory.len() {
        let [ex, ey, fx, fy] =
            ["ex", "ey", "fx", "fy"].map(|name| column(&run, &format!("joint.c.{name}"))[row]);
        close(ex.hypot(ey), 1e-4, 1e-16);
        close((ex * fy - ey * fx) / fx.hypot(fy), 0.0, 1e-9);
    }
    assert!(
        run.report.quality.power_imbalance.expect("forces") < 1e-9,
        "{:?}",
        run.report.quality
    );
}

fn said(joint: Value) -> Vec<String> {
    let mut model = pendulum(0.0, 0.01, &json!({ "law": "none" }));
    model["joints"]["o"] = joint;
    match linkdyn_model::load(model.to_string().as_bytes(), &[]) {
        Ok(loaded) => loaded.warnings,
        Err(complaints) => {
            let text = |complaint: &linkdyn_model::error::Complaint| {
                let text = complaint.to_string();
                text.split_once("joints.o")
                    .map_or(text.clone(), |(_, rest)| rest.to_string())
            };
            complaints.iter().map(text).collect()
        }
    }
}

#[test]
fn complaints_say_what_lacks_and_where_it_belongs() {
    let pin = |more: Value| {
        let mut joint = json!({ "type": "revolute", "between": ["ground.O", "bar.A"] });
        for (key, value) in more.as_object().expect("a map") {
            joint[key] = value.clone();
        }
        said(joint)
    };
    let sound = coulomb(0.1, 0.01);
    assert!(pin(json!({ "friction": sound, "pin_radius": "8 mm" })).is_empty());
    assert!(pin(json!({ "friction": { "law": "none" } })).is_empty());
    assert_eq!(
        pin(json!({ "friction": sound })),
        [
            ": \"pin_radius\" is missing (the torque of the friction is that of its force on the pin's surface)"
        ]
    );
    assert_eq!(
        pin(json!({ "friction": { "law": "coulomb", "coefficient": 0.1 }, "pin_radius": 0.01 })),
        [": \"friction.threshold_velocity\" is missing (the law \"coulomb\" needs it)"]
    );
    let clearance =
        |model: &str| json!({ "model": model, "radius": 1e-4, "surface": { "stiffness": 1e8 } });
    let both = |model: &str| json!({ "friction": sound, "pin_radius": 0.01, "clearance": clearance(model) });
    assert!(pin(both("ideal")).is_empty());
    for complaint in [pin(both("two_state")), pin(both("massless_link"))].concat() {
        assert!(
            complaint.starts_with(".friction: ") && complaint.contains("is that of an ideal joint"),
            "{complaint}"
        );
    }
    let zero = pin(json!({ "friction": sound, "pin_radius": 0.0 }));
    assert!(
        zero.len() == 1 && zero[0].starts_with(".pin_radius: 0"),
        "{zero:?}"
    );
    let slot = said(
        json!({ "type": "slot", "between": ["ground.O", "bar.A"], "axis": [1.0, 0.0], "friction": sound }),
    );
    assert!(
        slot.iter()
            .any(|text| text.contains("only revolute and prismatic joints can have friction")),
        "{slot:?}"
    );
}

#[test]
fn what_has_no_history_has_no_bristles_and_rest_no_friction() {
    let mut driven = four_bar(0.1);
    driven["joints"]["b"]["friction"] = lugre(0.1, 0.2);
    let complaints = run(&loaded(&driven).model, &Control::default()).expect_err("refused");
    assert_eq!(complaints.len(), 1);
    let text = complaints[0].to_string();
    assert!(
        text.contains("joints.b.friction.law") && text.contains("bristles have a history"),
        "{text}"
    );
    driven["analysis"]["type"] = json!("kinematics");
    assert_eq!(outcome(&driven).report.status, Status::Completed);

    let mut resting = pendulum(-1.0, 0.01, &coulomb(0.1, 0.01));
    resting["analysis"] = json!({ "type": "statics" });
    let run = outcome(&resting);
    assert!(
        run.report
            .warnings
            .iter()
            .any(|text| text.starts_with("the friction of o is left out")),
        "{:?}",
        run.report.warnings
    );
    close(last(&run, "bar.angle"), -std::f64::consts::FRAC_PI_2, 1e-9);
    assert!(run.trajectory.values("joint.o.friction").is_none());
}

const LOCKING: &str = include_str!("../cases/friction-lock.json");

/// A parallelogram that swings into its flat position: its pins' friction grows as 1/(t* − t) towards the lock before it, so
/// that no step reaches it. Whatever the tolerance, the run ends there and names the joint.
#[test]
fn a_lock_that_no_step_reaches_ends_as_one() {
    let mut ends = Vec::new();
    for rtol in [1e-4, 1e-6, 1e-8, 1e-10] {
        let mut model: Value = serde_json::from_str(LOCKING).expect("JSON");
        model["analysis"] = dynamics(1.0, 10_001, rtol);
        let run = outcome(&model);
        assert_eq!(
            run.report.status,
            Status::Singular,
            "{rtol}: {:?}",
            run.report.message
        );
        let message = run.report.message.as_deref().expect("a message");
        assert!(
            message.contains("joint \"b\" locks itself") && !message.contains("oosen"),
            "{message}"
        );
        assert!(
            message.starts_with("at t = 0.49") && message.contains("the rows until there are kept"),
            "{message}"
        );
        let (forces, times) = (column(&run, "joint.b.fx"), column(&run, "time"));
        let end = times[times.len() - 1];
        assert!(forces.iter().all(|force| force.is_finite()));
        ends.push(end);
    }
    assert!(
        ends.iter()
            .all(|end| (end - ends[3]).abs() <= 1.01e-4 * (1.0 + ends[3])),
        "{ends:?}"
    );
}
