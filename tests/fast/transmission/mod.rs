//! Transmission angles where the output's point stands still: on a carrier that is welded to ground, or that another driver holds.

mod slides;

use crate::models;
use crate::transform;
use linkdyn_engine::analysis::derived::derived;
use linkdyn_model::Model;
use linkdyn_output::Trajectory;
use serde_json::{Value, json};

/// A bucket on a stick that is welded to ground.
const WELDED: &str = include_str!("../../cases/transmission-angle-noise.json");

fn welded() -> Value {
    serde_json::from_str(WELDED).expect("JSON")
}

/// The same with the stick's points on ground.
fn grounded() -> Value {
    let mut model = welded();
    let points = model["bodies"]["stick"]["points"].clone();
    let ground = model["bodies"]["ground"]["points"]
        .as_object_mut()
        .expect("points");
    ground.extend(points.as_object().expect("points").clone());
    model["bodies"]
        .as_object_mut()
        .expect("bodies")
        .remove("stick");
    model["joints"]
        .as_object_mut()
        .expect("joints")
        .remove("stick pin");
    for joint in model["joints"]
        .as_object_mut()
        .expect("joints")
        .values_mut()
    {
        for end in joint["between"].as_array_mut().expect("ends") {
            *end = json!(end.as_str().expect("text").replace("stick.", "ground."));
        }
    }
    model
}

/// The same with the stick turned by a driver of its own.
fn held(motion: Value) -> Value {
    let mut model = welded();
    model["joints"]["stick pin"] =
        json!({ "type": "revolute", "between": ["ground.B", "stick.B"] });
    model["drivers"]["stick cylinder"] =
        json!({ "type": "rotation", "body": "stick", "motion": motion });
    model
}

fn transmitted(model: &Model) -> (Trajectory, Vec<String>) {
    derived(&models::checked(model), models::solve(model).all())
}

#[track_caller]
fn column(table: &Trajectory, name: &str) -> Vec<f64> {
    table
        .values(name)
        .unwrap_or_else(|| panic!("no column {name}"))
}

/// Same numbers to round-off, same empty cells.
#[track_caller]
fn same(ours: &[f64], known: &[f64], tolerance: f64) {
    assert_eq!(ours.len(), known.len());
    for (row, (a, b)) in ours.iter().zip(known).enumerate() {
        assert!(
            a.is_nan() == b.is_nan() && (a.is_nan() || (a - b).abs() <= tolerance),
            "row {row}: {a} and {b}"
        );
    }
}

/// By the triangle of link and bucket: the angle between the lines K–L and N–L, folded into 0 … 90°.
fn triangle(model: &Model) -> Vec<f64> {
    let outcome = models::solve(model);
    let at = |body: &str, point: &str| -> Vec<[f64; 2]> {
        let [x, y] = model.bodies[body].points[point];
        if body == "ground" {
            return vec![[x, y]; outcome.trajectory.len()];
        }
        let of = |quantity: &str| models::values(&outcome, &format!("{body}.{quantity}"));
        let place = |((ox, oy), angle): ((f64, f64), f64)| {
            let (sin, cos) = angle.sin_cos();
            [ox + cos * x - sin * y, oy + sin * x + cos * y]
        };
        of("x")
            .into_iter()
            .zip(of("y"))
            .zip(of("angle"))
            .map(place)
            .collect()
    };
    let (k, l, n) = (at("link", "K"), at("link", "L"), at("bucket", "N"));
    let angle = |row: usize| {
        let [a, b] = [k[row], n[row]].map(|end| [end[0] - l[row][0], end[1] - l[row][1]]);
        (a[0] * b[1] - a[1] * b[0])
            .abs()
            .atan2((a[0] * b[0] + a[1] * b[1]).abs())
    };
    (0..l.len()).map(angle).collect()
}

#[test]
fn a_welded_carrier_transmits_like_ground() {
    let (ours, notes) = transmitted(&models::load(&welded()));
    let model = models::load(&grounded());
    let (known, said) = transmitted(&model);
    same(
        &column(&ours, "transmission.H.angle"),
        &column(&known, "transmission.H.angle"),
        1e-12,
    );
    same(
        &column(&ours, "transmission.H.angle"),
        &triangle(&model),
        1e-12,
    );
    same(
        &column(&ours, "transmission.ratio"),
        &column(&known, "transmission.ratio"),
        1e-9,
    );
    assert!(
        column(&ours, "transmission.nose.angle")
            .iter()
            .all(|angle| angle.is_nan())
    );
    assert_eq!(
        notes,
        [
            "transmission.nose.angle is empty in all rows: bucket stands still at this joint while bucket cylinder alone moves, so that \
          its velocity there has no direction"
        ]
    );
    assert!(
        known.column_index("transmission.nose.angle").is_none() && said.is_empty(),
        "{said:?}"
    );
}

