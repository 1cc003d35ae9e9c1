//! The flow between events: the equations that are integrated, with the memories of contacts and the energy ledger beside them
//! (see [`super::state`] for y).

mod formulas;
mod grip;
mod guards;
mod implicit;
mod marks;
mod sustained;
mod timed;
mod tolerance;

use super::modes::largest_guard;
use super::state::{Layout, State};
use crate::element::pair::{Contact, ContactId, Phase, Reading};
use crate::integrate::{Implicit, Ode, Refused};
use crate::mechanism::driven::Failure;
use crate::mechanism::phases::Phases;
use crate::mechanism::reduced::Reduced;
use crate::system::System;
use formulas::{levels, sample_sides};
use grip::{Grip, Sustained};
use marks::Marks;
pub use marks::{Least, Mark, Sample};

/// Components of a ledger that is short.
const SHORT: usize = 64;

/// A mechanism in motion, with the rows of the moment.
#[derive(Clone)]
pub struct Flow<'s> {
    /// Its equations in minimal coordinates.
    pub(super) equations: Reduced<'s>,
    /// The mechanism by the rows in force.
    phases: &'s Phases<'s>,
    /// Contacts whose journals stay on their bearings, as constraints.
    sustained: Vec<Option<Sustained>>,
    layout: Layout,
    /// Factors are kept where the position is this far from theirs, without sustained contacts [rad or sizes].
    lag: f64,
    moving_drivers: bool,
    /// y has coordinates and rates alone, and nothing watches while it goes on.
    is_bare: bool,
    /// Why the last evaluation for a stepper was refused, where it was.
    refusal: Option<Failure>,
    /// Multipliers (m).
    lambda: Vec<f64>,
    marks: Marks,
    /// The real and complex numbers that an implicit method's systems are of.
    shifts: Vec<[f64; 2]>,
}

impl<'s> Flow<'s> {
    /// At the point of these equations, with all contacts in flight.
    pub fn new(phases: &'s Phases<'s>, equations: Reduced<'s>) -> Self {
        let system = equations.system();
        let layout = Layout::new(system, equations.freedom());
        let is_bare = layout.dimension() == layout.mechanical().len()
            && system.contacts.is_empty()
            && system.kinks.is_empty();
        Flow {
            layout,
            is_bare,
            equations,
            lag: 0.0,
            phases,
            sustained: vec![None; system.contacts.len()],
            moving_drivers: system.drivers.iter().any(|driver| !driver.is_still()),
            refusal: None,
            lambda: vec![0.0; system.m()],
            marks: Marks::new([system.guards(), system.kinked_arguments()]),
            shifts: Vec::with_capacity(4),
        }
    }

