//! Equilibria and small motions against closed forms.

mod along;
mod coupled;
mod springs;
mod strokes;

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, Linearised, Outcome, modes, run};
use linkdyn_model::load;
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, PI};

const G: f64 = 9.81;

/// A model for statics.
fn statics(bodies: Value, joints: Value, forces: Value) -> Value {
    let mut model = model(bodies, joints, json!({}));
    model["forces"] = forces;
    model["analysis"] = json!({ "type": "statics" });
    model
}

fn stability(outcome: &Outcome) -> &'static str {
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    outcome
        .report
        .equilibrium
        .as_ref()
        .expect("an equilibrium")
        .stability
}

fn value(outcome: &Outcome, name: &str) -> f64 {
    column(outcome, name)[0]
}

fn linearised(model: &Value, pose: bool) -> Linearised {
    modes(&loaded(model).model, pose, &Control::default()).unwrap_or_else(|said| panic!("{said:?}"))
}

/// A rod of length 0.8 m hinged at the origin, drawn at `angle` (0 is along +x).
fn pendulum(angle: f64) -> Value {
    let bodies =
        json!({ "ground": { "points": { "O": [0.0, 0.0] } }, "rod": rod(0.8, [0.0, 0.0], angle) });
    statics(bodies, json!({ "o": pin("ground.O", "rod.A") }), json!({}))
}

#[test]
fn a_pendulum_hangs_from_wherever_it_is_let_go() {
    for angle in [-3.0, -1.5, 0.0, 0.7, FRAC_PI_2 - 1e-6] {
        let run = outcome(&pendulum(angle));
        assert_eq!(stability(&run), "stable", "{angle}");
        close(value(&run, "rod.angle"), -FRAC_PI_2, 1e-14);
        close(value(&run, "joint.o.fy"), G, 1e-13);
        close(value(&run, "energy.potential"), -0.4 * G, 1e-13);
        close(
            run.report.equilibrium.as_ref().expect("there").stiffness[0],
            0.4 * G,
            1e-13,
        );
    }
    // ω² = m g l / (J + m l²), l = L/2: 3g/(2L).
    let found = linearised(&pendulum(0.3), false);
    assert_eq!(found.modes.len(), 1);
    close(found.modes[0].frequency(), (1.5 * G / 0.8).sqrt(), 1e-13);
    assert_eq!(found.modes[0].damping_ratio(), Some(0.0));
    assert_eq!(found.modes[0].shape[0][2], [1.0, 0.0]);
}

#[test]
fn an_upright_pendulum_is_unstable() {
    let run = outcome(&pendulum(FRAC_PI_2));
    assert_eq!(stability(&run), "unstable");
    assert!(
        run.report.warnings[0].contains("unstable"),
        "{:?}",
        run.report.warnings
    );
    close(
        run.report.equilibrium.as_ref().expect("there").stiffness[0],
        -0.4 * G,
        1e-13,
    );
    let found = linearised(&pendulum(FRAC_PI_2), false);
    let rates: Vec<f64> = found.modes.iter().map(|mode| mode.eigenvalue[0]).collect();
    let rate = (1.5 * G / 0.8).sqrt();
    close(rates[0], rate, 1e-13);
    close(rates[1], -rate, 1e-13);
}

/// Two rods of one length and mass hanging from each other: ω² = (3 ∓ 6/√7) g/l, shapes θ₂/θ₁ = (2√7 ∓ 1)/3 … (Landau §5).
#[test]
fn a_double_pendulum_of_rods_has_its_two_frequencies() {
    let l = 0.6;
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
                         "upper": rod(l, [0.0, 0.0], 0.4), "lower": rod(l, [0.55, 0.2], -0.9) });
    let joints = json!({ "o": pin("ground.O", "upper.A"), "p": pin("upper.B", "lower.A") });
    let model = statics(bodies, joints, json!({}));
    let run = outcome(&model);
    assert_eq!(stability(&run), "stable");
    for body in ["upper", "lower"] {
        close(
            (value(&run, &format!("{body}.angle")) + FRAC_PI_2).sin(),
            0.0,
            1e-13,
        );
    }
    let found = linearised(&model, false);
    for (mode, sign) in found.modes.iter().zip([-1.0, 1.0]) {
        close(
            mode.frequency(),
            ((3.0 + sign * 6.0 / 7.0_f64.sqrt()) * G / l).sqrt(),
            1e-12,
        );
        // From the second row of (K − ω² M) x = 0 with M = [4/3, 1/2; 1/2, 1/3] m l², K = [3/2, 0; 0, 1/2] m g l.
        let square = mode.frequency().powi(2) * l / G;
        let ratio = mode.shape[1][2][0] / mode.shape[0][2][0];
        close(ratio, 0.5 * square / (0.5 - square / 3.0), 1e-11);
    }
}

