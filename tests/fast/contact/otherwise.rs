//! The ideal joint as the clearance vanishes, and the same mechanism told otherwise.

use super::*;

/// Places differ from those of ideal joints by what the journal can move, so the order in c is one. A massless link turns about
/// where the force turns round, but stays within c.
#[test]
fn a_vanishing_clearance_is_an_ideal_joint() {
    const CLEARANCES: [f64; 4] = [1e-3, 3e-4, 1e-4, 3e-5];
    let common = [
        "drivers.motor.motion.velocity=500 rpm",
        "analysis.end=0.03",
        "analysis.outputs=301",
    ];
    let surface = r#"joints.b.clearance.surface={ "stiffness": 1e10, "damping": 1e5 }"#;
    let of = |more: &[String]| {
        let sets: Vec<&str> = common
            .into_iter()
            .chain([surface])
            .chain(more.iter().map(String::as_str))
            .collect();
        column(&solve(&slider_crank(&sets)), "slider.x")
    };
    let ideal = of(&["joints.b.clearance.model=ideal".into()]);
    for (model, analysis) in [
        ("contact", "dynamics"),
        ("two_state", "dynamics"),
        ("three_state", "dynamics"),
        ("massless_link", "dynamics"),
        ("massless_link", "inverse_dynamics"),
        ("massless_link", "kinematics"),
    ] {
        let errors: Vec<f64> = CLEARANCES
            .iter()
            .map(|clearance| {
                let real = of(&[
                    format!("analysis.type={analysis}"),
                    format!("joints.b.clearance.model={model}"),
                    format!("joints.b.clearance.radius={clearance}"),
                    "joints.b.clearance.normal.stiffness=1e11".into(),
                ]);
                real.iter()
                    .zip(&ideal)
                    .map(|(a, b)| (a - b).abs())
                    .fold(0.0, f64::max)
            })
            .collect();
        let (first, last) = (errors[0], errors[errors.len() - 1]);
        let order = (first / last).ln() / (CLEARANCES[0] / CLEARANCES[3]).ln();
        println!("{model} in {analysis}: {errors:?} for {CLEARANCES:?}, order {order:.3}");
        assert!(
            (0.9..1.1).contains(&order),
            "{model} in {analysis}: order {order} of {errors:?}"
        );
        for (error, clearance) in errors.iter().zip(CLEARANCES) {
            // cos of the rod's angle at most: 1/√(1 − (r/L)²) = 1.10, and the penetration.
            let part = error / clearance;
            assert!(
                (0.5..1.3).contains(&part),
                "{model} in {analysis}: {error:e} at {clearance:e}"
            );
        }
    }
}

/// Three impacts at 5000 rpm, which multiply differences by some ten.
#[test]
fn the_same_mechanism_told_otherwise_moves_the_same() {
    let short = [
        "analysis.end=0.0009",
        "analysis.outputs=181",
        "analysis.solver.rtol=1e-10",
    ];
    let names = ["penetration", "energy.contact"];
    told_otherwise(&short, "joints.b.clearance.friction.law=none", &names, 3);
}

/// Impacts, a journal that follows its bearing from 0.65 ms on, leaves it, and more impacts.
#[test]
fn the_same_rigid_journal_told_otherwise_moves_the_same() {
    let short = [
        "joints.b.clearance.model=three_state",
        r#"joints.b.clearance.impact={ "restitution": 0.5, "friction": 0.03 }"#,
        "analysis.end=0.003",
        "analysis.outputs=301",
        "analysis.solver.rtol=1e-10",
    ];
    let model = solve(&slider_crank(&short));
    let state = column(&model, "joint.b.state");
    assert!(
        state.contains(&0.0) && state.iter().any(|state| *state > 0.0),
        "{state:?}"
    );
    told_otherwise(
        &short,
        "joints.b.clearance.impact.friction=0",
        &["state"],
        10,
    );
}

/// A column in a world that is turned by `angle`.
fn rotated_column(outcome: &Outcome, name: &str, angle: f64) -> Vec<f64> {
    let (stem, quantity) = name.rsplit_once('.').expect("an owner");
    match quantity {
        "ex" | "ey" | "fx" | "fy" => {
            let kind = &quantity[..1];
            let [x, y] = ["x", "y"].map(|axis| column(outcome, &format!("{stem}.{kind}{axis}")));
            let component = usize::from(quantity.ends_with('y'));
            let pairs = x.iter().zip(&y);
            pairs
                .map(|(x, y)| turned([*x, *y], angle)[component])
                .collect()
        }
        "angle" => column(outcome, name)
            .iter()
            .map(|value| value + angle)
            .collect(),
        _ => column(outcome, name),
    }
}

/// What a mirror changes the sign of: x, angles, torques, and the sense of sliding.
fn mirrored(name: &str) -> (String, f64) {
    let quantity = name.rsplit('.').next().unwrap_or(name);
    let turns = [
        "ex",
        "fx",
        "angle",
        "effort",
        "sliding_speed",
        "tangential_force",
    ]
    .contains(&quantity);
    (name.to_string(), if turns { -1.0 } else { 1.0 })
}

