//! Derivatives of forces, put together from those that elements know of their own.
//!
//! ```text
//! ∂Q/∂q, ∂Q/∂v     springs, dampers, loads, contacts       (gravity has none)
//! ∂(Jᵀλ)/∂q        constraints, symmetric
//! ```

use super::{Evaluation, Inputs, System};
use crate::element::Slope;

/// Row and column of an entry; none of ground.
pub(crate) type RowColumn = [Option<usize>; 2];

/// Where the entries of a system's derivatives stand: in the order of forces and contacts, and of blocks.
#[derive(Clone)]
pub(crate) struct Slopes {
    /// Of the forces' derivatives.
    pub forces: Vec<RowColumn>,
    /// Of the constraints'; what stands beside the diagonal stands for two.
    pub bends: Vec<RowColumn>,
    /// Entries of each force and contact, and of each block.
    force_counts: Vec<usize>,
    bend_counts: Vec<usize>,
}

impl Slopes {
    /// Of a system.
    pub fn of(system: &System) -> Self {
        let place = |pair: &Slope| pair.map(|(body, axis)| system.layout.column(body, axis));
        let of_forces = system.forces.iter().map(|force| force.slopes());
        let of_contacts = system.contacts.iter().map(|contact| contact.slopes());
        let of_blocks = system
            .blocks
            .iter()
            .map(|block| block.constraint.curvature_pattern());
        let forces: Vec<Vec<Slope>> = of_forces.chain(of_contacts).collect();
        let bends: Vec<Vec<Slope>> = of_blocks.collect();
        Slopes {
            forces: forces.iter().flatten().map(place).collect(),
            bends: bends.iter().flatten().map(place).collect(),
            force_counts: forces.iter().map(Vec::len).collect(),
            bend_counts: bends.iter().map(Vec::len).collect(),
        }
    }

    /// ∂Q/∂q and ∂Q/∂v at the position and velocity taken.
    pub fn eval_forces(
        &self,
        evaluation: &Evaluation,
        (system, inputs): (&System, &Inputs),
        mut position: &mut [f64],
        mut velocity: &mut [f64],
    ) {
        let at = evaluation.kinematics(inputs);
        let (of_forces, of_contacts) = self.force_counts.split_at(system.forces.len());
        for (force, count) in system.forces.iter().zip(of_forces) {
            let (by_position, by_velocity);
            (by_position, position) = position.split_at_mut(*count);
            (by_velocity, velocity) = velocity.split_at_mut(*count);
            force.slope(&at, by_position, by_velocity);
        }
        let contacts = system.contacts.iter().zip(&inputs.contacts);
        for ((contact, memory), count) in contacts.zip(of_contacts) {
            let (by_position, by_velocity);
            (by_position, position) = position.split_at_mut(*count);
            (by_velocity, velocity) = velocity.split_at_mut(*count);
            contact.slope(&at, memory, by_position, by_velocity);
        }
    }

    /// ∂(Jᵀλ)/∂q at the position taken, of multipliers λ (m).
    pub fn eval_bends(
        &self,
        evaluation: &Evaluation,
        (system, inputs): (&System, &Inputs),
        lambda: &[f64],
        mut values: &mut [f64],
    ) {
        let at = evaluation.kinematics(inputs);
        for (block, count) in system.blocks.iter().zip(&self.bend_counts) {
            let own;
            (own, values) = values.split_at_mut(*count);
            let lambda = &lambda[block.rows()];
            block.constraint.bend(&at, lambda, own);
        }
    }
}
