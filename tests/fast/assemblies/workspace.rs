//! The map of a five-bar against its closed form: it closes where both far pins are at most 2 l apart, its assemblies meet where they are
//! just that, and the far pin stays between rings about both pivots.

use super::*;
use linkdyn_engine::analysis::{WorkspaceQuestion, workspace};
use linkdyn_model::PointRef;
use std::f64::consts::TAU;

const NEAR: f64 = 0.08;
const FAR: f64 = 0.11;
const BASE: f64 = 0.1;

fn five_bar() -> Value {
    let bar = |points: [&str; 2], length: f64, position: [f64; 2], angle: f64| json!({ "points": { points[0]: [0, 0], points[1]: [length, 0] }, "pose": { "position": position, "angle": angle } });
    let pin = |a: &str, b: &str| json!({ "type": "revolute", "between": [a, b] });
    let motor = |body: &str, start: f64| json!({ "type": "rotation", "body": body, "motion": { "type": "constant_velocity", "start": start, "velocity": 1 } });
    json!({ "format": "linkdyn/1", "units": "SI",
        "bodies": { "ground": { "points": { "A": [0, 0], "E": [BASE, 0] } },
            "left": bar(["A", "B"], NEAR, [0.0, 0.0], 1.9), "far_left": bar(["B", "C"], FAR, [-0.026, 0.076], 0.8),
            "right": bar(["E", "D"], NEAR, [BASE, 0.0], 1.2), "far_right": bar(["D", "C"], FAR, [0.129, 0.075], 2.4) },
        "joints": { "a": pin("ground.A", "left.A"), "b": pin("left.B", "far_left.B"), "c": pin("far_left.C", "far_right.C"),
            "d": pin("right.D", "far_right.D"), "e": pin("ground.E", "right.E") },
        "drivers": { "one": motor("left", 1.9), "two": motor("right", 1.2) } })
}

/// Distance of both near pins.
fn apart([one, two]: [f64; 2]) -> f64 {
    let x = BASE + NEAR * (two.cos() - one.cos());
    x.hypot(NEAR * (two.sin() - one.sin()))
}

fn question(drivers: Option<[&str; 2]>) -> WorkspaceQuestion {
    WorkspaceQuestion {
        point: PointRef::try_from("far_left.C".to_owned()).expect("a point"),
        drivers: drivers.map(|own| own.map(str::to_owned)),
        count: 33,
        most: 10,
    }
}

#[test]
fn the_map_of_a_five_bar_is_that_of_its_closed_form() {
    let model = loaded(&five_bar()).model;
    let map = workspace(&model, &question(None), &Control::default());
    let map = map.expect("a map").expect("not stopped");
    assert!(map.doubts.is_empty(), "{:?}", map.doubts);
    for (j, two) in map.values[1].iter().enumerate() {
        for (i, one) in map.values[0].iter().enumerate() {
            let off = apart([*one, *two]) - 2.0 * FAR;
            // Nothing is said within round-off.
            if off.abs() > 1e-9 {
                let closes = if off < 0.0 { 2 } else { 0 };
                assert_eq!(map.counts[j][i], closes, "{one} {two}: {off}");
            }
        }
    }
    let singular: Vec<_> = map.singular.iter().flatten().collect();
    assert!(singular.len() > 40, "{}", singular.len());
    for own in &singular {
        let off = apart(own.values) - 2.0 * FAR;
        assert!(off.abs() < 1e-9, "{:?}: {off:e}", own.values);
        // Stretched out: the pin is in the middle.
        let [one, two] = own.values;
        let middle = [
            0.5 * (BASE + NEAR * (one.cos() + two.cos())),
            0.5 * NEAR * (one.sin() + two.sin()),
        ];
        let off = (own.place[0] - middle[0]).hypot(own.place[1] - middle[1]);
        assert!(off < 1e-5, "{off:e}");
    }
    // The curve is closed but for the ends of the turn: neighbours are a cell apart at the most.
    let cell = TAU / 32.0;
    for two in map.singular.iter().flat_map(|curve| curve.windows(2)) {
        let by = [0, 1].map(|k| (two[0].values[k] - two[1].values[k]).abs());
        assert!(by[0] <= cell + 1e-9 && by[1] <= cell + 1e-9);
    }
    for [x, y] in &map.places {
        for pivot in [0.0, BASE] {
            let far = (x - pivot).hypot(*y);
            assert!(far > FAR - NEAR - 1e-9 && far < FAR + NEAR + 1e-9, "{far}");
        }
    }
}

#[test]
fn drivers_may_be_named_in_either_order() {
    let model = loaded(&five_bar()).model;
    let [one, two] = [["one", "two"], ["two", "one"]].map(|names| {
        let map = workspace(&model, &question(Some(names)), &Control::default());
        map.expect("a map").expect("not stopped")
    });
    assert_eq!(one.values[0], two.values[1]);
    for (i, row) in one.counts.iter().enumerate() {
        for (j, own) in row.iter().enumerate() {
            assert_eq!(*own, two.counts[j][i]);
        }
    }
}
