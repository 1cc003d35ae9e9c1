//! Forces as functions of what moves, against closed forms.

mod units;

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, Family, Outcome, modes};
use linkdyn_model::Given;
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::PI;

const MASS: f64 = 2.0;

/// A block of 2 kg on a guide along x, without weight, with one force along it.
fn block(force: &str, start: [f64; 2], end: f64) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": MASS, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] },
                   "pose": { "position": [start[0], 0.0] } } });
    let joints = json!({ "g": { "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [1.0, 0.0] } });
    let mut model = model(bodies, joints, json!({}));
    model["gravity"] = json!([0.0, 0.0]);
    model["forces"] = json!({ "f": { "type": "force", "at": "block.P", "vector": [force, 0.0] } });
    model["initial"] = json!({ "block": { "x": start[0], "vx": start[1] } });
    model["analysis"] = json!({ "type": "dynamics", "end": end, "outputs": 21,
        "solver": { "rtol": 1e-12, "atol": 1e-14 } });
    model
}

/// A rotor of 0.2 kg·m² on ground with one torque.
fn rotor(torque: &str, parameters: Value) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "rotor": { "mass": 1.0, "inertia": 0.2, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0] } } });
    let mut model = model(
        bodies,
        json!({ "o": pin("ground.O", "rotor.O") }),
        json!({}),
    );
    model["parameters"] = parameters;
    model["forces"] = json!({ "m": { "type": "torque", "body": "rotor", "value": torque } });
    model["analysis"] = json!({ "type": "dynamics", "end": 2.0, "outputs": 21,
        "solver": { "rtol": 1e-12, "atol": 1e-14 } });
    model
}

#[track_caller]
fn holds(run: &Outcome, name: &str, tolerance: f64, known: impl Fn(f64) -> f64) {
    let said = &run.report;
    assert_eq!(said.status, Status::Completed, "{:?}", said.message);
    for (t, value) in column(run, "time").iter().zip(column(run, name)) {
        let known = known(*t);
        let off = (value - known).abs();
        assert!(off <= tolerance, "{name} at {t}: {value} {known}, {off:e}");
    }
}

#[test]
fn a_motor_droops() {
    let parameters = json!({ "stall": "3 N*m", "idle": "40 rad/s" });
    let run = outcome(&rotor("=stall*(1 - rotor.omega/idle)", parameters));
    let rate = 3.0 / (0.2 * 40.0);
    holds(&run, "rotor.omega", 4e-11, |t| {
        40.0 * (1.0 - (-rate * t).exp())
    });
}

#[test]
fn drag_grows_with_the_square_of_the_speed() {
    let run = outcome(&block("=-0.5 kg/m*block.vx*abs(block.vx)", [0.0, 3.0], 2.0));
    let k = 0.5 / MASS;
    holds(&run, "block.vx", 1e-11, |t| 3.0 / (1.0 + 3.0 * k * t));
}

#[test]
fn a_force_that_changes_its_sign_does_so_at_once() {
    // constant towards the middle: parabolas, of which four quarters make a period
    let quarter = (2.0 * 0.4 * MASS / 3.0_f64).sqrt();
    let place = |t: f64| {
        let phase = (t / quarter).rem_euclid(4.0);
        let (sign, into) = match phase {
            phase if phase < 1.0 => (1.0, phase),
            phase if phase < 3.0 => (-1.0, phase - 2.0),
            phase => (1.0, phase - 4.0),
        };
        sign * 0.4 * (1.0 - into * into)
    };
    for force in [
        "=-3 N*sign(block.x)",
        "=3 N*(1 - 2*step(block.x))",
        "=min(3 N, max(-3 N, -1e9 N/m*block.x))",
    ] {
        let run = outcome(&block(force, [0.4, 0.0], 9.7 * quarter));
        // the last one turns within some nanometres
        let tolerance = if force.contains("min") { 1e-7 } else { 2e-11 };
        holds(&run, "block.x", tolerance, place);
        assert!(
            run.report.statistics.steps < 400,
            "{}",
            run.report.statistics.steps
        );
    }
}

