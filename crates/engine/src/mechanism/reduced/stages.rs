//! The stages of an implicit method's step.
//!
//! A stage is a point as any other, whose position begins at that of the iteration before. Where J has not changed since the
//! accepted point, as on guides that do not turn, the factors of that point are those of the stage, and nothing is factored:
//!
//! ```text
//! J_A Δq = −(φ, q_c − u),   J_A Δv = −(J v + φ_t, v_c − u̇)
//! [M Jᵀ; J 0] (Δa, Δλ) = (Q − M a − Jᵀ λ, γ − J a)
//! ```
//!
//! The same corrections by factors that are off by some h ω were tried for all mechanisms, one for each of Newton's iterations:
//! they save a quarter of the time, but what they leave is not seen by the iteration, and at orders 9 and 13 errors were a hundred
//! times as large.

use super::Reduced;
use super::inertia::Inertia;
use super::place::Placed;
use super::saddle::Saddle;
use super::sparse::Sparse;
use crate::mechanism::driven::Failure;
use linkdyn_linear::lu::SparseLu;

/// Residual above which the constraints are no longer those of the accepted point, whatever J is there: round-off of a few
/// additions [–].
const STRAIGHT: f64 = 1e-14;
/// Most stages of a method.
const STAGES: usize = 7;

/// A stage's position (n).
#[derive(Debug, Clone)]
struct Stage {
    time: f64,
    q: Vec<f64>,
}

/// What an implicit method needs of a mechanism.
pub(super) struct Stages {
    saddle: Saddle,
    stages: Vec<Stage>,
    /// The matrix of the accelerations at the accepted point, and its multipliers (m).
    accelerations: Option<SparseLu>,
    lambda: Vec<f64>,
    /// J's entries there.
    jacobian: Vec<f64>,
    /// J has been the same everywhere so far.
    is_straight: bool,
    /// (m), (m), (n).
    multipliers: Vec<f64>,
    rows: Vec<f64>,
    columns: Vec<f64>,
}

impl Stages {
    fn of(reduced: &Reduced) -> Self {
        let (n, m) = (reduced.system().n(), reduced.system().m());
        let stage = Stage {
            time: f64::NAN,
            q: vec![0.0; n],
        };
        Stages {
            saddle: Saddle::of(&reduced.driven),
            stages: vec![stage; STAGES],
            accelerations: None,
            lambda: vec![0.0; m],
            jacobian: vec![0.0; reduced.system().entries.len()],
            is_straight: true,
            multipliers: vec![0.0; m],
            rows: vec![0.0; m],
            columns: vec![0.0; n],
        }
    }

    /// Keeps what belongs to the accepted point at hand.
    pub fn keep(&mut self, reduced_jacobian: &[f64], sparse: &Sparse) {
        sparse.keep_factors(&mut self.accelerations);
        self.lambda.copy_from_slice(sparse.multipliers());
        self.jacobian.copy_from_slice(reduced_jacobian);
        self.stages.iter_mut().for_each(|s| s.time = f64::NAN);
    }