/// The name of a column of the renamed model.
fn again(name: &str) -> (String, f64) {
    let words: Vec<&str> = name.split('.').collect();
    let renamed = match words.as_slice() {
        [kind @ ("joint" | "driver"), owner, quantity] => {
            format!("{kind}.{}.{quantity}", renamed(owner))
        }
        [owner, quantity] if *owner != "energy" => format!("{}.{quantity}", renamed(owner)),
        _ => name.to_string(),
    };
    (renamed, 1.0)
}

/// Turned, mirrored, renamed, bearing and journal exchanged (this without friction, whose arms differ).
#[track_caller]
fn told_otherwise(short: &[&str], without_friction: &str, more: &[&str], least: usize) {
    let model = slider_crank(short);
    let frictionless = slider_crank(&[short, &[without_friction]].concat());
    let angle = 0.7;
    let same = |name: &str| (name.to_string(), 1.0);
    let swapped = |name: &str| {
        let turns = ["ex", "ey", "fx", "fy"]
            .map(|q| format!("joint.b.{q}"))
            .contains(&name.to_string());
        (name.to_string(), if turns { -1.0 } else { 1.0 })
    };
    let common = [
        "joint.b.ex",
        "joint.b.ey",
        "joint.b.fx",
        "joint.b.fy",
        "joint.b.normal_force",
    ]
    .map(String::from);
    let bodies = ["rod.angle", "driver.motor.effort", "energy.dissipated"].map(String::from);
    let own = more.iter().map(|name| {
        if name.contains('.') {
            (*name).into()
        } else {
            format!("joint.b.{name}")
        }
    });
    let names: Vec<String> = common.into_iter().chain(bodies).chain(own).collect();
    type Rename<'a> = &'a dyn Fn(&str) -> (String, f64);
    let cases: [(&str, &Model, Model, Rename); 4] = [
        ("rotated", &model, rotate(&model, angle), &same),
        ("mirrored", &model, mirror(&model), &mirrored),
        (
            "renamed and reversed",
            &model,
            rename_and_reverse(&model),
            &again,
        ),
        (
            "bearing and journal exchanged",
            &frictionless,
            swap(&frictionless),
            &swapped,
        ),
    ];
    for (what, original, other, expected) in cases {
        let (one, two) = (solve(original), solve(&other));
        let impacts = episodes(&one).len();
        assert!(
            impacts >= least && episodes(&two).len() == impacts,
            "{what}: {impacts}"
        );
        for name in names.iter().map(String::as_str) {
            let (other_name, sign) = expected(name);
            let wanted = if what == "rotated" {
                rotated_column(&one, name, angle)
            } else {
                let values = column(&one, name);
                values.iter().map(|value| sign * value).collect()
            };
            let scale = wanted.iter().fold(0.0, |m: f64, value| m.max(value.abs()));
            let ours = column(&two, &other_name);
            let off = ours
                .iter()
                .zip(&wanted)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max)
                / scale;
            println!("{what}: {name} off by {off:.1e}");
            // 10 rtol per impact of local error, multiplied by what impacts multiply.
            assert!(off < 1e-6, "{what}: {name} off by {off:e}");
        }
    }
}

#[test]
fn switching_the_model_changes_no_column() {
    let columns = |model: &str| {
        let surface = r#"joints.b.clearance.surface={ "stiffness": 1e8, "damping": 2e3 }"#;
        let model = format!("joints.b.clearance.model={model}");
        let outcome = solve(&slider_crank(&[
            "analysis.end=0.001",
            "analysis.outputs=11",
            surface,
            &model,
        ]));
        outcome.trajectory.columns
    };
    let ideal = columns("ideal");
    assert!(
        ideal
            .iter()
            .any(|column| column.name == "joint.b.penetration")
    );
    for model in ["massless_link", "two_state", "contact"] {
        assert_eq!(columns(model), ideal, "{model}");
    }
}

#[track_caller]
/// A mass on a guide between stiff stops: steps that land far beyond a stop are taken again shorter. Each rebound has half the
/// speed; the way between the stops is 2c less the depths.
#[test]
fn a_mass_on_a_guide_comes_off_a_stiff_stop() {
    for stiffness in [1e6, 1e9, 1e11] {
        let normal = json!({ "law": "gonthier", "restitution": 0.5, "stiffness": stiffness });
        let outcome = completed(&json!({ "format": "linkdyn/1", "units": "SI",
            "bodies": { "ground": { "points": { "O": [0.0, 0.0] } },
                "block": { "mass": 1.3, "inertia": 0.0, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] } } },
            "joints": { "guide": { "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [1, 0] },
                "stop": { "type": "revolute", "between": ["ground.O", "block.P"],
                          "clearance": { "model": "contact", "radius": 0.002, "normal": normal } } },
            "initial": { "block": { "vx": 1.0 } },
            "analysis": { "type": "dynamics", "end": 0.1, "outputs": 6 } }));
        let found = episodes(&outcome);
        assert!(found.len() >= 3, "{stiffness:e}: {found:?}");
        let mut speed = 1.0;
        for episode in &found {
            assert!(
                (episode.approach_speed / speed - 1.0).abs() < 1e-6,
                "{stiffness:e}: {episode:?}"
            );
            speed *= 0.5;
            if let Some(separation) = episode.separation_speed {
                assert!(
                    (separation / speed - 1.0).abs() < 1e-6,
                    "{stiffness:e}: {episode:?}"
                );
            }
        }
    }
}
