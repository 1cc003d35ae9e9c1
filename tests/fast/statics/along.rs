//! Quasi-statics against closed forms: holding forces over a stroke, friction by the direction of motion, equilibria that follow
//! what is moved slowly.

use super::*;

fn slow(mut model: Value, end: f64, outputs: usize) -> Value {
    model["analysis"] = json!({ "type": "quasi_statics", "end": end, "outputs": outputs });
    model
}

/// A lid on a hinge, held by hand and a gas spring whose damper must not count.
fn lid(mass: Option<f64>) -> Value {
    let mut lid = json!({ "com": [0.4, 0.05], "points": { "H": [0, 0], "S": [0.25, 0.02], "C": [0.4, 0.05] } });
    if let Some(mass) = mass {
        lid["mass"] = mass.into();
    }
    let bodies = json!({ "ground": { "points": { "H": [0, 0], "G": [0.3, -0.1] } }, "lid": lid });
    let drivers = json!({ "hand": { "type": "rotation", "body": "lid",
        "motion": { "type": "constant_velocity", "start": 0, "velocity": 0.2 } } });
    let mut model = model(
        bodies,
        json!({ "hinge": pin("ground.H", "lid.H") }),
        drivers,
    );
    model["gravity"] = json!([0, -G]);
    model["forces"] = json!({ "gas": { "type": "spring", "between": ["ground.G", "lid.S"],
        "stiffness": 800, "free_length": 0.6, "damping": 500 } });
    slow(model, 7.0, 36)
}

#[test]
fn a_lid_is_held_over_its_stroke() {
    for mass in [Some(12.0), None] {
        let mut model = lid(mass);
        if mass.is_none() {
            model["forces"]["weight"] =
                json!({ "type": "force", "at": "lid.C", "vector": [0, -12.0 * G] });
        }
        let run = completed(&model);
        let angles = column(&run, "lid.angle");
        assert_eq!(angles.len(), 36);
        for (theta, effort) in angles.iter().zip(column(&run, "driver.hand.effort")) {
            let (sin, cos) = theta.sin_cos();
            let at = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
            let (s, c) = (at(0.25, 0.02), at(0.4, 0.05));
            let coil = [s[0] - 0.3, s[1] + 0.1];
            let length = coil[0].hypot(coil[1]);
            let push = 800.0 * (0.6 - length) / length;
            let wanted = 12.0 * G * c[0] - push * (s[0] * coil[1] - s[1] * coil[0]);
            close(effort, wanted, 1e-12 * 120.0);
        }
        let names: Vec<&str> = run
            .trajectory
            .columns
            .iter()
            .map(|c| c.name.as_str())
            .collect();
        assert!(
            names
                .iter()
                .all(|name| !name.contains("omega") && !name.ends_with(".v")),
            "{names:?}"
        );
    }
}

/// A wedge that is pushed along the ground under a block that can only rise.
fn wedge(slope: f64, friction: &Value, motion: &Value) -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0, 0] } },
        "wedge": { "points": { "P": [0, 0] } },
        "block": { "mass": 3, "com": [0, 0], "points": { "P": [0, 0] } } });
    let joints = json!({
        "floor": { "type": "prismatic", "between": ["ground.O", "wedge.P"], "axis": [1, 0] },
        "face": { "type": "prismatic", "between": ["wedge.P", "block.P"], "axis": [-slope.cos(), slope.sin()],
                  "friction": friction },
        "guide": { "type": "slot", "between": ["ground.O", "block.P"], "axis": [0, 1] } });
    let mut model = model(
        bodies,
        joints,
        json!({ "push": { "type": "translation", "joint": "floor", "motion": motion } }),
    );
    model["gravity"] = json!([0, -G]);
    model
}

