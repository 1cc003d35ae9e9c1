//! Integrated states, against closed forms.

use crate::mechanisms::*;
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::Status;
use serde_json::{Value, json};

const INERTIA: f64 = 0.2;

/// A rotor of 0.2 kg·m² on ground with one torque, and states.
fn rotor(torque: &str, states: Value, parameters: Value) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "rotor": { "mass": 1.0, "inertia": INERTIA, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0] } } });
    let mut model = model(
        bodies,
        json!({ "o": pin("ground.O", "rotor.O") }),
        json!({}),
    );
    model["parameters"] = parameters;
    model["states"] = states;
    model["forces"] = json!({ "m": { "type": "torque", "body": "rotor", "value": torque } });
    model["analysis"] = json!({ "type": "dynamics", "end": 2.0, "outputs": 41,
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

/// J ω̇ = p e + i ∫e dt with e = 10 rad/s − ω is e″ + p/J e′ + i/J e = 0 with e′(0) = −p/J e(0).
#[test]
fn a_controller_with_an_integral_has_its_closed_form() {
    let parameters = json!({ "p": "0.6 N*m*s/rad", "i": "4 N*m/rad", "target": "10 rad/s" });
    let states = json!({ "integral": { "rate": "=target - rotor.omega", "start": 0 } });
    let torque = "=p*(target - rotor.omega) + i*state.integral";
    let (decay, square) = (0.5 * 0.6 / INERTIA, 4.0 / INERTIA);
    let wave = f64::sqrt(square - decay * decay);
    let error =
        |t: f64| 10.0 * (-decay * t).exp() * ((wave * t).cos() - decay / wave * (wave * t).sin());
    for method in ["dop853", "radau5", "auto"] {
        let mut model = rotor(torque, states.clone(), parameters.clone());
        model["analysis"]["solver"]["method"] = json!(method);
        model["responses"] =
            json!({ "torque": "last(force.m.torque)", "most": "max(state.integral)" });
        let run = outcome(&model);
        holds(&run, "rotor.omega", 1e-9, |t| 10.0 - error(t));
        holds(&run, "state.integral.rate", 1e-9, error);
        // i ∫e = J ω̇ − p e, where ω̇ = −e′
        let slope = |t: f64| {
            let (sin, cos) = (wave * t).sin_cos();
            let turned = -decay * (cos - decay / wave * sin) - wave * sin - decay * cos;
            10.0 * (-decay * t).exp() * turned
        };
        let integral = |t: f64| (-INERTIA * slope(t) - 0.6 * error(t)) / 4.0;
        holds(&run, "state.integral", 1e-9, integral);
        let torque = -INERTIA * slope(2.0);
        let derived =
            linkdyn_engine::analysis::derived::derived(&loaded(&model).model, &run.trajectory).0;
        let found = derived.values("force.m.torque").expect("a column");
        assert!((found[40] - torque).abs() < 1e-8, "{} {torque}", found[40]);
        let columns = &run.trajectory.columns;
        let unit = |name: &str| {
            columns
                .iter()
                .find(|one| one.name == name)
                .map(|one| one.unit)
        };
        assert_eq!(
            (unit("state.integral"), unit("state.integral.rate")),
            (Some("rad"), Some("rad/s"))
        );
    }
}

#[test]
fn states_may_follow_each_other() {
    // a lag behind a lag: b = 1 − (1 + t/τ) e^(−t/τ)
    let states = json!({
        "b": { "rate": "=(state.a - state.b)/tau", "start": "0 N*m" },
        "a": { "rate": "=(1 N*m - state.a)/tau", "start": "0 N*m" } });
    let run = outcome(&rotor("=state.b", states, json!({ "tau": "0.3 s" })));
    let lag = |t: f64| 1.0 - (1.0 + t / 0.3) * (-t / 0.3).exp();
    holds(&run, "state.b", 1e-11, lag);
    holds(&run, "state.a", 1e-11, |t| 1.0 - (-t / 0.3).exp());
}

#[test]
fn kinks_of_rates_are_events() {
    // ω = 5 t passes 3 rad/s at 0.6 s
    let states = json!({ "over": { "rate": "=max(0 rad/s, rotor.omega - 3 rad/s)" } });
    let run = outcome(&rotor(
        "=1 N*m + 0*state.over*1 N*m/(1 rad)",
        states,
        json!({}),
    ));
    holds(&run, "state.over", 1e-11, |t| {
        let late = (t - 0.6).max(0.0);
        2.5 * late * late
    });
}

#[test]
fn a_controller_in_saturation_winds_up() {
    // at most 1 N·m until p e + i ∫e falls below it: e = 10 − 5 t, ∫e = 10 t − 2.5 t²
    let parameters = json!({ "p": "0.2 N*m*s/rad", "i": "0.4 N*m/rad", "target": "10 rad/s" });
    let states = json!({ "integral": { "rate": "=target - rotor.omega" } });
    let torque = "=clamp(p*(target - rotor.omega) + i*state.integral, -1 N*m, 1 N*m)";
    let run = outcome(&rotor(torque, states, parameters));
    holds(&run, "rotor.omega", 1e-11, |t| 5.0 * t);
    holds(&run, "state.integral", 1e-11, |t| 10.0 * t - 2.5 * t * t);
}

#[test]
fn states_go_on_through_impacts() {
    // between two stops with e = 1 at 1 m/s: a triangle, and its integral
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": 2.0, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] } } });
    let joints = json!({ "g": { "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [1.0, 0.0],
        "limits": [-0.5, 0.5], "restitution": 1.0 } });
    let mut model = model(bodies, joints, json!({}));
    model["gravity"] = json!([0.0, 0.0]);
    model["initial"] = json!({ "block": { "x": 0.0, "vx": 1.0 } });
    model["states"] = json!({ "way": { "rate": "=block.x", "start": "0.1 m*s" } });
    model["analysis"] = json!({ "type": "dynamics", "end": 3.3, "outputs": 34 });
    let run = outcome(&model);
    holds(&run, "state.way", 1e-8, |t| {
        let phase = t.rem_euclid(2.0);
        let own = match phase {
            phase if phase < 0.5 => phase * phase,
            phase if phase < 1.5 => 0.5 - (phase - 1.0) * (phase - 1.0),
            phase => (phase - 2.0) * (phase - 2.0),
        };
        0.1 + 0.5 * own
    });
}

#[test]
fn at_rest_states_are_held() {
    let states = json!({ "load": { "rate": "=1 N*m/(1 s)", "start": "0.5 N*m" } });
    let mut model = rotor("=state.load - 2 N*m/rad*rotor.angle", states, json!({}));
    model["analysis"] = json!({ "type": "statics" });
    let run = outcome(&model);
    let angle = column(&run, "rotor.angle")[0];
    assert!((angle - 0.25).abs() < 1e-9, "{angle}");
}

#[test]
fn models_with_states_are_printed_back() {
    let parameters = json!({ "target": "10 rad/s" });
    let states = json!({ "integral": { "rate": "=target - rotor.omega", "start": 0 } });
    let model = rotor("=1 N*m/rad*state.integral", states, parameters);
    let own = loaded(&model);
    assert_eq!(own.source.print(&own.model), own.document);
    let plain = own.model.to_json();
    assert_eq!(
        plain["states"]["integral"],
        json!({ "rate": "=(10.0 rad/s) - rotor.omega", "start": "0.0 rad" })
    );
    let (one, two) = (outcome(&model), outcome(&plain));
    assert_eq!(one.trajectory.data, two.trajectory.data);
}

/// The states, and what is said.
const FAULTS: &[(&str, &str)] = &[
    (r#"{ "s": {} }"#, r#"states.s: "rate" is missing"#),
    (
        r#"{ "s": { "rate": 1 } }"#,
        "states.s.rate: 1: text is expected, not a number",
    ),
    (
        r#"{ "s": { "rate": "1 rad/s" } }"#,
        r#"states.s.rate: "1 rad/s": the rate of a state is an expression (as in "rate": "=target - rotor.omega")"#,
    ),
    (
        r#"{ "s": { "rate": "=rotor.omega", "start": "1 mm" } }"#,
        r#"states.s.start: "1 mm": this is a length [m], where an angle [rad] is wanted"#,
    ),
    (
        r#"{ "s": { "rate": "=rotor.alpha" } }"#,
        r#"states.s.rate: "=rotor.alpha": rotor.alpha follows from the forces, and can't be in one (places, angles and their rates can, and t)"#,
    ),
    (
        r#"{ "s": { "rate": "=rotor.omega - state.r" } }"#,
        r#"states.s.rate: "=rotor.omega - state.r": there is no parameter, and nothing that moves, called "state.r" (as in crank.angle, slider.vx, rod.B.y, joint.guide.slide, force.shock.length or t)"#,
    ),
    (
        r#"{ "s": { "rate": "=(1 - state.s)/(1 s)" } }"#,
        r#"states.s.rate: "=(1 - state.s)/(1 s)": the dimension of this state is not known (write "start" with its unit, as in "0 rad")"#,
    ),
    (
        r#"{ "s": { "rate": "=rotor.omega + rotor.angle" } }"#,
        r#"states.s.rate: "=rotor.omega + rotor.angle": an angular velocity [rad/s] and an angle [rad] can't be added"#,
    ),
    (
        r#"{ "x": { "rate": "=rotor.omega" } }"#,
        r#"states.x: state.x would be a column of a body called "state" (give the state another name)"#,
    ),
    (
        r#"{ "s": { "rate": "=rotor.omega", "begin": 1 } }"#,
        r#"states.s.begin: "begin": unknown key (known keys: rate, start, note)"#,
    ),
];

#[test]
fn faults_of_states_are_told_in_their_place() {
    let mut wrong = String::new();
    for (states, expected) in FAULTS {
        let states: Value = serde_json::from_str(states).expect("JSON");
        let model = rotor("=1 N*m", states, json!({})).to_string();
        let said = linkdyn_model::load(model.as_bytes(), &[]).expect_err(expected);
        let text = said[0].to_string();
        let text = text.split_once(": ").map_or("", |(_, said)| said);
        if text != *expected {
            wrong += &format!("{expected}\n    {text}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    let mut model = rotor(
        "=1 N*m",
        json!({ "s": { "rate": "=rotor.omega" } }),
        json!({}),
    );
    model["drivers"] = json!({ "d": { "type": "rotation", "body": "rotor",
        "motion": { "type": "constant_velocity", "velocity": 3.0 } } });
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 5 });
    let said = linkdyn_model::load(model.to_string().as_bytes(), &[])
        .expect_err("refused")
        .to_string();
    assert!(
        said.contains("states are integrated in a free motion, and drivers prescribe this one"),
        "{said}"
    );
}
