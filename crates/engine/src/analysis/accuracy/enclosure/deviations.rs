//! What all deviations together do to the coordinates, to first order.

use super::super::dimensions::{Dimension, Dimensions, Here};

use super::super::grip::{Grip, driver_block};
use super::super::source::Play;
use super::inverse::{Four, Inverse};
use crate::system::System;
use std::ops::Range;

/// So small that what a dimension's step does counts to first order alone.
const SMALL: f64 = 1e-150;

/// What a deviation does in a row: a factor times a rate, times cosine or sine of a body's angle.
#[derive(Clone, Copy)]
struct Part {
    row: u32,
    /// Its number among the entries of J, or behind them.
    rate: u32,
    /// Its number among the turns.
    turn: u32,
    factor: f64,
}

/// What it does at a pose.
#[derive(Clone, Copy, Default)]
struct Step {
    row: u32,
    by: f64,
}

/// Deviations by what they do in the rows.
#[derive(Default)]
pub(super) struct Deviations {
    /// Sums of those that go to either side in one row alone (m).
    sides: Vec<f64>,
    /// Pins by their first row, with their clearance.
    pins: Vec<(u32, f64)>,
    /// Guided sliders by their first row, with their play as a gap and as a turn.
    guided: Vec<(u32, [f64; 2])>,
    /// Parts of parameters that stand in two rows at most; then of the others; then of zones along x and y.
    parts: Vec<Part>,
    /// How many parts are of pairs; where those of each of the others end, and of each zone along x and y.
    pairs: usize,
    longer: Vec<usize>,
    zones: Vec<[usize; 2]>,
    /// The parts at the pose.
    steps: Vec<Step>,
    /// Dimensions other than points, with the row of a rate: they follow the entries of J.
    others: Vec<(usize, u32)>,
    /// Entries of J, and rates of the others.
    rates: Vec<f64>,
    /// cos θ and sin θ of each body; of ground 1 and 0.
    turns: Vec<f64>,
    /// Room (m).
    rows: Vec<f64>,
}

impl Deviations {
    /// Of a mechanism.
    pub fn new(system: &System, plays: &[Play], dimensions: &Dimensions) -> Deviations {
        let mut all = Deviations {
            sides: vec![0.0; system.m()],
            rows: vec![0.0; system.m()],
            rates: vec![0.0; system.entries.len()],
            turns: vec![0.0; 2 * (system.bodies.len() + 1)],
            ..Deviations::default()
        };
        let (mut pairs, mut longer, mut zones) = (Vec::new(), Vec::new(), Vec::new());
        for play in plays {
            match play {
                Play::Pin { row, clearance } => all.pins.push((*row as u32, clearance[1])),
                Play::Sides { row, half } => all.sides[*row] += half[1],
                Play::Driver { row, half } => all.sides[*row] += half,
                Play::Guided { row, half, length } => {
                    let half = half[1];
                    all.guided.push((*row as u32, [half, 2.0 * half / length]));
                }
                Play::Zone { point, radius } => {
                    // Along x and y of the ground.
                    zones.push([0, 1].map(|axis| {
                        let entries = Grip::all(&dimensions.points[point.0].grips, axis);
                        let part = |(row, rate, sign)| Part {
                            row: row as u32,
                            rate: rate as u32,
                            turn: 0,
                            factor: sign * radius,
                        };
                        entries.map(part).collect::<Vec<_>>()
                    }));
                }
                Play::Parameter {
                    lower,
                    upper,
                    steps,
                    ..
                } => {
                    let half = lower.abs().max(upper.abs());
                    let mut parts = Vec::new();
                    for &(k, by) in steps {
                        all.add_parts(system, dimensions, (k, half * by), &mut parts);
                    }
                    match parts[..] {
                        [] => {}
                        [a] => pairs.extend([a, Part { factor: 0.0, ..a }]),
                        [a, b] => pairs.extend([a, b]),
                        _ => longer.push(parts),
                    }
                }
            }
        }
        all.rates
            .resize(system.entries.len() + all.others.len(), 0.0);
        all.pairs = pairs.len();
        all.parts = pairs;
        for own in longer {
            all.parts.extend(own);
            all.longer.push(all.parts.len());
        }
        for [x, y] in zones {
            all.parts.extend(x);
            let end = all.parts.len();
            all.parts.extend(y);
            all.zones.push([end, all.parts.len()]);
        }
        all.steps = vec![Step::default(); all.parts.len()];
        all
    }

