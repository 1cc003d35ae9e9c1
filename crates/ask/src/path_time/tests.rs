//! Closed forms, other programs' answers, and what is refused.

use super::*;
use crate::Text;
use linkdyn_model::FileAccess;
use std::collections::BTreeMap;

const SLIDER_CRANK: &str = include_str!("tests/slider-crank.json");
const FOUR_BAR: &str = include_str!("tests/four-bar.json");
/// A wheel of 0.02 kg·m², not balanced if its centre of mass is elsewhere.
const WHEEL: &str = r#"{ "format": "linkdyn/1", "units": { "angle": "deg" },
  "bodies": { "wheel": { "mass": 2, "inertia": 0.02, "com": [0, 0], "points": { "O": [0, 0] } }, "ground": { "points": { "O": [0, 0] } } },
  "joints": { "o": { "type": "revolute", "between": ["ground.O", "wheel.O"] } },
  "drivers": { "motor": { "type": "rotation", "body": "wheel", "motion": { "type": "constant_velocity", "velocity": "1 rad/s" } } },
  "analysis": { "type": "kinematics", "end": 2, "outputs": 2 } }"#;

fn file(text: &str, sets: &[&str]) -> ModelFile {
    let bytes = text.as_bytes().to_vec();
    let text = Text::new("m".into(), "m".into(), bytes, FileAccess::default());
    let sets = sets.iter().map(|set| (*set).to_owned()).collect();
    ModelFile::read(text, sets).expect("a legal model")
}

/// A question from its options: `from`, `limit` and so on, each with its text.
fn question(options: &[(&str, &str)]) -> PathTime {
    let mut question = PathTime::default();
    for (option, text) in options {
        let text = (*text).to_owned();
        match *option {
            "driver" => question.driver = Some(text),
            "from" => question.from = Some(text),
            "to" => question.to = Some(text),
            "limit" => question.limits.push(text),
            "speed" => question.speed = Some(text),
            "acceleration" => question.acceleration = Some(text),
            "start-speed" => question.start_speed = Some(text),
            "end-speed" => question.end_speed = Some(text),
            "intervals" => question.intervals = text.parse().ok(),
            other => panic!("{other}"),
        }
    }
    question
}

fn ask(text: &str, sets: &[&str], options: &[(&str, &str)]) -> Result<FastestMotion, Unanswered> {
    question(options).answer(&file(text, sets), &Control::default())
}

fn found(text: &str, sets: &[&str], options: &[(&str, &str)]) -> FastestMotion {
    ask(text, sets, options).unwrap_or_else(|why| panic!("{why}"))
}

/// Columns of a run of the written model with this number of outputs.
fn run_of(found: &FastestMotion, outputs: usize) -> BTreeMap<String, Vec<f64>> {
    let text = found.model().print();
    let file = file(&text, &[&format!("analysis.outputs={outputs}")]);
    let outcome = crate::run::unplaced(&file, &Control::default()).expect("it runs");
    let run = outcome.trajectory;
    assert_eq!(run.len(), outputs, "{:?}", outcome.report.message);
    let column = |name: &str| {
        run.columns
            .iter()
            .position(|own| own.name == name)
            .map(|k| run.rows().map(|row| row[k]).collect())
    };
    let names = run.columns.iter().map(|own| own.name.clone());
    names
        .filter_map(|name| column(&name).map(|values| (name.clone(), values)))
        .collect()
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most: f64, value| most.max(value.abs()))
}

#[test]
fn a_wheel_takes_the_time_of_the_closed_form() {
    let torque = ("limit", "driver.motor.effort=5 N*m");
    let angle = 90_f64.to_radians();
    let bang = 2.0 * (0.02 * angle / 5.0).sqrt();
    let there = found(WHEEL, &[], &[("from", "0 deg"), ("to", "90 deg"), torque]);
    assert!(
        (there.time() / bang - 1.0).abs() < 1e-10,
        "{}",
        there.time()
    );
    assert!(there.law.found.gap < 1e-8);
    // Backwards, and with plain numbers in the units of the file.
    let back = found(WHEEL, &[], &[("from", "40"), ("to", "-50"), torque]);
    assert!((back.time() / bang - 1.0).abs() < 1e-10, "{}", back.time());
    // ω² = 2 α s is reached after a quarter of the stroke, which is a node.
    let speed = (2.0 * 250.0 * 0.25 * angle).sqrt();
    let words = format!("{speed} rad/s");
    let limited = found(
        WHEEL,
        &[],
        &[("from", "0"), ("to", "90"), torque, ("speed", &words)],
    );
    let trapezoid = angle / speed + speed / 250.0;
    assert!(
        (limited.time() / trapezoid - 1.0).abs() < 1e-10,
        "{}",
        limited.time()
    );
    // From one speed to another by one acceleration.
    let ends = [
        ("from", "0"),
        ("to", "90"),
        ("start-speed", "10 rad/s"),
        ("end-speed", "20 rad/s"),
    ];
    let passing = found(
        WHEEL,
        &[],
        &[
            &ends[..],
            &[("acceleration", &format!("{} rad/s^2", 150.0 / angle))],
        ]
        .concat(),
    );
    assert!(
        (passing.time() / (angle / 15.0) - 1.0).abs() < 1e-7,
        "{}",
        passing.time()
    );
}

