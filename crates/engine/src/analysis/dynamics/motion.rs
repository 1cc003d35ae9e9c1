//! The equations that are integrated: minimal coordinates, and with contacts their memories and the energy ledger.
//!
//! ```text
//! y = (u, u̇ | z | W | D, I, S per contact)
//!
//! u, u̇   minimal coordinates and their rates (f, f)        [`crate::mechanism::reduced`]
//! z      bristles of friction laws that have them           ż by the law                           [m]
//!        (of contacts, then of ideal joints)
//! W      work of drivers, loads and dampers                 W' = Σ effort · rate + Σ supplied      [J]
//! D      energy dissipated in a contact                     D' = (N − N_e) δ̇ − T v_t               [J]
//! I      normal impulse                                     I' = N                                 [N·s]
//! S      sliding under load, for wear                       S' = N |v_t|                           [J]
//! ```
//!
//! Without contacts y is (u, u̇ | z) alone.

use super::contact::worst_guard;
use super::settings::Wanted;
use crate::analysis::assembly::ranks;
use crate::element::journal::{Contact, ContactId, Journal, Phase, Reading, Surface};
use crate::integrate::{Ode, Refused, Tolerance};
use crate::mechanism::driven::{Failure, LAST_STEP};
use crate::mechanism::phases::{Exchanged, Phases, Windows};
use crate::mechanism::reduced::Reduced;
use crate::system::Inputs;
use crate::system::System;

/// Quantities kept per contact.
const PER_CONTACT: usize = 3;
/// Evaluations remembered: those of one step of any method are among them.
const MARKS: usize = 24;
/// Rates near zero are measured against this [L/T, 1/T]: slow against the motion, fast against its round-off.
const SLOW: f64 = 2e-3;

/// Errors of the energy ledger are bounded by this, times rtol, of the kinetic energy at the last event.
const LEDGER: f64 = 10.0;
/// No step is bounded by less than this part of what it moves, for evaluations are no better.
const ROUND_OFF: f64 = 1e-14;
/// The same of contacts' lengths, which are differences of coordinates, and of coordinates in sizes.
const LEAST: f64 = 1e-16;
/// Lengths are measured against no less than this part of a clearance [–].
const SHALLOW: f64 = 1e-2;

/// An evaluation: its time, and the largest of all guards there, above zero where an event has passed.
type Mark = (f64, f64);

/// A mechanism in motion.
pub struct Motion<'s> {
    pub reduced: Reduced<'s>,
    phases: &'s Phases<'s>,
    /// First row of each contact that follows its bearing, and the normal force there \[N\].
    following: Vec<Option<usize>>,
    pressing: Vec<f64>,
    /// Friction of each contact that follows its bearing, as a force that depends on multipliers.
    rubbing: Vec<Option<usize>>,
    /// Component of each contact's bristles, counted from the first.
    bristles: Vec<Option<usize>>,
    /// The same of forces that depend on multipliers.
    memories: Vec<Option<usize>>,
    bristle_count: usize,
    moving_drivers: bool,
    /// Why the last evaluation for a stepper was refused, where it was.
    pub(super) refusal: Option<Failure>,
    lambda: Vec<f64>,
    marks: [Mark; MARKS],
    next_mark: usize,
}

