//! Instants of one motion that are solved side by side, ahead of the rows that they become.

use super::super::clearance_link::balance;
use super::super::instants::OutputInstant;
use super::super::sample::Sample;
use crate::mechanism::abreast::{Abreast, is_among, which};
use crate::mechanism::continuation::{Parameter, Path, Source};
use crate::mechanism::driven::{Driven, Work};
use crate::system::{Evaluation, Inputs, System};
use linkdyn_linear::math::{Lanes, WIDTH};
use nalgebra::SimdValue;

/// Instants ahead of the one at hand.
pub(super) struct Ahead {
    abreast: Abreast,
    reactions: bool,
    /// What is left after first steps, as part of their squares.
    curvature: Lanes,
    /// q, v, a, λ (n).
    motion: [Vec<Lanes>; 4],
    residual: Lanes,
    forces: [Vec<f64>; WIDTH],
    balance: Vec<Lanes>,
    /// How many have been looked at, which of them have been found, and how many have been taken.
    count: usize,
    found: [bool; WIDTH],
    taken: usize,
}

impl Ahead {
    /// Of a mechanism; `None` where each instant is solved alone: with redundant constraints, massless links, or forces that depend
    /// on multipliers, and in slow motions.
    pub fn new(driven: &Driven, reactions: bool) -> Option<Self> {
        let system = driven.system;
        let depends = reactions && !system.dependent_forces.is_empty();
        if system.links > 0 || depends || system.is_slow {
            return None;
        }
        let zero = || vec![Lanes::ZERO; system.n()];
        Some(Ahead {
            abreast: driven.abreast()?,
            reactions,
            curvature: Lanes::splat(f64::INFINITY),
            motion: [(); 4].map(|()| zero()),
            residual: Lanes::ZERO,
            forces: [(); WIDTH].map(|()| vec![0.0; system.n()]),
            balance: zero(),
            count: 0,
            found: [false; WIDTH],
            taken: 0,
        })
    }

    /// Takes the next instant, the first of those given, to a sample and an evaluation; its residual, or `None` where it must be
    /// solved alone.
    pub fn take(
        &mut self,
        driven: &mut Driven,
        path: &Path,
        instants: &[OutputInstant],
        inputs: &Inputs,
        sample: &mut Sample,
    ) -> Option<f64> {
        if self.taken == self.count {
            self.look(driven, path, instants, inputs.clone(), sample);
        }
        let lane = self.taken;
        self.taken += 1;
        if !self.found[lane] {
            return None;
        }
        self.read(lane, &mut driven.evaluation, sample);
        if self.reactions {
            sample.force.copy_from_slice(&self.forces[lane]);
            driven
                .system
                .mass
                .residual(&sample.force, &sample.a, &mut sample.balance);
        }
        Some(self.residual.extract(lane))
    }

    /// Takes one of them to a sample and an evaluation.
    fn read(&self, lane: usize, evaluation: &mut Evaluation, sample: &mut Sample) {
        let to = [
            &mut sample.q,
            &mut sample.v,
            &mut sample.a,
            &mut sample.lambda,
        ];
        for (to, from) in to.into_iter().zip(&self.motion) {
            let pairs = to.iter_mut().zip(from);
            pairs.for_each(|(to, from)| *to = from.extract(lane));
        }
        let turns = self.abreast.poses().iter();
        let turns = turns.map(|pose| [pose.cos.extract(lane), pose.sin.extract(lane)]);
        evaluation.set_poses(&sample.q, turns);
        evaluation.set_velocity(&sample.v);
    }

    /// Solves the next instants.
    fn look(
        &mut self,
        driven: &mut Driven,
        path: &Path,
        instants: &[OutputInstant],
        mut inputs: Inputs,
        sample: &mut Sample,
    ) {
        let system = driven.system;
        let mut expected = [false; WIDTH];
        (self.count, self.taken) = (instants.len().min(WIDTH), 0);
        let Sample { q, v, a, .. } = &mut *sample;
        for (lane, instant) in instants.iter().take(WIDTH).enumerate() {
            drive(system, instant, &mut inputs);
            let s = match path.parameter {
                Parameter::DriverValue => inputs.drive[0][0],
                Parameter::Time | Parameter::Coordinate => instant.time,
            };
            let source = path.guess(s, q, v, a);
            expected[lane] = matches!(source, Some(Source::Regular | Source::Known));
            let pairs = self.motion[0].iter_mut().zip(&*q);
            pairs.for_each(|(all, own)| all.replace(lane, *own));
            for (all, own) in self.abreast.drive.iter_mut().zip(&inputs.drive) {
                for (all, own) in all.iter_mut().zip(own) {
                    all.replace(lane, *own);
                }
            }
        }
        let [q, v, a, _] = &mut self.motion;
        let near = Some(&mut self.curvature);
        let corrected = self.abreast.correct(q, which(|lane| expected[lane]), near);
        self.residual = self.abreast.residual();
        let sign = self.abreast.factor();
        self.abreast.rates(v, a);
        self.found = std::array::from_fn(|lane| {
            is_among(corrected.is_proven, lane) && sign.extract(lane) != 0.0
        });
        let found = self.found.iter().filter(|found| **found).count() as u64;
        let steps = corrected.steps as u64;
        driven.done.add(Work {
            newton_iterations: found * steps,
            evaluations: found * (steps + 1),
            factorisations: 2 * found,
        });
        if !self.reactions {
            return;
        }
        for lane in (0..self.count).filter(|lane| expected[*lane]) {
            drive(system, &instants[lane], &mut inputs);
            self.read(lane, &mut driven.evaluation, sample);
            balance(system, &driven.evaluation, &inputs, sample);
            self.forces[lane].copy_from_slice(&sample.force);
            let pairs = self.balance.iter_mut().zip(&sample.balance);
            pairs.for_each(|(all, own)| all.replace(lane, *own));
        }
        self.abreast.carry(&self.balance, &mut self.motion[3]);
    }
}

fn drive(system: &System, instant: &OutputInstant, inputs: &mut Inputs) {
    inputs.time = instant.time;
    instant.drive(system, &mut inputs.drive);
}