    /// Adds the parts of a step of a dimension.
    fn add_parts(
        &mut self,
        system: &System,
        dimensions: &Dimensions,
        (k, by): (usize, f64),
        parts: &mut Vec<Part>,
    ) {
        if let Dimension::Point(id, axis) = &dimensions.all[k] {
            let point = &dimensions.points[id.0];
            // Along x of the body (cos θ, sin θ), along y (−sin θ, cos θ).
            for global in 0..2 {
                let is_sine = global != *axis;
                let sign = if global < *axis { -by } else { by };
                let entries = Grip::all(&point.grips, global);
                parts.extend(entries.map(|(row, rate, own)| Part {
                    row: row as u32,
                    rate: rate as u32,
                    turn: 2 * point.body.0 as u32 + u32::from(is_sine),
                    factor: sign * own,
                }));
            }
            return;
        }
        for row in rows_of(system, &dimensions.all[k]).into_iter().flatten() {
            let other = (k, row as u32);
            let place = self.others.iter().position(|own| *own == other);
            let place = place.unwrap_or_else(|| {
                self.others.push(other);
                self.others.len() - 1
            });
            parts.push(Part {
                row: row as u32,
                rate: (system.entries.len() + place) as u32,
                turn: 0,
                factor: by,
            });
        }
    }

    /// Takes the steps of a pose.
    pub fn take(&mut self, here: &Here<'_>, dimensions: &Dimensions) {
        let jacobian = &here.evaluation.jacobian;
        let (entries, others) = self.rates.split_at_mut(jacobian.len());
        entries.copy_from_slice(jacobian);
        for (rate, &(k, row)) in others.iter_mut().zip(&self.others) {
            self.rows.fill(0.0);
            dimensions.push_one(here, k, SMALL, &mut self.rows);
            *rate = self.rows[row as usize] / SMALL;
        }
        for (turn, pose) in self.turns.as_chunks_mut().0.iter_mut().zip(here.at.poses) {
            *turn = [pose.cos, pose.sin];
        }
        for (step, part) in self.steps.iter_mut().zip(&self.parts) {
            let rate = self.rates[part.rate as usize] * self.turns[part.turn as usize];
            *step = Step {
                row: part.row,
                by: part.factor * rate,
            };
        }
    }

    /// Bounds of |C e| over all deviations, with `off` (m) to either side in each row besides.
    pub fn straight(&self, inverse: &Inverse, off: &[f64], straight: &mut [Four]) {
        let pairs = self.steps[..self.pairs].as_chunks::<2>().0;
        for (own, sum) in inverse.fours().zip(straight) {
            let at = |row: u32| &own[row as usize];
            let both = |row: u32| (at(row), at(row + 1));
            *sum = [0.0; 4];
            for ((c, off), half) in own.iter().zip(off).zip(&self.sides) {
                let by = off + half;
                add(sum, |k| by * c[k].abs());
            }
            for &(row, clearance) in &self.pins {
                let (a, b) = both(row);
                add(sum, |k| clearance * size(a[k], b[k]));
            }
            for &(row, [half, turn]) in &self.guided {
                let (a, b) = both(row);
                add(sum, |k| (half * a[k].abs()).max(turn * b[k].abs()));
            }
            for [first, second] in pairs {
                let (a, b) = (at(first.row), at(second.row));
                add(sum, |k| (first.by * a[k] + second.by * b[k]).abs());
            }
            let carried = |span: Range<usize>| {
                let mut carried = [0.0; 4];
                for step in &self.steps[span] {
                    let c = at(step.row);
                    add(&mut carried, |k| step.by * c[k]);
                }
                carried
            };
            let mut begin = self.pairs;
            for &end in &self.longer {
                let way = carried(begin..end);
                add(sum, |k| way[k].abs());
                begin = end;
            }
            for &[middle, end] in &self.zones {
                let (a, b) = (carried(begin..middle), carried(middle..end));
                add(sum, |k| size(a[k], b[k]));
                begin = end;
            }
        }
    }
}

/// The rows in which a dimension other than a point stands.
fn rows_of(system: &System, dimension: &Dimension) -> [Option<usize>; 2] {
    match dimension {
        Dimension::Point(..) => [None, None],
        Dimension::Direction { joint, driver } => {
            let driven = driver.map(|id| driver_block(system, id).row());
            [Some(system.blocks[*joint].row()), driven]
        }
        Dimension::Angle { row } | Dimension::Mesh { row } => [Some(*row), None],
        Dimension::Ratio { joint, .. } => [Some(system.blocks[*joint].row()), None],
        Dimension::Motion { driver, .. } => [Some(driver_block(system, *driver).row()), None],
    }
}

/// Rounded up by less than the widening of X.
fn size(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

fn add(sum: &mut Four, of: impl Fn(usize) -> f64) {
    for (k, sum) in sum.iter_mut().enumerate() {
        *sum += of(k);
    }
}