#[test]
fn the_stroke_is_that_of_the_model_where_nothing_is_said() {
    let found = found(WHEEL, &[], &[("acceleration", "2 rad/s^2")]);
    assert_eq!([found.stroke.from, found.stroke.to], [0.0, 2.0]);
    assert!((found.time() - 2.0).abs() < 1e-10, "{}", found.time());
}

/// Times by CasADi 3.8 and IPOPT on 400 intervals with limits at nine places in each: coefficients from closed forms of the linkage and
/// Newton and Euler's equations, solved with NumPy.
#[test]
fn another_program_with_other_equations_finds_the_same_times() {
    let slider = found(
        SLIDER_CRANK,
        &[],
        &[
            ("from", "20 deg"),
            ("to", "170 deg"),
            ("limit", "driver.motor.effort=1.2 N*m"),
            ("limit", "joint.small=22 N"),
            ("speed", "24 rad/s"),
        ],
    );
    let four_bar = found(
        FOUR_BAR,
        &[],
        &[
            ("from", "30 deg"),
            ("to", "300 deg"),
            ("limit", "driver.motor.effort=3 N*m"),
            ("limit", "joint.a=45 N"),
            ("limit", "joint.c=28 N"),
            ("speed", "20 rad/s"),
        ],
    );
    for (found, time) in [(&slider, 0.141_794_899_913), (&four_bar, 0.290_789_388_669)] {
        let off = found.time() / time - 1.0;
        assert!(off.abs() < 1e-6, "{} {time}: {off:e}", found.time());
        assert!(found.law.found.gap < 1e-8, "{}", found.law.found.gap);
        assert!(found.excess.0 < 1e-6, "{:?}", found.excess);
        assert!(
            found.shares().iter().all(|share| *share > 0),
            "{:?}",
            found.shares()
        );
    }
    // What is written keeps all limits at instants of its own, too.
    let run = run_of(&slider, 3333);
    let effort = largest(run["driver.motor.effort"].iter().copied());
    assert!(
        effort < 1.2 * (1.0 + 1e-6) && effort > 1.2 * (1.0 - 1e-3),
        "{effort}"
    );
    let force = run["joint.small.fx"].iter().zip(&run["joint.small.fy"]);
    let force = largest(force.map(|(x, y)| x.hypot(*y)));
    assert!(
        force < 22.0 * (1.0 + 1e-6) && force > 22.0 * (1.0 - 1e-3),
        "{force}"
    );
    let speed = largest(run["crank.omega"].iter().copied());
    assert!(speed < 24.0 * (1.0 + 1e-6), "{speed}");
}

#[test]
fn velocities_and_accelerations_of_columns_may_be_limited() {
    let options = [
        ("from", "20 deg"),
        ("to", "160 deg"),
        ("limit", "piston.vx=1 m/s"),
        ("limit", "piston.ax=-12 m/s^2:15 m/s^2"),
    ];
    let found = found(SLIDER_CRANK, &[], &options);
    assert!(
        found.shares().iter().all(|share| *share > 0),
        "{:?}",
        found.shares()
    );
    let run = run_of(&found, 2777);
    let speed = largest(run["piston.vx"].iter().copied());
    assert!((speed - 1.0).abs() < 1e-6, "{speed}");
    let most = run["piston.ax"]
        .iter()
        .fold(0.0, |most: f64, a| most.max(*a));
    let least = run["piston.ax"]
        .iter()
        .fold(0.0, |least: f64, a| least.min(*a));
    assert!(
        (most - 15.0).abs() < 2e-5 && (least + 12.0).abs() < 2e-5,
        "{least} {most}"
    );
}

