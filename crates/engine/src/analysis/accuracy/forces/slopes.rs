//! Derivatives of forces by what is off: central differences of the whole balance, extrapolated (Ridders 1982).
//!
//! A parameter may stand in points, masses, springs, loads and motions at once, and forces follow from q, v and a, which
//! follow from all of these. So the equations are made and solved anew with each source off to both sides:
//!
//! ```text
//! D(h) = (y(h) − y(−h))/2h = y′ + c₂h² + c₄h⁴ + …        h, h/2, h/4, …: the powers are taken out one by one
//! ```
//!
//! The difference of two columns of that table says how good the best of them is.

use super::loaded::{Carried, Loaded, Offs, Systems};
use super::{Posed, sizes};
use crate::analysis::accuracy::source::Play;

/// First step, as a part of what the source's number is measured by.
const FIRST_STEP: f64 = 0.02;
/// Most steps, each half of the one before.
const MOST_STEPS: usize = 18;
/// A derivative with this error, relative, is good enough.
const EXACT: f64 = 1e-12;
/// Round-off of a force, relative to it and to the part of the largest that it may be the difference of.
const NOISE: f64 = 1e-15;
const CANCELLED: f64 = 0.01;

/// A derivative and its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slope {
    pub by: f64,
    pub error: f64,
}

impl Slope {
    const NONE: Slope = Slope {
        by: f64::NAN,
        error: f64::INFINITY,
    };
}

/// Difference quotients of halved steps, their powers taken out.
struct Table {
    last: Vec<f64>,
    best: Slope,
}

impl Table {
    fn new() -> Self {
        Table {
            last: Vec::new(),
            best: Slope::NONE,
        }
    }

    /// Takes the next quotient, known to `noise`; whether no other could make it better.
    fn take(&mut self, quotient: f64, noise: f64) -> bool {
        let mut next = vec![quotient];
        let mut power = 1.0;
        for k in 0..self.last.len() {
            power *= 4.0;
            let improved = next[k] + (next[k] - self.last[k]) / (power - 1.0);
            let apart = (improved - next[k])
                .abs()
                .max((improved - self.last[k]).abs());
            if apart + noise <= self.best.error {
                self.best = Slope {
                    by: improved,
                    error: apart + noise,
                };
            }
            next.push(improved);
        }
        self.last = next;
        self.best.error <= EXACT * self.best.by.abs() + 2.0 * noise
    }
}

/// ∂y/∂(source) of all forces at a pose: by force and source, a zone has two.
pub(super) type Slopes = Vec<Vec<[Slope; 2]>>;

/// Slopes at all poses that have a balance.
pub(super) fn slopes(
    systems: &mut Systems,
    poses: &[Posed],
    nominal: &[Option<Carried>],
    scales: &[f64],
    at_rest: bool,
) -> Vec<Slopes> {
    let plays = systems.plays;
    let mut found: Vec<Slopes> = poses
        .iter()
        .map(|posed| vec![vec![[Slope::NONE; 2]; plays.len()]; posed.forces.len()])
        .collect();
    for (source, play) in plays.iter().enumerate() {
        let numbers = match play {
            Play::Zone { .. } => 2,
            Play::Pin { .. }
            | Play::Sides { .. }
            | Play::Guided { .. }
            | Play::Driver { .. }
            | Play::Parameter { .. } => 1,
        };
        for number in 0..numbers {
            let mut along = Along {
                systems: &mut *systems,
                poses,
                nominal,
                at_rest,
                step: FIRST_STEP * scales[source],
            };
            let tables = along.tables((source, number));
            for (found, tables) in found.iter_mut().zip(tables) {
                for (found, table) in found.iter_mut().zip(tables) {
                    found[source][number] = table.best;
                }
            }
        }
    }
    found
}

/// One number of a source on its way to smaller steps.
struct Along<'a, 'f> {
    systems: &'a mut Systems<'f>,
    poses: &'a [Posed],
    nominal: &'a [Option<Carried>],
    at_rest: bool,
    step: f64,
}

impl Along<'_, '_> {
    /// Tables by pose and force.
    fn tables(&mut self, place: (usize, usize)) -> Vec<Vec<Table>> {
        let tables = self.poses.iter();
        let tables = tables.map(|posed| posed.forces.iter().map(|_| Table::new()).collect());
        let mut tables: Vec<Vec<Table>> = tables.collect();
        let mut open: Vec<bool> = self.nominal.iter().map(Option::is_some).collect();
        for _ in 0..MOST_STEPS {
            if !open.contains(&true) {
                break;
            }
            let [low, high] = [-1.0, 1.0].map(|side| self.values(place, side * self.step, &open));
            for (index, tables) in tables.iter_mut().enumerate() {
                let (Some(low), Some(high), Some(nominal)) =
                    (&low[index], &high[index], &self.nominal[index])
                else {
                    continue;
                };
                let noise = |k: usize| {
                    let sizes = sizes(&self.systems.nominal, &self.poses[index].forces[k]);
                    let size = nominal.values[k]
                        .abs()
                        .max(CANCELLED * nominal.largest * sizes);
                    NOISE * size / self.step
                };
                let quotients = low
                    .iter()
                    .zip(high)
                    .map(|(low, high)| (high - low) / (2.0 * self.step));
                // All tables of a pose go on until each is good.
                let done = tables.iter_mut().zip(quotients).enumerate();
                let done = done.map(|(k, (table, quotient))| table.take(quotient, noise(k)));
                open[index] = done.fold(false, |open, done| open | !done);
            }
            self.step *= 0.5;
        }
        tables
    }

    /// Forces by pose with a source off; none where there is no balance, or no need of it.
    fn values(
        &mut self,
        (source, number): (usize, usize),
        off: f64,
        open: &[bool],
    ) -> Vec<Option<Vec<f64>>> {
        let plays = self.systems.plays;
        let mut offs: Offs = vec![[0.0; 2]; plays.len()];
        offs[source][number] = off;
        let nominal = self.systems.nominal.clone();
        let system = self.systems.with(&offs);
        let mut loaded = None;
        let cases = self.poses.iter().zip(self.nominal).zip(open);
        cases
            .map(|((posed, carried), open)| {
                let (carried, true) = (carried.as_ref()?, *open) else {
                    return None;
                };
                if loaded.is_none() {
                    let systems = [&*nominal, &**system.as_ref()?];
                    loaded = Loaded::new(systems, plays, posed, self.at_rest);
                }
                let found = loaded.as_mut()?.carry(posed, None, &offs, &carried.sides);
                found.ok().map(|found| found.values)
            })
            .collect()
    }
}
