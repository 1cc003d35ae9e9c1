//! Driven mechanisms of one structure side by side: positions, velocities and accelerations of all by the same arithmetic.
//!
//! ```text
//! position       J₀ Δq = −φ(q)      J₀ at the guess, repeated: Newton's first step, then chords
//! velocity       J v   = −φ_t
//! acceleration   J a   = γ
//! multipliers    Jᵀ λ  = M (g − a)   where nothing but weights pulls
//! ```
//!
//! What comes out for one of them does not depend on the others. A chord's steps shrink by ‖J₀⁻¹J − I‖, which the size of the
//! first step bounds: what shrinks less than fourfold from step to step is left to [`Driven`](super::driven::Driven).

mod singly;
mod turns;

use super::driven::{LAST_STEP, RESIDUAL_FLOOR};
use crate::element::{Constraint, Equations, Kinematics, Layout, Pose, Twist};
use crate::motion::Jet;
use crate::system::{Evaluation, Inputs, System};
use linkdyn_linear::lu::{LuAbreast, SparseLu};
use linkdyn_linear::math::{Lanes, Vector, WIDTH};
use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};
use singly::Singly;
use std::ops::Range;
use std::sync::Arc;
use turns::{SMALL, sin_cos, turned};

/// Yes or no for each of them.
pub type Which = <Lanes as SimdValue>::SimdBool;
/// Contraction that proves the branch.
const CONTRACTION: f64 = 0.25;
/// What is left to correct when a correction ends, scaled [–].
const ROUND_OFF: f64 = 1e-15;
const MOST_STEPS: usize = 12;
/// By how much a step may leave more than others near it did.
const CAUTION: f64 = 16.0;

/// The equations of one joint or driver of all mechanisms.
struct EquationBlock {
    equations: Box<dyn Equations<Lanes>>,
    rows: Range<usize>,
    entries: Range<usize>,
}

/// Mechanisms side by side.
pub struct Abreast {
    layout: Layout,
    blocks: Vec<EquationBlock>,
    /// Numbers of the equations, in their order.
    numbers: Vec<Lanes>,
    /// Those of each mechanism, by blocks.
    constraints: Vec<[Arc<dyn Constraint>; WIDTH]>,
    poses: Vec<Pose<Lanes>>,
    twists: Vec<Twist<Lanes>>,
    /// Values of the drivers.
    pub drive: Vec<Jet<Lanes>>,
    phi: Vec<Lanes>,
    jacobian: Vec<Lanes>,
    /// Entries of J that differ with the position and are not ground's, and their places among the factors.
    places: Vec<[u32; 2]>,
    lu: LuAbreast,
    /// Inverse scales of rows and columns.
    rows: Vec<f64>,
    columns: Vec<f64>,
    step: Vec<Lanes>,
    /// Diagonals of the mass matrices (n), where multipliers are wanted and nothing but weights pulls, and gravity.
    weights: Option<(Vec<Lanes>, [Lanes; 2])>,
}

/// How corrections went.
#[derive(Debug, Clone, Copy)]
pub struct Corrected {
    /// Largest step of the first iteration, scaled [–].
    pub first_step: Lanes,
    /// Sign of det J at the guess.
    pub sign: Lanes,
    /// Steps that were made, by those that took most.
    pub steps: usize,
    /// Of which the solution is proven to belong to the guess.
    pub is_proven: Which,
}

/// Those places of which something is so.
pub fn which(is: impl Fn(usize) -> bool) -> Which {
    let mut of = Lanes::ZERO;
    (0..WIDTH).for_each(|lane| of.replace(lane, if is(lane) { 1.0 } else { 0.0 }));
    of.simd_gt(Lanes::ZERO)
}

/// Whether one is among them.
pub fn is_among(of: Which, lane: usize) -> bool {
    Lanes::splat(1.0).select(of, Lanes::ZERO).extract(lane) > 0.0
}

