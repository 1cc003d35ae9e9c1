//! What settles as the tolerance of the integration goes down.
//!
//! An impact amplifies what two runs differ by, and a stroke has hundreds of impacts: runs at two tolerances part soon, and what can
//! settle after that are statistics. So three things are reported: how contacts converge before runs part ([`super::early`]), on what part
//! of the outputs two runs agree, and the paper's statistics at each tolerance.

use super::super::models::{Quantity, RADII, STEPS, Stroke};
use super::super::table::{
    DISTURBED, Deviation, Deviations, NEAR_CHANGE_POINT, Runs, UNBOUNDED, settles,
};
use super::strokes::{STEP, Strokes, TOLERANCES};

/// End of the part of the stroke that is clear of the change point \[deg\].
pub const CLEAR: f64 = NEAR_CHANGE_POINT - UNBOUNDED;
/// A number of the paper's table.
pub type Statistic = fn(Deviation) -> f64;
/// Both, as the table names them.
pub const STATISTICS: [(&str, Statistic); 2] = [("max", |d| d.max), ("mean", |d| d.mean)];
/// Outputs this close together are the same \[deg\].
const SAME_OUTPUT: f64 = 1e-6;

/// The paper's statistics at each tolerance.
pub struct Convergence {
    /// By tolerance; each by radius, output step and quantity.
    pub whole: Vec<Deviations>,
    /// The same up to [`CLEAR`].
    pub clear: Vec<Deviations>,
}

impl Convergence {
    /// Against the ideal runs of `base`.
    pub fn new(base: &Runs, strokes: &Strokes) -> Self {
        let until = |end: f64| {
            (0..TOLERANCES.len())
                .map(|index| deviations(base, &strokes.at(index), end))
                .collect()
        };
        Convergence {
            whole: until(f64::INFINITY),
            clear: until(CLEAR),
        }
    }

    /// At the finest tolerance.
    pub fn finest(&self) -> &Deviations {
        &self.whole[TOLERANCES.len() - 1]
    }
}

/// A statistic of a quantity at one clearance and output step, at all tolerances.
pub fn by_tolerance(
    all: &[Deviations],
    [radius, step]: [usize; 2],
    quantity: Quantity,
    value: impl Fn(Deviation) -> f64,
) -> Vec<f64> {
    all.iter()
        .map(|deviations| value(deviations.at(radius, step, quantity)))
        .collect()
}

/// Numbers of the paper's table that can settle: all of its 20 but the two largest F12, which contact has from the ideal lock, without
/// bound at its change point.
pub const NUMBERS: usize = 18;

/// How many of these settle in a table of values, by radius, quantity and statistic: in the last two values, and in the last three.
pub fn settled(values: impl Fn(usize, Quantity, Statistic) -> Vec<f64>) -> [usize; 2] {
    let mut count = [0, 0];
    for quantity in Quantity::ALL {
        for (name, statistic) in STATISTICS {
            if (name, quantity) == ("max", Quantity::Force) {
                continue;
            }
            for radius in 0..RADII.len() {
                let values = values(radius, quantity, statistic);
                let before = values
                    .split_last()
                    .is_some_and(|(_, before)| settles(before));
                let ends = values
                    .len()
                    .checked_sub(3)
                    .is_some_and(|first| settles(&[values[first], values[first + 2]]));
                count[0] += usize::from(settles(&values));
                count[1] += usize::from(settles(&values) && before && ends);
            }
        }
    }
    count
}

fn deviations(base: &Runs, strokes: &[&Stroke], end: f64) -> Deviations {
    let at = |stroke: &Stroke| {
        STEPS
            .iter()
            .map(|&step| deviation(base, stroke, end, step))
            .collect()
    };
    Deviations {
        ranges: base.deviations.ranges,
        table: strokes.iter().map(|stroke| at(stroke)).collect(),
    }
}

