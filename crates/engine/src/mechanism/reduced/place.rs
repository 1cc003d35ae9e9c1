//! The question that every chart answers: a position, from the independent coordinates.

use super::accepted::Accepted;
use crate::mechanism::driven::{Driven, Failure};
use crate::system::Inputs;

/// The independent coordinates that are given, and when.
#[derive(Clone, Copy)]
pub(super) struct Given<'a> {
    /// \[s\]
    pub time: f64,
    /// u (f).
    pub u: &'a [f64],
    /// Drivers and memories then.
    pub inputs: &'a Inputs,
    /// The points that predict it.
    pub accepted: &'a Accepted,
    /// How well S and S' must be known where nothing is solved [rad or sizes]; `None` if it is wanted with the equations' factors.
    pub known_to: Option<f64>,
}

/// What a chart's position is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Placed {
    /// Near the position that is meant: the constraints correct it.
    Guess,
    /// The same, nearly to round-off.
    Close,
    /// On a curve that is known with S and S'; the constraints have factors there.
    Known,
    /// On the smooth branch of a curve, whose S and S' hold.
    Smooth,
    /// On constraints that are linear in what moves; the constraints have no factors there.
    Straight,
    /// On constraints that say the dependent coordinates one after the other; the same.
    InSequence,
}

/// Where positions come from.
pub(super) trait PositionSource<'s> {
    /// Puts q (n) at the given coordinates, or near, and where they are known S and S' beside it (n); `driven` becomes the solver to
    /// correct it with.
    ///
    /// # Errors
    /// Where such a solver can't be made.
    fn place(
        &mut self,
        given: Given,
        driven: &mut Driven<'s>,
        to: [&mut [f64]; 3],
    ) -> Result<Placed, Failure>;

    /// Forgets what belongs to other independent coordinates.
    fn forget(&mut self);
}
