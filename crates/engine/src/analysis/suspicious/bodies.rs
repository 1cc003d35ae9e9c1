//! What all of these looks measure bodies by.

use linkdyn_linear::math::Vec2;
use linkdyn_model::{Body, GROUND, Model};

/// Significant digits: enough to see a slip.
pub(super) const DIGITS: usize = 4;

/// Moving bodies with their names.
pub(super) fn moving(model: &Model) -> impl Iterator<Item = (&String, &Body)> {
    model.bodies.iter().filter(|(name, _)| *name != GROUND)
}

/// Its points \[m\].
pub(super) fn points(body: &Body) -> impl Iterator<Item = Vec2> {
    body.points.values().map(|&point| Vec2::from(point))
}

/// Largest distance of two points of a body \[m\]; zero where it has one or none.
pub(super) fn extent(body: &Body) -> f64 {
    let low = points(body).fold(Vec2::repeat(f64::INFINITY), |low, point| low.inf(&point));
    let high = points(body).fold(Vec2::repeat(f64::NEG_INFINITY), |high, point| {
        high.sup(&point)
    });
    if body.points.len() < 2 {
        0.0
    } else {
        (high - low).norm()
    }
}
