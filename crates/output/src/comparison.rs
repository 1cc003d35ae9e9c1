//! Results of several runs side by side: the curves of chosen columns, and how far each run is from the first.
//!
//! ```text
//! curves        time, then per column and run `run:column[unit]`       what a figure or a spreadsheet needs
//! differences   per column and run but the first, over the instants that both have:
//!               max |d|, mean |d|, √(mean d²)                          d = run − first
//! ```

use super::{Column, TIME, Trajectory, matches};

/// A run's name, and its table.
#[derive(Debug, Clone, Copy)]
pub struct Run<'a> {
    /// What the run is called.
    pub name: &'a str,
    /// Its table.
    pub trajectory: &'a Trajectory,
}

/// How far a run's column is from the first run's.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Name of the run.
    pub run: String,
    /// The column that is compared.
    pub column: Column,
    /// Instants at which both have a value.
    pub instants: usize,
    /// The numbers over them; none without such an instant.
    pub numbers: Option<Numbers>,
}

/// In the unit of the column, but for the time \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numbers {
    /// Largest |d|.
    pub max: f64,
    /// Time of the largest |d| \[s\].
    pub max_time: f64,
    /// Mean |d|.
    pub mean: f64,
    /// Root of the mean d².
    pub rms: f64,
}

/// Curves and differences.
#[derive(Debug, Clone, Default)]
pub struct Comparison {
    /// The compared columns, as the runs call them.
    pub columns: Vec<Column>,
    /// Time, then per column each run; rows of all runs' instants, empty where a run has no value.
    pub curves: Trajectory,
    /// Column after column, run after run.
    pub differences: Vec<Difference>,
    /// Patterns that match no column.
    pub unmatched: Vec<String>,
}

impl Comparison {
    /// Compares the columns of the first run that match one of `patterns` (`*` any text, `?` one character, names without
    /// `[unit]`), in the order of the patterns.
    ///
    /// Runs are compared at instants that both have: with equally spaced outputs all, as far as both got.
    pub fn new(runs: &[Run], patterns: &[String]) -> Self {
        let Some(first) = runs.first() else {
            return Comparison::default();
        };
        let mut comparison = Comparison::default();
        for pattern in patterns {
            let found = first
                .trajectory
                .columns
                .iter()
                .filter(|c| c.name != TIME && matches(pattern, &c.name));
            let mut found = found.peekable();
            if found.peek().is_none() {
                comparison.unmatched.push(pattern.clone());
            }
            for column in found {
                if !comparison.columns.contains(column) {
                    comparison.columns.push(column.clone());
                }
            }
        }
        comparison.draw(runs);
        for column in &comparison.columns {
            let times = first.trajectory.values(TIME).unwrap_or_default();
            let reference = values_at(first.trajectory, column, &times);
            for run in &runs[1..] {
                let (instants, numbers) = differences(
                    &times,
                    &reference,
                    &values_at(run.trajectory, column, &times),
                );
                let (run, column) = (run.name.to_string(), column.clone());
                comparison.differences.push(Difference {
                    run,
                    column,
                    instants,
                    numbers,
                });
            }
        }
        comparison
    }

    /// Fills the curves.
    fn draw(&mut self, runs: &[Run]) {
        let mut times: Vec<f64> = runs
            .iter()
            .flat_map(|run| run.trajectory.values(TIME).unwrap_or_default())
            .collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let mut columns = vec![Column::new(TIME, "s")];
        let mut values = vec![times.clone()];
        for column in &self.columns {
            for run in runs {
                columns.push(Column::new(
                    format!("{}:{}", run.name, column.name),
                    column.unit,
                ));
                values.push(values_at(run.trajectory, column, &times));
            }
        }
        self.curves = Trajectory::new(columns);
        self.curves.reserve(times.len());
        for row in 0..times.len() {
            let row: Vec<f64> = values
                .iter()
                .map(|values| values.get(row).copied().unwrap_or(f64::NAN))
                .collect();
            self.curves.push_row(&row);
        }
    }
}

/// Values of a column at these times, which stand in order; NaN where the table has no such row.
fn values_at(table: &Trajectory, column: &Column, times: &[f64]) -> Vec<f64> {
    let known = table.values(TIME).unwrap_or_default();
    let Some(values) = table.id_of(column).map(|id| table.column(id)) else {
        return vec![f64::NAN; times.len()];
    };
    let mut next = 0;
    let at = |time: &f64| {
        while known.get(next).is_some_and(|known| known < time) {
            next += 1;
        }
        match known.get(next) {
            Some(known) if known == time => values.get(next).unwrap_or(f64::NAN),
            Some(_) | None => f64::NAN,
        }
    };
    times.iter().map(at).collect()
}

