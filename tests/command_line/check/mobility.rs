//! What the mobility means.

use super::*;

#[test]
fn the_mobility_is_said_in_a_sentence() {
    let cases: &[(&[&str], &str)] = &[
        (
            &["four-bar"],
            "1 degree of freedom, driven by motor: kinematics, inverse dynamics, statics and quasi-statics are possible; forward dynamics \
             has nothing free",
        ),
        (
            &["double-pendulum"],
            "2 degrees of freedom, none driven: forward dynamics, statics and quasi-statics are possible; kinematics and inverse dynamics \
             need 2 drivers",
        ),
        (
            &[
                "double-pendulum",
                "--set",
                r#"drivers.m={"type":"rotation","body":"upper","motion":{"type":"constant_velocity","velocity":1}}"#,
            ],
            "2 degrees of freedom, 1 driven by m: forward dynamics, statics and quasi-statics are possible; kinematics and inverse dynamics \
             need 1 driver more",
        ),
        (
            &[
                "slider-crank-clearance",
                "--set",
                "joints.wristpin.clearance.model=ideal",
            ],
            "1 degree of freedom, driven by motor: kinematics, inverse dynamics, statics and quasi-statics are possible; forward dynamics has nothing \
             free",
        ),
        (
            &["slider-crank-clearance"],
            "with ideal pins 1 degree of freedom, driven by motor: kinematics, inverse dynamics and forward dynamics are \
             possible; the journal of wristpin is free in its bearing: 3 degrees of freedom in motion",
        ),
        // Free journals are integrated, driven or not.
        (
            &["slider-crank-clearance", "--set", "drivers={}"],
            "with ideal pins 1 degree of freedom, none driven: kinematics, inverse dynamics and forward dynamics are \
             possible; the journal of wristpin is free in its bearing: 3 degrees of freedom in motion",
        ),
        (
            &["hoeken"],
            "1 degree of freedom, driven by motor: kinematics, statics and quasi-statics are possible; forward dynamics has nothing free; \
             inverse dynamics needs data that bodies lack",
        ),
        (
            &[
                "four-bar",
                "--set",
                "drivers={}",
                "--set",
                r#"joints.weld={"type":"fixed","between":["ground.O2","crank.O2"],"angle":60}"#,
            ],
            "no degree of freedom, a structure: nothing in it can move: kinematics, inverse dynamics, statics and quasi-statics are possible",
        ),
    ];
    for (arguments, sentence) in cases {
        let (_, stdout, stderr) = linkdyn(&[&["check", "--json"], *arguments].concat());
        let told: Value =
            serde_json::from_str(&stdout).unwrap_or_else(|_| panic!("{arguments:?}: {stderr}"));
        assert_eq!(told["mobility"]["words"], *sentence, "{arguments:?}");
    }
}

#[test]
fn loops_and_lacks_are_named() {
    let told = checked(&[
        "hoeken",
        "--set",
        "bodies.rocker.mass=1",
        "--set",
        "bodies.rocker.com=[0, 0]",
    ]);
    assert_eq!(told["loops"], json!(["a – b – c – d"]));
    assert_eq!(told["loop_bodies"], json!([["crank", "coupler", "rocker"]]));
    assert_eq!(
        told["lacks"],
        json!([
            { "bodies": ["crank", "coupler"], "keys": ["mass", "inertia"], "for": ["inverse_dynamics", "dynamics"] },
            { "bodies": ["rocker"], "keys": ["inertia"], "for": ["inverse_dynamics", "dynamics"] },
        ])
    );
    // As it was before: each analysis with what it lacks.
    assert_eq!(
        told["missing"]["inverse_dynamics"][2],
        "inertia of body \"rocker\""
    );
}

/// A block on a guide between stops.
const STOP: &str = r#"{ "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81],
  "bodies": { "ground": { "points": { "O": [0, 0] } },
    "block": { "mass": 1, "inertia": 0.01, "com": [0, 0], "points": { "P": [0, 0] } } },
  "joints": { "guide": { "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [0, 1] },
    "j": { "type": "revolute", "between": ["ground.O", "block.P"], "clearance": { "model": "contact", "radius": 0.05, "bearing_radius": 0.1,
      "normal": { "law": "kelvin_voigt", "stiffness": 1e5, "damping": 100 }, "surface": { "stiffness": 1e5, "damping": 100 },
      "impact": { "restitution": 0.5 } } } },
  "analysis": { "type": "dynamics", "end": 0.1, "outputs": 11 } }
"#;

#[test]
fn a_stop_leaves_its_body_free() {
    let file = File::new("stop", STOP);
    let driver = r#"drivers.m={"type":"translation","joint":"guide","motion":{"type":"constant_velocity","velocity":0.01}}"#;
    let possible = "kinematics, inverse dynamics and forward dynamics are possible";
    for model in ["contact", "two_state", "three_state"] {
        let model = format!("joints.j.clearance.model={model}");
        let told = checked(&[file.path(), "--set", &model]);
        let free = "the journal of j is free in its bearing: 1 degree of freedom in motion";
        assert_eq!(
            told["mobility"]["words"],
            format!("with ideal pins no degree of freedom: {possible}; {free}")
        );
        assert_eq!(
            told["mobility"]["free_journals"],
            json!({ "joints": ["j"], "grubler": 1, "rank": 1 })
        );
        // What run says of it.
        let (status, stdout, _) = linkdyn(&["run", file.path(), "--set", &model]);
        assert!(
            status == Some(0) && stdout.contains("1 by Grübler, 1 by rank"),
            "{stdout}"
        );
    }
    // A driver of what only ideal pins hold is none too many.
    let told = checked(&[file.path(), "--set", driver]);
    let words = told["mobility"]["words"].as_str().expect("words");
    assert!(
        words.contains("kinematics") && words.contains("possible") && !words.contains("take"),
        "{words}"
    );
    assert_eq!(
        linkdyn(&[
            "run",
            file.path(),
            "--set",
            driver,
            "--set",
            "analysis.type=kinematics"
        ])
        .0,
        Some(0)
    );
}

