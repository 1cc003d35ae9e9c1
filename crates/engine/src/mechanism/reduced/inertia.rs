//! Who solves for accelerations, and what they need of the mechanism.
//!
//! ```text
//! tangents    v = S u̇ + v_t,  SᵀM S ü = Sᵀ (Q − M a₀),  a = S ü + a₀      S (n, f), SᵀMS (f, f): cost as f³
//! sparse      J_A v = (−φ_t, u̇),  [M Jᵀ; J 0] (a, λ) = (Q, γ)             frozen patterns: cost as the entries
//! ```
//!
//! Both give the same motion. Independent coordinates are given either way, so that positions and velocities never drift; what
//! differs is where ü comes from. Of few degrees of freedom the small dense matrices are cheaper.

use super::sparse::Sparse;
use super::tangents::Tangents;
use crate::mechanism::driven::{Driven, Failure};
use crate::system::Inputs;

/// Degrees of freedom from which on entries are fewer than what is dense.
const MANY: usize = 5;

/// Who may be wanted to solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solver {
    /// Dense, by tangents.
    Tangents,
    /// Sparse, with the multipliers.
    Sparse,
}

/// Who solves.
#[derive(Clone)]
pub(super) enum Inertia {
    /// Dense, by tangents.
    Tangents(Tangents),
    /// Sparse, with the multipliers.
    Sparse(Box<Sparse>),
}

impl Inertia {
    /// Who is wanted, or else costs least for a mechanism.
    pub fn of(driven: &Driven, solver: Option<Solver>) -> Self {
        let cheapest = if driven.independent.len() < MANY {
            Solver::Tangents
        } else {
            Solver::Sparse
        };
        match solver.unwrap_or(cheapest) {
            Solver::Tangents => Inertia::Tangents(Tangents::of(driven)),
            Solver::Sparse => Inertia::Sparse(Box::new(Sparse::of(driven))),
        }
    }

    /// The tangents, where there are any.
    pub fn tangents(&mut self) -> Option<&mut Tangents> {
        match self {
            Inertia::Tangents(tangents) => Some(tangents),
            Inertia::Sparse(_) => None,
        }
    }

    /// S (f × n), where it is at hand.
    pub fn known_tangents(&self) -> &[f64] {
        match self {
            Inertia::Tangents(tangents) => &tangents.s,
            Inertia::Sparse(_) => &[],
        }
    }

    /// v (n) at a position that satisfies the constraints, by the factors at hand; `rates` are u̇ (f).
    pub fn velocity(&mut self, driven: &mut Driven, inputs: &Inputs, rates: &[f64], v: &mut [f64]) {
        match self {
            Inertia::Tangents(tangents) => tangents.velocity(driven, inputs, rates, v),
            Inertia::Sparse(_) => driven.velocity(inputs, v),
        }
    }

    /// a (n) under forces Q (n), where independent coordinates have ü (f).
    ///
    /// # Errors
    /// Where freedom has no mass.
    pub fn accelerate(
        &mut self,
        driven: &mut Driven,
        inputs: &Inputs,
        force: &[f64],
        [a, accelerations]: [&mut [f64]; 2],
    ) -> Result<(), Failure> {
        match self {
            Inertia::Tangents(tangents) => {
                driven.acceleration(inputs, a);
                tangents.accelerate(driven, force, [a, accelerations])
            }
            Inertia::Sparse(sparse) => {
                sparse.accelerate(driven, inputs, force, a)?;
                let own = driven.independent.iter().zip(accelerations);
                own.for_each(|(coordinate, to)| *to = a[coordinate.column]);
                Ok(())
            }
        }
    }

    /// What a generalized force or impulse (n) changes, of accelerations or velocities (n), at the point of the last
    /// accelerations.
    pub fn respond(&mut self, driven: &Driven, force: &[f64], change: &mut [f64]) {
        match self {
            Inertia::Tangents(tangents) => tangents.respond(force, change),
            Inertia::Sparse(sparse) => sparse.respond(driven, force, change),
        }
    }
}