/// F = W tan(α ± φ), whatever the law and the speed: with φ > α the wedge holds itself.
#[test]
fn a_wedge_rubs_against_the_direction_of_motion() {
    let slope = 0.2_f64;
    let coulomb = |mu: f64, speed: f64| json!({ "law": "coulomb", "coefficient": mu, "threshold_velocity": speed });
    let static_only = json!({ "law": "lugre", "coefficient": 0.05, "static_coefficient": 0.3, "stribeck_velocity": 0.01,
        "bristle_stiffness": 1e4 });
    for (law, mu) in [
        (coulomb(0.1, 0.01), 0.1),
        (coulomb(0.3, 100.0), 0.3),
        (static_only, 0.3),
    ] {
        for speed in [1e-6, -2.0] {
            let motion = json!({ "type": "constant_velocity", "start": 0.1, "velocity": speed });
            let run = completed(&slow(wedge(slope, &law, &motion), 0.05, 3));
            let wanted = 3.0 * G * (slope + f64::atan(mu) * f64::signum(speed)).tan();
            let normal =
                3.0 * G / (slope + f64::atan(mu) * f64::signum(speed)).cos() * f64::atan(mu).cos();
            for friction in column(&run, "joint.face.friction") {
                close(friction.abs(), mu * normal, 1e-10 * 30.0);
            }
            for effort in column(&run, "driver.push.effort") {
                close(effort, wanted, 1e-11 * 30.0);
            }
        }
    }
}

/// A motion that begins and ends at rest has a direction there all the same.
#[test]
fn friction_does_not_vanish_at_the_ends_of_a_motion() {
    let law = json!({ "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 0.01 });
    let motion = json!({ "type": "sequence", "start": 0, "segments": [
        { "law": "cycloidal", "rise": 0.1, "duration": 1 }, { "dwell": 0.5 }] });
    let run = completed(&slow(wedge(0.2, &law, &motion), 1.5, 31));
    let wanted = 3.0 * G * (0.2 + f64::atan(0.1)).tan();
    let efforts = column(&run, "driver.push.effort");
    close(efforts[0], wanted, 1e-11 * 30.0);
    close(efforts[20], wanted, 1e-11 * 30.0);
}

/// A weight on a spring whose upper end is moved: it goes along, by a spring on ground less far.
#[test]
fn what_is_free_follows_in_equilibrium() {
    let bodies = json!({
        "ground": { "points": { "O": [0, 0] } },
        "hand": { "points": { "P": [0, 0] } },
        "weight": { "mass": 2, "com": [0, 0], "points": { "P": [0, 0] }, "pose": { "position": [0, -0.3] } } });
    let guide = |body: &str| json!({ "type": "prismatic", "between": ["ground.O", format!("{body}.P")], "axis": [0, 1] });
    let mut model = model(
        bodies,
        json!({ "upper": guide("hand"), "lower": guide("weight") }),
        json!({ "lift": { "type": "translation", "joint": "upper",
            "motion": { "type": "constant_velocity", "start": 0, "velocity": 0.1 } } }),
    );
    model["gravity"] = json!([0, -G]);
    model["forces"] = json!({
        "coil": { "type": "spring", "between": ["hand.P", "weight.P"], "stiffness": 500, "free_length": 0.2 },
        "bed": { "type": "spring", "between": ["ground.O", "weight.P"], "stiffness": 100, "free_length": 0 } });
    // rows that begin later than the motion have the same equilibria
    let mut later = model.clone();
    later["analysis"] = json!({ "type": "quasi_statics",
        "sample": { "driver": "lift", "from": 0.05, "to": 0.1, "step": 0.01 } });
    let later = column(&completed(&later), "weight.y")[0];
    close(later, (500.0 * (0.05 - 0.2) - 2.0 * G) / 600.0, 1e-12);
    let run = completed(&slow(model, 1.0, 11));
    let (times, places) = (column(&run, "time"), column(&run, "weight.y"));
    let efforts = column(&run, "driver.lift.effort");
    for ((time, place), effort) in times.iter().zip(places).zip(efforts) {
        let hand = 0.1 * time;
        // 500 (hand − y − 0.2) = 2 g + 100 y
        let wanted = (500.0 * (hand - 0.2) - 2.0 * G) / 600.0;
        close(place, wanted, 1e-12);
        close(effort, 500.0 * (hand - wanted - 0.2), 1e-9);
    }
}

/// Two bars (von Mises) that are pressed flat by a spring of this stiffness.
fn truss(stiffness: f64) -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0, 0], "A": [1, 0] } },
        "hand": { "points": { "P": [0, 0] }, "pose": { "position": [0, 0.6] } },
        "apex": { "points": { "P": [0, 0] }, "pose": { "position": [0, 0.3] } } });
    let guide = |body: &str| json!({ "type": "prismatic", "between": ["ground.O", format!("{body}.P")], "axis": [0, 1] });
    let mut model = model(
        bodies,
        json!({ "upper": guide("hand"), "lower": guide("apex") }),
        json!({ "press": { "type": "translation", "joint": "upper",
            "motion": { "type": "constant_velocity", "start": 0.6, "velocity": -0.1 } } }),
    );
    model["forces"] = json!({
        "bar": { "type": "spring", "between": ["ground.A", "apex.P"], "stiffness": 1000, "free_length": 1.09_f64.sqrt() },
        "press": { "type": "spring", "between": ["hand.P", "apex.P"], "stiffness": stiffness, "free_length": 0.3 } });
    slow(model, 6.0, 61)
}

