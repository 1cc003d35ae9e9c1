//! Phases of a contact, what ends them, and the episodes that come of it.
//!
//! Each phase has **guards**, functions of the state that become positive where the phase ends:
//!
//! ```text
//! flight     δ                              the journal meets the bearing
//! contact    −δ − ε                         it leaves
//!            −h(δ, δ̇)                       the law would pull, h ≤ 0 (Kelvin and Voigt: K δ + D δ̇)
//!            v_t − v_up,  v_low − v_t       the friction law goes over to its next piece
//! released   −δ − ε,  h(δ, δ̇)               it leaves; it presses again
//!
//! rigid surfaces:
//! flight     min(δ, δ̇)                      an impact
//! contact    −N                             the multiplier of the journal on the surface would pull
//!            v_t − v_up,  v_low − v_t       the friction law goes over to its next piece
//! ```
//!
//! Between events the equations are smooth; events are located on the step's continuous extension.

use crate::contact::friction;
use crate::element::journal::{Contact, Journal, Phase, Reading, Surface};
use crate::system::Scale;
use linkdyn_output::{Episode, Event, EventKind};

/// A journal has left where it is this far, in parts of the bearing's clearance, from the surface: well above round-off.
const GONE: f64 = 1e-10;
/// Approach of a rigid journal that is round-off [L/T]: velocities of constrained bodies are good to some 1e-12.
const CREEP: f64 = 1e-10;
/// Pull on a journal that stays on its bearing which is round-off [M L/T²]: multipliers lose a few digits more.
const PULL: f64 = 1e-9;
/// Sliding velocity past the end of a piece of the friction law from which the next piece holds [L/T]: as little as
/// velocities resolve, for the law is continuous there.
const PAST: f64 = 1e-12;
/// The same for journals that follow rigid bearings, in parts of the threshold: their forces are large where they wedge, and
/// round-off in their velocities too.
const PAST_RIGID: f64 = 1e-4;
/// Bins of the bearing's circumference in which sliding under load is summed.
pub const WEAR_BINS: usize = 72;
/// Episodes, and changes between stick and slip, that are listed at most; all are counted.
const LISTED: usize = 20_000;

/// The largest of a contact's guards, with round-off by the mechanism's own length, mass and time.
pub fn worst_guard(scale: &Scale, journal: &Journal, memory: &Contact, reading: &Reading) -> f64 {
    match (&journal.surface, memory.phase) {
        (Surface::Compliant(_), Phase::Flight) => reading.penetration,
        // On its way out it may still be where it touched.
        (Surface::Rigid(_), Phase::Flight) => {
            let approach = reading.rate - CREEP * scale.velocity();
            reading.penetration.min(approach * scale.time)
        }
        (Surface::Rigid(rigid), Phase::Contact) => lets_go(scale, reading)
            .max(past(&rigid.friction_law(), memory, reading) - PAST_RIGID * rigid.threshold),
        (Surface::Compliant(laws), Phase::Contact) => {
            let hold = laws
                .normal
                .hold(reading.penetration, reading.rate, memory.approach);
            gone(journal, reading)
                .max(-hold)
                .max(past(&laws.friction, memory, reading) - PAST * scale.velocity())
        }
        (Surface::Compliant(laws), Phase::Released) => gone(journal, reading).max(
            laws.normal
                .hold(reading.penetration, reading.rate, memory.approach),
        ),
        (Surface::Rigid(_), Phase::Released) => f64::NEG_INFINITY,
    }
}

/// Positive where a rigid journal that follows its bearing would be pulled.
pub fn lets_go(scale: &Scale, reading: &Reading) -> f64 {
    -reading.normal - PULL * scale.force()
}

/// Positive beyond the ends of the friction law's piece.
fn past(friction: &friction::Law, memory: &Contact, reading: &Reading) -> f64 {
    let (low, up) = friction.bounds(memory.piece);
    (reading.sliding - up).max(low - reading.sliding)
}

fn gone(journal: &Journal, reading: &Reading) -> f64 {
    -reading.penetration - GONE * journal.clearance
}

