//! The point at which a rigid journal touches its bearing: what pushes there change, and what friction does there.

use super::motion::Motion;
use crate::element::journal::{Reading, Surface};
use crate::element::{Applied, Constraint, Kinematics};
use linkdyn_linear::math::dot;
use nalgebra::DMatrix;

/// Least height of a rebound, in parts of the clearance, whatever the tolerance.
pub(super) const LOWEST: f64 = 1e-9;
/// Normal speed of a journal that stays where it is [L/T]: above what approaches by round-off.
const AT_REST: f64 = 1e-9;

/// The same in a motion [m/s].
pub(super) fn at_rest(motion: &Motion) -> f64 {
    AT_REST * motion.system().scale.velocity()
}

/// Directions of an impact and what unit impulses along them change.
pub(super) struct Point {
    /// Generalized forces of unit forces there (n).
    pub(super) forces: [Vec<f64>; 2],
    rates: [Vec<f64>; 2],
    /// Changes of the velocities (n).
    pub(super) changes: [Vec<f64>; 2],
    /// W \[1/kg\].
    pub(super) mass: [[f64; 2]; 2],
}

impl Point {
    /// Of some contacts, as they are at the last evaluation.
    pub(super) fn of(motion: &Motion, contacts: &[usize]) -> Vec<Point> {
        contacts
            .iter()
            .map(|&contact| Point::new(motion, contact, &motion.reading(contact)))
            .collect()
    }

    /// Of a contact with this reading.
    pub(super) fn new(motion: &Motion, contact: usize, reading: &Reading) -> Self {
        let system = motion.system();
        let reduced = &motion.reduced;
        let at = reduced.driven.evaluation.kinematics(&reduced.inputs);
        let (n, f) = (system.n(), reduced.freedom());
        let forces = [[1.0, 0.0], [0.0, 1.0]].map(|unit| {
            let mut force = vec![0.0; n];
            let mut applied = Applied::to(&mut force, &system.layout);
            system.contacts[contact].press(&at, reading, unit, &mut applied);
            force
        });
        let rates = forces.each_ref().map(|force| {
            let mut rates = vec![0.0; f];
            reduced.kick(force, &mut rates);
            rates
        });
        let changes = rates.each_ref().map(|rates| {
            let mut change = vec![0.0; n];
            reduced.spread(rates, &mut change);
            change
        });
        let coupling = dot(&forces[1], &changes[0]);
        let mass = [
            [dot(&forces[0], &changes[0]), coupling],
            [coupling, dot(&forces[1], &changes[1])],
        ];
        Point {
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

    /// Changes the rates in y by impulses.
    pub(super) fn apply(&self, y: &mut [f64], [normal, tangential]: [f64; 2]) {
        let f = self.rates[0].len();
        for (k, y) in y[f..2 * f].iter_mut().enumerate() {
            *y += normal * self.rates[0][k] + tangential * self.rates[1][k];
        }
    }
}

/// Velocities halfway between those before and after these impulses: work is impulse times that.
pub(super) fn halfway(motion: &Motion, points: &[Point], pushes: &[[f64; 2]]) -> Vec<f64> {
    let mut halfway = motion.reduced.v.clone();
    for (point, &push) in points.iter().zip(pushes) {
        let change = point.sum(&point.changes, push);
        halfway
            .iter_mut()
            .zip(&change)
            .for_each(|(v, change)| *v += 0.5 * change);
    }
    halfway
}

/// W̃ (k, k) of contacts whose impulses or forces along t are `ratios` of those along −n: what each does to δ̇ of the others.
pub(super) fn inverse_mass(points: &[Point], ratios: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(points.len(), points.len(), |i, j| {
        let [normal, tangential] = points[j]
            .changes
            .each_ref()
            .map(|change| dot(&points[i].forces[0], change));
        normal + ratios[j] * tangential
    })
}

/// T/N of a rigid journal that begins to follow its bearing.
pub(super) fn rubbing(motion: &Motion, contact: usize) -> f64 {
    match &motion.system().contacts[contact].surface {
        Surface::Rigid(rigid) => {
            rigid
                .friction_law()
                .force(motion.reading(contact).sliding, 1.0, 0.0)
                .force
        }
        Surface::Compliant(_) => 0.0,
    }
}

/// Whether a rigid journal is on its bearing's surface, slower than `slow`.
pub(super) fn touches(motion: &Motion, contact: usize, slow: f64) -> bool {
    let journal = &motion.system().contacts[contact];
    let reading = motion.reading(contact);
    matches!(journal.surface, Surface::Rigid(_))
        && reading.penetration > -LOWEST * journal.clearance
        && reading.rate.abs() <= slow
}

/// δ̈ of a contact at the point of the last evaluation [m/s²].
pub(super) fn approach_acceleration(motion: &Motion, contact: usize, point: &Point) -> f64 {
    let following = motion.system().contacts[contact].following();
    let reduced = &motion.reduced;
    let at: Kinematics = reduced.driven.evaluation.kinematics(&reduced.inputs);
    let mut gamma = [0.0];
    following.gamma(&at, &mut gamma);
    -dot(&point.forces[0], &reduced.a) - gamma[0]
}
