//! A run in words: how it went, and the numbers that are requested first.

use linkdyn_engine::analysis::Outcome;
use linkdyn_model::display::DisplayUnits;
use linkdyn_output::{ClearanceSums, Event, Quality, StopSums, Trajectory};

use super::largest::{efforts, forces};
use crate::ModelFile;
use crate::text::words::{analysis_words, equilibrium, mobility, status_words};
use crate::text::{Page, count, number, responses, seconds, shorten};

/// Digits of numbers.
const DIGITS: usize = 4;

/// A run in words.
pub fn text(file: &ModelFile, outcome: &Outcome) -> Page {
    let Outcome {
        trajectory, report, ..
    } = outcome;
    let model = file.model();
    let analysis = model.analysis.as_ref();
    let kind = analysis.map_or("", |analysis| analysis_words(analysis.kind));
    let curves = outcome.curves();
    let mut page = Page::default();
    page.line(format!(
        "{} ({}): {kind}, {}",
        file.name(),
        file.label(),
        status_words(report.status)
    ));
    responses::answers(&mut page, &outcome.responses, &model.display);
    page.row("mobility", mobility(&report.mobility));
    page.row("outputs", outputs(trajectory));
    page.row("quality", quality(&report.quality));
    page.rows("equilibrium", report.equilibrium.iter().map(equilibrium));
    let contacts = report.clearances.iter().map(contacts);
    page.rows("contacts", shorten(contacts.collect()));
    let stops = report.stops.iter().map(stops);
    page.rows("stops", shorten(stops.collect()));
    let events = report.events.iter();
    let events = events.map(|event| event_words(event, trajectory, &model.display));
    page.rows("events", shorten(events.collect()));
    page.rows("effort", efforts(&curves, report));
    page.rows("largest force", forces(&curves, report));
    page.rows("warnings", shorten(report.warnings.clone()));
    page
}

fn outputs(trajectory: &Trajectory) -> String {
    let Some(time) = trajectory
        .column_index("time")
        .filter(|_| !trajectory.is_empty())
    else {
        return "none".into();
    };
    let (first, last) = (
        trajectory.row(0)[time],
        trajectory.row(trajectory.len() - 1)[time],
    );
    let instants = count(trajectory.len(), "instant");
    format!(
        "{instants}, t = {} … {} s, {}",
        number(first, 6),
        number(last, 6),
        count(trajectory.width(), "column")
    )
}

fn quality(quality: &Quality) -> String {
    let parts = [
        ("power imbalance", quality.power_imbalance),
        ("energy drift", quality.energy_drift),
        ("energy imbalance", quality.energy_imbalance),
        ("section imbalance", quality.section_imbalance),
    ];
    if quality.constraint_residual.is_nan() {
        return "nothing is solved".into();
    }
    let mut text = format!(
        "constraint residual {}",
        number(quality.constraint_residual, 2)
    );
    for (what, value) in parts {
        text.extend(value.map(|value| format!(", {what} {}", number(value, 2))));
    }
    text
}

/// A joint's contacts: `b: 24, 2.1 ms in all, 4.2 J lost`.
fn contacts(sums: &ClearanceSums) -> String {
    let touched = touched(sums.episodes, sums.time_in_contact, sums.energy_lost);
    format!("{}: {touched}", sums.joint)
}

/// The same of a stop: `o, lower: 21, 2.5 s in all, 0.94 J lost`.
fn stops(sums: &StopSums) -> String {
    let touched = touched(sums.episodes, sums.time_in_contact, sums.energy_lost);
    format!("{}, {}: {touched}", sums.joint, sums.stop)
}

fn touched(episodes: u64, time: f64, lost: f64) -> String {
    let (time, lost) = (seconds(time), number(lost, DIGITS));
    format!("{episodes}, {time} in all, {lost} J lost")
}

