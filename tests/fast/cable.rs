//! Cables over points, against closed forms.

use crate::mechanisms::*;
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::Status;
use serde_json::{Value, json};

const GRAVITY: f64 = 9.81;
const MASS: f64 = 2.0;

/// A block of 2 kg on a vertical guide, with one cable.
fn hung(cable: Value, start: f64, analysis: Value) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0], "A": [-0.3, 1.0], "B": [0.3, 1.0], "C": [0.3, 0.2] } },
        "block": { "mass": MASS, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0], "Q": [0.1, 0.0] },
                   "pose": { "position": [0.0, start] } } });
    let joints = json!({ "g": { "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [0.0, 1.0] } });
    let mut model = model(bodies, joints, json!({}));
    model["forces"] = json!({ "hoist": cable });
    model["analysis"] = analysis;
    model
}

#[track_caller]
fn completed(run: &Outcome) {
    let said = &run.report;
    assert_eq!(said.status, Status::Completed, "{:?}", said.message);
}

#[test]
fn a_tackle_shares_the_weight() {
    // two stretches hold the block, the third runs down to the ground and only makes the cable longer
    let cable = json!({ "type": "cable", "through": ["ground.A", "block.P", "ground.B", "ground.C"],
        "stiffness": 5e4, "free_length": "2 m" });
    let mut model = hung(cable, 0.3, json!({ "type": "statics" }));
    model["responses"] =
        json!({ "pull": "last(force.hoist.f)", "long": "last(force.hoist.length)" });
    let run = outcome(&model);
    completed(&run);
    let y = column(&run, "block.y")[0];
    let stretch = (0.09 + (1.0 - y) * (1.0 - y)).sqrt();
    let tension = 5e4 * (2.0 * stretch + 0.8 - 2.0);
    let lifted = 2.0 * tension * (1.0 - y) / stretch;
    assert!((lifted - MASS * GRAVITY).abs() < 1e-7, "{lifted}");
    let f = column(&run, "force.hoist.f")[0];
    assert!((f - tension).abs() < 1e-9 * tension, "{f} {tension}");
    let length = column(&run, "force.hoist.length")[0];
    assert!((length - 2.0 * stretch - 0.8).abs() < 1e-14, "{length}");
}

/// Free fall until the cable is taut, half a wave and a bit, and free flight again, over and over.
#[test]
fn a_block_on_a_slack_cable_bounces() {
    let (k, free) = (800.0, 0.5);
    let cable = json!({ "type": "cable", "through": ["ground.T", "block.P"], "stiffness": k, "free_length": free });
    for method in ["dop853", "radau5"] {
        let solver = json!({ "method": method, "rtol": 1e-11, "atol": 1e-13 });
        let analysis = json!({ "type": "dynamics", "end": 3.0, "outputs": 61, "solver": solver });
        let mut model = hung(cable.clone(), 1.0, analysis);
        model["bodies"]["ground"]["points"]["T"] = json!([0.0, 1.0]);
        let run = outcome(&model);
        completed(&run);
        let (fall, speed) = ((2.0 * free / GRAVITY).sqrt(), (2.0 * GRAVITY * free).sqrt());
        let omega = (k / MASS).sqrt();
        let sag = GRAVITY / (omega * omega);
        // below the place where it is taut: sag (1 − cos ωt) + v/ω sin ωt, until that is zero again
        let taut = 2.0 / omega * (std::f64::consts::PI - (speed / (omega * sag)).atan());
        let period = 2.0 * fall + taut;
        let depth = |t: f64| {
            let phase = t.rem_euclid(period);
            if phase < fall {
                return 0.5 * GRAVITY * phase * phase;
            }
            let into = phase - fall;
            if into < taut {
                let (sin, cos) = (omega * into).sin_cos();
                return free + sag * (1.0 - cos) + speed / omega * sin;
            }
            let back = period - phase;
            0.5 * GRAVITY * back * back
        };
        let rows = column(&run, "time")
            .into_iter()
            .zip(column(&run, "block.y"));
        for ((t, y), f) in rows.zip(column(&run, "force.hoist.f")) {
            let known = depth(t);
            assert!(
                (1.0 - y - known).abs() < 1e-8,
                "{method} {t}: {} {known}",
                1.0 - y
            );
            let tension = (k * (known - free)).max(0.0);
            assert!((f - tension).abs() < 1e-5, "{method} {t}: {f} {tension}");
        }
    }
}

#[test]
fn a_winch_lifts_what_hangs_on_it() {
    // the free length shrinks by 0.2 m/s: the block swings about the motion of a weight that hangs
    let motion = json!({ "type": "constant_velocity", "start": 0.5, "velocity": -0.2 });
    let cable = json!({ "type": "cable", "through": ["ground.T", "block.P"], "stiffness": 2e3, "damping": 30.0, "free_length": motion });
    let analysis = json!({ "type": "dynamics", "end": 1.5, "outputs": 31, "solver": { "rtol": 1e-11, "atol": 1e-13 } });
    let mut model = hung(cable, 0.5, analysis);
    model["bodies"]["ground"]["points"]["T"] = json!([0.0, 1.0]);
    let run = outcome(&model);
    completed(&run);
    // z = how much longer than free, but for what hangs: z″ + c/m z′ + k/m z = 0, of the rate without that of the winch
    let (decay, square): (f64, f64) = (0.5 * 30.0 / MASS, 2e3 / MASS);
    let wave = (square - decay * decay).sqrt();
    let hang = |t: f64| {
        // z = l − l₀(t): m z″ = −k z − c l̇ + m g, with l̇ = ż − 0.2
        let rest = (MASS * GRAVITY + 30.0 * 0.2) / 2e3;
        let (z0, v0) = (-rest, 0.2);
        let (sin, cos) = (wave * t).sin_cos();
        rest + (-decay * t).exp() * (z0 * cos + (v0 + decay * z0) / wave * sin)
    };
    // taut all the time but in the first instants, which the weight ends at once
    let (time, y) = (column(&run, "time"), column(&run, "block.y"));
    for (t, y) in time.iter().zip(y) {
        let known = 0.5 - 0.2 * t + hang(*t);
        assert!((1.0 - y - known).abs() < 1e-8, "{t}: {} {known}", 1.0 - y);
    }
}

/// The cable, and what is said.
const FAULTS: &[(&str, &str)] = &[
    (
        r#"{ "type": "cable", "stiffness": 1, "free_length": 1 }"#,
        r#"forces.hoist: "through" is missing"#,
    ),
    (
        r#"{ "type": "cable", "through": ["ground.A"], "stiffness": 1, "free_length": 1 }"#,
        "forces.hoist.through: a list of at least 2 is expected, this one has 1",
    ),
    (
        r#"{ "type": "cable", "through": ["ground.A", "block.P"], "stiffness": 0, "free_length": 1 }"#,
        "forces.hoist.stiffness: 0: must be greater than 0",
    ),
    (
        r#"{ "type": "cable", "through": ["ground.A", "block.P"], "stiffness": 1 }"#,
        r#"forces.hoist: "free_length" is missing"#,
    ),
    (
        r#"{ "type": "cable", "through": ["ground.A", "ground.A", "block.P"], "stiffness": 1, "free_length": 1 }"#,
        r#"forces.hoist.through[1]: "ground.A": the same point twice, one after the other (leave one of them out)"#,
    ),
    (
        r#"{ "type": "cable", "through": ["ground.A", "block.R"], "stiffness": 1, "free_length": 1 }"#,
        r#"forces.hoist.through[1]: "block.R": body "block" has no point "R" (its points: P, Q)"#,
    ),
    (
        r#"{ "type": "cable", "through": ["ground.A", "block.P"], "stiffness": 1, "free_length": "=block.y" }"#,
        r#"forces.hoist.free_length: "=block.y": there is no parameter "block" (write it into "parameters")"#,
    ),
];

#[test]
fn faults_of_cables_are_told_in_their_place() {
    let mut wrong = String::new();
    let told = |cable: Value| {
        let model = hung(cable, 0.5, json!({ "type": "statics" })).to_string();
        let said = linkdyn_model::load(model.as_bytes(), &[]).expect_err("refused");
        let text = said[0].to_string();
        text.split_once(": ")
            .map_or(String::new(), |(_, said)| said.to_owned())
    };
    for (cable, expected) in FAULTS {
        let said = told(serde_json::from_str(cable).expect("JSON"));
        if said != *expected {
            wrong += &format!("{expected}\n    {said}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    let through: Vec<&str> = (0..9)
        .map(|k| if k % 2 == 0 { "ground.A" } else { "block.P" })
        .collect();
    let said =
        told(json!({ "type": "cable", "through": through, "stiffness": 1, "free_length": 1 }));
    assert_eq!(
        said,
        "forces.hoist.through: a cable goes over at most 8 points, here 9 (a longer one is two, joined at a body)"
    );
}

/// A four-bar of which a muscle from ground goes over the coupler to the rocker.
fn walker() -> Value {
    let bodies = json!({
        "ground": { "points": { "A": [0.0, 0.0], "D": [4.0, 0.0], "M": [-0.5, 0.8] } },
        "crank": { "mass": 1.0, "inertia": 0.2, "com": [0.5, 0.0], "points": { "A": [0.0, 0.0], "B": [1.0, 0.0] },
                   "pose": { "angle": 1.0 } },
        "coupler": { "mass": 1.0, "inertia": 0.2, "com": [1.7, 0.0], "points": { "B": [0.0, 0.0], "C": [3.5, 0.0], "V": [1.5, 0.4] },
                     "pose": { "position": [0.5, 0.9], "angle": 0.6 } },
        "rocker": { "mass": 1.0, "inertia": 0.2, "com": [1.4, 0.0], "points": { "D": [0.0, 0.0], "C": [2.8, 0.0], "N": [1.2, -0.3] },
                    "pose": { "position": [4.0, 0.0], "angle": 1.8 } } });
    let joints = json!({ "a": pin("ground.A", "crank.A"), "b": pin("crank.B", "coupler.B"),
        "c": pin("coupler.C", "rocker.C"), "d": pin("ground.D", "rocker.D") });
    let turn = json!({ "type": "rotation", "body": "crank",
        "motion": { "type": "constant_velocity", "start": 1.0, "velocity": SPEED } });
    let mut model = model(bodies, joints, json!({ "motor": turn }));
    model["forces"] = json!({
        "muscle": { "type": "cable", "through": ["ground.M", "coupler.V", "rocker.N"], "stiffness": 1.0, "free_length": 0.0 },
        "jack": { "type": "actuator", "between": ["ground.M", "coupler.V"], "force": 0.0 },
        "band": { "type": "spring", "between": ["coupler.V", "rocker.N"], "stiffness": 0.0, "free_length": 0.0 } });
    model
}

const SPEED: f64 = 1.7;

/// Of the walker at an angle of its crank: the lengths of both stretches, and what they and the angle of the rocker change by it.
fn stretches(theta: f64) -> ([f64; 2], [f64; 2], f64) {
    let turned = |angle: f64, [x, y]: [f64; 2]| {
        let (sin, cos) = angle.sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    };
    let (crank, coupler, rocker) = (1.0, 3.5, 2.8);
    let pin = turned(theta, [crank, 0.0]);
    // the triangle of coupler, rocker and the line from the pin to D
    let (dx, dy) = (4.0 - pin[0], -pin[1]);
    let line = dx.hypot(dy);
    let lean = (line * line + coupler * coupler - rocker * rocker) / (2.0 * line * coupler);
    let phi = dy.atan2(dx) + lean.acos();
    let tip = turned(phi, [coupler, 0.0]);
    let psi = (pin[1] + tip[1]).atan2(pin[0] + tip[0] - 4.0);
    // what the loop says of rates: r1 i e^(i theta) + r2 phi' i e^(i phi) = r3 psi' i e^(i psi)
    let of_phi = -crank * (theta - psi).sin() / (coupler * (phi - psi).sin());
    let of_psi = crank * (theta - phi).sin() / (rocker * (psi - phi).sin());
    let (v, n) = (turned(phi, [1.5, 0.4]), turned(psi, [1.2, -0.3]));
    let (via, end) = ([pin[0] + v[0], pin[1] + v[1]], [4.0 + n[0], n[1]]);
    let via_rate = [-pin[1] - of_phi * v[1], pin[0] + of_phi * v[0]];
    let end_rate = [-of_psi * n[1], of_psi * n[0]];
    let stretch = |from: [f64; 2], to: [f64; 2], [a, b]: [[f64; 2]; 2]| {
        let (x, y) = (to[0] - from[0], to[1] - from[1]);
        let length = x.hypot(y);
        (length, (x * (b[0] - a[0]) + y * (b[1] - a[1])) / length)
    };
    let (first, by_first) = stretch([-0.5, 0.8], via, [[0.0; 2], via_rate]);
    let (second, by_second) = stretch(via, end, [via_rate, end_rate]);
    ([first, second], [by_first, by_second], of_psi)
}

#[test]
fn the_moment_arm_of_a_muscle_is_the_sum_over_its_path() {
    let mut model = walker();
    model["outputs"] = json!({ "crank": "d(force.muscle.length)/d(crank.angle)", "rocker": "d(muscle.length)/d(rocker.angle)",
        "back": "d(rocker.angle)/d(muscle.length)", "share": "d(jack.length)/d(muscle.length)", "rest": "d(band.length)/d(crank.angle)" });
    model["responses"] = json!({ "reach": "max(muscle.length)", "pull": "last(muscle.rate)" });
    let run = outcome(&model);
    completed(&run);
    let of = |name: &str| column(&run, name);
    for (row, theta) in of("crank.angle").into_iter().enumerate() {
        let (_, [first, second], of_psi) = stretches(theta);
        let arm = first + second;
        for (name, known) in [
            ("crank", arm),
            ("rocker", arm / of_psi),
            ("back", of_psi / arm),
            ("share", first / arm),
            ("rest", second),
        ] {
            let found = of(&format!("output.{name}"))[row];
            let off = (found - known).abs() / known.abs().max(1.0);
            assert!(off < 1e-12, "{name} at {theta}: {found}, not {known}");
        }
    }
    let unit = |name: &str| {
        let mut columns = run.trajectory.columns.iter();
        columns.find(|one| one.name == name).map(|one| one.unit)
    };
    assert_eq!(unit("output.crank"), Some("m/rad"));
    assert_eq!(unit("output.back"), Some("rad/m"));
    assert_eq!(unit("output.share"), Some("1"));
}

#[test]
fn formulas_take_lengths_and_rates_of_cables() {
    let mut model = walker();
    let free = outcome(&model);
    completed(&free);
    model["forces"]["brake"] = json!({ "type": "torque", "body": "crank",
        "value": "=3 N*force.muscle.length + 2 N*s*muscle.rate*abs(muscle.rate)/(1 m/s) - 1 N*jack.length - 1 N*s*force.band.rate" });
    let run = outcome(&model);
    completed(&run);
    // What the brake takes the motor gives.
    let [with, without] = [&run, &free].map(|run| column(run, "driver.motor.effort"));
    for (row, theta) in column(&run, "crank.angle").into_iter().enumerate() {
        let ([first, second], by, _) = stretches(theta);
        let rate = SPEED * (by[0] + by[1]);
        let known = 3.0 * (first + second) + 2.0 * rate * rate.abs() - first - SPEED * by[1];
        let found = without[row] - with[row];
        assert!(
            (found - known).abs() < 1e-11,
            "at {theta}: {found}, not {known}"
        );
    }
}
