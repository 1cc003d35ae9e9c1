//! Outputs: ratios of velocities against closed forms, finite differences and rates, and where there is none.

use crate::models;
use linkdyn_engine::analysis::derived::derived;
use linkdyn_engine::analysis::{Control, Family, Outcome, Prepared};
use linkdyn_model::{Given, bundled, load};
use serde_json::{Value, json};
use std::f64::consts::TAU;

const R: f64 = 0.05;
const L: f64 = 0.2;

/// A slider-crank with a spring, begun flat, with these outputs.
fn crank(motion: &Value, outputs: &Value) -> Value {
    json!({ "format": "linkdyn/1", "units": "SI",
      "bodies": {
        "ground": { "points": { "O": [0, 0], "W": [0.02, -0.1] } },
        "crank": { "mass": 1, "inertia": 0.001, "com": [0.01, 0], "points": { "O": [0, 0], "A": [R, 0] } },
        "rod": { "mass": 0.4, "inertia": 0.002, "com": [0.1, 0], "points": { "A": [0, 0], "B": [L, 0] }, "pose": { "position": [R, 0] } },
        "piston": { "mass": 2, "inertia": 0, "com": [0.03, 0], "points": { "B": [0, 0] }, "pose": { "position": [R + L, 0] } } },
      "joints": {
        "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
        "big": { "type": "revolute", "between": ["crank.A", "rod.A"] },
        "small": { "type": "revolute", "between": ["rod.B", "piston.B"] },
        "guide": { "type": "prismatic", "between": ["ground.O", "piston.B"], "axis": [1, 0] } },
      "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": motion } },
      "forces": { "shock": { "type": "spring", "between": ["ground.W", "piston.B"], "stiffness": 700, "free_length": 0.15 } },
      "outputs": outputs,
      "analysis": { "type": "kinematics", "end": 1, "outputs": 61 } })
}

fn turning() -> Value {
    json!({ "type": "constant_velocity", "velocity": TAU })
}

/// x and dx/dθ of the piston.
fn piston(angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    let across = (L * L - R * R * sin * sin).sqrt();
    [R * cos + across, -R * sin - R * R * sin * cos / across]
}

fn run(json: &Value) -> Outcome {
    models::solve(&models::load(json))
}

#[track_caller]
fn near(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (row, (found, expected)) in found.iter().zip(expected).enumerate() {
        let error = (found - expected).abs();
        assert!(
            error <= tolerance * expected.abs().max(1.0),
            "row {row}: {found}, not {expected}"
        );
    }
}

#[test]
fn a_slider_crank_is_that_of_its_closed_form() {
    let outputs = json!({
        "travel": "d(piston.x)/d(crank.angle)", "by motor": " d ( 'piston.x' ) / d(driver.motor) ",
        "swing": "d(joint.big.angle)/d(joint.main.angle)", "spring": "d(shock.length)/d(crank.angle)",
        "slide": "d(joint.guide.slide)/d(crank.angle)", "itself": "d(crank.A.y)/d(crank.A.y)" });
    let outcome = run(&crank(&turning(), &outputs));
    let of = |name: &str| models::values(&outcome, name);
    let angles = of("crank.angle");
    let expected =
        |of: &dyn Fn(f64) -> f64| angles.iter().map(|angle| of(*angle)).collect::<Vec<_>>();
    near(
        &of("output.travel"),
        &expected(&|angle| piston(angle)[1]),
        1e-12,
    );
    near(
        &of("output.by motor"),
        &expected(&|angle| piston(angle)[1]),
        1e-12,
    );
    let swing = |angle: f64| -R * angle.cos() / (L * L - (R * angle.sin()).powi(2)).sqrt() - 1.0;
    near(&of("output.swing"), &expected(&swing), 1e-12);
    let spring = |angle: f64| {
        let [x, slope] = piston(angle);
        (x - 0.02) * slope / (x - 0.02).hypot(0.1)
    };
    near(&of("output.spring"), &expected(&spring), 1e-12);
    near(&of("output.slide"), &of("output.travel"), 1e-12);
    let units: Vec<&str> = outcome
        .trajectory
        .columns
        .iter()
        .rev()
        .take(6)
        .map(|column| column.unit)
        .collect();
    assert_eq!(units, ["1", "m/rad", "m/rad", "1", "m/rad", "m/rad"]);
    // y of the crank pin turns back at 90° and 270°, where it does not change
    assert_eq!(
        of("output.itself")
            .iter()
            .filter(|value| value.is_nan())
            .count(),
        2
    );
    assert_eq!(
        outcome.report.warnings,
        ["output.itself is empty in 2 of 61 rows: what it divides by does not change there"]
    );
}

