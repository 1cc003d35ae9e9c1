//! Charts: where a position comes from when the independent coordinates u are given.
//!
//! ```text
//! coordinates   q(u, t) predicted from the accepted points, corrected by Newton         any mechanism
//! curve         q(u), S = dq/du and S' from a path that was followed once, near         one degree of freedom,
//!               change points from its smooth branch                                    drivers at rest
//! bridge        as coordinates, with the smooth branches of parts in the place of       parts with one degree of
//!               their joints near those parts' change points                            freedom in a larger mechanism
//! ```
//!
//! A chart says whether its position is a guess, which the constraints still correct, or one that is known with S and S', so that
//! nothing is to be solved: on a smooth branch the constraints have no trustworthy factors at all.

use super::curve::CoordinateCurve;
use super::extrapolation::Extrapolation;
use super::place::{Given, Placed, PositionSource};
use crate::mechanism::driven::{Driven, Failure};
use crate::mechanism::parts::Parts;

/// The charts there are.
#[derive(Clone)]
pub(super) enum Chart<'s> {
    /// Coordinates, and bridges across parts' change points.
    Coordinates(Extrapolation<'s>),
    /// A curve of one coordinate.
    CoordinateCurve(Box<CoordinateCurve<'s>>),
}

impl<'s> Chart<'s> {
    /// The curve, where there is one.
    pub fn curve(&self) -> Option<&CoordinateCurve<'s>> {
        match self {
            Chart::CoordinateCurve(curve) => Some(curve),
            Chart::Coordinates(_) => None,
        }
    }

    /// The same, to be changed.
    pub fn curve_mut(&mut self) -> Option<&mut CoordinateCurve<'s>> {
        match self {
            Chart::CoordinateCurve(curve) => Some(curve),
            Chart::Coordinates(_) => None,
        }
    }

    fn extrapolation(&mut self) -> &mut Extrapolation<'s> {
        match self {
            Chart::CoordinateCurve(curve) => &mut curve.beyond,
            Chart::Coordinates(extrapolation) => extrapolation,
        }
    }

    /// The bridge, where there is one.
    pub fn bridge(&self) -> Option<&Parts<'s>> {
        match self {
            Chart::CoordinateCurve(curve) => curve.beyond.bridge.as_ref(),
            Chart::Coordinates(extrapolation) => extrapolation.bridge.as_ref(),
        }
    }

    /// Exchanges the bridge for another.
    pub fn exchange_bridge(&mut self, bridge: Option<Parts<'s>>) -> Option<Parts<'s>> {
        std::mem::replace(&mut self.extrapolation().bridge, bridge)
    }

    /// The solver of the mechanism's own equations, where that of parts' smooth branches is in use.
    pub fn own(&mut self) -> Option<&mut Driven<'s>> {
        self.extrapolation().bridge.as_mut()?.own()
    }
}

impl<'s> PositionSource<'s> for Chart<'s> {
    fn place(
        &mut self,
        given: Given,
        driven: &mut Driven<'s>,
        to: [&mut [f64]; 3],
    ) -> Result<Placed, Failure> {
        match self {
            Chart::Coordinates(extrapolation) => extrapolation.place(given, driven, to),
            Chart::CoordinateCurve(curve) => curve.place(given, driven, to),
        }
    }

    fn forget(&mut self) {
        match self {
            Chart::Coordinates(extrapolation) => extrapolation.forget(),
            Chart::CoordinateCurve(curve) => curve.forget(),
        }
    }
}
