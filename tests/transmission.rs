//! Transmission angles where the output's point stands still: on a carrier that is welded to ground, or that another driver holds.

#[path = "common/models.rs"]
mod models;
#[path = "common/transform.rs"]
mod transform;

use linkdyn_engine::analysis::derived::derived;
use linkdyn_model::Model;
use linkdyn_output::Trajectory;
use serde_json::{Value, json};

/// A bucket on a stick that is welded to ground.
const WELDED: &str = include_str!("cases/transmission-angle-noise.json");

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
    derived(model, models::solve(model).all())
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
    assert!(
        notes.len() == 1 && notes[0].contains("is empty in 1 of 401 rows"),
        "{notes:?}"
    );
}
