//! A tip touches an outline as one body, of however many pieces it is.

use super::*;
use linkdyn_engine::analysis::Outcome;

/// A tip of 5 mm that 100 N press onto an outline which a driver pulls under it.
/// No corner of the outlines is passed at an output, where the force before it and behind it are as right.
fn pulled(outline: Value, more: Value) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "slide": { "mass": 1.0, "inertia": 1e-6, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0] } },
        "plunger": { "mass": 0.01, "inertia": 1e-6, "com": [0.0, 0.0], "points": { "T": [0.0, 0.0] }, "pose": { "position": [0.0, 0.005] } } });
    let slide = |second: &str, axis: [f64; 2]| json!({ "type": "prismatic", "between": ["ground.O", second], "axis": axis });
    let mut notch = json!({ "type": "contact", "between": ["slide.O", "plunger.T"], "radius": 0.005, "outline": outline });
    join(&mut notch, more);
    let joints = json!({ "rail": slide("slide.O", [1.0, 0.0]), "bore": slide("plunger.T", [0.0, 1.0]), "notch": notch });
    let drivers = json!({ "pull": { "type": "translation", "joint": "rail",
        "motion": { "type": "constant_velocity", "start": -0.01005, "velocity": 0.03 } } });
    let mut model = model(bodies, joints, drivers);
    model["forces"] =
        json!({ "preload": { "type": "force", "at": "plunger.T", "vector": [0.0, -100.0] } });
    model["initial"] = json!({ "plunger": { "y": 0.00499, "vy": 0.0 } });
    model["gravity"] = json!([0.0, 0.0]);
    model["analysis"] = json!({ "type": "dynamics", "end": 0.6, "outputs": 601 });
    model
}

fn yields() -> Value {
    json!({ "stiffness": 1e7, "damping": 300.0 })
}

/// Greatest and least of a column, its peaks among them.
fn range(run: &Outcome, name: &str) -> [f64; 2] {
    let values = run.curves().values(name).expect("a column");
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [least, most]
}

fn contacts(run: &Outcome) -> u64 {
    run.report.stops.iter().map(|sums| sums.episodes).sum()
}

/// The joint of two straights in line is none: the force stays what it is.
#[test]
fn a_joint_of_two_straights_presses_once() {
    let joint = json!([[0.06, 0.0], [0.0, 0.0], [-0.06, 0.0]]);
    let mut model = pulled(joint, yields());
    model["analysis"]["solver"] = json!({ "rtol": 1e-10, "atol": 1e-13 });
    let run = completed(&model);
    for force in range(&run, "joint.notch.normal_force") {
        near(force, 100.0, 1e-7);
    }
    assert_eq!(contacts(&run), 1);
    near(run.report.stops[0].impulse, 60.0, 1e-7);
    near(run.report.stops[0].time_in_contact, 0.6, 1e-12);
}

/// Over a corner of 45 degrees: the tip goes round it, and comes down the slope with 100 N/cos 45°.
#[test]
fn a_corner_presses_once() {
    let run = completed(&pulled(
        json!([[0.06, 0.0], [0.0, 0.0], [-0.06, -0.06]]),
        yields(),
    ));
    let [least, most] = range(&run, "joint.notch.normal_force");
    // 0.04 N are the damping where the force has grown and does not any more.
    near(most, 100.0 * 2.0_f64.sqrt(), 5e-2);
    assert!(least > 90.0, "{least}");
    assert_eq!(contacts(&run), 1);
}

/// Points from one to another with thirty straights between.
fn thirty([from, to]: [[f64; 2]; 2]) -> Vec<Vec<f64>> {
    let part = |k: u32| f64::from(k) / 30.0;
    let between = |k: u32| {
        (0..2)
            .map(|i| from[i] + (to[i] - from[i]) * part(k))
            .collect()
    };
    (0..=30).map(between).collect()
}

/// A circle of so many arcs, of radius r > 0 of what it bounds, or r < 0 of what is around it.
fn circle(radius: f64, pieces: u32) -> Vec<Vec<f64>> {
    let place = |k: u32| {
        let angle = 2.0 * PI * f64::from(k % pieces) / f64::from(pieces) + 0.1;
        let (sin, cos) = angle.sin_cos();
        let mut node = vec![radius.abs() * cos, radius * sin];
        if k > 0 {
            node.push(radius);
        }
        node
    };
    (0..=pieces).map(place).collect()
}

