//! The paper's table: absolute deviations from the ideal mechanism over the stroke, at several output steps.

use super::document::broken;
use super::models::{Quantity, RADII, Request, STEPS, Stroke};
use crate::CaseError;
use crate::table::Table;
use linkdyn_engine::analysis::Control;

/// Relative difference of the values at the two finest steps up to which a row counts as settled.
pub const SETTLED: f64 = 0.2;

/// Statistics of one quantity at one clearance and step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    pub max: f64,
    /// Where the largest deviation is \[deg\].
    pub at: f64,
    pub mean: f64,
    /// Part of the instants with a deviation above [`DISTURBED`] of the ideal curve's range [–].
    pub disturbed: f64,
    /// Number of instants that have a value.
    pub instants: usize,
}

/// A deviation of this part of the ideal curve's range counts as a disturbance.
pub const DISTURBED: f64 = 0.01;

impl Deviation {
    /// Of a curve from the ideal one; instants without a value are left out.
    pub fn of(theta6: &[f64], ideal: &[f64], curve: &[f64], range: f64) -> Deviation {
        let mut found = Deviation {
            max: 0.0,
            at: f64::NAN,
            mean: 0.0,
            disturbed: 0.0,
            instants: 0,
        };
        for ((&theta6, ideal), value) in theta6.iter().zip(ideal).zip(curve) {
            let deviation = (value - ideal).abs();
            if !deviation.is_finite() {
                continue;
            }
            found.instants += 1;
            found.mean += deviation;
            if deviation > found.max {
                (found.max, found.at) = (deviation, theta6);
            }
            if deviation > DISTURBED * range {
                found.disturbed += 1.0;
            }
        }
        let instants = found.instants.max(1) as f64;
        found.mean /= instants;
        found.disturbed /= instants;
        found
    }
}

/// Whether values at ever finer steps settle: the last two differ by no more than [`SETTLED`] of the larger one.
pub fn settles(values: &[f64]) -> bool {
    match values {
        [.., before, last] => (last - before).abs() <= SETTLED * last.abs().max(before.abs()),
        [_] | [] => false,
    }
}

/// What the paper prints.
#[derive(Debug, Clone, PartialEq)]
pub struct Paper(Table);

impl Paper {
    /// Reads `validation/lock/paper.csv`.
    ///
    /// # Errors
    /// When the file is not what it should be.
    pub fn read() -> Result<Self, CaseError> {
        let table = Table::parse(include_str!("../../lock/paper.csv")).map_err(broken)?;
        let expected: Vec<String> = std::iter::once("e[um]".to_string())
            .chain(Quantity::ALL.into_iter().flat_map(|q| {
                ["max", "mean"].map(|statistic| format!("{}.{statistic}[{}]", q.symbol(), q.unit()))
            }))
            .collect();
        let radii: Vec<f64> = table.rows.iter().map(|row| row[0]).collect();
        if table.columns != expected || radii != RADII {
            return Err(broken(format!(
                "paper.csv: columns {expected:?} in rows {RADII:?} are expected"
            )));
        }
        Ok(Paper(table))
    }

    /// Largest and mean deviation, for the radius of that index.
    pub fn deviation(&self, radius: usize, quantity: Quantity) -> [f64; 2] {
        let row = &self.0.rows[radius];
        let column = 1 + 2 * quantity.index();
        [row[column], row[column + 1]]
    }
}

/// The runs of one choice of centres of mass: ideal and with each clearance, at each step.
pub struct Runs {
    pub request: Request,
    /// By step.
    pub ideal: Vec<Stroke>,
    /// By radius and step.
    pub clearance: Vec<Vec<Stroke>>,
    pub deviations: Deviations,
}

/// Deviations from the ideal mechanism.
#[derive(Debug, Clone)]
pub struct Deviations {
    /// Range of each ideal curve [its unit].
    pub ranges: [f64; 5],
    /// By radius, step and quantity.
    pub table: Vec<Vec<[Deviation; 5]>>,
}

impl Deviations {
    /// Of a quantity at all steps.
    pub fn row(&self, radius: usize, quantity: Quantity) -> Vec<Deviation> {
        (0..STEPS.len())
            .map(|step| self.at(radius, step, quantity))
            .collect()
    }

    /// Of a quantity at one step.
    pub fn at(&self, radius: usize, step: usize, quantity: Quantity) -> Deviation {
        self.table[radius][step][quantity.index()]
    }
}