#[test]
fn a_snap_is_told() {
    let run = completed(&truss(20.0));
    let places = column(&run, "apex.y");
    let jump = places.windows(2).position(|pair| pair[0] - pair[1] > 0.1);
    let jump = jump.expect("a snap");
    // dF/dy of the bar plus 20 N/m vanishes there: 1000 (1 − L₀/L³) = −20, where L² = 1 + y²
    let length = (1.09_f64.sqrt() / 1.02).cbrt();
    let limit = (length * length - 1.0).sqrt();
    assert!(
        places[jump] > limit && places[jump] - limit < 0.05,
        "{} and {limit}",
        places[jump]
    );
    let warnings = run.report.warnings.join("\n");
    assert!(
        warnings.contains("the mechanism snaps at about t = "),
        "{warnings}"
    );
    // a stiffer spring leads it through
    let led = completed(&truss(2000.0));
    assert!(led.report.warnings.is_empty(), "{:?}", led.report.warnings);
}

/// Accuracy knows equilibria without friction alone: the hand's torque is off as the weight is, and friction is refused.
#[test]
fn accuracy_of_holding_forces_leaves_no_friction_out() {
    let mut model = lid(Some(12.0));
    model["parameters"] = json!({ "mass": { "value": "12 kg", "tolerance": "0.1 kg" } });
    model["bodies"]["lid"]["mass"] = "=mass".into();
    model["accuracy"] =
        json!({ "outputs": { "hold": { "column": "driver.hand.effort", "at": { "value": 0 } } } });
    let asked = |name: &str, model: &Value| {
        let name = format!("linkdyn-{name}-{}.json", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, model.to_string()).expect("a file");
        let mut words = Vec::from(["linkdyn", "accuracy", "--json"].map(std::ffi::OsString::from));
        words.push(path.clone().into());
        let said = linkdyn::cli::captured(words);
        std::fs::remove_file(path).expect("the file");
        said
    };
    let said = asked("held", &model);
    assert_eq!(said.status, 0, "{}", said.stderr);
    let found: Value = serde_json::from_str(&said.stdout).expect("JSON");
    let text = found.to_string();
    // 0.1 kg at 0.4 m
    assert!(
        text.contains(&format!("{:.6}", 0.1 * G * 0.4)[..6]),
        "{text}"
    );
    model["joints"]["hinge"]["pin_radius"] = 0.01.into();
    model["joints"]["hinge"]["friction"] =
        json!({ "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 0.01 });
    let said = asked("rubs", &model);
    assert_eq!(said.status, 2, "{}", said.stdout);
    assert!(
        said.stderr.contains("leaves friction out"),
        "{}",
        said.stderr
    );
}
