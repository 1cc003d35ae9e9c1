//! What an implicit method asks of the equations: their derivatives, systems with these, and stages.

use super::Reduced;
use super::inertia::Inertia;
use super::place::Placed;
use super::stages::{Matrices, Stage, Stages};
use crate::mechanism::driven::Failure;

/// Those of the last linearisation, where there was one.
fn matrices(stages: &mut Option<Box<Stages>>) -> Option<&mut Matrices> {
    stages.as_mut()?.matrices.as_mut()
}

impl Reduced<'_> {
    /// Whether an implicit method's systems are solved with sparse matrices: where accelerations are, and no force depends on
    /// multipliers.
    pub fn is_implicit(&self) -> bool {
        matches!(self.inertia, Inertia::Sparse(_)) && self.driven.system.dependent_forces.is_empty()
    }

    /// Makes ready for an implicit method; what it has to keep of accepted points is kept from now on.
    fn begin_stages(&mut self) -> Result<(), Failure> {
        if self.stages.is_none() {
            self.stages = Some(Box::new(Stages::of(self.driven.system)));
            if let Inertia::Sparse(sparse) = &mut self.inertia {
                sparse.take_whole();
            }
            // At the accepted point once more, for what was not kept.
            let (time, mut y) = (self.accepted.here.s, vec![0.0; 2 * self.freedom()]);
            let before = self.accepted.set_aside();
            self.recall()?;
            self.q.copy_from_slice(&self.accepted.here.q);
            self.v.copy_from_slice(&self.accepted.here.d);
            self.state(&mut y);
            let evaluated = self.evaluate(time, &y);
            self.accepted.take_back(before);
            evaluated?;
            self.keep_stages();
        }
        Ok(())
    }

    /// Keeps what stages need of the accepted point at hand.
    pub(super) fn keep_stages(&mut self) {
        if let (Some(stages), Inertia::Sparse(sparse)) = (&mut self.stages, &self.inertia) {
            stages.keep(sparse);
        }
    }

    /// Takes the derivatives of the accelerations at the last accepted point.
    ///
    /// # Errors
    /// Where accelerations can't be solved for there.
    pub fn linearise(&mut self) -> Result<(), Failure> {
        self.begin_stages()?;
        let Some(stages) = &mut self.stages else {
            return Err(Failure::Singular);
        };
        self.at = None;
        let here = &self.accepted.here;
        self.inputs.set_time(self.driven.system, here.s);
        self.driven.evaluation.set_position(&here.q);
        self.driven.evaluation.set_velocity(&here.d);
        self.driven
            .evaluation
            .eval_jacobian(self.driven.system, &self.inputs);
        let (driven, revision) = (&self.driven, self.driven.revision());
        let current = stages.matrices.take();
        let current = current.filter(|matrices| matrices.revision == revision);
        let matrices = stages
            .matrices
            .insert(current.unwrap_or_else(|| Matrices::of(driven)));
        matrices.saddle.take(driven, &self.inputs, &stages.lambda);
        Ok(())
    }

    /// Factors s − J for a real s and complex ones; false where it can't.
    pub fn factor_shifted(&mut self, real: f64, complex: &[[f64; 2]]) -> bool {
        matrices(&mut self.stages).is_some_and(|matrices| matrices.saddle.factor(real, complex))
    }

    /// Overwrites b (2 f) with the x of (s − J) x = b, of the real s; NaN where that is not known.
    pub fn solve_shifted(&mut self, b: &mut [f64]) {
        let (driven, inertia) = (&self.driven, (&mut self.inertia, self.sequence.as_deref()));
        let matrices = matrices(&mut self.stages);
        match matrices.and_then(|matrices| matrices.parts(driven, inertia)) {
            Some((saddle, by)) => saddle.solve(driven, by, b),
            None => b.fill(f64::NAN),
        }
    }

    /// The same of a complex s.
    pub fn solve_shifted_complex(&mut self, number: usize, [re, im]: [&mut [f64]; 2]) {
        let (driven, inertia) = (&self.driven, (&mut self.inertia, self.sequence.as_deref()));
        let matrices = matrices(&mut self.stages);
        match matrices.and_then(|matrices| matrices.parts(driven, inertia)) {
            Some((saddle, by)) => saddle.solve_complex(driven, by, number, [re, im]),
            None => [re, im].into_iter().for_each(|b| b.fill(f64::NAN)),
        }
    }

    /// q, v, a at (t, (u, u̇)) of a stage, by its number and whether this is the first time in a step.
    ///
    /// # Errors
    /// As [`Reduced::evaluate`].
    pub fn evaluate_stage(
        &mut self,
        (stage, first): (usize, bool),
        time: f64,
        y: &[f64],
    ) -> Result<(), Failure> {
        if self.evaluate_straight(time, y) {
            return Ok(());
        }
        if let Some(point) = self.stage(stage)
            && (first || point.time != time)
        {
            point.time = f64::NAN;
        }
        self.evaluate(time, y)?;
        let q = std::mem::take(&mut self.q);
        if let Some(point) = self.stage(stage) {
            point.time = time;
            point.q.copy_from_slice(&q);
        }
        self.q = q;
        Ok(())
    }

    fn stage(&mut self, stage: usize) -> Option<&mut Stage> {
        self.stages.as_mut()?.stages.get_mut(stage)
    }

    /// q, v, a at (t, (u, u̇)) where no constraint bends; whether that is so, and known.
    pub(super) fn evaluate_straight(&mut self, time: f64, y: &[f64]) -> bool {
        let (system, f, revision) = (self.system(), self.freedom(), self.driven.revision());
        let matrices = matrices(&mut self.stages).filter(|matrices| matrices.revision == revision);
        let Some(straight) = matrices.and_then(|matrices| matrices.straight.as_mut()) else {
            return false;
        };
        self.placed = Placed::Straight;
        self.inputs.set_time(system, time);
        let (driven, inputs) = (&mut self.driven, &self.inputs);
        for (k, coordinate) in driven.independent.iter_mut().enumerate() {
            coordinate.jet = [y[k], y[f + k], 0.0];
        }
        self.q.copy_from_slice(&self.accepted.here.q);
        straight.place(driven, inputs, &mut self.q);
        straight.velocity(driven, inputs, &mut self.v);
        driven
            .evaluation
            .eval_force(system, inputs, &mut self.force);
        straight.accelerate(driven, inputs, &self.force, &mut self.a);
        let own = driven.independent.iter_mut().zip(&mut self.accelerations);
        for (coordinate, rate) in own {
            *rate = self.a[coordinate.column];
            coordinate.jet[2] = *rate;
        }
        self.at = Some(time);
        true
    }
}
