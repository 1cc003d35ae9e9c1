//! Mechanisms with several freedoms: points led along paths, and what each driver moves.

use crate::mechanisms::*;
use serde_json::{Value, json};
use std::f64::consts::TAU;

const BASE: f64 = 0.4;
const CRANK: f64 = 0.25;
const ROD: f64 = 0.3;

/// A five-bar whose cranks stand at the given angles, and whose rods meet in P.
fn five_bar(drivers: Value) -> Value {
    let bodies = json!({
        "ground": { "points": { "L": [0, 0], "R": [BASE, 0] } },
        "left": { "mass": 0.5, "inertia": 0.003, "com": [0.1, 0], "points": { "O": [0, 0], "A": [CRANK, 0] },
                  "pose": { "angle": 1.9 } },
        "right": { "mass": 0.5, "inertia": 0.003, "com": [0.1, 0], "points": { "O": [0, 0], "A": [CRANK, 0] },
                   "pose": { "position": [BASE, 0], "angle": 1.3 } },
        "near": { "mass": 0.3, "inertia": 0.002, "com": [0.15, 0], "points": { "A": [0, 0], "P": [ROD, 0] },
                  "pose": { "position": [-0.08, 0.24], "angle": 0.4 } },
        "far": { "mass": 0.3, "inertia": 0.002, "com": [0.15, 0], "points": { "A": [0, 0], "P": [ROD, 0] },
                 "pose": { "position": [0.47, 0.24], "angle": 2.7 } } });
    let joints = json!({
        "l": pin("ground.L", "left.O"), "r": pin("ground.R", "right.O"),
        "a": pin("left.A", "near.A"), "b": pin("right.A", "far.A"), "p": pin("near.P", "far.P") });
    let mut model = model(bodies, joints, drivers);
    model["points"] = json!(["near.P"]);
    model
}

/// Angle of a crank about (x, 0) whose rod ends at P; the elbow on the side of `sign`.
fn crank_angle(x: f64, p: [f64; 2], sign: f64) -> f64 {
    let d = [p[0] - x, p[1]];
    let length = d[0].hypot(d[1]);
    let cos = (CRANK * CRANK + length * length - ROD * ROD) / (2.0 * CRANK * length);
    d[1].atan2(d[0]) + sign * cos.acos()
}

#[test]
fn a_five_bar_draws_a_circle() {
    let law = |offset: f64, phase: f64| json!({ "type": "harmonic", "offset": offset, "amplitude": 0.06, "frequency": 0.5, "phase": phase });
    let lead = |axis: &str, offset: f64, phase: f64| json!({ "type": "point", "point": "near.P", "axis": axis, "motion": law(offset, phase) });
    let mut model = five_bar(json!({ "x": lead("x", 0.2, TAU / 4.0), "y": lead("y", 0.4, 0.0) }));
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 2.0, "outputs": 73 });
    model["responses"] = json!({ "fx0": "first(shaking.fx)", "fy0": "first(shaking.fy)", "fx1": "last(shaking.fx)", "fy1": "last(shaking.fy)" });
    let run = completed(&model);
    let of = |name: &str| column(&run, name);
    let (x, y) = (of("near.P.x"), of("near.P.y"));
    let (left, right) = (of("left.angle"), of("right.angle"));
    for (row, time) in of("time").iter().enumerate() {
        let (sin, cos) = (TAU * 0.5 * time).sin_cos();
        let p = [0.2 + 0.06 * cos, 0.4 + 0.06 * sin];
        close(x[row], p[0], 1e-14);
        close(y[row], p[1], 1e-14);
        close(left[row], crank_angle(0.0, p, 1.0), 1e-12);
        close(right[row], crank_angle(BASE, p, -1.0), 1e-12);
    }
    // the force that leads the point does the work that the mechanism takes
    assert!(run.report.quality.power_imbalance.expect("forces") < 1e-12);
    // what acts on the ground is what the masses take, the hand at the point included
    let bodies = [
        ("left", 0.5, 0.1),
        ("right", 0.5, 0.1),
        ("near", 0.3, 0.15),
        ("far", 0.3, 0.15),
    ];
    for (row, answers) in [(0, 0..2), (x.len() - 1, 2..4)] {
        let mut sum = [0.0; 2];
        for (body, mass, arm) in bodies {
            let at = |word: &str| of(&format!("{body}.{word}"))[row];
            let (sin, cos) = at("angle").sin_cos();
            let (alpha, omega) = (at("alpha"), at("omega"));
            sum[0] += mass * (at("ax") - arm * (alpha * sin + omega * omega * cos));
            sum[1] += mass * (at("ay") + arm * (alpha * cos - omega * omega * sin) + 9.81);
        }
        for (answer, sum) in run.responses[answers].iter().zip(sum) {
            close(answer.value.expect("a value"), -sum, 1e-11);
        }
    }
}

