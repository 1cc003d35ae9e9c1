//! Linkages that come near to what is wanted, by least squares over all dimensions and, where they are free, the crank's angles.
//!
//! At each wanted position the linkage is closed, from the one before, so that it gets there without being taken apart or turned back:
//! where it can't, there are no residuals, and the search takes a shorter step. Derivatives are those of the closed linkage (implicit
//! function theorem).

use crate::keep::{Kept, Residual};
use crate::linkage::{Linkage, Places};
use linkdyn_linear::bilinear::Number;
use linkdyn_optimise::least_squares::{Fitted, Settings, least_squares};
use linkdyn_optimise::outcome::{Bounds, Evaluate, Outcome};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// What is wanted at one position.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Wanted {
    /// How far the crank has turned since the first position \[rad\].
    pub crank: Option<f64>,
    /// Where the output's point is.
    pub point: Option<Number>,
    /// How far the output has turned since the first position \[rad\].
    pub angle: Option<f64>,
}

/// A linkage, and its crank's angles.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The linkage.
    pub linkage: Linkage,
    /// How far the crank has turned at each wanted position \[rad\], 0 at the first.
    pub turns: Vec<f64>,
}

/// Limits of dimensions.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Of each dimension the least and the greatest, equal where it stands.
    pub dimensions: Vec<[f64; 2]>,
    /// Directions from the ground pin of a body to its other pin \[rad\].
    pub directions: Vec<(usize, f64)>,
    /// The length that counts as much as a radian.
    pub length: f64,
    /// What a search keeps.
    pub kept: Option<Kept>,
}

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The linkage.
    pub candidate: Candidate,
    /// Root mean square of what is left, in parts of the length that counts as a radian.
    pub rms: f64,
}

/// A search gives up where so many steps leave more than this (root mean square).
const TRIAL: usize = 40;
const HOPEFUL: f64 = 0.1;

struct Search<'s> {
    from: &'s Linkage,
    wanted: &'s [Wanted],
    limits: &'s Limits,
    /// Dimensions that vary.
    free: Vec<usize>,
    /// Dimensions of all.
    dimensions: Vec<f64>,
    /// Positions whose crank angle varies.
    open: Vec<usize>,
    stop: &'s dyn Fn() -> bool,
    /// Where the residuals were asked for last, and the places there: derivatives are asked for at the same values.
    last: Option<(Vec<f64>, Vec<Places>)>,
}

impl Search<'_> {
    fn linkage(&self, x: &[f64]) -> Linkage {
        let mut all = self.dimensions.clone();
        for (k, value) in self.free.iter().zip(x) {
            all[*k] = value * self.limits.length;
        }
        // Angles are no lengths.
        for (k, is_angle) in angles(self.from).into_iter().enumerate() {
            if is_angle && let Some(at) = self.free.iter().position(|free| *free == k) {
                all[k] = x[at];
            }
        }
        self.from.with(&all)
    }

    fn turns(&self, x: &[f64]) -> Vec<f64> {
        let mut turns: Vec<f64> = self
            .wanted
            .iter()
            .map(|wanted| wanted.crank.unwrap_or(0.0))
            .collect();
        for (place, value) in self.open.iter().zip(&x[self.free.len()..]) {
            turns[*place] = *value;
        }
        turns
    }

    /// The places at all positions.
    fn led(&self, linkage: &Linkage, turns: &[f64]) -> Option<Vec<Places>> {
        let mut all = Vec::new();
        let (mut at, mut places) = (0.0, linkage.first());
        for turn in turns {
            places = linkage.led(places, at, *turn)?;
            at = *turn;
            all.push(places.clone());
        }
        Some(all)
    }

    fn residuals(&self, linkage: &Linkage, all: &[Places]) -> Vec<f64> {
        let mut rows = Vec::new();
        for (wanted, places) in self.wanted.iter().zip(all) {
            if let Some(point) = wanted.point {
                let off = linkage.position(places, linkage.output).of(linkage.point) - point;
                rows.extend([off.re / self.limits.length, off.im / self.limits.length]);
            }
            if let Some(angle) = wanted.angle {
                // Whole turns are the same position.
                let off = linkage.angle(places, linkage.output) - angle;
                rows.push(off - TAU * (off / TAU).round());
            }
        }
        let drawn = self.drawn(linkage).into_iter();
        rows.extend(drawn.map(|own| own.value / self.limits.length));
        for places in all {
            rows.extend(
                self.transmission(linkage, places)
                    .iter()
                    .map(|own| own.value),
            );
        }
        rows
    }

    /// What is to be kept of a drawing, as lengths.
    fn drawn(&self, linkage: &Linkage) -> Vec<Residual> {
        let directions = self.limits.directions.iter();
        let lengths = self.limits.kept.map(|kept| kept.lengths);
        let lengths = lengths.map(|own| Residual::of_lengths(linkage, own));
        directions
            .map(|(body, direction)| Residual::of_direction(linkage, *body, *direction))
            .chain(lengths.into_iter().flatten())
            .collect()
    }

    /// What is to be kept at a place.
    fn transmission(&self, linkage: &Linkage, places: &Places) -> Vec<Residual> {
        let least = self.limits.kept.and_then(|kept| kept.transmission);
        least.map_or(Vec::new(), |least| {
            Residual::of_transmission(linkage, places, least)
        })
    }

    /// How many residuals are those of what is wanted.
    fn wanted_rows(&self) -> usize {
        let of =
            |own: &Wanted| 2 * usize::from(own.point.is_some()) + usize::from(own.angle.is_some());
        self.wanted.iter().map(of).sum::<usize>() + self.limits.directions.len()
    }
}

