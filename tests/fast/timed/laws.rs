//! Turned, mirrored, renamed and in another scale, what closes and opens does the same.

use super::*;

/// What a run tells: times at which something closes and opens, and what it loses.
fn told(model: &Value) -> Vec<f64> {
    let run = completed(model);
    let mut told = [times(&run, EventKind::Close), times(&run, EventKind::Open)].concat();
    told.extend(episodes(&run).iter().flat_map(|(_, episode)| {
        [
            episode.start,
            episode.end.unwrap_or(-1.0),
            episode.energy_lost,
        ]
    }));
    told
}

#[track_caller]
fn same(found: &[f64], expected: &[f64], factors: [f64; 2]) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        let factor = match (k >= 2 && k % 3 == 1, *expected) {
            (true, _) => factors[1],
            (false, expected) if expected < 0.0 => 1.0,
            (false, _) => factors[0],
        };
        near(
            *found,
            factor * expected,
            1e-9 * (factor * expected).abs().max(1e-3),
        );
    }
}

fn hooked(flight: &Flight, from: &str) -> Value {
    let joint = json!({ "type": "revolute", "between": ["one.H", "two.H"],
        "active": { "from": from, "until": "time >= 0.8 s" } });
    flight.model(&joint)
}

#[test]
fn it_does_not_matter_how_it_is_told() {
    let angles = [0.3, -0.4];
    let plain = told(&hooked(&flight(angles), "two.angle >= -0.4 rad"));
    assert_eq!(plain.len(), 5, "{plain:?}");

    let mut turned_by = flight([angles[0] + 0.7, angles[1] + 0.7]);
    for k in 0..2 {
        turned_by.places[k] = turned(flight(angles).places[k], 0.7);
        turned_by.velocities[k] = turned(flight(angles).velocities[k], 0.7);
    }
    let said = told(&hooked(&turned_by, "two.angle - 0.7 rad reaches -0.4 rad"));
    same(&said, &plain, [1.0; 2]);

    let mut mirrored = flight(angles);
    for k in 0..2 {
        mirrored.hooks[k][1] *= -1.0;
        mirrored.places[k][1] *= -1.0;
        mirrored.velocities[k][1] *= -1.0;
        mirrored.angles[k] *= -1.0;
        mirrored.omegas[k] *= -1.0;
    }
    same(
        &told(&hooked(&mirrored, "two.angle ≤ 0.4 rad")),
        &plain,
        [1.0; 2],
    );

    let mut large = flight(angles);
    for k in 0..2 {
        large.masses[k] *= 3.0;
        large.inertias[k] *= 300.0;
        for axis in 0..2 {
            large.hooks[k][axis] *= 10.0;
            large.places[k][axis] *= 10.0;
            large.velocities[k][axis] *= 10.0;
        }
    }
    same(
        &told(&hooked(&large, "two.angle >= -0.4 rad")),
        &plain,
        [1.0, 300.0],
    );

    let text = hooked(&flight(angles), "two.angle >= -0.4 rad").to_string();
    let renamed = text.replace("two", "second").replace("one", "first");
    let renamed = serde_json::from_str(&renamed).expect("still JSON");
    same(&told(&renamed), &plain, [1.0; 2]);
}

/// A clutch the other way round in the mirror, and between its bodies the other way round.
#[test]
fn a_clutch_has_a_mirror() {
    let run = |way: &str, sign: f64, swapped: bool| {
        let mut model = shaft([0.5, 0.3], [0.0, 0.0], &json!({ "one_way": way }), 3.0);
        if swapped {
            model["joints"]["clutch"]["between"] = json!(["load.O", "rotor.O"]);
        }
        model["forces"] = json!({
            "motor": { "type": "torque", "body": "rotor", "value": format!("={} N*m*cos(3 rad/s*time)", 2.0 * sign) },
            "drag": { "type": "torque", "body": "load", "value": -0.4 * sign } });
        let run = completed(&model);
        let last = *column(&run, "load.angle").last().expect("rows");
        let ends = episodes(&run)
            .iter()
            .filter_map(|(_, episode)| episode.end)
            .collect::<Vec<f64>>();
        (last * sign, ends)
    };
    let (angle, ends) = run("forward", 1.0, false);
    // Swapped, the angle of the rotor in the load must not grow.
    for (way, sign, swapped) in [("backward", -1.0, false), ("backward", 1.0, true)] {
        let (other, others) = run(way, sign, swapped);
        near(other, angle, 1e-10);
        assert_eq!(ends.len(), others.len());
        ends.iter()
            .zip(&others)
            .for_each(|(end, other)| near(*other, *end, 1e-10));
    }
}