/// J = (∂P/∂θ) of a five-bar: (P − A)·(Ṗ − θ̇ k×a) = 0 for both rods.
#[test]
fn each_driver_moves_the_point_by_its_column_of_the_jacobian() {
    let turn = |start: f64, velocity: f64, body: &str| {
        json!({ "type": "rotation", "body": body,
        "motion": { "type": "constant_velocity", "start": start, "velocity": velocity } })
    };
    let mut model = five_bar(json!({ "l": turn(1.7, 0.2, "left"), "r": turn(1.5, -0.1, "right") }));
    model["outputs"] = json!({
        "xl": "d(near.P.x)/d(driver.l)", "xr": "d(near.P.x)/d(driver.r)",
        "yl": "d(near.P.y)/d(driver.l)", "yr": "d(near.P.y)/d(driver.r)" });
    model["responses"] =
        json!({ "dexterity": "min(abs(output.xl*output.yr - output.xr*output.yl))" });
    model["analysis"] = json!({ "type": "kinematics", "end": 1.0, "outputs": 21 });
    let run = completed(&model);
    let of = |name: &str| column(&run, name);
    let (x, y, left, right) = (
        of("near.P.x"),
        of("near.P.y"),
        of("left.angle"),
        of("right.angle"),
    );
    let entries = ["xl", "xr", "yl", "yr"].map(|name| of(&format!("output.{name}")));
    let mut least = f64::INFINITY;
    for row in 0..x.len() {
        let rod = |foot: f64, angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let e = [x[row] - foot - CRANK * cos, y[row] - CRANK * sin];
            // e·k×a
            (e, CRANK * (-sin * e[0] + cos * e[1]))
        };
        let ((e, l), (f, r)) = (rod(0.0, left[row]), rod(BASE, right[row]));
        let det = e[0] * f[1] - e[1] * f[0];
        let jacobian = [
            f[1] * l / det,
            -e[1] * r / det,
            -f[0] * l / det,
            e[0] * r / det,
        ];
        for (found, wanted) in entries.iter().zip(jacobian) {
            close(found[row], wanted, 1e-12);
        }
        least = least.min((jacobian[0] * jacobian[3] - jacobian[1] * jacobian[2]).abs());
    }
    let found = run.responses[0].value.expect("a value");
    assert!(
        found <= least + 1e-12 && found > 0.99 * least,
        "{found} and {least}"
    );
}

/// The inverse of the Jacobian, by drivers that lead the point, and its determinant as a response.
#[test]
fn responses_know_ratios_by_drivers_of_a_point() {
    let lead = |axis: &str, start: f64, velocity: f64| {
        json!({ "type": "point", "point": "near.P", "axis": axis,
            "motion": { "type": "constant_velocity", "start": start, "velocity": velocity } })
    };
    let mut model = five_bar(json!({ "x": lead("x", 0.2, 0.05), "y": lead("y", 0.4, 0.02) }));
    model["outputs"] = json!({
        "lx": "d(left.angle)/d(driver.x)", "ly": "d(left.angle)/d(driver.y)",
        "rx": "d(right.angle)/d(driver.x)", "ry": "d(right.angle)/d(driver.y)" });
    model["responses"] = json!({ "inverse": "last(output.lx*output.ry - output.ly*output.rx)" });
    model["analysis"] = json!({ "type": "kinematics", "end": 1.0, "outputs": 5 });
    let run = completed(&model);
    let of = |name: &str| *column(&run, name).last().expect("rows");
    let (x, y) = (of("near.P.x"), of("near.P.y"));
    let rod = |foot: f64, angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let e = [x - foot - CRANK * cos, y - CRANK * sin];
        (e, CRANK * (-sin * e[0] + cos * e[1]))
    };
    let ((e, l), (f, r)) = (rod(0.0, of("left.angle")), rod(BASE, of("right.angle")));
    // θ̇ l = e·ṗ for each crank
    let expected = (e[0] * f[1] - e[1] * f[0]) / (l * r);
    close(run.responses[0].value.expect("a value"), expected, 1e-11);
}

