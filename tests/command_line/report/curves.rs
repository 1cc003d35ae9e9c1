//! Which plots come first, and what their axes are.

use super::*;

fn told(model: &str) -> Option<Value> {
    let browser = find()?;
    let (page, _, _) = run(&[model]);
    let script = include_str!("curves.js");
    let (told, visit) = ask_in(&browser, &page, script, Some(8000), [1280, 720]);
    assert!(visit.console.is_empty(), "{model}: {:#?}", visit.console);
    Some(told)
}

/// On a laptop the point that a mechanism is built for and what its motor gives are seen at once.
#[test]
fn the_declared_point_and_the_effort_are_on_the_first_screen() {
    for (model, first, second) in [
        ("four-bar", "coupler.P.x", "driver.motor.effort"),
        ("double-wishbone", "knuckle.patch.x", "driver.rig.effort"),
        ("scotch-yoke", "yoke.tip.x", "driver.motor.effort"),
    ] {
        let Some(told) = told(model) else { return };
        assert_eq!(told["order"][0][0], first, "{model}: {told:#}");
        assert_eq!(told["order"][1][0], second, "{model}: {told:#}");
        let [bottom, height] =
            [&told["bottoms"][1], &told["height"]].map(|value| value.as_f64().expect("a number"));
        assert!(bottom <= height, "{model}: {told:#}");
    }
}

/// A curve that moves is seen to move, whatever stands beside it: it goes through an eighth of its axis at least, less the
/// margins of a seventh. A length is as long both ways where a path is shown.
#[test]
fn the_travel_of_a_point_is_seen_both_ways() {
    let mut apart = 0;
    for model in ["double-wishbone", "four-bar", "hoeken", "jansen-leg"] {
        let Some(told) = told(model) else { return };
        let shares = told["shares"].as_array().expect("a list");
        assert!(!shares.is_empty(), "{model}: {told:#}");
        for share in shares {
            let part = share[1].as_f64().expect("a share");
            assert!(part > 0.125 / 1.14 && part <= 1.0, "{model}: {share}");
        }
        for ratio in told["uneven"].as_array().expect("a list") {
            let ratio = ratio.as_f64().expect("a ratio");
            assert!((ratio - 1.0).abs() < 0.02, "{model}: {told:#}");
        }
        apart += told["axes"]
            .as_array()
            .expect("a list")
            .iter()
            .filter(|axes| **axes == json!(["x [mm]", "y [mm]"]))
            .count();
    }
    // Of the wheel's patch x goes 18 mm at 755 mm from the middle of the car; of the four-bar both go far.
    assert!(apart >= 1, "no axes of their own");
}
