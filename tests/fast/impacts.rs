//! Joints with clearance whose surfaces are rigid: flight, impacts, following, against closed forms.

use crate::mechanisms::{column, loaded};
use crate::rigid::rigid;
use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_output::{Episode, EventKind, Status};
use serde_json::{Value, json};

/// Radial clearance, and radius of the journal [m].
pub const CLEARANCE: f64 = 0.001;
pub const JOURNAL: f64 = 0.009;
pub const MASS: f64 = 2.0;
pub const INERTIA: f64 = 1e-4;

/// A disc in a bearing of the ground.
pub fn disc(impact: &Value, gravity: [f64; 2], initial: &Value, end: f64, outputs: usize) -> Value {
    json!({ "format": "linkdyn/1", "units": "SI", "gravity": gravity,
        "bodies": { "ground": { "points": { "O": [0.0, 0.0] } },
            "disc": { "mass": MASS, "inertia": INERTIA, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] } } },
        "joints": { "pin": { "type": "revolute", "between": ["ground.O", "disc.P"],
            "clearance": { "model": "three_state", "radius": CLEARANCE, "bearing_radius": CLEARANCE + JOURNAL,
                           "impact": impact } } },
        "initial": { "disc": initial },
        "analysis": { "type": "dynamics", "end": end, "outputs": outputs, "solver": { "rtol": 1e-9 } } })
}

#[track_caller]
pub fn completed(model: &Value) -> Outcome {
    let outcome =
        run(&loaded(model).model, &Control::default()).unwrap_or_else(|said| panic!("{said:?}"));
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    let imbalance = outcome
        .report
        .quality
        .energy_imbalance
        .expect("of contacts");
    assert!(imbalance < 1e-8, "{imbalance:e} of the energy missing");
    outcome
}

fn episodes(outcome: &Outcome) -> Vec<Episode> {
    outcome
        .report
        .events
        .iter()
        .filter_map(|event| event.episode)
        .collect()
}

/// Without gravity the disc flies along chords: an impact keeps the speed along the wall and turns round e of that across
/// it, so that tan β = v_t/v_n grows by 1/e, the chord's length is 2 c cos β, and the angle about the centre between impacts is π − 2 β.
#[test]
fn a_disc_without_gravity_is_a_billiard_ball() {
    for restitution in [1.0, 0.8] {
        let start = json!({ "x": 0.0005, "y": 0.0, "vx": 0.3, "vy": 0.4 });
        let outcome = completed(&disc(
            &json!({ "restitution": restitution, "friction": 0.0 }),
            [0.0, 0.0],
            &start,
            if restitution < 1.0 { 0.05 } else { 0.5 },
            11,
        ));
        let impacts = episodes(&outcome);
        // The first impact, from the chord through the start.
        let (x, speed) = (0.0005, [0.3, 0.4]);
        let (along, square) = (x * speed[0], 0.25);
        let mut time =
            (-along + (along * along + square * (CLEARANCE * CLEARANCE - x * x)).sqrt()) / square;
        // Angular momentum per mass stays; the rest of the speed is across the wall.
        let tangential = x * speed[1] / CLEARANCE;
        let mut across = (square - tangential * tangential).sqrt();
        let count = if restitution < 1.0 { 20 } else { 137 };
        assert!(impacts.len() >= count, "{}", impacts.len());
        for impact in &impacts[..count] {
            assert!(
                (impact.start / time - 1.0).abs() < 1e-10,
                "{} for {time}",
                impact.start
            );
            assert!(
                (impact.approach_speed / across - 1.0).abs() < 1e-10,
                "{} for {across}",
                impact.approach_speed
            );
            across *= restitution;
            let separation = impact.separation_speed.expect("it leaves");
            assert!(
                (separation / across - 1.0).abs() < 1e-10,
                "{separation} for {across}"
            );
            time += 2.0 * CLEARANCE * across / (across * across + tangential * tangential);
        }
        let last = |name: &str| *column(&outcome, name).last().expect("rows");
        let momentum = last("disc.x") * last("disc.vy") - last("disc.y") * last("disc.vx");
        assert!(
            (momentum / (x * speed[1]) - 1.0).abs() < 1e-10,
            "{momentum}"
        );
    }
}

