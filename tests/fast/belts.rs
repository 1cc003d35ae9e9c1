//! Belts against closed forms, and their forces against tensions along strands that are drawn by hand.

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, modes};
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// Round-off of some ten equations in numbers around 1.
const ROUND_OFF: f64 = 1e-13;
/// Of tensions, as a part of them.
const FORCE: f64 = 1e-12;

fn pulley(position: [f64; 2], angle: f64, inertia: f64) -> Value {
    json!({ "mass": 1.5, "inertia": inertia, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
            "pose": { "position": position, "angle": angle } })
}

fn belt(first: &str, second: &str, radii: [f64; 2], strands: &str) -> Value {
    json!({ "type": "belt", "between": [first, second], "radii": radii, "strands": strands })
}

const RADII: [f64; 2] = [0.05, 0.12];
const AT: [f64; 2] = [0.3, 0.4];

/// Two pulleys on the ground.
fn pair(strands: &str) -> Value {
    let bodies = json!({ "ground": { "points": { "A": [0.0, 0.0], "B": AT } },
        "one": pulley([0.0, 0.0], 0.2, 0.01), "two": pulley(AT, -0.5, 0.04) });
    let joints = json!({ "a": pin("ground.A", "one.C"), "b": pin("ground.B", "two.C"),
        "belt": belt("one.C", "two.C", RADII, strands) });
    let mut pair = model(bodies, joints, json!({}));
    pair["gravity"] = json!([0.0, 0.0]);
    pair
}

/// Directions of the strands from the first pulley to the second, left and right: a line touches both circles where it is square
/// to a unit vector m with m·d = r₁ ∓ r₂, and runs from r₁ m to d ± r₂ m.
fn strands(crossed: bool) -> [[f64; 2]; 2] {
    let [x, y] = AT;
    let length = x.hypot(y);
    let other = if crossed { -RADII[1] } else { RADII[1] };
    let along = (RADII[0] - other) / length;
    let across = (1.0 - along * along).sqrt();
    [1.0, -1.0].map(|side| {
        let m = [
            (along * x - side * across * y) / length,
            (along * y + side * across * x) / length,
        ];
        let run = [0, 1].map(|k| AT[k] + other * m[k] - RADII[0] * m[k]);
        let far = run[0].hypot(run[1]);
        run.map(|part| part / far)
    })
}

/// The load is felt at the first pulley by the radii, and each bearing carries both tensions along their strands.
#[test]
fn bearings_carry_the_tensions_of_both_strands_along_them() {
    let (alpha, load, pretension) = (3.0, 4.0, 80.0);
    for (word, sigma) in [("open", 1.0), ("crossed", -1.0)] {
        let mut driven = pair(word);
        driven["joints"]["belt"]["pretension"] = json!(pretension);
        driven["drivers"] = json!({ "motor": { "type": "rotation", "body": "one",
            "motion": { "type": "polynomial", "coefficients": [0.2, 1.0, 0.5 * alpha] } } });
        driven["forces"] = json!({ "load": { "type": "torque", "body": "two", "value": -load } });
        let run = outcome(&driven);
        assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
        assert!(run.report.warnings.is_empty(), "{:?}", run.report.warnings);
        let mobility = &run.report.mobility;
        assert_eq!((mobility.grubler, mobility.rank), (1, 1));
        let ratio = sigma * RADII[0] / RADII[1];
        let torque = 0.04 * ratio * alpha + load;
        // σ r₂ (T_l − T_r) turns the second pulley.
        let apart = sigma * torque / RADII[1];
        let tensions = [pretension + 0.5 * apart, pretension - 0.5 * apart];
        let [left, right] = strands(sigma < 0.0);
        let pull = [0, 1].map(|k| tensions[0] * left[k] + tensions[1] * right[k]);
        let of = |name: &str| column(&run, name);
        for (k, theta) in of("one.angle").into_iter().enumerate() {
            close(of("two.angle")[k], -0.5 + ratio * (theta - 0.2), 1e-12);
            let known = [
                ("joint.a.fx", -pull[0]),
                ("joint.a.fy", -pull[1]),
                ("joint.b.fx", pull[0]),
                ("joint.b.fy", pull[1]),
                ("joint.belt.fx", -pull[0]),
                ("joint.belt.fy", -pull[1]),
                ("joint.belt.torque", torque),
                ("joint.belt.tight", tensions[0].max(tensions[1])),
                ("joint.belt.slack", tensions[0].min(tensions[1])),
                ("driver.motor.effort", 0.01 * alpha + ratio * torque),
            ];
            for (name, known) in known {
                close(of(name)[k], known, FORCE * 2.0 * pretension);
            }
        }
    }
}

