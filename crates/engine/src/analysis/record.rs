//! Result columns of a system, and the rows that fill them: the one place where a quantity becomes a column.

use crate::element::journal::Reading;
use crate::element::{Instant, Measure};
use crate::system::{Evaluation, Inputs, System};
use linkdyn_output::{Column, Trajectory};

/// What an analysis computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contents {
    pub velocities: bool,
    pub accelerations: bool,
    pub reactions: bool,
}

/// Values at one output instant, SI; NaN where a value does not exist.
#[derive(Debug, Clone)]
pub struct Sample {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub a: Vec<f64>,
    pub lambda: Vec<f64>,
    /// Q (n): gravity, springs, loads.
    pub force: Vec<f64>,
    /// Q − M a (n): what the constraints carry.
    pub balance: Vec<f64>,
    /// Sizes of the forces that depend on multipliers.
    pub reactive: Vec<f64>,
    /// Joints whose clearance is modelled by contact.
    pub contacts: Vec<ContactSample>,
    /// Elastic energy of the contacts, and what they have dissipated \[J\].
    pub contact_energy: [f64; 2],
}

/// A contact at an output instant.
#[derive(Debug, Clone, Copy, Default)]
pub struct ContactSample {
    pub reading: Reading,
    /// 0 flight, 1 contact, 2 contact that sticks.
    pub state: f64,
}

impl Sample {
    pub fn new(system: &System) -> Self {
        let zero = vec![0.0; system.n()];
        Sample {
            q: zero.clone(),
            v: zero.clone(),
            a: zero.clone(),
            lambda: vec![0.0; system.m()],
            force: zero.clone(),
            balance: zero,
            reactive: vec![0.0; system.reactive.len()],
            contacts: vec![ContactSample::default(); system.contacts.len()],
            contact_energy: [0.0; 2],
        }
    }
}

/// Columns in the order of the contract, and the trajectory they fill.
pub struct Recorder {
    contents: Contents,
    pub trajectory: Trajectory,
}

impl Recorder {
    pub fn new(system: &System, contents: Contents, rows: usize) -> Self {
        let columns = columns(system, contents);
        let data = Vec::with_capacity(rows * columns.len());
        Recorder {
            contents,
            trajectory: Trajectory { columns, data },
        }
    }

    /// Appends a row; `evaluation` has the sample's position and velocity.
    pub fn push(
        &mut self,
        system: &System,
        evaluation: &Evaluation,
        inputs: &Inputs,
        sample: &Sample,
    ) {
        let at = evaluation.instant(inputs);
        let row = &mut self.trajectory.data;
        row.push(inputs.time);
        for k in 0..system.bodies.len() {
            self.contents.body(&at, system, k, sample, row);
        }
        for point in &system.points {
            let marker = &point.marker;
            let (place, velocity) = (marker.place(&at), marker.velocity(&at));
            row.extend([place.x, place.y]);
            if self.contents.velocities {
                row.extend([velocity.x, velocity.y]);
            }
            if self.contents.accelerations {
                let mut acceleration = marker.centripetal(&at);
                if let Some(columns) = system.layout.columns(marker.body) {
                    let ([x, y, theta], rho) = (columns.read(&sample.a), marker.rho(&at));
                    acceleration.x += x - theta * rho.y;
                    acceleration.y += y + theta * rho.x;
                }
                row.extend([acceleration.x, acceleration.y]);
            }
        }
        // Blocks stand in the order joints, drivers.
        for (joint, block) in system.joints.iter().zip(&system.blocks) {
            let (mut force, torque) = block
                .constraint
                .reaction(&at, &sample.lambda[block.row..block.row + block.rows]);
            let contact = joint.contact.map(|id| sample.contacts[id.0]);
            if let Some(contact) = contact {
                force += contact.reading.force;
            }
            let friction = joint
                .friction
                .map(|friction| sample.reactive[friction.force]);
            if let (Some(at_joint), Some(size)) = (joint.friction, friction) {
                force += system.reactive[at_joint.force].force.reaction(&at, size).0;
            }
            if self.contents.reactions {
                row.extend([force.x, force.y]);
                row.extend(joint.torque.then_some(torque));
                row.extend(friction.filter(|_| self.contents.velocities));
            }
            if let Some(bearing) = &joint.bearing {
                let ContactSample { reading, state } = contact.unwrap_or_else(|| {
                    let offset = joint.clearance.map(|link| &inputs.offset[link.offset]);
                    ContactSample {
                        reading: bearing.held(&at, &joint.points, offset, force),
                        state: 1.0,
                    }
                });
                row.extend([reading.eccentricity.x, reading.eccentricity.y]);
                if self.contents.reactions {
                    row.extend([
                        reading.eccentricity.norm(),
                        reading.penetration.max(0.0),
                        reading.normal,
                        reading.tangential,
                        reading.sliding,
                        state,
                    ]);
                }
            }
        }
        for (k, jet) in inputs.drive.iter().enumerate() {
            row.push(jet[0]);
            if self.contents.reactions {
                row.push(sample.lambda[system.joint_rows() + k]);
            }
        }
        if system.masses_known {
            row.extend([
                evaluation.kinetic_energy(system, &sample.v),
                evaluation.potential_energy(system, inputs),
            ]);
            if self.contents.has_contact_energy(system) {
                row.extend(sample.contact_energy);
            }
        }
    }

