//! The worst found: against massless clearance links, and against random deviations.

use super::{sprung, told};
use crate::accuracy::told::Random;
use crate::models;
use linkdyn_engine::analysis::{Control, run};
use linkdyn_variation::OutputAccuracy;
use serde_json::{Value, json};

/// The lock, closing so slowly that nothing but its weight counts, all pins with this clearance.
fn slow_lock(clearance: &str) -> Value {
    let mut json = models::load_bundled("lock", &[]).to_json();
    json["drivers"]["motor"] = json!({ "type": "rotation", "body": "link6",
        "motion": { "type": "constant_velocity", "start": -0.87, "velocity": 1e-6 } });
    json["analysis"] = json!({ "type": "inverse_dynamics", "sample": { "driver": "motor", "from": -0.87, "to": 1.9, "step": 0.2 } });
    for joint in json["joints"].as_object_mut().expect("joints").values_mut() {
        joint["clearance"] = json!({ "model": clearance, "radius": 1e-5 });
    }
    json["accuracy"] = json!({ "outputs": { "closing": { "column": "driver.motor.effort" },
        "hinge": { "column": "joint.a.fx" }, "other": { "column": "joint.g.fy" } } });
    json
}

/// The worst found of pins that are pressed is the massless link, whose fixed point stands to 1e-10 of the coordinates.
#[test]
fn the_lock_closes_with_the_force_that_clearance_links_give() {
    let found = told(&slow_lock("ideal")).answer();
    let linked = told(&slow_lock("massless_link"));
    let run = run(&linked.loaded.model, &Control::default()).expect("a run");
    for output in &found.outputs {
        let values = run.trajectory.values(&output.of).expect("a column");
        let size = output
            .poses
            .iter()
            .map(|pose| pose.found[0].expect("found").abs());
        let size = size.fold(0.0, f64::max);
        assert_eq!(output.poses.len(), values.len());
        for (pose, value) in output.poses.iter().zip(values) {
            let by = value - pose.nominal;
            for found in pose.found {
                let off = (found.expect("found") - by).abs() / size;
                assert!(
                    off <= 1e-9,
                    "{} at {:?}: {found:?} instead of {by}",
                    output.name,
                    pose.drivers
                );
            }
        }
    }
}

#[test]
fn nothing_within_the_tolerances_goes_beyond_the_worst_found() {
    let mut json = sprung();
    let told_all = told(&json);
    let found = told_all.answer();
    let mut random = Random(11);
    let mut least = [f64::INFINITY; 2];
    for _ in 0..150 {
        // Often at the ends, where the worst is.
        let mut part = || (2.0 * random.both()).clamp(-1.0, 1.0);
        let (angle, radius) = (std::f64::consts::PI * part(), 2e-4);
        let place = [0.3 + radius * angle.cos(), radius * angle.sin()];
        json["bodies"]["ground"]["points"]["Q"] = json!(place);
        let told = told(&json);
        let off = told.loaded.parameters.iter().map(|own| {
            let tolerance = own.tolerance.as_ref().expect("a tolerance");
            let by = part();
            (
                own.name.as_str(),
                if by > 0.0 {
                    by * tolerance.upper
                } else {
                    -by * tolerance.lower
                },
            )
        });
        let off: Vec<(&str, f64)> = off.collect();
        let model = told.loaded.source.with_deviations(&off).expect("legal");
        let run = run(&model, &Control::default()).expect("a run");
        for output in &found.outputs[..2] {
            let values = run.trajectory.values(&output.of).expect("a column");
            for (pose, value) in output.poses.iter().zip(values) {
                let by = value - pose.nominal;
                let [low, high] = pose.found.map(|by| by.expect("found"));
                assert!(
                    low * (1.0 + 1e-9) <= by && by <= high * (1.0 + 1e-9),
                    "{} at {}: {by} beyond {low} {high}",
                    output.name,
                    pose.time
                );
                least = [least[0].min(1.0 - by / low), least[1].min(1.0 - by / high)];
            }
        }
    }
    // They come near.
    assert!(least[0] < 0.2 && least[1] < 0.2, "{least:?}");
}

/// The worst found over the first order, less 1, at tolerances of a part.
fn remainder(part: f64) -> f64 {
    let mut json = sprung();
    for parameter in json["parameters"]
        .as_object_mut()
        .expect("some")
        .values_mut()
    {
        let value: f64 = parameter["value"]
            .as_str()
            .and_then(|text| text.split(' ').next())
            .expect("a value")
            .parse()
            .expect("a number");
        let unit = parameter["value"]
            .as_str()
            .and_then(|text| text.split(' ').nth(1))
            .expect("a unit");
        parameter["tolerance"] = json!(format!("{:e} {unit}", 0.01 * part * value));
    }
    json["bodies"]["ground"]["points"]["Q"]["tolerance"] = json!(2e-3 * part);
    for joint in ["a", "b", "c", "d"] {
        json["joints"][joint]["clearance"] =
            json!({ "model": "ideal", "radius": [0, 1e-3 * part] });
    }
    let found = told(&json).answer();
    let OutputAccuracy { poses, .. } = &found.outputs[2];
    let (first, worst) = (
        poses[0].first.expect("first")[1],
        poses[0].found[1].expect("found"),
    );
    (worst / first - 1.0).abs()
}

#[test]
fn the_worst_found_tends_to_the_first_order() {
    let [coarse, fine] = [1.0, 0.01].map(remainder);
    // In proportion to the deviations, or faster.
    assert!(
        coarse > 1e-4 && fine <= 0.02 * coarse,
        "{coarse:e} {fine:e}"
    );
}