/// A block of 2 kg on a vertical slide, on a spring from above.
fn hanging_block(kind: &str, damping: f64) -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0], "T": [0.0, 1.0] } },
        "block": { "mass": 2.0, "inertia": 0.3, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
                   "pose": { "position": [0.0, 0.4] } },
    });
    let joints =
        json!({ "g": { "type": kind, "between": ["ground.O", "block.C"], "axis": [0.0, 1.0] } });
    let spring = json!({ "type": "spring", "between": ["ground.T", "block.C"], "stiffness": 150.0, "damping": damping,
                         "free_length": 0.3 });
    statics(bodies, joints, json!({ "s": spring }))
}

#[test]
fn a_frame_without_freedom_has_its_thrust() {
    let h = 3.0_f64.sqrt() / 2.0;
    let bodies = json!({
        "ground": { "points": { "A": [0.0, 0.0], "B": [1.0, 0.0] } },
        "left": rod(1.0, [0.0, 0.0], 1.0), "right": rod(1.0, [1.0, 0.0], 2.1),
    });
    let joints = json!({ "p": pin("ground.A", "left.A"), "q": pin("ground.B", "right.A"), "r": pin("left.B", "right.B") });
    let run = outcome(&statics(bodies, joints, json!({})));
    assert_eq!(stability(&run), "stable");
    close(value(&run, "joint.p.fx"), 0.5 * G * 0.5 / h, 1e-12);
    close(value(&run, "joint.p.fy"), G, 1e-12);
}

#[test]
fn a_driver_holds_its_crank_at_the_start_value() {
    let mut model = slider_crank(
        0.1,
        0.3,
        0.5,
        false,
        &json!({ "type": "polynomial", "coefficients": [0.5, 7.0] }),
    );
    model["analysis"] = json!({ "type": "statics" });
    let run = outcome(&model);
    close(value(&run, "crank.angle"), 0.5, 1e-15);
    // Virtual work: centres of crank and rod rise by r/2 cos θ each per rad (the rod's other end does not).
    close(
        value(&run, "driver.motor.effort"),
        G * 0.1 * 0.5_f64.cos(),
        1e-13,
    );
    assert!(
        run.trajectory.column_index("crank.omega").is_none()
            && run.trajectory.column_index("crank.ax").is_none()
    );
}

#[test]
fn a_rod_on_an_axis_without_gravity_is_indifferent() {
    let mut model = pendulum(0.7);
    model["gravity"] = json!([0.0, 0.0]);
    let run = outcome(&model);
    assert_eq!(stability(&run), "indifferent");
    close(value(&run, "rod.angle"), 0.7, 1e-15);
    assert_eq!(linearised(&model, false).modes[0].frequency(), 0.0);
    // As with its centre of mass on the axis, under gravity.
    let mut model = pendulum(0.7);
    model["bodies"]["rod"]["com"] = json!([0.0, 0.0]);
    assert_eq!(stability(&outcome(&model)), "indifferent");
}

#[test]
fn a_load_that_nothing_balances_has_no_equilibrium() {
    let mut model = hanging_block("prismatic", 0.0);
    model["forces"] = json!({});
    let run = outcome(&model);
    assert_eq!(
        (run.report.status, run.trajectory.len()),
        (Status::Singular, 0)
    );
    let said = run.report.message.expect("a message");
    assert!(
        said.contains("no equilibrium found: something still pulls at block.y")
            && !said.contains("friction"),
        "{said}"
    );
    let mut joints = model["joints"]
        .as_object_mut()
        .expect("joints")
        .values_mut();
    joints.next().expect("a guide")["friction"] =
        json!({ "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 0.01 });
    let said = outcome(&model).report.message.expect("a message");
    assert!(said.contains("; the friction of"), "{said}");
}

#[test]
fn quasi_statics_says_what_it_lacks_and_refuses() {
    let mut model = hanging_block("prismatic", 0.0);
    model["analysis"] = json!({ "type": "quasi_statics" });
    let said = format!("{:?}", load(model.to_string().as_bytes(), &[]).map(|_| ()));
    assert!(said.contains("it is not said for which instants"), "{said}");
    model["analysis"] = json!({ "type": "quasi_statics", "end": 1, "outputs": 3 });
    model["states"] = json!({ "heat": { "rate": "1 J/s", "start": "0 J" } });
    let said = format!("{:?}", load(model.to_string().as_bytes(), &[]).map(|_| ()));
    assert!(
        said.contains("states are integrated in a free motion, and quasi-statics has none"),
        "{said}"
    );
}

/// A follower force F along the rod's end against a torsion spring and a side load: the stiffness is not symmetric, the
/// equilibrium is where both joints' torques balance.
#[test]
fn a_follower_force_is_followed() {
    let l = 0.5;
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
                         "first": rod(l, [0.0, 0.0], 0.1), "second": rod(l, [l, 0.0], 0.2) });
    let joints = json!({ "o": pin("ground.O", "first.A"), "p": pin("first.B", "second.A") });
    let forces = json!({
        "k1": { "type": "torsion_spring", "between": ["first", "ground"], "stiffness": 9.0 },
        "k2": { "type": "torsion_spring", "between": ["second", "first"], "stiffness": 7.0 },
        "push": { "type": "force", "at": "second.B", "vector": [-4.0, -3.0], "frame": "body" },
    });
    let mut model = statics(bodies, joints, forces);
    model["gravity"] = json!([0.0, 0.0]);
    let run = outcome(&model);
    assert_eq!(stability(&run), "stable");
    let (a, b) = (value(&run, "first.angle"), value(&run, "second.angle"));
    close(7.0 * (b - a), -3.0 * l, 1e-13);
    let (fx, fy) = (
        -4.0 * b.cos() + 3.0 * b.sin(),
        -4.0 * b.sin() - 3.0 * b.cos(),
    );
    close(
        9.0 * a - 7.0 * (b - a),
        l * (a.cos() * fy - a.sin() * fx),
        1e-13,
    );
    assert!(b.abs() < PI);
}