/// A strand that would have to push is told, with the time from when.
#[test]
fn a_slack_strand_is_told() {
    let mut driven = pair("open");
    driven["joints"]["belt"]["pretension"] = json!(5.0);
    driven["drivers"] = json!({ "motor": { "type": "rotation", "body": "one",
        "motion": { "type": "polynomial", "coefficients": [0.2, 1.0] } } });
    driven["forces"] =
        json!({ "load": { "type": "torque", "body": "two", "value": "=-2.4 N*m/s*time" } });
    // λ = 20 N/s·t: half of it is 5 N at 0.5 s.
    let said = outcome(&driven).report.warnings;
    assert_eq!(
        said,
        [
            "joint \"belt\": from t = 0.51 s on a strand would have to push, with up to 5 N: it hangs slack there, and the results do \
             not hold; raise \"pretension\""
        ]
    );
    // Without a pretension none is known.
    driven["joints"]["belt"]
        .as_object_mut()
        .expect("a map")
        .remove("pretension");
    assert!(outcome(&driven).report.warnings.is_empty());
}

/// A pulley on an arm, belted to one that stands: with equal radii it keeps its direction, with crossed strands it turns twice;
/// over many turns of the arm.
#[test]
fn a_pulley_on_an_arm_keeps_its_direction() {
    for (word, turns) in [("open", 0.0), ("crossed", 2.0)] {
        let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
            "arm": { "mass": 0.5, "inertia": 0.01, "com": [0.1, 0.0], "points": { "O": [0.0, 0.0], "C": [0.4, 0.0] },
                     "pose": { "angle": 1.0 } },
            "planet": pulley([0.2, 0.3], 0.3, 0.02) });
        let joints = json!({ "arm": pin("ground.O", "arm.O"), "planet": pin("arm.C", "planet.C"),
            "belt": belt("ground.O", "planet.C", [0.06, 0.06], word) });
        let motor = json!({ "type": "rotation", "body": "arm", "motion": { "type": "polynomial", "coefficients": [1.0, 40.0] } });
        let run = outcome(&model(bodies, joints, json!({ "motor": motor })));
        assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
        let (arm, planet) = (column(&run, "arm.angle"), column(&run, "planet.angle"));
        for (arm, planet) in arm.into_iter().zip(planet) {
            close(planet, 0.3 + turns * (arm - 1.0), 1e-11);
        }
    }
}