    /// The position of the last step's stage at this time, where there is one.
    pub fn position_at(&self, time: f64) -> Option<&[f64]> {
        let stage = self.stages.iter().find(|stage| stage.time == time)?;
        Some(&stage.q)
    }
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
            self.stages = Some(Box::new(Stages::of(self)));
            if let Inertia::Sparse(sparse) = &mut self.inertia {
                sparse.take_whole();
            }
            // At the accepted point once more, for what was not kept.
            let (time, mut y) = (self.accepted.here.s, vec![0.0; 2 * self.freedom()]);
            let before = self.accepted.set_aside();
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
            stages.keep(&self.driven.evaluation.jacobian, sparse);
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
        if stages.saddle.revision != self.driven.revision() {
            stages.saddle = Saddle::of(&self.driven);
        }
        stages
            .saddle
            .take(&self.driven, &self.inputs, &stages.lambda);
        Ok(())
    }

    /// Factors s − J for a real s and complex ones; false where it can't.
    pub fn factor_shifted(&mut self, real: f64, complex: &[[f64; 2]]) -> bool {
        let stages = self.stages.as_mut();
        stages.is_some_and(|stages| stages.saddle.factor(real, complex))
    }

    /// Overwrites b (2 f) with the x of (s − J) x = b, of the real s; NaN where that is not known.
    pub fn solve_shifted(&mut self, b: &mut [f64]) {
        let kept = match &mut self.inertia {
            Inertia::Sparse(sparse) => sparse.kept(&self.driven),
            Inertia::Tangents(_) => None,
        };
        match (&mut self.stages, kept) {
            (Some(stages), Some(kept)) => stages.saddle.solve(&mut self.driven, kept, b),
            _ => b.fill(f64::NAN),
        }
    }

    /// The same of a complex s.
    pub fn solve_shifted_complex(&mut self, number: usize, [re, im]: [&mut [f64]; 2]) {
        let kept = match &mut self.inertia {
            Inertia::Sparse(sparse) => sparse.kept(&self.driven),
            Inertia::Tangents(_) => None,
        };
        match (&mut self.stages, kept) {
            (Some(stages), Some(kept)) => {
                let saddle = &mut stages.saddle;
                saddle.solve_complex(&mut self.driven, kept, number, [re, im]);
            }
            _ => [re, im].into_iter().for_each(|b| b.fill(f64::NAN)),
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

    /// q, v, a at (t, (u, u̇)) where J is that of the accepted point; whether it is.
    pub(super) fn evaluate_straight(&mut self, time: f64, y: &[f64]) -> bool {
        let (system, f) = (self.driven.system, self.freedom());
        let (Some(stages), Inertia::Sparse(sparse)) = (&mut self.stages, &mut self.inertia) else {
            return false;
        };
        let Stages {
            accelerations: Some(factors),
            lambda,
            jacobian,
            is_straight,
            multipliers,
            rows,
            columns,
            ..
        } = &mut **stages
        else {
            return false;
        };
        let Some(kept) = sparse.kept(&self.driven).filter(|_| *is_straight) else {
            return false;
        };
        self.at = None;
        self.placed = Placed::Guess;
        self.inputs.set_time(system, time);
        let driven = &mut self.driven;
        for (k, coordinate) in driven.independent.iter_mut().enumerate() {
            coordinate.jet = [y[k], y[f + k], 0.0];
        }
        self.q.copy_from_slice(&self.accepted.here.q);
        self.v.copy_from_slice(&self.accepted.here.d);
        driven.near(kept, &self.inputs, &mut self.q);
        driven.evaluation.set_position(&self.q);
        driven.evaluation.eval_jacobian(system, &self.inputs);
        driven.evaluation.eval_phi(system, &self.inputs);
        *is_straight = driven.evaluation.jacobian == *jacobian
            && system.scaled_residual(&driven.evaluation.phi) <= STRAIGHT;
        if !*is_straight {
            return false;
        }
        driven.velocity_near(kept, &self.inputs, rows, &mut self.v);
        let evaluation = &driven.evaluation;
        evaluation.eval_force(system, &self.inputs, &mut self.force);
        evaluation.eval_gamma(system, &self.inputs, rows);
        self.a.copy_from_slice(&self.accepted.here.dd);
        multipliers.copy_from_slice(lambda);
        evaluation.subtract_product(system, &self.a, rows);
        system.mass.residual(&self.force, &self.a, columns);
        evaluation.subtract_transposed_product(system, multipliers, columns);
        let to = [&mut self.a[..], multipliers];
        sparse.correct(driven, factors, [columns, rows], to);
        sparse.set_multipliers(multipliers);
        let own = driven.independent.iter_mut().zip(&mut self.accelerations);
        for (coordinate, rate) in own {
            *rate = self.a[coordinate.column];
            coordinate.jet[2] = *rate;
        }
        self.at = Some(time);
        true
    }
}
