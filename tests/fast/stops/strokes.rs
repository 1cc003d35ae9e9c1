//! Springs and actuators whose stroke has ends, against closed forms.
//!
//! ```text
//! a mass on a spring between two stops at x = h and x = −d from where it is free, ω² = k/m:
//! from h with the speed u it is at −d after (arccos(−d/R) − arctan(u/ωh))/ω, R² = h² + u²/ω², with the speed ω √(R² − d²)
//! ```

use super::*;
use crate::mechanisms::momenta;

const STIFFNESS: f64 = 200.0;
const FREE: f64 = 0.5;

/// A block on a guide along x with an element between the ground's origin and it.
fn pushed(element: &Value, words: &Value, start: [f64; 2], end: f64) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "block": { "mass": MASS, "inertia": 0.1, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] },
                   "pose": { "position": [start[0], 0.0] } } });
    let guide =
        json!({ "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [1.0, 0.0] });
    let mut force = json!({ "between": ["ground.O", "block.P"] });
    join(&mut force, element);
    join(&mut force, words);
    let mut model = model(bodies, json!({ "g": guide }), json!({}));
    model["forces"] = json!({ "s": force });
    model["gravity"] = json!([0.0, -GRAVITY]);
    model["initial"] = json!({ "block": { "x": start[0], "vx": start[1] } });
    model["analysis"] =
        json!({ "type": "dynamics", "end": end, "outputs": 41, "solver": { "rtol": 1e-12 } });
    model
}

fn spring() -> Value {
    json!({ "type": "spring", "stiffness": STIFFNESS, "free_length": FREE })
}

fn actuator(force: f64) -> Value {
    json!({ "type": "actuator", "force": force })
}

#[test]
fn a_mass_on_a_spring_goes_between_two_stops() {
    let (lower, upper) = (0.42, 0.55);
    let omega = (STIFFNESS / MASS).sqrt();
    for e in [1.0, 0.9] {
        let stops = json!({ "limits": [lower, upper], "restitution": e });
        let run = completed(&pushed(&spring(), &stops, [FREE, 2.0], 1.5));
        let met = contacts(&run);
        let reach = [FREE - lower, upper - FREE];
        // from where the spring is free, outward
        let mut time = (reach[1] * omega / 2.0).asin() / omega;
        let mut speed = (4.0 - (omega * reach[1]).powi(2)).sqrt();
        let mut side = 1;
        assert!(met.len() > 10, "{}", met.len());
        for (event, episode) in &met[..10] {
            let word = ["lower", "upper"][side];
            assert_eq!(
                (event.joint.as_deref(), event.stop),
                (Some("force.s"), Some(word))
            );
            near(event.time, time, 1e-9 * time);
            near(episode.approach_speed, speed, 1e-9 * speed);
            near(
                episode.impulse,
                MASS * speed * (1.0 + e),
                1e-9 * MASS * speed,
            );
            let left = e * speed;
            let (from, to) = (reach[side], reach[1 - side]);
            let radius = from.hypot(left / omega);
            time += ((-to / radius).acos() - (left / omega).atan2(from)) / omega;
            speed = omega * (radius * radius - to * to).sqrt();
            side = 1 - side;
        }
        let imbalance = run.report.quality.energy_imbalance.expect("a ledger");
        assert!(imbalance < 1e-12, "{imbalance:e}");
        let sums = &run.report.stops;
        assert_eq!(
            sums.iter()
                .map(|sums| (sums.joint.as_str(), sums.stop))
                .collect::<Vec<_>>(),
            [("force.s", "lower"), ("force.s", "upper")]
        );
    }
}

/// A constant force drives a block against its stop, and rests there: flights are parabolas. With e = 1 none is lost.
#[test]
fn a_cylinder_comes_to_its_end() {
    let (stroke, force, e) = (0.3, 12.0, 0.5);
    let stops = json!({ "limits": [0.2, 0.9], "restitution": e });
    let run = completed(&pushed(&actuator(-force), &stops, [0.2 + stroke, 0.0], 3.0));
    let first = (2.0 * stroke * MASS / force).sqrt();
    let met = contacts(&run);
    let mut time = first;
    for (k, (event, _)) in met[..8].iter().enumerate() {
        near(event.time, time, 1e-9 * first);
        time += 2.0 * first * f64::powi(e, i32::try_from(k).expect("few") + 1);
    }
    let following = |event: &&Event| event.kind == EventKind::SustainedContact;
    let rests = run.report.events.iter().find(following).expect("it rests");
    near(rests.time, first * (1.0 + e) / (1.0 - e), 1e-9 * first);
    let last = |name: &str| *column(&run, name).last().expect("rows");
    near(last("force.s.stop"), force, 1e-9);
    near(last("force.s.f"), -force, 1e-12);
    near(last("force.s.length"), 0.2, 1e-9);
    let perfect = json!({ "limits": [0.2, null], "restitution": 1.0 });
    let run = completed(&pushed(
        &actuator(-force),
        &perfect,
        [0.2 + stroke, 0.0],
        5.0,
    ));
    assert!(contacts(&run).len() > 5);
    let imbalance = run.report.quality.energy_imbalance.expect("a ledger");
    assert!(imbalance < 1e-13, "{imbalance:e}");
}

/// Stops that yield: half a period of their spring, and what they sink by at rest; small motions there are those of both springs.
#[test]
fn stops_of_a_stroke_yield() {
    let stiff = 3e4;
    let stops = json!({ "limits": [0.2, null], "stop_stiffness": stiff });
    let run = completed(&pushed(&actuator(0.0), &stops, [0.3, -0.5], 0.5));
    let (event, episode) = contacts(&run)[0].clone();
    near(event.time, 0.2, 1e-10);
    let omega = (stiff / MASS).sqrt();
    near(
        episode.end.expect("it leaves") - event.time,
        PI / omega,
        1e-8 * PI / omega,
    );
    near(episode.peak_penetration, 0.5 / omega, 1e-9);
    let mut rests = pushed(
        &spring(),
        &json!({ "limits": [null, 0.45], "stop_stiffness": stiff }),
        [0.44, 0.0],
        1.0,
    );
    rests["initial"] = json!({});
    rests["analysis"] = json!({ "type": "statics" });
    let run = completed(&rests);
    let sunk = STIFFNESS * (FREE - 0.45) / (STIFFNESS + stiff);
    near(column(&run, "block.x")[0], 0.45 + sunk, 1e-12);
    near(column(&run, "force.s.stop")[0], -stiff * sunk, 1e-8);
    let found = analysis::modes(&loaded(&rests).model, false, &Control::default()).expect("modes");
    let known = ((STIFFNESS + stiff) / MASS).sqrt();
    near(found.modes[0].frequency(), known, 1e-9 * known);
}

/// A flap on a stay that has its full length at an angle of the law of cosines, where it hangs: the stay carries the moment of the
/// weight, the ground all of it.
#[test]
fn a_flap_hangs_on_its_stay() {
    let (height, arm, length): (f64, f64, f64) = (0.8, 1.2, 1.5);
    // The angle from the upright, down to the rod.
    let opened = ((height * height + arm * arm - length * length) / (2.0 * height * arm)).acos();
    let angle = 0.5 * PI - opened;
    let mut flap = rod(1.0, &json!({}), 2.0);
    flap["bodies"]["ground"]["points"]["G"] = json!([0.0, height]);
    flap["bodies"]["rod"]["points"]["S"] = json!([arm, 0.0]);
    flap["forces"] = json!({ "stay": { "type": "actuator", "between": ["ground.G", "rod.S"], "force": 0.0, "limits": [null, length] } });
    flap["analysis"]["solver"] = json!({ "rtol": 1e-12 });
    flap["responses"] = json!({ "fy": "last(shaking.fy)", "moment": "last(shaking.moment)" });
    let run = completed(&flap);
    let (event, episode) = contacts(&run)[0].clone();
    assert_eq!(
        (event.joint.as_deref(), event.end_time),
        (Some("force.stay"), None)
    );
    // ω² = m g (sin θ₀ − sin θ) · 2/I_O with the centre 1 m out, and L̇ = h r cos θ ω/L.
    let omega = (1.5 * GRAVITY * (f64::sin(1.0) - angle.sin())).sqrt();
    let rate = height * arm * angle.cos() * omega / length;
    near(episode.approach_speed, rate, 1e-9 * rate);
    let last = |name: &str| *column(&run, name).last().expect("rows");
    near(last("rod.angle"), angle, 1e-9);
    let pull = GRAVITY * angle.cos() * length / (height * arm * angle.cos());
    near(last("force.stay.stop"), -pull, 1e-8);
    let along = [
        arm * angle.cos() / length,
        (arm * angle.sin() - height) / length,
    ];
    near(last("joint.o.fx"), pull * along[0], 1e-8);
    near(last("joint.o.fy"), GRAVITY + pull * along[1], 1e-8);
    let told = |name: &str| {
        let found = run.responses.iter().find(|answer| answer.name == name);
        found.and_then(|answer| answer.value).expect("a number")
    };
    near(told("fy"), -GRAVITY, 1e-8);
    near(told("moment"), -GRAVITY * angle.cos(), 1e-8);
}

/// Two bodies in space on a rod that slides into itself: impacts at its ends change neither momentum, and with e = 1 not the energy.
#[test]
fn ends_of_a_stroke_keep_the_momentum() {
    let bodies = json!({
        "one": { "mass": 3.0, "inertia": 0.2, "com": [0.1, 0.0], "points": { "A": [0.3, 0.1] } },
        "two": { "mass": 1.0, "inertia": 0.05, "com": [0.2, -0.1], "points": { "B": [-0.1, 0.2] },
                 "pose": { "position": [0.9, -0.12], "angle": 0.2 } } });
    let mut pair = model(bodies, json!({}), json!({}));
    pair["gravity"] = json!([0.0, 0.0]);
    pair["forces"] = json!({ "s": { "type": "actuator", "between": ["one.A", "two.B"], "force": 0.0,
        "limits": [0.3, 0.7], "restitution": 1.0 } });
    pair["initial"] = json!({
        "one": { "vx": 0.5, "vy": 0.2, "angular_velocity": 3.0 },
        "two": { "vx": -0.4, "vy": 0.9, "angular_velocity": -2.0 } });
    pair["analysis"] = json!({ "type": "dynamics", "end": 5.0, "outputs": 51, "solver": { "rtol": 1e-12, "atol": 1e-14 } });
    let run = completed(&pair);
    assert!(contacts(&run).len() >= 5, "{}", contacts(&run).len());
    let bodies = [
        ("one", 3.0, 0.2, [0.1, 0.0]),
        ("two", 1.0, 0.05, [0.2, -0.1]),
    ];
    let sums = |row: usize| momenta(&run, row, &bodies);
    let first = sums(0);
    let kinetic = column(&run, "energy.kinetic");
    for row in 0..51 {
        for (ours, known) in sums(row).into_iter().zip(first) {
            near(ours, known, 1e-11);
        }
        near(kinetic[row], kinetic[0], 1e-11);
        let length = column(&run, "force.s.length")[row];
        assert!((0.3 - 1e-9..0.7 + 1e-9).contains(&length), "{length}");
    }
}

/// A start beyond the stroke is refused, and drivers that pass it are told of.
#[test]
fn starts_and_drivers_beyond_a_stroke_are_told() {
    let refused = |model: &Value| {
        let run = analysis::run(&loaded(model).model, &Control::default());
        run.expect_err("refused").to_string()
    };
    assert_eq!(
        refused(&pushed(
            &spring(),
            &json!({ "limits": [0.2, 0.4] }),
            [0.5, 0.0],
            1.0
        )),
        "forces.s.limits: the mechanism starts at 0.5 m, beyond the upper limit 0.4 m (it is the distance of its points: give wider \
         limits, or another start)"
    );
    let mut driven = pushed(
        &actuator(0.0),
        &json!({ "limits": [0.2, 0.8] }),
        [0.5, 0.0],
        1.0,
    );
    driven["initial"] = json!({});
    driven["drivers"] = json!({ "m": { "type": "length", "between": ["ground.O", "block.P"],
        "motion": { "type": "polynomial", "coefficients": [0.5, 0.4] } } });
    driven["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 5 });
    assert_eq!(
        completed(&driven).report.warnings,
        [
            "the drivers take force \"s\" beyond its upper limit 0.8 m, by 0.1 m at t = 1 s: a motion that is prescribed does not stop \
             there"
        ]
    );
}

/// Limits that can't be, in these words.
#[test]
fn faulty_limits_of_strokes_are_told() {
    let said = |element: &Value, words: &Value| {
        let model = pushed(element, words, [0.5, 0.0], 1.0).to_string();
        let faults = linkdyn_model::load(model.as_bytes(), &[]).expect_err("refused");
        let text = faults.to_string();
        text[text.find("forces.").unwrap_or(0)..].to_owned()
    };
    for (words, expected) in [
        (
            json!({ "limits": [0.9, 0.2] }),
            "forces.s.limits: the lower limit 0.9 m is not below the upper limit 0.2 m (write [lower, upper])",
        ),
        (
            json!({ "limits": [null, null] }),
            "forces.s.limits: neither end is given (give one of them, or leave \"limits\" out)",
        ),
        (
            json!({ "limits": [0.0, 0.2] }),
            "forces.s.limits: the lower limit 0 m is no length that its points could come to (a distance is above 0: give a greater \
             one, or null where the stroke has no end)",
        ),
        (
            json!({ "limits": [null, -0.2] }),
            "forces.s.limits: the upper limit -0.2 m leaves no stroke (it is the greatest distance of its points)",
        ),
        (
            json!({ "limits": ["10 deg", 0.2] }),
            "forces.s.limits[0]: \"10 deg\": \"deg\" is not a unit of length (such as \"m\")",
        ),
        (
            json!({ "limits": [0.2, 0.9], "stop_damping": 5.0 }),
            "forces.s.stop_damping: 5.0: \"stop_stiffness\" is missing: a stop with damping yields (give the stiffness of the stops, \
             or \"restitution\" instead of the damping)",
        ),
        (
            json!({ "limits": [0.2, 0.9], "stop_stiffness": 5.0, "restitution": 0.5 }),
            "forces.s.restitution: 0.5: the stops yield, since there is a \"stop_stiffness\": what they give back follows from \
             stiffness and damping (leave out one of them)",
        ),
        (
            json!({ "restitution": 0.5 }),
            "forces.s.restitution: 0.5: is of the stops at its limits, and there are no \"limits\" (as in \"limits\": [\"300 mm\", \
             \"500 mm\"])",
        ),
        (
            json!({ "limits": [0.2, 0.9], "restitution": 1.5 }),
            "forces.s.restitution: 1.5: must not be greater than 1",
        ),
    ] {
        assert_eq!(said(&spring(), &words), expected);
        assert_eq!(said(&actuator(1.0), &words), expected);
    }
}

/// Springs that are tightened and let go while they are stretched, beside a stop: what moves their free length or angle works by
/// −k (l − l₀) l̇₀, so that energies and losses make a whole. Without that part they would miss this much of it.
#[test]
fn what_moves_a_free_length_does_its_work() {
    let turns = |amplitude: f64, offset: f64| json!({ "type": "harmonic", "offset": offset, "amplitude": amplitude, "frequency": 1.3, "phase": 0.4 });
    let limits = json!({ "limits": [0.35, 0.6], "restitution": 0.8 });
    for damping in [0.0, 1.5] {
        let coil = json!({ "type": "spring", "stiffness": STIFFNESS, "damping": damping, "free_length": turns(0.1, FREE) });
        let mut model = pushed(&coil, &limits, [FREE, 0.0], 2.0);
        model["analysis"]["outputs"] = json!(2001);
        // A wheel beside it, whose spring winds it against a stop.
        model["bodies"]["wheel"] = json!({ "mass": 1.0, "inertia": 0.05, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] } });
        model["joints"]["axle"] = pin("ground.O", "wheel.C");
        join(
            &mut model["joints"]["axle"],
            &json!({ "limits": [-0.5, 0.5], "restitution": 0.7 }),
        );
        model["forces"]["wind"] = json!({ "type": "torsion_spring", "between": ["wheel", "ground"], "stiffness": 3.0,
            "damping": 0.02 * damping, "free_angle": turns(0.9, 0.1) });
        let run = completed(&model);
        let imbalance = run.report.quality.energy_imbalance.expect("a ledger");
        assert!(imbalance < 1e-10, "{imbalance:e}");
        // By the rows, to the trapezium rule at some twenty kinks: what was supplied is what there is and what was lost.
        let of = |name: &str| column(&run, name);
        let (time, x, angle) = (of("time"), of("block.x"), of("wheel.angle"));
        let power = |k: usize| {
            let phase = 2.0 * PI * 1.3 * time[k] + 0.4;
            let (wave, rate) = (phase.sin(), 2.0 * PI * 1.3 * phase.cos());
            let pull = STIFFNESS * (x[k] - FREE - 0.1 * wave) * 0.1 * rate;
            let wound = 3.0 * (-angle[k] - 0.1 - 0.9 * wave) * 0.9 * rate;
            -pull - wound
        };
        let (speed, omega) = (of("block.vx"), of("wheel.omega"));
        let braked = |k: usize| damping * (speed[k].powi(2) + 0.02 * omega[k].powi(2));
        let work: f64 = (1..time.len())
            .map(|k| {
                0.5 * (power(k - 1) + power(k) - braked(k - 1) - braked(k))
                    * (time[k] - time[k - 1])
            })
            .sum();
        let (kinetic, potential) = (of("energy.kinetic"), of("energy.potential"));
        let whole = |k: usize| kinetic[k] + potential[k];
        let lost: f64 = run.report.stops.iter().map(|sums| sums.energy_lost).sum();
        let gained = whole(time.len() - 1) - whole(0) + lost;
        assert!(
            (gained - work).abs() < 2e-3 * lost && lost > 0.5,
            "{gained} by the work of {work}, {lost} lost"
        );
    }
}