#[test]
fn a_carrier_that_another_driver_holds_transmits_like_ground() {
    let motions = [
        json!({ "type": "constant_velocity", "velocity": 0 }),
        json!({ "type": "constant_velocity", "velocity": "-9 deg/s" }),
    ];
    for motion in motions {
        let model = models::load(&held(motion));
        let (ours, notes) = transmitted(&model);
        same(
            &column(&ours, "transmission.H.angle"),
            &triangle(&model),
            1e-11,
        );
        assert!(
            column(&ours, "transmission.nose.angle")
                .iter()
                .all(|angle| angle.is_nan())
        );
        assert_eq!(notes.len(), 1, "{notes:?}");
    }
    // The other way round the stick moves the nose, and the link follows the held rocker.
    let mut model = held(json!({ "type": "constant_velocity", "velocity": "-9 deg/s" }));
    model["analysis"]["transmission"]["driver"] = json!("stick cylinder");
    let (ours, _) = transmitted(&models::load(&model));
    same(&column(&ours, "transmission.ratio"), &vec![1.0; 301], 1e-9);
    assert!(
        column(&ours, "transmission.nose.angle")
            .iter()
            .all(|angle| angle.is_finite())
    );
}

#[test]
fn transmission_angles_do_not_depend_on_place_hand_and_size() {
    for original in [
        welded(),
        held(json!({ "type": "constant_velocity", "velocity": "-9 deg/s" })),
    ] {
        let model = models::load(&original);
        let (known, _) = transmitted(&model);
        let mut copies = vec![
            transform::rotate(&model, 0.7),
            transform::mirror(&model),
            transform::swap(&model),
        ];
        for unit in ["um", "m", "km"] {
            let mut scaled = original.clone();
            scaled["units"]["length"] = json!(unit);
            copies.push(models::load(&scaled));
        }
        for copy in &copies {
            let (ours, notes) = transmitted(copy);
            for name in ["transmission.H.angle", "transmission.nose.angle"] {
                same(&column(&ours, name), &column(&known, name), 1e-10);
            }
            assert_eq!(notes.len(), 1, "{notes:?}");
        }
    }
}

