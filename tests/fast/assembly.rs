//! Assembly: from rough guesses, with exact initial values, and what is said when it can't be.

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, run};
use linkdyn_output::Status;
use serde_json::{Value, json};

fn still(value: f64) -> Value {
    json!({ "type": "polynomial", "coefficients": [value, 1.0] })
}

fn failure(model: &Value) -> String {
    let outcome = outcome(model);
    assert_eq!(
        outcome.report.status,
        Status::AssemblyFailed,
        "{:?}",
        outcome.report.message
    );
    outcome.report.message.expect("a message")
}

fn complaint(model: &Value) -> String {
    let loaded = loaded(model);
    let Err(complaints) = run(&loaded.model, &Control::default()) else {
        panic!("bad input was accepted")
    };
    assert_eq!(complaints.len(), 1, "{complaints:?}");
    loaded.source.place(complaints[0].clone()).to_string()
}

#[test]
fn a_slider_crank_without_poses_assembles() {
    let mut model = slider_crank(0.1, 0.3, 0.5, false, &still(0.5));
    for body in ["crank", "rod", "slider"] {
        model["bodies"][body]
            .as_object_mut()
            .expect("a map")
            .remove("pose");
    }
    let x = column(&outcome(&model), "slider.x")[0];
    assert!((x - slider_position(0.1, 0.3, 0.5)).abs() < 1e-15, "{x}");
}

/// The bodies of a drawing without poses lie in a line, from which no way leads to the assembly: it is found all the same,
/// and that is said.
#[test]
fn a_drawing_in_a_line_assembles() {
    for [base, crank, coupler, rocker] in [
        [3.0, 1.0, 3.0, 2.5],
        [2.0, 0.7, 1.9, 2.1],
        [1.4, 0.5, 2.0, 2.3],
    ] {
        let ground = json!({ "points": { "O": [0.0, 0.0], "Q": [base, 0.0] } });
        let link = |length: f64| json!({ "points": { "A": [0.0, 0.0], "B": [length, 0.0] } });
        let bodies = json!({ "ground": ground, "crank": link(crank), "coupler": link(coupler), "rocker": link(rocker) });
        let joints = json!({ "a": pin("ground.O", "crank.A"), "b": pin("crank.B", "coupler.A"),
            "c": pin("coupler.B", "rocker.B"), "d": pin("rocker.A", "ground.Q") });
        let drivers =
            json!({ "motor": { "type": "rotation", "body": "crank", "motion": still(0.0) } });
        let mut model = model(bodies, joints, drivers);
        model["analysis"] = json!({ "type": "kinematics", "end": 1.0, "outputs": 2 });
        let outcome = outcome(&model);
        assert_eq!(
            outcome.report.status,
            Status::Completed,
            "{:?}",
            outcome.report.message
        );
        assert!(
            outcome
                .report
                .warnings
                .iter()
                .any(|said| said.contains("lie in a line?")),
            "{:?}",
            outcome.report.warnings
        );
        // The law of cosines for the angle at the rocker's pin.
        let reach = base - crank;
        let cosine = (rocker * rocker + reach * reach - coupler * coupler) / (2.0 * rocker * reach);
        let angle = column(&outcome, "rocker.angle")[0];
        assert!((angle.cos() + cosine).abs() < 1e-12, "{angle} for {cosine}");
    }
}

/// Of a mechanism that is not assembled there is no residual, and its drawing's own singularity is not told as redundancy.
#[test]
fn a_failed_assembly_has_no_residual() {
    let mut model = slider_crank(0.1, 0.3, 0.5, false, &still(0.5));
    for body in ["crank", "rod", "slider"] {
        model["bodies"][body]
            .as_object_mut()
            .expect("a map")
            .remove("pose");
    }
    model["bodies"]["ground"]["points"]["H"] = json!([0.0, 2.0]);
    model["joints"]["g"]["between"][0] = json!("ground.H");
    let outcome = outcome(&model);
    assert_eq!(
        outcome.report.status,
        Status::AssemblyFailed,
        "{:?}",
        outcome.report.message
    );
    assert!(outcome.report.quality.constraint_residual.is_nan());
    assert_eq!(
        (
            outcome.report.mobility.rank,
            outcome.report.mobility.redundant.len()
        ),
        (1, 0)
    );
}