#[test]
fn more_intervals_are_a_little_faster() {
    let time = |intervals: &str| {
        let options = [
            ("from", "20 deg"),
            ("to", "170 deg"),
            ("limit", "driver.motor.effort=1.2 N*m"),
            ("limit", "joint.*=30 N"),
            ("intervals", intervals),
        ];
        found(SLIDER_CRANK, &[], &options).time()
    };
    let [coarse, usual, fine] = ["50", "400", "1600"].map(time);
    assert!(coarse > usual && usual > fine, "{coarse} {usual} {fine}");
    // The acceleration of an interval is kept by all of it, so that the loss goes with its length.
    let order = (coarse - usual) / (usual - fine);
    assert!((8.0..11.0).contains(&order), "{order}");
    assert!(usual / fine - 1.0 < 5e-3, "{usual} {fine}");
}

/// Models, sets, options, and all that is said.
type Refusal = (
    &'static str,
    &'static [&'static str],
    &'static [(&'static str, &'static str)],
    &'static str,
);

const UNBALANCED: &[&str] = &["gravity=[0,-10]", "bodies.wheel.com=[0.1,0]"];

const REFUSED: &[Refusal] = &[
    (
        WHEEL,
        &[],
        &[("from", "0"), ("to", "90")],
        "nothing is limited: say --limit \"driver.motor.effort=5 N*m\", --speed or --acceleration",
    ),
    (
        WHEEL,
        &[],
        &[("driver", "moter"), ("acceleration", "1")],
        "--driver \"moter\": no driver \"moter\" (did you mean \"motor\"?)",
    ),
    (
        WHEEL,
        &["drivers={}"],
        &[("acceleration", "1")],
        "the model has no driver, whose stroke the motion would go along; add one under \"drivers\"",
    ),
    (
        WHEEL,
        &[],
        &[("from", "0"), ("to", "0 rad"), ("acceleration", "1")],
        "the stroke has no length: its ends are the same; say --from and --to, as in --from \"0 deg\" --to \"90 deg\"",
    ),
    (
        WHEEL,
        &["analysis=null"],
        &[("acceleration", "1")],
        "where does the stroke end? The model's analysis has no \"end\": say --to, as in --to \"90 deg\"",
    ),
    (
        WHEEL,
        &[],
        &[("from", "5 mm"), ("acceleration", "1")],
        "--from \"5 mm\": \"mm\" is not a unit of angle (such as \"rad\")",
    ),
    (
        WHEEL,
        &[],
        &[("speed", "-5 rad/s")],
        "--speed \"-5 rad/s\": must be greater than 0",
    ),
    (
        WHEEL,
        &[],
        &[("acceleration", "5 rad/s")],
        "--acceleration \"5 rad/s\": \"rad/s\" is not a unit of angular acceleration (such as \"rad/s^2\")",
    ),
    (
        WHEEL,
        &[],
        &[("acceleration", "5"), ("start-speed", "-2")],
        "--start-speed \"-2\": a speed along the stroke is not negative",
    ),
    (
        WHEEL,
        &[],
        &[("acceleration", "5"), ("speed", "5"), ("end-speed", "7")],
        "the speed at an end of the stroke is more than --speed",
    ),
    (
        WHEEL,
        &[],
        &[("acceleration", "5"), ("intervals", "1")],
        "--intervals 1: 2 to 20000 are possible",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "driver.motor.effort 5 N*m")],
        "--limit \"driver.motor.effort 5 N*m\": write it as in \"driver.motor.effort=5 N*m\", or with both ends, as in \"driver.motor.effort=-2 N*m:5 N*m\"",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "driver.moter.effort=5 N*m")],
        "--limit \"driver.moter.effort=5 N*m\": the results have no column \"driver.moter.effort\" (did you mean \"driver.motor.effort\"?)",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "driver.motor.effort=5 N")],
        "--limit \"driver.motor.effort=5 N\": this is a force [N], where a torque [N*m] is wanted",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "driver.motor.effort=-5 N*m")],
        "--limit \"driver.motor.effort=-5 N*m\": a limit to both sides is positive; one with two ends is LOWER:UPPER",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "driver.motor.effort=1:2:3")],
        "--limit \"driver.motor.effort=1:2:3\": a limit is one value, or a lower and an upper one, as in \"-2 N*m:5 N*m\"",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "driver.motor.effort=5 N*m:2 N*m")],
        "--limit \"driver.motor.effort=5 N*m:2 N*m\": the limits are the wrong way round (the lower limit comes first, as in [79, 81])",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "joint.o=-2 N:5 N")],
        "--limit \"joint.o=-2 N:5 N\": the size of a force has one limit, and no lower one",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "wheel.*=5")],
        "--limit \"wheel.*=5\": wheel.x and wheel.angle have different units; limit each of them",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "wheel.angle=90")],
        "at rest at 114.592° wheel.angle is 2 rad, beyond its limit of 1.571 rad: the motion can't have an end there",
    ),
    (
        WHEEL,
        &[],
        &[("limit", "joint.o=5 N")],
        "the limits do not bound the speed, so there is no fastest motion; add --speed, or a limit on an effort of what has mass",
    ),
    (
        WHEEL,
        UNBALANCED,
        &[("to", "60 deg"), ("limit", "driver.motor.effort=1 N*m")],
        "at rest at 0° driver.motor.effort is 2 N·m, beyond its limit of 1 N·m: the motion can't have an end there",
    ),
    (
        WHEEL,
        UNBALANCED,
        &[
            ("from", "-90 deg"),
            ("to", "90 deg"),
            ("limit", "driver.motor.effort=1 N*m"),
        ],
        "no motion along the stroke keeps all limits: they would have to be wider by 45.4 %; what hinders most is driver.motor.effort",
    ),
    (
        WHEEL,
        &[
            "gravity=[0,-10]",
            "joints.o.pin_radius=0.02",
            r#"joints.o.friction={"law":"coulomb","coefficient":0.2,"threshold_velocity":0.001}"#,
        ],
        &[("limit", "driver.motor.effort=1 N*m")],
        NOT_STRAIGHT,
    ),
    (
        WHEEL,
        &[r#"forces.d={"type":"torsion_spring","between":["ground","wheel"],"damping":0.1}"#],
        &[("limit", "driver.motor.effort=1 N*m")],
        NOT_STRAIGHT,
    ),
    (
        WHEEL,
        &[
            r#"forces.d={"type":"torque","body":"wheel","value":{"type":"harmonic","amplitude":1,"frequency":2}}"#,
        ],
        &[("limit", "driver.motor.effort=1 N*m")],
        "driver.motor.effort changes with time at the same place: forces that depend on time can't be limited along a stroke",
    ),
    (
        SLIDER_CRANK,
        &[
            r#"drivers={"push":{"type":"translation","joint":"guide","motion":{"type":"constant_velocity","start":0.246,"velocity":0.1}}}"#,
        ],
        &[("from", "0.246"), ("to", "0.3"), ("speed", "1")],
        "dead centre: driver \"push\" can't go on beyond 0.25 m, where \"crank\" and \"rod\" are in line. End the stroke before it, or drive another body",
    ),
    (
        FOUR_BAR,
        &[
            "bodies.coupler.points.B=[0.32,0]",
            "bodies.rocker.points.B=[0.1,0]",
            "bodies.coupler.pose.angle=0",
            "bodies.rocker.pose.angle=0.52",
        ],
        &[("to", "200 deg"), ("speed", "1")],
        "change point at 3.14159 rad (180°), where \"crank\", \"coupler\" and \"rocker\" are in line: there joint forces have no bound or no value. End the stroke before it",
    ),
    (
        SLIDER_CRANK,
        &[r#"joints.small.clearance={"model":"massless_link","radius":1e-4}"#],
        &[("to", "60 deg"), ("speed", "1")],
        "line 7, column 13: joints: joints with clearance leave more free than the drivers prescribe (remove their \"clearance\")",
    ),
    (
        SLIDER_CRANK,
        &[
            r#"drivers.push={"type":"translation","joint":"guide","motion":{"type":"constant_velocity","start":0.246,"velocity":0.1}}"#,
        ],
        &[("driver", "motor"), ("to", "60 deg"), ("speed", "1")],
        "driver \"push\" moves, too, by its own motion over time, which is not known before the answer; let it stand still, as in --set \"drivers.push.motion={\\\"type\\\":\\\"constant_velocity\\\",\\\"velocity\\\":0}\"",
    ),
];

const NOT_STRAIGHT: &str = "driver.motor.effort does not follow acceleration and square of the speed in straight lines, as with friction, damping, or a formula with \
                            velocities: its fastest motion is no convex problem. Remove what depends on velocities, or the limit";

#[test]
fn what_can_not_be_asked_is_said_to_the_letter() {
    let mut wrong = String::new();
    for (model, sets, options, expected) in REFUSED {
        let said = match ask(model, sets, options) {
            Ok(found) => format!("found {} s", found.time()),
            Err(why) => why.to_string(),
        };
        if said != *expected {
            wrong += &format!("\n{sets:?} {options:?}\n{said}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
