//! The curves on which a mechanism moves, and their change points: one of the whole, or one of each part that has its own.

use super::Reduced;
use crate::mechanism::continuation::Path;

/// A change point of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChangePoint {
    /// Number of the curve.
    pub curve: usize,
    /// Number of its window; whole turns come to the same again.
    pub window: usize,
    /// The curve's coordinate there [rad or m].
    pub s: f64,
    /// Half width of the stretch on which the smooth branch was looked at, in the same.
    pub width: f64,
}

impl ChangePoint {
    /// Whether both are the same position of the mechanism.
    pub fn is(&self, other: &ChangePoint) -> bool {
        (self.curve, self.window) == (other.curve, other.window)
    }
}

impl Reduced<'_> {
    /// Number of curves.
    pub fn curves(&self) -> usize {
        match (self.chart.curve(), self.chart.bridge()) {
            (Some(_), _) => 1,
            (None, Some(parts)) => parts.count(),
            (None, None) => 0,
        }
    }

    /// Whether there is one of the whole, by the independent coordinate.
    pub fn is_curve(&self) -> bool {
        self.chart.curve().is_some()
    }

    fn path(&self, curve: usize) -> Option<&Path> {
        match (self.chart.curve(), self.chart.bridge()) {
            (Some(of_whole), _) => of_whole.path(),
            (None, Some(parts)) => parts.path(curve),
            (None, None) => None,
        }
    }

    /// The coordinate of a curve with the mechanism at `q` [rad or m]; `None` if it was not followed yet.
    pub fn coordinate(&self, curve: usize, q: &[f64]) -> Option<f64> {
        self.path(curve)?;
        match self.chart.bridge() {
            Some(parts) if !self.is_curve() => parts.coordinate(curve, q),
            Some(_) | None => Some(q[self.driven.independent[0].column]),
        }
    }

    /// Change points of a curve between two values of its coordinate.
    pub fn change_points(
        &self,
        curve: usize,
        [from, to]: [f64; 2],
    ) -> impl Iterator<Item = ChangePoint> {
        let path = self.path(curve).into_iter();
        path.flat_map(move |path| {
            let points = path.change_points_between(from.min(to), from.max(to));
            points.map(move |(window, s)| ChangePoint {
                curve,
                window,
                s,
                width: path.windows()[window].width,
            })
        })
    }
}
