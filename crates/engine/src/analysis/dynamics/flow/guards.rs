//! The guards of the flow: those of contacts, and those of formulas and cams whose kinks are held on one side each, so that the
//! flow is smooth between events.

use super::Flow;
use super::formulas::{PAST, beyond, sample_sides};
use super::marks::{Least, Mark, Sample};
use crate::analysis::dynamics::modes::{GONE, creep};
use crate::element::pair::{Phase, Reading, Surface};

/// Penetration, in parts of the mechanism, that round-off may make.
const GRAZE: f64 = 1e-12;
/// What places are rounded by, in parts of the mechanism.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// How far it is at an event: less, so that one that was located is there as well when the mechanism is evaluated again, with
/// round-off of its own.
const STILL_PAST: f64 = 0.5 * PAST;

impl Flow<'_> {
    /// Whether any formula or cam has kinks.
    pub fn has_kinks(&self) -> bool {
        !self.system().kinks.is_empty()
    }

    /// Holds all formulas and cams on the sides on which they are at the point of the last evaluation.
    pub fn freeze_branches(&mut self) {
        if self.has_kinks() {
            self.equations.take_sides();
        }
    }

    /// The formulas whose sides are held.
    fn held_formulas(&self) -> std::ops::Range<usize> {
        match self.has_kinks() {
            true => 0..self.system().formulas.len(),
            false => 0..0,
        }
    }

    /// The largest guard of formulas and cams at the point of the last evaluation: positive where one is beyond its side.
    pub(super) fn formula_guard(&self) -> f64 {
        let guards = self.held_formulas().map(|formula| self.beyond(formula));
        guards.fold(self.cam_guard(), f64::max)
    }

    /// The largest guard of the cams: positive where one is beyond the stretch of its law.
    fn cam_guard(&self) -> f64 {
        let at = self.equations.kinematics();
        let guards = self.system().cams().map(|cam| cam.beyond(&at) - PAST);
        guards.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The guard of a formula where its arguments have these levels.
    pub fn guard_at(&self, formula: usize, levels: &[f64]) -> f64 {
        let system = self.system();
        let sides = &self.equations.inputs.sides;
        system.formulas[formula].beyond_at(levels, sides, &system.kinks) - PAST
    }

    /// Whether a cam comes to another stretch of its law at the point of the last evaluation.
    pub fn turns_over(&self) -> bool {
        self.has_kinks() && self.cam_guard() > STILL_PAST - PAST
    }

    fn beyond(&self, formula: usize) -> f64 {
        beyond(&self.equations, formula)
    }

    /// The force of the first formula that is beyond its side at the point of the last evaluation.
    pub fn switching(&self) -> Option<usize> {
        let mut formulas = self.held_formulas();
        let formula = formulas.find(|formula| self.beyond(*formula) > STILL_PAST - PAST)?;
        Some(self.system().formulas[formula].force)
    }

    /// The force of the first formula that has no value at the point of the last evaluation.
    pub fn without_value(&self) -> Option<usize> {
        let at = self.equations.kinematics();
        let mut formulas = self.system().formulas.iter();
        let formula = formulas.find(|formula| !formula.value(&at).is_finite())?;
        Some(formula.force)
    }
}

impl<'s> Flow<'s> {
    /// A step begins.
    pub fn begin_step(&mut self) {
        self.marks.begin_step();
    }

    /// The evaluations of the last step, from one time to another, the last one first.
    pub fn evaluations(&self, from: f64, to: f64) -> impl Iterator<Item = Mark<'_>> {
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

    /// A contact with this reading and guard. One that touches has no sample.
    pub(super) fn sample_contact(&self, contact: usize, reading: &Reading, guard: f64) -> Sample {
        let system = self.system();
        let pair = &system.contacts[contact];
        match self.memories()[contact].phase {
            _ if guard == f64::NEG_INFINITY => Sample::never(),
            Phase::Flight if pair.is_one_way() || pair.is_timed() => Sample::never(),
            Phase::Flight => {
                let level = pair.level(&self.equations.kinematics(), reading);
                let graze = GRAZE * system.scale.length;
                Sample {
                    value: level.value - graze,
                    rate: level.rate,
                    rooms: level.rooms.map(|room| room + GONE * pair.size() - graze),
                }
            }
            Phase::Behind => Sample::of(guard),
            Phase::Contact | Phase::Released => Sample::never(),
        }
    }

    /// What of a guard makes no event.
    pub fn least(&self, guard: usize) -> Least {
        let system = self.system();
        let Some(pair) = system.contacts.get(guard) else {
            return Least::default();
        };
        Least {
            rate: match (self.memories()[guard].phase, &pair.surface) {
                (Phase::Flight, Surface::Rigid(_)) => creep(&system.scale),
                (Phase::Flight, Surface::Compliant(_)) => f64::NEG_INFINITY,
                _ => 0.0,
            },
            change: ROUND_OFF * system.scale.length.max(pair.size()),
        }
    }

    /// Whether an evaluation within (from, to] has passed an event.
    pub fn has_passed(&self, from: f64, to: f64) -> bool {
        self.marks.has_passed(from, to)
    }
}
