//! What of a good model arrives, and in which units.

use super::*;

/// The base model with parameters and expressions.
fn sized(sets: &[&str]) -> linkdyn_model::Loaded {
    let text = BASE
        .replace(
            "\"name\": \"four-bar and slider\"",
            "\"parameters\": { \"note\": \"sizes\", \"l\": \"=2.5*r\", \"r\": \"100 mm\", \"rho\": \"8 kg/m\", \"n\": 4,
               \"turn\": \"=2*pi * 1 rad\", \"spare\": 1 }",
        )
        .replace("0.8", "\"=rho*r\"")
        .replace("7e-4", "\"=rho*r^3/12\"")
        .replace("\"A\": [100, 0]", "\"A\": [\"=r\", \"=3*4\"]")
        .replace("\"angle\": 60 } }", "\"angle\": \"=asin(1)/3*2\" } }")
        .replace("250", "\"=l\"")
        .replace("\"axis\": [1, 0]", "\"axis\": [\"=cos(turn)\", \"=sin(0)\"]")
        .replace("\"10 rad/s\"", "\"=0.2 m/s / r * 1 rad\"")
        .replace("401", "\"=100*n+1\"");
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    linkdyn_model::load(text.as_bytes(), &sets).unwrap_or_else(|said| panic!("{}", said[0]))
}

#[test]
fn expressions_arrive_in_si() {
    let loaded = sized(&[]);
    let crank = &loaded.model.bodies["crank"];
    assert_eq!(
        (crank.mass, crank.inertia),
        (Some(0.8), Some(8.0 * 0.1_f64.powi(3) / 12.0))
    );
    assert_eq!(
        crank.points["A"],
        [0.1, 0.012],
        "a plain result is in the file's unit"
    );
    assert_eq!(crank.pose.angle, std::f64::consts::FRAC_PI_2 / 3.0 * 2.0);
    assert_eq!(loaded.model.bodies["coupler"].points["B"], [0.25, 0.0]);
    let linkdyn_model::JointKind::Prismatic { axis, .. } = &loaded.model.joints["e"].kind else {
        panic!()
    };
    assert_eq!(axis, &[1.0, 0.0]);
    let linkdyn_model::Motion::Polynomial { coefficients } = &loaded.model.drivers["motor"].motion
    else {
        panic!()
    };
    assert_eq!(coefficients[1], 2.0);
    assert_eq!(
        loaded
            .model
            .analysis
            .as_ref()
            .and_then(|analysis| analysis.outputs),
        Some(401)
    );
    assert_eq!(
        loaded.warnings,
        ["line 4, column 50: parameters.spare: 1: no expression uses this parameter"]
    );
    let resolved: Vec<_> = loaded
        .parameters
        .iter()
        .map(|p| (p.name.as_str(), p.value, p.unit.as_str()))
        .collect();
    let tau = std::f64::consts::TAU;
    assert_eq!(
        resolved,
        [
            ("l", 0.25, "m"),
            ("r", 0.1, "m"),
            ("rho", 8.0, "kg/m"),
            ("n", 4.0, ""),
            ("turn", tau, "rad"),
            ("spare", 1.0, "")
        ]
    );
}

/// One value changes all that follows from it; the document keeps the words.
#[test]
fn a_parameter_changes_what_follows_from_it() {
    let changed = sized(&[
        "parameters.r=200 mm",
        "parameters.l==r+10 mm",
        "initial.crank.angle==30 deg",
    ]);
    assert_eq!(
        changed.model.bodies["coupler"].points["B"],
        [0.21000000000000002, 0.0]
    );
    assert_eq!(
        changed.model.initial["crank"].angle,
        Some(30f64.to_radians())
    );
    assert_eq!(changed.document["parameters"]["r"], "200 mm");
    assert_eq!(changed.document["bodies"]["crank"]["mass"], "=rho*r");
}

#[test]
fn warnings_are_no_faults() {
    let edited = |from: &str, to: &str| {
        assert!(BASE.contains(from));
        linkdyn_model::load(BASE.replace(from, to).as_bytes(), &[])
            .unwrap()
            .warnings
    };
    assert_eq!(edited("0.8", "0.9"), Vec::<String>::new());
    assert_eq!(
        edited(
            "\"crank\": { \"angle\": 60 }",
            "\"crank\": { \"angular_velocity\": 60 }"
        ),
        [
            "line 30, column 47: initial.crank.angular_velocity: 60: a plain angular_velocity is in rad/s, although \
          \"angle\" has another unit (name a unit for \"angular_velocity\" in units, or write it with its unit)"
        ]
    );
    assert_eq!(
        edited(", \"free_length\": 150", ""),
        [
            "line 27, column 15: forces.return: \"free_length\" is left out and taken as 0 (write it, even if it is 0)"
        ]
    );
    assert_eq!(
        edited("\"at\": \"coupler.B\"", "\"at\": \"ground.O\""),
        [
            "line 28, column 38: forces.load.at: \"ground.O\": ground is fixed: the force moves nothing (name a body that it is to \
          move)"
        ]
    );
}

