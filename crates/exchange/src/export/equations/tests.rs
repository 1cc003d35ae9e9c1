//! What is not written as equations, in exact words; and what is, for names that are no identifiers.

use linkdyn_model::error::Complaints;

use super::{BodyState, Equations, Linkage, StartState};

/// A pendulum with other entries in its sections.
fn model(bodies: &str, joints: &str, rest: &str) -> String {
    let comma = |text: &str| match text {
        "" => String::new(),
        text => format!(", {text}"),
    };
    format!(
        r#"{{ "format": "linkdyn/1", "units": "SI",
            "bodies": {{ "ground": {{ "points": {{ "O": [0, 0], "Q": [1, 0] }} }},
                         "rod": {{ "mass": 1, "inertia": 0.1, "com": [0.5, 0], "points": {{ "O": [0, 0], "P": [1, 0] }} }}{} }},
            "joints": {{ "o": {{ "type": "revolute", "between": ["ground.O", "rod.O"] }}{} }}{} }}"#,
        comma(bodies),
        comma(joints),
        comma(rest)
    )
}

fn linkage(text: &str) -> Result<Linkage, Complaints> {
    let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("a legal model");
    Linkage::of(&loaded.model, "test")
}

fn told(text: &str) -> String {
    linkage(text).expect_err("it is refused").to_string()
}

/// The model at the poses of its file, at rest.
fn drawn(text: &str) -> Result<Equations, Complaints> {
    let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("a legal model");
    let bodies = super::linkage::moving(&loaded.model).map(|(_, body)| BodyState {
        position: body.pose.position,
        angle: body.pose.angle,
        ..BodyState::default()
    });
    let state = StartState {
        bodies: bodies.collect(),
        efforts: vec![0.0; loaded.model.drivers.len()],
    };
    linkage(text)?.at(&state)
}

const WHEEL: &str =
    r#""wheel": { "mass": 1, "inertia": 0.1, "com": [0, 0], "points": { "Q": [0, 0] } }"#;
const HUB: &str = r#""hub": { "type": "revolute", "between": ["ground.Q", "wheel.Q"] }"#;

#[test]
fn joints_that_are_not_written_are_named() {
    let cases = [
        (
            r#""mesh": { "type": "gear", "between": ["rod.O", "wheel.Q"], "ratio": -2 }"#,
            r#"joints.mesh: a joint of type "gear" is not written as equations (revolute, prismatic and fixed joints are)"#,
        ),
        (
            r#""slot": { "type": "slot", "between": ["rod.O", "wheel.Q"], "axis": [1, 0] }"#,
            r#"joints.slot: a joint of type "slot" is not written as equations (revolute, prismatic and fixed joints are)"#,
        ),
        (
            r#""rubber": { "type": "bushing", "between": ["rod.P", "wheel.Q"], "radial_stiffness": 1000 }"#,
            r#"joints.rubber: a joint of type "bushing" is not written as equations (revolute, prismatic and fixed joints are)"#,
        ),
        (
            r#""belt": { "type": "belt", "between": ["rod.O", "wheel.Q"], "radii": [0.1, 0.2] }"#,
            r#"joints.belt: a joint of type "belt" is not written as equations (revolute, prismatic and fixed joints are)"#,
        ),
        (
            r#""pin": { "type": "revolute", "between": ["rod.P", "wheel.Q"], "clearance": { "model": "massless_link", "radius": 0.001 } }"#,
            r#"joints.pin.clearance: a clearance is not written as equations (clearances with the model "ideal" are)"#,
        ),
        (
            r#""pin": { "type": "revolute", "between": ["rod.P", "wheel.Q"], "pin_radius": 0.01, "friction": { "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 0.001 } }"#,
            "joints.pin.friction: friction is not written as equations (joints without it are)",
        ),
        (
            r#""pin": { "type": "revolute", "between": ["rod.P", "wheel.Q"], "limits": [-1, 1] }"#,
            "joints.pin.limits: a way that ends is not written as equations (joints that hold all the time and move without end are)",
        ),
        (
            r#""pin": { "type": "revolute", "between": ["rod.P", "wheel.Q"], "one_way": "forward" }"#,
            "joints.pin.one_way: a one-way clutch is not written as equations (joints that hold all the time and move without end are)",
        ),
    ];
    for (joint, text) in cases {
        let joints = format!("{HUB}, {joint}");
        assert_eq!(told(&model(WHEEL, &joints, "")), text);
    }
}