    /// The mechanism with its rows of the moment.
    pub fn system(&self) -> &'s System {
        self.equations.system()
    }

    /// Factors are kept where the position is this far from theirs [rad or sizes].
    pub fn set_lag(&mut self, lag: f64) {
        self.lag = lag;
        self.equations.set_lag(lag);
    }

    /// Where the parts of y are.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// What contacts remember.
    pub fn memories(&self) -> &[Contact] {
        &self.equations.inputs.contacts
    }

    /// The same, to be changed by events.
    pub fn memory_mut(&mut self, contact: usize) -> &mut Contact {
        &mut self.equations.inputs.contacts[contact]
    }

    /// Whether a contact presses.
    pub fn is_in_contact(&self, contact: usize) -> bool {
        self.memories()[contact].phase == Phase::Contact
    }

    /// Puts the coordinates and rates at hand into y.
    pub fn store(&self, state: &mut State) {
        self.equations.state(state.mechanical_mut());
    }

    /// A contact at the point of the last evaluation.
    pub fn reading(&self, contact: usize) -> Reading {
        let Reduced { inputs, .. } = &self.equations;
        let evaluation = self.equations.evaluation();
        let mut reading = evaluation.contact(self.system(), inputs, ContactId(contact));
        if let Some(sustained) = &self.sustained[contact] {
            let normal = sustained.normal_force;
            match sustained.grip {
                Grip::None => reading.slide(normal, 0.0),
                Grip::Slides(force) => {
                    let sizes = self.equations.dependent_forces().sizes();
                    reading.slide(normal, sizes[force]);
                }
                Grip::Sticks(tangential) => reading.stick([normal, tangential]),
            }
        }
        reading
    }

    /// Work that moving drivers do in an impulse that changes the velocities (n) \[J\].
    pub fn impulsive_work(&mut self, impulse: &[f64], change: &[f64]) -> f64 {
        if !self.moving_drivers {
            return 0.0;
        }
        self.equations
            .impulsive_multipliers(impulse, change, &mut self.lambda);
        self.power_of_efforts()
    }

    /// Efforts of drivers, which are in the multipliers at hand, times their rates.
    fn power_of_efforts(&self) -> f64 {
        let efforts = &self.lambda[self.system().joint_rows()..];
        efforts
            .iter()
            .zip(&self.equations.inputs.drive)
            .map(|(effort, jet)| effort * jet[1])
            .sum()
    }

    /// Angle of a contact in the bearing's body \[rad\].
    pub fn contact_angle(&self, contact: usize, reading: &Reading) -> f64 {
        let at = self.equations.kinematics();
        self.system().contacts[contact].angle(&at, reading)
    }

    /// All of the mechanism at (t, y).
    ///
    /// # Errors
    /// Where the position can't be solved on its branch, or the mass matrix is singular.
    pub fn evaluate(&mut self, t: f64, y: &[f64]) -> Result<(), Failure> {
        self.take_bristles(y);
        self.equations.evaluate(t, &y[self.layout.mechanical()])?;
        self.eval_normal_forces();
        Ok(())
    }

    /// As [`Flow::evaluate`], exactly onto the constraints, whatever the tolerance of the integration.
    ///
    /// # Errors
    /// As there.
    pub fn evaluate_exactly(&mut self, t: f64, y: &[f64]) -> Result<(), Failure> {
        self.take_bristles(y);
        self.equations
            .evaluate_exactly(t, &y[self.layout.mechanical()])?;
        self.eval_normal_forces();
        Ok(())
    }

    fn take_bristles(&mut self, y: &[f64]) {
        let inputs = &mut self.equations.inputs;
        let own = self.layout.states();
        let given = inputs.states.len() - own.len();
        let states = inputs.states[given..].iter_mut().zip(own);
        states.for_each(|(state, component)| *state = y[component]);
        for (contact, memory) in inputs.contacts.iter_mut().enumerate() {
            if let Some(component) = self.layout.bristle(contact) {
                memory.bristle = y[component];
            }
        }
        for force in 0..self.layout.forces() {
            if let Some(component) = self.layout.memory(force) {
                inputs.memories[force] = y[component];
            }
        }
    }

    /// The largest of all guards at the point of the last evaluation.
    pub fn largest_guard(&self) -> f64 {
        let contacts = 0..self.memories().len();
        contacts.fold(self.formula_guard(), |largest, contact| {
            largest.max(self.guard(contact, &self.reading(contact)))
        })
    }

    /// The largest of a contact's guards with this reading.
    pub fn guard(&self, contact: usize, reading: &Reading) -> f64 {
        if self.is_carried(contact) {
            return f64::NEG_INFINITY;
        }
        let system = self.system();
        let (pair, memory) = (&system.contacts[contact], &self.memories()[contact]);
        largest_guard(&system.scale, pair, memory, reading)
    }

    /// Elastic energy of a contact at the point of the last evaluation, in the phase of `memory` \[J\].
    pub fn stored(&self, contact: usize, memory: &Contact) -> f64 {
        self.system().contacts[contact].stored(self.reading(contact).penetration, memory)
    }

    /// Why the last evaluation for a stepper was refused. Values that are not finite come of singular equations.
    pub fn refusal(&self) -> Failure {
        self.refusal.unwrap_or(Failure::Singular)
    }

    /// f at the point of the last evaluation.
    pub(super) fn eval_rates(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        rates(&self.equations, y, dy);
        for (force, dependent) in self.system().dependent_forces.iter().enumerate() {
            if let Some(component) = self.layout.memory(force) {
                let at = self.equations.kinematics();
                let memory = self.equations.inputs.memories[force];
                dy[component] = dependent.force.memory_rate(&at, memory);
            }
        }
        let states = self.system().states.iter().zip(self.layout.states());
        for (state, component) in states {
            dy[component] = state.rate.value(&self.equations.kinematics());
        }
        if !self.sustained.is_empty() {
            self.eval_ledger(t, dy);
        } else if self.has_kinks() {
            levels(&self.equations, self.marks.levels_mut());
            let largest = sample_sides(&self.equations, self.marks.samples_mut());
            self.marks.note(t, largest);
        }
    }

    /// Rates of W, D, I, S and of the contacts' bristles.
    fn eval_ledger(&mut self, t: f64, dy: &mut [f64]) {
        let system = self.system();
        let evaluation = self.equations.evaluation();
        let mut power = evaluation.supplied(system, &self.equations.inputs);
        if self.moving_drivers {
            power += self.equations.constraint_power();
        }
        let dependent = self.equations.dependent_forces();
        power += dependent.power(self.equations.velocity());
        // Of contacts it counts as dissipated there.
        for (contact, sustained) in self.sustained.iter().enumerate() {
            if sustained.is_some_and(|held| matches!(held.grip, Grip::Slides(_))) {
                power += self.reading(contact).dissipation;
            }
        }
        dy[self.layout.work()] = power;
        levels(&self.equations, self.marks.levels_mut());
        let sides = &mut self.marks.samples_mut()[system.contacts.len()..];
        let mut largest = sample_sides(&self.equations, sides);
        for contact in 0..system.contacts.len() {
            let reading = self.reading(contact);
            let guard = self.guard(contact, &reading);
            self.marks.samples_mut()[contact] = self.sample_contact(contact, &reading, guard);
            largest = largest.max(guard);
            let memory = &self.memories()[contact];
            let pressed = if memory.phase == Phase::Contact {
                reading.normal
            } else {
                0.0
            };
            dy[self.layout.sums(contact)].copy_from_slice(&[
                reading.dissipation,
                pressed,
                pressed * reading.sliding.abs(),
            ]);
            if let Some(component) = self.layout.bristle(contact) {
                dy[component] = reading.bristle_rate;
            }
        }
        self.marks.note(t, largest);
    }
}