/// One impact of a spinning disc that falls straight onto the wall: it slides all through it where μ is less than what
/// ends sliding, m_t v_t/((1 + e) m v_n) with 1/m_t = 1/m + r²/I, and else sticks.
#[test]
fn friction_in_an_impact_takes_impulse_along_the_wall() {
    let (restitution, fall, spin) = (0.6, 0.5, 40.0);
    let sliding = spin * JOURNAL;
    let tangential_mass = 1.0 / (1.0 / MASS + JOURNAL * JOURNAL / INERTIA);
    let stops = tangential_mass * sliding / ((1.0 + restitution) * MASS * fall);
    for friction in [0.5 * stops, 0.99 * stops, 1.5 * stops] {
        let start = json!({ "x": 0.0, "y": 0.0, "vx": 0.0, "vy": -fall, "angular_velocity": spin });
        let outcome = completed(&disc(
            &json!({ "restitution": restitution, "friction": friction }),
            [0.0, 0.0],
            &start,
            0.003,
            4,
        ));
        let impulse = (friction / stops).min(1.0) * tangential_mass * sliding;
        let last = |name: &str| *column(&outcome, name).last().expect("rows");
        assert_eq!(episodes(&outcome).len(), 1);
        // The lowest point of a disc that turns counter-clockwise moves to the right, so friction pushes it to the left.
        for (name, wanted) in [
            ("disc.vy", restitution * fall),
            ("disc.vx", -impulse / MASS),
            ("disc.omega", spin - JOURNAL * impulse / INERTIA),
        ] {
            assert!(
                (last(name) / wanted - 1.0).abs() < 1e-9,
                "{name}: {} for {wanted}",
                last(name)
            );
        }
        // ∫|v_t| dp_n: v_t is straight in p_n, to the end or to where it stops.
        let slides = (stops / friction).min(1.0) * (1.0 + restitution) * MASS * fall;
        let wanted = slides * 0.5 * (sliding + (sliding - impulse / tangential_mass));
        let wear: f64 = outcome.report.clearances[0].wear.iter().sum();
        assert!((wear / wanted - 1.0).abs() < 1e-9, "{wear} for {wanted}");
    }
}

/// A spinning disc dropped onto the wall bounces ever less, follows the wall, and rubs: T = −μ N sign v, which brakes its
/// spin by μ N r/I. The acceleration along the wall is (T ± m g sin)/m.
#[test]
fn a_following_disc_rubs() {
    let friction = 0.2;
    let start = json!({ "x": 0.0, "y": -0.0005, "vx": 0.0, "vy": 0.0, "angular_velocity": 400.0 });
    let outcome = completed(&disc(
        &json!({ "restitution": 0.3, "friction": friction }),
        [0.0, -9.81],
        &start,
        0.2,
        201,
    ));
    let of = |name: &str| column(&outcome, name);
    let (normal, tangential) = (
        of("joint.pin.normal_force"),
        of("joint.pin.tangential_force"),
    );
    let (alpha, eccentricity) = (of("disc.alpha"), of("joint.pin.eccentricity"));
    let (ex, ey) = (of("joint.pin.ex"), of("joint.pin.ey"));
    let (vx, vy) = (of("disc.vx"), of("disc.vy"));
    for k in 100..201 {
        assert!((eccentricity[k] / CLEARANCE - 1.0).abs() < 1e-12);
        assert!(
            (tangential[k] + friction * normal[k]).abs() < 1e-9 * normal[k],
            "{} {}",
            tangential[k],
            normal[k]
        );
        assert!(
            (alpha[k] + JOURNAL * friction * normal[k] / INERTIA).abs() < 1e-6,
            "{}",
            alpha[k]
        );
        // Newton across the wall: N = m v²/c − m g·e/c.
        let pressing =
            MASS * (vx[k] * vx[k] + vy[k] * vy[k]) / CLEARANCE - MASS * 9.81 * ey[k] / CLEARANCE;
        assert!(
            (normal[k] / pressing - 1.0).abs() < 1e-7,
            "{} for {pressing} at {}",
            normal[k],
            ex[k]
        );
    }
}

/// A disc that spins slowly comes to roll on the wall: it sticks from where it slides no more, not before.
#[test]
fn a_following_disc_sticks_at_last() {
    let start = json!({ "x": 0.0, "y": -0.0005, "vx": 0.0, "vy": 0.0, "angular_velocity": 30.0 });
    let outcome = completed(&disc(
        &json!({ "restitution": 0.3, "friction": 0.2 }),
        [0.0, -9.81],
        &start,
        1.0,
        2001,
    ));
    let [(state, sliding)] = [("state", "sliding_speed")].map(|(a, b)| {
        (
            column(&outcome, &format!("joint.pin.{a}")),
            column(&outcome, &format!("joint.pin.{b}")),
        )
    });
    let events = |kind: EventKind| {
        outcome
            .report
            .events
            .iter()
            .filter(|event| event.kind == kind)
            .collect::<Vec<_>>()
    };
    let (sticks, slips) = (events(EventKind::Stick), events(EventKind::Slip));
    assert!(sticks.len() == slips.len() + 1, "{sticks:?} {slips:?}");
    let mut stuck = 0;
    for (state, sliding) in state
        .iter()
        .zip(&sliding)
        .filter(|(state, _)| **state > 0.0)
    {
        assert_eq!(
            *state == 2.0,
            sliding.abs() <= 1e-9,
            "state {state} at {sliding} m/s"
        );
        stuck += usize::from(*state == 2.0);
    }
    assert!(stuck > 100, "{stuck}");
}

