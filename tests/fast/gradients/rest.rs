//! Equilibria: variants are the runs that they are, and their gradients are those of closed forms and of central differences.

use super::{ALLOWED, Tally, assert_met, compare, family_of};
use crate::accuracy::told::{Random, parametric};
use crate::family::{alone, beside, off};
use crate::mechanisms::pin;
use crate::models;
use linkdyn_engine::analysis::{Control, Family};
use linkdyn_model::{Given, Loaded, Model};
use linkdyn_output::Status;
use serde_json::{Map, Value, json};

const G: f64 = 9.81;

/// Differences by more parameters than that take long, and those of a chain of forty four-bars near their change points are not good
/// to that many digits.
const MOST: usize = 150;

/// A rod that hangs at O: its tip is B, its centre of mass at `c`.
fn lever(forces: Value, drivers: Value, angle: f64) -> Value {
    json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0.0, -G],
        "parameters": { "mass": "2 kg", "c": "0.3 m", "length": "0.7 m", "a": "0.4 m", "k": "60 N/m",
            "push": "15 N", "start": "0.6 rad" },
        "bodies": {
            "ground": { "points": { "O": [0.0, 0.0], "P": ["=a", 0.0] } },
            "rod": { "mass": "=mass", "inertia": 0.01, "com": ["=c", 0.0],
                "points": { "O": [0.0, 0.0], "B": ["=length", 0.0] }, "pose": { "angle": angle } } },
        "points": ["rod.B"], "joints": { "o": pin("ground.O", "rod.O") }, "forces": forces, "drivers": drivers,
        "analysis": { "type": "statics" } })
}

const VALUES: [f64; 7] = [2.0, 0.3, 0.7, 0.4, 60.0, 15.0, 0.6];
const NAMES: [&str; 7] = ["mass", "c", "length", "a", "k", "push", "start"];

/// Responses and gradients of a model with these responses.
fn gradient(mut model: Value, responses: &[&str]) -> (Vec<f64>, Vec<f64>) {
    let named = responses.iter().enumerate();
    model["responses"] = named
        .map(|(k, text)| (format!("r{k}"), json!(text)))
        .collect::<Map<_, _>>()
        .into();
    let text = model.to_string();
    let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("sound");
    let family = Family::new(&loaded, &NAMES, Given::Values).expect("it runs");
    super::gradient(&family, &VALUES)
}

/// With no free length its spring pulls at the tip with k (P − B), so that tan θ = −m g c/(k L a).
#[test]
fn a_rod_on_a_spring_has_the_slopes_of_its_closed_form() {
    let spring = json!({ "s": { "type": "spring", "between": ["ground.P", "rod.B"], "stiffness": "=k",
        "free_length": 0.0 } });
    let responses = [
        "last(rod.angle)",
        "max(rod.B.y)",
        "rms(rod.B.y)",
        "mean(joint.o.fx)/k",
        "min(joint.o.fy)",
        "range(rod.x) + argmin(rod.x)*a/(1 s) + first(rod.B.x)",
    ];
    let (values, found) = gradient(lever(spring, json!({}), -0.2), &responses);
    let [m, c, l, a, k, ..] = VALUES;
    let t = -m * G * c / (k * l * a);
    let (sin, cos) = t.atan().sin_cos();
    assert!((values[0] - t.atan()).abs() < 1e-13, "{values:?}");
    // θ by m, c, L, a, k.
    let angle = [1.0 / m, 1.0 / c, -1.0 / l, -1.0 / a, -1.0 / k].map(|part| cos * cos * t * part);
    let row = |by: f64, own: [f64; 5]| -> Vec<f64> {
        let parts = angle.iter().zip(own).map(|(angle, own)| by * angle + own);
        parts.chain([0.0; 2]).collect()
    };
    let of_tip = row(l * cos, [0.0, 0.0, sin, 0.0, 0.0]);
    let across = row(-l * sin, [0.0, 0.0, cos, 0.0, 0.0]);
    // The ground holds the rod against the spring, k (a − L cos θ), and the weight.
    let side = row(-l * sin, [0.0, 0.0, cos, -1.0, 0.0]);
    let up = row(k * l * cos, [G, 0.0, k * sin, 0.0, l * sin]);
    let minus: Vec<f64> = of_tip.iter().map(|own| -own).collect();
    let exact = [row(1.0, [0.0; 5]), of_tip, minus, side, up, across];
    let of = |k: usize| &found[7 * k..7 * k + 7];
    assert!((values[3] - (l * cos - a)).abs() < 1e-12, "{values:?}");
    for (number, exact) in exact.iter().enumerate() {
        assert_met(responses[number], of(number), exact);
    }
}