/// Whether each dimension is an angle.
fn angles(linkage: &Linkage) -> Vec<bool> {
    let of = |joint: &crate::linkage::Joint| match joint.pin() {
        Some(_) => vec![false; 2],
        None => vec![true],
    };
    let joints = linkage.joints.iter().flat_map(of);
    joints.chain([false; 2]).collect()
}

impl Evaluate for Search<'_> {
    fn values(&mut self, x: &[f64]) -> Outcome {
        if (self.stop)() {
            return Outcome::Stopped;
        }
        let linkage = self.linkage(x);
        let Some(all) = self.led(&linkage, &self.turns(x)) else {
            return Outcome::Missing;
        };
        let residuals = self.residuals(&linkage, &all);
        self.last = Some((x.to_vec(), all));
        Outcome::of(residuals)
    }

    fn slopes(&mut self, x: &[f64]) -> Option<Vec<f64>> {
        let linkage = self.linkage(x);
        let turns = self.turns(x);
        let all = match self.last.take() {
            Some((last, all)) if last == x => all,
            _ => self.led(&linkage, &turns)?,
        };
        let count = x.len();
        let is_angle = angles(&linkage);
        let length = self.limits.length;
        let slopes = all.iter().zip(&turns);
        let slopes: Option<Vec<DMatrix<f64>>> = slopes
            .map(|(places, turn)| linkage.slopes(places, *turn))
            .collect();
        let slopes = slopes?;
        let mut rows = Vec::new();
        for (j, (wanted, places)) in self.wanted.iter().zip(&all).enumerate() {
            let by = &slopes[j];
            let own = linkage.position(places, linkage.output);
            let k = 3 * linkage.output - 3;
            // The output's point and angle by a dimension, the last two of which move the point itself, and behind them the crank's angle.
            let dimension = |column: usize| -> (Number, f64) {
                let angle = by[(k + 2, column)];
                let shift = Number::new(by[(k, column)], by[(k + 1, column)]);
                let arm = Number::i() * own.turn * linkage.point * angle;
                let place = shift + arm;
                let place = match column.checked_sub(is_angle.len() - 2) {
                    Some(0) => place + own.turn,
                    Some(1) => place + own.turn * Number::i(),
                    _ => place,
                };
                (place, angle)
            };
            let mut row = vec![(Number::new(0.0, 0.0), 0.0); count];
            for (own, column) in row.iter_mut().zip(&self.free) {
                let (place, angle) = dimension(*column);
                let scale = if is_angle[*column] { 1.0 } else { length };
                *own = (place * scale, angle * scale);
            }
            if let Some(at) = self.open.iter().position(|place| *place == j) {
                row[self.free.len() + at] = dimension(is_angle.len());
            }
            if wanted.point.is_some() {
                rows.extend(row.iter().map(|(place, _)| place.re / length));
                rows.extend(row.iter().map(|(place, _)| place.im / length));
            }
            if wanted.angle.is_some() {
                rows.extend(row.iter().map(|(_, angle)| *angle));
            }
        }
        // Numbers of the first dimensions of joints.
        let firsts: Vec<usize> = linkage
            .joints
            .iter()
            .scan(0, |next, joint| {
                let own = *next;
                *next += if joint.pin().is_some() { 2 } else { 1 };
                Some(own)
            })
            .collect();
        // By a dimension, or by a crank's angle, of which all but that of its own position change nothing.
        let row = |own: &Residual, by: Option<(&DMatrix<f64>, usize)>| -> Vec<f64> {
            let angle = |column: usize| {
                let turned = by.iter().flat_map(|(by, _)| {
                    let bodies = own.by_bodies.iter();
                    bodies.map(|(body, weight)| weight * by[(3 * body - 1, column)])
                });
                turned.sum::<f64>()
            };
            let pin = |column: usize| {
                let of = |(joint, by): &(usize, Number)| match column.checked_sub(firsts[*joint]) {
                    Some(0) => by.re,
                    Some(1) => by.im,
                    _ => 0.0,
                };
                own.by_pins.iter().map(of).sum::<f64>()
            };
            let free = self.free.iter().map(|column| {
                let scale = if is_angle[*column] { 1.0 } else { length };
                (pin(*column) + angle(*column)) * scale
            });
            let open = self.open.iter().map(|place| match by {
                Some((_, at)) if at == *place => angle(is_angle.len()),
                _ => 0.0,
            });
            free.chain(open).collect()
        };
        for own in self.drawn(&linkage) {
            rows.extend(row(&own, None).iter().map(|slope| slope / length));
        }
        for (j, (places, by)) in all.iter().zip(&slopes).enumerate() {
            for own in self.transmission(&linkage, places) {
                rows.extend(row(&own, Some((by, j))));
            }
        }
        Some(rows)
    }
}

