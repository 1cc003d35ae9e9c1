//! One impact with friction at the lowest point of the bearing, of a body whose centre of mass is at −r from the contact:
//!
//! ```text
//! a = 1/m + r_y²/I,  b = −r_x r_y/I,  d = 1/m + r_x²/I
//! Δu_x = a P_x + b P_y,  Δu_y = b P_x + d P_y                   u, velocity of the contact point        [m/s]
//! Δv = P/m,  Δω = (r_x P_y − r_y P_x)/I                          P, impulse on the body                 [N·s]
//! ```

use std::fmt::Write as _;

use super::{CLEARANCE, INERTIA, JOURNAL, MASS, episodes, solve, values};
use crate::{CaseError, CaseReport, Claim, Setting, Verdict, at_most, broken, verdict};
use linkdyn_engine::analysis::Outcome;

/// An impact is solved in closed form: what differs is the normal, since it is met late by 1e-10 of a flight along the wall of
/// a fifth of the clearance.
const CLOSE: f64 = 2e-11;

/// Spin [rad/s], fall [m/s] and restitution of the disc.
const SPIN: f64 = 40.0;
const FALL: f64 = 0.5;
const RESTITUTION: f64 = 0.6;

/// Velocity of the body off centre as it meets the wall [m/s], and its centre of mass \[m\].
const VELOCITY: [f64; 2] = [0.2, -0.5];
const CENTRE: [f64; 2] = [0.004, -0.001];

/// Velocity of the centre of mass and angular velocity in the last row, after the only impact.
fn after(outcome: &Outcome, [x, y]: [f64; 2]) -> Result<[f64; 3], CaseError> {
    if episodes(outcome).len() != 1 {
        return Err(broken(format!(
            "{} impacts instead of one",
            episodes(outcome).len()
        )));
    }
    let last = |name: &str| {
        values(outcome, name)?
            .last()
            .copied()
            .ok_or_else(|| broken("no rows"))
    };
    let (sin, cos) = last("disc.angle")?.sin_cos();
    let (vx, vy, omega) = (last("disc.vx")?, last("disc.vy")?, last("disc.omega")?);
    Ok([
        vx - omega * (sin * x + cos * y),
        vy + omega * (cos * x - sin * y),
        omega,
    ])
}

/// Largest difference of velocities, those of rotation as of the contact point.
fn distance(ours: [f64; 3], exact: [f64; 3]) -> f64 {
    let scale = exact[0].hypot(exact[1]).max(JOURNAL * exact[2].abs());
    let parts = [
        ours[0] - exact[0],
        ours[1] - exact[1],
        JOURNAL * (ours[2] - exact[2]),
    ];
    super::largest(parts.into_iter()) / scale
}

/// A spinning disc falls straight: it slides all through where μ is less than what ends sliding, and else sticks.
pub fn spinning(setting: &Setting, report: &mut CaseReport) -> Result<(), CaseError> {
    let tangential_mass = 1.0 / (1.0 / MASS + JOURNAL * JOURNAL / INERTIA);
    let all = tangential_mass * SPIN * JOURNAL;
    let stops = all / ((1.0 + RESTITUTION) * MASS * FALL);
    for (what, part) in [
        ("slides throughout", 0.5),
        ("slides nearly to its end", 0.999),
        ("sticks", 1.5),
    ] {
        let friction = part * stops;
        let sets = [
            format!(
                "joints.pin.clearance.impact={{\"restitution\":{RESTITUTION},\"friction\":{friction:e}}}"
            ),
            format!(
                "initial.disc={{\"x\":0,\"y\":0,\"vx\":0,\"vy\":{:e},\"angular_velocity\":{SPIN}}}",
                -FALL
            ),
            "analysis.end=0.003".into(),
            "analysis.outputs=4".into(),
        ];
        let outcome = solve(setting, &sets)?;
        let impulse = part.min(1.0) * all;
        // The lowest point of a disc that turns counter-clockwise moves to the right: friction pushes it to the left.
        let exact = [
            -impulse / MASS,
            RESTITUTION * FALL,
            SPIN - JOURNAL * impulse / INERTIA,
        ];
        let off = distance(after(&outcome, [0.0, 0.0])?, exact);
        let what = format!(
            "spinning disc, μ = {friction:.4}, {what}: velocities after it, relative error [–]"
        );
        report.claims.push(at_most(what, off, CLOSE));
    }
    Ok(())
}