#[test]
fn what_moves_by_no_driver_alone_is_refused() {
    let mut model = five_bar(json!({
        "x": { "type": "point", "point": "near.P", "axis": "x", "motion": { "type": "constant_velocity", "start": 0.2, "velocity": 0.1 } } }));
    model["outputs"] = json!({ "lean": "d(near.P.y)/d(driver.x)" });
    model["analysis"] = json!({ "type": "dynamics", "end": 0.1, "outputs": 3 });
    let refused = |model: &Value| {
        let loaded = linkdyn_model::load(model.to_string().as_bytes(), &[]);
        let found = match loaded {
            Err(complaints) => complaints,
            Ok(loaded) => linkdyn_engine::analysis::run(&loaded.model, &Default::default())
                .map(|_| ())
                .expect_err("a refusal"),
        };
        format!("{found:?}").replace("\\\"", "\"")
    };
    let said = refused(&model);
    assert!(
        said.contains("this one has 2 without its drivers"),
        "{said}"
    );
    model["outputs"] = json!({});
    for (driver, wanted) in [
        (
            json!({ "type": "point", "point": "ground.L", "axis": "x" }),
            "ground is fixed, its points can't be moved",
        ),
        (
            json!({ "type": "point", "point": "near.P", "axis": "z" }),
            "drivers.y.axis",
        ),
        (
            json!({ "type": "point", "point": "near.P", "axis": "x" }),
            "x of near.P is driven by \"x\" already",
        ),
        (
            json!({ "type": "point", "point": "near.Q", "axis": "y" }),
            "near",
        ),
    ] {
        let mut faulty = model.clone();
        let mut driver = driver;
        driver["motion"] = json!({ "type": "constant_velocity", "velocity": 0.1 });
        faulty["drivers"]["y"] = driver;
        let said = refused(&faulty);
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
}

/// Both cranks of a parallelogram, or one.
fn cranks(second: Option<Value>) -> Value {
    let law = json!({ "type": "constant_velocity", "start": 1.0, "velocity": 2.0 });
    let mut model = parallelogram(1, false, 1.0, &law);
    if let Some(motion) = second {
        model["drivers"]["second"] = json!({ "type": "rotation", "body": "c1", "motion": motion });
    }
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 0.3, "outputs": 11 });
    model
}

#[test]
fn two_motors_of_one_freedom_share_the_work() {
    let alone = completed(&cranks(None));
    let law = json!({ "type": "constant_velocity", "start": 1.0, "velocity": 2.0 });
    let both = completed(&cranks(Some(law)));
    let needed = column(&alone, "driver.motor.effort");
    for name in ["driver.motor.effort", "driver.second.effort"] {
        for (effort, needed) in column(&both, name).iter().zip(&needed) {
            close(*effort, 0.5 * needed, 1e-11);
        }
    }
    let warnings = both.report.warnings.join("\n");
    assert!(
        warnings.contains("motor and second drive 1 degree of freedom together"),
        "{warnings}"
    );
    assert!(
        alone
            .report
            .warnings
            .iter()
            .all(|said| !said.contains("together"))
    );
    // laws that agree at first alone lead to where they do not
    let parting = json!({ "type": "constant_acceleration", "start": 1.0, "velocity": 2.0, "acceleration": 0.5 });
    let run = outcome(&cranks(Some(parting)));
    assert_ne!(run.report.status, linkdyn_output::Status::Completed);
    let message = run.report.message.expect("a message");
    assert!(message.contains("drivers"), "{message}");
}