/// The phase in which a journal is at the start.
pub fn first_phase(journal: &Journal, reading: &Reading) -> Contact {
    let mut memory = Contact::default();
    if reading.penetration > 0.0 && matches!(journal.surface, Surface::Compliant(_)) {
        begin(journal, reading, &mut memory);
    }
    memory
}

fn begin(journal: &Journal, reading: &Reading, memory: &mut Contact) {
    *memory = Contact {
        phase: Phase::Contact,
        approach: reading.rate.max(0.0),
        ..Contact::default()
    };
    if let Surface::Compliant(laws) = &journal.surface {
        memory.piece = laws.friction.piece(reading.sliding);
    }
}

/// What a contact's guards say has happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    Begin,
    Release,
    Press,
    End,
    /// The friction law's next piece holds.
    Piece,
}

/// Changes the memory where a guard has become positive.
pub fn change(
    scale: &Scale,
    journal: &Journal,
    memory: &mut Contact,
    reading: &Reading,
) -> Option<Change> {
    let next_piece = |friction: &friction::Law, memory: &mut Contact, slack: f64| {
        (past(friction, memory, reading) > slack).then(|| {
            memory.piece = friction.piece(reading.sliding);
            Change::Piece
        })
    };
    let laws = match &journal.surface {
        Surface::Compliant(laws) => laws,
        // All else that a rigid journal does comes with impulses.
        Surface::Rigid(rigid) if memory.phase == Phase::Contact => {
            return next_piece(&rigid.friction_law(), memory, PAST_RIGID * rigid.threshold);
        }
        Surface::Rigid(_) => return None,
    };
    match memory.phase {
        Phase::Flight => (reading.penetration > 0.0).then(|| {
            begin(journal, reading, memory);
            Change::Begin
        }),
        Phase::Contact | Phase::Released if gone(journal, reading) > 0.0 => {
            *memory = Contact::default();
            Some(Change::End)
        }
        Phase::Contact => {
            if laws
                .normal
                .hold(reading.penetration, reading.rate, memory.approach)
                < 0.0
            {
                memory.phase = Phase::Released;
                Some(Change::Release)
            } else {
                next_piece(&laws.friction, memory, PAST * scale.velocity())
            }
        }
        Phase::Released => (laws
            .normal
            .hold(reading.penetration, reading.rate, memory.approach)
            > 0.0)
            .then(|| {
                memory.phase = Phase::Contact;
                memory.piece = laws.friction.piece(reading.sliding);
                Change::Press
            }),
    }
}

/// State of a contact in the results: flight, sliding, sticking.
pub fn state(journal: &Journal, memory: &Contact) -> f64 {
    match (&journal.surface, memory.phase) {
        (_, Phase::Flight | Phase::Released) => 0.0,
        (_, Phase::Contact) if sticks(journal, memory) => 2.0,
        (_, Phase::Contact) => 1.0,
    }
}

/// Whether a journal in contact sticks.
pub fn sticks(journal: &Journal, memory: &Contact) -> bool {
    match &journal.surface {
        Surface::Compliant(laws) => laws.friction.sticks(memory.piece),
        Surface::Rigid(rigid) => rigid.friction_law().sticks(memory.piece),
    }
}

/// Dissipated energy, normal impulse and sliding under load since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sums {
    pub dissipated: f64,
    pub impulse: f64,
    pub sliding: f64,
}

impl Sums {
    /// From their components of y.
    pub fn of(parts: &[f64]) -> Self {
        Sums {
            dissipated: parts[0],
            impulse: parts[1],
            sliding: parts[2],
        }
    }
}

/// Everything that is told of a joint's contact.
#[derive(Debug, Clone)]
pub struct History {
    joint: String,
    open: Option<(Episode, Sums)>,
    /// Sums at the last point.
    last: Sums,
    last_angle: f64,
    /// S by angle of the bearing [N·m].
    pub wear: Vec<f64>,
    pub episodes: u64,
    /// Largest penetration of all of them \[m\].
    pub most: f64,
    /// Changes between stick and slip.
    pub switches: u64,
    pub time_in_contact: f64,
    pub events: Vec<Event>,
    /// How many more there were.
    pub unlisted: u64,
}