/// Instants with both values, and the numbers over them.
fn differences(times: &[f64], reference: &[f64], values: &[f64]) -> (usize, Option<Numbers>) {
    let differences = times
        .iter()
        .zip(reference.iter().zip(values))
        .map(|(time, (a, b))| (*time, (b - a).abs()));
    let known: Vec<(f64, f64)> = differences
        .filter(|(_, difference)| difference.is_finite())
        .collect();
    let n = known.len() as f64;
    let largest = known
        .iter()
        .copied()
        .reduce(|most, next| if next.1 > most.1 { next } else { most });
    let numbers = largest.map(|(max_time, max)| Numbers {
        max,
        max_time,
        mean: known.iter().map(|(_, difference)| difference).sum::<f64>() / n,
        // Scaled, so that no square overflows.
        rms: if max > 0.0 {
            max * (known.iter().map(|(_, d)| (d / max).powi(2)).sum::<f64>() / n).sqrt()
        } else {
            0.0
        },
    });
    (known.len(), numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rows: &[[f64; 3]]) -> Trajectory {
        let columns =
            [("time", "s"), ("a.x", "m"), ("a.y", "m")].map(|(name, unit)| Column::new(name, unit));
        let mut table = Trajectory::new(columns.to_vec());
        rows.iter().for_each(|row| table.push_row(row));
        table
    }

    fn compare(first: &Trajectory, second: &Trajectory, patterns: &[&str]) -> Comparison {
        let runs = [
            Run {
                name: "ideal",
                trajectory: first,
            },
            Run {
                name: "contact",
                trajectory: second,
            },
        ];
        Comparison::new(
            &runs,
            &patterns
                .iter()
                .map(|pattern| (*pattern).to_string())
                .collect::<Vec<_>>(),
        )
    }

    #[test]
    fn differences_are_those_of_the_instants_that_both_have() {
        let first = table(&[[0.0, 1.0, 0.0], [1.0, 1.0, f64::NAN], [2.0, 1.0, 5.0]]);
        let second = table(&[[0.0, 4.0, 1.0], [1.0, -3.0, 2.0]]);
        let compared = compare(&first, &second, &["a.y", "a.*", "b"]);
        let names: Vec<&str> = compared
            .columns
            .iter()
            .map(|column| column.name.as_str())
            .collect();
        assert_eq!(
            (names, compared.unmatched.as_slice()),
            (vec!["a.y", "a.x"], ["b".to_string()].as_slice())
        );
        let of = |k: usize| {
            (
                compared.differences[k].instants,
                compared.differences[k].numbers.expect("some"),
            )
        };
        let (instants, y) = of(0);
        assert_eq!(
            (instants, y),
            (
                1,
                Numbers {
                    max: 1.0,
                    max_time: 0.0,
                    mean: 1.0,
                    rms: 1.0
                }
            )
        );
        let (instants, x) = of(1);
        assert_eq!((instants, x.max, x.max_time, x.mean), (2, 4.0, 1.0, 3.5));
        assert!((x.rms - 12.5f64.sqrt()).abs() < 1e-15, "{x:?}");
    }

    #[test]
    fn curves_have_the_rows_of_the_longest_run() {
        let compared = compare(
            &table(&[[0.0, 1.0, 0.0]]),
            &table(&[[0.0, 2.0, 0.0], [1.0, 3.0, 0.0]]),
            &["a.x"],
        );
        let labels: Vec<String> = compared.curves.columns.iter().map(Column::label).collect();
        assert_eq!(labels, ["time[s]", "ideal:a.x[m]", "contact:a.x[m]"]);
        assert_eq!(compared.curves.row(0), [0.0, 1.0, 2.0]);
        let last = compared.curves.row(1);
        assert!(
            last[0] == 1.0 && last[1].is_nan() && last[2] == 3.0,
            "{last:?}"
        );
    }

    #[test]
    fn runs_without_rows_have_no_numbers() {
        let compared = compare(&table(&[]), &table(&[[0.0, 2.0, 0.0]]), &["a.x"]);
        assert_eq!(compared.differences[0].numbers, None);
        assert!(Comparison::new(&[], &[]).curves.is_empty());
    }
}