/// A chain of bodies none of which is fixed, and those that something holds.
#[test]
fn a_mechanism_that_nothing_holds_is_said_to_be_loose() {
    let model = |fixed: &str, mass: &str, forces: &str| {
        format!(
            r#"{{ "format": "linkdyn/1", "units": "SI", "bodies": {{
  "{fixed}": {{ {mass} "points": {{ "O": [0, 0] }} }},
  "arm": {{ "mass": 1, "inertia": 0.1, "com": [0.5, 0], "points": {{ "O": [0, 0], "A": [1, 0] }} }} }},
  "joints": {{ "o": {{ "type": "revolute", "between": ["{fixed}.O", "arm.O"] }} }}, "forces": {{ {forces} }},
  "analysis": {{ "type": "dynamics", "end": 1, "outputs": 3 }} }}"#
        )
    };
    let warned = |name: &str, text: &str| {
        let file = File::new(name, text);
        let told = checked(&[file.path()]);
        assert_eq!(
            told["mobility"]["rank"],
            if text.contains("ground\": {") { 1 } else { 4 }
        );
        told["warnings"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|text| text.as_str().expect("text").to_string())
            .collect::<Vec<_>>()
    };
    let heavy = r#""mass": 10, "inertia": 1, "com": [0, 0],"#;
    let loose = |hint: &str| {
        vec![format!(
            "line 1, column 51: bodies: nothing holds the mechanism: no body is called \"ground\", which is the name of the fixed one \
             (rename the fixed body{hint} to \"ground\", unless all of it is to move freely)"
        )]
    };
    assert_eq!(
        warned("frame", &model("machine_frame", heavy, "")),
        loose(", probably \"machine_frame\",")
    );
    // Without an analysis, which would need masses.
    let massless = model("block", "", "").replace(
        r#",
  "analysis": { "type": "dynamics", "end": 1, "outputs": 3 }"#,
        "",
    );
    assert_eq!(
        warned("massless", &massless),
        loose(", probably \"block\",")
    );
    assert_eq!(warned("heavy", &model("block", heavy, "")), loose(""));
    assert_eq!(
        warned("ground", &model("ground", "", "")),
        Vec::<String>::new()
    );
    // A spring holds it, too, though nothing stays where it is.
    let spring =
        r#""s": { "type": "torsion_spring", "between": ["ground", "arm"], "stiffness": 1 }"#;
    assert_eq!(
        warned("spring", &model("block", heavy, spring)),
        Vec::<String>::new()
    );
    // There is a ground, and nothing on it.
    let text = model("base", heavy, "").replace(
        r#""bodies": {"#,
        r#""bodies": { "ground": { "points": { "O": [0, 0] } },"#,
    );
    let file = File::new("untouched", &text);
    let told = checked(&[file.path()])["warnings"].to_string();
    assert!(
        told.contains(
            "no joint or spring is on \\\"ground\\\" (rename the fixed body, probably \\\"base\\\""
        ),
        "{told}"
    );
}

/// A lid that a hand lifts, of which nothing is weighed yet.
const LID: &str = r#"{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg" }, "gravity": [0, "-9.81 m/s^2"],
  "bodies": { "ground": { "points": { "O": [0, 0], "P": [300, -100] } }, "lid": { "points": { "O": [0, 0], "P": [250, 20] } } },
  "joints": { "hinge": { "type": "revolute", "between": ["ground.O", "lid.O"] } },
  "forces": { "gas": { "type": "gas_spring", "between": ["ground.P", "lid.P"], "force": "130 N", "extended": 450, "stroke": 330, "progression": 1.3 } },
  "drivers": { "hand": { "type": "rotation", "body": "lid", "motion": { "type": "constant_velocity", "velocity": 10 } } },
  "responses": { "hand": { "value": "max(abs(driver.hand.effort))/850 mm", "unit": "kN" } },
  "analysis": { "type": "quasi_statics", "sample": { "driver": "hand", "from": 0, "to": 80, "step": 20 } } }"#;

#[test]
fn what_lacks_masses_can_be_moved_slowly() {
    let file = File::new("lid", LID);
    let told = checked(&[file.path()]);
    assert_eq!(
        told["mobility"]["words"],
        "1 degree of freedom, driven by hand: kinematics and quasi-statics are possible; forward dynamics has nothing free; \
         inverse dynamics and statics need data that bodies lack; in quasi-statics a body without mass has no weight"
    );
    assert_eq!(told["possible"], json!(["kinematics", "quasi_statics"]));
    let (status, _, said) = linkdyn(&["run", file.path()]);
    assert_eq!(status, Some(0), "{said}");
    // What moves freely in its bearing has no place at rest.
    let told = checked(&["slider-crank-clearance"]);
    let missing = json!(["an ideal clearance of joint \"wristpin\""]);
    assert_eq!(told["missing"]["quasi_statics"], missing);
}

#[test]
fn responses_are_listed_in_the_unit_that_the_model_declares() {
    let file = File::new("lid-responses", LID);
    let (_, said, _) = linkdyn(&["check", file.path()]);
    let row = "responses     hand = max(abs(driver.hand.effort))/850 mm  [kN]";
    assert!(said.contains(row), "{said}");
    let told = checked(&[file.path()]);
    let wanted =
        json!({ "value": "max(abs(driver.hand.effort))/850 mm", "unit": "N", "declared": "kN" });
    assert_eq!(told["responses"]["hand"], wanted);
}