#[test]
fn lengths_that_overflow_are_refused() {
    let mut model = slider_crank(0.1, 0.3, 0.5, false, &still(0.5));
    let joint = model["joints"]
        .as_object()
        .expect("a map")
        .keys()
        .next()
        .expect("one")
        .clone();
    let point = model["joints"][&joint]["between"][1]
        .as_str()
        .expect("text")
        .to_string();
    let (body, point) = point.split_once('.').expect("a point");
    model["bodies"][body]["points"][point] = json!([1e160, 0.0]);
    let said = complaint(&model);
    assert!(said.contains("where numbers overflow"), "{said}");
}

#[test]
fn rough_guesses_lead_to_the_branch_they_are_near() {
    for off in [-0.3, -0.1, 0.2, 0.35] {
        let mut model = slider_crank(0.1, 0.3, 0.5, false, &still(0.5));
        model["bodies"]["rod"]["pose"] =
            json!({ "position": [0.1 + off * 0.2, 0.05 - 0.1 * off], "angle": off });
        model["bodies"]["slider"]["pose"] =
            json!({ "position": [0.3 - 0.3 * off, off * 0.1], "angle": -off });
        let x = column(&outcome(&model), "slider.x")[0];
        assert!(
            (x - slider_position(0.1, 0.3, 0.5)).abs() < 1e-15,
            "{off}: {x}"
        );
    }
}

#[test]
fn initial_values_are_met_exactly() {
    let mut model = slider_crank(0.1, 0.3, 0.5, false, &still(0.5));
    model.as_object_mut().expect("a map").remove("drivers");
    model["initial"] = json!({ "crank": { "angle": 2.0, "angular_velocity": 3.0 } });
    model["analysis"] = json!({ "type": "assembly" });
    let run = outcome(&model);
    assert!((column(&run, "crank.angle")[0] - 2.0).abs() < 1e-14);
    assert!((column(&run, "slider.x")[0] - slider_position(0.1, 0.3, 2.0)).abs() < 1e-14);
    assert!((column(&run, "crank.omega")[0] - 3.0).abs() < 1e-12);
    let h = 1e-6;
    let speed =
        3.0 * (slider_position(0.1, 0.3, 2.0 + h) - slider_position(0.1, 0.3, 2.0 - h)) / (2.0 * h);
    assert!((column(&run, "slider.vx")[0] - speed).abs() < 1e-9);
}

#[test]
fn free_velocities_are_those_of_least_kinetic_energy() {
    // A free rod whose end A is given v_y = 1: least energy with v_c + ω L/2·(−1) = 1 is v_c = 1/4, ω = −3/(2L).
    let bodies = json!({ "ground": {}, "rod": rod(0.4, [0.0, 0.0], 0.0) });
    let mut model = model(bodies, json!({}), json!({}));
    model["initial"] = json!({ "rod": { "vy": 1.0 } });
    model["analysis"] = json!({ "type": "assembly" });
    let run = outcome(&model);
    assert!(
        (column(&run, "rod.omega")[0] + 1.5 / 0.4).abs() < 1e-12,
        "{:?}",
        column(&run, "rod.omega")
    );
    assert!(
        (column(&run, "rod.vy")[0] - 1.0).abs() < 1e-12 && column(&run, "rod.vx")[0].abs() < 1e-12
    );
}

#[test]
fn conflicting_initial_values_are_named() {
    let mut model = slider_crank(0.1, 0.3, 0.5, false, &still(0.5));
    model.as_object_mut().expect("a map").remove("drivers");
    model["analysis"] = json!({ "type": "assembly" });
    model["initial"] = json!({ "crank": { "angle": 2.0 }, "slider": { "x": 0.33 } });
    assert_eq!(
        failure(&model),
        "can't assemble: initial value \"crank.angle\" and initial value \"slider.x\" can't be met together with the \
         joints and drivers; leave out one, or change it"
    );
    model["initial"] =
        json!({ "crank": { "angle": 2.0, "angular_velocity": 3.0 }, "slider": { "vx": 1.0 } });
    assert_eq!(
        failure(&model),
        "can't assemble: the initial velocities crank.angular_velocity, slider.vx can't be met together with the joints \
         and drivers"
    );
}

