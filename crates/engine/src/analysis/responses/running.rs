//! A reduction over rows, as far as they came.

use super::crossing::{self, Known};
use super::reason::Reason;
use super::top::{self, CurvePoint};
use linkdyn_model::response::Reduction;

/// Both sides of an equation are the same where they differ by less, relative to the larger: a driver's value and the one
/// written are rounded a few times each.
const SAME: f64 = 4.0 * f64::EPSILON;
/// Extremes that differ by less, relative to their value, are found at the first of them.
const EQUAL: f64 = 1e-12;

/// What a row gives.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    pub time: f64,
    pub value: Result<f64, Reason>,
    /// Of `at` and `count`.
    pub sides: Option<Result<[f64; 2], Reason>>,
}

/// A reduction that is under way.
#[derive(Debug, Clone, Default)]
pub struct Running {
    /// How many rows came.
    rows: usize,
    begin: f64,
    /// The last row: time, value, and how far the left side is above the right one.
    last: Option<(f64, f64, f64)>,
    /// Largest and smallest value with their times.
    most: Option<[f64; 2]>,
    least: Option<[f64; 2]>,
    integral: f64,
    squares: f64,
    /// Passages, and on which side of the equation the last row was.
    count: u32,
    side: f64,
    /// What was found, of `first`, `last` and `at`.
    found: Option<f64>,
    /// The two rows between which it was found, of `at`.
    around: Option<[Known; 2]>,
    /// Their times, twice that of the row where it was found.
    between: Option<[f64; 2]>,
    fault: Option<Reason>,
    /// What was empty last, of extremes.
    empty: Option<Reason>,
    /// Times and values of all rows, of extremes.
    points: Vec<CurvePoint>,
}

impl Running {
    /// Forgets the rows.
    pub fn restart(&mut self) {
        let mut points = std::mem::take(&mut self.points);
        points.clear();
        *self = Running {
            points,
            ..Running::default()
        };
    }

    /// Takes the next row.
    pub fn row(&mut self, reduction: Reduction, row: &Row) {
        match reduction {
            Reduction::At => return self.look(row),
            Reduction::Count => return self.pass(row),
            Reduction::First => {
                if self.rows == 0 {
                    (self.found, self.fault) = (row.value.ok(), row.value.err());
                }
            }
            Reduction::Last => (self.found, self.fault) = (row.value.ok(), row.value.err()),
            Reduction::Max
            | Reduction::Min
            | Reduction::Range
            | Reduction::ArgMax
            | Reduction::ArgMin => {
                self.between(row);
                self.points
                    .extend(row.value.ok().map(|value| [row.time, value]));
                match row.value {
                    // extremes are those of the other instants
                    Err(reason @ Reason::Empty(_)) => self.empty = Some(reason),
                    Err(reason) => self.fault = self.fault.or(Some(reason)),
                    Ok(_) => {}
                }
            }
            Reduction::Mean | Reduction::Rms | Reduction::Integral | Reduction::Sum => {
                match row.value {
                    Ok(value) => self.sum(row.time, value),
                    Err(reason) => self.fault = self.fault.or(Some(reason)),
                }
            }
        }
        self.rows += 1;
    }

    /// Takes a row between others.
    pub fn between(&mut self, row: &Row) {
        let Ok(value) = row.value else { return };
        let time = row.time;
        let take = |known: Option<[f64; 2]>, sign: f64| match known {
            // of equal extremes the first
            Some([best, at]) if (value - best).abs() <= EQUAL * best.abs() => {
                let farther = if sign * value > sign * best {
                    value
                } else {
                    best
                };
                [farther, f64::min(time, at)]
            }
            Some([best, at]) if sign * value <= sign * best => [best, at],
            Some(_) | None => [value, time],
        };
        self.most = Some(take(self.most, 1.0));
        self.least = Some(take(self.least, -1.0));
    }

    /// Looks for what lies between the rows, by asking for rows there.
    pub fn ask(&mut self, reduction: Reduction, mut row: impl FnMut(f64) -> Option<Row>) {
        if self.fault.is_some() {
            return;
        }
        let sides: &[f64] = match reduction {
            Reduction::Max | Reduction::ArgMax => &[1.0],
            Reduction::Min | Reduction::ArgMin => &[-1.0],
            Reduction::Range => &[1.0, -1.0],
            Reduction::At => {
                let found = self
                    .around
                    .and_then(|around| crossing::value(around, |time| known(&row(time)?)));
                self.found = found.or(self.found);
                return;
            }
            Reduction::First
            | Reduction::Last
            | Reduction::Mean
            | Reduction::Rms
            | Reduction::Integral
            | Reduction::Sum
            | Reduction::Count => return,
        };
        let mut points = std::mem::take(&mut self.points);
        for side in sides {
            points.iter_mut().for_each(|point| point[1] *= side);
            self.climb(&points, *side, &mut row);
            points.iter_mut().for_each(|point| point[1] *= side);
        }
        self.points = points;
    }

