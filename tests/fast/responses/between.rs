//! What lies between rows, and what follows from rows.

use super::{L, R, answers, holds, model};
use linkdyn_engine::analysis::{Control, Prepared};
use linkdyn_model::{Response, bundled, load};
use std::f64::consts::PI;

/// Where the piston is.
fn x(degrees: f64) -> f64 {
    let angle = degrees.to_radians();
    R * angle.cos() + (L * L - (R * angle.sin()).powi(2)).sqrt()
}

#[test]
fn values_between_rows_are_those_of_the_motion() {
    holds("at(t, crank.angle = 87 deg)", 87.0 / 360.0, "s", 1e-12);
    holds("at(piston.x, driver.motor = 87 deg)", x(87.0), "m", 1e-14);
    holds(
        "at(driver.motor, piston.x = 200 mm)",
        (R / (2.0 * L)).acos(),
        "rad",
        1e-12,
    );
    // nothing has every unit
    holds("at(driver.motor, crank.A.x = 0)", PI / 2.0, "rad", 1e-12);
    holds(
        "at(abs(piston.x - 0.2 m), t = 0.11 s)",
        x(39.6) - 0.2,
        "m",
        1e-13,
    );
}

#[test]
fn extremes_do_not_depend_on_where_the_rows_are() {
    let texts = [
        "range(piston.x)",
        "max(abs(rod.angle))",
        "argmin(piston.x)",
        "max(piston.vx)",
        "min(hypot(crank.A.x - 30 mm, crank.A.y - 40 mm + 1e-3*piston.x))",
        "max(abs(driver.motor.effort))",
        "argmax(abs(crank.A.y - 0.013 m))",
    ];
    let rows = |outputs: usize| -> Vec<f64> {
        let model = model(&texts).edit(|model| {
            model.analysis.as_mut().expect("an analysis").outputs = Some(outputs);
        });
        let answers = answers(&model.expect("good"));
        answers
            .iter()
            .map(|answer| answer.value.expect("a value"))
            .collect()
    };
    let dense = rows(2001);
    assert!((dense[0] - 2.0 * R).abs() < 1e-14);
    assert!((dense[1] - (R / L).asin()).abs() < 1e-14);
    assert!((dense[2] - 0.5).abs() < 1e-8);
    for outputs in [14, 17, 24, 36, 61, 100] {
        let found = rows(outputs);
        for ((text, found), dense) in texts.iter().zip(found).zip(&dense) {
            let within = if text.starts_with("arg") {
                1e-6
            } else {
                1e-10 * dense.abs().max(1e-3)
            };
            assert!(
                (found - dense).abs() <= within,
                "{outputs} rows: {text}: {found}, not {dense}"
            );
        }
    }
}

#[test]
fn free_motion_has_its_extremes_between_rows_too() {
    let text = bundled::find("pendulum")
        .map(|model| model.text)
        .expect("bundled");
    let peaks = |outputs: usize| {
        let set = [format!("analysis.outputs={outputs}")];
        let loaded = load(text.as_bytes(), &set).expect("good");
        let with = loaded.model.edit(|model| {
            let response = Response::new("max(abs(rod.omega))");
            model.responses.insert("fastest".to_owned(), response);
        });
        let prepared = Prepared::new(&with.expect("good")).expect("runs");
        let outcome = prepared.run(&Control::default()).expect("runs");
        assert!(outcome.peaks.is_empty(), "responses add no rows");
        let fastest = outcome.responses[0].value.expect("a value");
        // let go at the level of its pivot, it passes below it with m v²/2 = m g l
        let expected = (2.0f64 * 9.81).sqrt();
        assert!(
            (fastest - expected).abs() < 1e-6,
            "{fastest}, not {expected}"
        );
        outcome.trajectory.data
    };
    let (few, _) = (peaks(23), peaks(3001));
    // asking changes nothing
    let set = ["analysis.outputs=23".to_owned()];
    let plain = Prepared::new(&load(text.as_bytes(), &set).expect("good").model).expect("runs");
    let plain = plain.run(&Control::default()).expect("runs");
    assert_eq!(plain.trajectory.data, few);
}

#[test]
fn loads_shaking_and_transmission_are_named() {
    let text = bundled::find("four-bar")
        .map(|model| model.text)
        .expect("bundled");
    let value = |json: serde_json::Value| {
        let loaded = load(json.to_string().as_bytes(), &[]).expect("good");
        answers(&loaded.model).remove(0)
    };
    let with = |response: &str| {
        let mut json: serde_json::Value = serde_json::from_str(text).expect("JSON");
        json["responses"] = serde_json::json!({ "n": response });
        json["analysis"]["transmission"] = serde_json::json!({ "output": "rocker" });
        value(json)
    };
    let [crank, coupler, rocker, ground] = [0.1, 0.25, 0.2, 0.3];
    // law of cosines where crank and ground are in line
    let angle = |diagonal: f64| {
        let cos =
            (coupler * coupler + rocker * rocker - diagonal * diagonal) / (2.0 * coupler * rocker);
        let angle = cos.acos();
        angle.min(PI - angle)
    };
    let expected = angle(ground - crank).min(angle(ground + crank));
    let found = with("min(transmission.c.angle)");
    let least = found.value.unwrap_or_else(|| panic!("{:?}", found.reason));
    assert!((least - expected).abs() < 1e-12, "{least}, not {expected}");
    assert_eq!(found.unit, "rad");
    let shaking = with("max(hypot(shaking.fx, shaking.fy))");
    assert_eq!(
        (shaking.unit.as_str(), shaking.value.is_some()),
        ("N", true)
    );
}

/// At a dead centre of the crank the piston stands still: the advantage has poles there, wherever the rows fall.
#[test]
fn a_pole_has_no_extreme() {
    let slider_crank = |response: &str, outputs: usize| {
        let mut json = model(&[]).to_json();
        json["analysis"]["outputs"] = serde_json::json!(outputs);
        json["analysis"]["transmission"] = serde_json::json!({ "output": "piston" });
        json["responses"] = serde_json::json!({ "n": response });
        let loaded = load(json.to_string().as_bytes(), &[]).expect("good");
        answers(&loaded.model).remove(0)
    };
    for outputs in [37, 40, 361] {
        for response in [
            "max(transmission.advantage)",
            "range(transmission.advantage)",
            "max(1/abs(piston.x - 0.2 m))",
        ] {
            let found = slider_crank(response, outputs);
            let reason = found.reason.unwrap_or_default();
            assert!(
                found.value.is_none() && reason.contains("grows without end near"),
                "{outputs} rows: {response}: {:?} {reason}",
                found.value
            );
        }
        // between the dead centres it has a least value, where the piston is fastest
        let least = slider_crank("min(abs(transmission.advantage))", outputs);
        let fastest = slider_crank("max(abs(piston.vx))/max(crank.omega)", outputs);
        let product = least.value.expect("a least one") * fastest.value.expect("a fastest");
        assert!((product - 1.0).abs() < 1e-10, "{product}");
    }
}