#[test]
fn a_driver_that_stands_still_and_one_at_its_dead_centre_have_a_ratio() {
    // at rest at first and at last
    let slow = json!({ "type": "harmonic", "offset": 0.8, "amplitude": 0.5, "frequency": 0.5, "phase": TAU / 4.0 });
    let outcome = run(&crank(
        &slow,
        &json!({ "travel": "d(piston.x)/d(crank.angle)" }),
    ));
    let of = |name: &str| models::values(&outcome, name);
    let (angles, omega) = (of("crank.angle"), of("crank.omega"));
    assert!(omega[0].abs() < 1e-9 && omega[60].abs() < 1e-9, "{omega:?}");
    let expected: Vec<f64> = angles.iter().map(|angle| piston(*angle)[1]).collect();
    near(&of("output.travel"), &expected, 1e-12);
    // at rest for good, where the crank's angle does not change: a dead centre of the piston
    let mut flat = crank(
        &turning(),
        &json!({ "turn": "d(crank.angle)/d(piston.x)", "back": "d(piston.x)/d(rod.angle)" }),
    );
    flat["drivers"] = json!({});
    flat["analysis"] = json!({ "type": "assembly" });
    let outcome = run(&flat);
    assert!(models::values(&outcome, "output.turn")[0].is_nan());
    assert!(models::values(&outcome, "output.back")[0].abs() < 1e-15);
    assert_eq!(
        outcome.report.warnings.last().map(String::as_str),
        Some("output.turn is empty in all rows: what it divides by does not change there")
    );
}

/// A wheel on two unlike wishbones, held by a spring between the lower one and ground.
fn suspension(analysis: &Value) -> Value {
    json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81],
      "bodies": {
        "ground": { "points": { "P": [0, 0], "Q": [0.05, 0.22], "S": [0.14, 0.45] } },
        "lower": { "mass": 3, "inertia": 0.05, "com": [0.2, 0], "points": { "P": [0, 0], "E": [0.4, 0], "S": [0.25, 0.02] } },
        "upper": { "mass": 2, "inertia": 0.03, "com": [0.15, 0], "points": { "Q": [0, 0], "F": [0.3, 0] }, "pose": { "position": [0.05, 0.22], "angle": 0.1 } },
        "axle": { "mass": 20, "inertia": 0.6, "com": [0.05, 0.1], "points": { "E": [0, 0], "F": [-0.05, 0.25] }, "pose": { "position": [0.4, 0] } } },
      "joints": {
        "p": { "type": "revolute", "between": ["ground.P", "lower.P"] },
        "q": { "type": "revolute", "between": ["ground.Q", "upper.Q"] },
        "e": { "type": "revolute", "between": ["lower.E", "axle.E"] },
        "f": { "type": "revolute", "between": ["upper.F", "axle.F"] } },
      "forces": { "shock": { "type": "spring", "between": ["ground.S", "lower.S"], "stiffness": 30000, "damping": 800, "free_length": 0.5 } },
      "outputs": { "leverage": "d(axle.y)/d(shock.length)" },
      "analysis": analysis })
}

#[test]
fn leverage_is_what_finite_differences_say() {
    let mut json = suspension(
        &json!({ "type": "kinematics", "end": 1, "outputs": 401, "columns": ["*.y", "force.shock.length", "output.*"] }),
    );
    json["drivers"] = json!({ "bump": { "type": "rotation", "body": "lower",
        "motion": { "type": "harmonic", "offset": 0, "amplitude": 0.05, "frequency": 0.25 } } });
    let outcome = run(&json);
    let of = |name: &str| models::values(&outcome, name);
    let (y, length, leverage) = (
        of("axle.y"),
        of("force.shock.length"),
        of("output.leverage"),
    );
    // fourth order; near the end the driver turns back and differences are of nothing
    for row in 2..350 {
        let slope = |of: &[f64]| of[row - 2] - 8.0 * of[row - 1] + 8.0 * of[row + 1] - of[row + 2];
        let difference = slope(&y) / slope(&length);
        assert!(
            (leverage[row] - difference).abs() < 1e-7,
            "row {row}: {} and {difference}",
            leverage[row]
        );
    }
    assert!((leverage[0] - leverage[300]).abs() > 1e-3, "it changes");
}

