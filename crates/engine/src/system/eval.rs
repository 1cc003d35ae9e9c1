//! Evaluation of a system at a state, without allocation.

use super::{Pushes, System};
use crate::element::pair::{Contact, ContactId, Reading};
use crate::element::{Applied, Kinematics, Layout, Pose, Twist};
use crate::motion::Jet;
use linkdyn_linear::math::Vec2;

/// What is prescribed from outside at an instant: drivers and clearance links, each with two derivatives, and what the
/// contacts remember.
#[derive(Debug, Clone, PartialEq)]
pub struct Inputs {
    /// Values of the drivers.
    pub drive: Vec<Jet>,
    /// Offsets of the clearance links [m, m/s, m/s²].
    pub(crate) offset: Vec<[Vec2; 3]>,
    /// What the contacts remember.
    pub(crate) contacts: Vec<Contact>,
    /// What the forces that depend on multipliers remember.
    pub(crate) memories: Vec<f64>,
    /// Sides of the formulas' kinks that a motion holds; empty where none are held.
    pub(crate) sides: Vec<i32>,
    /// Numbers from outside, then integrated states.
    pub(crate) states: Vec<f64>,
    /// What is added to φ (m) [m or rad]: gaps that joints are given; empty where there are none.
    pub gaps: Vec<f64>,
    /// Forces from outside the model.
    pub(crate) pushes: Pushes,
    /// Drivers whose acceleration was set, in the place of their laws.
    pub(crate) steered: Vec<Steered>,
    /// \[s\]
    pub time: f64,
}

/// A driver that moves with constant acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Steered {
    /// Its index.
    pub driver: usize,
    /// Since when \[s\].
    pub since: f64,
    /// Its value then, its rate, and its acceleration [rad or m, 1/s, 1/s²].
    pub jet: Jet,
}

impl Inputs {
    /// Drivers at their values at `time`, clearance links closed.
    pub fn at_time(system: &System, time: f64) -> Self {
        let mut inputs = Inputs::still(system);
        inputs.set_time(system, time);
        inputs
    }

    /// Everything zero.
    pub(crate) fn still(system: &System) -> Self {
        Inputs {
            drive: vec![[0.0; 3]; system.drivers.len()],
            offset: vec![[Vec2::zeros(); 3]; system.links],
            contacts: vec![Contact::default(); system.contacts.len()],
            memories: vec![0.0; system.dependent_forces.len()],
            sides: Vec::new(),
            states: {
                let given = system.inputs.iter().map(|input| input.start);
                given
                    .chain(system.states.iter().map(|state| state.start))
                    .collect()
            },
            gaps: Vec::new(),
            pushes: Pushes::None,
            steered: Vec::new(),
            time: 0.0,
        }
    }

    /// Evaluates the drivers' laws.
    pub fn set_time(&mut self, system: &System, time: f64) {
        self.time = time;
        system.drive(time, &mut self.drive);
        for Steered { driver, since, jet } in &self.steered {
            let (passed, [value, rate, acceleration]) = (time - since, *jet);
            self.drive[*driver] = [
                value + passed * (rate + 0.5 * passed * acceleration),
                rate + passed * acceleration,
                acceleration,
            ];
        }
    }
}

/// Workspace of one evaluation: poses, twists, φ, J.
#[derive(Debug, Clone)]
pub struct Evaluation {
    layout: Layout,
    poses: Vec<Pose>,
    twists: Vec<Twist>,
    /// φ (m)
    pub phi: Vec<f64>,
    /// Values of [`System::entries`], plus one cell that takes what belongs nowhere.
    pub jacobian: Vec<f64>,
}

impl Evaluation {
    /// A workspace with all bodies at the origin.
    pub fn new(system: &System) -> Self {
        let bodies = system.bodies.len() + 1;
        Evaluation {
            layout: system.layout.clone(),
            poses: vec![Pose::GROUND; bodies],
            twists: vec![Twist::default(); bodies],
            phi: vec![0.0; system.m()],
            jacobian: vec![0.0; system.entries.len()],
        }
    }

