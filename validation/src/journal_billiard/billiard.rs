//! Flights along chords. After an impact with the speeds v_n across the wall and v_t along it:
//!
//! ```text
//! τ = 2 c v_n/(v_n² + v_t²)      time of flight              [s]
//! Δθ = 2 atan(v_n/v_t)           angle between impacts       [rad]
//! v_n' = e v_n,  v_t' = v_t      the next impact
//! ```

use std::fmt::Write as _;

use super::{CLEARANCE, MASS, episodes, largest, solve, values};
use crate::{CaseError, CaseReport, Claim, Setting, at_most, broken, verdict};
use linkdyn_engine::analysis::Outcome;

/// Start \[m\], velocity [m/s]: along the y axis the chord's distance from the centre is X·VY/|v|.
const X: f64 = 5e-4;
const VELOCITY: [f64; 2] = [0.3, 0.4];
/// Part of a flight by which an impact is late: it is located to 1e-10 of an eighth of a step, from beyond.
const LATE: f64 = 1.25e-11;
/// Momentum and energy change by round-off only, some ulp in each of a thousand impacts.
const KEPT: f64 = 1e-12;
const RESTITUTION: f64 = 0.8;
/// A rebound lower than this part of the clearance is the last: the journal follows the wall.
const LOWEST: f64 = 1e-9;
/// Error of an integrated speed: ten times the model's rtol.
const INTEGRATED: f64 = 1e-8;

/// An impact: time, angle of the wall, speed towards it.
struct Bounce {
    time: f64,
    angle: f64,
    across: f64,
}

/// The motion by the map.
struct Billiard {
    /// v_t, constant.
    along: f64,
    bounces: Vec<Bounce>,
}

impl Billiard {
    /// Impacts until one after `end`, or until their speed is negligible next to v_t.
    fn new(restitution: f64, end: f64) -> Self {
        let [vx, vy] = VELOCITY;
        let square = vx * vx + vy * vy;
        let time = (-X * vx + (X * X * vx * vx + square * (CLEARANCE * CLEARANCE - X * X)).sqrt())
            / square;
        let along = X * vy / CLEARANCE;
        let across = (square - along * along).sqrt();
        let angle = (vy * time).atan2(X + vx * time);
        let mut bounces = vec![Bounce {
            time,
            angle,
            across,
        }];
        while let Some(&Bounce {
            time,
            angle,
            across,
        }) = bounces.last()
        {
            let across = restitution * across;
            if time > end || across < f64::EPSILON * along {
                break;
            }
            let time = time + 2.0 * CLEARANCE * across / (across * across + along * along);
            bounces.push(Bounce {
                time,
                angle: angle + 2.0 * across.atan2(along),
                across,
            });
        }
        Billiard { along, bounces }
    }

    /// Where the journal is at a time, and its velocity; beyond the last impact along the wall.
    fn at(&self, time: f64) -> [f64; 4] {
        let next = self.bounces.partition_point(|bounce| bounce.time <= time);
        let wall = |angle: f64| [CLEARANCE * angle.cos(), CLEARANCE * angle.sin()];
        match (
            next.checked_sub(1).map(|last| &self.bounces[last]),
            self.bounces.get(next),
        ) {
            (None, _) => [
                X + VELOCITY[0] * time,
                VELOCITY[1] * time,
                VELOCITY[0],
                VELOCITY[1],
            ],
            (Some(last), Some(next)) => {
                let ([x, y], [to_x, to_y]) = (wall(last.angle), wall(next.angle));
                let (flight, since) = (next.time - last.time, time - last.time);
                let (vx, vy) = ((to_x - x) / flight, (to_y - y) / flight);
                [x + vx * since, y + vy * since, vx, vy]
            }
            (Some(last), None) => {
                let angle = last.angle + self.along / CLEARANCE * (time - last.time);
                let [x, y] = wall(angle);
                [x, y, -self.along * angle.sin(), self.along * angle.cos()]
            }
        }
    }
}