#[test]
fn it_is_the_ratio_of_transmission() {
    // found there by the factors of all rows, with the driver at unit speed
    for (name, driver, output) in [
        ("four-bar", "motor", "rocker"),
        ("whitworth", "motor", "arm"),
        ("hoeken", "motor", "coupler"),
    ] {
        let text = bundled::find(name).expect("bundled").text;
        let mut json: Value = serde_json::from_str(text).expect("JSON");
        json["analysis"]["transmission"] = json!({ "driver": driver, "output": output });
        json["outputs"] = json!({ "ratio": format!("d({output}.angle)/d(driver.{driver})") });
        let model = models::load(&json);
        let outcome = models::solve(&model);
        let table = derived(&models::checked(&model), outcome.all()).0;
        let known = table.values("transmission.ratio").expect("a column");
        near(&models::values(&outcome, "output.ratio"), &known, 1e-12);
    }
}

#[test]
fn motions_without_drivers_have_the_ratio_of_their_rates() {
    let mut json = suspension(&json!({ "type": "dynamics", "end": 0.3, "outputs": 61,
        "columns": ["axle.vy", "force.shock.rate", "output.leverage"] }));
    json["initial"] = json!({ "lower": { "angular_velocity": 0.5 } });
    let outcome = run(&json);
    let of = |name: &str| models::values(&outcome, name);
    let (vy, rate, leverage) = (of("axle.vy"), of("force.shock.rate"), of("output.leverage"));
    let mut compared = 0;
    for row in 0..61 {
        if rate[row].abs() > 1e-3 {
            assert!(
                (leverage[row] - vy[row] / rate[row]).abs() < 1e-9,
                "row {row}"
            );
            compared += 1;
        }
    }
    assert!(compared > 30, "{compared}");
}

#[test]
fn at_rest_it_is_that_of_virtual_displacements() {
    // the spring bears the axle alone: f dl = m g dy
    let mut json =
        suspension(&json!({ "type": "statics", "columns": ["force.shock.f", "output.*"] }));
    for body in ["lower", "upper"] {
        (
            json["bodies"][body]["mass"],
            json["bodies"][body]["inertia"],
        ) = (json!(0), json!(0));
    }
    json["bodies"]["axle"]["com"] = json!([0, 0]);
    let rest = run(&json);
    let [f, leverage] =
        ["force.shock.f", "output.leverage"].map(|name| models::values(&rest, name)[0]);
    assert!(leverage < -1.0, "{leverage}");
    assert!(
        (f - 20.0 * 9.81 * leverage).abs() < 1e-9 * f.abs(),
        "{f} and {leverage}"
    );
}

#[test]
fn responses_are_of_them_and_follow_parameters() {
    let mut json = crank(
        &turning(),
        &json!({ "travel": "d(piston.x)/d(crank.angle)" }),
    );
    json["parameters"] = json!({ "r": "0.05 m" });
    json["bodies"]["crank"]["points"]["A"] = json!(["=r", 0]);
    json["responses"] =
        json!({ "fastest": "max(output.travel)", "mean": "mean(abs(output.travel))/r" });
    let loaded = load(json.to_string().as_bytes(), &[]).expect("a good model");
    let prepared = Prepared::new(&loaded.model).expect("runs");
    let outcome = prepared.run(&Control::default()).expect("runs");
    let found: Vec<f64> = outcome
        .responses
        .iter()
        .map(|one| one.value.expect("a value"))
        .collect();
    // the largest of a fine net of the closed form
    let fine = (0..100_000).map(|k| piston(TAU * f64::from(k) / 1e5)[1]);
    let largest = fine.fold(f64::NEG_INFINITY, f64::max);
    assert!(
        (found[0] - largest).abs() < 1e-9,
        "{} and {largest}",
        found[0]
    );
    assert_eq!(outcome.responses[0].unit, "m/rad");
    let family = Family::new(&loaded, &["r"], Given::Values).expect("a family");
    let mut member = family.begin();
    let (mut values, mut slopes) = ([0.0; 2], [0.0; 2]);
    let control = Control::default();
    member
        .gradient(&[R], &[R], &control, &mut values, &mut slopes)
        .expect("runs");
    near(&values, &found, 1e-9);
    let mut beside = |r: f64| {
        let mut values = [0.0; 2];
        member.run(&[r], &control, &mut values).expect("runs");
        values
    };
    let (below, above) = (beside(R - 1e-5), beside(R + 1e-5));
    let difference = [0, 1].map(|k| (above[k] - below[k]) / 2e-5);
    near(&slopes, &difference, 1e-7);
}