/// One event: `change point at 1.7 s, motor = 117.5°`, `impact at 0.01 s (joint b)`.
fn event_words(event: &Event, trajectory: &Trajectory, display: &DisplayUnits) -> String {
    let kind = event.kind.name().replace('_', " ");
    let start = display.time(event.time);
    let mut text = match (&event.episode, event.end_time) {
        (Some(_), Some(end)) if end == event.time => format!("impact at {start}"),
        // Shorter than the digits shown.
        (Some(_), Some(end)) if display.time(end) == start => {
            format!(
                "{kind} at {start} for {}",
                display.time_to(end - event.time, 2)
            )
        }
        (Some(_), None) => format!("{kind} from {start} on"),
        (_, Some(end)) => format!("{kind} from {}", display.times(event.time, end)),
        (None, None) => format!("{kind} at {start}"),
    };
    let stop = event.stop.map(|stop| match stop {
        "one_way" => ", one-way clutch".to_owned(),
        "lock" => ", lock".to_owned(),
        stop => format!(", {stop} stop"),
    });
    let stop = stop.unwrap_or_default();
    text.extend(event.joint.iter().map(|owner| {
        // No joint has a name with a full stop.
        let what = if owner.starts_with("force.") {
            ""
        } else {
            "joint "
        };
        format!(" ({what}{owner}{stop})")
    }));
    if let (Some(driver), Some(start)) = (&event.driver, event.value) {
        let unit = trajectory
            .column_index(&format!("driver.{driver}.value"))
            .map(|i| trajectory.columns[i].unit);
        let with_unit = |value: f64| match unit {
            Some("rad") => display.angle(value),
            Some("m") => display.length(value),
            Some(unit) => format!("{} {unit}", number(value, 6)),
            None => number(value, 6),
        };
        text += &format!(", {driver} = {}", with_unit(start));
        if let Some(end) = event.end_value {
            text += &format!(" … {}", with_unit(end));
        }
    }
    if let Some(note) = &event.note {
        text += &format!(": {note}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_output::{Channel, Column, DriverQuantity, Episode, EventKind};

    fn results() -> Trajectory {
        let value = |driver, owner, unit| {
            let channel = Channel::Driver(driver, DriverQuantity::Value);
            Column::of(channel, owner, unit)
        };
        Trajectory::new(vec![value(0, "motor", "rad"), value(1, "slide", "m")])
    }

    fn event(driver: &str, end_time: Option<f64>) -> Event {
        Event {
            end_time,
            driver: Some(driver.into()),
            value: Some(2.05),
            end_value: end_time.map(|_| 2.1),
            ..Event::at(EventKind::ChangePoint, 1.7)
        }
    }

    #[test]
    fn events_tell_angles_in_degrees_too() {
        let words = |event: &Event| event_words(event, &results(), &DisplayUnits::default());
        assert_eq!(
            words(&event("motor", None)),
            "change point at 1.7 s, motor = 2.05 rad (117.456°)"
        );
        assert_eq!(
            words(&event("slide", Some(2.0))),
            "change point from 1.7 to 2 s, slide = 2.05 m … 2.1 m"
        );
        let noted = Event {
            driver: None,
            note: Some("here".into()),
            ..event("", None)
        };
        assert_eq!(words(&noted), "change point at 1.7 s: here");
    }

    #[test]
    fn contacts_tell_their_joint_and_how_long_they_last() {
        let of_pin = |kind: EventKind, end_time: Option<f64>, episode: Option<Episode>| {
            let event = Event {
                end_time,
                joint: Some("pin".into()),
                episode,
                ..Event::at(kind, 0.0100964)
            };
            event_words(&event, &results(), &DisplayUnits::default())
        };
        let contact =
            |end_time: Option<f64>| of_pin(EventKind::Contact, end_time, Some(Episode::default()));
        assert_eq!(
            contact(Some(0.0100964)),
            "impact at 0.0100964 s (joint pin)"
        );
        assert_eq!(
            contact(Some(0.0100964 + 2.5e-10)),
            "contact at 0.0100964 s for 2.5e-10 s (joint pin)"
        );
        assert_eq!(
            contact(Some(0.0101)),
            "contact from 0.0100964 to 0.0101 s (joint pin)"
        );
        assert_eq!(contact(None), "contact from 0.0100964 s on (joint pin)");
        assert_eq!(
            of_pin(EventKind::Slip, None, None),
            "slip at 0.0100964 s (joint pin)"
        );
        let of_strut = Event {
            end_time: Some(0.5),
            joint: Some("force.strut".into()),
            stop: Some("upper"),
            episode: Some(Episode::default()),
            ..Event::at(EventKind::Contact, 0.5)
        };
        assert_eq!(
            event_words(&of_strut, &results(), &DisplayUnits::default()),
            "impact at 0.5 s (force.strut, upper stop)"
        );
    }

    #[test]
    fn an_empty_run_has_words_too() {
        assert_eq!(outputs(&Trajectory::default()), "none");
    }
}
