//! Where and why a prescribed motion ends, in words.

use super::passages::times_of;
use crate::analysis::in_line::{singular_text, stressed_rows};
use crate::analysis::words::locked;
use crate::mechanism::continuation::{End, Parameter, Path};
use crate::mechanism::driven::Failure;
use crate::system::System;
use linkdyn_output::Status;

/// Why and when somebody asked to stop.
pub(super) fn stopped(status: Status, when: &str) -> String {
    let why = if status == Status::Interrupted {
        "interrupted"
    } else {
        "max_wall_time is over"
    };
    format!("{why} {when}")
}

/// Where the path ends before the outputs do.
pub(super) fn limits(system: &System, path: &Path, end: f64) -> Option<(f64, Status, String)> {
    let ends = [path.low, path.high]
        .into_iter()
        .filter_map(|side| match side {
            End::Reached | End::Interrupted => None,
            End::DeadCentre { s } => {
                let time = times_of(system, s, end).first().copied()?;
                Some((
                    time,
                    Status::DeadCentre,
                    dead_centre_text(system, path, s, time),
                ))
            }
            End::Stuck { s } => {
                let time = times_of(system, s, end).first().copied()?;
                let what = format!(
                    "{} can't be followed beyond {}; the results until there are kept",
                    drivers_text(system),
                    position_text(system, s, time)
                );
                Some((time, Status::Singular, what))
            }
        });
    ends.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Where and when the path ends: `2.31681 rad (132.743°), t = 0.22 s`, or the time alone.
fn position_text(system: &System, s: f64, time: f64) -> String {
    let time = system.display.time(time);
    match Parameter::of(system) {
        Parameter::Time | Parameter::Coordinate => format!("t = {time}"),
        Parameter::DriverValue => {
            format!("{}, t = {time}", system.driver_value(0, s))
        }
    }
}

/// Who drives: `driver "motor"`, or `the drivers`.
fn drivers_text(system: &System) -> String {
    match &system.drivers[..] {
        [driver] => format!("driver \"{}\"", driver.name),
        _ => "the drivers".into(),
    }
}

/// `driver "motor" can't go on beyond …, where "coupler" and "rocker" are in line`, and what to try.
fn dead_centre_text(system: &System, path: &Path, s: f64, time: f64) -> String {
    let stress = path
        .singular_at(s)
        .map(|position| stressed_rows(system, &position.self_stress));
    let what = singular_text(system, &stress.unwrap_or_default());
    let what = what.map_or_else(String::new, |what| format!(", where {what}"));
    format!(
        "dead centre: {} can't go on beyond {}{what}; the results until there are kept. Turn back before it, go the other \
         way, or drive another body",
        drivers_text(system),
        position_text(system, s, time)
    )
}

/// Why an instant has no solution.
pub(in crate::analysis) fn describe(system: &System, failure: Failure) -> String {
    match failure {
        Failure::Locked { force } => locked(system, force),
        Failure::Singular => "the constraints are singular there".into(),
        Failure::Diverged { residual } if !residual.is_finite() => {
            "Newton's iteration does not converge (it leaves the range of numbers)".into()
        }
        Failure::Diverged { residual } => {
            format!("Newton's iteration does not converge (residual {residual:.1e} of the size)")
        }
        Failure::Inconsistent { residual } => {
            format!(
                "redundant constraints contradict each other by {residual:.1e} of the mechanism's size"
            )
        }
    }
}