    /// What the elements may look at.
    pub fn kinematics<'a>(&'a self, inputs: &'a Inputs) -> Kinematics<'a> {
        Kinematics {
            poses: &self.poses,
            twists: &self.twists,
            drive: &inputs.drive,
            offset: &inputs.offset,
            sides: &inputs.sides,
            states: &inputs.states,
            contacts: &inputs.contacts,
            time: inputs.time,
        }
    }

    /// Takes the coordinates (n).
    pub fn set_position(&mut self, q: &[f64]) {
        for (pose, columns) in self.poses[1..].iter_mut().zip(self.layout.bodies()) {
            let [x, y, theta] = columns.read(q);
            // Corrections leave most angles as they are, whose sine and cosine are known.
            if theta.to_bits() == pose.theta.to_bits() {
                pose.r = Vec2::new(x, y);
            } else {
                *pose = Pose::new(x, y, theta);
            }
        }
    }

    /// Takes the coordinates (n), with the cosine and the sine of each body's angle.
    pub(crate) fn set_poses(&mut self, q: &[f64], turns: impl Iterator<Item = [f64; 2]>) {
        let poses = self.poses[1..].iter_mut().zip(self.layout.bodies());
        for ((pose, columns), [cos, sin]) in poses.zip(turns) {
            let [x, y, theta] = columns.read(q);
            *pose = Pose {
                r: Vec2::new(x, y),
                theta,
                cos,
                sin,
            };
        }
    }

    /// Takes the velocities (n).
    pub fn set_velocity(&mut self, v: &[f64]) {
        for (twist, columns) in self.twists[1..].iter_mut().zip(self.layout.bodies()) {
            let [x, y, omega] = columns.read(v);
            *twist = Twist {
                v: Vec2::new(x, y),
                omega,
            };
        }
    }

    /// The coordinates taken (n).
    pub(super) fn position(&self) -> Vec<f64> {
        let poses = self.poses[1..].iter();
        poses
            .flat_map(|pose| [pose.r.x, pose.r.y, pose.theta])
            .collect()
    }

    /// The velocities taken (n).
    pub(super) fn velocity(&self) -> Vec<f64> {
        let twists = self.twists[1..].iter();
        twists
            .flat_map(|twist| [twist.v.x, twist.v.y, twist.omega])
            .collect()
    }

    /// φ at the position taken.
    pub fn eval_phi(&mut self, system: &System, inputs: &Inputs) {
        let mut phi = std::mem::take(&mut self.phi);
        let at = self.kinematics(inputs);
        for block in &system.blocks {
            block.constraint.position(&at, &mut phi[block.rows()]);
        }
        phi.iter_mut()
            .zip(&inputs.gaps)
            .for_each(|(phi, gap)| *phi += gap);
        self.phi = phi;
    }

    /// J at the position taken.
    pub fn eval_jacobian(&mut self, system: &System, inputs: &Inputs) {
        let mut values = std::mem::take(&mut self.jacobian);
        let at = self.kinematics(inputs);
        for block in &system.blocks {
            block.constraint.jacobian(&at, &mut values[block.entries()]);
        }
        self.jacobian = values;
    }

    /// φ_t (m).
    pub(crate) fn eval_rate(&self, system: &System, inputs: &Inputs, phi_t: &mut [f64]) {
        let at = self.kinematics(inputs);
        for block in &system.blocks {
            block.constraint.rate(&at, &mut phi_t[block.rows()]);
        }
    }

    /// γ (m) at the velocity taken.
    pub(crate) fn eval_gamma(&self, system: &System, inputs: &Inputs, gamma: &mut [f64]) {
        let at = self.kinematics(inputs);
        for block in &system.blocks {
            block.constraint.gamma(&at, &mut gamma[block.rows()]);
        }
    }