#[test]
fn an_open_loop_is_named_with_its_gap() {
    // Links of 0.1 + 0.1 m over a ground of 0.5 m: 0.2 m are missing (crank, coupler and rocker in a line: 0.3 m).
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0], "Q": [0.5, 0.0] } },
        "crank": rod(0.1, [0.0, 0.0], 0.3), "coupler": rod(0.1, [0.1, 0.0], 0.0), "rocker": rod(0.1, [0.5, 0.0], 2.8),
    });
    let joints = json!({ "o": pin("ground.O", "crank.A"), "a": pin("crank.B", "coupler.A"),
                         "b": pin("coupler.B", "rocker.B"), "q": pin("ground.Q", "rocker.A") });
    let mut model = model(bodies, joints, json!({}));
    model["analysis"] = json!({ "type": "assembly" });
    assert_eq!(
        failure(&model),
        "can't assemble: the loop o – a – b – q does not close; it lacks 0.2 m at the best position found; change a \
         length in it, or draw the guess closer to the assembly"
    );
}

#[test]
fn a_driver_value_out_of_reach_names_the_loop_and_the_gap() {
    assert_eq!(
        failure(&slider_crank(0.1, 0.3, 0.5, true, &still(0.5))),
        "can't assemble: the joints alone close, but with the drivers at their first values the loop o – a – b – g does \
         not close; it lacks 0.1 m at the best position found; change the start of a driver, or the lengths that keep \
         it from there"
    );
}

#[test]
fn too_many_and_too_few_drivers_are_bad_input() {
    let mut model = parallelogram(1, false, 1.0, &still(1.0));
    model["drivers"]["extra"] = json!({ "type": "rotation", "body": "c1",
        "motion": { "type": "constant_velocity", "start": 1.0, "velocity": 0.1 } });
    let said = complaint(&model);
    assert!(
        said.contains("drivers: too many drivers: the joints leave 1 degree of freedom, and there are 2 drivers (\"motor\", \"extra\")"),
        "{said}"
    );
    let mut model = parallelogram(1, false, 1.0, &still(1.0));
    model["bodies"]["loose"] = rod(0.1, [0.0, 0.0], 0.0);
    let said = complaint(&model);
    assert!(
        said.contains("too few drivers: the joints leave 4 degrees of freedom, 1 driven; \"loose\" can still move"),
        "{said}"
    );
}

#[test]
fn a_statically_determinate_frame_has_reactions_without_drivers() {
    // Two equal bars leaning on each other at 60°: each pivot carries its bar's weight, thrust W/2 · cot 60°.
    let (l, h) = (1.0, 3.0_f64.sqrt() / 2.0);
    let bodies = json!({
        "ground": { "points": { "A": [0.0, 0.0], "B": [1.0, 0.0] } },
        "left": rod(l, [0.0, 0.0], 1.0), "right": rod(l, [1.0, 0.0], 2.1),
    });
    let joints = json!({ "p": pin("ground.A", "left.A"), "q": pin("ground.B", "right.A"), "r": pin("left.B", "right.B") });
    let run = outcome(&model(bodies, joints, json!({})));
    let thrust = 0.5 * 9.81 * 0.5 / h;
    assert!((column(&run, "joint.p.fx")[0] - thrust).abs() < 1e-12);
    assert!((column(&run, "joint.p.fy")[0] - 9.81).abs() < 1e-12);
    assert!(
        (column(&run, "joint.r.fx")[0] - thrust).abs() < 1e-12
            && column(&run, "joint.r.fy")[0].abs() < 1e-12
    );
}