/// A search, its bounds and its start.
fn prepared<'s>(
    from: &'s Candidate,
    wanted: &'s [Wanted],
    limits: &'s Limits,
    stop: &'s dyn Fn() -> bool,
) -> (Search<'s>, Bounds, Vec<f64>) {
    let linkage = &from.linkage;
    let dimensions = linkage.dimensions();
    let varies = |k: &usize| limits.dimensions[*k][1] > limits.dimensions[*k][0];
    let free: Vec<usize> = (0..dimensions.len()).filter(varies).collect();
    let open: Vec<usize> = (1..wanted.len())
        .filter(|j| wanted[*j].crank.is_none())
        .collect();
    let is_angle = angles(linkage);
    let scaled = |k: usize, value: f64| match is_angle[k] {
        true => value,
        false => value / limits.length,
    };
    let ranges = free
        .iter()
        .map(|k| limits.dimensions[*k].map(|end| scaled(*k, end)));
    let ranges: Vec<[f64; 2]> = ranges
        .chain(open.iter().map(|_| [-2.0 * TAU, 2.0 * TAU]))
        .collect();
    let start = free.iter().map(|k| scaled(*k, dimensions[*k]));
    let start = start.chain(open.iter().map(|j| from.turns[*j])).collect();
    let search = Search {
        from: linkage,
        wanted,
        limits,
        free,
        dimensions,
        open,
        stop,
        last: None,
    };
    (search, Bounds::new(&ranges), start)
}

/// Root mean square of what is left at a candidate, and of what it does not keep; `None` where it does not pass all positions in one motion.
pub fn distance(of: &Candidate, wanted: &[Wanted], limits: &Limits) -> Option<f64> {
    let (mut search, bounds, mut start) = prepared(of, wanted, limits, &|| false);
    bounds.clamp(&mut start);
    search.values(&start).values().map(|own| rms(&own))
}

fn rms(residuals: &[f64]) -> f64 {
    let square: f64 = residuals.iter().map(|r| r * r).sum();
    (square / residuals.len().max(1) as f64).sqrt()
}

/// Searches from a linkage and its crank's angles.
pub fn fit(
    from: &Candidate,
    wanted: &[Wanted],
    limits: &Limits,
    stop: &dyn Fn() -> bool,
) -> Option<Found> {
    let (mut search, bounds, start) = prepared(from, wanted, limits, stop);
    let rows = search.wanted_rows();
    let settings = Settings {
        trial: TRIAL,
        hopeful: HOPEFUL * (rows as f64).sqrt(),
        ..Settings::default()
    };
    let Fitted { x, residuals, .. } = least_squares(&mut search, &bounds, &start, &settings);
    (!residuals.is_empty()).then(|| Found {
        rms: rms(&residuals[..rows]),
        candidate: Candidate {
            linkage: search.linkage(&x),
            turns: search.turns(&x),
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::{Joint, Kind};

    #[test]
    fn slopes_are_those_of_differences() {
        let pins = [[0.2, -0.1], [1.1, 0.2], [1.8, 2.9], [3.2, 0.4]];
        let bodies = [[0, 1], [1, 2], [2, 3], [3, 0]];
        let joints = pins.iter().zip(bodies).map(|([x, y], bodies)| Joint {
            bodies,
            kind: Kind::Pin(Number::new(*x, *y)),
        });
        let linkage = Linkage {
            bodies: 4,
            joints: joints.collect(),
            crank: 1,
            output: 2,
            point: Number::new(1.0, 1.6),
        };
        let wanted = [0.9, 1.2, 0.4].map(|x| Wanted {
            point: Some(Number::new(x, 1.5)),
            angle: Some(0.2 * x),
            ..Wanted::default()
        });
        let limits = Limits {
            dimensions: linkage
                .dimensions()
                .iter()
                .map(|d| [d - 1.0, d + 1.0])
                .collect(),
            directions: vec![(1, 0.4)],
            length: 2.5,
            kept: Some(Kept {
                lengths: [1.1, 2.0],
                transmission: Some(1.5),
            }),
        };
        let from = Candidate {
            linkage,
            turns: vec![0.0, 0.4, 0.9],
        };
        let (mut search, _, start) = prepared(&from, &wanted, &limits, &|| false);
        let slopes = search.slopes(&start).expect("closed");
        let step = 1e-6;
        let mut at = |k: usize, by: f64| {
            let mut x = start.clone();
            x[k] += by;
            search.values(&x).values().expect("closed")
        };
        for k in 0..start.len() {
            let (there, back) = (at(k, step), at(k, -step));
            for (row, (a, b)) in there.iter().zip(&back).enumerate() {
                let (own, by) = (slopes[row * start.len() + k], (a - b) / (2.0 * step));
                assert!(
                    (own - by).abs() < 1e-6 * (1.0 + by.abs()),
                    "row {row} by {k}: {own} for {by}"
                );
            }
        }
    }
}