/// (u̇, ü) of the last evaluation.
fn rates(equations: &Reduced, y: &[f64], dy: &mut [f64]) {
    let f = equations.freedom();
    // One number each is sooner copied by itself.
    if let (1, [acceleration]) = (f, equations.accelerations()) {
        (dy[0], dy[1]) = (y[1], *acceleration);
        return;
    }
    dy[..f].copy_from_slice(&y[f..2 * f]);
    dy[f..2 * f].copy_from_slice(equations.accelerations());
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

    fn implicit(&mut self) -> Option<&mut dyn Implicit> {
        self.is_implicit().then_some(self as &mut dyn Implicit)
    }
}

impl Implicit for Reduced<'_> {
    fn linearise(&mut self) -> Result<(), Refused> {
        Reduced::linearise(self).map_err(|_| Refused)
    }

    fn factor(&mut self, real: f64, complex: &[[f64; 2]]) -> bool {
        self.factor_shifted(real, complex)
    }

    fn solve(&mut self, b: &mut [f64]) {
        self.solve_shifted(b);
    }

    fn solve_complex(&mut self, number: usize, b: [&mut [f64]; 2]) {
        self.solve_shifted_complex(number, b);
    }

    fn eval_stage(
        &mut self,
        stage: (usize, bool),
        t: f64,
        y: &[f64],
        dy: &mut [f64],
    ) -> Result<(), Refused> {
        self.evaluate_stage(stage, t, y).map_err(|_| Refused)?;
        rates(self, y, dy);
        Ok(())
    }
}

impl Ode for Flow<'_> {
    fn dimension(&self) -> usize {
        self.layout.dimension()
    }

    /// The ledger is asked by nothing. A short one stands among the others: a small matrix of all is as cheap.
    fn asked(&self) -> usize {
        let (asked, all) = (self.layout.work(), self.layout.dimension());
        if all - asked > SHORT { asked } else { all }
    }

    fn eval(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused> {
        if self.is_bare {
            let evaluated = self.equations.evaluate_within(t, y);
            self.refusal = evaluated.err();
            evaluated.map_err(|_| Refused)?;
            rates(&self.equations, y, dy);
            return Ok(());
        }
        self.take_bristles(y);
        let evaluated = self
            .equations
            .evaluate_within(t, &y[self.layout.mechanical()]);
        if evaluated.is_ok() {
            self.eval_normal_forces();
        }
        self.refusal = evaluated.err();
        evaluated.map_err(|_| Refused)?;
        self.eval_rates(t, y, dy);
        Ok(())
    }

    fn accept(&mut self, t: f64, y: &[f64]) {
        Ode::accept(&mut self.equations, t, y);
    }

    fn implicit(&mut self) -> Option<&mut dyn Implicit> {
        self.is_implicit().then_some(self as &mut dyn Implicit)
    }
}
