//! Numbers as compact text, column by column.
//!
//! All columns go in as they are while there is room. Else, in this order: 7 digits instead of 16 (binary32), then only every
//! k-th row as long as [`FEW_ROWS`] remain, then columns are left out from the least important on, and at last rows again. Rows
//! in which columns have their extremes stay, in up to half of the room for rows.

use std::io::{self, Write};

use crate::numbers::Numbers;
use linkdyn_output::{Column, Trajectory};

/// Rows below which columns are left out rather than more rows.
const FEW_ROWS: usize = 500;

/// How much a column is worth when room is short; the first is the last to go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Worth {
    /// Time, driver values, columns that `analysis.columns` names.
    Asked,
    /// Poses: the animation.
    Pose,
    /// Efforts, energies, points, derived quantities.
    Overall,
    /// Joint forces and clearance.
    Joint,
    Velocity,
    Acceleration,
}

const WORTHS: [Worth; 6] = [
    Worth::Asked,
    Worth::Pose,
    Worth::Overall,
    Worth::Joint,
    Worth::Velocity,
    Worth::Acceleration,
];

/// A column for the page.
#[derive(Debug, Clone)]
pub struct Source<'a> {
    pub column: &'a Column,
    pub table: &'a Trajectory,
    /// Its number in `table`.
    pub index: usize,
    /// Rows in which it is smallest and largest.
    pub ends: Option<[usize; 2]>,
    pub worth: Worth,
    /// Offered for plots and tables, or there for the drawing alone.
    pub wanted: bool,
}

impl Source<'_> {
    /// Its value in a row.
    pub fn value(&self, row: usize) -> f64 {
        self.table.row(row)[self.index]
    }
}

/// What of the columns and rows goes in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Plan {
    pub binary64: bool,
    /// Rows, ascending.
    pub rows: Vec<usize>,
    /// From one row to the next, but for those with extremes; and whether all of these are there.
    pub step: usize,
    pub all_extremes: bool,
    /// The least worth that is still in.
    pub worth: Worth,
}

/// Chooses what fits into `room` bytes of text; `heading` is the text that a column's name takes.
pub fn plan(
    sources: &[Source],
    rows: usize,
    room: usize,
    heading: impl Fn(&Source) -> usize,
) -> Plan {
    let (mut count, mut headings) = ([0; WORTHS.len()], [0; WORTHS.len()]);
    for source in sources {
        count[source.worth as usize] += 1;
        headings[source.worth as usize] += heading(source);
    }
    let upto = |sums: &[usize], k: usize| sums[..=k].iter().sum::<usize>();
    // Rows that fit when worths 0..=k go in.
    let fitting = |k: usize, bytes: usize| {
        let free = room.saturating_sub(upto(&headings, k)) / 4 * 3;
        free / (bytes * upto(&count, k).max(1))
    };
    let last = WORTHS.len() - 1;
    let all = |binary64| {
        let rows = (0..rows).collect();
        Plan {
            binary64,
            rows,
            step: 1,
            all_extremes: true,
            worth: WORTHS[last],
        }
    };
    if fitting(last, 8) >= rows {
        return all(true);
    }
    if fitting(last, 4) >= rows {
        return all(false);
    }
    let pose = Worth::Pose as usize;
    let k = (pose..=last)
        .rev()
        .find(|&k| fitting(k, 4) >= rows.min(FEW_ROWS))
        .unwrap_or(pose);
    // Without room for two instants of all poses there is no animation.
    let k = if fitting(k, 4) < rows.min(2) { 0 } else { k };
    let most = fitting(k, 4);
    if most >= rows {
        return Plan {
            worth: WORTHS[k],
            ..all(false)
        };
    }
    let (extremes, all_extremes) = extremes(sources, WORTHS[k], most / 2);
    let mut kept = thinned(rows, most - extremes.len());
    let step = kept.get(1).copied().unwrap_or(rows);
    kept.extend(extremes);
    kept.sort_unstable();
    kept.dedup();
    Plan {
        binary64: false,
        rows: kept,
        step,
        all_extremes,
        worth: WORTHS[k],
    }
}

/// Rows in which columns of no less worth have their extremes, the worthiest first, `most` at most; and whether that is all.
fn extremes(sources: &[Source], least: Worth, most: usize) -> (Vec<usize>, bool) {
    let mut rows: Vec<usize> = Vec::new();
    let worthy = |worth: Worth| {
        sources
            .iter()
            .filter(move |source| source.worth == worth && worth <= least)
    };
    for source in WORTHS.into_iter().flat_map(worthy) {
        for row in source.ends.into_iter().flatten() {
            if !rows.contains(&row) {
                if rows.len() >= most {
                    return (rows, false);
                }
                rows.push(row);
            }
        }
    }
    (rows, true)
}

