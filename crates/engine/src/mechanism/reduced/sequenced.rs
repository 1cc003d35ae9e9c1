//! Positions and velocities of dependent coordinates that follow one after the other.

use super::Reduced;
use super::inertia::Inertia;
use super::place::Placed;
use super::sequence::Sequence;
use crate::mechanism::driven::Failure;

impl Reduced<'_> {
    /// Looks for an order of the choice at hand, at the position of the last Jacobian. Of few coordinates tangents are at hand, and
    /// where there is a bridge rows change on the way.
    pub(super) fn find_sequence(&mut self) {
        let order = match self.inertia {
            Inertia::Sparse(_) if self.chart.bridge().is_none() => Sequence::of(&self.driven),
            Inertia::Sparse(_) | Inertia::Tangents(_) => None,
        };
        self.sequence = order.map(Box::new);
    }

    /// q and v where the independent coordinates have these values and rates, and the factors where they are wanted; whether the others
    /// follow one after the other.
    pub(super) fn solve_in_sequence(&mut self, u: &[f64], rates: &[f64]) -> Result<bool, Failure> {
        let Some(sequence) = self.sequence.as_mut().filter(|own| own.is_of(&self.driven)) else {
            return Ok(false);
        };
        let (driven, inputs) = (&mut self.driven, &self.inputs);
        driven.give(u, rates);
        self.q.copy_from_slice(&self.accepted.here.q);
        sequence.place(driven, inputs, &mut self.q);
        if self.with_factors {
            driven.refresh(inputs)?;
            self.placed = Placed::Close;
        } else {
            driven.evaluation.eval_jacobian(driven.system, inputs);
            self.placed = Placed::InSequence;
        }
        sequence.velocity(driven, inputs, &mut self.v);
        Ok(true)
    }
}
