//! What `linkdyn optimise` refuses, to the letter.

use crate::browser::Scratch;
use std::process::{Command, Stdio};

const STROKE: &str = "max(piston.x) - min(piston.x)";

/// What is said, and the exit status.
fn said(arguments: &[&str]) -> String {
    let scratch = Scratch::new("optimise-refused");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command
        .arg("optimise")
        .args(arguments)
        .current_dir(&scratch.0)
        .stdin(Stdio::null());
    let output = command.output().expect("the binary runs");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    assert_eq!(String::from_utf8_lossy(&output.stdout), "", "{arguments:?}");
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Options for the bundled slider-crank, and all that is said; `§` stands for the stroke.
const CASES: &[(&[&str], &str)] = &[
    (
        &["--vary", "parameters.cranc=10:20", "--goal", "§ = 80 mm"],
        "slider-crank: --vary parameters.cranc=10:20: there is no parameter \"cranc\" (did you mean \"crank\"?)",
    ),
    (
        &["--vary", "crank=60:10", "--goal", "§ = 80 mm"],
        "slider-crank: --vary crank=60:10: the bounds are the wrong way round (the lower bound comes first)",
    ),
    (
        &["--vary", "crank=10 mm:10 mm", "--goal", "§ = 80 mm"],
        "slider-crank: --vary crank=10 mm:10 mm: between these bounds there is nothing (as in [\"10 mm\", \"60 mm\"])",
    ),
    (
        &["--vary", "crank=10 N:20 N", "--goal", "§ = 80 mm"],
        "slider-crank: --vary crank=10 N:20 N: this is a force [N], where a length [m] is wanted, as the parameter is",
    ),
    (
        &["--vary", "crank=10 mm", "--goal", "§ = 80 mm"],
        "--vary crank=10 mm: write it as in \"parameters.r=10 mm:60 mm\", lower and upper bound",
    ),
    (
        &["--vary", "bodies.crank.mass=1:2", "--goal", "§ = 80 mm"],
        "--vary bodies.crank.mass=1:2: only parameters can be varied; write it as in \"parameters.r=10 mm:60 mm\", lower and upper bound",
    ),
    (
        &["--vary", "crank", "--goal", "§ < 80 mm"],
        "--goal \"§ < 80 mm\": a goal is an equation, as in \"stroke = 80 mm\"; an inequality is a --constraint",
    ),
    (
        &["--vary", "crank", "--goal", "§"],
        "--goal \"§\": a goal is an equation, as in \"stroke = 80 mm\"; an inequality is a --constraint",
    ),
    (
        &["--vary", "crank", "--goal", "§ = 80 N"],
        "slider-crank: --goal \"§ = 80 N\": a length [m] and a force [N] can't be compared",
    ),
    (
        &["--vary", "crank", "--goal", "max(pistn.x) = 80 mm"],
        "slider-crank: --goal \"max(pistn.x) = 80 mm\": there is no column, parameter or number \"pistn.x\" (did you mean \"piston.x\"?)",
    ),
    (
        &["--vary", "crank=10 mm:60 mm"],
        "nothing is looked for: say --goal \"stroke = 80 mm\", --minimise EXPRESSION or --maximise EXPRESSION, or \"optimise\" in the model",
    ),
    (
        &["--goal", "§ = 80 mm"],
        "nothing may change: say --vary \"parameters.r=10 mm:60 mm\", or \"design\" in the model's \"optimise\"",
    ),
    (
        &["--vary", "crank", "--minimise", "§"],
        "slider-crank: --vary crank: a range is missing: only a goal of one parameter goes without (as in [\"10 mm\", \"60 mm\"])",
    ),
    (
        &[
            "--vary",
            "crank=10:60",
            "--minimise",
            "§",
            "--maximise",
            "§",
        ],
        "--minimise \"§\", --maximise \"§\": there is one objective; what else must hold is a --constraint",
    ),
    (
        &["--vary", "crank=10:60", "--minimise", "piston.x"],
        "slider-crank: --minimise \"piston.x\": this has many values: which one of them? (max( … ), mean( … ), last( … ), or at( … , driver.NAME = value))",
    ),
    (
        &[
            "--vary",
            "crank=10:60",
            "--minimise",
            "§",
            "--constraint",
            "§",
        ],
        "slider-crank: --constraint \"§\": an equation or an inequality is expected (as in \"stroke = 80 mm\" or \"peak < 40 N*m\")",
    ),
    (
        &["--vary", "crank=10:60", "--minimise", "§", "--robust", "3"],
        "slider-crank: no parameter has a tolerance, so that nothing scatters; as in \"rod\": { \"value\": \"200 mm\", \"tolerance\": \"0.1 mm\" }",
    ),
    (
        &["--vary", "crank=10:60", "--minimise", "§", "--starts", "0"],
        "slider-crank: --starts 0: must not be less than 1",
    ),
];

#[test]
fn options_that_do_not_fit_are_told_to_the_letter() {
    for (options, wanted) in CASES {
        let written = |text: &str| text.replace('§', STROKE);
        let options: Vec<String> = options.iter().map(|one| written(one)).collect();
        let options: Vec<&str> = options.iter().map(String::as_str).collect();
        let found = said(&[&["slider-crank"], &options[..]].concat());
        assert_eq!(
            found,
            format!("error: {}\n", written(wanted)),
            "{options:?}"
        );
    }
}

/// What stands under `optimise` of the bundled four-bar, and what is said of it.
const MODELS: &[(&str, &str)] = &[
    (
        r#"{"design":{"crank":[60,140]},"curve":{"point":"coupler.Q","through":[[1,2],[3,4]]}}"#,
        r#"optimise.curve.point: body "coupler" has no point "Q" (its points: A, B, P)"#,
    ),
    (
        r#"{"design":{"crank":[60,140]},"curve":{"point":"coupler.P","through":[[1,2],[3,4]],"at":[0,10,20]}}"#,
        "optimise.curve.at: 3 values of the driver do not fit 2 points (one for each point; left out, it does not matter when the path passes them)",
    ),
    (
        r#"{"design":{"crank":[60,140]},"curve":{"point":"coupler.P","through":[[1,2],[3,4]],"at":[0,"5 mm"]}}"#,
        r#"optimise.curve.at[1]: "mm" is not a unit of angle (such as "rad")"#,
    ),
    (
        r#"{"design":{"crank":[60,140]},"curve":{"point":"coupler.P"}}"#,
        r#"optimise.curve: "through" is missing (as in "through": [[10, 40], [20, 45], [30, 40]])"#,
    ),
    (
        r#"{"design":{"crank":[60,140]},"curve":{"point":"coupler.P","through":[[1,2],[3,4]]},"objective":{"minimise":"1"}}"#,
        r#"optimise.curve: "objective" and "curve" exclude each other (keep one of them)"#,
    ),
    (
        r#"{"design":{"crank":[60,140]},"objective":{"minimise":"1","maximise":"1"}}"#,
        r#"optimise.objective.maximise: "minimise" and "maximise" exclude each other (keep one of them)"#,
    ),
    (
        r#"{"design":{"crank":[60,140]},"objectiv":{"minimise":"1"}}"#,
        r#"optimise.objectiv: unknown key (did you mean "objective"?)"#,
    ),
    (
        r#"{"design":{"crank":[60,140]},"constraints":["max(rocker.angle) < 2 rad"]}"#,
        r#""objective" is missing (as in "objective": { "minimise": "max(abs(driver.motor.effort))" }; equations alone are goals, and need none)"#,
    ),
    (
        r#"{"design":{},"objective":{"minimise":"1"}}"#,
        r#"optimise.design: it is empty, at least one parameter is needed (as in "r": ["10 mm", "60 mm"])"#,
    ),
    (
        r#"{"objective":{"minimise":"1"}}"#,
        r#""design" is missing (as in "design": { "r": ["10 mm", "60 mm"] })"#,
    ),
    (
        r#"{"design":{"crank":5},"objective":{"minimise":"1"}}"#,
        r#"optimise.design.crank: a lower and an upper bound are expected (as in ["10 mm", "60 mm"])"#,
    ),
];

#[test]
fn words_of_a_model_that_do_not_fit_are_told_to_the_letter() {
    for (asked, wanted) in MODELS {
        let found = said(&["four-bar", "--set", &format!("optimise={asked}")]);
        assert!(
            found.ends_with(&format!(": {wanted}\n")),
            "{asked}:\n{found}"
        );
        assert_eq!(found.lines().count(), 1, "{found}");
    }
}