/// A disc hangs in a ring that hangs in the ground; dropped, both bounce, kick each other off their bearings, and come to rest,
/// where the outer bearing carries both weights and the inner one the disc's.
#[test]
fn two_journals_in_a_row_come_to_rest() {
    let clearance = |restitution: f64| {
        json!({ "model": "three_state", "radius": CLEARANCE, "bearing_radius": CLEARANCE + JOURNAL,
                "impact": { "restitution": restitution, "friction": 0.1 } })
    };
    let body = |mass: f64| json!({ "mass": mass, "inertia": INERTIA, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] } });
    for restitutions in [[0.3, 0.6], [0.6, 0.3], [0.0, 0.5], [0.5, 0.0]] {
        let model = json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0.0, -9.81],
            "bodies": { "ground": { "points": { "O": [0.0, 0.0] } }, "ring": body(2.0), "disc": body(3.0) },
            "joints": {
                "outer": { "type": "revolute", "between": ["ground.O", "ring.P"], "clearance": clearance(restitutions[0]) },
                "inner": { "type": "revolute", "between": ["ring.P", "disc.P"], "clearance": clearance(restitutions[1]) } },
            "analysis": { "type": "dynamics", "end": 0.3, "outputs": 31, "solver": { "rtol": 1e-9 } } });
        let outcome = completed(&model);
        assert!(episodes(&outcome).len() > 10, "{restitutions:?}");
        let last = |name: &str| *column(&outcome, name).last().expect("rows");
        assert!(
            (last("joint.outer.normal_force") - 5.0 * 9.81).abs() < 1e-9,
            "{}",
            last("joint.outer.normal_force")
        );
        assert!(
            (last("joint.inner.normal_force") - 3.0 * 9.81).abs() < 1e-9,
            "{}",
            last("joint.inner.normal_force")
        );
        assert!(
            (last("ring.y") + CLEARANCE).abs() < 1e-12
                && (last("disc.y") + 2.0 * CLEARANCE).abs() < 1e-12
        );
        // What fell is lost.
        let lost = 9.81 * (2.0 * CLEARANCE + 3.0 * 2.0 * CLEARANCE);
        assert!(
            (last("energy.dissipated") / lost - 1.0).abs() < 1e-7,
            "{}",
            last("energy.dissipated")
        );
    }
}

/// A disc that its last impact stops goes on along the wall, whichever way round-off leaves it: no further impact.
#[test]
fn the_last_impact_is_one() {
    for restitution in [0.5, 0.6, 0.7, 0.75, 0.8, 0.85] {
        let start = json!({ "x": 0.0005, "y": 0.0, "vx": 0.3, "vy": 0.4 });
        let impact = json!({ "restitution": restitution, "friction": 0.0 });
        let outcome = completed(&disc(&impact, [0.0, 0.0], &start, 0.1, 11));
        let impacts = episodes(&outcome);
        // The rebound from a speed e v is as high as c (e v/v_t)²/2; the last, below 1e-9 c, does not happen.
        let lowest = 0.2 * 2e-9_f64.sqrt();
        let mut across = (0.25_f64 - 0.04).sqrt();
        let mut count = 1;
        while restitution * across > lowest {
            across *= restitution;
            count += 1;
        }
        assert_eq!(impacts.len(), count, "{restitution}: {impacts:?}");
    }
}

/// A journal that lies quietly lets steps grow until parts of them go beyond it: the step is taken again, not the run given up.
#[test]
fn long_steps_of_a_quiet_journal_are_no_failure() {
    for (joint, restitution, rtol) in [
        ("q", 0.0, "1e-5"),
        ("q", 0.9, "1e-5"),
        ("b", 0.3, "1e-5"),
        ("b", 0.6, "1e-4"),
    ] {
        let rtol = format!("analysis.solver.rtol={rtol}");
        let outcome = rigid(
            "parallel-crank",
            &[joint],
            "50 um",
            restitution,
            0.02,
            &[&rtol],
        );
        assert_eq!(
            outcome.report.status,
            Status::Completed,
            "{joint} {restitution}: {:?}",
            outcome.report.message
        );
        // The plate moves as on ideal cranks, but for the clearance.
        let angle = column(&outcome, "plate.angle")
            .into_iter()
            .fold(0.0, |most: f64, angle| most.max(angle.abs()));
        assert!(
            angle < 1e-9,
            "{joint} {restitution}: the plate turns by {angle:e}"
        );
    }
}