/// Runs of the same outline in few pieces and in many are the same.
fn agree(few: &Outcome, many: &Outcome, columns: &[&str], part: f64) {
    for name in columns {
        let pairs = column(few, name).into_iter().zip(column(many, name));
        let most = column(few, name)
            .iter()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        for (one, other) in pairs {
            near(other, one, part * most.max(1e-3));
        }
    }
    let sums = [few, many].map(|run| run.report.stops[0].clone());
    assert_eq!(sums[0].episodes, sums[1].episodes);
    near(sums[1].impulse, sums[0].impulse, part * sums[0].impulse);
    near(sums[1].time_in_contact, sums[0].time_in_contact, part);
}

const TOUCH: [&str; 4] = [
    "disc.x",
    "disc.y",
    "joint.t.normal_force",
    "joint.t.tangential_force",
];

/// A disc in a drum and on one, rigid and yielding, with friction: of two arcs and of thirty.
#[test]
fn a_drum_of_thirty_arcs_is_one_of_two() {
    let friction =
        |law: &str| json!({ "law": law, "coefficient": 0.3, "threshold_velocity": 1e-2 });
    for made in [
        json!({ "friction": friction("coulomb"), "restitution": 0.0 }),
        json!({ "stiffness": 1e5, "damping": 50.0, "friction": friction("coulomb") }),
    ] {
        for (radius, start) in [(-1.0, [0.8, -0.4]), (1.0, [0.05, 1.1])] {
            let run = |pieces: u32| {
                // It begins on the drum.
                let shift = (1.0 + radius * RADIUS) / f64::hypot(start[0], start[1]);
                let start = start.map(|x| x * shift);
                completed(&disc(
                    start,
                    [0.0; 2],
                    json!(circle(radius, pieces)),
                    made.clone(),
                    0.5,
                ))
            };
            agree(&run(2), &run(30), &TOUCH, 1e-5);
        }
    }
}

/// A floor of thirty pieces under a disc that bounces, slides and rolls; many of them begin where it lands.
#[test]
fn a_floor_of_thirty_pieces_is_one() {
    let friction = json!({ "law": "coulomb", "coefficient": 0.3, "threshold_velocity": 1e-2 });
    for made in [
        json!({ "friction": friction, "restitution": 0.5, "sense": "energetic" }),
        json!({ "stiffness": 1e4, "damping": 20.0, "friction": friction }),
    ] {
        let run =
            |outline: Value| completed(&disc([0.0, 0.3], [2.0, 0.0], outline, made.clone(), 1.0));
        let few = run(json!([[3.0, 0.0], [-3.0, 0.0]]));
        let many = run(json!(thirty([[3.0, 0.0], [-3.0, 0.0]])));
        agree(&few, &many, &TOUCH, 1e-6);
    }
}

/// A tip that falls onto the joint of two pieces meets one of them.
#[test]
fn a_tip_that_falls_on_a_joint_meets_it() {
    for made in [json!({ "restitution": 0.5 }), json!({ "stiffness": 1e4 })] {
        let joint = json!([[3.0, 0.0], [0.0, 0.0], [-3.0, 0.0]]);
        let one = completed(&disc([0.0, 0.3], [0.0; 2], floor(), made.clone(), 0.5));
        let two = completed(&disc([0.0, 0.3], [0.0; 2], joint, made, 0.5));
        agree(&one, &two, &["disc.y"], 1e-9);
    }
}

/// A detent: the tip goes down into a notch and out again, and its flats may be in pieces.
#[test]
fn a_detent_of_many_pieces_is_one_of_few() {
    let rest = [
        [0.004, 0.0],
        [0.002, -0.002],
        [-0.002, -0.002],
        [-0.004, 0.0],
    ];
    let few: Vec<Vec<f64>> = [[0.06, 0.0]]
        .iter()
        .chain(&rest)
        .chain(&[[-0.06, 0.0]])
        .map(|p| p.to_vec())
        .collect();
    let mut many = thirty([[0.06, 0.0], rest[0]]);
    many.extend(rest[1..].iter().map(|p| p.to_vec()));
    many.extend(thirty([rest[3], [-0.06, 0.0]]).split_off(1));
    let [few, many] = [few, many].map(|outline| completed(&pulled(json!(outline), yields())));
    agree(
        &few,
        &many,
        &["plunger.y", "joint.notch.normal_force"],
        1e-5,
    );
}

/// A disc that rolls over a corner and falls has touched the table once.
#[test]
fn a_disc_that_rolls_over_a_corner_touches_once() {
    let table = json!([[0.0, -2.0], [0.0, 0.0], [-5.0, 0.0]]);
    for made in [json!({}), json!({ "stiffness": 1e6, "damping": 100.0 })] {
        let run = completed(&disc([-0.15, RADIUS], [0.3, 0.0], table.clone(), made, 1.0));
        assert_eq!(contacts(&run), 1);
    }
}
