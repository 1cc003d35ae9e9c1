//! What a contact has done: its episodes, its changes between stick and slip, and its wear.

use crate::analysis::dynamics::state::Sums;
use crate::element::pair::{Pair, Reading, Shape};
use linkdyn_output::{Episode, Event, EventKind};

/// Bins of the bearing's circumference in which sliding under load is summed.
pub const WEAR_BINS: usize = 72;
/// Episodes, and changes between stick and slip, that are listed at most; all are counted.
const LISTED: usize = 20_000;

/// A contact at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Entry {
    /// \[s\]
    pub time: f64,
    /// Penetration, rates and forces then.
    pub reading: Reading,
    /// What it has done until then.
    pub sums: Sums,
    /// Its angle in the bearing's body \[rad\].
    pub angle: f64,
}

/// Everything that is reported about a joint's contact.
#[derive(Debug, Clone)]
pub struct History {
    joint: String,
    /// Which stop of the joint it is, with its arm.
    stop: Option<(&'static str, f64)>,
    /// Whether events close it.
    is_timed: bool,
    /// What stays together where it stays.
    together: &'static str,
    open: Option<(Episode, Sums)>,
    /// Sums at the last point.
    last: Sums,
    last_angle: f64,
    /// S by angle of the bearing \[N·m\]; nothing of what is none.
    pub wear: Vec<f64>,
    /// Episodes that are over.
    pub episodes: u64,
    /// Largest penetration of all of them \[m\].
    pub most: f64,
    /// Changes between stick and slip.
    pub switches: u64,
    /// Time in contact \[s\].
    pub time_in_contact: f64,
    /// What is listed of it.
    pub events: Vec<Event>,
    /// How many more events there were.
    pub unlisted: u64,
}

impl History {
    /// Of a contact of a joint, before anything has happened.
    pub fn new(joint: &str, pair: &Pair) -> Self {
        let together = match pair.shape {
            Shape::Journal(_) => "would follow: the journal stays on the bearing's surface",
            Shape::Stop(_) => "follow until then: from there the joint stays at its stop",
            Shape::Edge(_) => "follow until then: from there the tip stays on the outline",
            // It has no impacts of its own.
            Shape::Clasp(_) => "",
        };
        History {
            joint: joint.into(),
            stop: pair.stop().map(|stop| (stop.word(), stop.arm)),
            is_timed: pair.is_timed(),
            together,
            open: None,
            last: Sums::default(),
            last_angle: 0.0,
            wear: match pair.journal() {
                Some(_) => vec![0.0; WEAR_BINS],
                None => Vec::new(),
            },
            episodes: 0,
            most: 0.0,
            switches: 0,
            time_in_contact: 0.0,
            events: Vec::new(),
            unlisted: 0,
        }
    }

    /// An episode begins.
    pub fn begin(&mut self, entry: &Entry) {
        let episode = Episode {
            start: entry.time,
            approach_speed: entry.reading.rate,
            ..Episode::default()
        };
        self.open = Some((episode, entry.sums));
        self.last = entry.sums;
        self.last_angle = entry.angle;
    }

    /// The state at a later point of the episode.
    pub fn go_on(&mut self, entry: &Entry) {
        self.peak(&entry.reading);
        self.wear_between(entry.angle, entry.sums.sliding - self.last.sliding);
        self.last = entry.sums;
        self.last_angle = entry.angle;
    }

    /// Larger penetration or force than the episode's so far.
    pub fn peak(&mut self, reading: &Reading) {
        if let Some((episode, _)) = &mut self.open {
            episode.peak_penetration = episode.peak_penetration.max(reading.penetration);
            episode.peak_force = episode.peak_force.max(reading.normal);
        }
    }

    /// Whether one of them could be larger than the episode's so far, by estimates good to a percent.
    pub fn rises(&self, penetration: f64, force: f64) -> bool {
        self.open.as_ref().is_some_and(|(episode, _)| {
            1.01 * penetration > episode.peak_penetration || 1.01 * force > episode.peak_force
        })
    }

    /// Largest penetration of the open episode.
    pub fn deepest(&self) -> Option<f64> {
        self.open
            .as_ref()
            .map(|(episode, _)| episode.peak_penetration)
    }

    /// The episode ends (for now): the last end counts.
    pub fn rest(&mut self, entry: &Entry) {
        if let Some((episode, start)) = &mut self.open {
            episode.end = Some(entry.time);
            episode.separation_speed = Some(-entry.reading.rate);
            episode.impulse = entry.sums.impulse - start.impulse;
            episode.energy_lost = entry.sums.dissipated - start.dissipated;
        }
    }

    /// The episode that is open goes over to another contact: it, and what it has done so far.
    pub fn hand_over(&mut self, sums: Sums) -> Option<(Episode, Sums)> {
        let (episode, start) = self.open.take()?;
        Some((episode, sums - start))
    }

    /// One comes over from another, which has done this; `sums` are the contact's own.
    pub fn take_over(&mut self, (episode, done): (Episode, Sums), sums: Sums) {
        self.open = Some((episode, sums - done));
        self.last = sums;
    }

    /// It presses again.
    pub fn press(&mut self) {
        if let Some((episode, _)) = &mut self.open {
            (episode.end, episode.separation_speed) = (None, None);
        }
    }

