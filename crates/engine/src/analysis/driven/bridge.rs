//! Outputs near a change point: motion from the smooth branch, forces as far as they exist.

use super::super::channels::Contents;
use super::super::clearance_link::{balance, carried};
use super::super::record::Recorder;
use super::super::sample::Sample;
use super::super::unbounded::{DISTANCES, unbounded};
use crate::mechanism::continuation::Path;
use crate::mechanism::driven::Driven;
use crate::system::{Inputs, Origin, System};

/// Within this part of a window's width the reactions of a singular loop are not computed: the change point is known to
/// about 1e-12 of it, so closer they are known to less than four digits.
const NO_REACTION: f64 = 1e-8;
/// Distances, in parts of a window's width, at which bounded reactions at a change point are taken for their limit.
const LIMIT: f64 = 1e-3;
/// The same for a change point's self-stress, which is read off at 1e-5 of the window's width beside it.
const UNBOUNDED: f64 = 1e-3;

/// A place in the window of a change point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    /// Number of the window.
    pub index: usize,
    /// From the change point, of the path's parameter.
    pub distance: f64,
    /// The path's parameter and its derivatives by time.
    pub s: [f64; 3],
}

/// What constraints carry at change points: limits from both sides.
pub(super) struct Bridge {
    /// Beside the change point.
    scratch: Sample,
    /// Joints whose reaction was left out at some position.
    pub missing: Vec<String>,
}

impl Near {
    /// Puts velocity and acceleration of a sample, derivatives by the path's parameter, into derivatives by time.
    fn by_time(&self, Sample { v, a, .. }: &mut Sample) {
        let [_, rate, bend] = self.s;
        for (v, a) in v.iter_mut().zip(a.iter_mut()) {
            *a = *a * rate * rate + *v * bend;
            *v *= rate;
        }
    }

    /// Takes the smooth branch into the sample and the evaluation; returns the scaled residual.
    pub fn settle(&self, driven: &mut Driven, inputs: &Inputs, sample: &mut Sample) -> f64 {
        let system = driven.system;
        self.by_time(sample);
        driven.evaluation.set_position(&sample.q);
        driven.evaluation.set_velocity(&sample.v);
        driven.evaluation.eval_phi(system, inputs);
        balance(system, &driven.evaluation, inputs, sample);
        system.scaled_residual(&driven.evaluation.phi)
    }

    /// Whether forces can be solved for here; then the constraints are factored.
    pub fn is_regular(&self, driven: &mut Driven, path: &Path, q: &[f64], inputs: &Inputs) -> bool {
        let window = &path.windows()[self.index];
        self.distance.abs() > NO_REACTION * window.width
            && driven.prepare(q, inputs).is_ok()
            && driven.factor(inputs).is_ok()
    }
}

impl Bridge {
    pub fn new(system: &System) -> Self {
        Bridge {
            scratch: Sample::new(system),
            missing: Vec::new(),
        }
    }

    /// At a change point: reactions of the singular loop do not exist, nor does friction that they cause; the others are
    /// limits from both sides. Returns the friction that locks a joint beside it, where one does.
    pub fn limit(
        &mut self,
        driven: &mut Driven,
        path: &Path,
        near: Near,
        inputs: &Inputs,
        sample: &mut Sample,
    ) -> Option<usize> {
        let system = driven.system;
        let mut limit = vec![0.0; system.m()];
        let mut sizes = vec![0.0; system.dependent_forces.len()];
        let mut locked = None;
        // Mean of both sides at h and 2h, then (4 M(h) − M(2h)) / 3: error O(h⁴).
        for (part, weight) in [
            (LIMIT, 4.0 / 6.0),
            (-LIMIT, 4.0 / 6.0),
            (2.0 * LIMIT, -1.0 / 6.0),
            (-2.0 * LIMIT, -1.0 / 6.0),
        ] {
            if self.solve_beside(driven, path, near, part, inputs) {
                locked = locked.or(driven.dependent_forces.locked());
                limit
                    .iter_mut()
                    .zip(&self.scratch.lambda)
                    .for_each(|(sum, l)| *sum += weight * l);
                sizes
                    .iter_mut()
                    .zip(&self.scratch.dependent_forces)
                    .for_each(|(sum, size)| *sum += weight * size);
            } else {
                limit.fill(f64::NAN);
                sizes.fill(f64::NAN);
            }
        }
        driven.evaluation.set_position(&sample.q);
        driven.evaluation.set_velocity(&sample.v);
        self.leave_out(system, path.self_stress(near.index), &mut limit);
        for (size, dependent) in sizes.iter_mut().zip(&system.dependent_forces) {
            if limit[system.blocks[dependent.block].row()].is_nan() {
                *size = f64::NAN;
            }
        }
        sample.lambda.copy_from_slice(&limit);
        sample.dependent_forces.copy_from_slice(&sizes);
        if !sizes.is_empty() {
            let forces = &mut driven.dependent_forces;
            forces.eval_units(system, &driven.evaluation, inputs);
            forces.set_sizes(&sizes);
            forces.add_forces(&mut sample.force);
            forces.add_forces(&mut sample.balance);
        }
        locked
    }

    /// Columns of these contents without bound at a change point.
    pub fn unbounded(
        &mut self,
        driven: &mut Driven,
        path: &Path,
        near: Near,
        (inputs, contents): (&Inputs, Contents),
    ) -> Vec<String> {
        let system = driven.system;
        let mut rows = Recorder::new(system, contents, DISTANCES.len());
        for part in DISTANCES {
            if self.solve_beside(driven, path, near, part * LIMIT, inputs) {
                rows.push(system, &driven.evaluation, inputs, &self.scratch);
            }
        }
        unbounded(&rows.trajectory)
    }

    /// What is carried at a part of the window's width beside the place, into the scratch; whether that is regular.
    fn solve_beside(
        &mut self,
        driven: &mut Driven,
        path: &Path,
        near: Near,
        part: f64,
        inputs: &Inputs,
    ) -> bool {
        let Sample { q, v, a, .. } = &mut self.scratch;
        path.guess(near.s[0] + part * path.windows()[near.index].width, q, v, a);
        near.by_time(&mut self.scratch);
        driven.evaluation.set_position(&self.scratch.q);
        driven.evaluation.set_velocity(&self.scratch.v);
        balance(driven.system, &driven.evaluation, inputs, &mut self.scratch);
        if driven.prepare(&self.scratch.q, inputs).is_err() || driven.factor(inputs).is_err() {
            return false;
        }
        // What locks itself so near has no limit.
        if carried(driven, inputs, &mut self.scratch).is_err() {
            self.scratch.lambda.fill(f64::NAN);
        }
        true
    }

    /// Leaves out reactions of joints that the change point's self-stress goes through.
    fn leave_out(&mut self, system: &System, stress: &[f64], limit: &mut [f64]) {
        let largest = linkdyn_linear::math::max_abs(stress);
        for block in &system.blocks {
            let rows = block.rows();
            let stressed = stress
                .get(rows.clone())
                .is_some_and(|part| linkdyn_linear::math::max_abs(part) > UNBOUNDED * largest);
            if !stressed {
                continue;
            }
            limit[rows].fill(f64::NAN);
            if let Origin::Joint(id) = block.origin {
                let name = &system.joints[id.0].name;
                if !self.missing.contains(name) {
                    self.missing.push(name.clone());
                }
            }
        }
    }
}
