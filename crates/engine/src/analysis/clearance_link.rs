//! The massless equivalent clearance link (Zhi, Wang and Sun 2014, §3; after Earles and Wu 1972): a fixed point at each
//! output instant.
//!
//! ```text
//! e_k = e (cos ψ_k, sin ψ_k)          journal centre − bearing centre [m], |e_k| the radial clearance
//! ψ_k = arg(−f_k)                     f_k the joint's force, first body on second: the journal presses the bearing
//! ψ̇_k = (ψ_k − ψ_k at the output instant before) / Δt,  0 at the first instant and behind a gap;  ψ̈_k = 0
//! ```
//!
//! 1. ψ from the ideal forces; 2. positions, velocities, accelerations, forces with these offsets; 3. ψ from these
//!    forces; repeat from 2 until no body coordinate changes by more than ε, lengths measured by the mechanism's size.
//!
//! Positions are reached from the ideal ones by letting the offsets grow from zero (homotopy), so the solution is the one
//! connected to the ideal branch, and a fold on the way proves that it ends before the clearance is reached.

use super::sample::Sample;
use crate::mechanism::driven::{Driven, Failure};
use crate::system::{Evaluation, Inputs, System};
use linkdyn_linear::math::{Vec2, dot, perp};
use std::f64::consts::{PI, TAU};

/// Largest change of any body coordinate, in rad or mechanism sizes, at which the fixed point counts as found.
pub const EPSILON: f64 = 1e-10;
/// Most passes at one instant.
pub const MOST_PASSES: usize = 50;
/// Newton's contraction up to which a solution provably belongs to its start (Kantorovich: ½ of its constant).
const SAFE_CONTRACTION: f64 = 0.25;
/// Shortest step of the homotopy, as a part of the clearance.
const SHORTEST: f64 = 1e-8;

/// How an instant went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fixpoint {
    /// The directions are those of the forces.
    Converged {
        /// Passes that it took.
        passes: usize,
    },
    /// The last pass moved a coordinate by this much, in rad or mechanism sizes.
    NotConverged {
        /// Largest change of a coordinate [m or rad].
        change: f64,
    },
    /// No assembly on the branch of the ideal mechanism, found in this pass.
    NoSolution {
        /// Number of the pass.
        pass: usize,
    },
}

/// The links' directions from instant to instant.
pub struct ClearanceLinks {
    /// (links) joint index and radius.
    joints: Vec<(usize, f64)>,
    /// Angles and time of the instant before.
    before: Option<(f64, Vec<f64>)>,
    psi: Vec<f64>,
}

impl ClearanceLinks {
    /// The links of a system; `None` if it has none.
    pub fn of(system: &System) -> Option<Self> {
        let joints: Vec<(usize, f64)> = system
            .joints
            .iter()
            .enumerate()
            .filter_map(|(k, joint)| joint.clearance().map(|link| (k, link.radius)))
            .collect();
        (!joints.is_empty()).then(|| ClearanceLinks {
            psi: vec![0.0; joints.len()],
            before: None,
            joints,
        })
    }

    /// Directions from the multipliers; a force that is zero or does not exist leaves its link as it is.
    fn aim(&mut self, system: &System, lambda: &[f64]) {
        for (psi, &(joint, _)) in self.psi.iter_mut().zip(&self.joints) {
            let row = system.blocks[joint].row();
            let (fx, fy) = (lambda[row], lambda[row + 1]);
            if fx.hypot(fy) > 0.0 {
                *psi = (-fy).atan2(-fx);
            }
        }
    }

    fn set_offsets(&self, inputs: &mut Inputs) {
        for (k, &(_, radius)) in self.joints.iter().enumerate() {
            let (sin, cos) = self.psi[k].sin_cos();
            let u = Vec2::new(cos, sin);
            let rate = match &self.before {
                Some((time, psi)) if inputs.time > *time => {
                    turn(self.psi[k] - psi[k]) / (inputs.time - time)
                }
                _ => 0.0,
            };
            inputs.offset[k] = [
                u * radius,
                perp(u) * (radius * rate),
                u * (-radius * rate * rate),
            ];
        }
    }

