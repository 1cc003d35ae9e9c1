//! Ready parts against closed forms: gas springs, cylinders, motors.

use crate::mechanisms::*;
use serde_json::{Value, json};

/// A slider on the x axis that a driver moves from 0.22 m to 0.44 m, 0.11 m/s, with a force to the ground's origin.
fn slide(force: Value) -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0, 0] } },
        "slider": { "points": { "C": [0, 0] }, "pose": { "position": [0.22, 0] } } });
    let joints = json!({ "guide": { "type": "prismatic", "between": ["ground.O", "slider.C"], "axis": [1, 0] } });
    let drivers = json!({ "hand": { "type": "translation", "joint": "guide",
        "motion": { "type": "constant_velocity", "start": 0.22, "velocity": 0.11 } } });
    let mut model = model(bodies, joints, drivers);
    model["forces"] = json!({ "part": force });
    model["analysis"] = json!({ "type": "quasi_statics", "end": 2.0, "outputs": 41 });
    model
}

/// A wheel of 0.02 kg·m² on the ground that a motor turns.
fn wheel(motor: &Value) -> Value {
    let mut motor = motor.clone();
    motor["type"] = json!("dc_motor");
    motor["body"] = json!("wheel");
    json!({ "format": "linkdyn/1", "units": "SI",
        "bodies": { "ground": { "points": { "O": [0, 0] } },
            "wheel": { "mass": 1, "inertia": 0.02, "com": [0, 0], "points": { "O": [0, 0] } } },
        "joints": { "pin": pin("ground.O", "wheel.O") },
        "forces": { "motor": motor },
        "analysis": { "type": "dynamics", "end": 1.0, "outputs": 21, "columns": ["*", "force.*.current", "force.*.torque"],
            "solver": { "rtol": 1e-12, "atol": 1e-14 } } })
}

#[test]
fn a_gas_spring_follows_the_gas_law() {
    let (f, extended, stroke, x) = (400.0, 0.45, 0.25, 1.4_f64);
    for exponent in [1.0, 1.4] {
        let run = completed(&slide(
            json!({ "type": "gas_spring", "between": ["ground.O", "slider.C"], "force": f,
            "extended": extended, "stroke": stroke, "progression": x, "exponent": exponent }),
        ));
        let [length, force, effort] = ["force.part.length", "force.part.f", "driver.hand.effort"]
            .map(|name| column(&run, name));
        for row in 0..length.len() {
            let s = extended - length[row];
            // V₁ = 1, and V₂ from x
            let area = (1.0 - x.powf(-1.0 / exponent)) / stroke;
            close(
                force[row],
                f * (1.0 / (1.0 - area * s)).powf(exponent),
                1e-11 * f,
            );
            close(effort[row], -force[row], 1e-10 * f);
        }
    }
}

#[test]
fn a_gas_spring_ends_at_its_stroke_and_damps() {
    let mut model = slide(
        json!({ "type": "gas_spring", "between": ["ground.O", "slider.C"], "force": 400,
        "extended": 0.45, "stroke": 0.25, "progression": 1.4, "damping": 60 }),
    );
    model["bodies"]["slider"]["mass"] = json!(5);
    model["bodies"]["slider"]["inertia"] = json!(1);
    model["bodies"]["slider"]["com"] = json!([0, 0]);
    model["analysis"]["type"] = json!("inverse_dynamics");
    let run = completed(&model);
    let [length, force] = ["force.part.length", "force.part.f"].map(|name| column(&run, name));
    for (length, force) in length.iter().zip(&force) {
        let s = 0.45 - length;
        close(
            *force,
            400.0 / (1.0 - (1.0 - 1.0 / 1.4) * s / 0.25) - 60.0 * 0.11,
            1e-10,
        );
    }
    // thrown from the middle it comes to rest at its upper end
    model["drivers"] = json!({});
    model["initial"] = json!({ "slider": { "x": 0.3 } });
    model["analysis"] = json!({ "type": "dynamics", "end": 3.0, "outputs": 31 });
    let run = completed(&model);
    close(*column(&run, "slider.x").last().expect("rows"), 0.45, 1e-9);
    close(
        *column(&run, "force.part.stop").last().expect("rows"),
        -400.0,
        1e-6,
    );
}

#[test]
fn a_cylinder_has_two_faces() {
    let run = completed(&slide(
        json!({ "type": "cylinder", "between": ["ground.O", "slider.C"], "bore": 0.05, "rod": 0.028,
        "pressure": { "type": "constant_velocity", "start": "20 bar", "velocity": 1e6 }, "rod_pressure": "=60 bar - 1 bar/m*slider.x" }),
    ));
    let [time, x, force] = ["time", "slider.x", "force.part.f"].map(|name| column(&run, name));
    let quarter = std::f64::consts::FRAC_PI_4;
    for row in 0..time.len() {
        let [full, ring] = [quarter * 0.0025, quarter * (0.0025 - 0.028 * 0.028)];
        let expected = (2e6 + 1e6 * time[row]) * full - (6e6 - 1e5 * x[row]) * ring;
        close(force[row], expected, 1e-9);
    }
}

