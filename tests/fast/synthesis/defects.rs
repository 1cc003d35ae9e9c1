//! What is wrong with linkages that pass all positions.

use super::*;

/// How candidates of a task fared.
fn fared(points: &[Place]) -> Value {
    let (_, told) = found(
        json!({ "path": points, "pivots": { "x": [-10, 10], "y": [-10, 10] }, "lengths": [0.001, 20], "most": 1000 }),
    );
    told
}

fn has_known(told: &Value) -> bool {
    let mut all = told["linkages"].as_array().expect("a list").iter();
    all.any(|one| (FourBar::of(&one["model"]).crank - KNOWN.crank).abs() < 1e-9)
}

#[test]
fn points_on_both_circuits_are_told() {
    // A crank that turns fully: both ways of closing are circuits of their own.
    let other = FourBar {
        side: -1.0,
        ..KNOWN
    };
    let points: Vec<Place> = (0..9)
        .map(|k| {
            let angle = 0.3 + 0.65 * f64::from(k);
            if k == 4 {
                other.point(angle)
            } else {
                KNOWN.point(angle)
            }
        })
        .collect();
    let told = fared(&points);
    assert!(!has_known(&told));
    assert!(
        told["tried"][0]["other_circuit"].as_u64().expect("a count") > 0,
        "{:#}",
        told["tried"]
    );
}

#[test]
fn points_in_another_order_are_told() {
    let mut points: Vec<Place> = (0..9)
        .map(|k| KNOWN.point(0.3 + 0.65 * f64::from(k)))
        .collect();
    points.swap(3, 6);
    let told = fared(&points);
    assert!(!has_known(&told));
    assert!(told["tried"][0]["other_order"].as_u64().expect("a count") > 0);
}

#[test]
fn positions_on_both_branches_are_told() {
    // A double rocker: its crank turns back at dead centres, between which both branches meet.
    let known = FourBar {
        crank: 0.25,
        coupler: 0.1,
        rocker: 0.22,
        point: [0.05, 0.07],
        side: 1.0,
        ..KNOWN
    };
    let other = FourBar {
        side: -1.0,
        ..known
    };
    let angles = [0.62, 0.75, 0.9, 1.1, 1.25];
    let positions: Vec<Value> = angles
        .iter()
        .enumerate()
        .map(|(k, angle)| {
            let own = if k < 3 { &known } else { &other };
            json!({ "point": own.point(*angle), "angle": own.angle(*angle) })
        })
        .collect();
    let (_, told) = found(
        json!({ "positions": positions, "pivots": { "x": [-10, 10], "y": [-10, 10] }, "lengths": [0.001, 20], "starts": 1 }),
    );
    let tried = &told["tried"][0];
    assert!(
        tried["other_branch"].as_u64().expect("a count") > 0,
        "{tried:#}"
    );
}
