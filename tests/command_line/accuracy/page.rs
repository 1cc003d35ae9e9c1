//! The page in a browser: what it shows is what the files hold, and what is pressed acts.

use super::*;
use crate::browser::{ask, ask_in, find, open};
use linkdyn_picture::Shape;
use linkdyn_picture::accuracy_page::{AccuracyPage, Output, Unit};
use serde_json::json;

const SCRIPT: &str = include_str!("page.js");

/// The pose of an output at an instant.
fn pose_at<'j>(json: &'j Value, output: &str, time: &Value) -> &'j Value {
    let poses = json["outputs"][output]["poses"].as_array().expect("poses");
    let found = poses
        .iter()
        .find(|pose| number(&pose["time"]) == number(time));
    found.unwrap_or_else(|| panic!("no pose of {output} at {time}"))
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}

/// The shares that the page tells of a pose are those of the file, the greatest first.
fn same_shares(told: &Value, pose: &Value) {
    let told = told.as_array().expect("rows");
    let listed = pose["contributions"].as_object().expect("sources");
    let carrying = listed
        .values()
        .filter(|by| number(&by["worst_share"]) > 0.0);
    assert_eq!(told.len(), carrying.count(), "{told:?}");
    let mut before = f64::INFINITY;
    for row in told {
        let by = &listed[row[0].as_str().expect("a name")];
        let share = number(&by["worst_share"]);
        assert!(share <= before, "{told:?}");
        before = share;
        assert_eq!(row[2], format!("{:.2} %", 100.0 * share));
        let variance = number(&by["variance_share"]);
        assert_eq!(
            row[3],
            format!("{variance:.2} %", variance = 100.0 * variance)
        );
    }
}