    /// Looks for the highest top of rows whose values have been multiplied by `side`.
    fn climb(
        &mut self,
        points: &[CurvePoint],
        side: f64,
        row: &mut impl FnMut(f64) -> Option<Row>,
    ) {
        let most = |running: &Running| {
            let known = if side > 0.0 {
                running.most
            } else {
                running.least
            };
            known.map_or(f64::NEG_INFINITY, |[value, _]| side * value)
        };
        for index in 0..points.len() {
            let promise = top::promise(points, index);
            if promise.is_none_or(|promise| points[index][1] + promise <= most(self)) {
                continue;
            }
            let found = top::find(points, index, |time| {
                let row = row(time)?;
                self.between(&row);
                row.value.ok().map(|value| side * value)
            });
            if let Err(time) = found {
                self.fault = Some(Reason::Endless(time));
                return;
            }
        }
    }

    fn sum(&mut self, time: f64, value: f64) {
        match self.last {
            Some((before, other, _)) => {
                let half = 0.5 * (time - before);
                self.integral += half * (other + value);
                self.squares += half * (other * other + value * value);
            }
            None => self.begin = time,
        }
        self.last = Some((time, value, 0.0));
    }

    /// Looks for where the equation first holds.
    fn look(&mut self, row: &Row) {
        self.rows += 1;
        if self.found.is_some() || self.fault.is_some() {
            return;
        }
        let (Some(Ok([left, right])), before) = (row.sides, self.last.take()) else {
            return;
        };
        let value = row.value.unwrap_or(f64::NAN);
        let above = left - right;
        self.last = Some((row.time, value, above));
        let is_here = above.abs() <= SAME * left.abs().max(right.abs());
        let found = match before {
            _ if is_here => {
                self.between = Some([row.time; 2]);
                value
            }
            Some((at, other, before)) if (before < 0.0) != (above < 0.0) => {
                let known = |at, above, value| Known { at, above, value };
                self.around = Some([known(at, before, other), known(row.time, above, value)]);
                self.between = Some([at, row.time]);
                other + (value - other) * (before / (before - above))
            }
            Some(_) | None => return,
        };
        match found.is_finite() {
            true => self.found = Some(found),
            false => {
                self.fault = Some(row.value.err().unwrap_or(Reason::NotFinite(Some(row.time))))
            }
        }
    }

    /// Counts how often the left side of the equation passes the right one; a touch is no passage.
    fn pass(&mut self, row: &Row) {
        self.rows += 1;
        match row.sides {
            Some(Ok([left, right])) => {
                let above = left - right;
                if above.abs() <= SAME * left.abs().max(right.abs()) {
                    return;
                }
                if self.side != 0.0 && self.side != above.signum() {
                    self.count += 1;
                }
                self.side = above.signum();
            }
            Some(Err(reason)) => self.fault = self.fault.or(Some(reason)),
            None => {}
        }
    }

    /// When the greatest (side 1) or smallest (−1) value was.
    pub fn extreme(&self, side: f64) -> Option<f64> {
        let known = if side > 0.0 { self.most } else { self.least };
        known.map(|[_, time]| time)
    }

    /// The times of the rows between which the equation of `at` holds.
    pub fn between_rows(&self) -> Option<[f64; 2]> {
        self.between
    }

    /// The result.
    pub fn result(&self, reduction: Reduction) -> Result<f64, Reason> {
        if let Some(reason) = self.fault {
            return Err(reason);
        }
        let nothing = self.empty.unwrap_or(Reason::Nothing(0));
        let (most, least) = (self.most.ok_or(nothing), self.least.ok_or(nothing));
        let (end, alone) = match self.last {
            Some((time, value, _)) => (time, Ok(value)),
            None => (0.0, Err(nothing)),
        };
        let duration = end - self.begin;
        match reduction {
            Reduction::Max => most.map(|[value, _]| value),
            Reduction::Min => least.map(|[value, _]| value),
            Reduction::Range => Ok(most?[0] - least?[0]),
            Reduction::ArgMax => most.map(|[_, time]| time),
            Reduction::ArgMin => least.map(|[_, time]| time),
            Reduction::Integral => alone.map(|_| self.integral),
            Reduction::Mean | Reduction::Sum if duration > 0.0 => Ok(self.integral / duration),
            Reduction::Mean | Reduction::Sum => alone,
            Reduction::Rms if duration > 0.0 => Ok((self.squares / duration).sqrt()),
            Reduction::Rms => alone.map(f64::abs),
            Reduction::First | Reduction::Last => self.found.ok_or(nothing),
            Reduction::At if self.rows == 0 => Err(nothing),
            Reduction::At => self.found.ok_or(Reason::NeverReached(0)),
            Reduction::Count if self.rows == 0 => Err(nothing),
            Reduction::Count => Ok(f64::from(self.count)),
        }
    }
}

/// What an equation's row says of it.
fn known(row: &Row) -> Option<Known> {
    let [left, right] = row.sides?.ok()?;
    let above = left - right;
    let is_here = above.abs() <= SAME * left.abs().max(right.abs());
    Some(Known {
        at: row.time,
        above: if is_here { 0.0 } else { above },
        value: row.value.ok()?,
    })
}