/// Deviations of a stroke from the ideal one up to `end` \[deg\], as far as it comes, at outputs `step` apart \[deg\].
pub fn deviation(base: &Runs, stroke: &Stroke, end: f64, step: f64) -> [Deviation; 5] {
    let ideal = &base.ideal[STEPS.len() - 1];
    let count = ideal.theta6.iter().filter(|theta6| **theta6 <= end).count();
    let stride = (step / STEP).round() as usize;
    let thin = |values: &[f64]| {
        values
            .iter()
            .take(count)
            .step_by(stride)
            .copied()
            .collect::<Vec<f64>>()
    };
    Quantity::ALL.map(|q| {
        let [theta6, without, with] =
            [&ideal.theta6[..], ideal.curve(q), stroke.curve(q)].map(thin);
        Deviation::of(&theta6, &without, &with, base.deviations.ranges[q.index()])
    })
}

/// Two runs of the same mechanism, at neighbouring tolerances or output steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// Part of the common outputs that differ by no more than 1 % of the ideal curve's range: up to [`CLEAR`], and beyond [–].
    pub agree: [[f64; 5]; 2],
    /// Mean difference by the mean deviation of the second from the ideal mechanism [–].
    pub mean: [f64; 5],
}

impl Pair {
    /// Compares them, where both have values.
    pub fn of(a: &Stroke, b: &Stroke, ideal: &Stroke, ranges: &[f64; 5]) -> Self {
        let row = |stroke: &Stroke, theta6: f64| {
            let row = stroke
                .theta6
                .partition_point(|other| *other < theta6 - SAME_OUTPUT);
            stroke
                .theta6
                .get(row)
                .is_some_and(|other| (other - theta6).abs() <= SAME_OUTPUT)
                .then_some(row)
        };
        let rows: Vec<(f64, [usize; 3])> = a
            .theta6
            .iter()
            .enumerate()
            .filter_map(|(first, &theta6)| {
                Some((theta6, [first, row(b, theta6)?, row(ideal, theta6)?]))
            })
            .collect();
        // θ6, difference, deviation of the second.
        let differences = |q: Quantity| {
            let [a, b, ideal] = [a, b, ideal].map(|stroke| stroke.curve(q));
            let of = move |&(theta6, [i, j, k]): &(f64, [usize; 3])| {
                (theta6, (a[i] - b[j]).abs(), (b[j] - ideal[k]).abs())
            };
            rows.iter().map(of).filter(|(_, difference, deviation)| {
                difference.is_finite() && deviation.is_finite()
            })
        };
        let agree = [true, false].map(|clear| {
            Quantity::ALL.map(|q| {
                let part = differences(q).filter(|(theta6, ..)| (*theta6 <= CLEAR) == clear);
                let (agree, all) = part.fold((0.0, 0.0), |(agree, all), (_, difference, _)| {
                    (
                        agree + f64::from(u8::from(difference <= DISTURBED * ranges[q.index()])),
                        all + 1.0,
                    )
                });
                agree / f64::max(all, 1.0)
            })
        });
        let mean = Quantity::ALL.map(|q| {
            let sums = differences(q).fold([0.0, 0.0], |sums, (_, difference, deviation)| {
                [sums[0] + difference, sums[1] + deviation]
            });
            sums[0] / sums[1]
        });
        Pair { agree, mean }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_settle_in_two_or_three_values_without_the_largest_force() {
        assert_eq!(settled(|_, _, _| vec![1.0, 1.1, 1.0]), [NUMBERS, NUMBERS]);
        assert_eq!(settled(|_, _, _| vec![2.0, 1.1, 1.0]), [NUMBERS, 0]);
        // Each 18 % apart, the outer ones 33 %.
        assert_eq!(settled(|_, _, _| vec![1.0, 1.22, 1.488]), [NUMBERS, 0]);
        assert_eq!(settled(|_, _, _| vec![1.0, 1.0, 2.0]), [0, 0]);
        let one = |radius: usize, quantity: Quantity, _: Statistic| {
            if (radius, quantity) == (0, Quantity::Force) {
                vec![1.0; 3]
            } else {
                vec![1.0, 2.0, 4.0]
            }
        };
        assert_eq!(settled(one), [1, 1], "its mean alone");
    }
}