/// Positions as parts of the clearance, and velocities of the speed, largest error over the rows that `counts`.
fn errors(
    outcome: &Outcome,
    exact: &Billiard,
    counts: impl Fn(f64) -> bool,
) -> Result<[f64; 2], CaseError> {
    let speed = VELOCITY[0].hypot(VELOCITY[1]);
    let columns = ["disc.x", "disc.y", "disc.vx", "disc.vy"].map(|name| values(outcome, name));
    let [x, y, vx, vy] = columns;
    let (x, y, vx, vy) = (x?, y?, vx?, vy?);
    let times = values(outcome, "time")?;
    let rows: Vec<(usize, [f64; 4])> = times
        .iter()
        .enumerate()
        .filter(|(_, time)| counts(**time))
        .map(|(k, time)| (k, exact.at(*time)))
        .collect();
    let place = largest(
        rows.iter()
            .map(|(k, exact)| (x[*k] - exact[0]).hypot(y[*k] - exact[1]) / CLEARANCE),
    );
    let velocity = largest(
        rows.iter()
            .map(|(k, exact)| (vx[*k] - exact[2]).hypot(vy[*k] - exact[3]) / speed),
    );
    Ok([place, velocity])
}

/// A thousand elastic impacts.
pub fn elastic(setting: &Setting, report: &mut CaseReport) -> Result<(), CaseError> {
    let outcome = solve(setting, &[])?;
    let times = values(&outcome, "time")?;
    let end = *times.last().ok_or_else(|| broken("no rows"))?;
    let exact = Billiard::new(1.0, end);
    let impacts = exact
        .bounces
        .iter()
        .filter(|bounce| bounce.time <= end)
        .count();
    let ours = episodes(&outcome);
    let _ = writeln!(
        report.text,
        "elastic: {} impacts in {end} s, {impacts} by the map",
        ours.len()
    );
    report
        .claims
        .push(count("elastic: impacts in 4 s", ours.len(), impacts));
    let flight = exact.bounces[1].time - exact.bounces[0].time;
    let speed = VELOCITY[0].hypot(VELOCITY[1]);
    let late = LATE * impacts as f64;
    let far = late * flight * speed / CLEARANCE;
    let pairs = || ours.iter().zip(&exact.bounces);
    let off = largest(pairs().map(|(ours, exact)| (ours.start - exact.time) / flight));
    report.claims.push(at_most(
        "elastic: times of impacts, error by the time of flight [–]".into(),
        off,
        late,
    ));
    let across = exact.bounces[0].across;
    let off = largest(pairs().map(|(ours, _)| ours.approach_speed / across - 1.0));
    // Where it is late it is beyond the wall, by as much, and the wall turned so.
    let most = LATE * flight * speed / CLEARANCE;
    report.claims.push(at_most(
        "elastic: approach speeds, relative error [–]".into(),
        off,
        most,
    ));
    let [place, velocity] = errors(&outcome, &exact, |_| true)?;
    report.claims.push(at_most(
        "elastic: place in every row, error by the clearance [–]".into(),
        place,
        far,
    ));
    report.claims.push(at_most(
        "elastic: velocity in every row, error by the speed [–]".into(),
        velocity,
        far,
    ));
    let (x, y) = (values(&outcome, "disc.x")?, values(&outcome, "disc.y")?);
    let (vx, vy) = (values(&outcome, "disc.vx")?, values(&outcome, "disc.vy")?);
    let rows = || 0..times.len();
    let turning = largest(rows().map(|k| (x[k] * vy[k] - y[k] * vx[k]) / (X * VELOCITY[1]) - 1.0));
    report.claims.push(at_most(
        "elastic: angular momentum, relative change [–]".into(),
        turning,
        KEPT,
    ));
    let energy = largest(rows().map(|k| (vx[k] * vx[k] + vy[k] * vy[k]) / (speed * speed) - 1.0));
    report.claims.push(at_most(
        "elastic: kinetic energy, relative change [–]".into(),
        energy,
        KEPT,
    ));
    let out = largest(rows().map(|k| (x[k].hypot(y[k]) / CLEARANCE - 1.0).max(0.0)));
    report.claims.push(at_most(
        "elastic: farthest beyond the wall, by the clearance [–]".into(),
        out,
        most,
    ));
    Ok(())
}

/// Ever lower impacts, infinitely many in a finite time, and then along the wall.
pub fn damped(setting: &Setting, report: &mut CaseReport) -> Result<(), CaseError> {
    let end = 0.2;
    let sets = [
        format!("joints.pin.clearance.impact.restitution={RESTITUTION}"),
        format!("analysis.end={end}"),
        "analysis.outputs=2001".into(),
    ];
    let outcome = solve(setting, &sets)?;
    let exact = Billiard::new(RESTITUTION, end);
    let ours = episodes(&outcome);
    let follows = outcome
        .report
        .events
        .iter()
        .find(|event| event.kind == linkdyn_output::EventKind::SustainedContact);
    let follows = follows
        .ok_or_else(|| broken("it does not follow the wall"))?
        .time;
    let last = &exact.bounces[exact.bounces.len() - 1];
    let _ = writeln!(
        report.text,
        "damped: {} impacts, following from {follows:.9} s; by the map infinitely many until {:.9} s\n",
        ours.len(),
        last.time
    );
    lower(&outcome, &exact, follows, report)?;
    along_the_wall(&outcome, &exact, end, report)
}

