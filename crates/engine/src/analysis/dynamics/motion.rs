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
use crate::element::journal::{Contact, ContactId, Phase, Reading, Surface};
use crate::integrate::{Ode, Refused};
use crate::mechanism::driven::{Failure, LAST_STEP};
use crate::mechanism::phases::Phases;
use crate::mechanism::reduced::Reduced;
use crate::system::System;

/// Quantities kept per contact.
const PER_CONTACT: usize = 3;
/// Evaluations remembered: those of one step of any method are among them.
const MARKS: usize = 24;

/// An evaluation: its time, and the largest of all guards there, above zero where an event has passed.
type Mark = (f64, f64);

/// A mechanism in motion.
pub struct Motion<'s> {
    /// Its equations in minimal coordinates.
    pub reduced: Reduced<'s>,
    /// The mechanism by what follows.
    pub(super) phases: &'s Phases<'s>,
    /// First row of each contact that follows its bearing, and the normal force there \[N\].
    pub(super) following: Vec<Option<usize>>,
    pressing: Vec<f64>,
    /// Friction of each contact that follows its bearing, as a force that depends on multipliers.
    pub(super) rubbing: Vec<Option<usize>>,
    /// Component of each contact's bristles, counted from the first.
    bristles: Vec<Option<usize>>,
    /// The same of forces that depend on multipliers.
    pub(super) memories: Vec<Option<usize>>,
    bristle_count: usize,
    moving_drivers: bool,
    /// Why the last evaluation for a stepper was refused, where it was.
    pub(super) refusal: Option<Failure>,
    /// Multipliers (m).
    pub(super) lambda: Vec<f64>,
    marks: [Mark; MARKS],
    next_mark: usize,
}

impl<'s> Motion<'s> {
    /// At the point of these equations, with all contacts in flight.
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

    /// The mechanism with its contacts of the moment.
    pub fn system(&self) -> &'s System {
        self.reduced.driven.system
    }

    /// Number of contacts.
    pub(super) fn contacts(&self) -> usize {
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
    pub(super) fn memory(&self, force: usize) -> Option<usize> {
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