#[test]
fn drivers_and_forces_that_are_not_written_are_named() {
    let cases = [
        (
            r#""drivers": { "ram": { "type": "length", "between": ["ground.Q", "rod.P"], "motion": { "type": "polynomial", "coefficients": [1] } } }"#,
            r#"drivers.ram: a driver of type "length" is not written as equations (drivers of type rotation and translation are)"#,
        ),
        (
            r#""drivers": { "m": { "type": "rotation", "body": "rod", "motion": { "type": "cycloidal", "rise": 1, "duration": 1 } } }"#,
            r#"drivers.m.motion: a motion of type "cycloidal" is not written as equations (polynomial, constant_velocity, constant_acceleration and harmonic motions are)"#,
        ),
        (
            r#""forces": { "f": { "type": "torque", "body": "rod", "value": { "type": "table", "points": [[0, 1], [1, 2]] } } }"#,
            r#"forces.f.value: a motion of type "table" is not written as equations (polynomial, constant_velocity, constant_acceleration and harmonic motions are)"#,
        ),
        (
            r#""forces": { "f": { "type": "force", "at": "rod.P", "vector": ["=-rod.vx*1 N*s/m", 0] } }"#,
            r#"forces.f.vector[0]: a formula of the motion is not written as equations (constants and laws of time are)"#,
        ),
        (
            r#""forces": { "g": { "type": "gas_spring", "between": ["ground.Q", "rod.P"], "force": 10, "extended": 2, "stroke": 1 } }"#,
            r#"forces.g: a force of type "gas_spring" is not written as equations (spring, torsion_spring, actuator, force and torque are)"#,
        ),
        (
            r#""forces": { "s": { "type": "spring", "between": ["ground.Q", "rod.P"], "stiffness": 10, "limits": [0.1, 3] } }"#,
            "forces.s.limits: a stroke that ends is not written as equations (strokes without limits are)",
        ),
        (
            r#""forces": { "f": { "type": "torque", "body": "rod", "value": 1e61 } }"#,
            "forces.f: a number is too large for products of it to be written as equations (1e60 in SI units at most)",
        ),
        (
            r#""states": { "heat": { "start": 0, "rate": "=1/1 s" } }"#,
            "states.heat: a state with a rate of its own is not written as equations (mechanisms are)",
        ),
    ];
    for (rest, text) in cases {
        assert_eq!(told(&model("", "", rest)), text);
    }
}

#[test]
fn all_that_is_not_written_is_told_at_once() {
    let joints = format!(
        r#"{HUB}, "mesh": {{ "type": "gear", "between": ["rod.O", "wheel.Q"], "ratio": -2 }}"#
    );
    let rest = r#""forces": { "s": { "type": "spring", "between": ["ground.Q", "rod.P"], "stiffness": 10, "limits": [0.1, 3] } }"#;
    assert_eq!(told(&model(WHEEL, &joints, rest)).lines().count(), 2);
}

