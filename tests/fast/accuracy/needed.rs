//! How far parts of all deviations let an output go, where nothing is certified.

use super::{asked, clearances};
use serde_json::Value;

/// The lock's change point, and a place close beside it, where nothing is certified.
const AT: [&str; 2] = ["117.512206516644 deg", "117.4 deg"];
const JOINTS: [&str; 7] = ["a", "b", "c", "d", "e", "f", "g"];

/// Deviations of the lock's first link with clearances of a radius \[m\] at a value of its driver.
fn lock(at: &str, c: f64) -> Value {
    let names: Vec<String> = JOINTS.map(String::from).into();
    let mut sets = clearances(&names, c);
    sets.push("drivers.motor.tolerance=0".into());
    sets.push(format!(
        r#"accuracy={{"outputs":{{"y":{{"column":"link2.angle","at":{{"value":"{at}"}}}}}}}}"#
    ));
    asked("watt-i-lock", &sets)["outputs"]["y"]["poses"][0].clone()
}

/// A part of the clearances allows what clearances of that part of the size allow.
#[test]
fn a_part_of_the_clearances_goes_as_far_as_smaller_ones() {
    for at in AT {
        let whole = lock(at, 1e-5);
        for side in [0, 1] {
            let curve = whole["needed"][side].as_array().expect("a curve");
            let points: Vec<[f64; 2]> = curve
                .iter()
                .map(|point| [0, 1].map(|k: usize| point[k].as_f64().expect("a number")))
                .collect();
            assert_eq!(points.len(), 10, "{at}: {points:?}");
            let rises =
                |pair: &[[f64; 2]]| pair[0][0].abs() < pair[1][0].abs() && pair[0][1] < pair[1][1];
            assert!(points.windows(2).all(rises), "{at}: {points:?}");
            assert_eq!(points[9][0], whole["found"][side].as_f64().expect("found"));
            for &[by, share] in points
                .iter()
                .filter(|[_, share]| [0.1, 0.5].contains(share))
            {
                let small = lock(at, 1e-5 * share);
                let found = small["found"][side].as_f64().expect("found");
                // Corrections stop at 1e-10 of a radian.
                assert!((by - found).abs() < 1e-9, "{at}: {by} {found}");
            }
        }
    }
}

/// Where a bound is certified nothing is followed step by step.
#[test]
fn where_a_bound_is_certified_no_share_is_told() {
    let pose = lock("60 deg", 1e-5);
    assert!(pose["certified"].is_array(), "{pose}");
    assert_eq!(pose["needed"], serde_json::json!([[], []]));
}
