//! Joints that latch at their ends.

use super::*;

/// Two bodies float, hinged to each other, and latch: momenta stay, and what is lost is what the one body that they are then
/// does not have.
#[test]
fn floating_bodies_latch() {
    let bodies = json!({
        "one": { "mass": 2.0, "inertia": 0.05, "com": [0.1, 0.02], "points": { "H": [0.3, 0.0] } },
        "two": { "mass": 1.0, "inertia": 0.03, "com": [0.2, -0.01], "points": { "H": [0.0, 0.0] },
                 "pose": { "position": [0.3, 0.0], "angle": 0.2 } } });
    let mut hinge = pin("one.H", "two.H");
    join(
        &mut hinge,
        &json!({ "limits": [null, 1.2], "latch": "upper" }),
    );
    let mut model = model(bodies, json!({ "h": hinge }), json!({}));
    model["gravity"] = json!([0.0, 0.0]);
    model["initial"] = json!({ "one": { "x": 0.0, "y": 0.0, "angle": 0.0, "vx": 0.3, "vy": -0.2, "angular_velocity": -0.5 },
        "two": { "angle": 0.2, "angular_velocity": 3.0 } });
    model["analysis"] =
        json!({ "type": "dynamics", "end": 1.0, "outputs": 21, "solver": { "rtol": 1e-12 } });
    let run = completed(&model);
    let of = |name: &str| column(&run, name);
    let body = |name: &str, mass: f64, inertia: f64, [a, b]: [f64; 2]| {
        let [x, y, angle, vx, vy, omega] =
            ["x", "y", "angle", "vx", "vy", "omega"].map(|word| of(&format!("{name}.{word}")));
        move |k: usize| {
            let (sin, cos) = angle[k].sin_cos();
            let rho = [a * cos - b * sin, a * sin + b * cos];
            let place = [x[k] + rho[0], y[k] + rho[1]];
            let rate = [vx[k] - omega[k] * rho[1], vy[k] + omega[k] * rho[0]];
            let spin = inertia * omega[k] + mass * (place[0] * rate[1] - place[1] * rate[0]);
            (
                [mass * rate[0], mass * rate[1], spin],
                [mass * place[0], mass * place[1]],
            )
        }
    };
    let (one, two) = (
        body("one", 2.0, 0.05, [0.1, 0.02]),
        body("two", 1.0, 0.03, [0.2, -0.01]),
    );
    let all = |k: usize| {
        let ((p, r), (q, s)) = (one(k), two(k));
        (
            [p[0] + q[0], p[1] + q[1], p[2] + q[2]],
            [r[0] + s[0], r[1] + s[1]],
        )
    };
    let last = of("time").len() - 1;
    let (before, after) = (all(0).0, all(last).0);
    for (before, after) in before.iter().zip(after) {
        near(after, *before, 1e-12);
    }
    // One body: its energy is that of its momenta.
    let ([px, py, spin], [mx, my]) = all(last);
    let mass = 3.0;
    let about = spin - (mx * py - my * px) / mass;
    let (h1, h2) = (two(last).1, one(last).1);
    let gap = [h1[0] / 1.0 - h2[0] / 2.0, h1[1] / 1.0 - h2[1] / 2.0];
    let inertia = 0.08 + 2.0 / mass * (gap[0] * gap[0] + gap[1] * gap[1]);
    let rigid = 0.5 * ((px * px + py * py) / mass + about * about / inertia);
    let kinetic = of("energy.kinetic");
    near(kinetic[last], rigid, 1e-12);
    let (event, episode) = contacts(&run)[0].clone();
    assert_eq!((event.stop, event.end_time), (Some("upper"), None));
    near(episode.energy_lost, kinetic[0] - rigid, 1e-11);
    near(of("two.angle")[last] - of("one.angle")[last], 1.2, 1e-12);
    let kinds: Vec<EventKind> = run.report.events.iter().map(|event| event.kind).collect();
    assert!(kinds.contains(&EventKind::Latch), "{kinds:?}");
}

/// A latch opens where it is pulled by more than it holds, and may close again.
#[test]
fn a_latch_opens_above_its_pull() {
    let mut model = rod(
        0.0,
        &json!({ "limits": [-1.0, 0.0], "latch": "upper", "release": 12.0 }),
        3.0,
    );
    // The weight pulls with 9.81 N·m, the torque with the rest; then it turns round.
    model["forces"] = json!({ "m": { "type": "torque", "body": "rod",
        "value": "=table(time; 0 s, 0 N*m; 1 s, -4 N*m; 1.5 s, 30 N*m; 4 s, 30 N*m)" } });
    let run = completed(&model);
    let at = |wanted: EventKind| {
        let events = run.report.events.iter();
        let times = events
            .filter(|event| event.kind == wanted)
            .map(|event| event.time);
        times.collect::<Vec<f64>>()
    };
    let (closed, opened) = (at(EventKind::Latch), at(EventKind::Unlatch));
    assert_eq!(
        (closed.len(), opened.len()),
        (2, 1),
        "{closed:?} {opened:?}"
    );
    near(opened[0], (12.0 - GRAVITY) / 4.0, 1e-8);
    let (times, stop) = (column(&run, "time"), column(&run, "joint.o.stop"));
    for (t, stop) in times.iter().zip(&stop).filter(|(t, _)| **t < opened[0]) {
        near(*stop, GRAVITY + 4.0 * t, 1e-8);
    }
    near(*stop.last().expect("rows"), GRAVITY - 30.0, 1e-8);
    // At rest, too, what begins latched stays so.
    let mut model = rod(
        0.0,
        &json!({ "limits": [-1.0, 0.0], "latch": "upper" }),
        1.0,
    );
    model["analysis"] = json!({ "type": "statics" });
    let run = completed(&model);
    near(column(&run, "rod.angle")[0], 0.0, 1e-12);
    near(column(&run, "joint.o.stop")[0], GRAVITY, 1e-9);
}