/// tan θ = −m g c/(F L) under a force F to the side.
#[test]
fn a_pushed_rod_has_the_slopes_of_its_closed_form() {
    let push = json!({ "p": { "type": "force", "at": "rod.B", "vector": ["=push", 0.0] } });
    let responses = ["first(rod.angle)", "mean(joint.o.fx)", "max(force.p.fx)"];
    let (values, found) = gradient(lever(push, json!({}), -0.2), &responses);
    let [m, c, l, _, _, f, _] = VALUES;
    let t = -m * G * c / (f * l);
    assert!((values[0] - t.atan()).abs() < 1e-13, "{values:?}");
    let by = t / (1.0 + t * t);
    assert_met(
        "angle",
        &found[..7],
        &[by / m, by / c, -by / l, 0.0, 0.0, -by / f, 0.0],
    );
    assert_met(
        "reaction",
        &found[7..14],
        &[0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0],
    );
    assert_met("load", &found[14..], &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
}

/// A rod that a motor holds: the effort is m g c cos θ. A joint's friction plays no part at rest.
#[test]
fn a_held_rod_has_the_slopes_of_its_efforts() {
    let motor = json!({ "motor": { "type": "rotation", "body": "rod",
        "motion": { "type": "constant_velocity", "start": "=start", "velocity": 3.0 } } });
    let responses = [
        "last(driver.motor.effort)",
        "last(rod.B.x)",
        "last(joint.o.fy)",
    ];
    let mut model = lever(json!({}), motor, 0.6);
    for friction in [false, true] {
        if friction {
            model["joints"]["o"]["friction"] =
                json!({ "law": "coulomb", "coefficient": 0.2, "threshold_velocity": 0.01 });
            model["joints"]["o"]["pin_radius"] = json!(0.02);
        }
        let (values, found) = gradient(model.clone(), &responses);
        let [m, c, l, _, _, _, angle] = VALUES;
        let (sin, cos) = angle.sin_cos();
        assert!((values[0] - m * G * c * cos).abs() < 1e-12, "{values:?}");
        let effort = [
            G * c * cos,
            m * G * cos,
            0.0,
            0.0,
            0.0,
            0.0,
            -m * G * c * sin,
        ];
        let place = [0.0, 0.0, cos, 0.0, 0.0, 0.0, -l * sin];
        assert_met("effort", &found[..7], &effort);
        assert_met("tip", &found[7..14], &place);
        assert_met("reaction", &found[14..], &[G, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    }
}

/// Half the opening x of the rhombus: V = 2 m g s sin 2x + k/2 (2 s cos x − l)², of which dV/dx = 0 is differentiated by hand.
#[test]
fn a_rhombus_on_its_spring_has_the_slopes_of_its_potential() {
    let (s, rho, k) = (1.0_f64, 1.0, 25.0);
    let text = linkdyn_model::bundled::find("four-bar-spring")
        .expect("it")
        .text;
    let sets = ["responses.angle=last(left.angle)".to_owned()];
    let loaded = linkdyn_model::load(text.as_bytes(), &sets).expect("sound");
    let family = Family::new(&loaded, &["side", "rho"], Given::Values).expect("it runs");
    let (values, found) = super::gradient(&family, &[s, rho]);
    let x = 0.5 * values[0];
    // Over s: 4 ρ s g cos 2x − 2 k sin x (2 s cos x − √2 s) = 0, in which the length of the sides has no part.
    let pull = 4.0 * rho * G * (2.0 * x).cos();
    let spring = 2.0 * k * x.sin() * (2.0 * x.cos() - 2.0_f64.sqrt());
    assert!((pull - spring).abs() < 1e-11, "{pull} {spring}");
    let by_x = -8.0 * rho * G * (2.0 * x).sin()
        - 2.0 * k * (2.0 * (2.0 * x).cos() - 2.0_f64.sqrt() * x.cos());
    let by_rho = 4.0 * G * (2.0 * x).cos();
    assert_met("angle", &found, &[0.0, -2.0 * by_rho / by_x]);
}

/// What is not held has no derivatives, nor has what is left at the least push; what a kink holds neither.
#[test]
fn what_is_not_held_is_not_known() {
    let response = ["last(rod.angle)"];
    let upright = lever(json!({}), json!({}), 0.5 * std::f64::consts::PI);
    let (values, found) = gradient(upright, &response);
    assert!(
        values[0].is_finite() && found[0].is_nan(),
        "{values:?} {found:?}"
    );
    let mut loose = lever(json!({}), json!({}), 0.3);
    loose["gravity"] = json!([0.0, 0.0]);
    let (values, found) = gradient(loose, &response);
    assert!(
        values[0].is_finite() && found[0].is_nan(),
        "{values:?} {found:?}"
    );
}

/// A model at rest with its numbers as parameters: held by its drivers, or hanging without them; none where it has no masses or
/// no analysis.
fn at_rest(json: &Value, is_held: bool) -> Option<Loaded> {
    let model: Model = models::load(json);
    model.analysis.as_ref()?;
    let mut json = parametric(&model, 12);
    let own = model.to_json();
    if own.get("forces").is_some() {
        json["forces"] = own["forces"].clone();
    }
    if !is_held {
        json["drivers"] = json!({});
    }
    json["gravity"] = json!([0.8, -9.7]);
    json["analysis"] = json!({ "type": "statics" });
    let mut responses = Map::new();
    let names: Vec<String> = model
        .bodies
        .keys()
        .filter(|name| *name != "ground")
        .cloned()
        .collect();
    for (number, name) in names.iter().enumerate() {
        let mass = json["bodies"][name]["mass"].as_f64().unwrap_or(0.5);
        json["parameters"][format!("mass{number}")] = json!(format!("{mass:e} kg"));
        json["bodies"][name]["mass"] = json!(format!("=mass{number}"));
        responses.insert(format!("x{number}"), json!(format!("last({name}.x)")));
        responses.insert(
            format!("angle{number}"),
            json!(format!("max({name}.angle)")),
        );
    }
    for (number, name) in model.joints.keys().enumerate() {
        responses.insert(
            format!("f{number}"),
            json!(format!("mean(joint.{name}.fy)")),
        );
    }
    if is_held {
        for (number, name) in model.drivers.keys().enumerate() {
            let effort = format!("min(driver.{name}.effort)");
            responses.insert(format!("effort{number}"), json!(effort));
        }
    }
    json["responses"] = Value::Object(responses);
    linkdyn_model::load(json.to_string().as_bytes(), &[]).ok()
}

/// All models at rest, with their names.
fn all() -> impl Iterator<Item = (String, Loaded)> {
    models::all().into_iter().flat_map(|named| {
        [true, false].into_iter().filter_map(move |is_held| {
            let held = if is_held { "held" } else { "hanging" };
            Some((
                format!("{} {held}", named.name),
                at_rest(&named.json, is_held)?,
            ))
        })
    })
}

#[test]
fn variants_at_rest_are_the_models_that_they_are() {
    let (mut found_some, mut compared) = (0, 0);
    for (index, (name, loaded)) in all().enumerate() {
        let Some(family) = family_of(&loaded) else {
            continue;
        };
        let mut random = Random(index as u64);
        let mut member = family.begin();
        let count = family.responses().len();
        for part in [1e-4, 0.02, 0.3] {
            let values = off(&loaded, part, &mut random);
            let (status, found) = beside(&mut member, &values, count);
            let (expected, answers) = alone(&family, &values);
            assert_eq!(status, expected, "{name} {part}");
            found_some += usize::from(status == Some(Status::Completed));
            let bits = |all: &[f64]| all.iter().map(|own| own.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&found), bits(&answers), "{name} {part}");
            compared += found.len();
        }
    }
    assert!(
        found_some >= 60 && compared >= 2000,
        "{found_some} {compared}"
    );
}

#[test]
fn gradients_at_rest_are_those_of_central_differences() {
    let mut random = Random(41);
    let (mut known, mut unknown, mut faults) = (0, 0, Vec::new());
    for (name, loaded) in all() {
        let Some(family) = family_of(&loaded).filter(|own| own.parameters() <= MOST) else {
            continue;
        };
        let mut tally = Tally::default();
        compare(&name, (&loaded, &family), &mut random, &mut tally);
        let Tally {
            known: own,
            unknown: not,
            worst,
            what,
        } = tally;
        println!("{name:50} {own:4} {not:4} {worst:.1e} {what}");
        known += own;
        unknown += not;
        if worst > ALLOWED {
            faults.push(format!("{worst:e} {what}"));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    println!("{known} known, {unknown} not");
    assert!(
        known >= 5_000 && unknown <= known / 4,
        "{known} known, {unknown} not"
    );
}

/// The status of what has no equilibrium, and the message of what is no legal model, are those of a run.
#[test]
fn what_fails_fails_as_a_run_does() {
    let mut model = lever(json!({}), json!({}), 0.3);
    model["gravity"] = json!([0.0, 0.0]);
    model["forces"] =
        json!({ "t": { "type": "torque", "body": "rod", "value": "=push*a - 6 N*m" } });
    model["responses"] = json!({ "r": "last(rod.angle)", "p": "2*push" });
    let loaded = linkdyn_model::load(model.to_string().as_bytes(), &[]).expect("sound");
    let family = Family::new(&loaded, &["push", "mass"], Given::Values).expect("it runs");
    let mut member = family.begin();
    for values in [[15.0, 2.0], [18.0, 2.0], [15.0, 3.0]] {
        let found = beside(&mut member, &values, 2);
        let expected = alone(&family, &values);
        assert_eq!(found.0, expected.0, "{values:?}");
        let bits = |all: &[f64]| all.iter().map(|own| own.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&found.1), bits(&expected.1), "{values:?}");
    }
    let said = |found: Result<_, linkdyn_model::error::Complaints>| format!("{:?}", found.err());
    let mut responses = [0.0; 2];
    let own = member.run(&[15.0, -1.0], &Control::default(), &mut responses);
    assert_eq!(
        said(own.map(|_| ())),
        said(family.model(&[15.0, -1.0]).map(|_| ()))
    );
}
