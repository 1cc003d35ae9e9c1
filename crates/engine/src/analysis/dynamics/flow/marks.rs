//! The guards at the evaluations of the last step.

use super::Flow;
use super::formulas::sample_sides;
use crate::analysis::dynamics::modes::creep;
use crate::element::pair::{Contact, Pair, Phase, Reading, Surface};
use crate::system::Scale;

/// Evaluations remembered: those of one step of any method are among them.
const REMEMBERED: usize = 32;
/// Those of these last ones that are within a step are its own, or of a longer one before it.
const LAST: usize = 24;
/// Penetration, in parts of the mechanism, that round-off may make.
const GRAZE: f64 = 1e-12;

/// A guard at one time, by what it is the least of; each is smooth within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The guard itself; δ of a contact in flight \[m\].
    pub value: f64,
    /// Its rate; NaN where that is not known.
    pub rate: f64,
    /// How far a contact in flight is from where its surface ends \[m\]; infinite of all others.
    pub room: f64,
    /// A rate that is not above this makes no event, of a guard that comes above zero only where it rises.
    pub least: f64,
}

impl Sample {
    /// Of a guard whose rate is not known.
    pub fn of(value: f64) -> Self {
        Sample {
            value,
            rate: f64::NAN,
            room: f64::INFINITY,
            least: 0.0,
        }
    }

    /// Of a guard that is looked at where the mechanism is evaluated, and nowhere between.
    pub fn never() -> Self {
        Sample::of(f64::NEG_INFINITY)
    }

    /// Of a contact.
    pub fn of_contact(
        scale: &Scale,
        (pair, memory): (&Pair, &Contact),
        reading: &Reading,
        guard: f64,
    ) -> Self {
        match memory.phase {
            Phase::Flight if pair.is_one_way() || pair.is_timed() => Sample::never(),
            Phase::Flight => Sample {
                value: reading.penetration - GRAZE * scale.length,
                rate: reading.rate,
                room: reading.room - GRAZE * scale.length,
                least: match pair.surface {
                    Surface::Rigid(_) => creep(scale),
                    Surface::Compliant(_) => f64::NEG_INFINITY,
                },
            },
            Phase::Behind => Sample::of(guard),
            Phase::Contact | Phase::Released => Sample::never(),
        }
    }
}

/// Times of evaluations, the guards there, and the largest of all of them, above zero where an event has passed.
pub(super) struct Marks {
    marks: [(f64, f64); REMEMBERED],
    next: usize,
    /// Evaluations since the step began.
    since: usize,
    /// Those of each guard, evaluation by evaluation.
    samples: Vec<Sample>,
    guards: usize,
}

impl Marks {
    /// None yet, of so many guards.
    pub fn new(guards: usize) -> Self {
        Marks {
            marks: [(f64::NEG_INFINITY, f64::NEG_INFINITY); REMEMBERED],
            next: 0,
            since: 0,
            samples: vec![Sample::never(); REMEMBERED * guards],
            guards,
        }
    }

    /// The samples of an evaluation that is noted next.
    pub fn samples_mut(&mut self) -> &mut [Sample] {
        &mut self.samples[self.next * self.guards..][..self.guards]
    }

    /// An evaluation, and the largest of its guards.
    pub fn note(&mut self, t: f64, guard: f64) {
        self.marks[self.next] = (t, guard);
        self.next = (self.next + 1) % REMEMBERED;
        self.since += 1;
    }

    /// A step begins.
    pub fn begin_step(&mut self) {
        self.since = 0;
    }

    /// Where the last evaluations are, the last one first.
    fn newest(&self) -> impl Iterator<Item = usize> {
        (1..=REMEMBERED).map(|back| (self.next + REMEMBERED - back) % REMEMBERED)
    }

    /// Whether one within (from, to] has passed an event.
    pub fn has_passed(&self, from: f64, to: f64) -> bool {
        self.newest().take(LAST).any(|index| {
            let (t, guard) = self.marks[index];
            t > from && t <= to && guard > 0.0
        })
    }

    /// The evaluations of the step from one time to another, with the largest guard and all samples of each, the last one first,
    /// and that of its beginning. Those of a longer step that was rejected stand before one beyond its end.
    pub fn of_step(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64, &[Sample])> {
        let time = |index: &usize| self.marks[*index].0;
        let own = self.newest().take(self.since);
        let own = own.take_while(move |index| time(index) <= to);
        let before = self.newest().skip(self.since);
        let beginning = before.filter(move |index| time(index) == from).take(1);
        let all = own.filter(move |index| time(index) >= from);
        all.chain(beginning).map(|index| {
            let (time, largest) = self.marks[index];
            let samples = &self.samples[index * self.guards..][..self.guards];
            (time, largest, samples)
        })
    }
}

impl<'s> Flow<'s> {
    /// A step begins.
    pub fn begin_step(&mut self) {
        self.marks.begin_step();
    }

    /// The evaluations of the last step, from one time to another, the last one first: the time, the largest guard, and a sample
    /// of each guard.
    pub fn evaluations(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64, &[Sample])> {
        self.marks.of_step(from, to)
    }

    /// The largest of all guards at the point of the last evaluation, and a sample of each: of contacts, formulas and cams.
    pub fn sample(&self, samples: &mut [Sample]) -> f64 {
        let (contacts, others) = samples.split_at_mut(self.sustained.len());
        let mut largest = sample_sides(&self.equations, others);
        for (contact, sample) in contacts.iter_mut().enumerate() {
            let reading = self.reading(contact);
            let guard = self.guard(contact, &reading);
            *sample = self.sample_contact(contact, &reading, guard);
            largest = largest.max(guard);
        }
        largest
    }

    /// A contact with this reading and guard; one without a guard has no sample.
    pub(super) fn sample_contact(&self, contact: usize, reading: &Reading, guard: f64) -> Sample {
        let (system, memory) = (self.system(), &self.memories()[contact]);
        match guard > f64::NEG_INFINITY {
            true => {
                let pair = &system.contacts[contact];
                Sample::of_contact(&system.scale, (pair, memory), reading, guard)
            }
            false => Sample::never(),
        }
    }

    /// Whether an evaluation within (from, to] has passed an event.
    pub fn has_passed(&self, from: f64, to: f64) -> bool {
        self.marks.has_passed(from, to)
    }
}