/// ω² = 2 k (r₁²/I₁ + r₂²/I₂), with k of each strand, open and crossed; at the time it takes, nothing is lost.
#[test]
fn an_elastic_belt_swings_as_two_springs() {
    let stiffness = 3000.0;
    let square: f64 = 2.0 * stiffness * (RADII[0].powi(2) / 0.01 + RADII[1].powi(2) / 0.04);
    for word in ["open", "crossed"] {
        let mut elastic = pair(word);
        elastic["joints"]["belt"]["stiffness"] = json!(stiffness);
        elastic["joints"]["belt"]["pretension"] = json!(100.0);
        let mut at_rest = elastic.clone();
        at_rest["analysis"] = json!({ "type": "statics" });
        let found = modes(&loaded(&at_rest).model, true, &Control::default()).expect("modes");
        let frequencies: Vec<f64> = found.modes.iter().map(|mode| mode.frequency()).collect();
        let fastest = frequencies.iter().copied().fold(0.0, f64::max);
        close(fastest, square.sqrt(), 1e-9 * fastest);
        // s = r₁ θ₁ − σ r₂ θ₂ is a cosine of that frequency.
        elastic["initial"] = json!({ "one": { "angle": 0.25, "angular_velocity": 0.0 } });
        elastic["analysis"] = json!({ "type": "dynamics", "end": TAU / square.sqrt(), "outputs": 41,
            "solver": { "rtol": 1e-12, "atol": 1e-14 } });
        let run = outcome(&elastic);
        assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
        let of = |name: &str| column(&run, name);
        let sigma = if word == "open" { 1.0 } else { -1.0 };
        let stretch = |k: usize| {
            RADII[0] * (of("one.angle")[k] - 0.2) - sigma * RADII[1] * (of("two.angle")[k] + 0.5)
        };
        let (kinetic, potential) = (of("energy.kinetic"), of("energy.potential"));
        for (k, t) in of("time").into_iter().enumerate() {
            let known = stretch(0) * (square.sqrt() * t).cos();
            close(stretch(k), known, 1e-9 * stretch(0).abs());
            close(
                kinetic[k] + potential[k],
                kinetic[0] + potential[0],
                1e-10 * potential[0].abs(),
            );
            let apart = 2.0 * stiffness * known;
            close(of("joint.belt.tight")[k], 100.0 + 0.5 * apart.abs(), 1e-6);
        }
    }
}

/// The second pulley on a slide with a spring: where it rests the spring carries 2 T cos β.
fn tensioned(word: &str, belt_words: &[(&str, f64)]) -> Value {
    let bodies = json!({ "ground": { "points": { "A": [0.0, 0.0], "S": [0.9, 0.0] } },
        "one": pulley([0.0, 0.0], 0.2, 0.01), "two": pulley([0.5, 0.0], -0.5, 0.04), "block": pulley([0.5, 0.0], 0.0, 0.01) });
    let joints = json!({ "a": pin("ground.A", "one.C"), "b": pin("block.C", "two.C"),
        "way": { "type": "prismatic", "between": ["ground.A", "block.C"], "axis": [1.0, 0.0] },
        "belt": belt("one.C", "two.C", RADII, word) });
    let mut model = model(bodies, joints, json!({}));
    model["joints"]["belt"]["carrier"] = json!("ground");
    for (key, value) in belt_words {
        model["joints"]["belt"][*key] = json!(value);
    }
    model["gravity"] = json!([0.0, 0.0]);
    model["forces"] = json!({ "tensioner": { "type": "spring", "between": ["block.C", "ground.S"], "stiffness": 800.0, "free_length": 0.1 } });
    model
}

#[test]
fn a_tensioner_carries_both_strands() {
    let pretension = 90.0;
    for (word, lean) in [("open", -0.07), ("crossed", 0.17)] {
        let mut rests = tensioned(word, &[("pretension", pretension)]);
        rests["analysis"] = json!({ "type": "statics" });
        let run = outcome(&rests);
        assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
        let x: f64 = column(&run, "block.x")[0];
        let sin = lean / x;
        let pull = 2.0 * pretension * (1.0_f64 - sin * sin).sqrt();
        close(800.0 * (0.9 - x - 0.1), pull, 1e-9 * pull);
        close(
            column(&run, "joint.belt.tight")[0],
            pretension,
            1e-9 * pretension,
        );
    }
}

