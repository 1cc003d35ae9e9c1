//! Rigid journals that stick to their bearings, against closed forms: a disc on the inside of a circle, which rolls where friction
//! holds it and slides where it does not.
//!
//! ```text
//! k = I/(m r²),  ψ from the lowest point, the centre on a circle of radius c
//! rolls     (1 + k) c ψ̈ = −g sin ψ,  T = k/(1 + k) m g sin ψ,  N = m g cos ψ + m c ψ̇²
//! slides    m c ψ̈ = T − m g sin ψ,  I ω̇ = r T,  T = −μ N sgn v_t,  v_t = c ψ̇ + r ω
//! ```
//!
//! It begins to slide where k/(1 + k) tan ψ > μ, at rest.

use crate::impacts::{CLEARANCE, INERTIA, JOURNAL, MASS, completed, disc};
use crate::mechanisms::column;
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::EventKind;
use serde_json::json;

const GRAVITY: f64 = 9.81;
/// Where it is let go [rad].
const FROM: f64 = 1.0;

/// I/(m r²).
fn ratio() -> f64 {
    INERTIA / (MASS * JOURNAL * JOURNAL)
}

/// Friction that just holds it where it is let go.
fn least_friction() -> f64 {
    ratio() / (1.0 + ratio()) * FROM.tan()
}

/// The disc lies on the wall at rest.
fn let_go(friction: f64, end: f64, outputs: usize) -> Outcome {
    let start = json!({ "x": CLEARANCE * FROM.sin(), "y": -CLEARANCE * FROM.cos() });
    let impact = json!({ "restitution": 0.0, "friction": friction });
    completed(&disc(&impact, [0.0, -GRAVITY], &start, end, outputs))
}

fn events(outcome: &Outcome, kind: EventKind) -> usize {
    let events = outcome.report.events.iter();
    events.filter(|event| event.kind == kind).count()
}

/// ψ, ψ̇ and ω at every output.
fn motion(outcome: &Outcome) -> Vec<[f64; 3]> {
    let [x, y, vx, vy, omega] =
        ["x", "y", "vx", "vy", "omega"].map(|name| column(outcome, &format!("disc.{name}")));
    let row = |k: usize| {
        let angle = x[k].atan2(-y[k]);
        let along = vx[k] * angle.cos() + vy[k] * angle.sin();
        [angle, along / CLEARANCE, omega[k]]
    };
    (0..x.len()).map(row).collect()
}

/// A hair below the friction it needs the disc slides at once; a hair above it rolls to and fro for ever, and loses nothing.
#[test]
fn friction_holds_a_disc_up_to_its_cone() {
    let outcome = let_go(1.001 * least_friction(), 0.1, 201);
    let of = |name: &str| column(&outcome, &format!("joint.pin.{name}"));
    let (state, normal, tangential) = (of("state"), of("normal_force"), of("tangential_force"));
    let motion = motion(&outcome);
    let share = ratio() / (1.0 + ratio());
    for (k, [angle, rate, omega]) in motion.iter().enumerate().skip(1) {
        assert_eq!(state[k], 2.0, "row {k}");
        let sliding = CLEARANCE * rate + JOURNAL * omega;
        assert!(sliding.abs() < 1e-12, "{sliding:e} m/s");
        let square = 2.0 * GRAVITY * (angle.cos() - FROM.cos()) / (CLEARANCE * (1.0 + ratio()));
        assert!(
            (rate * rate - square).abs() < 1e-6 * GRAVITY / CLEARANCE,
            "{rate} for {square}"
        );
        let presses = MASS * (GRAVITY * angle.cos() + CLEARANCE * rate * rate);
        assert!(
            (normal[k] - presses).abs() < 1e-9 * presses,
            "{}",
            normal[k]
        );
        let holds = share * MASS * GRAVITY * angle.sin();
        assert!(
            (tangential[k].abs() - holds.abs()).abs() < 1e-7 * presses,
            "{} for {holds}",
            tangential[k]
        );
    }
    // It has been on the other side, and come back.
    let least = motion.iter().fold(0.0, |least: f64, row| least.min(row[0]));
    assert!((least + FROM).abs() < 1e-2, "{least}");
    assert_eq!(events(&outcome, EventKind::Slip), 0);

    let outcome = let_go(0.999 * least_friction(), 4e-4, 11);
    let of = |name: &str| column(&outcome, &format!("joint.pin.{name}"));
    let (state, sliding) = (of("state"), of("sliding_speed"));
    assert_eq!(state[10], 1.0);
    assert!(sliding[10].abs() > 0.0, "{}", sliding[10]);
}

