//! Bounds of outputs within a region.

use super::super::displaced::{Mechanism, Stand};
use super::super::output::{Load, Output};
use super::{Enclosure, Extents, Region};
use crate::element::{Kinematics, Layout};
use linkdyn_linear::math::Vec2;

impl Mechanism<'_> {
    /// The bound of the output's deviations to both sides, least and greatest, within a region of the pose; none where it is
    /// not finite. The pose was taken.
    pub fn bound(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: &Load,
        reach: [f64; 2],
        region: &Region,
    ) -> Option<[f64; 2]> {
        if !self.is_bounded {
            return None;
        }
        let system = self.driven.system;
        let Enclosure {
            columns,
            extents,
            gradient,
            change,
            near,
            ..
        } = &mut self.enclosure;
        let x = match output {
            Output::Angle(_) | Output::Coordinate(..) => &region.x,
            Output::Distance(from, to) => {
                near.copy_from_slice(&region.x);
                for &(column, x) in &region.ends {
                    let (body, _) = system.layout.coordinate(column);
                    if [from, to].iter().any(|end| end.marker.body == body) {
                        near[column] = x;
                    }
                }
                near
            }
        };
        let at = self.driven.evaluation.kinematics(&stand.inputs);
        let own = output.pulls(&at, &self.shifts);
        output.gradient(&at, &own, &system.layout, gradient);
        output.gradient_change(&at, &system.layout, x, change);
        // (|∂y₀ − λᵀJ₀| + |∂ȳ − ∂y₀|) X
        let mut lean = 0.0;
        let slopes = gradient.iter().zip(&*change);
        for ((column, (slope, change)), x) in columns.each().zip(slopes).zip(x) {
            let mut carried = 0.0;
            for (row, value) in column {
                carried += load.lambda[row] * value;
            }
            let rounding = 8.0 * f64::EPSILON * (slope.abs() + carried.abs());
            lean += ((slope - carried).abs() + rounding + change) * x;
        }
        // |λ|(|φ₀| + |J̄ − J₀| X)
        for (lambda, row) in load.lambda.iter().zip(&region.rows) {
            lean += lambda.abs() * row;
        }
        lean += own_points((&at, &system.layout), output, extents, x);
        let (low, high) = (reach[0] - lean, reach[1] + lean);
        let sums = (system.n() + self.plays.len()) as f64;
        let widened = 1.0 + 1e-13 + 4.0 * f64::EPSILON * sums;
        (low.is_finite() && high.is_finite()).then_some([low * widened, high * widened])
    }
}

/// What the output's own points add to its deviation beyond the first order.
fn own_points(
    (at, layout): (&Kinematics, &Layout),
    output: &Output,
    extents: &Extents,
    x: &[f64],
) -> f64 {
    let (places, span) = match output {
        Output::Angle(_) => return 0.0,
        Output::Coordinate(place, _) => ([Some(place), None], f64::INFINITY),
        Output::Distance(from, to) => {
            let span = to.marker.place(at) - from.marker.place(at);
            ([Some(from), Some(to)], span.norm())
        }
    };
    let (mut own_beyond, mut total, mut turn, mut moved) = (0.0, 0.0, 0.0_f64, 0.0);
    for place in places.into_iter().flatten() {
        if let Some(point) = place.point {
            total += extents.off[point.0] + extents.beyond[point.0];
            own_beyond += extents.beyond[point.0];
        }
        if let Some(columns) = layout.columns(place.marker.body) {
            let angle = x[columns.theta()];
            turn = turn.max(angle);
            moved += Vec2::new(x[columns.x()], x[columns.y()]).norm();
            moved += place.marker.s.norm() * angle;
        }
    }
    own_beyond + total * turn + 2.0 * total * (moved + total) / span
}