impl Abreast {
    /// Of a mechanism, as often as there is room, with slots of the entries of J and its factors; `None` where it must be solved
    /// alone.
    pub fn new(system: &System, (slots, lu): (&[u32], &SparseLu)) -> Option<Self> {
        let measures = system.measures.iter();
        let rows: Vec<f64> = measures.map(|of| system.measure_scale(*of)).collect();
        let columns = 0..system.n();
        let columns: Vec<f64> = columns.map(|column| system.column_scale(column)).collect();
        let mut evaluation = Evaluation::new(system);
        evaluation.eval_jacobian(system, &Inputs::still(system));
        let mut is_constant = vec![false; system.entries.len()];
        for block in &system.blocks {
            let own = is_constant[block.entries()].iter_mut().enumerate();
            own.for_each(|(entry, is)| *is = block.constraint.is_constant(entry));
        }
        let mut fixed = vec![None; lu.pattern().entries() + 1];
        let entries = slots.iter().zip(&evaluation.jacobian).zip(&is_constant);
        for ((&slot, value), _) in entries.filter(|(_, is_constant)| **is_constant) {
            fixed[slot as usize] = Some(*value);
        }
        let lu = LuAbreast::new(lu, [&rows, &columns], &fixed)?;
        let entries = system.entries.iter().zip(slots).enumerate();
        let entries =
            entries.filter(|(index, (entry, _))| entry.column().is_some() && !is_constant[*index]);
        let places = entries.map(|(entry, (_, &slot))| [entry as u32, lu.place(slot)]);
        let n = system.n();
        let bodies = system.bodies.len() + 1;
        let ground = Pose::new(Lanes::ZERO, Lanes::ZERO, Lanes::ZERO);
        let inverse = |scales: Vec<f64>| scales.iter().map(|scale| 1.0 / scale).collect();
        let mut numbers = Vec::new();
        let mut note = |value: f64| {
            numbers.push(Lanes::splat(value));
            Lanes::splat(value)
        };
        let blocks = system.blocks.iter().map(|block| {
            let constraints: [_; WIDTH] = std::array::from_fn(|_| block.constraint.clone());
            let equations = block.constraint.abreast(&mut note);
            let each = || Box::new(Singly::new(constraints.clone())) as _;
            let own = EquationBlock {
                equations: equations.unwrap_or_else(each),
                rows: block.rows(),
                entries: block.entries(),
            };
            (own, constraints)
        });
        let (blocks, constraints) = blocks.unzip();
        Some(Abreast {
            layout: system.layout.clone(),
            blocks,
            numbers,
            constraints,
            poses: vec![ground; bodies],
            twists: vec![Twist::default(); bodies],
            drive: vec![[Lanes::ZERO; 3]; system.drivers.len()],
            phi: vec![Lanes::ZERO; n],
            jacobian: vec![Lanes::ZERO; system.entries.len()],
            places: places.collect(),
            lu,
            rows: inverse(rows),
            columns: inverse(columns),
            step: vec![Lanes::ZERO; n],
            weights: None,
        })
    }

    /// Puts a mechanism in a place; [`Abreast::build`] follows.
    pub fn put(&mut self, lane: usize, system: &System) {
        for (own, block) in self.constraints.iter_mut().zip(&system.blocks) {
            own[lane] = block.constraint.clone();
        }
        if let Some((masses, gravity)) = &mut self.weights {
            let own = masses.iter_mut().zip(system.mass.diagonal());
            own.for_each(|(all, own)| all.replace(lane, *own));
            gravity[0].replace(lane, system.gravity.x);
            gravity[1].replace(lane, system.gravity.y);
        }
        let mut numbers = self.numbers.iter_mut();
        let mut note = |value: f64| {
            if let Some(all) = numbers.next() {
                all.replace(lane, value);
            }
            Lanes::ZERO
        };
        for block in &system.blocks {
            block.constraint.abreast(&mut note);
        }
    }

    /// The same of numbers as [`System::renumber`] has them.
    pub fn put_numbers(&mut self, lane: usize, numbers: &[f64]) {
        for (all, own) in self.numbers.iter_mut().zip(numbers) {
            all.replace(lane, *own);
        }
        if let Some((masses, _)) = &mut self.weights {
            let own = &numbers[numbers.len() - masses.len()..];
            masses
                .iter_mut()
                .zip(own)
                .for_each(|(all, own)| all.replace(lane, *own));
        }
    }

    /// Knows weights from now on, those of a mechanism in all places, where nothing else pulls; whether that is so.
    pub fn weigh(&mut self, system: &System) -> bool {
        if !system.looks_at_places() {
            let masses = system.mass.diagonal().iter();
            let gravity = [system.gravity.x, system.gravity.y];
            self.weights = Some((
                masses.map(|own| Lanes::splat(*own)).collect(),
                gravity.map(Lanes::splat),
            ));
        }
        self.weights.is_some()
    }

