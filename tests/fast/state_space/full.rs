//! Next to the full engine: differences of runs, and motions over a short time.

use super::*;
use crate::models;

/// Columns at the beginning of a run.
fn beginning(model: &Value, columns: &[&str]) -> Vec<f64> {
    let run = completed(model);
    columns.iter().map(|name| column(&run, name)[0]).collect()
}

/// Derivative by a number, of order four.
fn slopes(at: impl Fn(f64) -> Vec<f64>, h: f64) -> Vec<f64> {
    let (near, far) = ([at(h), at(-h)], [at(2.0 * h), at(-2.0 * h)]);
    let one = |k: usize| (8.0 * (near[0][k] - near[1][k]) - (far[0][k] - far[1][k])) / (12.0 * h);
    (0..near[0].len()).map(one).collect()
}

#[track_caller]
fn agree(what: &str, found: impl Iterator<Item = f64>, known: &[f64], tolerance: f64) {
    let found: Vec<f64> = found.collect();
    let largest = known.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    for (own, known) in found.iter().zip(known) {
        let off = (own - known).abs() / largest;
        assert!(
            off <= tolerance,
            "{what}: {own} {known} off by {off:e}: {found:?}"
        );
    }
}

fn motion(coefficients: Value) -> Value {
    json!({ "type": "polynomial", "coefficients": coefficients })
}

/// The four-bar and the slider-crank, whose drivers are let go on their way, are next to runs that start there with a torque.
#[test]
fn a_driver_that_is_let_go_is_a_torque() {
    let four_bar: Value = serde_json::from_str(
        linkdyn_model::bundled::find("four-bar")
            .expect("bundled")
            .text,
    )
    .expect("JSON");
    let mut crank = slider_crank(0.1, 0.3, 0.6, false, &motion(json!([0.6, 4.0, 3.0])));
    crank["forces"] = json!({
        "s": { "type": "spring", "between": ["ground.O", "slider.B"], "stiffness": 900.0, "damping": 15.0, "free_length": 0.3 } });
    let columns = ["joint.b.fx", "joint.a.fy", "crank.alpha", "energy.kinetic"];
    for (model, time) in [(four_bar, 0.3), (crank, 0.25)] {
        let found = moving(&model, &["driver.motor"], &columns, time);
        let (x, tau) = (&found.states, found.inputs[0].value);
        assert_eq!(names(x), ["driver.motor", "driver.motor.rate"]);
        let run = |angle: f64, rate: f64, torque: f64| {
            let mut free = model.clone();
            free["drivers"] = json!({});
            free["forces"]["tau"] = json!({ "type": "torque", "body": "crank", "value": format!("{:e} N*m", tau + torque) });
            // Near where it is, so that it closes on the same branch.
            let held = completed(&model);
            let row = column(&held, "time")
                .iter()
                .position(|t| *t >= time - 1e-9)
                .expect("there");
            let bodies: Vec<String> = free["bodies"]
                .as_object()
                .expect("bodies")
                .keys()
                .cloned()
                .collect();
            for body in bodies.iter().filter(|body| *body != "ground") {
                let [x, y, turned] =
                    ["x", "y", "angle"].map(|q| column(&held, &format!("{body}.{q}"))[row]);
                free["bodies"][body]["pose"] = json!({ "position": [format!("{x:e} m"), format!("{y:e} m")], "angle": format!("{turned:e} rad") });
            }
            free["initial"] = json!({ "crank": { "angle": format!("{:e} rad", x[0].value + angle),
                                                 "angular_velocity": format!("{:e} rad/s", x[1].value + rate) } });
            free["analysis"] = json!({ "type": "dynamics", "end": "1 ms", "outputs": 2 });
            beginning(&free, &columns)
        };
        let value = run(0.0, 0.0, 0.0);
        agree("y", found.outputs.iter().map(|y| y.value), &value, 1e-10);
        let by = [
            slopes(|h| run(h, 0.0, 0.0), 2e-3),
            slopes(|h| run(0.0, h, 0.0), 0.1),
            slopes(|h| run(0.0, 0.0, h), 1.0),
        ];
        for (k, known) in by.iter().enumerate() {
            let own = found.c.iter().zip(&found.d);
            let own = own.map(|(c, d)| if k < 2 { c[k] } else { d[0] });
            agree(&format!("column {k}"), own, known, 3e-8);
        }
        // The third column is the acceleration of the state itself.
        agree("A", found.a[1].iter().copied(), &[by[0][2], by[1][2]], 3e-8);
        agree("B", found.b[1].iter().copied(), &[by[2][2]], 1e-9);
        assert!(
            found.errors.iter().all(|error| *error < 1e-8),
            "{:?}",
            found.errors
        );
        let drift = found.rates[1];
        near(drift, value[2], 1e-9 * drift.abs().max(1.0));
    }
}