    /// Q (n): gravity, springs, loads, contacts, and what comes from outside.
    pub fn eval_force(&self, system: &System, inputs: &Inputs, q_force: &mut [f64]) {
        let gravity = [system.gravity.x, system.gravity.y];
        system.mass.weigh(&system.layout, gravity, q_force);
        self.push_from_outside(inputs, q_force);
        if system.forces.is_empty() && system.contacts.is_empty() {
            return;
        }
        let still: Vec<Twist>;
        let mut at = self.kinematics(inputs);
        if system.is_slow {
            still = vec![Twist::default(); self.twists.len()];
            at.twists = &still;
        }
        let mut applied = Applied::to(q_force, &system.layout);
        for force in &system.forces {
            force.apply(&at, &mut applied);
        }
        for (contact, memory) in system.contacts.iter().zip(&inputs.contacts) {
            contact.apply(&at, memory, &mut applied);
        }
    }

    /// Adds what comes from outside the model to Q (n).
    pub(crate) fn push_from_outside(&self, inputs: &Inputs, q_force: &mut [f64]) {
        let state = || [self.position(), self.velocity()];
        inputs.pushes.add(state, inputs.time, q_force);
    }

    /// Takes the sides on which the kinks of formulas and cams are at the position and velocity taken.
    pub(crate) fn take_sides(&self, system: &System, inputs: &mut Inputs) {
        let mut sides = std::mem::take(&mut inputs.sides);
        sides.resize(system.kinks.len(), 0);
        let at = self.kinematics(inputs);
        for formula in &system.formulas {
            formula.take_sides(&at, &mut sides);
        }
        for cam in system.cams() {
            cam.take_side(&at, &mut sides);
        }
        inputs.sides = sides;
    }

    /// How far a formula's kinks are beyond the sides that are held, by their scales [–].
    pub(crate) fn beyond(&self, system: &System, inputs: &Inputs, formula: usize) -> f64 {
        let at = self.kinematics(inputs);
        system.formulas[formula].beyond(&at, &system.kinks)
    }

    /// A contact at the position and velocity taken.
    pub(crate) fn contact(&self, system: &System, inputs: &Inputs, id: ContactId) -> Reading {
        system.contacts[id.0].read(&self.kinematics(inputs), &inputs.contacts[id.0])
    }

    /// Elastic energy of all contacts \[J\].
    pub(crate) fn contact_energy(&self, system: &System, inputs: &Inputs) -> f64 {
        let at = self.kinematics(inputs);
        system
            .contacts
            .iter()
            .zip(&inputs.contacts)
            .map(|(contact, memory)| contact.potential(&at, memory))
            .sum()
    }

    /// Power that force elements bring in beside their potential \[W\].
    pub(crate) fn supplied(&self, system: &System, inputs: &Inputs) -> f64 {
        let at = self.kinematics(inputs);
        let forces = system.forces.iter();
        let own: f64 = forces.map(|force| force.supplied(&at)).sum();
        let state = || [self.position(), self.velocity()];
        own + inputs.pushes.power(state, inputs.time)
    }

    /// Kinetic energy ½ vᵀ M v \[J\].
    pub(crate) fn kinetic_energy(&self, system: &System, v: &[f64]) -> f64 {
        system.mass.kinetic_energy(v)
    }

    /// Potential energy of gravity (zero at the ground's origin) and springs \[J\].
    pub(crate) fn potential_energy(&self, system: &System, inputs: &Inputs) -> f64 {
        let at = self.kinematics(inputs);
        let weight: f64 = self.poses[1..]
            .iter()
            .zip(system.layout.bodies())
            .map(|(pose, columns)| -system.mass.of_body(columns) * system.gravity.dot(&pose.r))
            .sum();
        weight
            + system
                .forces
                .iter()
                .map(|force| force.potential(&at))
                .sum::<f64>()
    }

    /// out = Jᵀ x by the entry list.
    pub(crate) fn transposed_product(&self, system: &System, x: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (entry, value) in system.entries.iter().zip(&self.jacobian) {
            if let Some(column) = entry.column() {
                out[column as usize] += value * x[entry.row as usize];
            }
        }
    }

    /// out = J x by the entry list.
    pub fn product(&self, system: &System, x: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (entry, value) in system.entries.iter().zip(&self.jacobian) {
            if let Some(column) = entry.column() {
                out[entry.row as usize] += value * x[column as usize];
            }
        }
    }
}
