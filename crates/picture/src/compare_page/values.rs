//! Rows as compact text: run after run its times and columns.
//!
//! All rows go in while there is room. Else 7 digits instead of 16, then of the outputs only every k-th, the same ones of all
//! runs, so that differences can still be taken; rows in which a column of a run has its extremes stay.

use std::collections::HashSet;

use super::ComparedRun;
use crate::numbers::Numbers;
use linkdyn_output::comparison::Comparison;
use linkdyn_output::{Column, TIME, Trajectory};

/// Bytes of text that values may take, so that the page stays below 5 MB.
const ROOM: usize = 4_300_000;

/// What of the rows goes in.
#[derive(Debug)]
pub struct Chosen {
    pub binary64: bool,
    /// Of each run, ascending.
    pub rows: Vec<Vec<usize>>,
    /// What to say about rows and digits that are not in the page.
    pub notes: Vec<String>,
}

/// Chooses what fits.
pub fn chosen(comparison: &Comparison, columns: &[Column], runs: &[ComparedRun]) -> Chosen {
    chosen_in(comparison, columns, runs, ROOM)
}

fn chosen_in(
    comparison: &Comparison,
    columns: &[Column],
    runs: &[ComparedRun],
    room: usize,
) -> Chosen {
    let width = 1 + columns.len();
    let numbers = |rows: &[Vec<usize>]| width * rows.iter().map(Vec::len).sum::<usize>();
    let fits = |rows: &[Vec<usize>], bytes: usize| numbers(rows) * bytes <= room / 4 * 3;
    let length = |run: &ComparedRun| run.table.map_or(0, Trajectory::len);
    let all: Vec<Vec<usize>> = runs.iter().map(|run| (0..length(run)).collect()).collect();
    for (binary64, bytes) in [(true, 8), (false, 4)] {
        if fits(&all, bytes) {
            let notes = if binary64 {
                vec![]
            } else {
                vec![DIGITS.to_string()]
            };
            return Chosen {
                binary64,
                rows: all,
                notes,
            };
        }
    }
    let outputs = comparison.curves.values(TIME).unwrap_or_default();
    let mut step = 2;
    loop {
        let kept: HashSet<u64> = outputs.iter().step_by(step).map(|t| t.to_bits()).collect();
        let rows: Vec<Vec<usize>> = runs
            .iter()
            .map(|run| thinned(run, columns, &kept))
            .collect();
        if fits(&rows, 4) || step > outputs.len() {
            let thinned = format!(
                "Of the outputs every {step}th is in this page, and those with the smallest and largest values, so that it stays below 5 MB; compare.csv has all."
            );
            return Chosen {
                binary64: false,
                rows,
                notes: vec![thinned, DIGITS.to_string()],
            };
        }
        step *= 2;
    }
}

const DIGITS: &str = "Numbers in this page have 7 digits; compare.csv has all 16.";

/// Rows at these times, and those with extremes.
fn thinned(run: &ComparedRun, columns: &[Column], kept: &HashSet<u64>) -> Vec<usize> {
    let Some(table) = run.table else {
        return Vec::new();
    };
    let times = table.values(TIME).unwrap_or_default();
    let extremes = columns
        .iter()
        .filter_map(|column| table.extremes_of(table.id_of(column)?));
    let peaks: HashSet<u64> = extremes
        .flat_map(|found| [found.min_time.to_bits(), found.max_time.to_bits()])
        .collect();
    let rows = times.iter().enumerate();
    rows.filter(|(_, t)| kept.contains(&t.to_bits()) || peaks.contains(&t.to_bits()))
        .map(|(row, _)| row)
        .collect()
}

/// The text.
pub fn encoded(runs: &[ComparedRun], columns: &[Column], chosen: &Chosen) -> String {
    let mut numbers = Numbers::new(chosen.binary64);
    for (run, rows) in runs.iter().zip(&chosen.rows) {
        let Some(table) = run.table else { continue };
        let times = table.values(TIME).unwrap_or_default();
        numbers.extend(rows.iter().map(|&row| times[row]));
        for column in columns {
            let values = table.id_of(column).map(|id| table.column(id));
            let value = |&row: &usize| values?.get(row);
            numbers.extend(rows.iter().map(|row| value(row).unwrap_or(f64::NAN)));
        }
    }
    numbers.text()
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_output::comparison::Run;

    fn table(scale: f64) -> Trajectory {
        let mut table = Trajectory::new(vec![Column::new(TIME, "s"), Column::new("x", "m")]);
        for row in 0..1000 {
            let peak = if row == 501 { 9.0 } else { 0.0 };
            table.push_row(&[f64::from(row), scale * f64::from(row % 7) + peak]);
        }
        table
    }

    #[test]
    fn thinned_rows_are_the_same_and_have_the_peaks() {
        let tables = [table(1e-3), table(2e-3)];
        let named = [
            Run {
                name: "a",
                trajectory: &tables[0],
            },
            Run {
                name: "b",
                trajectory: &tables[1],
            },
        ];
        let comparison = Comparison::new(&named, &["x".to_string()]);
        let runs: Vec<ComparedRun> = named
            .iter()
            .map(|run| ComparedRun {
                name: run.name,
                status: None,
                ended: String::new(),
                facts: String::new(),
                notes: &[],
                table: Some(run.trajectory),
                events: &[],
            })
            .collect();
        let rows = |room| chosen_in(&comparison, &comparison.columns, &runs, room).rows;
        assert_eq!(rows(ROOM)[0].len(), 1000);
        let few = rows(8000);
        assert!(
            few[0].len() < 400 && few[0].contains(&501),
            "{:?}",
            few[0].len()
        );
        let both = few[0].iter().filter(|row| few[1].contains(row)).count();
        assert!(both >= few[0].len() - 2, "{both}");
        let text = encoded(
            &runs,
            &comparison.columns,
            &chosen_in(&comparison, &comparison.columns, &runs, 8000),
        );
        assert!(text.len() <= 8000, "{}", text.len());
    }
}