#[test]
fn a_bumper_pushes_only_while_it_is_touched() {
    // 0.5 m of free way, half a wave in the bumper, and back
    let k: f64 = 800.0;
    let omega = (k / MASS).sqrt();
    let run = outcome(&block(
        "=-800 N/m*max(0 m, block.P.x - 0.5 m)",
        [0.0, 1.0],
        1.5,
    ));
    holds(&run, "block.x", 1e-11, |t| {
        let into = t - 0.5;
        let out = into - PI / omega;
        match (into < 0.0, out < 0.0) {
            (true, _) => t,
            (_, true) => 0.5 + (omega * into).sin() / omega,
            _ => 0.5 - out,
        }
    });
}

#[test]
fn a_gas_spring_keeps_its_energy() {
    // 300 N at 0.2 m, polytropic with 1.3, between the origin and the block
    let mut model = block("0 N", [0.2, 0.0], 0.3);
    model["forces"] = json!({ "gas": { "type": "actuator", "between": ["ground.O", "block.P"],
        "force": "=300 N*(0.2 m/force.gas.length)^1.3 - 150 N" } });
    let run = outcome(&model);
    let potential = |l: f64| 300.0 * 0.2_f64.powf(1.3) * l.powf(-0.3) / 0.3 + 150.0 * l;
    let (x, v) = (column(&run, "block.x"), column(&run, "block.vx"));
    let whole = potential(0.2);
    assert!(x.iter().any(|x| *x > 0.3), "it moves");
    for (x, v) in x.iter().zip(v) {
        let energy = 0.5 * MASS * v * v + potential(*x);
        assert!((energy - whole).abs() < 1e-11 * whole, "{energy} {whole}");
    }
}

/// T = 2 ∫ dl/v between the turning points, v² = 2(U₀ − U)/m, with l = middle + half sin φ: then the trapezoid rule over a turn
/// of φ converges as fast as the digits do.
#[test]
fn a_gas_spring_swings_in_its_period() {
    let potential = |l: f64| 300.0 * 0.2_f64.powf(1.3) * l.powf(-0.3) / 0.3 + 150.0 * l;
    let (mut near, mut far) = (0.3, 2.0);
    for _ in 0..100 {
        let middle = 0.5 * (near + far);
        match potential(middle) < potential(0.2) {
            true => near = middle,
            false => far = middle,
        }
    }
    let (middle, half) = (0.5 * (0.2 + near), 0.5 * (near - 0.2));
    let count = 64;
    let terms = (0..count).map(|k| {
        let (sin, cos) = (PI * ((f64::from(k) + 0.5) / f64::from(count) - 0.5)).sin_cos();
        let speed = (2.0 * (potential(0.2) - potential(middle + half * sin)) / MASS).sqrt();
        half * cos / speed
    });
    let period = 2.0 * PI / f64::from(count) * terms.sum::<f64>();
    let mut model = block("0 N", [0.2, 0.0], period);
    model["analysis"]["outputs"] = json!(2);
    model["forces"] = json!({ "gas": { "type": "actuator", "between": ["ground.O", "block.P"],
        "force": "=300 N*(0.2 m/force.gas.length)^1.3 - 150 N" } });
    let run = outcome(&model);
    // it is at rest there, and 75 m/s² say by how much it is late
    let late = column(&run, "block.vx")[1] / 75.0;
    assert!(late.abs() < 1e-9 * period, "{late:e} of {period}");
    assert!((column(&run, "block.x")[1] - 0.2).abs() < 1e-9);
}

#[test]
fn a_controller_is_a_spring_and_a_damper() {
    let parameters = json!({ "p": "5 N*m/rad", "d": "0.4 N*m*s/rad", "to": "0.7 rad" });
    let mut model = rotor(
        "=clamp(p*(to - joint.o.angle) - d*joint.o.omega, -50 N*m, 50 N*m)",
        parameters,
    );
    let (decay, squared) = (0.4 / 0.4, 5.0 / 0.2);
    let omega = f64::sqrt(squared - decay * decay);
    let run = outcome(&model);
    holds(&run, "rotor.angle", 1e-11, |t| {
        let wave = (omega * t).cos() + decay / omega * (omega * t).sin();
        0.7 - 0.7 * (-decay * t).exp() * wave
    });
    // small motions about where it holds
    model["analysis"] = json!({ "type": "statics" });
    model["bodies"]["rotor"]["pose"] = json!({ "angle": 0.6 });
    let small = modes(&loaded(&model).model, false, &Control::default()).expect("small motions");
    let [real, imaginary] = small.modes[0].eigenvalue;
    assert!(
        (real + decay).abs() < 1e-9 && (imaginary.abs() - omega).abs() < 1e-9,
        "{real} {imaginary}"
    );
}