/// A rocker at its limit stands still, and only there.
#[test]
fn an_output_that_turns_back_leaves_one_cell_empty() {
    // Crank and coupler in line: |O2 B| = 350 at the outer limit.
    let start = ((350.0_f64.powi(2) + 300.0_f64.powi(2) - 200.0_f64.powi(2))
        / (2.0 * 350.0 * 300.0))
        .acos();
    let motion = format!(
        r#"drivers.motor.motion={{"type":"constant_velocity","start":"{start} rad","velocity":"1 rad/s"}}"#
    );
    let sets = [r#"analysis.transmission={"output":"rocker"}"#, &motion];
    let model = models::load_bundled("four-bar", &sets);
    let (ours, notes) = transmitted(&model);
    let angle = column(&ours, "transmission.c.angle");
    assert!(
        angle[0].is_nan() && angle[1..].iter().all(|angle| angle.is_finite()),
        "{angle:?}"
    );
    let advantage = column(&ours, "transmission.advantage");
    assert!(
        advantage[0].is_nan() && advantage[1..].iter().all(|advantage| advantage.is_finite()),
        "{advantage:?}"
    );
    assert!(
        notes.len() == 2
            && notes
                .iter()
                .all(|note| note.contains("is empty in 1 of 401 rows")),
        "{notes:?}"
    );
}

/// Four-bar: Alt's transmission angle from the triangle coupler, rocker, diagonal; the ratio of the velocities.
#[test]
fn transmission_of_a_four_bar_is_that_of_its_triangle() {
    let model = models::load_bundled(
        "four-bar",
        &[r#"analysis.transmission={"output":"rocker"}"#],
    );
    let outcome = models::solve(&model);
    let (derived, notes) = derived(&models::checked(&model), outcome.all());
    assert!(notes.is_empty(), "{notes:?}");
    let joint = model.joints.iter().find(|(_, joint)| {
        let bodies = joint.between.each_ref().map(|end| end.body.as_str());
        bodies == ["coupler", "rocker"] || bodies == ["rocker", "coupler"]
    });
    let (name, joint) = joint.expect("a joint between coupler and rocker");
    let angle = derived
        .values(&format!("transmission.{name}.angle"))
        .expect("an angle");
    let (ratio, advantage) = (
        derived.values("transmission.ratio"),
        derived.values("transmission.advantage"),
    );
    let (ratio, advantage) = (ratio.expect("a ratio"), advantage.expect("an advantage"));
    let place = |body: &str, point: &str, row: usize| {
        let [x, y] = model.bodies[body].points[point];
        let of = |q: &str| {
            if body == "ground" {
                0.0
            } else {
                models::values(&outcome, &format!("{body}.{q}"))[row]
            }
        };
        let (sin, cos) = of("angle").sin_cos();
        [of("x") + cos * x - sin * y, of("y") + sin * x + cos * y]
    };
    // The other ends of the two links.
    let far = |body: &str, not: &str| {
        let other = model
            .joints
            .values()
            .flat_map(|joint| &joint.between)
            .find(|end| end.body == body && end.point != not);
        other.expect("another end").point.clone()
    };
    let [coupler_end, rocker_end] = ["coupler", "rocker"].map(|body| {
        let end = joint
            .between
            .iter()
            .find(|end| end.body == body)
            .expect("an end");
        (end.point.clone(), far(body, &end.point))
    });
    let [crank_omega, rocker_omega] =
        ["crank", "rocker"].map(|body| models::values(&outcome, &format!("{body}.omega")));
    for row in (0..outcome.trajectory.len()).step_by(7) {
        let pin = place("coupler", &coupler_end.0, row);
        let along = |end: [f64; 2]| [end[0] - pin[0], end[1] - pin[1]];
        let (a, b) = (
            along(place("coupler", &coupler_end.1, row)),
            along(place("rocker", &rocker_end.1, row)),
        );
        let between = (a[0] * b[1] - a[1] * b[0])
            .abs()
            .atan2((a[0] * b[0] + a[1] * b[1]).abs());
        assert!(
            (angle[row] - between).abs() < 1e-9,
            "row {row}: {} and {between}",
            angle[row]
        );
        let expected = rocker_omega[row] / crank_omega[row];
        assert!(
            (ratio[row] - expected).abs() < 1e-9 * expected.abs().max(1.0),
            "row {row}: {} and {expected}",
            ratio[row]
        );
        assert!((advantage[row] * ratio[row] - 1.0).abs() < 1e-12);
    }
}

/// Slider-crank in closed form: x = r cos θ + √(l² − r² sin² θ), the angle between rod and the normal of the guide; and a driver at rest.
#[test]
fn transmission_of_a_slider_crank_is_its_closed_form() {
    for motion in ["{}", r#"{"type":"polynomial","coefficients":[40]}"#] {
        let mut sets =
            vec![r#"analysis.transmission={"driver":"motor","output":"piston"}"#.to_string()];
        sets.extend((motion != "{}").then(|| format!("drivers.motor.motion={motion}")));
        let model = models::load_bundled(
            "slider-crank",
            &sets.iter().map(String::as_str).collect::<Vec<_>>(),
        );
        let outcome = models::solve(&model);
        let (derived, _) = derived(&models::checked(&model), outcome.all());
        assert_eq!(
            derived.columns[derived.column_index("transmission.ratio").expect("a ratio")].unit,
            "m/rad"
        );
        let ratio = derived.values("transmission.ratio").expect("a ratio");
        let angle = derived
            .values("transmission.wristpin.angle")
            .expect("an angle");
        let (r, l) = (0.05_f64, 0.2_f64);
        for (row, theta) in models::values(&outcome, "crank.angle")
            .into_iter()
            .enumerate()
        {
            let root = (l * l - (r * theta.sin()).powi(2)).sqrt();
            let expected = -r * theta.sin() - r * r * theta.sin() * theta.cos() / root;
            assert!(
                (ratio[row] - expected).abs() < 1e-12,
                "row {row}: {} and {expected}",
                ratio[row]
            );
            let between = (root / l).asin();
            // In the dead centres the piston has no velocity, and μ no meaning.
            assert!(
                angle[row].is_nan() || (angle[row] - between).abs() < 1e-7,
                "row {row}: {} and {between}",
                angle[row]
            );
        }
        assert!(
            angle.iter().filter(|angle| angle.is_nan()).count() <= 3,
            "{angle:?}"
        );
    }
}

#[test]
fn a_transmission_that_the_drivers_do_not_determine_is_said_to_be_none() {
    // A pendulum beside the driven mechanism.
    let sets = [
        r#"analysis={"type":"dynamics","end":0.1,"outputs":3,"transmission":{"driver":"motor","output":"arm"}}"#,
        r#"bodies.bob={"mass":1,"inertia":0.1,"com":[0,0],"points":{"P":[100,0]}}"#,
        r#"joints.swing={"type":"revolute","between":["ground.O","bob.P"]}"#,
    ];
    let model = models::load_bundled("quick-return", &sets);
    let (derived, notes) = derived(&models::checked(&model), models::solve(&model).all());
    assert!(derived.column_index("transmission.ratio").is_none());
    assert!(
        notes.len() == 1 && notes[0].contains("do not determine the motion"),
        "{notes:?}"
    );
}
