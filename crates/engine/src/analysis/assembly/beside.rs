//! Positions a little beside one that is singular, or from which no way leads to the assembly.

use crate::mechanism::closing::{Closed, close};
use crate::system::{Block, Inputs, Origin, System};

/// Turns of the bodies, largest in rad, by which a drawing is left that is singular itself: there the least gap may be a
/// saddle, from which no way leads to the assembly.
const KICKS: [f64; 6] = [0.02, -0.02, 0.2, -0.2, 0.7, -0.7];

/// Change of the coordinates, in rad or mechanism sizes, by which a singular start is left to see its ranks from outside.
const NUDGE: f64 = 1e-2;

/// The guess with its bodies turned a little.
pub(super) fn nearby_guess(system: &System) -> Vec<f64> {
    kicked(system, KICKS[0])
}

/// The guess with its bodies turned by parts of `largest`, each by another.
fn kicked(system: &System, largest: f64) -> Vec<f64> {
    kicked_from(system, &system.guess, largest)
}

fn kicked_from(system: &System, q: &[f64], largest: f64) -> Vec<f64> {
    let mut q = q.to_vec();
    for (k, body) in system.layout.bodies().enumerate() {
        // Multiples of the golden ratio are spread evenly, and never alike.
        let part = (0.618_033_988_749_895 * (k + 1) as f64).fract();
        q[body.theta()] += largest * (0.2 + 0.8 * part) * if k % 2 == 0 { 1.0 } else { -1.0 };
    }
    q
}

/// A position a little beside `q` that the joints allow, drivers or not.
pub(super) fn beside_by_joints(system: &System, q: &[f64], inputs: &Inputs) -> Option<Vec<f64>> {
    let joints: Vec<&Block> = system
        .blocks
        .iter()
        .filter(|b| matches!(b.origin, Origin::Joint(_)))
        .collect();
    let closed = KICKS
        .iter()
        .map(|&kick| close(system, &joints, &kicked_from(system, q, kick), inputs));
    closed
        .into_iter()
        .find(|closed| closed.converged)
        .map(|closed| closed.q)
}

/// An assembly from where the guess is left a little.
pub(super) fn close_from_beside(system: &System, inputs: &Inputs) -> Option<Closed> {
    let all: Vec<&Block> = system.blocks.iter().chain(&system.initial).collect();
    KICKS
        .iter()
        .map(|&kick| close(system, &all, &kicked(system, kick), inputs))
        .find(|closed| closed.converged)
}

/// A position a little beside, along a null direction of all rows, with the joints closed again.
pub(super) fn nudged(
    system: &System,
    q: &[f64],
    direction: &[f64],
    inputs: &Inputs,
) -> Option<Vec<f64>> {
    let joints: Vec<&Block> = system
        .blocks
        .iter()
        .filter(|b| matches!(b.origin, Origin::Joint(_)))
        .collect();
    let largest = linkdyn_linear::math::max_abs(direction);
    let mut q = q.to_vec();
    for (k, (q, d)) in q.iter_mut().zip(direction).enumerate() {
        *q += NUDGE * d / largest * system.column_scale(k);
    }
    let closed = close(system, &joints, &q, inputs);
    closed.converged.then_some(closed.q)
}