    /// Makes the equations with the numbers at hand.
    pub fn build(&mut self) {
        let mut numbers = self.numbers.iter();
        let mut next = |_| *numbers.next().expect("as many numbers as were read");
        for (block, constraints) in self.blocks.iter_mut().zip(&self.constraints) {
            let equations = constraints[0].abreast(&mut next);
            block.equations =
                equations.unwrap_or_else(|| Box::new(Singly::new(constraints.clone())));
        }
    }

    fn set_position(&mut self, q: &[Lanes]) {
        for (pose, columns) in self.poses[1..].iter_mut().zip(self.layout.bodies()) {
            let theta = q[columns.theta()];
            let (sin, cos) = sin_cos(theta);
            *pose = Pose {
                r: Vector::new(q[columns.x()], q[columns.y()]),
                theta,
                cos,
                sin,
            };
        }
    }

    /// Moves on by a step whose angles are small.
    fn move_by(&mut self, step: &[Lanes]) {
        for (pose, columns) in self.poses[1..].iter_mut().zip(self.layout.bodies()) {
            *pose = turned(pose, step[columns.theta()]);
            pose.r += Vector::new(step[columns.x()], step[columns.y()]);
        }
    }

    /// Poses of the moving bodies.
    pub fn poses(&self) -> &[Pose<Lanes>] {
        &self.poses[1..]
    }

    /// Evaluates one thing of all blocks.
    fn each(
        &mut self,
        what: impl Fn(&EquationBlock, &Kinematics<Lanes>, &mut [Lanes], &mut [Lanes]),
    ) {
        let at = Kinematics {
            poses: &self.poses,
            twists: &self.twists,
            drive: &self.drive,
            offset: &[],
            sides: &[],
            states: &[],
            contacts: &[],
            time: 0.0,
        };
        for block in &self.blocks {
            let rows = &mut self.phi[block.rows.clone()];
            what(block, &at, rows, &mut self.jacobian[block.entries.clone()]);
        }
    }

    /// J and its factors at the position taken; signs of the determinants.
    pub fn factor(&mut self) -> Lanes {
        self.each(|block, at, _, entries| block.equations.jacobian(at, entries));
        let values = self.places.iter();
        let values = values.map(|&[entry, place]| (place, self.jacobian[entry as usize]));
        self.lu.factor(values)
    }

    /// x with J x = rows at hand, times a sign.
    fn solve(&mut self, sign: f64, x: &mut [Lanes]) {
        self.lu.solve(&self.phi, sign, x);
    }

    /// Largest |x| by scales; infinite where one is not finite.
    fn largest(x: &[Lanes], inverse: &[f64]) -> Lanes {
        let (mut largest, mut spoilt) = (Lanes::ZERO, Lanes::ZERO);
        for (x, inverse) in x.iter().zip(inverse) {
            spoilt += *x * Lanes::ZERO;
            largest = largest.simd_max((*x * Lanes::splat(*inverse)).simd_abs());
        }
        largest.select(spoilt.simd_eq(Lanes::ZERO), Lanes::splat(f64::INFINITY))
    }

    /// How far a step goes [–].
    fn size(&self, step: &[Lanes]) -> Lanes {
        Abreast::largest(step, &self.columns)
    }

