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

use super::loaded::{Carried, Loaded, Systems, Without, carried_over};
use super::question::{Posed, numbers};

/// First step, as a part of what the source's number is measured by: where the series holds for most.
const FIRST_STEP: f64 = 0.02;
/// Most steps, each half of the one before: the last ones are left to places near singular positions.
const MOST_HALVINGS: usize = 18;
/// A derivative with this error, relative, is good enough.
const EXACT: f64 = 1e-12;
/// Round-off of a force, relative to it, and to a hundredth of the largest, of which it may be the difference.
const NOISE: f64 = 1e-15;

/// A derivative and its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slope {
    pub by: f64,
    pub error: f64,
}

/// Difference quotients of halved steps, their powers taken out.
struct Table {
    last: Vec<f64>,
    best: Slope,
}

impl Table {
    fn new() -> Self {
        let best = Slope {
            by: f64::NAN,
            error: f64::INFINITY,
        };
        Table {
            last: Vec::new(),
            best,
        }
    }

    /// Takes the next quotient, known to `noise`; whether no other could make it better.
    fn take(&mut self, quotient: f64, noise: f64) -> bool {
        let mut next = vec![quotient];
        let mut power = 1.0;
        for k in 0..self.last.len() {
            power *= 4.0;
            let by = next[k] + (next[k] - self.last[k]) / (power - 1.0);
            let apart = (by - next[k]).abs().max((by - self.last[k]).abs());
            let error = apart + noise;
            if error <= self.best.error {
                self.best = Slope { by, error };
            }
            next.push(by);
        }
        self.last = next;
        self.best.error <= EXACT * self.best.by.abs() + 2.0 * noise
    }
}

/// ∂y/∂(source) of all forces at all poses: by pose, force and source; of most sources the second number is none.
pub(super) fn slopes(
    systems: &mut Systems,
    poses: &[Posed],
    nominal: &[Result<Carried, Without>],
) -> Vec<Vec<Vec<[Slope; 2]>>> {
    let none = Slope {
        by: 0.0,
        error: 0.0,
    };
    let blank = |posed: &Posed| vec![vec![[none; 2]; systems.sources.len()]; posed.forces.len()];
    let mut found: Vec<_> = poses.iter().map(blank).collect();
    for (number, source) in systems.sources.iter().enumerate() {
        for axis in 0..numbers(source) {
            let tables = along(systems, poses, nominal, (number, axis));
            for (found, tables) in found.iter_mut().zip(tables) {
                for (found, table) in found.iter_mut().zip(tables) {
                    found[number][axis] = table.best;
                }
            }
        }
    }
    found
}

/// Tables of one number of a source, by pose and force.
fn along(
    systems: &mut Systems,
    poses: &[Posed],
    nominal: &[Result<Carried, Without>],
    number: (usize, usize),
) -> Vec<Vec<Table>> {
    let tables = poses
        .iter()
        .map(|posed| posed.forces.iter().map(|_| Table::new()).collect());
    let mut tables: Vec<Vec<Table>> = tables.collect();
    let mut open: Vec<Option<&Carried>> = nominal.iter().map(|own| own.as_ref().ok()).collect();
    let mut step = FIRST_STEP * systems.question.scales[number.0];
    for _ in 0..MOST_HALVINGS {
        if open.iter().all(Option::is_none) {
            break;
        }
        let [low, high] = [-step, step].map(|off| values(systems, poses, &open, (number, off)));
        for (index, tables) in tables.iter_mut().enumerate() {
            let (Some(low), Some(high), Some(nominal)) = (&low[index], &high[index], open[index])
            else {
                continue;
            };
            // All tables of a pose go on until each is good.
            let mut is_done = true;
            for (k, table) in tables.iter_mut().enumerate() {
                let arm = match poses[index].forces[k].1.unit {
                    "N" => 1.0,
                    _ => systems.nominal.size,
                };
                let size = nominal.values[k].abs().max(0.01 * nominal.largest * arm);
                let quotient = (high[k] - low[k]) / (2.0 * step);
                is_done &= table.take(quotient, NOISE * size / step);
            }
            if is_done {
                open[index] = None;
            }
        }
        step *= 0.5;
    }
    tables
}

/// Forces by pose with a number of a source off; `None` if there is no balance, or no need of it.
fn values(
    systems: &mut Systems,
    poses: &[Posed],
    open: &[Option<&Carried>],
    ((source, axis), off): ((usize, usize), f64),
) -> Vec<Option<Vec<f64>>> {
    let mut e = vec![[0.0; 2]; systems.sources.len()];
    e[source][axis] = off;
    let Some(system) = systems.with(&e) else {
        return vec![None; poses.len()];
    };
    let mut loaded = None;
    let found = poses.iter().zip(open).map(|(posed, open)| {
        let sides = &open.as_ref()?.sides;
        if loaded.is_none() {
            loaded = Loaded::new(systems, &system, posed);
        }
        let q = carried_over(&systems.nominal, &system, &posed.stand.q);
        let found = loaded.as_mut()?.carry(posed, &q, &e, sides);
        found.ok().map(|found| found.values)
    });
    found.collect()
}