/// Whatever the belt does while the distance changes, its energy is counted; damping takes some.
#[test]
fn a_belt_whose_length_changes_keeps_the_energy() {
    for words in [
        &[("pretension", 90.0)][..],
        &[("pretension", 90.0), ("stiffness", 2000.0)],
        &[
            ("pretension", 90.0),
            ("stiffness", 2000.0),
            ("damping", 5.0),
        ],
    ] {
        let mut moves = tensioned("open", words);
        moves["initial"] = json!({ "block": { "vx": 0.3 }, "one": { "angular_velocity": 4.0 } });
        moves["analysis"] = json!({ "type": "dynamics", "end": 0.3, "outputs": 31,
            "solver": { "rtol": 1e-12, "atol": 1e-14 } });
        let run = outcome(&moves);
        assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
        let of = |name: &str| column(&run, name);
        let (kinetic, potential) = (of("energy.kinetic"), of("energy.potential"));
        let sum = |k: usize| kinetic[k] + potential[k];
        let (first, last) = (sum(0), sum(30));
        if words.len() < 3 {
            close(last, first, 1e-10 * kinetic[0]);
        } else {
            assert!(last < first - 1e-3, "{last} {first}");
        }
        let imbalance = run.report.quality.power_imbalance.expect("known");
        assert!(imbalance < 1e-9, "{imbalance}");
        // Pulleys that roll: of a belt that does not stretch.
        if words.len() == 1 {
            for k in 0..31 {
                close(
                    RADII[0] * of("one.omega")[k],
                    RADII[1] * of("two.omega")[k],
                    ROUND_OFF * 10.0,
                );
            }
        }
    }
}

#[test]
fn pulleys_that_overlap_are_refused() {
    let said = |word: &str, radii: [f64; 2]| {
        let mut wrong = pair(word);
        wrong["joints"]["belt"]["radii"] = json!(radii);
        wrong["analysis"] = json!({ "type": "assembly" });
        let said = linkdyn_engine::analysis::run(&loaded(&wrong).model, &Control::default());
        said.expect_err("refused").to_string()
    };
    assert_eq!(
        said("crossed", [0.2, 0.3]),
        "joints.belt.radii: the pulleys' centres are 0.5 m apart, and crossed strands between these radii need more than 0.5 m (look \
         at the radii, and at the places of the pulleys)"
    );
    assert_eq!(
        said("open", [0.1, 0.7]),
        "joints.belt.radii: the pulleys' centres are 0.5 m apart, and open strands between these radii need more than 0.6 m (look at \
         the radii, and at the places of the pulleys)"
    );
}

/// In a carrier that the file names the line of centres may turn by less than half a turn: it is said where it goes on, and the motion
/// ends there.
#[test]
fn a_line_of_centres_that_comes_round_is_told() {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "arm": { "mass": 0.5, "inertia": 0.01, "com": [0.1, 0.0], "points": { "O": [0.0, 0.0], "C": [0.4, 0.0] },
                 "pose": { "angle": 1.0 } },
        "planet": pulley([0.2, 0.3], 0.3, 0.02) });
    let mut joints = json!({ "arm": pin("ground.O", "arm.O"), "planet": pin("arm.C", "planet.C"),
        "belt": belt("ground.O", "planet.C", [0.06, 0.03], "open") });
    joints["belt"]["carrier"] = json!("ground");
    let motor = json!({ "type": "rotation", "body": "arm", "motion": { "type": "polynomial", "coefficients": [1.0, 4.0] } });
    let mut turns = model(bodies, joints, json!({ "motor": motor }));
    let report = outcome(&turns).report;
    assert_ne!(report.status, Status::Completed);
    assert_eq!(
        report.warnings,
        [
            "joint \"belt\": at t = 0.71 s the line of centres has turned by nearly half a turn in the body that \"carrier\" names, \
             beyond which a belt is not followed; name a body that turns with the line"
        ]
    );
    turns["joints"]["belt"]["carrier"] = json!("arm");
    let report = outcome(&turns).report;
    assert_eq!(
        (report.status, report.warnings.len()),
        (Status::Completed, 0)
    );
}