    /// Appends a row at an instant without solution: time and driver values only.
    pub fn push_gap(&mut self, inputs: &Inputs) {
        let start = self.trajectory.data.len();
        let columns = &self.trajectory.columns;
        self.trajectory.data.resize(start + columns.len(), f64::NAN);
        self.trajectory.data[start] = inputs.time;
        let values = columns
            .iter()
            .enumerate()
            .filter(|(_, c)| c.name.starts_with("driver.") && c.name.ends_with(".value"));
        for ((k, _), jet) in values.zip(&inputs.drive) {
            self.trajectory.data[start + k] = jet[0];
        }
    }
}

impl Contents {
    /// Motions with forces and a joint with clearance, by whatever model.
    fn has_contact_energy(self, system: &System) -> bool {
        self.reactions
            && self.velocities
            && system.joints.iter().any(|joint| joint.bearing.is_some())
    }

    fn body(self, at: &Instant, system: &System, k: usize, sample: &Sample, row: &mut Vec<f64>) {
        let (pose, twist) = (&at.poses[k + 1], &at.twists[k + 1]);
        // From the centre of mass to the frame's origin.
        let rho = pose.turn(system.bodies[k].origin);
        let omega = twist.omega;
        row.extend([pose.r.x + rho.x, pose.r.y + rho.y, pose.theta]);
        if self.velocities {
            row.extend([twist.v.x - omega * rho.y, twist.v.y + omega * rho.x, omega]);
        }
        if self.accelerations {
            let [x, y, theta] = system.layout.moving(k).read(&sample.a);
            let square = omega * omega;
            row.extend([
                x - theta * rho.y - square * rho.x,
                y + theta * rho.x - square * rho.y,
                theta,
            ]);
        }
    }
}

fn columns(system: &System, contents: Contents) -> Vec<Column> {
    let mut columns = vec![Column {
        name: "time".into(),
        unit: "s",
    }];
    let mut add = |owner: &str, quantities: &[(&str, &'static str)]| {
        columns.extend(quantities.iter().map(|(quantity, unit)| Column {
            name: format!("{owner}.{quantity}"),
            unit,
        }));
    };
    const PLACE: [(&str, &str); 2] = [("x", "m"), ("y", "m")];
    const RATE: [(&str, &str); 2] = [("vx", "m/s"), ("vy", "m/s")];
    const CHANGE: [(&str, &str); 2] = [("ax", "m/s^2"), ("ay", "m/s^2")];
    for body in &system.bodies {
        add(&body.name, &PLACE);
        add(&body.name, &[("angle", "rad")]);
        if contents.velocities {
            add(&body.name, &RATE);
            add(&body.name, &[("omega", "rad/s")]);
        }
        if contents.accelerations {
            add(&body.name, &CHANGE);
            add(&body.name, &[("alpha", "rad/s^2")]);
        }
    }
    for point in &system.points {
        add(&point.name, &PLACE);
        if contents.velocities {
            add(&point.name, &RATE);
        }
        if contents.accelerations {
            add(&point.name, &CHANGE);
        }
    }
    for joint in &system.joints {
        let owner = format!("joint.{}", joint.name);
        if contents.reactions {
            add(&owner, &[("fx", "N"), ("fy", "N")]);
            if joint.torque {
                add(&owner, &[("torque", "N*m")]);
            }
            // At rest there is none.
            if let Some(friction) = joint.friction.filter(|_| contents.velocities) {
                let unit = match friction.measure {
                    Measure::Angle => "N*m",
                    Measure::Length => "N",
                };
                add(&owner, &[("friction", unit)]);
            }
        }
        if joint.bearing.is_some() {
            add(&owner, &[("ex", "m"), ("ey", "m")]);
            if contents.reactions {
                add(&owner, &[("eccentricity", "m"), ("penetration", "m")]);
                add(
                    &owner,
                    &[
                        ("normal_force", "N"),
                        ("tangential_force", "N"),
                        ("sliding_speed", "m/s"),
                        ("state", "1"),
                    ],
                );
            }
        }
    }
    for driver in &system.drivers {
        let owner = format!("driver.{}", driver.name);
        let (value, effort) = match driver.measure {
            Measure::Angle => ("rad", "N*m"),
            Measure::Length => ("m", "N"),
        };
        add(&owner, &[("value", value)]);
        if contents.reactions {
            add(&owner, &[("effort", effort)]);
        }
    }
    if system.masses_known {
        add("energy", &[("kinetic", "J"), ("potential", "J")]);
        if contents.has_contact_energy(system) {
            add("energy", &[("contact", "J"), ("dissipated", "J")]);
        }
    }
    columns
}