#[test]
fn a_change_point_leaves_more_than_one_motion() {
    // a parallelogram that begins folded, where it may go on as an antiparallelogram
    let json = json!({ "format": "linkdyn/1", "units": "SI",
      "bodies": {
        "ground": { "points": { "A": [0, 0], "D": [0.3, 0] } },
        "left": { "points": { "A": [0, 0], "B": [0.1, 0] } },
        "coupler": { "points": { "B": [0, 0], "C": [0.3, 0] }, "pose": { "position": [0.1, 0] } },
        "right": { "points": { "D": [0, 0], "C": [0.1, 0] }, "pose": { "position": [0.3, 0] } } },
      "joints": {
        "a": { "type": "revolute", "between": ["ground.A", "left.A"] },
        "b": { "type": "revolute", "between": ["left.B", "coupler.B"] },
        "c": { "type": "revolute", "between": ["coupler.C", "right.C"] },
        "d": { "type": "revolute", "between": ["ground.D", "right.D"] } },
      "outputs": { "follow": "d(right.angle)/d(left.angle)" },
      "analysis": { "type": "assembly" } });
    let outcome = run(&json);
    assert!(models::values(&outcome, "output.follow")[0].is_nan());
    assert_eq!(
        outcome.report.warnings.last().map(String::as_str),
        Some("output.follow is empty in all rows: the joints do not leave one motion alone there")
    );
}

#[test]
fn faults_are_told() {
    let said = |outputs: Value| {
        let json = crank(&turning(), &outputs);
        let said = load(json.to_string().as_bytes(), &[]).expect_err("a bad model");
        let said = said.to_string();
        said.split_once("outputs")
            .map_or(said.clone(), |(_, rest)| format!("outputs{rest}"))
    };
    for (text, expected) in [
        (
            "piston.x",
            r#"outputs.a: "piston.x": this is no ratio of two velocities (as in d(axle.y)/d(force.shock.length))"#,
        ),
        (
            "d(piston.x)/d(crank.angle)*2",
            r#"outputs.a: "d(piston.x)/d(crank.angle)*2": this is no ratio of two velocities (as in d(axle.y)/d(force.shock.length))"#,
        ),
        (
            "d(piston.x)/d(crnk.angle)",
            r#"outputs.a: "d(piston.x)/d(crnk.angle)": nothing that moves is called "crnk.angle" (did you mean "crank.angle"?)"#,
        ),
        (
            "d(force.shok.length)/d(crank.angle)",
            r#"outputs.a: "d(force.shok.length)/d(crank.angle)": nothing that moves is called "force.shok.length" (did you mean "force.shock.length"?)"#,
        ),
        (
            "d(force.shock.f)/d(crank.angle)",
            r#"outputs.a: "d(force.shock.f)/d(crank.angle)": nothing that moves is called "force.shock.f" (as in crank.angle, rod.B.y, joint.guide.slide, force.shock.length or driver.motor)"#,
        ),
        (
            "d(piston.vx)/d(crank.angle)",
            "outputs.a: \"d(piston.vx)/d(crank.angle)\": piston.vx is a rate, and d( ) wants what changes (as in d(slider.x) or d(force.shock.length))",
        ),
        (
            "d(piston.x)/d(t)",
            "outputs.a: \"d(piston.x)/d(t)\": time is nothing that the mechanism moves (what changes by time has a column of its rate, as slider.vx)",
        ),
    ] {
        assert_eq!(said(json!({ "a": text })), expected, "{text}");
    }
    assert_eq!(
        said(json!({ "angle": "d(piston.x)/d(crank.angle)" })),
        r#"outputs.angle: "d(piston.x)/d(crank.angle)": output.angle would be a column of a body called "output" (give the output another name)"#
    );
    // more than one degree of freedom
    let mut json = suspension(&json!({ "type": "statics" }));
    json["joints"].as_object_mut().expect("joints").remove("f");
    let model = models::checked(&models::load(&json));
    let said = Prepared::new(&model).expect_err("two degrees of freedom");
    assert_eq!(
        said.to_string(),
        "outputs.leverage: a ratio of velocities wants a mechanism with one degree of freedom, and this one has 3 without its drivers \
         (hold what shall not move by joints)"
    );
    // journals in their bearings are free to move
    let text = bundled::find("slider-crank-clearance")
        .expect("bundled")
        .text;
    let mut json: Value = serde_json::from_str(text).expect("JSON");
    json["outputs"] = json!({ "travel": "d(slider.x)/d(crank.angle)" });
    let model = models::checked(&models::load(&json));
    let said = Prepared::new(&model).expect_err("three degrees of freedom");
    let hint =
        r#"(journals that move in their bearings count: give the clearances the model "ideal")"#;
    assert!(said.to_string().ends_with(hint), "{said}");
}