    /// Moves those asked for onto their constraints. Where a guess is `near` others that were corrected, no angle is corrected by
    /// more than 0.01 rad, and what was left of their first steps, as part of the squares, is handed on: where that leaves only
    /// round-off, one step is enough.
    pub fn correct(
        &mut self,
        q: &mut [Lanes],
        wanted: Which,
        near: Option<&mut Lanes>,
    ) -> Corrected {
        let mut step = std::mem::take(&mut self.step);
        let splat = Lanes::splat;
        let (mut first_step, mut sign, mut steps) = (Lanes::ZERO, Lanes::ZERO, 0);
        let (mut last, mut is_done) = (splat(f64::INFINITY), !wanted);
        let mut is_proven = wanted;
        let most = splat(if near.is_some() { SMALL } else { f64::MAX });
        let mut ignored = splat(f64::INFINITY);
        let (is_near, curvature) = (near.is_some(), near.unwrap_or(&mut ignored));
        self.set_position(q);
        for iteration in 0..MOST_STEPS {
            self.each(|block, at, rows, _| block.equations.position(at, rows));
            if iteration == 0 {
                sign = self.factor();
            } else {
                let residual = Abreast::largest(&self.phi, &self.rows);
                is_done = is_done | residual.simd_le(splat(RESIDUAL_FLOOR));
                if is_done.all() {
                    break;
                }
            }
            self.solve(-1.0, &mut step);
            steps += 1;
            let size = self.size(&step);
            // What is left after a step of Newton is its square, and after one of a chord what the last two say.
            let left = if iteration == 0 {
                first_step = size;
                let left = *curvature * size * size;
                left.select(size.simd_gt(splat(LAST_STEP)), Lanes::ZERO)
            } else {
                let ratio = size / last;
                if iteration == 1 {
                    let seen = splat(CAUTION) * size.simd_max(splat(ROUND_OFF)) / (last * last);
                    let larger = seen.simd_max(*curvature);
                    let known = larger.select(curvature.simd_lt(splat(f64::INFINITY)), seen);
                    *curvature = curvature.select(is_done, known);
                }
                let shrinks = ratio.simd_le(splat(CONTRACTION)) | size.simd_le(splat(LAST_STEP));
                is_proven = is_proven & (is_done | shrinks);
                size * ratio
            };
            is_proven = is_proven & (is_done | size.simd_le(most));
            is_done = is_done | !is_proven;
            // Who is done stays where it is, however many steps the others take.
            for (q, step) in q.iter_mut().zip(&mut step) {
                *step = Lanes::ZERO.select(is_done, *step);
                *q += *step;
            }
            match is_near {
                true => self.move_by(&step),
                false => self.set_position(q),
            }
            is_done = is_done | left.simd_le(splat(ROUND_OFF));
            if is_done.all() {
                break;
            }
            last = size;
        }
        self.step = step;
        is_proven = is_proven & is_done & !sign.simd_eq(Lanes::ZERO);
        Corrected {
            first_step,
            sign,
            steps,
            is_proven,
        }
    }

    /// Velocities and accelerations at the position and the factors at hand.
    pub fn rates(&mut self, v: &mut [Lanes], a: &mut [Lanes]) {
        self.each(|block, at, rows, _| block.equations.rate(at, rows));
        self.solve(-1.0, v);
        for (twist, columns) in self.twists[1..].iter_mut().zip(self.layout.bodies()) {
            *twist = Twist {
                v: Vector::new(v[columns.x()], v[columns.y()]),
                omega: v[columns.theta()],
            };
        }
        self.each(|block, at, rows, _| block.equations.gamma(at, rows));
        self.solve(1.0, a);
    }

    /// Multipliers with the accelerations and the factors at hand; none where weights are unknown.
    pub fn multipliers(&mut self, a: &[Lanes], lambda: &mut [Lanes]) {
        let Some((masses, gravity)) = &self.weights else {
            return;
        };
        for columns in self.layout.bodies() {
            let pull = [gravity[0], gravity[1], Lanes::ZERO];
            for (column, pull) in columns.range().zip(pull) {
                self.step[column] = masses[column] * (pull - a[column]);
            }
        }
        self.lu.solve_transposed(&self.step, lambda);
    }

    /// Multipliers λ with Jᵀ λ = b by the factors at hand.
    pub fn carry(&mut self, b: &[Lanes], lambda: &mut [Lanes]) {
        self.lu.solve_transposed(b, lambda);
    }

    /// Residuals at the position taken, scaled [–].
    pub fn residual(&mut self) -> Lanes {
        self.each(|block, at, rows, _| block.equations.position(at, rows));
        Abreast::largest(&self.phi, &self.rows)
    }

    /// How far a position is from its constraints, by the factors at hand [–].
    pub fn miss(&mut self, q: &[Lanes]) -> Lanes {
        self.set_position(q);
        self.each(|block, at, rows, _| block.equations.position(at, rows));
        let mut step = std::mem::take(&mut self.step);
        self.solve(1.0, &mut step);
        let size = self.size(&step);
        self.step = step;
        size
    }
}
