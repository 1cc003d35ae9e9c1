//! Events of runs as marks of a figure.

use serde_json::Value;

use super::units::convert_one;
use crate::cli::results::Results;
use linkdyn_output::{Channel, DriverQuantity};
use linkdyn_picture::Mark;

/// Events of a run that are marked, at most.
const MOST_EVENTS: usize = 200;
/// Contacts, sticks and slips that are marked with their names; of more only the beginnings of contacts, without.
const MOST_NAMED: usize = 8;

/// Events that a run's summary tells of, where the x axis has a place for them.
pub fn event_marks(run: &Results, x_name: &str, x_unit: &str) -> Vec<Mark> {
    let events = run
        .summary
        .as_ref()
        .and_then(|summary| summary.get("events")?.as_array());
    let column = run
        .table
        .columns
        .iter()
        .find(|column| column.name == x_name);
    let (Some(events), Some(column)) = (events, column) else {
        return Vec::new();
    };
    let is_time = column.channel == Some(Channel::Time);
    let is_driver = matches!(
        column.channel,
        Some(Channel::Driver(_, DriverQuantity::Value))
    );
    let driver = is_driver.then_some(column.owner.as_str());
    let many = events.iter().filter(|event| is_contact(event)).count() > MOST_NAMED;
    let mark = |event: &Value| -> Option<Mark> {
        let x = match driver {
            None if is_time => event.get("time")?.as_f64()?,
            Some(driver) if event.get("driver")?.as_str()? == driver => {
                event.get("value")?.as_f64()?
            }
            None | Some(_) => return None,
        };
        let label = if is_contact(event) && many {
            String::new()
        } else {
            event_word(event)?
        };
        Some(Mark {
            x: convert_one(x, &column.unit, x_unit)?,
            label,
        })
    };
    // Others are not crowded out by contacts.
    let others = events.iter().filter(|event| !is_contact(event));
    let contacts = events
        .iter()
        .filter(|event| is_contact(event))
        .filter(|event| !many || event["type"] == "contact");
    others
        .chain(contacts)
        .take(MOST_EVENTS)
        .filter_map(mark)
        .collect()
}

/// Whether an event is one of a journal in its bearing.
fn is_contact(event: &Value) -> bool {
    let kind = event["type"].as_str().unwrap_or_default();
    ["contact", "stick", "slip", "following"].contains(&kind)
}

/// `change point`; a contact that takes no time is an impact.
fn event_word(event: &Value) -> Option<String> {
    let kind = event.get("type")?.as_str()?;
    let is_impact = kind == "contact" && event["duration"].as_f64() == Some(0.0);
    Some(if is_impact {
        "impact".into()
    } else {
        kind.replace('_', " ")
    })
}
