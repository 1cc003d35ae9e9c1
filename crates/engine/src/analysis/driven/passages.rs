//! When the drivers pass a value of the path's parameter.

use super::super::instants::OutputInstant;
use crate::mechanism::continuation::{Parameter, Path, SingularKind};
use crate::motion::Law;
use crate::system::System;
use linkdyn_output::{Event, EventKind};

/// The range of the path's parameter that the instants (and what lies between them) need.
pub fn range(system: &System, instants: &[OutputInstant]) -> (f64, f64) {
    let end = instants.last().map_or(0.0, |last| last.time);
    match Parameter::of(system) {
        Parameter::Time | Parameter::Coordinate => (0.0, end),
        Parameter::DriverValue => {
            let law = &system.drivers[0].law;
            let ends = law.stretches(end).map(|(_, right)| right);
            let turns = ends.chain([0.0, end]).map(|t| law.jet(t)[0]);
            let sampled = instants
                .iter()
                .filter_map(|instant| instant.exact.map(|(_, value)| value));
            turns
                .chain(sampled)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| {
                    (low.min(s), high.max(s))
                })
        }
    }
}

/// Times in [0, end] at which the path's parameter passes `s`, ascending.
pub(super) fn times_of(system: &System, s: f64, end: f64) -> Vec<f64> {
    match Parameter::of(system) {
        Parameter::Time | Parameter::Coordinate => {
            Vec::from_iter((s >= 0.0 && s <= end * (1.0 + ON_THE_EDGE)).then_some(s.min(end)))
        }
        Parameter::DriverValue => passages(&system.drivers[0].law, s, end),
    }
}

/// A singular position this close beyond the end of the range, relative to the range, still belongs to it: that is how
/// well its place and the user's numbers agree.
pub(super) const ON_THE_EDGE: f64 = 1e-10;
/// More passages of one position than anybody reads.
const MOST_PASSAGES: usize = 1000;

/// Times in [0, end] at which a law passes a value: at most one on each monotone stretch.
pub fn passages(law: &Law, value: f64, end: f64) -> Vec<f64> {
    let mut times: Vec<f64> = Vec::new();
    for (left, right) in law.stretches(end) {
        let (from, to) = (law.jet(left)[0], law.jet(right)[0]);
        let (a, b) = (from - value, to - value);
        let edge = ON_THE_EDGE * (to - from).abs();
        let time = if a.abs() <= edge {
            Some(left)
        } else if b.abs() <= edge {
            Some(right)
        } else if a * b < 0.0 {
            Some(crate::motion::bisect(
                |t| (law.jet(t)[0] - value) * a,
                left,
                right,
            ))
        } else {
            None
        };
        if let Some(time) = time
            && times.last() != Some(&time)
        {
            times.push(time);
        }
        if times.len() >= MOST_PASSAGES {
            break;
        }
    }
    times
}

/// Passages of singular positions in `low` to `high` until `end`, by time; a dead centre ends the run.
pub(super) fn events(
    system: &System,
    path: &Path,
    (low, high): (f64, f64),
    end: f64,
) -> Vec<Event> {
    let by_value = path.parameter == Parameter::DriverValue;
    let edge = ON_THE_EDGE * (high - low);
    let mut events = Vec::new();
    for position in path.singular_between(low - edge, high + edge) {
        let times = times_of(system, position.s, end);
        let (kind, times) = match position.kind {
            SingularKind::ChangePoint => (EventKind::ChangePoint, &times[..]),
            SingularKind::DeadCentre => (EventKind::DeadCentre, &times[..times.len().min(1)]),
        };
        events.extend(times.iter().map(|&time| Event {
            driver: by_value.then(|| system.drivers[0].name.clone()),
            value: by_value.then_some(position.s),
            ..Event::at(kind, time)
        }));
    }
    events
}

/// The instants, with those of events between them.
pub(super) fn with_passages(instants: &[OutputInstant], events: &[Event]) -> Vec<OutputInstant> {
    let mut all = instants.to_vec();
    let end = instants.last().map_or(0.0, |last| last.time);
    let is_near = |time: f64| {
        instants
            .iter()
            .any(|instant| (instant.time - time).abs() <= ON_THE_EDGE * end)
    };
    let between = events.iter().filter(|event| !is_near(event.time));
    // By value there is one driver that counts.
    all.extend(between.map(|event| OutputInstant {
        time: event.time,
        exact: event.value.map(|value| (0, value)),
    }));
    all.sort_by(|a, b| a.time.total_cmp(&b.time));
    all
}