/// A motion with an integrated state and a force that follows it, at an instant of `dynamics`.
#[test]
fn states_of_a_motion_are_states() {
    let mut model = slider_crank(0.1, 0.3, 0.6, false, &json!({}));
    model["drivers"] = json!({});
    model["states"] = json!({ "e": { "rate": "=slider.x - 0.3 m", "start": "0.01 m*s" } });
    model["forces"] = json!({
        "s": { "type": "spring", "between": ["ground.O", "slider.B"], "stiffness": 900.0, "damping": 15.0, "free_length": 0.3 },
        "u": { "type": "torque", "body": "crank", "value": "=-40 N/(m*s)*state.e*0.1 m - 0.02 N*m*s*crank.omega/(1 rad)" } });
    model["analysis"] = json!({ "type": "dynamics", "end": 0.4, "outputs": 5, "columns": ["*", "force.u.torque"],
        "solver": { "rtol": 1e-12, "atol": 1e-14 } });
    let columns = ["slider.ax", "joint.b.fy", "state.e", "force.u.torque"];
    let found = moving(&model, &["slider.B.fx", "force.u"], &columns, 0.2);
    assert_eq!(names(&found.states)[2], "state.e");
    assert_eq!(found.a[2][1..], [0.0, 0.0]);
    let held = completed(&model);
    let coordinate = found.states[0].name.split('.').collect::<Vec<_>>();
    let (body, axis) = (coordinate[0].to_owned(), coordinate[1]);
    assert_eq!(axis, "angle", "{:?}", names(&found.states));
    let run = |moved: [f64; 3], push: [f64; 2]| {
        let mut model = model.clone();
        for body in ["crank", "rod", "slider"] {
            let [x, y, turned] =
                ["x", "y", "angle"].map(|q| column(&held, &format!("{body}.{q}"))[2]);
            model["bodies"][body]["pose"] = json!({ "position": [x, y], "angle": turned });
        }
        model["initial"] = json!({ body.clone(): { "angle": found.states[0].value + moved[0],
                                                  "angular_velocity": found.states[1].value + moved[1] } });
        model["states"]["e"]["start"] =
            json!(format!("{:e} m*s", found.states[2].value + moved[2]));
        model["forces"]["fx"] =
            json!({ "type": "force", "at": "slider.B", "vector": [push[0], 0.0] });
        model["forces"]["more"] = json!({ "type": "torque", "body": "crank", "value": push[1] });
        beginning(&model, &columns)
    };
    agree(
        "y",
        found.outputs.iter().map(|y| y.value),
        &run([0.0; 3], [0.0; 2]),
        1e-9,
    );
    for k in 0..5 {
        let at = |h: f64| {
            let (mut moved, mut push) = ([0.0; 3], [0.0; 2]);
            match k {
                0..3 => moved[k] = h,
                _ => push[k - 3] = h,
            }
            run(moved, push)
        };
        let known = slopes(at, [2e-3, 0.1, 0.1, 1.0, 0.1][k]);
        let own = found.c.iter().zip(&found.d);
        let own = own.map(|(c, d)| if k < 3 { c[k] } else { d[k - 3] });
        agree(&format!("column {k}"), own, &known, 3e-8);
    }
}