impl<'s> Motion<'s> {
    pub fn new(phases: &'s Phases<'s>, reduced: Reduced<'s>) -> Self {
        let system = reduced.driven.system;
        let mut bristle_count = 0;
        let bristles = system
            .contacts
            .iter()
            .map(|contact| match &contact.surface {
                Surface::Compliant(laws) if laws.friction.has_bristle() => {
                    bristle_count += 1;
                    Some(bristle_count - 1)
                }
                Surface::Compliant(_) | Surface::Rigid(_) => None,
            })
            .collect();
        let memories = system.dependent_forces.iter().map(|dependent| {
            dependent.force.memory_scale()?;
            bristle_count += 1;
            Some(bristle_count - 1)
        });
        let memories = memories.collect();
        Motion {
            reduced,
            phases,
            following: vec![None; system.contacts.len()],
            pressing: vec![0.0; system.contacts.len()],
            rubbing: vec![None; system.contacts.len()],
            bristles,
            memories,
            bristle_count,
            moving_drivers: system
                .drivers
                .iter()
                .any(|driver| !driver.law.is_constant()),
            refusal: None,
            lambda: vec![0.0; system.m()],
            marks: [(f64::NEG_INFINITY, f64::NEG_INFINITY); MARKS],
            next_mark: 0,
        }
    }

