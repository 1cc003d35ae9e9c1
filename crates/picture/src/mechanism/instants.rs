//! The values of drivers in a pose, and the instants whose poses show most of the motion.

use super::drivers::driver_value;
use super::moving::Mechanism;
use crate::poses::{Pose, Poses};
use crate::shape::DriverKind;
use crate::words;

/// Outputs among which instants are chosen, at most.
const MOST_ROWS: usize = 2000;
/// Halvings of an interval of outputs: below the round-off of a time.
const HALVINGS: usize = 50;
/// Most drivers whose values are shown.
const MOST_TOLD: usize = 2;
/// Poses that differ less, as a part of the mechanism's size and in radians, are the same.
const SAME: f64 = 1e-3;
/// A driver that goes less far in all stands still [rad, m].
const STILL: f64 = 1e-9;

/// Instants on which poses are spread: over `value` from the first to the last one.
struct Stretch {
    rows: Vec<[f64; 2]>,
}

impl Mechanism {
    /// `motor = −30.0°`: the values of the drivers in a pose, with the digits that their ranges ask for.
    pub(super) fn driver_words(&self, pose: &[Pose]) -> String {
        let drivers = self.shape.drivers.iter().zip(&self.driver_ranges);
        let words = drivers.take(MOST_TOLD).map(|(driver, [low, high])| {
            let (factor, unit) = match driver.kind {
                DriverKind::Rotation { .. } => (1f64.to_degrees(), "°"),
                DriverKind::Translation { .. }
                | DriverKind::Length { .. }
                | DriverKind::Point { .. }
                    if high.abs().max(low.abs()) < 10.0 =>
                {
                    (1000.0, " mm")
                }
                DriverKind::Translation { .. }
                | DriverKind::Length { .. }
                | DriverKind::Point { .. } => (1.0, " m"),
            };
            let value = driver_value(&self.shape, pose, driver.kind) * factor;
            let span = (high - low) * factor;
            let decimals = if span > 1e-9 {
                (3.0 - span.log10().floor()).clamp(0.0, 6.0) as usize
            } else {
                1
            };
            let name = words::printable(&driver.name);
            // Round-off has no sign.
            let value = if value.abs() < 0.5 * 0.1_f64.powi(decimals as i32) {
                0.0
            } else {
                value
            };
            let number = words::minus(&format!("{value:.decimals$}"));
            format!("{name} = {number}{unit}")
        });
        words.collect::<Vec<_>>().join(", ")
    }

    /// Instants of so many poses. Where there is one driver they are equally spaced in its value, over the longest stretch in which
    /// it goes one way; else in time. None lies in a gap, and of a whole cycle the end, which is the beginning, is left out.
    pub fn instants(&self, count: usize) -> Vec<f64> {
        let [first, _] = self.span();
        if count < 2 {
            return vec![first; count];
        }
        let by_driver = match &self.shape.drivers[..] {
            [driver] => self.stretch_of(driver.kind),
            _ => None,
        };
        let (driver, stretch) = match by_driver {
            Some((driver, stretch)) => (Some(driver), stretch),
            None => (None, self.stretch_of_time()),
        };
        let (Some([start, low]), Some([end, high])) = (stretch.rows.first(), stretch.rows.last())
        else {
            return vec![first; count];
        };
        let spaces = if driver.is_some() && self.is_same(*start, *end) {
            count
        } else {
            count - 1
        };
        let target = |index: usize| low + (high - low) * index as f64 / spaces as f64;
        (0..count)
            .map(|index| match (index, driver) {
                (0, _) => *start,
                (index, _) if index == spaces => *end,
                (index, Some(driver)) => self.instant_of(&stretch, driver, target(index)),
                (index, None) => stretch.time_of(target(index)),
            })
            .collect()
    }

    /// Outputs with poses: their time, and their value by `value`.
    fn rows_with(&self, value: impl Fn(&Poses, usize) -> Option<f64>) -> Vec<Option<[f64; 2]>> {
        let count = self.poses.time.len();
        let step = count.div_ceil(MOST_ROWS).max(1);
        let rows = (0..count).step_by(step);
        let last = !(count - 1).is_multiple_of(step);
        rows.chain(last.then_some(count - 1))
            .map(|row| value(&self.poses, row).map(|value| [self.poses.time[row], value]))
            .collect()
    }