#[test]
fn missing_masses_are_named_for_the_analysis_that_needs_them() {
    let mut model = slider_crank(0.1, 0.3, 0.5, false, &still(0.5));
    model["bodies"]["rod"]
        .as_object_mut()
        .expect("a map")
        .remove("inertia");
    assert!(
        complaint(&model)
            .contains("bodies.rod: inverse dynamics needs the inertia of body \"rod\"")
    );
    model["analysis"]["type"] = json!("kinematics");
    assert_eq!(outcome(&model).report.status, Status::Completed);
}

const CONTRADICTING: &str = include_str!("../cases/drivers-contradict.json");

/// Three bars in a chain: the second turns by itself, and against the first, which turns by itself, too.
#[test]
fn drivers_that_prescribe_one_motion_are_named_whatever_they_say() {
    let contradicting: Value = serde_json::from_str(CONTRADICTING).expect("JSON");
    // The sum of the two others, and nothing like it.
    let mut agreeing = contradicting.clone();
    for (driver, start, rate) in [("d1", 0.1, 1.0), ("d2", 0.2, -3.0), ("d3", 0.3, -2.0)] {
        agreeing["drivers"][driver]["motion"] =
            json!({ "type": "polynomial", "coefficients": [start, rate] });
    }
    for mut model in [contradicting, agreeing] {
        for kind in [
            "kinematics",
            "inverse_dynamics",
            "dynamics",
            "statics",
            "assembly",
        ] {
            model["analysis"]["type"] = json!(kind);
            let said = complaint(&model);
            assert!(
                said.contains(
                    "drivers.d3: drivers \"d1\", \"d2\", \"d3\" prescribe the same motion"
                ) && said.contains("take one of them out"),
                "{kind}: {said}"
            );
        }
        let small =
            linkdyn_engine::analysis::modes(&loaded(&model).model, false, &Control::default());
        assert!(
            small.expect_err("bad input")[0]
                .to_string()
                .contains("prescribe the same motion")
        );
    }
    // Two of three, beside freedom that nobody drives.
    let mut model: Value = serde_json::from_str(CONTRADICTING).expect("JSON");
    model["analysis"]["type"] = json!("dynamics");
    model["drivers"]
        .as_object_mut()
        .expect("a map")
        .remove("d2");
    assert_eq!(outcome(&model).report.status, Status::Completed);
    model["joints"]["j2"] = json!({ "type": "fixed", "between": ["a.A", "b.O"], "angle": 0.0 });
    assert!(
        complaint(&model).contains("drivers.d3: drivers \"d1\", \"d3\" prescribe the same motion")
    );
    // What the joints hold can't be driven.
    model["joints"]["j1"]["type"] = json!("fixed");
    model["drivers"] = json!({ "d": { "type": "rotation", "body": "b", "motion": still(0.2) } });
    let said = complaint(&model);
    assert!(
        said.contains("drivers.d: the joints leave no room for what driver \"d\" prescribes"),
        "{said}"
    );
}

#[test]
fn a_long_chain_is_as_closed_as_its_coordinates_can_be() {
    const LINKS: usize = 1000;
    let length = 1.0 / LINKS as f64;
    let (mut bodies, mut joints) = (
        json!({ "ground": { "points": { "O": [0, 0] } } }),
        json!({}),
    );
    for k in 0..LINKS {
        let at = [k as f64 * length, 0.0];
        bodies[format!("l{k}")] =
            json!({ "points": { "A": [0, 0], "B": [length, 0] }, "pose": { "position": at } });
        let before = k
            .checked_sub(1)
            .map_or("ground.O".into(), |k| format!("l{k}.B"));
        joints[format!("j{k}")] =
            json!({ "type": "revolute", "between": [before, format!("l{k}.A")] });
    }
    let outcome = outcome(
        &json!({ "format": "linkdyn/1", "units": "SI", "bodies": bodies, "joints": joints,
        "analysis": { "type": "assembly" } }),
    );
    assert_eq!(outcome.report.status, Status::Completed);
    // What is left is round-off of a thousand lengths, which no step takes away.
    assert_eq!(outcome.report.statistics.newton_iterations, 0);
}