/// What restitution compares, where that matters: sliding stops while the contact is still compressed.
pub fn senses(setting: &Setting, report: &mut CaseReport) -> Result<(), CaseError> {
    let _ = writeln!(
        report.text,
        "off centre     μ    e  sense      v_x [m/s]  v_y [m/s]  ω [rad/s]  energy change [J]"
    );
    let mut gains = [0.0_f64; 3];
    for (what, friction) in [("sticks", 0.4), ("turns round", 0.15)] {
        for (k, sense) in ["energetic", "kinetic", "kinematic"]
            .into_iter()
            .enumerate()
        {
            let mut worst = 0.0_f64;
            for restitution in [0.7, 1.0] {
                let outcome = strike(setting, restitution, friction, sense)?;
                let ours = after(&outcome, CENTRE)?;
                let exact = exact(restitution, friction, sense);
                worst = worst.max(distance(ours, exact));
                let gain = energy(ours) - energy([VELOCITY[0], VELOCITY[1], 0.0]);
                gains[k] = if friction == 0.4 && restitution == 1.0 {
                    gain
                } else {
                    gains[k]
                };
                let [vx, vy, omega] = ours;
                let _ = writeln!(
                    report.text,
                    "{what:11} {friction:5} {restitution:4}  {sense:9} {vx:10.6} {vy:10.6} {omega:10.4} {gain:+18.6}"
                );
            }
            let what = format!(
                "off centre, sliding stops and {what}, {sense}: velocities, relative error [–]"
            );
            report.claims.push(at_most(what, worst, CLOSE));
        }
    }
    report.claims.push(gain_claim(gains[2]));
    report.claims.push(Claim {
        what: "off centre, e = 1: energy that the energetic sense gains [J]".into(),
        reference: "none".into(),
        ours: format!("{:.6}", gains[0]),
        difference: String::new(),
        verdict: verdict(gains[0] < 0.0),
    });
    Ok(())
}

/// Newton's restitution makes energy where sliding stops (T. R. Kane 1984); by the closed form.
fn gain_claim(ours: f64) -> Claim {
    let exact = energy(exact(1.0, 0.4, "kinematic")) - energy([VELOCITY[0], VELOCITY[1], 0.0]);
    Claim {
        what: "off centre, e = 1: energy that the kinematic sense gains [J]".into(),
        reference: format!("{exact:.9}"),
        ours: format!("{ours:.9}"),
        difference: format!("{:.1e}", ours - exact),
        verdict: if exact > 0.0 && (ours - exact).abs() <= CLOSE * exact {
            Verdict::Agrees
        } else {
            Verdict::Fault
        },
    }
}

fn energy([vx, vy, omega]: [f64; 3]) -> f64 {
    0.5 * (MASS * (vx * vx + vy * vy) + INERTIA * omega * omega)
}

/// The body meets the lowest point after a millisecond.
fn strike(
    setting: &Setting,
    restitution: f64,
    friction: f64,
    sense: &str,
) -> Result<Outcome, CaseError> {
    let [vx, vy] = VELOCITY;
    let (x, y) = (-1e-3 * vx, -CLEARANCE - 1e-3 * vy);
    let words =
        format!("{{\"restitution\":{restitution},\"friction\":{friction},\"sense\":\"{sense}\"}}");
    let sets = [
        format!("joints.pin.clearance.impact={words}"),
        format!("bodies.disc.com=[{},{}]", CENTRE[0], CENTRE[1]),
        format!(
            "initial.disc={{\"x\":{x:e},\"y\":{y:e},\"angle\":0,\"vx\":{vx},\"vy\":{vy},\"angular_velocity\":0}}"
        ),
        "analysis.end=0.0011".into(),
        "analysis.outputs=12".into(),
    ];
    solve(setting, &sets)
}

/// Velocities after the impact: along p = P_y sliding at first, which stops at p_s in compression; then the point sticks, or
/// slides the other way. Compression ends at p_c, restitution adds q.
fn exact(restitution: f64, friction: f64, sense: &str) -> [f64; 3] {
    let [rx, ry] = [-CENTRE[0], -CENTRE[1] - JOURNAL];
    let (a, b, d) = (
        1.0 / MASS + ry * ry / INERTIA,
        -rx * ry / INERTIA,
        1.0 / MASS + rx * rx / INERTIA,
    );
    let [ux, uy] = VELOCITY;
    let stop = -ux / (b - friction * a);
    let speed = uy + (d - friction * b) * stop;
    let ratio = if b.abs() <= friction * a {
        -b / a
    } else {
        -friction * b.signum()
    };
    let rate = d + b * ratio;
    let compression = stop - speed / rate;
    let work = -0.5 * ((uy + speed) * stop + speed * (compression - stop));
    let rebound = match sense {
        "energetic" => restitution * (2.0 * work / rate).sqrt(),
        "kinetic" => restitution * compression,
        _ => -restitution * uy / rate,
    };
    let py = compression + rebound;
    let px = -friction * stop + ratio * (py - stop);
    [
        ux + px / MASS,
        uy + py / MASS,
        (rx * py - ry * px) / INERTIA,
    ]
}