#[test]
fn torques_on_what_can_not_move_are_warned_of() {
    let torque = |ends: &str| {
        let set = format!("forces.t={{\"type\": \"torque\", {ends}, \"value\": 5}}");
        linkdyn_model::load(BASE.as_bytes(), &[set])
            .unwrap()
            .warnings
    };
    let none = Vec::<String>::new();
    assert_eq!(torque(r#""body": "crank""#), none);
    assert_eq!(torque(r#""body": "ground", "relative_to": "crank""#), none);
    for ends in [
        r#""body": "ground""#,
        r#""body": "ground", "relative_to": "ground""#,
    ] {
        let said = torque(ends);
        assert!(
            said.len() == 1 && said[0].contains("ground is fixed: the torque moves nothing"),
            "{said:?}"
        );
    }
    let said = torque(r#""body": "crank", "relative_to": "crank""#);
    assert!(
        said.len() == 1 && said[0].contains("the same body takes the opposite"),
        "{said:?}"
    );
}

#[test]
fn numbers_arrive_in_si() {
    let text = BASE.replace("7e-4", "\"700 kg*mm^2\"").replace(
        "[0, 5] }",
        "[\"1 lbf\", { \"type\": \"harmonic\", \"amplitude\": 2, \"frequency\": 3, \"phase\": 90 }] }",
    );
    let loaded =
        linkdyn_model::load(text.as_bytes(), &["joints.b.clearance.radius=10 um".into()]).unwrap();
    let (model, degree) = (&loaded.model, std::f64::consts::PI / 180.0);
    assert_eq!(model.bodies["crank"].inertia, Some(7e-4));
    assert_eq!(model.bodies["crank"].pose.angle, 60.0 * degree);
    assert_eq!(model.bodies["coupler"].points["B"], [0.25, 0.0]);
    let linkdyn_model::JointKind::Revolute {
        clearance: Some(clearance),
        ..
    } = &model.joints["b"].kind
    else {
        panic!()
    };
    assert_eq!(clearance.radius, Some(1e-5));
    let linkdyn_model::Motion::Polynomial { coefficients } = &model.drivers["motor"].motion else {
        panic!()
    };
    assert_eq!(coefficients, &[60.0 * degree, 10.0]);
    let linkdyn_model::Motion::Table { points, .. } = &model.drivers["pusher"].motion else {
        panic!()
    };
    assert_eq!(points, &[[0.0, 0.0], [1.0, 0.005]]);
    let linkdyn_model::ForceKind::Load {
        vector: [Value::Constant(x), Value::Motion(y)],
        ..
    } = &model.forces["load"].kind
    else {
        panic!()
    };
    assert_eq!(*x, 4.4482216152605);
    let harmonic = linkdyn_model::Motion::Harmonic {
        offset: 0.0,
        amplitude: 2.0,
        frequency: 3.0,
        phase: 90.0 * degree,
    };
    assert_eq!(*y, harmonic);
    assert_eq!(
        model.bodies.keys().collect::<Vec<_>>(),
        ["ground", "crank", "coupler", "rocker", "slider"]
    );
}

#[test]
fn the_document_is_what_was_written_and_set() {
    let sets = [
        "analysis.solver.rtol=1e-9",
        "joints.b.between[1]=rocker.B",
        "about=x=y",
        "gravity=[0, 0]",
    ]
    .map(String::from);
    let loaded = linkdyn_model::load(BASE.as_bytes(), &sets).unwrap();
    let mut expected: serde_json::Value = serde_json::from_str(BASE).unwrap();
    expected["analysis"]["solver"] = serde_json::json!({ "rtol": 1e-9 });
    expected["joints"]["b"]["between"][1] = "rocker.B".into();
    expected["about"] = "x=y".into();
    expected["gravity"] = serde_json::json!([0, 0]);
    assert_eq!(loaded.document.to_string(), expected.to_string());
    let place = |path: &str| {
        loaded
            .source
            .locate(path)
            .map(|place| (place.line, place.column))
    };
    assert_eq!(place("joints.b.between[0]"), Some((16, 44)));
    assert_eq!(place("joints.b.between[1]"), None, "it came from --set");
    assert_eq!(
        place("joints.b.speed"),
        Some((16, 5)),
        "the key of the nearest ancestor"
    );
    assert_eq!(place(""), Some((1, 1)));
}

#[test]
fn a_note_is_allowed_in_every_object() {
    // a brace that opens an object gets a note at once
    let text = BASE
        .replace(", \"note\": \"measured\"", "")
        .replace("{ ", "{ \"note\": \"why\", ")
        .replace("{\n", "{ \"note\": \"why\",\n");
    assert_eq!(
        said(text.as_bytes(), &["analysis.solver.note=why"]),
        Vec::<String>::new()
    );
}