/// With half the friction it slides first, against it by μ N, and rolls from where it slides no more; then friction holds it.
#[test]
fn a_disc_slides_until_it_rolls() {
    let friction = 0.5 * least_friction();
    let outcome = let_go(friction, 0.1, 2001);
    let of = |name: &str| column(&outcome, &format!("joint.pin.{name}"));
    let [state, normal, tangential, sliding] =
        ["state", "normal_force", "tangential_force", "sliding_speed"].map(of);
    let first = state
        .iter()
        .position(|state| *state == 2.0)
        .expect("it sticks");
    assert!(first > 50, "{first}");
    for k in 1..state.len() {
        if state[k] == 2.0 {
            assert!(sliding[k].abs() < 1e-12, "{:e} m/s", sliding[k]);
            assert!(tangential[k].abs() <= friction * normal[k] * (1.0 + 1e-7));
        } else {
            let rubs = -friction * normal[k] * sliding[k].signum();
            assert!((tangential[k] - rubs).abs() < 1e-9 * normal[k], "row {k}");
        }
    }
    let (sticks, slips) = (
        events(&outcome, EventKind::Stick),
        events(&outcome, EventKind::Slip),
    );
    assert!(
        sticks >= 1 && sticks.abs_diff(slips) <= 1,
        "{sticks} {slips}"
    );
}

/// ψ, ψ̇ and ω by the law whose friction grows from zero up to a threshold velocity, by Runge and Kutta's method.
fn creeps(friction: f64, threshold: f64, end: f64) -> [f64; 3] {
    let rates = |[angle, rate, omega]: [f64; 3]| {
        let normal = MASS * (GRAVITY * angle.cos() + CLEARANCE * rate * rate);
        let sliding = CLEARANCE * rate + JOURNAL * omega;
        let force = -friction * normal * (sliding / threshold).clamp(-1.0, 1.0);
        [
            rate,
            (force / MASS - GRAVITY * angle.sin()) / CLEARANCE,
            JOURNAL * force / INERTIA,
        ]
    };
    // A quarter of the time in which sliding dies away.
    let fades = threshold * MASS / (friction * 2.0 * MASS * GRAVITY * (1.0 + 1.0 / ratio()));
    let steps = (end / (0.25 * fades)).ceil();
    let h = end / steps;
    let add = |y: [f64; 3], by: f64, dy: [f64; 3]| [0, 1, 2].map(|k| y[k] + by * dy[k]);
    let mut y = [FROM, 0.0, 0.0];
    for _ in 0..steps as usize {
        let first = rates(y);
        let second = rates(add(y, 0.5 * h, first));
        let third = rates(add(y, 0.5 * h, second));
        let fourth = rates(add(y, h, third));
        y = [0, 1, 2]
            .map(|k| y[k] + h / 6.0 * (first[k] + 2.0 * second[k] + 2.0 * third[k] + fourth[k]));
    }
    y
}

/// Friction that grows up to a threshold velocity tends to friction that sticks as the threshold goes to zero, and the more so
/// the smaller it is.
#[test]
fn a_regularised_law_tends_to_sticking() {
    for part in [0.5, 1.5] {
        let friction = part * least_friction();
        let end = 0.03;
        let outcome = let_go(friction, end, 4);
        let last = *motion(&outcome).last().expect("rows");
        let apart = [1e-3, 1e-4, 1e-5].map(|threshold| {
            let near = creeps(friction, threshold, end);
            (near[0] - last[0]).abs()
        });
        assert!(
            apart[1] < 0.2 * apart[0] && apart[2] < 0.2 * apart[1] && apart[2] < 1e-3,
            "{apart:?}"
        );
    }
}