    /// The journal has left.
    pub fn end(&mut self) {
        let Some((episode, _)) = self.open.take() else {
            return;
        };
        self.episodes += 1;
        self.most = self.most.max(episode.peak_penetration);
        self.time_in_contact += episode.end.unwrap_or(episode.start) - episode.start;
        let end_time = episode.end;
        self.list(Event {
            end_time,
            episode: Some(self.told(episode)),
            ..Event::at(EventKind::Contact, episode.start)
        });
    }

    /// An episode at a stop of an angle: angles for lengths, torques for forces.
    fn told(&self, episode: Episode) -> Episode {
        let Some((_, arm)) = self.stop else {
            return episode;
        };
        Episode {
            approach_speed: episode.approach_speed / arm,
            separation_speed: episode.separation_speed.map(|speed| speed / arm),
            peak_penetration: episode.peak_penetration / arm,
            peak_force: episode.peak_force * arm,
            impulse: episode.impulse * arm,
            ..episode
        }
    }

    /// The run is over: an episode that goes on has neither end nor separation speed.
    pub fn finish(&mut self, time: f64, sums: Sums) {
        if let Some((episode, start)) = &mut self.open {
            if episode.end.is_none() {
                self.time_in_contact += time - episode.start;
                episode.impulse = sums.impulse - start.impulse;
                episode.energy_lost = sums.dissipated - start.dissipated;
            }
            self.end();
        }
    }

    /// Impacts have become so low, `height` in words, that the contact is sustained from now on.
    pub fn sustain(&mut self, time: f64, height: &str) {
        let note = format!("impacts lower than {height} {}", self.together);
        self.list(Event {
            note: Some(note),
            ..Event::at(EventKind::SustainedContact, time)
        });
    }

    /// The joint latches at its stop, or comes off it; or an event closes or opens it.
    pub fn latch(&mut self, time: f64, closes: bool) {
        self.list(Event::at(
            match (closes, self.is_timed) {
                (true, false) => EventKind::Latch,
                (false, false) => EventKind::Unlatch,
                (true, true) => EventKind::Close,
                (false, true) => EventKind::Open,
            },
            time,
        ));
    }

    /// The journal sticks or slips from now on.
    pub fn switch(&mut self, time: f64, sticks: bool) {
        self.switches += 1;
        let kind = if sticks {
            EventKind::Stick
        } else {
            EventKind::Slip
        };
        self.list(Event::at(kind, time));
    }

    fn list(&mut self, event: Event) {
        if self.events.len() < LISTED {
            self.events.push(Event {
                joint: Some(self.joint.clone()),
                stop: self.stop.map(|(stop, _)| stop),
                ..event
            });
        } else {
            self.unlisted += 1;
        }
    }

    /// Spreads a part of S over the bins from the last angle to this one, the shorter way.
    fn wear_between(&mut self, angle: f64, part: f64) {
        use std::f64::consts::TAU;
        if part == 0.0 || self.wear.is_empty() {
            return;
        }
        let bins = WEAR_BINS as f64;
        let turn = (angle - self.last_angle + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
        let (from, to) = (
            self.last_angle / TAU * bins,
            (self.last_angle + turn) / TAU * bins,
        );
        let (low, high) = (from.min(to), from.max(to));
        let mut bin = low.floor();
        loop {
            let share = if high > low {
                ((bin + 1.0).min(high) - bin.max(low)) / (high - low)
            } else {
                1.0
            };
            self.wear[bin.rem_euclid(bins) as usize % WEAR_BINS] += share * part;
            bin += 1.0;
            if bin >= high {
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::impact::Sense;
    use crate::element::journal::Journal;
    use crate::element::pair::{Rigid, Surface};
    use crate::element::{BodyId, Marker};
    use linkdyn_linear::math::Vec2;

    fn journal() -> History {
        let centre = Marker {
            body: BodyId::GROUND,
            s: Vec2::zeros(),
        };
        let shape = Shape::Journal(Journal {
            bearing: centre,
            journal: centre,
            clearance: 1.0,
            bearing_radius: 2.0,
        });
        let surface = Surface::Rigid(Rigid {
            restitution: 0.0,
            friction: 0.0,
            sense: Sense::Kinematic,
            latch: None,
        });
        History::new("a", &Pair { shape, surface })
    }

    fn at(angle: f64, sliding: f64) -> Entry {
        let sums = Sums {
            sliding,
            ..Sums::default()
        };
        Entry {
            sums,
            angle,
            ..Entry::default()
        }
    }

    #[test]
    fn wear_goes_to_the_bins_passed_the_shorter_way() {
        let mut history = journal();
        let degrees = f64::to_radians;
        history.begin(&at(degrees(-2.5), 0.0));
        history.go_on(&at(degrees(12.5), 3.0));
        let bins: Vec<(usize, f64)> = history
            .wear
            .iter()
            .copied()
            .enumerate()
            .filter(|(_, s)| *s > 0.0)
            .collect();
        let expected = [(0, 1.0), (1, 1.0), (2, 0.5), (71, 0.5)];
        assert_eq!(bins.len(), 4, "{bins:?}");
        for ((bin, sum), (expected_bin, expected)) in bins.iter().zip(expected) {
            assert!(
                *bin == expected_bin && (sum - expected).abs() < 1e-12,
                "{bins:?}"
            );
        }
    }

    #[test]
    fn wear_at_one_angle_goes_to_one_bin() {
        let mut history = journal();
        history.begin(&at(-1e-12, 0.0));
        history.go_on(&at(-1e-12, 1.0));
        assert_eq!(history.wear[71], 1.0);
    }
}
