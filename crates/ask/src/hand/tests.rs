use super::*;
use crate::Text;
use linkdyn_engine::analysis::hand::Hand;
use linkdyn_model::{FileAccess, bundled};

fn read(text: &str) -> ModelFile {
    let bytes = text.as_bytes().to_vec();
    let text = Text::new("m".into(), "m".into(), bytes, FileAccess::default());
    ModelFile::read(text, Vec::new()).expect("a legal model")
}

/// The model and its bodies where they are assembled.
fn assembled(text: &str) -> (ModelFile, Vec<[f64; 3]>) {
    let file = read(text);
    let mut hand = Hand::new(file.model()).expect("it can be held");
    let guess = hand.poses();
    let poses = hand.beside(&guess, 0.0).expect("it closes");
    (file, poses)
}

fn point(text: &str) -> PointRef {
    PointRef::try_from(text.to_owned()).expect("body.point")
}

/// Where a point of a model stands, its body at a pose.
fn place(file: &ModelFile, poses: &[[f64; 3]], at: &str) -> [f64; 2] {
    let (model, point) = (file.model(), point(at));
    let mut moving = model.bodies.keys().filter(|name| *name != GROUND);
    let pose = moving
        .position(|name| *name == point.body)
        .map(|k| poses[k]);
    carried(
        pose.unwrap_or_default(),
        model.bodies[&point.body].points[&point.point],
    )
}

fn far([a, b]: [f64; 2], [x, y]: [f64; 2]) -> f64 {
    (a - x).hypot(b - y)
}

/// What differs between two texts: lines.
fn lines<'t>(before: &'t str, after: &'t str) -> Vec<[&'t str; 2]> {
    let pairs = before.lines().zip(after.lines());
    pairs.filter(|(a, b)| a != b).map(|(a, b)| [a, b]).collect()
}

#[test]
fn the_lengths_behind_a_pin_follow_it() {
    let text = bundled::text("four-bar").expect("it is bundled");
    let (file, poses) = assembled(&text);
    let [a, b, d] = ["crank.A", "coupler.B", "ground.O4"].map(|at| place(&file, &poses, at));
    let target = [b[0] + 0.012, b[1] + 0.021];
    let ends = [point("coupler.B"), point("rocker.B")];
    let moved = moved(&file, &poses, &ends, target, 1e-5).expect("it moves");
    assert_eq!(moved.changed, ["parameters.coupler", "parameters.rocker"]);
    assert!(far(moved.place, target) < 1e-9, "{:?}", moved.place);
    // Its other pins stay: the bars are as long as from these to the target.
    let after = read(&moved.text);
    let length = |name: &str| {
        let mut all = after.loaded.parameters.iter();
        all.find(|own| own.name == name).expect("a parameter").value
    };
    assert!((length("coupler") - far(a, target)).abs() < 1e-5);
    assert!((length("rocker") - far(d, target)).abs() < 1e-5);
    assert_eq!(
        lines(&text, &moved.text).len(),
        1,
        "one line has all numbers"
    );
}

#[test]
fn what_a_driver_holds_keeps_its_direction() {
    let text = bundled::text("four-bar").expect("it is bundled");
    let (file, poses) = assembled(&text);
    let a = place(&file, &poses, "crank.A");
    let (sin, cos) = poses[0][2].sin_cos();
    let ends = [point("crank.A"), point("coupler.A")];
    let target = [
        a[0] + 0.02 * cos - 0.01 * sin,
        a[1] + 0.02 * sin + 0.01 * cos,
    ];
    let moved = moved(&file, &poses, &ends, target, 1e-5).expect("it moves");
    assert_eq!(moved.changed, ["parameters.crank", "parameters.coupler"]);
    let expected = [a[0] + 0.02 * cos, a[1] + 0.02 * sin];
    assert!(far(moved.place, expected) < 1e-4, "{:?}", moved.place);
}

#[test]
fn plain_numbers_are_written_in_their_own_units() {
    let text = r#"{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg" },
  "bodies": { "ground": { "points": {"O":[0,0]} },
    "a": { "points": { "O": [0, 0], "P" : [ 100,"2.00 in"] }, "pose": { "angle": 90 } },
    "b": { "points": { "P": { "position": [0.5, 0] , "tolerance": "1 mm" } }, "pose": { "position": [-51.3, 100] } } },
  "joints": { "o": { "type": "revolute", "between": ["ground.O", "a.O"] }, "p": { "type": "revolute", "between": ["a.P", "b.P"] } } }"#;
    let (file, poses) = assembled(text);
    let ends = [point("a.P"), point("b.P")];
    let moved = moved(&file, &poses, &ends, [-0.0254, 0.12], 1e-4).expect("it moves");
    // b goes with its only point.
    assert_eq!(
        moved.changed,
        ["bodies.a.points.P[0]", "bodies.a.points.P[1]"]
    );
    let expected = text.replace("[ 100,\"2.00 in\"]", "[ 120,\"1 in\"]");
    assert_eq!(moved.text, expected);
}

#[test]
fn what_follows_from_nothing_that_can_change_stays() {
    let text = r#"{ "format": "linkdyn/1", "units": "SI", "parameters": { "l": "=2 m" }, "bodies": { "ground": { "points": { "O": [0, 0] } },
        "a": { "points": { "O": [0, 0], "P": ["=l", 0] } } }, "joints": { "o": { "type": "revolute", "between": ["ground.O", "a.O"] } } }"#;
    let (file, poses) = assembled(text);
    let moved = moved(&file, &poses, &[point("a.P")], [3.0, 1.0], 1e-3).expect("it moves");
    assert!(moved.changed.is_empty() && moved.text == text);
    let refused = super::moved(&file, &poses, &[point("a.Q")], [3.0, 1.0], 1e-3);
    assert!(refused.is_err_and(|why| why.to_string().contains("a.Q")));
}

#[test]
fn bundled_models_take_any_drag() {
    let mut state = 5_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut refused = 0;
    for name in bundled::names().filter(|name| *name != bundled::FAMILY) {
        let text = bundled::text(name).expect("it is bundled");
        let file = read(&text);
        let mut hand = Hand::new(file.model()).expect("it can be held");
        let guess = hand.poses();
        let poses = hand.beside(&guess, 0.0).unwrap_or(guess);
        for joint in file.model().joints.values().take(8) {
            let at = place(&file, &poses, &joint.between[1].to_string());
            let target = [at[0] + 0.05 * random(), at[1] + 0.05 * random()];
            let Ok(moved) = moved(&file, &poses, &joint.between, target, 1e-5) else {
                refused += 1;
                continue;
            };
            assert!(moved.place.iter().all(|own| own.is_finite()), "{name}");
            let after = linkdyn_model::load(moved.text.as_bytes(), &[]);
            // Ranges of the format may say no; what is written is JSON with the same keys.
            if let Err(found) = after {
                assert!(
                    found.iter().all(|one| !one.path.is_empty()),
                    "{name}: {found:?}"
                );
            }
            if moved.changed.is_empty() {
                assert_eq!(moved.text, text);
            }
        }
    }
    assert!(refused < 5, "{refused}");
}