#[test]
fn rows_have_the_columns_alone_that_are_asked_for_where_nothing_else_is_read() {
    let run = |name: &str, sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        let text = bundled::find(name).expect("bundled").text;
        let model = load(text.as_bytes(), &sets).expect("sound").model;
        let prepared = || Prepared::new(&model).expect("sound");
        [prepared(), prepared().for_columns()]
            .map(|prepared| prepared.run(&Control::default()).expect("it runs"))
    };
    let columns = r#"analysis.columns=["*.vx", "joint.*.fy", "crnk.x"]"#;
    for name in ["four-bar", "double-pendulum", "watt-i-lock"] {
        let [whole, asked] = run(name, &[columns]);
        assert_eq!(asked.trajectory.columns, whole.trajectory.columns, "{name}");
        let bits = |outcome: &Outcome| {
            let data = outcome.trajectory.data.iter();
            data.map(|value| value.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(bits(&asked), bits(&whole), "{name}");
        assert_eq!(asked.report.warnings, whole.report.warnings, "{name}");
        assert!(
            asked.complete.is_none() && whole.complete.is_some(),
            "{name}"
        );
    }
    // A response reads other columns.
    let response = r#"responses={ "most": "max(rocker.angle)" }"#;
    let [whole, asked] = run("four-bar", &[columns, response]);
    assert_eq!(asked.all().width(), whole.all().width());
}

/// By the theorem of Kennedy and Aronhold: of the rod over the piston on the line of the crank, of crank and piston on the
/// perpendicular to the guide through the crank's pin, at the piston's velocity by that of the crank.
#[test]
fn bodies_turn_about_their_instant_centres() {
    let outputs = json!({
        "rx": "centre(rod, ground).x", "ry": "centre( 'rod' , ground ).y",
        "pin_x": "centre(crank, rod).x", "pin_y": "centre(rod, crank).y",
        "px": "centre(crank, piston).x", "py": "centre(crank, piston).y",
        "none": "centre(piston, ground).y" });
    let motion = json!({ "type": "constant_velocity", "start": 0.3, "velocity": TAU / 5.0 });
    let mut model = crank(&motion, &outputs);
    model["responses"] = json!({ "high": "max(output.ry)" });
    model["analysis"]["end"] = json!(0.9);
    let outcome = run(&model);
    let of = |name: &str| outcome.trajectory.values(name).expect("a column");
    let angles = of("crank.angle");
    let each =
        |place: &dyn Fn(f64) -> f64| -> Vec<f64> { angles.iter().map(|&a| place(a)).collect() };
    near(&of("output.rx"), &each(&|a| piston(a)[0]), 1e-12);
    near(&of("output.ry"), &each(&|a| piston(a)[0] * a.tan()), 1e-11);
    near(&of("output.pin_x"), &each(&|a| R * a.cos()), 1e-12);
    near(&of("output.pin_y"), &each(&|a| R * a.sin()), 1e-12);
    near(&of("output.px"), &vec![0.0; angles.len()], 1e-12);
    near(&of("output.py"), &each(&|a| -piston(a)[1]), 1e-12);
    assert!(of("output.none").iter().all(|cell| cell.is_nan()));
    let warnings = outcome.report.warnings.join("\n");
    assert!(
        warnings.contains(
            "output.none is empty in all rows: its bodies do not turn against each other there"
        ),
        "{warnings}"
    );
}

#[test]
fn centres_of_nothing_are_refused() {
    for (text, said) in [
        (
            "centre(rod, ground)",
            "this is no coordinate of an instant centre",
        ),
        (
            "centre(rod).x",
            "this is no coordinate of an instant centre",
        ),
        (
            "centre(rod, ground).angle",
            "this is no coordinate of an instant centre",
        ),
        ("centre(rot, ground).x", "there is no body \"rot\""),
        ("centre(rod, rod).y", "both are \"rod\""),
    ] {
        let model = crank(&turning(), &json!({ "one": text }));
        let complaints = load(model.to_string().as_bytes(), &[]).expect_err(text);
        let found = complaints.to_string();
        assert!(
            found.contains(said) && found.contains("outputs.one"),
            "{found}"
        );
    }
}

#[test]
fn a_response_of_a_faulty_output_says_what_is_wrong_with_that() {
    let mut model = crank(
        &turning(),
        &json!({ "lever": "d(piston.x)/d(driver.moter)" }),
    );
    model["responses"] = json!({ "most": "max(output.lever)" });
    let complaints = load(model.to_string().as_bytes(), &[]).expect_err("a faulty output");
    let said = "output.lever has no value: nothing that moves is called \"driver.moter\" (did you mean \"driver.motor\"?)";
    assert!(complaints.to_string().contains(said), "{complaints}");
}