#[test]
fn driven_mechanisms_answer_with_their_efforts() {
    let mut model = rotor(
        "=-2 N*m/rad*rotor.angle - 0.1 N*m*s/rad*driver.motor*1 rad/(1 rad*1 s)",
        json!({}),
    );
    model["drivers"] = json!({ "motor": { "type": "rotation", "body": "rotor",
        "motion": { "type": "constant_velocity", "velocity": 3.0 } } });
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 5 });
    model["responses"] = json!({ "least": "min(force.m.torque)" });
    let run = outcome(&model);
    holds(&run, "driver.motor.effort", 1e-14, |t| 2.1 * 3.0 * t);
    let derived =
        linkdyn_engine::analysis::derived::derived(&loaded(&model).model, &run.trajectory).0;
    let torque = derived.values("force.m.torque").expect("a column");
    assert!((torque[4] + 2.1 * 3.0).abs() < 1e-14, "{torque:?}");
}

#[test]
fn a_table_over_the_angle_does_its_work_in_each_turn() {
    // a saw-tooth of one turn: from 0 to 4 N·m in a quarter, back to 0 in the rest
    let torque =
        "=table(mod(rotor.angle, 2*pi*1 rad); 0 rad, 0 N*m; pi/2*1 rad, 4 N*m; 2*pi*1 rad, 0 N*m)";
    let mut model = rotor(torque, json!({}));
    model["initial"] = json!({ "rotor": { "angle": -0.3, "angular_velocity": 5.0 } });
    model["analysis"]["end"] = json!(3.0);
    let run = outcome(&model);
    let work = |angle: f64| {
        let (turns, rest) = ((angle / (2.0 * PI)).floor(), angle.rem_euclid(2.0 * PI));
        let rising = rest.min(0.5 * PI);
        let falling = (rest - 0.5 * PI).max(0.0);
        turns * 4.0 * PI + rising * rising * 4.0 / PI + falling * (4.0 - falling * 4.0 / (3.0 * PI))
    };
    let (angle, omega) = (column(&run, "rotor.angle"), column(&run, "rotor.omega"));
    assert!(angle[20] > 4.0 * PI, "{} turns", angle[20] / (2.0 * PI));
    for (angle, omega) in angle.iter().zip(omega) {
        let known = 0.5 * 0.2 * 25.0 + work(*angle) - work(-0.3);
        let energy = 0.5 * 0.2 * omega * omega;
        assert!(
            (energy - known).abs() < 1e-11 * known,
            "{angle}: {energy} {known}"
        );
    }
}

#[test]
fn variants_and_gradients_take_the_parameters_of_formulas() {
    // effort k θ + c ω², at 3 rad and 3 rad/s
    let parameters = json!({ "k": "2 N*m/rad", "c": "0.1 N*m*s^2/rad^2" });
    let mut model = rotor(
        "=-k*rotor.angle - c*rotor.omega*abs(rotor.omega)",
        parameters,
    );
    model["drivers"] = json!({ "motor": { "type": "rotation", "body": "rotor",
        "motion": { "type": "constant_velocity", "velocity": 3.0 } } });
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 5 });
    model["responses"] =
        json!({ "effort": "last(driver.motor.effort)", "torque": "last(force.m.torque)" });
    let family = Family::new(&loaded(&model), &["k", "c"], Given::Values).expect("it runs");
    let mut member = family.begin();
    for [k, c] in [[2.0, 0.1], [2.5, 0.07]] {
        let (mut values, mut slopes) = ([f64::NAN; 2], [f64::NAN; 4]);
        let (given, control) = ([k, c], Control::default());
        let ended = member.gradient(&given, &given, &control, &mut values, &mut slopes);
        ended.expect("it runs");
        let known = 3.0 * k + 9.0 * c;
        for (found, known) in values
            .into_iter()
            .chain(slopes)
            .zip([known, -known, 3.0, 9.0, -3.0, -9.0])
        {
            assert!(
                (found - known).abs() < 1e-11 * known.abs(),
                "{found} {known}"
            );
        }
    }
}

