//! What all deviations together do to the coordinates to first order, and what they do beyond it.

use super::super::displaced::{Mechanism, Stand};
use super::super::output::Output;
use super::super::source::Play;
use super::Inverse;
use super::changes::Radii;
use super::extents::Extents;
use linkdyn_linear::math::Vec2;

/// So small that what a dimension's step does counts to first order alone.
const SMALL: f64 = 1e-150;

impl Mechanism<'_> {
    /// Bounds of |C e| (n) over all deviations, to first order.
    pub(super) fn straight(&self, stand: &Stand, inverse: &Inverse) -> Vec<f64> {
        let system = self.driven.system;
        let here = self.here(stand);
        let mut bound = vec![0.0; system.n()];
        for (row, phi) in self.driven.evaluation.phi.iter().enumerate() {
            let phi = phi.abs() + 8.0 * f64::EPSILON * system.row_scale(row);
            add(&mut bound, inverse.column(row), |c| phi * c.abs());
        }
        let mut rows = vec![0.0; system.m()];
        let mut ways = [vec![0.0; system.n()], vec![0.0; system.n()]];
        for play in self.plays {
            match play {
                Play::Pin { row, clearance } => {
                    let pair = [inverse.column(*row), inverse.column(row + 1)];
                    add_pair(&mut bound, pair, |a, b| clearance[1] * size(a, b));
                }
                Play::Sides { row, half } => {
                    add(&mut bound, inverse.column(*row), |c| half[1] * c.abs());
                }
                Play::Driver { row, half } => {
                    add(&mut bound, inverse.column(*row), |c| half * c.abs());
                }
                Play::Guided { row, half, length } => {
                    let pair = [inverse.column(*row), inverse.column(row + 1)];
                    add_pair(&mut bound, pair, |a, b| {
                        half[1] * a.abs().max(2.0 * b.abs() / length)
                    });
                }
                Play::Zone { point, radius } => {
                    for (axis, way) in ways.iter_mut().enumerate() {
                        rows.fill(0.0);
                        let along = Vec2::new((1 - axis) as f64, axis as f64);
                        for grip in &self.dimensions.points[point.0].grips {
                            grip.push(&self.driven.evaluation.jacobian, along, &mut rows);
                        }
                        inverse.carry(&rows, 1.0, way);
                    }
                    let [a, b] = &ways;
                    add_pair(&mut bound, [a, b], |a, b| radius * size(a, b));
                }
                Play::Parameter {
                    lower,
                    upper,
                    steps,
                    ..
                } => {
                    rows.fill(0.0);
                    for &(k, by) in steps {
                        self.dimensions.push_one(here, k, by * SMALL, &mut rows);
                    }
                    let [way, _] = &mut ways;
                    inverse.carry(&rows, 1.0 / SMALL, way);
                    let half = lower.abs().max(upper.abs());
                    add(&mut bound, way, |q| half * q.abs());
                }
            }
        }
        bound
    }

    /// Adds to the rows (m) bounds of what gaps change as the mechanism moves by `x`, and of what is left out of the
    /// parameters' steps.
    pub(super) fn loose(&self, stand: &Stand, extents: &Extents, x: &[f64], rows: &mut [f64]) {
        let system = self.driven.system;
        let here = self.here(stand);
        for play in self.plays {
            if let Play::Zone { point, radius } = play {
                let total = system
                    .layout
                    .bodies()
                    .map(|c| x[c.theta()])
                    .fold(0.0, f64::max);
                for grip in &self.dimensions.points[point.0].grips {
                    grip.push_size(radius * 2.0 * total, rows);
                }
            }
        }
        self.dimensions.push_change(here, &extents.most, x, rows);
        // Slack itself is no first-order step of any play.
        if !extents.slack.is_empty() {
            let mut own = vec![0.0; system.m()];
            for &(k, step) in &extents.slack {
                own.fill(0.0);
                self.dimensions.push_one(here, k, step, &mut own);
                rows.iter_mut()
                    .zip(&own)
                    .for_each(|(row, own)| *row += own.abs());
            }
        }
    }

    /// What the output's own points add to its deviation beyond the first order.
    pub(super) fn own_points(
        &self,
        stand: &Stand,
        output: &Output,
        extents: &Extents,
        x: &[f64],
    ) -> f64 {
        let here = self.here(stand);
        let radii = Radii {
            system: self.driven.system,
            x,
        };
        let Extents { off, beyond, .. } = extents;
        let places: Vec<_> = output
            .pulls(&here.at, here.shifts)
            .into_iter()
            .flatten()
            .collect();
        let total: f64 = places
            .iter()
            .filter_map(|(place, _)| Some(off[place.point?.0] + beyond[place.point?.0]))
            .sum();
        let turn: f64 = places
            .iter()
            .map(|(place, _)| radii.turn(place.marker.body))
            .fold(0.0, f64::max);
        let span = match output {
            Output::Distance(from, to) => {
                (to.marker.place(&here.at) - from.marker.place(&here.at)).norm()
            }
            Output::Angle(_) | Output::Coordinate(..) => f64::INFINITY,
        };
        let moved: f64 = places
            .iter()
            .map(|(place, _)| {
                radii.shift(place.marker.body).norm()
                    + place.marker.s.norm() * radii.turn(place.marker.body)
            })
            .sum();
        let own_beyond: f64 = places
            .iter()
            .filter_map(|(place, _)| Some(beyond[place.point?.0]))
            .sum();
        own_beyond + total * turn + 2.0 * total * (moved + total) / span
    }
}

/// Rounded up by less than the widening of X.
fn size(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

fn add(bound: &mut [f64], column: &[f64], of: impl Fn(f64) -> f64) {
    bound.iter_mut().zip(column).for_each(|(b, c)| *b += of(*c));
}

fn add_pair(bound: &mut [f64], [a, b]: [&[f64]; 2], of: impl Fn(f64, f64) -> f64) {
    let pairs = a.iter().zip(b);
    bound
        .iter_mut()
        .zip(pairs)
        .for_each(|(bound, (a, b))| *bound += of(*a, *b));
}