#[test]
fn the_gas_of_an_engine_turns_its_crank_and_pushes_its_head() {
    let (r, l, bore) = (0.04, 0.14, 0.08);
    let bodies = json!({
        "ground": { "points": { "O": [0, 0], "head": [0.25, 0] } },
        "crank": { "mass": 1, "inertia": 1e-3, "com": [0, 0], "points": { "O": [0, 0], "A": [r, 0] } },
        "rod": { "mass": 0, "inertia": 0, "com": [0, 0], "points": { "A": [0, 0], "B": [l, 0] }, "pose": { "position": [r, 0] } },
        "piston": { "mass": 0, "inertia": 0, "com": [0, 0], "points": { "B": [0, 0] }, "pose": { "position": [r + l, 0] } } });
    let joints = json!({ "main": pin("ground.O", "crank.O"), "big": pin("crank.A", "rod.A"), "small": pin("rod.B", "piston.B"),
        "bore": { "type": "prismatic", "between": ["ground.O", "piston.B"], "axis": [1, 0] } });
    let drivers = json!({ "shaft": { "type": "rotation", "body": "crank",
        "motion": { "type": "constant_velocity", "start": 0.3, "velocity": 10.0 } } });
    let mut model = model(bodies, joints, drivers);
    model["forces"] = json!({ "gas": { "type": "cylinder", "between": ["ground.head", "piston.B"], "bore": bore,
        "pressure": "=30 bar*(1 + cos(crank.angle))" } });
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 0.6, "outputs": 61, "columns": ["*", "shaking.*"] });
    let run = completed(&model);
    let [angle, effort] = ["crank.angle", "driver.shaft.effort"].map(|name| column(&run, name));
    for (theta, effort) in angle.iter().zip(&effort) {
        let (sin, cos) = theta.sin_cos();
        let by_angle = -r * sin - r * r * sin * cos / (l * l - r * r * sin * sin).sqrt();
        let pressure = 30e5 * (1.0 + cos);
        // it pushes the piston to −x
        let torque = -pressure * std::f64::consts::FRAC_PI_4 * bore * bore * by_angle;
        close(*effort, -torque, 1e-9);
    }
}

#[test]
fn a_motor_without_inductance_runs_up_exponentially() {
    let (u, k, resistance, gear) = (24.0, 0.05, 0.8, 20.0);
    let run = completed(&wheel(
        &json!({ "voltage": u, "torque_constant": k, "resistance": resistance, "gear": gear }),
    ));
    let [time, omega, current, torque] = [
        "time",
        "wheel.omega",
        "force.motor.current",
        "force.motor.torque",
    ]
    .map(|name| column(&run, name));
    let kg = k * gear;
    let tau = 0.02 * resistance / (kg * kg);
    for row in 0..time.len() {
        let expected = u / kg * -(-time[row] / tau).exp_m1();
        close(omega[row], expected, 1e-9);
        close(current[row], (u - kg * omega[row]) / resistance, 1e-12);
        close(torque[row], kg * current[row], 1e-12);
    }
    close(current[0], u / resistance, 1e-12);
}

#[test]
fn the_current_of_a_motor_with_inductance_swings() {
    let (k, resistance, inductance, inertia) = (0.6, "1200 mohm", "40 mH", 0.02);
    let run = completed(&wheel(
        &json!({ "voltage": "12 V", "torque_constant": "0.6 N*m/A", "resistance": resistance,
        "inductance": inductance }),
    ));
    let [time, omega, current, integrated] = [
        "time",
        "wheel.omega",
        "force.motor.current",
        "state.motor.current",
    ]
    .map(|name| column(&run, name));
    // J ω' = k i, L i' = u − R i − k ω
    let damping = 1.2 / (2.0 * 0.04);
    let pace = (k * k / (0.04_f64 * inertia) - damping * damping).sqrt();
    let top = 12.0 / k;
    for row in 0..time.len() {
        let t = time[row];
        let (sin, cos) = (pace * t).sin_cos();
        let fade = (-damping * t).exp();
        close(
            omega[row],
            top * (1.0 - fade * (cos + damping / pace * sin)),
            1e-9,
        );
        let rate = top * fade * sin * (pace + damping * damping / pace);
        close(current[row], inertia * rate / k, 1e-9);
        close(integrated[row], current[row], 1e-14);
    }
}

#[test]
fn a_motor_may_stand_on_a_body_and_its_voltage_follow_the_motion() {
    let mut model = wheel(
        &json!({ "voltage": "=12 V*step(wheel.angle - 3 rad)", "torque_constant": 0.1, "resistance": 0.5 }),
    );
    model["bodies"]["cart"] =
        json!({ "mass": 3, "inertia": 0.5, "com": [0, 0], "points": { "O": [0, 0] } });
    model["joints"]["axle"] = pin("ground.O", "cart.O");
    model["joints"]["pin"] = pin("cart.O", "wheel.O");
    model["forces"]["motor"]["relative_to"] = json!("cart");
    model["initial"] = json!({ "wheel": { "angular_velocity": 8.0 } });
    let run = completed(&model);
    let [wheel, cart, current, angle] = [
        "wheel.omega",
        "cart.omega",
        "force.motor.current",
        "wheel.angle",
    ]
    .map(|name| column(&run, name));
    for row in 0..wheel.len() {
        // momentum stays
        close(0.02 * wheel[row] + 0.5 * cart[row], 0.02 * 8.0, 1e-10);
        let u = if angle[row] > 3.0 { 12.0 } else { 0.0 };
        close(
            current[row],
            (u - 0.1 * (wheel[row] - cart[row])) / 0.5,
            1e-9,
        );
    }
    assert!(current[0] < 0.0 && *current.last().expect("rows") > 0.0);
}