#[test]
fn the_page_shows_what_the_files_hold() {
    let Some(browser) = find() else { return };
    let (told, page, json) = accuracy(&FOUR_BAR);
    assert!(told.contains("report.html"), "{told}");
    let (found, visit) = ask(&browser, &page, SCRIPT, Some(4000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert_eq!(found["requests"], json!([]));
    let names: Vec<&Value> = found["outputs"]
        .as_array()
        .expect("outputs")
        .iter()
        .map(|output| &output["name"])
        .collect();
    assert_eq!(json!(names), json!(["rocking", "reach", "set"]));
    same_shares(&found["shares"], pose_at(&json, "rocking", &found["time"]));
    same_shares(
        &found["clicked_shares"],
        pose_at(&json, "rocking", &found["clicked_time"]),
    );
    // Bars are as long as what the sources carry, about the middle.
    for bar in found["bars"].as_array().expect("bars") {
        let [left, width] = [0, 1].map(|k| number(&bar[k]));
        assert!(
            (left + width / 2.0 - 50.0).abs() < 1e-3 && width > 1.0,
            "{bar}"
        );
    }
    // 0.0194 / 0.0196: of the output at a pose the page tells what the command prints.
    let tiles = &found["outputs"][2]["tiles"];
    let pose = &json["outputs"]["set"]["poses"][0];
    let degrees = number(&pose["nominal"]).to_degrees();
    assert_eq!(tiles["nominal"], format!("{degrees:.3}°"));
    assert_eq!(tiles["limits"], "±0.1°");
    assert_eq!(tiles["Cp"], format!("{:.2}", number(&pose["cp"])));
    assert_eq!(found["outputs"][2]["badge"], "limits kept (certified)");
    let limits = &json["outputs"]["rocking"]["limits"];
    let poses = json["outputs"]["rocking"]["poses"]
        .as_array()
        .expect("poses");
    let exceeded = poses.iter().filter(|pose| {
        (0..2).any(|k| {
            let beyond = number(&pose["found"][k]) - number(&limits[k]);
            if k == 0 { beyond < 0.0 } else { beyond > 0.0 }
        })
    });
    let badge = format!(
        "limits exceeded at {} of {} poses",
        exceeded.count(),
        poses.len()
    );
    assert_eq!(found["outputs"][0]["badge"], badge);
    assert_eq!(
        found["third"],
        json!({ "name": "set", "band_hidden": true, "shares": 2 })
    );
    // All of it is certified.
    assert_eq!(found["needed"]["hidden"], true);
}

#[test]
fn what_is_pressed_acts() {
    let Some(browser) = find() else { return };
    let (_, page, json) = accuracy(&FOUR_BAR);
    let (found, visit) = ask(&browser, &page, SCRIPT, Some(4000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert!(number(&found["clicked"]) < 0.01, "{found:#}");
    let all = json!({ "drawing": true, "shares": true, "head": true });
    assert_eq!(found["follows"], all);
    assert_eq!(found["first_pose"], 0);
    assert!(
        number(&found["larger"]["factor"]) > number(&found["factor"]),
        "{found:#}"
    );
    assert_eq!(found["larger"]["drawing"], true);
    assert_eq!(found["fitted"]["drawing"], true);
    assert_eq!(found["other_side"], json!({ "side": 0, "drawing": true }));
    assert_eq!(
        found["sliders"],
        json!(["base", "crank", "coupler", "rocker"])
    );
    // To first order the output moves by its derivative times the tolerance.
    let moved = &found["moved"];
    let by = &pose_at(&json, "rocking", &moved["time"])["contributions"]["parameters.base"];
    let expected = number(&by["sensitivity"]) * 5e-5;
    let relative = number(&moved["shift"]) / expected - 1.0;
    assert!(relative.abs() < 1e-12, "{moved}: {expected}");
    let text = moved["text"].as_str().expect("text");
    assert!(
        text.contains(moved["expected"].as_str().expect("text")),
        "{text}"
    );
    assert_eq!(moved["plot"], true);
    assert_eq!(found["reset"], true);
    corners(&found, by);
    // Names break at their dots.
    assert_eq!(found["names_broken"], json!([1, 1]));
}

/// With all parameters at their worst the page shows the worst found, in between the first order.
fn corners(found: &Value, by: &Value) {
    for (name, side) in [("lowest", 0), ("highest", 1)] {
        let at = &found[name];
        assert_eq!(at["corner"], side, "{at}");
        assert_eq!(at["side"], side, "{at}");
        assert_eq!(at["level"], "worst found", "{at}");
        let text = at["text"].as_str().expect("text");
        let expected = at["expected"].as_str().expect("text");
        assert!(
            text.contains(expected) && text.contains("worst found"),
            "{text}"
        );
        // Only `base` has a tolerance.
        let is_up = (number(&by["sensitivity"]) > 0.0) == (side == 1);
        let end = if is_up { 100 } else { -100 };
        assert_eq!(at["inputs"], json!([end, 0, 0, 0]), "{at}");
    }
    let between = &found["between"];
    assert_eq!(between["corner"], Value::Null, "{between}");
    assert_eq!(between["level"], "to first order", "{between}");
    let note = between["note"].as_str().expect("text");
    assert!(note.contains("not this drawing"), "{note}");
}

/// Beside the change point of the lock nothing is certified: the band is open there, says so, and its peaks are told.
#[test]
fn what_is_not_certified_is_told() {
    let Some(browser) = find() else { return };
    let (_, page, json) = accuracy(&LOCK);
    let (found, visit) = ask(&browser, &page, SCRIPT, Some(4000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let poses = json["outputs"]["closed"]["poses"]
        .as_array()
        .expect("poses");
    let open = poses
        .iter()
        .filter(|pose| pose["certified"].is_null())
        .count();
    assert!(open > 0 && open < poses.len() / 10, "{open}");
    let hatched: f64 = found["open"][0]
        .as_array()
        .expect("runs")
        .iter()
        .map(number)
        .sum();
    assert_eq!(hatched, open as f64);
    let note = found["note"].as_str().expect("text");
    let said = format!("Nothing is certified at {open} of {} poses", poses.len());
    assert!(
        note.starts_with(&said) && note.contains("Peaks are cut off"),
        "{note}"
    );
    assert_eq!(found["outputs"][0]["tiles"]["certified"], "not certified");
    let largest = |side: usize, sign: f64| {
        let found = poses.iter().filter_map(|pose| pose["found"][side].as_f64());
        found.map(|by| sign * by).fold(0.0, f64::max) * sign
    };
    let peaks = found["peaks"].as_array().expect("peaks");
    for end in [largest(0, -1.0), largest(1, 1.0)] {
        // The plot divides by the unit, and the peak multiplies by it again.
        let is_end = |value: f64| (value - end).abs() <= 2.0 * f64::EPSILON * end.abs();
        let told = peaks
            .iter()
            .any(|peak| peak["name"] == "worst found" && is_end(number(&peak["value"])));
        assert!(told, "{end}: {peaks:?}");
    }
    needs(&found["needed"]);
    // The worst configuration is displaced by so much that it can be seen.
    assert!(number(&found["factor"]) >= 2.0, "{found:#}");
    assert_eq!(found["factor_told"], format!("× {}", found["factor"]));
}

/// The page draws what a deviation needs: two curves from nothing at the nominal output to the worst found.
fn needs(needed: &Value) {
    assert_eq!(needed["hidden"], false);
    let note = needed["note"].as_str().expect("text");
    for share in ["10 % of them", "50 % of them", "100 % of them"] {
        assert!(note.contains(share), "{note}");
    }
    let curves = needed["curves"].as_array().expect("curves");
    assert_eq!(curves.len(), 2);
    for (curve, end) in curves.iter().zip(needed["ends"].as_array().expect("dots")) {
        let points: Vec<[f64; 2]> = curve
            .as_array()
            .expect("points")
            .iter()
            .map(|point| [0, 1].map(|k: usize| number(&point[k])))
            .collect();
        // On paper y goes down as the share rises.
        assert!(
            points.windows(2).all(|pair| pair[1][1] <= pair[0][1]),
            "{points:?}"
        );
        assert!((points[60][0] - number(end)).abs() < 0.01, "{points:?}");
        let tall = points[0][1] - points[60][1];
        assert!((tall - 146.0).abs() < 0.01, "{points:?}");
    }
}

#[test]
fn the_band_is_on_the_first_screen() {
    let Some(browser) = find() else { return };
    for (model, arguments) in [("four-bar", &FOUR_BAR[..]), ("lock", &LOCK[..])] {
        let (_, page, _) = accuracy(arguments);
        for size in [[390, 844], [820, 1180], [1280, 720], [1920, 1080]] {
            let (found, visit) = ask_in(&browser, &page, SCRIPT, Some(4000), size);
            assert!(
                visit.console.is_empty(),
                "{model} {size:?}: {:#?}",
                visit.console
            );
            let [width, height] = size.map(f64::from);
            assert_eq!(number(&found["width"]), width);
            assert!(
                number(&found["scroll_width"]) <= width,
                "{model} {size:?}: {found:#}"
            );
            assert!(
                number(&found["plot_bottom"]) <= height,
                "{model} {size:?}: {found:#}"
            );
            assert!(number(&found["plot_tall"]) > 150.0, "{model} {size:?}");
            assert_eq!(found["texts_outside"], json!([]), "{model} {size:?}");
        }
    }
}

/// An output whose pose the motion does not have is told, and nothing else is shown.
#[test]
fn a_pose_that_does_not_exist_is_told() {
    let Some(browser) = find() else { return };
    let unit = |symbol: &str| Unit {
        symbol: symbol.into(),
        size: 1.0,
    };
    let page = AccuracyPage {
        model: "empty",
        about: None,
        assumed: String::new(),
        level: 2,
        length: unit("m"),
        angle: unit("rad"),
        drivers: vec![("motor".into(), "rad")],
        shape: Shape::default(),
        sources: Vec::new(),
        outputs: vec![Output {
            name: "set",
            of: "rocker.angle",
            unit: "rad",
            limits: None,
            poses: Vec::new(),
        }],
        notes: &["a warning".into()],
    };
    let probe = "setTimeout(() => answer({ notes: [...document.querySelectorAll('#notes p')].map((p) => p.textContent), \
        results: document.getElementById('results').hidden }), 300);";
    let (found, visit) = ask(&browser, &page.html(), probe, Some(2000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let notes = ["set: the motion has no such pose.", "a warning"];
    assert_eq!(found, json!({ "notes": notes, "results": true }));
}

/// A stroke of many poses stays a page: what is left out is said.
#[test]
fn a_long_stroke_stays_below_5_mb() {
    let mut arguments = FOUR_BAR.to_vec();
    arguments.extend(["--set", "analysis.outputs=5001"]);
    let (_, page, json) = accuracy(&arguments);
    assert!(page.len() < 5_000_000, "{}", page.len());
    let poses = json["outputs"]["rocking"]["poses"]
        .as_array()
        .expect("poses");
    assert_eq!(poses.len(), 5_001);
    let Some(browser) = find() else { return };
    let (found, visit) = ask(&browser, &page, SCRIPT, Some(4000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert!((2..=200).contains(&found["details"][0].as_u64().expect("a number")));
    let foot = found["foot"].as_str().expect("text");
    assert!(foot.contains("of 5001 poses are in this page"), "{foot}");
    // The farthest pose is there though most are not.
    let extent = |pose: &Value| {
        [0, 1]
            .map(|k| number(&pose["found"][k]).abs())
            .into_iter()
            .fold(0.0, f64::max)
    };
    let farthest = poses
        .iter()
        .max_by(|a, b| extent(a).total_cmp(&extent(b)))
        .expect("a pose");
    assert_eq!(found["time"], farthest["time"]);
}

const HOSTILE: &str = r#"{ "format": "linkdyn/1", "name": "</script><script>window.hacked=1</script><!--<script>", "units": "SI",
  "about": "<img src=x onerror=\"window.hacked=1\"> & &lt; {{script}}",
  "bodies": { "ground": { "points": { "</script>": [0, 0] } },
    "<!--<script>": { "points": { "</script>": [0, 0], "\" onload '": [1, 0] } },
    "__proto__": { "points": { "constructor": [0, 0], "🔒\u202e\u2028": [1, 0] }, "pose": { "position": [1, 0] } } },
  "joints": { "</style><svg/onload>": { "type": "revolute", "between": ["ground.</script>", "<!--<script>.</script>"], "clearance": { "model": "ideal", "radius": 1e-3 } },
    "toString": { "type": "revolute", "between": ["<!--<script>.\" onload '", "__proto__.constructor"], "clearance": { "model": "ideal", "radius": 1e-3 } } },
  "drivers": { "a\"b": { "type": "rotation", "body": "<!--<script>", "motion": { "type": "constant_velocity", "velocity": 1 } },
    "🔒": { "type": "rotation", "body": "__proto__", "motion": { "type": "constant_velocity", "velocity": 2 } } },
  "accuracy": { "outputs": { "</script><img src>": { "distance": ["ground.</script>", "__proto__.🔒\u202e\u2028"], "limits": [-1e-3, 1e-3] } } },
  "analysis": { "type": "kinematics", "end": 1, "outputs": 11 } }"#;

#[test]
fn hostile_names_stay_text() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("accuracy-hostile");
    let path = scratch.0.join("model.json");
    fs::write(&path, HOSTILE).expect("written");
    let (_, page, _) = accuracy(&[path.to_str().expect("UTF-8")]);
    let probe = "setTimeout(() => answer({ hacked: typeof window.hacked, images: document.images.length, scripts: document.scripts.length, \
        name: document.getElementById('name').textContent, output: document.querySelector('#outputs strong').textContent, \
        shares: document.querySelectorAll('.bar').length }), 300);";
    let (found, visit) = ask(&browser, &page, probe, Some(2000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let expected = json!({ "hacked": "undefined", "images": 0, "scripts": 5,
        "name": "</script><script>window.hacked=1</script><!--<script>",
        "output": "</script><img src>", "shares": 2 });
    assert_eq!(found, expected);
    assert!(open(&browser, &page, Some(500)).console.is_empty());
}
