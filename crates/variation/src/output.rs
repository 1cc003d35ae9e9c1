//! What is asked about: a number that a position has.
//!
//! ```text
//! angle         y = θ                       ∂y = [0, 0, 1]
//! coordinate    y = k·(r + ρ)               ∂y = [kᵀ, k·ρ⊥]                        k a unit vector
//! distance      y = |P₂ − P₁|               ∂y = [−uᵀ, −u·ρ₁⊥ | uᵀ, u·ρ₂⊥]         u from P₁ to P₂
//! ```

use super::geometry::PointId;
use linkdyn_engine::element::{BodyId, Kinematics, Layout, Marker};
use linkdyn_linear::math::{Vec2, perp};

/// A point of a body, and its number among the dimensions; the origin of a frame has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub marker: Marker,
    pub point: Option<PointId>,
}

impl Place {
    /// Where it is, its point off by `shift` (body frame).
    fn at(&self, at: &Kinematics, shift: &dyn Fn(PointId) -> Vec2) -> Vec2 {
        let off = self.point.map_or(Vec2::zeros(), shift);
        at.poses[self.marker.body.0].r + at.poses[self.marker.body.0].turn(self.marker.s + off)
    }
}

/// A load on the output, drivers locked: Jᵀ λ = size·∂yᵀ.
#[derive(Debug, Clone)]
pub(super) struct Load {
    /// λ (m).
    pub lambda: Vec<f64>,
    /// 1, or what it is at a change point: 0.
    pub size: f64,
}

/// Points that an output is about, each with ∂y/∂(place of the point), in global axes.
pub(super) type Pulls = [Option<(Place, Vec2)>; 2];

/// A number that a position has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Output {
    /// Angle of a body \[rad\].
    Angle(BodyId),
    /// Place of a point along a direction of the ground frame \[m\].
    Coordinate(Place, Vec2),
    /// Distance of two points \[m\].
    Distance(Place, Place),
}

impl Output {
    /// Whether it is measured in radians.
    pub fn is_angle(&self) -> bool {
        matches!(self, Output::Angle(_))
    }

    /// Its value [rad or m], points off by `shift` (body frame).
    pub fn value(&self, at: &Kinematics, shift: &dyn Fn(PointId) -> Vec2) -> f64 {
        match self {
            Output::Angle(body) => at.poses[body.0].theta,
            Output::Coordinate(place, along) => along.dot(&place.at(at, shift)),
            Output::Distance(from, to) => (to.at(at, shift) - from.at(at, shift)).norm(),
        }
    }

    /// The points that it is about, each with ∂y/∂(place of the point), in global axes; points off by `shifts` (body frames).
    pub fn pulls(&self, at: &Kinematics, shifts: &[Vec2]) -> Pulls {
        match *self {
            Output::Angle(_) => [None, None],
            Output::Coordinate(place, along) => [Some((place, along)), None],
            Output::Distance(from, to) => {
                let place = |place: Place| place.at(at, &|PointId(point)| shifts[point]);
                let along = linkdyn_engine::element::direction(place(to) - place(from));
                // Zero where the points coincide.
                let along = along.map_or(Vec2::zeros(), |(unit, _)| unit);
                [Some((from, -along)), Some((to, along))]
            }
        }
    }

    /// ∂y/∂q (n), with what [`Output::pulls`] says; points that are off keep their direction.
    pub fn gradient(&self, at: &Kinematics, pulls: &Pulls, layout: &Layout, gradient: &mut [f64]) {
        gradient.fill(0.0);
        if let Output::Angle(body) = self {
            if let Some(columns) = layout.columns(*body) {
                gradient[columns.theta()] = 1.0;
            }
            return;
        }
        for (place, pull) in pulls.iter().flatten() {
            if let Some(columns) = layout.columns(place.marker.body) {
                gradient[columns.x()] += pull.x;
                gradient[columns.y()] += pull.y;
                gradient[columns.theta()] += pull.dot(&perp(place.marker.rho(at)));
            }
        }
    }

    /// Bounds of how far ∂y/∂q (n) is off its value here, where the coordinates are off by `x` (n) at most: in the mean
    /// along the way.
    pub fn gradient_change(&self, at: &Kinematics, layout: &Layout, x: &[f64], change: &mut [f64]) {
        change.fill(0.0);
        let turned = |body: BodyId| layout.columns(body).map_or(0.0, |c| x[c.theta()]);
        let moved = |place: &Place| {
            layout.columns(place.marker.body).map_or(0.0, |c| {
                x[c.x()].hypot(x[c.y()]) + place.marker.s.norm() * x[c.theta()]
            })
        };
        match *self {
            Output::Angle(_) => {}
            Output::Coordinate(place, along) => {
                if let Some(columns) = layout.columns(place.marker.body) {
                    let (rho, turn) = (place.marker.rho(at), turned(place.marker.body));
                    change[columns.theta()] = 0.5 * along.dot(&rho).abs() * turn
                        + along.dot(&perp(rho)).abs() * turn * turn / 6.0;
                }
            }
            Output::Distance(from, to) => {
                let span = (to.marker.place(at) - from.marker.place(at)).norm();
                let lean = 2.0 * (moved(&from) + moved(&to)) / span;
                for place in [from, to] {
                    if let Some(columns) = layout.columns(place.marker.body) {
                        change[columns.x()] += lean;
                        change[columns.y()] += lean;
                        change[columns.theta()] +=
                            (lean + turned(place.marker.body)) * place.marker.s.norm();
                    }
                }
            }
        }
    }
}
