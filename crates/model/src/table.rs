//! Tables: functions by their points, `"tables": { "gas": { "points": [["0 deg", "30 bar"], …] } }`, which formulas call as
//! `gas(crank.angle)`.

use serde::{Deserialize, Serialize};

use crate::dimension::Powers;
use crate::error::Complaint;
use crate::motion::Interpolation;
use crate::units::Unit;

/// Points that a table has at most.
pub const MOST_POINTS: usize = 100_000;

/// A function by its points, in SI.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Table {
    /// [[place, value], …]
    pub points: Vec<[f64; 2]>,
    /// SI units of both columns; empty of plain numbers.
    pub units: [String; 2],
    /// What is between the points.
    pub interpolation: Interpolation,
    /// After which it repeats, in the unit of the places.
    pub period: Option<f64>,
}

impl Table {
    /// The dimensions of both columns.
    ///
    /// # Errors
    /// What is wrong with a unit, at no path.
    pub(crate) fn columns(&self) -> Result<[Powers; 2], Complaint> {
        let [x, y] = &self.units;
        Ok([unit(x)?.powers, unit(y)?.powers])
    }

    /// After what it repeats; `None` if it does not.
    pub fn repeats(&self) -> Option<f64> {
        let (first, last) = (self.points.first()?, self.points.last()?);
        let whole = (self.interpolation == Interpolation::Periodic).then_some(last[0] - first[0]);
        self.period.or(whole)
    }

    /// Its points, with the first one of the next period where it repeats.
    pub fn closed(&self) -> Vec<[f64; 2]> {
        let mut points = self.points.clone();
        if let (Some(period), Some(first), Some(last)) =
            (self.repeats(), points.first().copied(), points.last_mut())
        {
            let end = first[0] + period;
            match is_end(last[0], end, period) {
                true => last[0] = end,
                false => points.push([end, first[1]]),
            }
        }
        points
    }
}

/// Whether a place is the end of a period, but for the rounding of both.
pub(crate) fn is_end(place: f64, end: f64, period: f64) -> bool {
    (place - end).abs() <= 1e-12 * (period + end.abs())
}

/// A unit; that of plain numbers where the text is empty.
///
/// # Errors
/// What is wrong with it, at no path.
pub(crate) fn unit(text: &str) -> Result<Unit, Complaint> {
    if matches!(text.trim(), "" | "1" | "-" | "–") {
        return Ok(Unit::si(Powers::default()));
    }
    Unit::parse(text.trim()).map_err(|fault| Complaint {
        hint: fault.hint(),
        ..Complaint::new("", fault.message(text))
    })
}