    pub fn system(&self) -> &'s System {
        self.reduced.driven.system
    }

    fn contacts(&self) -> usize {
        self.reduced.inputs.contacts.len()
    }

    /// Component W of y.
    pub fn work(&self) -> usize {
        2 * self.reduced.freedom() + self.bristle_count
    }

    /// Component D of a contact; I and S follow it.
    pub fn dissipated(&self, contact: usize) -> usize {
        self.work() + 1 + PER_CONTACT * contact
    }

    /// Component z of a contact.
    pub fn bristle(&self, contact: usize) -> Option<usize> {
        Some(2 * self.reduced.freedom() + self.bristles[contact]?)
    }

    /// Component z of a force that depends on multipliers.
    fn memory(&self, force: usize) -> Option<usize> {
        Some(2 * self.reduced.freedom() + (*self.memories.get(force)?)?)
    }

    /// Puts the coordinates and rates at hand into y.
    pub fn state(&self, y: &mut [f64]) {
        self.reduced.state(&mut y[..2 * self.reduced.freedom()]);
    }

    /// A contact at the point of the last evaluation.
    pub fn reading(&self, contact: usize) -> Reading {
        let evaluation = &self.reduced.driven.evaluation;
        let mut reading =
            evaluation.contact(self.system(), &self.reduced.inputs, ContactId(contact));
        if self.following[contact].is_some() {
            let friction = self.rubbing[contact].map_or(0.0, |force| {
                self.reduced.driven.dependent_forces.sizes()[force]
            });
            reading.follow(self.pressing[contact], friction);
        }
        reading
    }

    /// Rigid contacts whose journals follow their bearings, by contact.
    pub fn followers(&self) -> Vec<bool> {
        self.following.iter().map(Option::is_some).collect()
    }

    /// Whether a contact is one of rigid surfaces with friction.
    pub fn rubs(&self, contact: usize) -> bool {
        matches!(&self.system().contacts[contact].surface, Surface::Rigid(rigid) if rigid.friction > 0.0)
    }

    /// First row of a contact that follows its bearing.
    pub fn following_row(&self, contact: usize) -> Option<usize> {
        self.following[contact]
    }

    /// Goes on with other rigid journals on their bearings' surfaces, from the position and velocities at hand.
    ///
    /// # Errors
    /// Where the constraints of these contacts are singular.
    pub fn follow(&mut self, following: &[bool], time: f64) -> Result<(), Failure> {
        let system = self.phases.get(following, &Windows::new(), Exchanged::new);
        let inputs = Inputs::at_time(system, time);
        let (q, v) = (&self.reduced.q, &self.reduced.v);
        let (_, all) = ranks(system, q, &inputs);
        let mut reduced = Reduced::new(system, &all.free_columns, q, v, time)?;
        reduced
            .inputs
            .contacts
            .clone_from(&self.reduced.inputs.contacts);
        for (memory, was) in reduced
            .inputs
            .memories
            .iter_mut()
            .zip(&self.reduced.inputs.memories)
        {
            *memory = *was;
        }
        reduced.lag = self.reduced.lag;
        reduced.driven.done = self.reduced.driven.done;
        reduced.cross_as(&mut self.reduced, following);
        self.reduced = reduced;
        self.lambda.resize(system.m(), 0.0);
        let rows = system
            .joints
            .iter()
            .zip(&system.blocks)
            .filter(|(joint, _)| joint.contact.is_some());
        // Those of contacts stand behind the joints' own.
        let mut next = self.memories.len();
        for (contact, (_, block)) in rows.enumerate() {
            self.following[contact] = following[contact].then_some(block.row);
            let rubs = self.rubs(contact);
            self.rubbing[contact] = (following[contact] && rubs).then_some(next);
            next += usize::from(following[contact] && rubs);
        }
        Ok(())
    }

    /// The follower that an impulse and its change of the velocities pull most towards its bearing, and its own impulse.
    pub fn pulled(&mut self, impulse: &[f64], change: &[f64]) -> Option<(usize, f64)> {
        self.following.iter().any(Option::is_some).then(|| {
            self.reduced
                .impulsive_multipliers(impulse, change, &mut self.lambda);
        })?;
        let rows = self
            .following
            .iter()
            .enumerate()
            .filter_map(|(contact, row)| Some((contact, (*row)?)));
        rows.map(|(contact, row)| (contact, self.lambda[row]))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Work that moving drivers do in an impulse that changes the velocities (n) \[J\].
    pub fn impulsive_work(&mut self, impulse: &[f64], change: &[f64]) -> f64 {
        if !self.moving_drivers {
            return 0.0;
        }
        self.reduced
            .impulsive_multipliers(impulse, change, &mut self.lambda);
        let efforts = &self.lambda[self.system().joint_rows()..];
        efforts
            .iter()
            .zip(&self.reduced.inputs.drive)
            .map(|(effort, jet)| effort * jet[1])
            .sum()
    }

    /// Angle of a contact in the bearing's body \[rad\].
    pub fn contact_angle(&self, contact: usize, reading: &Reading) -> f64 {
        let at = self
            .reduced
            .driven
            .evaluation
            .kinematics(&self.reduced.inputs);
        self.system().contacts[contact].bearing_angle(&at, reading)
    }

    /// Normal forces of the contacts that follow, at the point of the last evaluation.
    fn eval_pressing(&mut self) {
        if self.following.iter().any(Option::is_some) {
            self.reduced.multipliers(&mut self.lambda);
            for (pressing, row) in self.pressing.iter_mut().zip(&self.following) {
                *pressing = row.map_or(0.0, |row| self.lambda[row]);
            }
        }
    }

    /// All of the mechanism at (t, y).
    ///
    /// # Errors
    /// Where the position can't be solved on its branch, or the mass matrix is singular.
    pub fn evaluate(&mut self, t: f64, y: &[f64]) -> Result<(), Failure> {
        self.take_bristles(y);
        self.reduced.evaluate(t, y)?;
        self.eval_pressing();
        Ok(())
    }

    fn take_bristles(&mut self, y: &[f64]) {
        for contact in 0..self.contacts() {
            if let Some(component) = self.bristle(contact) {
                self.reduced.inputs.contacts[contact].bristle = y[component];
            }
        }
        for force in 0..self.memories.len() {
            if let Some(component) = self.memory(force) {
                self.reduced.inputs.memories[force] = y[component];
            }
        }
    }

    /// The largest of all guards at the point of the last evaluation.
    pub fn worst(&self) -> f64 {
        let memories = &self.reduced.inputs.contacts;
        let scale = &self.system().scale;
        let guards = self.system().contacts.iter().zip(memories).enumerate();
        guards.fold(f64::NEG_INFINITY, |worst, (contact, (journal, memory))| {
            worst.max(worst_guard(scale, journal, memory, &self.reading(contact)))
        })
    }

    /// Elastic energy of a contact at the point of the last evaluation, in the phase of `memory` \[J\].
    pub fn stored(&self, contact: usize, memory: &Contact) -> f64 {
        self.system().contacts[contact].stored(self.reading(contact).penetration, memory)
    }

    /// As [`Motion::evaluate`], exactly onto the constraints, whatever the tolerance of the integration.
    ///
    /// # Errors
    /// As there.
    pub fn evaluate_exactly(&mut self, t: f64, y: &[f64]) -> Result<(), Failure> {
        let (lag, last_step) = (self.reduced.lag, self.reduced.driven.last_step);
        self.reduced.lag = 0.0;
        self.reduced.driven.last_step = LAST_STEP;
        let solved = self.evaluate(t, y);
        (self.reduced.lag, self.reduced.driven.last_step) = (lag, last_step);
        solved
    }

    /// Whether an evaluation within (from, to] has passed an event.
    pub fn passed(&self, from: f64, to: f64) -> bool {
        self.marks
            .iter()
            .any(|&(t, guard)| t > from && t <= to && guard > 0.0)
    }

    /// The bound of the local error. In a mechanism with contacts lengths are measured against the smallest clearance, or the
    /// smallest depth at which a contact would hold all the kinetic energy of the moment, where that is less: an error of the
    /// penetration is one of the energy, force times error. Rates near zero are measured
    /// against [`SLOW`].
    pub fn tolerance(&self, wanted: Wanted) -> Tolerance {
        let f = self.reduced.freedom();
        let dimension = self.dimension();
        let system = self.system();
        let (rtol, atol) = (
            wanted.rtol.max(ROUND_OFF),
            wanted.atol.max(ROUND_OFF * system.size.min(1.0)),
        );
        let clearance = system
            .contacts
            .iter()
            .map(|contact| contact.clearance)
            .fold(f64::INFINITY, f64::min);
        let mut tolerance = if clearance.is_finite() {
            Tolerance {
                rtol,
                atol: vec![f64::MAX; dimension],
                cap: vec![f64::INFINITY; dimension],
            }
        } else {
            Tolerance {
                rtol,
                atol: vec![atol; dimension],
                cap: Vec::new(),
            }
        };
        for (force, dependent) in system.dependent_forces.iter().enumerate() {
            if let (Some(component), Some(scale)) =
                (self.memory(force), dependent.force.memory_scale())
            {
                tolerance.atol[component] = rtol * scale;
            }
        }
        if !clearance.is_finite() {
            return tolerance;
        }
        let energy = self
            .reduced
            .driven
            .evaluation
            .kinetic_energy(system, &self.reduced.v);
        let depth = system
            .contacts
            .iter()
            .map(|contact| depth(contact, energy))
            .fold(f64::INFINITY, f64::min);
        for (k, pin) in self.reduced.driven.pins.iter().enumerate() {
            let small = depth / system.size * system.column_scale(pin.column);
            tolerance.cap[k] = small;
            tolerance.atol[k] = atol
                .min(rtol * small)
                .max(LEAST * system.column_scale(pin.column));
            let rate = system.column_scale(pin.column) / system.scale.time;
            tolerance.atol[f + k] = atol.min(SLOW * rtol * rate);
        }
        for contact in 0..self.contacts() {
            if let Some(component) = self.bristle(contact) {
                tolerance.atol[component] = rtol * clearance;
            }
            if energy > 0.0 {
                tolerance.atol[self.dissipated(contact)] = LEDGER * rtol * energy;
            }
        }
        // Where all is smooth the motion needs no steps as short as the work of its drivers.
        if energy > 0.0 {
            tolerance.atol[self.work()] = LEDGER * rtol * energy;
        }
        tolerance
    }

    fn eval_ledger(&mut self, t: f64, dy: &mut [f64]) {
        let system = self.system();
        let work = self.work();
        let mut power = self
            .reduced
            .driven
            .evaluation
            .supplied(system, &self.reduced.inputs);
        if self.moving_drivers {
            self.reduced.multipliers(&mut self.lambda);
            let efforts = &self.lambda[system.joint_rows()..];
            power += efforts
                .iter()
                .zip(&self.reduced.inputs.drive)
                .map(|(effort, jet)| effort * jet[1])
                .sum::<f64>();
        }
        power += self.reduced.driven.dependent_forces.power(&self.reduced.v);
        // Of contacts it counts as dissipated there.
        for contact in 0..self.contacts() {
            if self.rubbing[contact].is_some() {
                power += self.reading(contact).dissipation;
            }
        }
        dy[work] = power;
        let mut worst = f64::NEG_INFINITY;
        for contact in 0..self.contacts() {
            let reading = self.reading(contact);
            let memory = self.reduced.inputs.contacts[contact];
            worst = worst.max(worst_guard(
                &system.scale,
                &system.contacts[contact],
                &memory,
                &reading,
            ));
            let k = self.dissipated(contact);
            let pressed = if memory.phase == Phase::Contact {
                reading.normal
            } else {
                0.0
            };
            dy[k..k + PER_CONTACT].copy_from_slice(&[
                reading.dissipation,
                pressed,
                pressed * reading.sliding.abs(),
            ]);
            if let Some(component) = self.bristle(contact) {
                dy[component] = reading.bristle_rate;
            }
        }
        self.marks[self.next_mark] = (t, worst);
        self.next_mark = (self.next_mark + 1) % MARKS;
    }
}