#[test]
fn what_has_no_end_or_no_value_is_told() {
    let told = |force: &str| {
        let run = outcome(&block(force, [0.3, 0.5], 3.0));
        assert_ne!(run.report.status, Status::Completed, "{force}");
        assert!(run.trajectory.data.iter().all(|value| value.is_finite()));
        run.report.message.expect("a message")
    };
    let said = told("=1 N - 4 N*sign(block.vx)");
    assert!(
        said.contains("force \"f\" holds the motion where it jumps"),
        "{said}"
    );
    let said = told("=-3 N*(sqrt(block.x/(1 m)) + 1)");
    assert!(said.contains("force \"f\" has no value"), "{said}");
    // where the motion is given, the rest of it is known
    let mut model = rotor("=1 N*m*sqrt(0.5 - t/(1 s))", json!({}));
    model["drivers"] = json!({ "motor": { "type": "rotation", "body": "rotor",
        "motion": { "type": "constant_velocity", "velocity": 3.0 } } });
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 11 });
    let run = outcome(&model);
    let efforts = column(&run, "driver.motor.effort");
    assert_eq!(
        efforts.iter().filter(|effort| effort.is_finite()).count(),
        6
    );
    let said = run.report.warnings.join("; ");
    assert!(
        said.contains("from t = 0.6 s on, the formula of force \"m\" has no value at times"),
        "{said}"
    );
}

#[test]
fn faults_are_told_in_their_place() {
    let told = |force: &str| {
        let model = block(force, [0.0, 0.0], 1.0).to_string();
        let said = linkdyn_model::load(model.as_bytes(), &[]).expect_err(force);
        let text = said[0].to_string();
        let begin = format!("\"{force}\": ");
        text.split_once(&begin)
            .map_or(text.clone(), |(_, said)| said.to_owned())
    };
    let faults = [
        (
            "=-c*block.vx",
            r#"there is no parameter, and nothing that moves, called "c" (as in crank.angle, slider.vx, rod.B.y, joint.guide.slide, force.shock.length or t)"#,
        ),
        (
            "=2*block.vx",
            "this is a velocity [m/s], where a force [N] is wanted (its factors carry units, as in -0.5 N*s/m * slider.vx)",
        ),
        (
            "=1 kg*block.ax",
            "block.ax follows from the forces, and can't be in one (places, angles and their rates can, and t)",
        ),
        (
            "=1 N*joint.g.fx/(1 N)",
            "joint.g.fx follows from the forces, and can't be in one (places, angles and their rates can, and t)",
        ),
        (
            "=1 kg/s*max(block.vx)",
            "this is known when a run has ended, and not while forces act (max and min of two values or more are the greater and the smaller one)",
        ),
        (
            "=1 N*blok.vx/(1 m/s)",
            r#"there is no parameter, and nothing that moves, called "blok.vx" (did you mean "block.vx"?)"#,
        ),
        (
            "=1 N*joint.g.angle/(1 rad)",
            r#"there is no parameter, and nothing that moves, called "joint.g.angle" (did you mean "joint.g.slide"?)"#,
        ),
        (
            "=1 N*clamp(block.x/(1 m), 2)",
            "clamp takes 3 values, here it has 2",
        ),
        (
            "=1 N + block.x",
            "a force [N] and a length [m] can't be added",
        ),
        (
            "=1 N*sqrt(block.x)",
            "this is a quantity in kg*m^1.5/s^2, where a force [N] is wanted (its factors carry units, as in -0.5 N*s/m * slider.vx)",
        ),
    ];
    let mut wrong = String::new();
    for (force, expected) in faults {
        let said = told(force);
        if said != expected {
            wrong += &format!("{force}\n    {said}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn models_with_formulas_are_printed_back() {
    let mut model = rotor(
        "=stall*(1 - rotor.omega/idle)",
        json!({ "stall": "3 N*m", "idle": "40 rad/s" }),
    );
    let loaded = loaded(&model);
    assert_eq!(loaded.source.print(&loaded.model), loaded.document);
    let plain = loaded.model.to_json();
    let text = plain["forces"]["m"]["value"].as_str().expect("a text");
    assert_eq!(text, "=(3.0 N*m)*(1 - rotor.omega/(40.0 rad/s))");
    // and what is printed is the same model
    let again = linkdyn_model::load(plain.to_string().as_bytes(), &[]).expect("legal");
    model["parameters"] = json!({});
    model["forces"]["m"]["value"] = json!(text);
    let (one, two) = (outcome(&model), outcome(&again.model.to_json()));
    assert_eq!(one.trajectory.data, two.trajectory.data);
}