#[test]
fn modes_about_the_pose_are_those_of_the_pose() {
    // A pendulum drawn at −30° from straight down: K = m g l cos 30°.
    let angle = -FRAC_PI_2 + PI / 6.0;
    let found = linearised(&pendulum(angle), true);
    close(found.bodies[0].1[2], angle, 1e-15);
    close(
        found.modes[0].frequency(),
        (1.5 * G / 0.8 * (PI / 6.0).cos()).sqrt(),
        1e-13,
    );
}

#[test]
fn what_is_needed_and_what_is_refused() {
    let complaint = |model: &Value| match run(&loaded(model).model, &Control::default()) {
        Ok(_) => panic!("bad input was accepted"),
        Err(said) => said
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>()
            .join("\n"),
    };
    let mut model = pendulum(0.3);
    model["bodies"]["rod"]
        .as_object_mut()
        .expect("a map")
        .remove("inertia");
    assert_eq!(stability(&outcome(&model)), "stable");
    model["bodies"]["rod"]
        .as_object_mut()
        .expect("a map")
        .remove("mass");
    assert!(complaint(&model).contains("statics under gravity needs the mass of body \"rod\""));
    let mut model = pendulum(0.3);
    model["joints"]["o"]["clearance"] = json!({ "model": "massless_link", "radius": 1e-4 });
    assert!(complaint(&model).contains("clearance link"));
    // Taken for open, the rod would fall, or have a mode more.
    for clearance in ["contact", "two_state", "three_state"] {
        model["joints"]["o"]["clearance"] = json!({ "model": clearance, "radius": 1e-4, "bearing_radius": 0.01,
            "normal": { "law": "hertz", "stiffness": 1e9, "restitution": 0.5 },
            "surface": { "stiffness": 1e8, "damping": 1e3 } });
        let small = modes(&loaded(&model).model, false, &Control::default())
            .expect_err("a journal that moves");
        for said in [complaint(&model), small[0].to_string()] {
            assert!(
                said.contains("joints.o.clearance.model: ")
                    && said.contains("a journal in its bearing"),
                "{said}"
            );
        }
    }
    let mut model = pendulum(0.3);
    model["drivers"] = json!({ "m": { "type": "rotation", "body": "rod", "motion": { "type": "constant_velocity", "velocity": 1.0 } } });
    let said =
        modes(&loaded(&model).model, false, &Control::default()).expect_err("nothing is free");
    assert!(said[0].to_string().contains("free to move"), "{said:?}");
}

/// Rows that are independent where it is drawn are not where it hangs.
#[test]
fn a_third_crank_takes_no_part_in_how_the_others_swing() {
    for start in [-2.8, -1.0, 0.6, 2.0, 3.0] {
        let mut model = parallelogram(
            1,
            true,
            start,
            &json!({ "type": "polynomial", "coefficients": [start] }),
        );
        model["drivers"] = json!({});
        let found = linearised(&model, false);
        assert_eq!(
            (found.status, found.modes.len()),
            (Status::Completed, 1),
            "{:?}",
            found.message
        );
        // K = g r (½·3 + 1), J = r² (⅓·3 + 1).
        close(
            found.modes[0].frequency(),
            (G * 2.5 / 0.1 / 2.0).sqrt(),
            1e-11,
        );
        assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    }
}