/// Depth at which a contact would hold this energy, within [`SHALLOW`] … 1 of its clearance \[m\].
fn depth(contact: &Journal, energy: f64) -> f64 {
    let Surface::Compliant(laws) = &contact.surface else {
        return contact.clearance;
    };
    let (mut low, mut high) = (SHALLOW * contact.clearance, contact.clearance);
    if laws.normal.elastic_energy(high) <= energy {
        return high;
    }
    // Its order of magnitude is enough.
    while high > 1.1 * low {
        let middle = (low * high).sqrt();
        if laws.normal.elastic_energy(middle) < energy {
            low = middle
        } else {
            high = middle
        }
    }
    low
}

/// (u̇, ü) of the last evaluation.
fn rates(reduced: &Reduced, y: &[f64], dy: &mut [f64]) {
    let f = reduced.freedom();
    dy[..f].copy_from_slice(&y[f..2 * f]);
    dy[f..2 * f].copy_from_slice(reduced.accelerations());
}

impl Ode for Reduced<'_> {
    fn dimension(&self) -> usize {
        2 * self.freedom()
    }

    fn eval(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused> {
        self.evaluate(t, y).map_err(|_| Refused)?;
        rates(self, y, dy);
        Ok(())
    }

    fn accept(&mut self, t: f64, y: &[f64]) {
        Reduced::accept(self, t, &y[..2 * self.freedom()]);
    }
}

impl Ode for Motion<'_> {
    fn dimension(&self) -> usize {
        let contacts = self.contacts();
        if contacts == 0 {
            self.work()
        } else {
            self.work() + 1 + PER_CONTACT * contacts
        }
    }

    fn eval(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused> {
        self.take_bristles(y);
        let evaluated = self.reduced.evaluate(t, y);
        self.refusal = evaluated.err();
        evaluated.map_err(|_| Refused)?;
        rates(&self.reduced, y, dy);
        self.eval_pressing();
        for (force, dependent) in self.system().dependent_forces.iter().enumerate() {
            if let Some(component) = self.memory(force) {
                let Reduced { driven, inputs, .. } = &self.reduced;
                let at = driven.evaluation.kinematics(inputs);
                dy[component] = dependent.force.memory_rate(&at, inputs.memories[force]);
            }
        }
        if self.contacts() > 0 {
            self.eval_ledger(t, dy);
        }
        Ok(())
    }

    fn accept(&mut self, t: f64, y: &[f64]) {
        Ode::accept(&mut self.reduced, t, y);
    }
}
