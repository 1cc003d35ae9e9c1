//! Contacts that hold one body between them, and come to rest together.

use super::*;

#[test]
fn a_disc_comes_to_rest_in_a_groove() {
    let groove = json!([[2.0, 1.2], [0.0, 0.0], [-2.0, 1.2]]);
    let (cos, start) = (2.0 / 2.0_f64.hypot(1.2), 0.6);
    for restitution in [0.0, 0.1, 0.5] {
        let run = completed(&disc(
            [0.3, start],
            [0.0; 2],
            groove.clone(),
            json!({ "restitution": restitution }),
            2.0,
        ));
        near(last(&run, "disc.x"), 0.0, 1e-12);
        near(last(&run, "disc.y"), RADIUS / cos, 1e-12);
        near(last(&run, "joint.t.fy"), GRAVITY, 1e-11);
        let fallen = GRAVITY * (start - RADIUS / cos);
        near(last(&run, "energy.dissipated"), fallen, 1e-8);
        let events = run.report.events.len();
        assert!(events < 100, "{restitution}: {events} events");
    }
}

/// The load of the wheel and the weight of the pawl hold the pawl in the root of a tooth, each against one flank: an impact on one
/// throws the pawl off the other.
#[test]
fn a_pawl_comes_to_rest_in_the_root_of_a_tooth() {
    let bodies = json!({
        "ground": { "points": { "W": [0.0, 0.0], "P": [-0.06, 0.05] } },
        "wheel": { "mass": 0.5, "inertia": 4e-4, "com": [0.0, 0.0], "points": { "W": [0.0, 0.0] } },
        "pawl": { "mass": 0.1, "inertia": 6e-5, "com": [0.025, 0.0], "points": { "P": [0.0, 0.0], "T": [0.06, 0.0] },
            "pose": { "position": [-0.06, 0.05], "angle": 5.0_f64.to_radians() } } });
    let teeth = json!({ "type": "contact", "between": ["wheel.W", "pawl.T"], "radius": 0.002, "repeat": 12, "restitution": 0.1,
        "outline": [[0.04, 0.0], [0.05, 0.0], [0.034641016, 0.02]] });
    let (axle, pivot) = (pin("ground.W", "wheel.W"), pin("ground.P", "pawl.P"));
    let mut model = model(
        bodies,
        json!({ "axle": axle, "pivot": pivot, "teeth": teeth }),
        json!({}),
    );
    model["forces"] = json!({ "load": { "type": "torque", "body": "wheel", "value": "=0.05 N*m*sin(2*pi*t/(0.5 s))" } });
    model["gravity"] = json!([0.0, -GRAVITY]);
    model["analysis"] = json!({ "type": "dynamics", "end": 1.5, "outputs": 31 });
    let run = completed(&model);
    let events = run.report.events.len();
    assert!((50..200).contains(&events), "{events} events");
}

/// A beam of half length b let down on one end after the other: an impact of one end lifts the other by ρ = (I − m b²)/(I + m b²) of its
/// speed. From rest with one end h high it rests after t₁ (1 + 2ρ + 2ρ² + …) = t₁ I/(m b²), t₁² = h (I + m b²)/(m b² g), without end
/// of smaller and smaller impacts.
#[test]
fn a_beam_rocks_from_end_to_end_until_it_rests() {
    let (b, lift) = (0.5, 1e-4);
    for inertia in [0.5, 1.5] {
        let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
            "beam": { "mass": 1.0, "inertia": inertia, "com": [0.0, 0.0], "points": { "A": [-b, 0.0], "B": [b, 0.0] },
                      "pose": { "position": [0.0, 0.5 * lift], "angle": f64::asin(0.5 * lift / b) } } });
        let end = |point: &str| json!({ "type": "contact", "between": ["ground.O", point], "outline": floor() });
        let mut beam = model(
            bodies,
            json!({ "a": end("beam.A"), "b": end("beam.B") }),
            json!({}),
        );
        beam["gravity"] = json!([0.0, -GRAVITY]);
        beam["initial"] =
            json!({ "beam": { "x": 0.0, "y": 0.5 * lift, "angle": f64::asin(0.5 * lift / b) } });
        let first = (lift * (inertia + b * b) / (b * b * GRAVITY)).sqrt();
        let rests = first * inertia / (b * b);
        beam["analysis"] = json!({ "type": "dynamics", "end": 1.2 * rests, "outputs": 25, "solver": { "rtol": 1e-9 } });
        let run = completed(&beam);
        let events = &run.report.events;
        let hits = events
            .iter()
            .filter(|event| event.kind == EventKind::Contact && event.time > 0.0);
        let hits: Vec<f64> = hits.map(|event| event.time).collect();
        let ratio = (inertia - b * b) / (inertia + b * b);
        let mut known = first;
        for (k, hit) in hits.iter().enumerate().take(4) {
            // an impact is located a little below the surface, later the slower it is, and the beam leans by 1e-4
            near(*hit, known, 1e-6 * rests);
            known += 2.0 * first * ratio.powi(1 + i32::try_from(k).expect("few"));
        }
        // What is left of the series is by rebounds that are lower than round-off.
        let end = hits.last().expect("it falls");
        assert!((0.9 * rests..rests).contains(end), "{end} of {rests}");
        // Flights are lower by ρ² each, down to 1e-9 of the mechanism's 1 m.
        let enough = (lift / 1e-9).ln() / (-2.0 * ratio.ln());
        near(hits.len() as f64, enough, 1.0);
        for name in ["joint.a.fy", "joint.b.fy"] {
            near(last(&run, name), 0.5 * GRAVITY, 1e-9);
        }
        near(last(&run, "beam.angle"), 0.0, 1e-9);
        let stops = &run.report.stops;
        let lost: f64 = stops.iter().map(|sums| sums.energy_lost).sum();
        near(lost, 0.5 * GRAVITY * lift, 1e-9 * GRAVITY);
    }
}