impl History {
    pub fn new(joint: &str) -> Self {
        History {
            joint: joint.into(),
            open: None,
            last: Sums::default(),
            last_angle: 0.0,
            wear: vec![0.0; WEAR_BINS],
            episodes: 0,
            most: 0.0,
            switches: 0,
            time_in_contact: 0.0,
            events: Vec::new(),
            unlisted: 0,
        }
    }

    /// An episode begins.
    pub fn begin(&mut self, time: f64, reading: &Reading, sums: Sums, angle: f64) {
        let episode = Episode {
            start: time,
            approach_speed: reading.rate,
            ..Episode::default()
        };
        self.open = Some((episode, sums));
        self.last = sums;
        self.last_angle = angle;
    }

    /// The state at a later point of the episode.
    pub fn go_on(&mut self, reading: &Reading, sums: Sums, angle: f64) {
        self.peak(reading.penetration, reading.normal);
        self.wear_between(angle, sums.sliding - self.last.sliding);
        self.last = sums;
        self.last_angle = angle;
    }

    /// Larger penetration or force than the episode's so far.
    pub fn peak(&mut self, penetration: f64, force: f64) {
        if let Some((episode, _)) = &mut self.open {
            episode.peak_penetration = episode.peak_penetration.max(penetration);
            episode.peak_force = episode.peak_force.max(force);
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
    pub fn rest(&mut self, time: f64, reading: &Reading, sums: Sums) {
        if let Some((episode, start)) = &mut self.open {
            episode.end = Some(time);
            episode.separation_speed = Some(-reading.rate);
            episode.impulse = sums.impulse - start.impulse;
            episode.energy_lost = sums.dissipated - start.dissipated;
        }
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
        self.list(Event {
            end_time: episode.end,
            joint: Some(self.joint.clone()),
            episode: Some(episode),
            ..Event::at(EventKind::Contact, episode.start)
        });
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

    /// Impacts have become so low, `height` in words, that the journal follows the surface from now on.
    pub fn follow(&mut self, time: f64, height: &str) {
        let note = format!(
            "impacts lower than {height} would follow: the journal stays on the bearing's surface"
        );
        self.list(Event {
            joint: Some(self.joint.clone()),
            note: Some(note),
            ..Event::at(EventKind::SustainedContact, time)
        });
    }

    /// The journal sticks or slips from now on.
    pub fn switch(&mut self, time: f64, sticks: bool) {
        self.switches += 1;
        let kind = if sticks {
            EventKind::Stick
        } else {
            EventKind::Slip
        };
        self.list(Event {
            joint: Some(self.joint.clone()),
            ..Event::at(kind, time)
        });
    }

    fn list(&mut self, event: Event) {
        if self.events.len() < LISTED {
            self.events.push(event);
        } else {
            self.unlisted += 1;
        }
    }

    /// Spreads a part of S over the bins from the last angle to this one, the shorter way.
    fn wear_between(&mut self, angle: f64, part: f64) {
        use std::f64::consts::TAU;
        if part == 0.0 {
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

    #[test]
    fn wear_goes_to_the_bins_passed_the_shorter_way() {
        let mut history = History::new("a");
        let degrees = f64::to_radians;
        history.begin(0.0, &Reading::default(), Sums::default(), degrees(-2.5));
        history.go_on(
            &Reading::default(),
            Sums {
                sliding: 3.0,
                ..Sums::default()
            },
            degrees(12.5),
        );
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
        let mut history = History::new("a");
        history.begin(0.0, &Reading::default(), Sums::default(), -1e-12);
        history.go_on(
            &Reading::default(),
            Sums {
                sliding: 1.0,
                ..Sums::default()
            },
            -1e-12,
        );
        assert_eq!(history.wear[71], 1.0);
    }
}