/// x(t) of ẋ = A x + B w by its series.
fn followed(system: &LinearSystem, w: f64, time: f64) -> Vec<f64> {
    let n = system.a.len();
    let steps = 200;
    let h = time / f64::from(steps);
    let rate = |x: &[f64]| -> Vec<f64> {
        (0..n)
            .map(|i| {
                let own: f64 = system.a[i].iter().zip(x).map(|(a, x)| a * x).sum();
                own + system.b[i][0] * w
            })
            .collect()
    };
    let mut x = vec![0.0; n];
    for _ in 0..steps {
        let (mut term, mut factor) = (rate(&x), h);
        for k in 2..12 {
            x.iter_mut().zip(&term).for_each(|(x, d)| *x += factor * d);
            term = (0..n)
                .map(|i| system.a[i].iter().zip(&term).map(|(a, d)| a * d).sum())
                .collect();
            factor *= h / f64::from(k);
        }
    }
    x
}

/// What the linear system leaves out after a small step of an input is of second order in it.
#[test]
fn the_linear_system_is_off_by_second_order() {
    let mut model = slider_crank(0.1, 0.3, 0.9, false, &json!({}));
    model["drivers"] = json!({});
    model["forces"] = json!({
        "s": { "type": "spring", "between": ["ground.O", "slider.B"], "stiffness": 900.0, "damping": 15.0, "free_length": 0.36 },
        "u": { "type": "torque", "body": "crank", "value": 0.0 } });
    model["analysis"] = json!({ "type": "dynamics", "end": 0.1, "outputs": 2,
        "solver": { "rtol": 1e-13, "atol": 1e-15, "method": "dop853" } });
    let found = linear(&model, &["force.u"], &[]);
    let (body, _) = found.states[0].name.split_once('.').expect("a coordinate");
    let off = |torque: f64| {
        let mut model = model.clone();
        model["initial"] =
            json!({ body: { "angle": found.states[0].value, "angular_velocity": 0.0 } });
        model["forces"]["u"]["value"] = json!(torque);
        let run = completed(&model);
        let moved = column(&run, &format!("{body}.angle"))[1] - found.states[0].value;
        let linear = followed(&found, torque, 0.1)[0];
        println!("{torque}: moved {moved:e}, off by {:e}", moved - linear);
        (moved - linear).abs()
    };
    let steps = [0.05, 0.025, 0.0125, 0.00625].map(off);
    for pair in steps.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        println!("order {order}");
        assert!((order - 2.0).abs() <= 0.05, "{order} {steps:?}");
    }
}

/// y at the point is the row of the run there, whatever the columns: redundant joints, cams, gears, contacts.
#[test]
fn outputs_of_a_point_are_those_of_the_run() {
    let mut compared = 0;
    for bundled in linkdyn_model::bundled::MODELS.iter() {
        let model = models::load_bundled(bundled.name, &[]);
        let is_short = |outputs: Option<usize>| outputs.is_some_and(|outputs| outputs <= 1000);
        if !model
            .analysis
            .as_ref()
            .is_some_and(|own| is_short(own.outputs))
        {
            continue;
        }
        let run = models::solve(&model);
        let row = run.trajectory.len() / 3;
        let time = models::values(&run, "time")[row];
        let driver = model
            .drivers
            .keys()
            .next()
            .map(|name| format!("driver.{name}"));
        let inputs: Vec<&str> = driver.iter().map(String::as_str).collect();
        let question = StateSpaceQuestion {
            at: vec![time],
            ..question(&inputs, &["*"])
        };
        let found = state_space(&models::checked(&model), &question, &Control::default());
        let found = match found {
            Ok(mut found) => found.remove(0),
            // Bodies without masses, bristles, bearings with massless links.
            Err(NoLinearSystem::Model(_)) => continue,
            Err(why) => panic!("{}: {why:?}", bundled.name),
        };
        // Measured by the largest value of its unit in the run, or a thousandth in SI: what is round-off of zero counts as such.
        let largest = |unit: &str| {
            let columns = run.trajectory.columns.iter();
            let names = columns.filter(|column| column.unit == unit);
            let all = names.filter_map(|column| run.trajectory.values(&column.name));
            all.flatten()
                .fold(1e-3, |most: f64, own| most.max(own.abs()))
        };
        for output in &found.outputs {
            let Some(all) = run.trajectory.values(&output.name) else {
                continue;
            };
            let off = (output.value - all[row]).abs() / largest(&output.unit);
            let name = (bundled.name, &output.name);
            assert!(
                off <= 1e-9,
                "{name:?}: {} {} {off:e}",
                output.value,
                all[row]
            );
            compared += 1;
        }
    }
    assert!(compared > 1000, "{compared}");
}
