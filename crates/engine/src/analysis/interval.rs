//! Events over an interval, from consecutive instants.

use linkdyn_output::{Event, EventKind};

/// Joins consecutive instants of one kind into an event over an interval.
#[derive(Debug, Default)]
pub struct Interval {
    open: Option<Event>,
}

impl Interval {
    /// The instant belongs to the interval.
    pub fn extend(
        &mut self,
        kind: EventKind,
        time: f64,
        driver: Option<(String, f64)>,
        note: &str,
    ) {
        let value = driver.as_ref().map(|(_, value)| *value);
        match &mut self.open {
            Some(event) => {
                event.end_time = Some(time);
                event.end_value = value;
            }
            None => {
                self.open = Some(Event {
                    end_time: Some(time),
                    driver: driver.map(|(name, _)| name),
                    value,
                    end_value: value,
                    note: Some(note.to_string()),
                    ..Event::at(kind, time)
                });
            }
        }
    }

    /// The interval ends before this instant.
    pub fn close(&mut self, events: &mut Vec<Event>) {
        events.extend(self.open.take());
    }
}