    /// All outputs with poses, with the time that has passed outside of gaps.
    fn stretch_of_time(&self) -> Stretch {
        let rows = self.rows_with(|poses, row| poses.row(row).map(|_| poses.time[row]));
        let mut passed = 0.0;
        let mut before: Option<f64> = None;
        let mut known = Vec::new();
        for row in rows {
            if let Some([time, _]) = row {
                passed += before.map_or(0.0, |before| time - before);
                known.push([time, passed]);
            }
            before = row.map(|[time, _]| time);
        }
        Stretch { rows: known }
    }

    /// The longest stretch without a gap in which a driver moves in one direction; `None` if it does not move.
    fn stretch_of(&self, driver: DriverKind) -> Option<(DriverKind, Stretch)> {
        let value =
            |poses: &Poses, row: usize| Some(driver_value(&self.shape, &poses.row(row)?, driver));
        let mut longest: Vec<[f64; 2]> = Vec::new();
        let mut current: Vec<[f64; 2]> = Vec::new();
        let far = |rows: &[[f64; 2]]| match rows {
            [[_, first], .., [_, last]] => (last - first).abs(),
            _ => 0.0,
        };
        for row in self.rows_with(value).into_iter().chain([None]) {
            let turns = match (row, &current[..]) {
                (None, _) => true,
                (Some([_, value]), [[_, first], .., [_, last]]) => {
                    (value - last) * (last - first) < 0.0
                }
                (Some(_), _) => false,
            };
            if turns {
                if far(&current) > far(&longest) {
                    longest.clone_from(&current);
                }
                // The turning point belongs to both stretches, an output before a gap to one.
                let kept = current.last().copied().filter(|_| row.is_some());
                current = Vec::from_iter(kept);
            }
            current.extend(row);
        }
        (far(&longest) > STILL).then_some((driver, Stretch { rows: longest }))
    }

    /// The instant of a stretch at which a driver has a value, on the motion between outputs.
    fn instant_of(&self, stretch: &Stretch, driver: DriverKind, value: f64) -> f64 {
        let [[mut low, first], [mut high, last]] = stretch.around(value);
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            let Some(pose) = self.poses.at(middle) else {
                break;
            };
            let here = driver_value(&self.shape, &pose, driver);
            if (here < value) == (first <= last) {
                low = middle;
            } else {
                high = middle;
            }
        }
        (low + high) / 2.0
    }

    /// Whether all bodies are at the same places at both instants, turns aside.
    pub(super) fn is_same(&self, one: f64, other: f64) -> bool {
        let (Some(a), Some(b)) = (self.poses.at(one), self.poses.at(other)) else {
            return false;
        };
        let [wide, high] = self.frame.extent.sizes();
        let room = SAME * wide.hypot(high);
        let same = |(a, b): (&Pose, &Pose)| {
            let turn = (b[2] - a[2]).sin().hypot(1.0 - (b[2] - a[2]).cos());
            (b[0] - a[0]).hypot(b[1] - a[1]) <= room && turn <= SAME
        };
        other > one && a.iter().zip(&b).all(same)
    }
}

impl Stretch {
    /// The outputs before and behind a value.
    fn around(&self, value: f64) -> [[f64; 2]; 2] {
        let rises = match self.rows[..] {
            [[_, first], .., [_, last]] => last >= first,
            _ => true,
        };
        let after = self
            .rows
            .partition_point(|[_, here]| if rises { *here < value } else { *here > value })
            .clamp(1, self.rows.len() - 1);
        [self.rows[after - 1], self.rows[after]]
    }

    /// The time of a value on the straight line between outputs.
    fn time_of(&self, value: f64) -> f64 {
        if self.rows.len() < 2 {
            return self.rows.first().map_or(0.0, |row| row[0]);
        }
        let [[low, first], [high, last]] = self.around(value);
        if last > first {
            low + (high - low) * (value - first) / (last - first)
        } else {
            // Over a gap no time has passed.
            low
        }
    }
}