/// Every k-th of `rows` rows, and the last one, at most `most` in all.
fn thinned(rows: usize, most: usize) -> Vec<usize> {
    if rows <= most {
        return (0..rows).collect();
    }
    if most < 2 {
        return (0..rows.min(most)).collect();
    }
    let step = (rows - 1).div_ceil(most - 1);
    let mut kept: Vec<usize> = (0..rows - 1).step_by(step).collect();
    kept.push(rows - 1);
    kept
}

/// Writes the values of the columns that the plan keeps, one column after the other.
pub fn write_values<'a>(
    sources: impl Iterator<Item = &'a Source<'a>>,
    plan: &Plan,
    out: &mut impl Write,
) -> io::Result<()> {
    let mut numbers = Numbers::new(plan.binary64);
    for source in sources {
        let width = source.table.width();
        let value = |row: &usize| source.table.data[row * width + source.index];
        numbers.extend(plan.rows.iter().map(value));
        numbers.hand_on(out)?;
    }
    out.write_all(numbers.text().as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sources<'a>(table: &'a Trajectory, worths: &[Worth]) -> Vec<Source<'a>> {
        let columns = table.columns.iter().enumerate().zip(worths);
        columns
            .zip(table.extreme_rows())
            .map(|(((index, column), &worth), ends)| Source {
                column,
                table,
                index,
                ends,
                worth,
                wanted: true,
            })
            .collect()
    }

    fn table(rows: usize, columns: usize) -> Trajectory {
        let mut table = Trajectory::new(
            (0..columns)
                .map(|c| Column::new(format!("c{c}"), "m"))
                .collect(),
        );
        table.data = (0..rows * columns).map(|k| k as f64).collect();
        table
    }

    #[test]
    fn with_room_everything_goes_in_as_it_is() {
        let table = table(10, 3);
        let plan = plan(&sources(&table, &[Worth::Asked; 3]), 10, 1000, |_| 5);
        let rows = (0..10).collect();
        let expected = Plan {
            binary64: true,
            rows,
            step: 1,
            all_extremes: true,
            worth: Worth::Acceleration,
        };
        assert_eq!(plan, expected);
    }

    #[test]
    fn what_is_left_out_follows_the_order_and_the_text_fits() {
        use Worth::{Acceleration, Asked, Pose, Velocity};
        let table = table(4000, 6);
        let sources = sources(
            &table,
            &[Asked, Pose, Pose, Velocity, Acceleration, Acceleration],
        );
        let mut seen = Vec::new();
        for room in [300_000, 140_000, 100_000, 18_000, 12_000, 9_000, 300, 20] {
            let plan = plan(&sources, 4000, room, |_| 5);
            let kept: Vec<&Source> = sources
                .iter()
                .filter(|source| source.worth <= plan.worth)
                .collect();
            let mut text = Vec::new();
            write_values(kept.iter().copied(), &plan, &mut text).expect("memory takes it");
            assert!(
                text.len() + 5 * kept.len() <= room.max(30),
                "{room}: {plan:?}"
            );
            assert!(plan.rows.is_empty() || plan.rows[0] == 0);
            assert!(
                plan.rows.len() < 2 || plan.rows.last() == Some(&3999),
                "the last row is kept"
            );
            seen.push((plan.binary64, plan.rows.len() == 4000, kept.len()));
        }
        // Digits go first, then rows, then accelerations, velocities, poses.
        let expected = [
            (true, true, 6),
            (false, true, 6),
            (false, false, 6),
            (false, false, 6),
            (false, false, 4),
            (false, false, 3),
            (false, false, 3),
            (false, false, 1),
        ];
        assert_eq!(seen, expected);
    }

    #[test]
    fn rows_with_extremes_stay() {
        let mut table = table(4000, 3);
        // A peak and a dip where no k-th row is.
        (table.data[3 * 1235 + 1], table.data[3 * 2111 + 2]) = (1e6, -1e6);
        let plan = plan(
            &sources(&table, &[Worth::Asked, Worth::Pose, Worth::Overall]),
            4000,
            12_000,
            |_| 5,
        );
        assert!(
            plan.rows.contains(&1235) && plan.rows.contains(&2111) && plan.all_extremes,
            "{plan:?}"
        );
        assert!(
            plan.rows.len() < 900 && plan.rows.windows(2).all(|pair| pair[0] < pair[1]),
            "{plan:?}"
        );
    }
}
