//! A reduction over rows, as far as they came.

use super::answer::Reason;
use linkdyn_model::response::Reduction;

/// Both sides of an equation are the same where they differ by less, relative to the larger: a driver's value and the one
/// written are rounded a few times each.
const SAME: f64 = 4.0 * f64::EPSILON;

/// What a row gives.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    pub time: f64,
    pub value: Result<f64, Reason>,
    /// Of `at` and `count`.
    pub sides: Option<Result<[f64; 2], Reason>>,
}

/// A reduction that is under way.
#[derive(Debug, Clone, Copy, Default)]
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
    fault: Option<Reason>,
}

impl Running {
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
                self.between(reduction, row);
                self.fault = self.fault.or(row.value.err());
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
    pub fn between(&mut self, _: Reduction, row: &Row) {
        let Ok(value) = row.value else { return };
        let time = row.time;
        let is_new = |known: Option<[f64; 2]>, sign: f64| {
            known
                .is_none_or(|[best, at]| sign * value > sign * best || (value == best && time < at))
        };
        if is_new(self.most, 1.0) {
            self.most = Some([value, time]);
        }
        if is_new(self.least, -1.0) {
            self.least = Some([value, time]);
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
            _ if is_here => value,
            Some((_, other, before)) if (before < 0.0) != (above < 0.0) => {
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

    /// The result.
    pub fn result(&self, reduction: Reduction) -> Result<f64, Reason> {
        if let Some(reason) = self.fault {
            return Err(reason);
        }
        let nothing = Reason::Nothing(0);
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
