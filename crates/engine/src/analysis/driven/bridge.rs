//! Outputs near a change point: motion from the smooth branch, forces as far as they exist.

use super::super::clearance_link::{balance, carried, effort_by_power};
use super::super::sample::Sample;
use super::outputs::Outputs;
use crate::mechanism::continuation::{Parameter, Path};
use crate::mechanism::driven::Driven;
use crate::system::{DriverId, Origin};

/// Within this part of a window's width the reactions of a singular loop are not computed: the change point is known to
/// about 1e-12 of it, so closer they are known to less than four digits.
const NO_REACTION: f64 = 1e-8;
/// Distances, in parts of a window's width, at which bounded reactions at a change point are taken for their limit.
const LIMIT: f64 = 1e-3;
/// The same for a change point's self-stress, which is read off at 1e-5 of the window's width beside it.
const UNBOUNDED: f64 = 1e-3;

impl Outputs<'_, '_> {
    /// The smooth branch near a change point; returns the scaled residual.
    pub(super) fn bridged(
        &mut self,
        driven: &mut Driven,
        path: &Path,
        index: usize,
        distance: f64,
        s: [f64; 3],
    ) -> f64 {
        let system = self.system;
        let [_, rate, bend] = s;
        let tangent = self.sample.v.clone();
        let Sample { v, a, .. } = &mut self.sample;
        for (v, a) in v.iter_mut().zip(a.iter_mut()) {
            *a = *a * rate * rate + *v * bend;
            *v *= rate;
        }
        self.settle(driven);
        let residual = system.scaled_residual(&driven.evaluation.phi);
        if !(self.reactions || self.links.is_some()) {
            return residual;
        }
        let window = &path.windows()[index];
        let regular = distance.abs() > NO_REACTION * window.width
            && driven.prepare(&self.sample.q, &self.inputs).is_ok()
            && driven.factor(&self.inputs).is_ok();
        if regular {
            self.carry(driven);
        } else {
            self.limit_reactions(driven, path, index, s);
        }
        let exists = self
            .sample
            .dependent_forces
            .iter()
            .all(|size| size.is_finite());
        if path.parameter == Parameter::DriverValue && exists {
            let row = system.driver_row(DriverId(0));
            self.sample.lambda[row] = effort_by_power(&self.sample.balance, &tangent);
        }
        residual
    }

    /// Takes position and velocity of the sample and works out what the constraints carry.
    fn settle(&mut self, driven: &mut Driven) {
        driven.evaluation.set_position(&self.sample.q);
        driven.evaluation.set_velocity(&self.sample.v);
        driven.evaluation.eval_phi(self.system, &self.inputs);
        balance(
            self.system,
            &driven.evaluation,
            &self.inputs,
            &mut self.sample,
        );
    }

    /// At a change point: reactions of the singular loop do not exist, nor does friction that they cause; the others are
    /// limits from both sides.
    fn limit_reactions(&mut self, driven: &mut Driven, path: &Path, index: usize, s: [f64; 3]) {
        let system = self.system;
        let window = &path.windows()[index];
        let [s, rate, bend] = s;
        let mut limit = vec![0.0; system.m()];
        let mut sizes = vec![0.0; system.dependent_forces.len()];
        // Mean of both sides at h and 2h, then (4 M(h) − M(2h)) / 3: error O(h⁴).
        for (part, weight) in [
            (LIMIT, 4.0 / 6.0),
            (-LIMIT, 4.0 / 6.0),
            (2.0 * LIMIT, -1.0 / 6.0),
            (-2.0 * LIMIT, -1.0 / 6.0),
        ] {
            let Sample { q, v, a, .. } = &mut self.scratch;
            path.guess(s + part * window.width, q, v, a);
            for (v, a) in v.iter_mut().zip(a.iter_mut()) {
                *a = *a * rate * rate + *v * bend;
                *v *= rate;
            }
            driven.evaluation.set_position(q);
            driven.evaluation.set_velocity(v);
            balance(system, &driven.evaluation, &self.inputs, &mut self.scratch);
            let q = &self.scratch.q;
            if driven.prepare(q, &self.inputs).is_ok() && driven.factor(&self.inputs).is_ok() {
                // What locks itself so near has no limit.
                if carried(driven, &self.inputs, &mut self.scratch).is_err() {
                    self.scratch.lambda.fill(f64::NAN);
                    self.note_locked(driven);
                }
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
        driven.evaluation.set_position(&self.sample.q);
        driven.evaluation.set_velocity(&self.sample.v);
        let stress = path.self_stress(index);
        let largest = linkdyn_linear::math::max_abs(stress);
        for block in &system.blocks {
            let rows = block.row..block.row + block.rows;
            let stressed = stress
                .get(rows.clone())
                .is_some_and(|part| linkdyn_linear::math::max_abs(part) > UNBOUNDED * largest);
            if stressed {
                limit[rows].fill(f64::NAN);
                if let Origin::Joint(id) = block.origin {
                    let name = &system.joints[id.0].name;
                    if !self.missing.contains(name) {
                        self.missing.push(name.clone());
                    }
                }
            }
        }
        for (size, dependent) in sizes.iter_mut().zip(&system.dependent_forces) {
            if limit[system.blocks[dependent.block].row].is_nan() {
                *size = f64::NAN;
            }
        }
        self.sample.lambda.copy_from_slice(&limit);
        self.sample.dependent_forces.copy_from_slice(&sizes);
        if !sizes.is_empty() {
            driven
                .dependent_forces
                .eval_units(system, &driven.evaluation, &self.inputs);
            driven.dependent_forces.set_sizes(&sizes);
            driven.dependent_forces.add_forces(&mut self.sample.force);
            driven.dependent_forces.add_forces(&mut self.sample.balance);
        }
    }
}
