//! What all deviations together do to the coordinates to first order, and what they do beyond it.

use super::super::dimensions::{Dimension, PointId};
use super::super::displaced::{Mechanism, Stand};
use super::super::output::Output;
use super::super::source::Play;
use super::Inverse;
use super::changes::Radii;
use linkdyn_linear::math::Vec2;

impl Mechanism<'_> {
    /// Bounds of |C e| (n) over all deviations, to first order.
    pub(super) fn straight(&self, stand: &Stand, inverse: &Inverse) -> Vec<f64> {
        let system = self.driven.system;
        let n = system.n();
        let here = self.here(stand);
        let mut bound = vec![0.0; n];
        let mut add = |of: &dyn Fn(usize) -> f64| {
            bound.iter_mut().enumerate().for_each(|(k, b)| *b += of(k));
        };
        let carried = |rows: &[f64]| {
            let mut q = vec![0.0; n];
            for (row, &e) in rows.iter().enumerate().filter(|(_, e)| **e != 0.0) {
                for (q, c) in q.iter_mut().zip(inverse.column(row)) {
                    *q += c * e;
                }
            }
            q
        };
        for (row, phi) in self.driven.evaluation.phi.iter().enumerate() {
            let phi = phi.abs() + 8.0 * f64::EPSILON * system.row_scale(row);
            add(&|k| inverse.column(row)[k].abs() * phi);
        }
        for play in self.plays {
            match play {
                Play::Pin { row, clearance } => {
                    let (a, b) = (inverse.column(*row), inverse.column(row + 1));
                    add(&|k| clearance[1] * a[k].hypot(b[k]));
                }
                Play::Sides { row, half } => add(&|k| half[1] * inverse.column(*row)[k].abs()),
                Play::Driver { row, half } => add(&|k| half * inverse.column(*row)[k].abs()),
                Play::Guided { row, half, length } => {
                    let (a, b) = (inverse.column(*row), inverse.column(row + 1));
                    add(&|k| half[1] * a[k].abs().max(2.0 * b[k].abs() / length));
                }
                Play::Zone { point, radius } => {
                    let of = |along: Vec2| {
                        let mut rows = vec![0.0; system.m()];
                        for grip in &self.dimensions.points[point.0].grips {
                            grip.push(&self.driven.evaluation.jacobian, along, &mut rows);
                        }
                        carried(&rows)
                    };
                    let (a, b) = (of(Vec2::new(1.0, 0.0)), of(Vec2::new(0.0, 1.0)));
                    add(&|k| radius * a[k].hypot(b[k]));
                }
                Play::Parameter {
                    lower,
                    upper,
                    steps,
                    ..
                } => {
                    let mut all = vec![0.0; self.dimensions.all.len()];
                    // small, so that a direction counts to first order alone
                    const SMALL: f64 = 1e-150;
                    for &(k, by) in steps {
                        all[k] += by * SMALL;
                    }
                    let mut rows = vec![0.0; system.m()];
                    self.dimensions.push(here, &all, &mut rows);
                    rows.iter_mut().for_each(|row| *row /= SMALL);
                    let q = carried(&rows);
                    let half = lower.abs().max(upper.abs());
                    add(&|k| half * q[k].abs());
                }
            }
        }
        bound
    }

    /// Bounds (m) of what gaps change as the mechanism moves by `x`, and of what is left out of the parameters' steps.
    pub(super) fn loose(&self, stand: &Stand, slack: &[f64], x: &[f64]) -> Vec<f64> {
        let system = self.driven.system;
        let here = self.here(stand);
        let mut rows = vec![0.0; system.m()];
        let mut most = slack.to_vec();
        let mut turned = vec![0.0; self.dimensions.all.len()];
        for play in self.plays {
            match play {
                Play::Parameter {
                    lower,
                    upper,
                    steps,
                    ..
                } => {
                    for &(k, by) in steps {
                        most[k] += by.abs() * lower.abs().max(upper.abs());
                    }
                }
                Play::Zone { point, radius } => {
                    let total = system
                        .layout
                        .bodies()
                        .map(|c| x[c.theta()])
                        .fold(0.0, f64::max);
                    for grip in &self.dimensions.points[point.0].grips {
                        grip.push_size(radius * 2.0 * total, &mut rows);
                    }
                }
                Play::Pin { .. }
                | Play::Sides { .. }
                | Play::Guided { .. }
                | Play::Driver { .. } => {}
            }
        }
        turned.copy_from_slice(&most);
        self.dimensions.push_change(here, &turned, x, &mut rows);
        // Slack itself is no first-order step of any play.
        if slack.iter().any(|s| *s > 0.0) {
            let mut own = vec![0.0; system.m()];
            for (k, step) in slack.iter().enumerate().filter(|(_, s)| **s > 0.0) {
                let mut one = vec![0.0; slack.len()];
                one[k] = *step;
                own.fill(0.0);
                self.dimensions.push(here, &one, &mut own);
                rows.iter_mut()
                    .zip(&own)
                    .for_each(|(row, own)| *row += own.abs());
            }
        }
        rows
    }

    /// What the output's own points add to its deviation beyond the first order.
    pub(super) fn own_points(
        &self,
        stand: &Stand,
        output: &Output,
        slack: &[f64],
        x: &[f64],
    ) -> f64 {
        let here = self.here(stand);
        let radii = Radii {
            system: self.driven.system,
            x,
        };
        let mut off = vec![0.0; self.dimensions.points.len()];
        let mut beyond = vec![0.0; self.dimensions.points.len()];
        for (k, dimension) in self.dimensions.all.iter().enumerate() {
            if let Dimension::Point(PointId(point), _) = dimension {
                beyond[*point] += slack[k];
                for play in self.plays {
                    if let Play::Parameter {
                        lower,
                        upper,
                        steps,
                        ..
                    } = play
                    {
                        let by: f64 = steps
                            .iter()
                            .filter(|(index, _)| *index == k)
                            .map(|(_, by)| by.abs())
                            .sum();
                        off[*point] += by * lower.abs().max(upper.abs());
                    }
                }
            }
        }
        for play in self.plays {
            if let Play::Zone { point, radius } = play {
                off[point.0] += radius;
            }
        }
        let places: Vec<_> = output.pulls(&here.at).into_iter().flatten().collect();
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
