//! What happened during a run.

use serde_json::{Map, Value};

/// What kind of thing happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum EventKind {
    /// The motion passes a position where it could go on in another way.
    ChangePoint,
    /// A driver comes to where it can't go on.
    DeadCentre,
    /// Outputs have no solution.
    NoSolution,
    /// The fixed point of the clearance links is not met.
    NotConverged,
    /// A joint locks itself by its friction, so that forces do not exist.
    SelfLocking,
    /// A journal touches its bearing, or a joint its stop, for a time or in an impact.
    Contact,
    /// A journal stays on its bearing, or a joint at its stop, after impacts too low to tell apart.
    SustainedContact,
    /// A journal begins to stick to its bearing.
    Stick,
    /// A journal begins to slip on its bearing.
    Slip,
    /// A joint latches at its stop.
    Latch,
    /// A latch opens.
    Unlatch,
    /// A joint, or the lock of one, closes.
    Close,
    /// It opens.
    Open,
}

impl EventKind {
    /// The word for it in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            EventKind::ChangePoint => "change_point",
            EventKind::DeadCentre => "dead_centre",
            EventKind::NoSolution => "no_solution",
            EventKind::NotConverged => "not_converged",
            EventKind::SelfLocking => "self_locking",
            EventKind::Contact => "contact",
            EventKind::SustainedContact => "following",
            EventKind::Stick => "stick",
            EventKind::Slip => "slip",
            EventKind::Latch => "latch",
            EventKind::Unlatch => "unlatch",
            EventKind::Close => "close",
            EventKind::Open => "open",
        }
    }
}

impl std::fmt::Display for EventKind {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        to.write_str(self.name())
    }
}

/// Something that happened at an instant or over an interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// What happened.
    pub kind: EventKind,
    /// Start \[s\].
    pub time: f64,
    /// End of an interval \[s\].
    pub end_time: Option<f64>,
    /// The driver that it is about.
    pub driver: Option<String>,
    /// Driver value at `time` [rad or m].
    pub value: Option<f64>,
    /// Driver value at `end_time`.
    pub end_value: Option<f64>,
    /// Joint with clearance, or with stops.
    pub joint: Option<String>,
    /// The stop of the joint, `lower` or `upper`.
    pub stop: Option<&'static str>,
    /// Of contacts.
    pub episode: Option<Episode>,
    /// What a reader should know.
    pub note: Option<String>,
}

impl Event {
    /// Something at an instant, about which nothing else is known.
    pub fn at(kind: EventKind, time: f64) -> Self {
        Event {
            kind,
            time,
            end_time: None,
            driver: None,
            value: None,
            end_value: None,
            joint: None,
            stop: None,
            episode: None,
            note: None,
        }
    }

    /// As in `summary.json`; what it does not have is left out.
    pub fn to_json(&self) -> Value {
        let mut json = Map::new();
        json.insert("type".into(), self.kind.name().into());
        json.insert("time".into(), self.time.into());
        let optional: [(&str, Option<Value>); 7] = [
            ("joint", self.joint.as_deref().map(Value::from)),
            ("stop", self.stop.map(Value::from)),
            ("end_time", self.end_time.map(Value::from)),
            ("driver", self.driver.as_deref().map(Value::from)),
            ("value", self.value.map(Value::from)),
            ("end_value", self.end_value.map(Value::from)),
            ("note", self.note.as_deref().map(Value::from)),
        ];
        json.extend(
            optional
                .into_iter()
                .filter_map(|(key, value)| Some((key.to_string(), value?))),
        );
        if let Some(episode) = &self.episode {
            let numbers = [
                ("duration", episode.end.map(|end| end - episode.start)),
                ("approach_speed", Some(episode.approach_speed)),
                ("separation_speed", episode.separation_speed),
                ("peak_penetration", Some(episode.peak_penetration)),
                ("peak_force", Some(episode.peak_force)),
                ("impulse", Some(episode.impulse)),
                ("energy_lost", Some(episode.energy_lost)),
            ];
            json.extend(
                numbers
                    .into_iter()
                    .filter_map(|(key, value)| Some((key.to_string(), value?.into()))),
            );
        }
        Value::Object(json)
    }
}

/// One time that a journal touches its bearing, or a joint its stop. Of a turning joint's stop lengths are angles, and forces torques.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Episode {
    /// Start \[s\].
    pub start: f64,
    /// End \[s\]; `None` if the run ends before.
    pub end: Option<f64>,
    /// Normal speed towards the bearing's surface [m/s].
    pub approach_speed: f64,
    /// Normal speed away from the bearing's surface [m/s].
    pub separation_speed: Option<f64>,
    /// Largest penetration \[m\].
    pub peak_penetration: f64,
    /// Largest normal force \[N\].
    pub peak_force: f64,
    /// Normal impulse ∫N dt [N·s].
    pub impulse: f64,
    /// Energy lost by damping and friction \[J\].
    pub energy_lost: f64,
}
