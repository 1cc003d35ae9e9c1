//! How an equilibrium changes with a parameter.
//!
//! Where the mechanism rests, with u the coordinates that determine its position q and S = ∂q/∂u (`mechanism/held`),
//!
//! ```text
//! φ(q; p) = 0               J q̄_p = −∂φ                          ∂ along p, u held
//! F = Jᵀ λ − Q = 0          r = ∂F                               along p and q̄_p at λ held
//!                           K u_p = −Sᵀ r                        K = Sᵀ (∂F/∂q) S
//!                           q_p = q̄_p + S u_p
//!                           Jᵀ λ_p = −∂F                         along p and q_p at λ held
//! column                    ∂ along all of them
//! ```
//!
//! Sᵀ of the derivative of F = 0 by p is the third line, for Sᵀ Jᵀ = 0. K is the stiffness −∂(Sᵀ Q)/∂u of the equilibrium: with
//! λᵀ ∂²φ(S, S) = −λᵀ J ∂²q/∂u² = −Q ∂²q/∂u² its geometric part is that of `held`. Here it comes from the same formula as all
//! other derivatives, at the places along each tangent, and says by them whether it is smooth. Directions that nearly nothing
//! holds have no derivatives that are known.
//! (Haug and Arora, Applied Optimal Design, 1979.)

use super::{Along, Differentiated, Readers, SlopeInstant, Slopes};
use crate::analysis::family::stencil::STEP;
use crate::analysis::sample::Sample;
use crate::analysis::statics;
use crate::mechanism::linearised_system::LinearisedSystem;
use linkdyn_linear::eigen::{solve, symmetric};
use linkdyn_linear::math::{dot, max_abs};

/// A stiffness this small beside the largest force and stiffness leaves too few digits.
const SOFT: f64 = 1e-6;
/// Newton's next step in an equilibrium is round-off, in rad or sizes.
const REACHED: f64 = 1e-9;

/// An equilibrium, and what holds it.
pub struct Equilibrium {
    sample: Sample,
    /// K (f × f, by rows) by the scales of its coordinates \[J\].
    stiffness: Vec<f64>,
}

impl Slopes<'_> {
    /// Of a mechanism in its equilibrium; `None` if nothing differentiable holds that.
    pub fn equilibrium(&mut self, held: &mut LinearisedSystem) -> Option<Equilibrium> {
        if held.driven.is_redundant() {
            return None;
        }
        let sample = statics::sample(held);
        let instant = SlopeInstant {
            system: held.driven.system,
            time: held.inputs.time,
            sample: &sample,
        };
        let f = held.freedom();
        let mut stiffness = vec![0.0; f * f];
        for j in 0..f {
            let scale = held.scale(j);
            let tangent = held.tangent(j).iter();
            let motion = self.position.iter_mut();
            motion.zip(tangent).for_each(|(to, own)| *to = scale * own);
            self.differentiate(Differentiated::Forces, &instant, &Along::Motion(STEP));
            if !self.are_forces_smooth(&instant) {
                return None;
            }
            for i in 0..f {
                stiffness[i * f + j] = held.scale(i) * dot(held.tangent(i), &self.forces.slopes);
            }
        }
        let is_held = is_held(held, &sample, &stiffness);
        is_held.then_some(Equilibrium { sample, stiffness })
    }

    /// Derivatives of the wanted columns along a parameter; NaN of one that is not smooth there, `None` if the equations are not.
    pub fn at_rest(
        &mut self,
        held: &mut LinearisedSystem,
        equilibrium: &Equilibrium,
        along: &Along,
        readers: Readers,
    ) -> Option<Vec<f64>> {
        let Equilibrium { sample, stiffness } = equilibrium;
        let instant = SlopeInstant {
            system: held.driven.system,
            time: held.inputs.time,
            sample,
        };
        self.differentiate(Differentiated::Positions, &instant, along);
        self.solve(&mut held.driven, 1.0, |own| &mut own.position)?;
        if held.freedom() > 0 {
            self.differentiate(Differentiated::Forces, &instant, along);
            if !self.are_forces_smooth(&instant) {
                return None;
            }
            let slopes = &self.forces.slopes;
            let moved = moved(held, stiffness, |k| -dot(held.tangent(k), slopes))?;
            super::add(&mut self.position, &moved, 1.0);
        }
        let depth = self.carried(true, &mut held.driven, &instant, along);
        Some(self.read(depth, &instant, along, readers))
    }
}

/// How the mechanism gives way to a pull (f) on its coordinates (n); `None` if it does so without end.
fn moved(
    held: &LinearisedSystem,
    stiffness: &[f64],
    pull: impl Fn(usize) -> f64,
) -> Option<Vec<f64>> {
    let f = held.freedom();
    let pull: Vec<f64> = (0..f).map(|k| held.scale(k) * pull(k)).collect();
    let mut step = solve(stiffness, &pull)?;
    let steps = step.iter_mut().enumerate();
    steps.for_each(|(k, step)| *step *= held.scale(k));
    let moved = held.along(&step);
    moved.iter().all(|own| own.is_finite()).then_some(moved)
}

/// Whether the forces hold every direction, and the mechanism is where they do.
fn is_held(held: &LinearisedSystem, sample: &Sample, stiffness: &[f64]) -> bool {
    let f = held.freedom();
    if f == 0 {
        return true;
    }
    let system = held.driven.system;
    let forces = sample.force.iter().enumerate();
    let forces: Vec<f64> = forces
        .map(|(k, force)| force * system.column_scale(k))
        .collect();
    let floor = SOFT * (max_abs(&forces) + max_abs(stiffness));
    let pull = held.pull();
    let rest = moved(held, stiffness, |k| pull[k]);
    let is_there = rest.is_some_and(|rest| system.scaled_norm(&rest) <= REACHED);
    is_there && symmetric(stiffness, f).0[0] > floor
}
