//! The point at which a rigid journal touches its bearing: what impulses there change, and what friction does there.

use crate::analysis::dynamics::flow::Flow;
use crate::analysis::dynamics::modes::{STILL, is_there};
use crate::element::Applied;
use crate::element::pair::{Reading, Surface};
use linkdyn_linear::math::dot;

/// Least height of a rebound, in parts of the clearance, whatever the tolerance.
pub(super) const LOWEST: f64 = 1e-9;
/// Normal speed of a journal that stays where it is [L/T]: above what approaches by round-off.
const AT_REST: f64 = 1e-9;

/// Sliding at which it has ended, in parts of what ends it.
const BEYOND: f64 = 10.0;

/// The same in a motion [m/s].
pub fn at_rest(flow: &Flow) -> f64 {
    AT_REST * flow.system().scale.velocity()
}

/// Directions of an impact and what unit impulses along them change.
pub(super) struct ContactPoint {
    /// Generalized forces of unit forces there (n).
    pub(super) forces: [Vec<f64>; 2],
    rates: [Vec<f64>; 2],
    /// Changes of the velocities (n).
    pub(super) changes: [Vec<f64>; 2],
    /// W \[1/kg\].
    pub(super) mass: [[f64; 2]; 2],
}

impl ContactPoint {
    /// Of a contact with this reading, at the last evaluation.
    pub(super) fn new(flow: &mut Flow, contact: usize, reading: &Reading) -> Self {
        let system = flow.system();
        let at = flow.equations.kinematics();
        let (n, f) = (system.n(), flow.equations.freedom());
        let forces = [[1.0, 0.0], [0.0, 1.0]].map(|unit| {
            let mut force = vec![0.0; n];
            let mut applied = Applied::to(&mut force, &system.layout);
            system.contacts[contact].press(&at, reading, unit, &mut applied);
            force
        });
        let [(normal_rates, normal_change), (rates, change)] = forces.each_ref().map(|force| {
            let (mut rates, mut change) = (vec![0.0; f], vec![0.0; n]);
            flow.equations
                .impulsive_change(force, &mut rates, &mut change);
            (rates, change)
        });
        let (rates, changes) = ([normal_rates, rates], [normal_change, change]);
        let coupling = dot(&forces[1], &changes[0]);
        let mass = [
            [dot(&forces[0], &changes[0]), coupling],
            [coupling, dot(&forces[1], &changes[1])],
        ];
        ContactPoint {
            forces,
            rates,
            changes,
            mass,
        }
    }

    /// What impulses make of `forces` or `changes`.
    pub(super) fn sum(&self, parts: &[Vec<f64>; 2], [normal, tangential]: [f64; 2]) -> Vec<f64> {
        parts[0]
            .iter()
            .zip(&parts[1])
            .map(|(n, t)| normal * n + tangential * t)
            .collect()
    }

    /// Changes the rates u̇ by impulses.
    pub(super) fn apply(&self, rates: &mut [f64], [normal, tangential]: [f64; 2]) {
        for (k, rate) in rates.iter_mut().enumerate() {
            *rate += normal * self.rates[0][k] + tangential * self.rates[1][k];
        }
    }
}

/// Sliding velocity up to which a journal does not slide [m/s]: where the guard of sliding becomes positive it is a little beyond
/// that.
pub(super) fn still(flow: &Flow) -> f64 {
    BEYOND * STILL * flow.system().scale.velocity()
}

/// Whether a rigid journal is on its bearing's surface, slower than `slow`.
pub(super) fn touches(flow: &Flow, contact: usize, slow: f64) -> bool {
    let pair = &flow.system().contacts[contact];
    let reading = flow.reading(contact);
    matches!(pair.surface, Surface::Rigid(_))
        && reading.penetration > -LOWEST * pair.size()
        && is_there(pair, &reading)
        && reading.rate.abs() <= slow
}

/// δ̈ of a contact at the point of the last evaluation [m/s²].
pub(super) fn approach_acceleration(flow: &Flow, contact: usize, point: &ContactPoint) -> f64 {
    let following = &flow.system().contact_rows[contact].sustained;
    let mut gamma = [0.0];
    following.gamma(&flow.equations.kinematics(), &mut gamma);
    -dot(&point.forces[0], flow.equations.acceleration()) - gamma[0]
}

/// How large δ̈ could be by the sizes of accelerations and directions [m/s²]: its round-off is a part of that.
pub(super) fn approach_size(flow: &Flow, point: &ContactPoint) -> f64 {
    let system = flow.system();
    let accelerations = flow.equations.acceleration().iter().enumerate();
    let (mut force, mut most) = (
        0.0,
        system.scale.velocity() / system.scale.time / system.size,
    );
    for (column, a) in accelerations {
        let scale = system.column_scale(column);
        force += (point.forces[0][column] * scale).abs();
        most = f64::max(most, (a / scale).abs());
    }
    force * most
}

/// v̇_t of a contact at the point of the last evaluation, where it does not slide [m/s²].
pub(super) fn sliding_acceleration(flow: &Flow, contact: usize, point: &ContactPoint) -> f64 {
    if flow.system().contacts[contact].stop().is_some() {
        return 0.0;
    }
    let sticking = &flow.system().contact_rows[contact].stuck;
    let mut gamma = [0.0; 2];
    sticking.gamma(&flow.equations.kinematics(), &mut gamma);
    dot(&point.forces[1], flow.equations.acceleration()) + gamma[1]
}

/// A rigid contact whose guard is positive.
pub(super) fn acting(flow: &Flow) -> Option<usize> {
    acting_of(flow, |_| true)
}

/// The same of some of them.
pub(super) fn acting_of(flow: &Flow, counts: impl Fn(usize) -> bool) -> Option<usize> {
    let system = flow.system();
    let mut contacts = (0..system.contacts.len()).filter(|&contact| counts(contact));
    contacts.find(|&contact| {
        let journal = &system.contacts[contact];
        matches!(journal.surface, Surface::Rigid(_))
            && flow.guard(contact, &flow.reading(contact)) > 0.0
    })
}