    /// Finds the fixed point at the instant of `inputs`; `sample` holds the ideal solution and receives this one.
    /// `inputs` keeps the offsets found.
    pub fn solve(
        &mut self,
        driven: &mut Driven,
        inputs: &mut Inputs,
        sample: &mut Sample,
    ) -> Fixpoint {
        let system = driven.system;
        let ideal = sample.q.clone();
        self.aim(system, &sample.lambda);
        let mut last = ideal.clone();
        let mut outcome = Fixpoint::NotConverged {
            change: f64::INFINITY,
        };
        for pass in 1..=MOST_PASSES {
            self.set_offsets(inputs);
            if pass > 1 {
                sample.q.copy_from_slice(&last);
            }
            let near = pass > 1 && corrected(driven, inputs, &mut sample.q);
            if !near && !reach(driven, inputs, &ideal, &mut sample.q) {
                self.before = None;
                return Fixpoint::NoSolution { pass };
            }
            if forces(driven, inputs, sample).is_err() {
                self.before = None;
                return Fixpoint::NoSolution { pass };
            }
            let moved: Vec<f64> = sample.q.iter().zip(&last).map(|(a, b)| a - b).collect();
            let change = system.scaled_norm(&moved);
            last.copy_from_slice(&sample.q);
            if pass > 1 && change < EPSILON {
                outcome = Fixpoint::Converged { passes: pass };
                break;
            }
            outcome = Fixpoint::NotConverged { change };
            if pass < MOST_PASSES {
                self.aim(system, &sample.lambda);
            }
        }
        self.before = Some((inputs.time, self.psi.clone()));
        outcome
    }
}

/// The angle in (−π, π].
fn turn(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}

/// Newton from `q`, taken only when its contraction proves the branch.
fn corrected(driven: &mut Driven, inputs: &Inputs, q: &mut [f64]) -> bool {
    driven
        .correct(q, inputs)
        .is_ok_and(|correction| correction.contraction <= SAFE_CONTRACTION)
}

/// Lets the offsets grow from zero to those of `inputs`, starting at the ideal position; whether that was possible.
fn reach(driven: &mut Driven, inputs: &Inputs, ideal: &[f64], q: &mut Vec<f64>) -> bool {
    q.copy_from_slice(ideal);
    if corrected(driven, inputs, q) {
        return true;
    }
    q.copy_from_slice(ideal);
    let mut part = 0.0;
    let mut step = 0.25;
    let mut before: Option<(f64, Vec<f64>)> = None;
    let mut scaled = inputs.clone();
    let mut trial = q.clone();
    while part < 1.0 {
        if step < SHORTEST {
            return false;
        }
        let next = if part + step >= 1.0 { 1.0 } else { part + step };
        for (offset, full) in scaled.offset.iter_mut().zip(&inputs.offset) {
            offset[0] = full[0] * next;
        }
        match &before {
            // Secant prediction.
            Some((at, from)) => {
                let along = (next - part) / (part - at);
                for k in 0..q.len() {
                    trial[k] = q[k] + along * (q[k] - from[k]);
                }
            }
            None => trial.copy_from_slice(q),
        }
        if corrected(driven, &scaled, &mut trial) {
            before = Some((part, q.clone()));
            std::mem::swap(q, &mut trial);
            part = next;
            step *= 2.0;
        } else {
            step *= 0.5;
        }
    }
    true
}

/// Velocities, accelerations and multipliers at the position of `sample`.
pub fn forces(driven: &mut Driven, inputs: &Inputs, sample: &mut Sample) -> Result<(), Failure> {
    driven.factor(inputs)?;
    forces_at_factors(driven, inputs, sample)
}

/// The same at a position whose factors are at hand.
pub fn forces_at_factors(
    driven: &mut Driven,
    inputs: &Inputs,
    sample: &mut Sample,
) -> Result<(), Failure> {
    driven.velocity(inputs, &mut sample.v);
    driven.acceleration(inputs, &mut sample.a);
    balance(driven.system, &driven.evaluation, inputs, sample);
    carried(driven, inputs, sample)
}

/// Multipliers, and the forces that depend on them, at a sample whose `force` and `balance` are without these.
///
/// # Errors
/// [`Failure::Locked`].
pub fn carried(driven: &mut Driven, inputs: &Inputs, sample: &mut Sample) -> Result<(), Failure> {
    let system = driven.system;
    if system.is_slow && !system.dependent_forces.is_empty() {
        // Friction asks for the direction of motion.
        let speed = system.scaled_norm(&sample.v);
        let direction: Vec<f64> = sample
            .v
            .iter()
            .map(|v| v / speed.max(f64::MIN_POSITIVE))
            .collect();
        driven.evaluation.set_velocity(&direction);
    }
    let Sample {
        force,
        balance,
        lambda,
        dependent_forces,
        ..
    } = sample;
    let found = driven.react(inputs, force, balance, lambda);
    dependent_forces.copy_from_slice(driven.dependent_forces.sizes());
    found
}

/// Q and Q − M a (n), what the constraints must carry; a = 0 in a slow motion.
pub fn balance(system: &System, evaluation: &Evaluation, inputs: &Inputs, sample: &mut Sample) {
    evaluation.eval_force(system, inputs, &mut sample.force);
    if system.is_slow {
        sample.a.fill(0.0);
    }
    system
        .mass
        .residual(&sample.force, &sample.a, &mut sample.balance);
}

/// λ_driver = −bᵀ dq/du: the effort of a single driver by virtual power, good also where J is singular.
pub fn effort_by_power(b: &[f64], dq: &[f64]) -> f64 {
    -dot(b, dq)
}