impl Runs {
    /// Runs all of them.
    ///
    /// # Errors
    /// When one can't be run.
    pub fn new(request: Request, control: &Control) -> Result<Self, CaseError> {
        let at = |radius: f64, step: f64| {
            Request {
                radius,
                step,
                ..request
            }
            .run(control)
        };
        let ideal = STEPS
            .iter()
            .map(|&step| at(0.0, step))
            .collect::<Result<Vec<_>, _>>()?;
        let by_step = |&radius: &f64| {
            STEPS
                .iter()
                .map(|&step| at(radius, step))
                .collect::<Result<Vec<_>, _>>()
        };
        let clearance = RADII.iter().map(by_step).collect::<Result<Vec<_>, _>>()?;
        let ranges = Quantity::ALL.map(|quantity| range(&ideal[0], quantity));
        let table = clearance
            .iter()
            .map(|strokes: &Vec<Stroke>| {
                let pairs = strokes.iter().zip(&ideal);
                pairs
                    .map(|(stroke, ideal)| deviations(stroke, ideal, &ranges))
                    .collect()
            })
            .collect();
        Ok(Runs {
            request,
            ideal,
            clearance,
            deviations: Deviations { ranges, table },
        })
    }

    /// The deviations of a quantity at all steps.
    pub fn row(&self, radius: usize, quantity: Quantity) -> Vec<Deviation> {
        self.deviations.row(radius, quantity)
    }
}

/// Deviations of all quantities.
fn deviations(stroke: &Stroke, ideal: &Stroke, ranges: &[f64; 5]) -> [Deviation; 5] {
    Quantity::ALL.map(|quantity| {
        let range = ranges[quantity.index()];
        Deviation::of(
            &stroke.theta6,
            ideal.curve(quantity),
            stroke.curve(quantity),
            range,
        )
    })
}

/// Distance from the change point within which the ideal F12, which has no bound there, is left out of its range \[deg\].
pub const UNBOUNDED: f64 = 2.5;
/// The paper's singular configuration that is the change point \[deg\].
pub const NEAR_CHANGE_POINT: f64 = 117.5;

/// Largest minus smallest value of an ideal curve.
fn range(ideal: &Stroke, quantity: Quantity) -> f64 {
    let bounded = |theta6: f64| match quantity {
        Quantity::Theta2 | Quantity::Omega2 | Quantity::Alpha2 | Quantity::Torque => true,
        Quantity::Force => (theta6 - NEAR_CHANGE_POINT).abs() > UNBOUNDED,
    };
    let values = ideal
        .theta6
        .iter()
        .zip(ideal.curve(quantity))
        .filter(|(theta6, _)| bounded(**theta6));
    let (low, high) = values.fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(low, high), (_, &value)| {
            if value.is_finite() {
                (low.min(value), high.max(value))
            } else {
                (low, high)
            }
        },
    );
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_leave_out_what_is_missing() {
        let theta6 = [0.0, 1.0, 2.0, 3.0];
        let deviation = Deviation::of(
            &theta6,
            &[1.0, 1.0, 1.0, 1.0],
            &[1.5, f64::NAN, -1.0, 1.0],
            100.0,
        );
        assert_eq!(
            (deviation.max, deviation.at, deviation.instants),
            (2.0, 2.0, 3)
        );
        assert!((deviation.mean - 2.5 / 3.0).abs() < 1e-15, "{deviation:?}");
        assert!(
            (deviation.disturbed - 1.0 / 3.0).abs() < 1e-15,
            "{deviation:?}"
        );
    }

    #[test]
    fn a_row_settles_when_its_last_two_values_agree() {
        assert!(settles(&[1.0, 5.0, 1.0, 1.1]));
        assert!(!settles(&[1.0, 2.0, 4.0, 20.0]));
        assert!(!settles(&[1.0, 1.0, 1.0, 0.7]));
        assert!(settles(&[0.0, 0.0]));
        assert!(!settles(&[1.0, f64::NAN]));
        assert!(!settles(&[1.0]));
    }

    #[test]
    fn the_papers_numbers_are_read_as_printed() {
        let paper = Paper::read().expect("valid");
        assert_eq!(paper.deviation(0, Quantity::Theta2), [0.0184, 0.0011]);
        assert_eq!(paper.deviation(1, Quantity::Force), [166_110.0, 957.4811]);
    }
}