/// A platform of weight W on four driven lengths: efforts e with A e = w, of least norm Aᵀ(A Aᵀ)⁻¹ w.
#[test]
fn drivers_of_one_shaft_divide_the_work_by_their_shares() {
    let law = json!({ "type": "constant_velocity", "start": 1.0, "velocity": 2.0 });
    let mut model = cranks(Some(law));
    model["drivers"]["second"]["share"] = json!(3);
    let run = completed(&model);
    let [one, three] =
        ["motor", "second"].map(|name| column(&run, &format!("driver.{name}.effort")));
    let alone = column(&completed(&cranks(None)), "driver.motor.effort");
    for row in 0..alone.len() {
        close(one[row], 0.25 * alone[row], 1e-12);
        close(three[row], 0.75 * alone[row], 1e-12);
    }
    let warnings = run.report.warnings.join("\n");
    assert!(warnings.contains("each divided by its share"), "{warnings}");
}

#[test]
fn four_legs_carry_a_platform_by_least_norm() {
    let feet: [[f64; 2]; 4] = [[-0.5, 0.0], [0.1, -0.1], [0.7, 0.0], [0.9, 0.6]];
    let heads: [[f64; 2]; 4] = [[0.0, 1.0], [0.2, 1.05], [0.6, 1.0], [0.6, 1.1]];
    let (mass, com) = (40.0, [0.3, 1.1]);
    let names = ["a", "b", "c", "d"];
    let mut ground = json!({});
    let mut platform = json!({});
    let mut drivers = json!({});
    for (k, name) in names.iter().enumerate() {
        ground[name] = json!(feet[k]);
        platform[name] = json!(heads[k]);
        let length = (heads[k][0] - feet[k][0]).hypot(heads[k][1] - feet[k][1]);
        drivers[name] = json!({ "type": "length", "between": [format!("ground.{name}"), format!("platform.{name}")],
            "motion": { "type": "constant_velocity", "start": length, "velocity": 0.0 } });
    }
    let bodies = json!({ "ground": { "points": ground },
        "platform": { "mass": mass, "inertia": 2.0, "com": com, "points": platform } });
    let mut model = model(bodies, json!({}), drivers);
    model["gravity"] = json!([0, -9.81]);
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 2 });
    let run = completed(&model);
    let mut at_rest = model.clone();
    at_rest["analysis"] = json!({ "type": "statics" });
    let warnings = completed(&at_rest).report.warnings.join("\n");
    assert!(
        warnings.contains("drive 3 degrees of freedom together"),
        "{warnings}"
    );
    // columns of A: direction and moment of each leg
    let a: Vec<[f64; 3]> = (0..4)
        .map(|k| {
            let d = [heads[k][0] - feet[k][0], heads[k][1] - feet[k][1]];
            let length = d[0].hypot(d[1]);
            let u = [d[0] / length, d[1] / length];
            [u[0], u[1], heads[k][0] * u[1] - heads[k][1] * u[0]]
        })
        .collect();
    let w = [0.0, mass * 9.81, com[0] * mass * 9.81];
    let mut normal = [[0.0; 4]; 3];
    for (i, row) in normal.iter_mut().enumerate() {
        for (j, cell) in row.iter_mut().take(3).enumerate() {
            *cell = a.iter().map(|leg| leg[i] * leg[j]).sum();
        }
        row[3] = w[i];
    }
    for i in 0..3 {
        let pivot = normal[i];
        for (_, row) in normal.iter_mut().enumerate().filter(|(row, _)| *row != i) {
            let part = row[i] / pivot[i];
            row.iter_mut().zip(pivot).for_each(|(x, p)| *x -= part * p);
        }
    }
    let y = [0, 1, 2].map(|i| normal[i][3] / normal[i][i]);
    for (leg, name) in a.iter().zip(names) {
        let wanted = leg[0] * y[0] + leg[1] * y[1] + leg[2] * y[2];
        close(
            column(&run, &format!("driver.{name}.effort"))[0],
            wanted,
            1e-9,
        );
    }
}
