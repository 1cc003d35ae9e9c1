//! Values at an output instant.

use crate::element::pair::Reading;
use crate::system::System;

/// Values at one output instant, SI; NaN where a value does not exist.
#[derive(Debug, Clone)]
pub struct Sample {
    /// Coordinates (n).
    pub q: Vec<f64>,
    /// Velocities (n).
    pub v: Vec<f64>,
    /// Accelerations (n).
    pub a: Vec<f64>,
    /// Multipliers (m).
    pub lambda: Vec<f64>,
    /// Q (n): gravity, springs, loads.
    pub force: Vec<f64>,
    /// Q − M a (n): what the constraints carry.
    pub balance: Vec<f64>,
    /// Sizes of the forces that depend on multipliers.
    pub dependent_forces: Vec<f64>,
    /// Joints whose clearance is modelled by contact.
    pub contacts: Vec<ContactSample>,
    /// Elastic energy of the contacts, and what they have dissipated \[J\].
    pub contact_energy: [f64; 2],
}

/// A contact at an output instant.
#[derive(Debug, Clone, Copy, Default)]
pub struct ContactSample {
    /// Where the journal is, and what it carries.
    pub reading: Reading,
    /// 0 flight, 1 contact, 2 contact that sticks.
    pub state: f64,
}

impl Sample {
    /// All zero.
    pub fn new(system: &System) -> Self {
        let zero = vec![0.0; system.n()];
        Sample {
            q: zero.clone(),
            v: zero.clone(),
            a: zero.clone(),
            lambda: vec![0.0; system.m()],
            force: zero.clone(),
            balance: zero,
            dependent_forces: vec![0.0; system.dependent_forces.len()],
            contacts: vec![ContactSample::default(); system.contacts.len()],
            contact_energy: [0.0; 2],
        }
    }
}