#[test]
fn bodies_that_are_none_or_too_many_are_told() {
    let ground = r#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "ground": { "points": { "O": [0, 0] } } } }"#;
    assert_eq!(
        told(ground),
        r#"bodies: no body moves, so that there is nothing to write (add a body other than "ground")"#
    );
    let many = |count: usize| -> String {
        let bodies =
            (0..count).map(|k| format!(r#""b{k}": {{ "mass": 1, "inertia": 1, "com": [0, 0] }}"#));
        bodies.collect::<Vec<_>>().join(", ")
    };
    assert_eq!(
        told(&model(&many(40), "", "")),
        "bodies: 41 moving bodies are too many to be written as equations (40 at most)"
    );
    let equations = drawn(&model(&many(6), "", "")).expect("seven bodies");
    assert_eq!(
        equations.latex().expect_err("too many").to_string(),
        "bodies: 7 moving bodies are too many for equations in LaTeX (6 at most; `--equations python` writes more)"
    );
    assert!(equations.python().contains("x_b5"));
}

#[test]
fn loops_and_drivers_that_depend_on_others_are_told() {
    let same = r#""p": { "type": "revolute", "between": ["ground.Q", "rod.P"] }"#;
    let text = model("", same, "");
    // Both pins are a unit apart on the ground, too: the rod is held, and one row is left over.
    assert_eq!(
        drawn(&text).expect_err("redundant").to_string(),
        "joints.p: the loop that this joint closes depends on others here, and a redundant joint or a singular position is not written as \
         equations (remove what is redundant, `linkdyn check` names it, or start from another position)"
    );
    let motion = r#""motion": { "type": "polynomial", "coefficients": [0, 1] }"#;
    let twice = format!(
        r#""drivers": {{ "one": {{ "type": "rotation", "body": "rod", {motion} }}, "two": {{ "type": "rotation", "body": "wheel", {motion} }} }}"#
    );
    let welded = r#""weld": { "type": "fixed", "between": ["rod.P", "wheel.Q"] }"#;
    assert_eq!(
        drawn(&model(WHEEL, welded, &twice))
            .expect_err("driven twice")
            .to_string(),
        "drivers.two: what this driver moves is determined without it, and more drivers than degrees of freedom, or one at a dead centre, are \
         not written as equations (remove a driver, or start from another position)"
    );
    let weld = r#""weld": { "type": "fixed", "between": ["ground.Q", "wheel.Q"] }"#;
    let held = r#"{ "format": "linkdyn/1", "units": "SI",
        "bodies": { "ground": { "points": { "Q": [0, 0] } }, "wheel": { "points": { "Q": [0, 0] } } }, "joints": { WELD } }"#;
    assert_eq!(
        drawn(&held.replace("WELD", weld))
            .expect_err("held")
            .to_string(),
        "joints: the joints let no body move, so that there is nothing to write as equations (`linkdyn check` counts the degrees of freedom)"
    );
}

/// Identifiers of Python are letters, digits and `_`, no keyword, and each constant is given once.
#[test]
fn names_become_identifiers_that_differ() {
    let names = [
        "lambda",
        "1a",
        "ä_b",
        "class",
        "a b",
        "a_b",
        "A_B",
        "曲柄",
        "START",
        "\\end{document}%",
        "\"\"\"",
    ];
    let bodies = names.map(|name| {
        let name = serde_json::json!(name);
        format!(r#"{name}: {{ "mass": 1, "inertia": 1, "com": [0.1, 0], "points": {{ "x": [0, 0], "X": [1, 1] }} }}"#)
    });
    for chunk in bodies.chunks(5) {
        let equations = drawn(&model(&chunk.join(", "), "", "")).expect("bodies that fall");
        let text = equations.python();
        let constants = text.lines().filter_map(|line| line.split_once(" = "));
        let mut seen = std::collections::HashSet::new();
        for (name, _) in constants.filter(|(name, _)| !name.starts_with([' ', '#'])) {
            if name.contains(',') {
                continue;
            }
            assert!(
                name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'),
                "{name}"
            );
            assert!(name.starts_with(|c: char| c.is_ascii_uppercase()), "{name}");
            assert!(seen.insert(name.to_owned()), "{name} is there twice");
        }
        assert!(seen.len() > 20);
        assert_eq!(text.matches("\"\"\"").count() % 2, 0);
        let latex = equations.latex().expect("six bodies");
        assert_eq!(latex.matches("\\end{document}").count(), 1);
    }
}
