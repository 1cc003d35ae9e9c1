//! Positions by extrapolation from the accepted points.

use super::place::{Given, Placed, PositionSource};
use crate::mechanism::driven::{Driven, Failure};
use crate::mechanism::parts::Parts;

/// Positions predicted from the accepted points, where there are parts across their change points.
#[derive(Clone, Default)]
pub(super) struct Extrapolation<'s> {
    pub bridge: Option<Parts<'s>>,
}

impl<'s> PositionSource<'s> for Extrapolation<'s> {
    fn place(
        &mut self,
        given: Given,
        driven: &mut Driven<'s>,
        [q, ..]: [&mut [f64]; 3],
    ) -> Result<Placed, Failure> {
        let columns = driven
            .independent
            .iter()
            .map(|coordinate| coordinate.column);
        let independent = columns.zip(given.u.iter().copied());
        given.accepted.predict(given.time, independent, q);
        if let Some(parts) = &mut self.bridge {
            parts.enter(driven, q, &given.accepted.here, given.inputs)?;
        }
        Ok(Placed::Guess)
    }

    fn forget(&mut self) {}
}