/// The impacts, and the flights between them until the journal follows the wall.
fn lower(
    outcome: &Outcome,
    exact: &Billiard,
    follows: f64,
    report: &mut CaseReport,
) -> Result<(), CaseError> {
    let along = exact.along;
    let ours = episodes(outcome);
    let (first, last) = (&exact.bounces[0], &exact.bounces[exact.bounces.len() - 1]);
    // Height above the wall c (v_n/v_t)²/2 of the flight after an impact.
    let slope = (2.0 * LOWEST).sqrt();
    let rebound = exact
        .bounces
        .iter()
        .filter(|bounce| RESTITUTION * bounce.across >= slope * along)
        .count();
    report.claims.push(count(
        "damped: impacts, the last with a rebound below 1e-9 of the clearance",
        ours.len(),
        rebound + 1,
    ));
    let pairs = || ours.iter().zip(&exact.bounces);
    let far = LATE * last.time * VELOCITY[0].hypot(VELOCITY[1]) / CLEARANCE;
    let off = largest(pairs().map(|(ours, exact)| (ours.start - exact.time) / last.time));
    report.claims.push(at_most(
        "damped: times of impacts, error by the time to the last [–]".into(),
        off,
        LATE,
    ));
    let off =
        largest(pairs().map(|(ours, exact)| (ours.approach_speed - exact.across) / first.across));
    report.claims.push(at_most(
        "damped: approach speeds, error by the first [–]".into(),
        off,
        LATE,
    ));
    // What is left of the geometric series.
    let left = 2.0 * CLEARANCE / along * slope / (1.0 - RESTITUTION) / last.time;
    let off = (follows - last.time).abs() / last.time;
    report.claims.push(at_most(
        "damped: following begins where impacts accumulate, relative error [–]".into(),
        off,
        left,
    ));
    let [place, velocity] = errors(outcome, exact, |time| time < follows)?;
    report.claims.push(at_most(
        "damped: place until then, error by the clearance [–]".into(),
        place,
        far,
    ));
    report.claims.push(at_most(
        "damped: velocity until then, error by the speed [–]".into(),
        velocity,
        far,
    ));
    Ok(())
}

/// The motion along the wall, what presses there, and what was lost before.
fn along_the_wall(
    outcome: &Outcome,
    exact: &Billiard,
    end: f64,
    report: &mut CaseReport,
) -> Result<(), CaseError> {
    let along = exact.along;
    let (first, last) = (&exact.bounces[0], &exact.bounces[exact.bounces.len() - 1]);
    let [place, velocity] = errors(outcome, exact, |time| time > last.time)?;
    let far = INTEGRATED * along / CLEARANCE * (end - last.time);
    report.claims.push(at_most(
        "damped: place along the wall, error by the clearance [–]".into(),
        place,
        far,
    ));
    report.claims.push(at_most(
        "damped: velocity along the wall, error by the speed [–]".into(),
        velocity,
        far,
    ));
    let times = values(outcome, "time")?;
    let normal = values(outcome, "joint.pin.normal_force")?;
    let after = times
        .iter()
        .zip(&normal)
        .filter(|(time, _)| **time > last.time);
    let pressing = MASS * along * along / CLEARANCE;
    let force = largest(after.map(|(_, normal)| normal / pressing - 1.0));
    let most = 2.0 * INTEGRATED;
    report.claims.push(at_most(
        "damped: normal force m v_t²/c along the wall, relative error [–]".into(),
        force,
        most,
    ));
    let lost = 0.5 * MASS * first.across * first.across;
    let dissipated = values(outcome, "energy.dissipated")?;
    let loss = dissipated
        .last()
        .map_or(f64::INFINITY, |ours| (ours / lost - 1.0).abs());
    report.claims.push(at_most(
        "damped: energy lost, m v_n²/2 of the start, relative error [–]".into(),
        loss,
        KEPT,
    ));
    Ok(())
}

fn count(what: &str, ours: usize, exact: usize) -> Claim {
    Claim {
        what: what.into(),
        reference: exact.to_string(),
        ours: ours.to_string(),
        difference: (ours as i64 - exact as i64).to_string(),
        verdict: verdict(ours == exact),
    }
}
