//! Results held against a reference, column by column.

use super::words::{Compare, default_tolerance};
use crate::table::Table;
use crate::{Claim, Verdict};
use linkdyn_output::{Trajectory, matches};

/// Largest distance of instants that count as the same \[s\].
const SAME_INSTANT: f64 = 1e-9;

/// Columns that are compared alike, and the worst value among them.
struct Group {
    how: Compare,
    values: usize,
    columns: usize,
    worst: Option<Worst>,
}

/// The value with the largest share of its tolerance.
struct Worst {
    column: String,
    time: f64,
    reference: f64,
    ours: f64,
    /// Difference by tolerance; more than 1 is too much.
    share: f64,
}

/// One claim per group of columns: its worst value.
///
/// # Errors
/// When the reference has a column that the results do not have, or no column to compare.
pub fn compare(
    reference: &Table,
    ours: &Trajectory,
    how: &[Compare],
) -> Result<Vec<Claim>, String> {
    let time = reference
        .columns
        .iter()
        .position(|column| column == "time[s]");
    let time = time.ok_or("reference.csv: no column time[s]")?;
    let times = ours
        .values("time[s]")
        .ok_or("the results have no column time[s]")?;
    let rows: Vec<Option<usize>> = reference
        .rows
        .iter()
        .map(|row| same_instant(&times, row[time]))
        .collect();
    let mut groups: Vec<Group> = how.iter().cloned().map(Group::new).collect();
    for (index, label) in reference.columns.iter().enumerate() {
        if index == time {
            continue;
        }
        let our_column = ours
            .column_index(label)
            .filter(|&column| ours.columns[column].label() == *label);
        let our_column = our_column
            .ok_or_else(|| format!("reference.csv: the results have no column {label:?}"))?;
        let group = group_of(&mut groups, label);
        group.columns += 1;
        let values = reference.rows.iter().map(|row| row[index]);
        let scale = values
            .filter(|value| !value.is_nan())
            .fold(group.how.scale_at_least, |scale: f64, value| {
                scale.max(value.abs())
            });
        let tolerance = group.how.tolerance_absolute + group.how.tolerance_relative * scale;
        for (row, &our_row) in reference.rows.iter().zip(&rows) {
            let our_value = our_row.map_or(f64::NAN, |our_row| ours.row(our_row)[our_column]);
            group.meet(label, row[time], row[index], our_value, tolerance);
        }
    }
    let claims: Vec<Claim> = groups.iter().filter_map(Group::claim).collect();
    if claims.is_empty() {
        Err("reference.csv: nothing to compare".into())
    } else {
        Ok(claims)
    }
}

/// Row of the instant, where there is one.
fn same_instant(times: &[f64], time: f64) -> Option<usize> {
    let row = times.partition_point(|&our_time| our_time < time - SAME_INSTANT);
    times
        .get(row)
        .filter(|&&our_time| (our_time - time).abs() <= SAME_INSTANT)
        .map(|_| row)
}

/// The first group whose pattern matches the column, else one for its unit.
fn group_of<'a>(groups: &'a mut Vec<Group>, label: &str) -> &'a mut Group {
    let (name, unit) = label.rsplit_once('[').unwrap_or((label, ""));
    let belongs =
        |group: &Group| matches(&group.how.column, label) || matches(&group.how.column, name);
    let index = groups.iter().position(belongs).unwrap_or_else(|| {
        groups.push(Group::new(default_tolerance(unit.trim_end_matches(']'))));
        groups.len() - 1
    });
    &mut groups[index]
}

impl Group {
    fn new(how: Compare) -> Self {
        Group {
            how,
            values: 0,
            columns: 0,
            worst: None,
        }
    }

    /// Takes one value in; an empty reference cell is not compared, a value that only we lack is infinitely wrong.
    fn meet(&mut self, column: &str, time: f64, reference: f64, ours: f64, tolerance: f64) {
        if reference.is_nan() {
            return;
        }
        self.values += 1;
        let difference = if ours.is_finite() {
            (ours - reference).abs()
        } else {
            f64::INFINITY
        };
        let share = if difference == 0.0 {
            0.0
        } else {
            difference / tolerance
        };
        if self.worst.as_ref().is_none_or(|worst| share > worst.share) {
            self.worst = Some(Worst {
                column: column.to_string(),
                time,
                reference,
                ours,
                share,
            });
        }
    }

    /// What the worst value says; `None` if nothing was compared.
    fn claim(&self) -> Option<Claim> {
        let Worst {
            column,
            time,
            reference,
            ours,
            share,
        } = self.worst.as_ref()?;
        let ours_exists = ours.is_finite();
        Some(Claim {
            what: format!(
                "{column} at {time} s, worst of {} values in {} columns",
                self.values, self.columns
            ),
            reference: format!("{reference}"),
            ours: if ours_exists {
                format!("{ours}")
            } else {
                "no value".into()
            },
            difference: if ours_exists {
                format!("{:.1e} ({share:.1e} of tolerance)", ours - reference)
            } else {
                "–".into()
            },
            verdict: if *share <= 1.0 {
                Verdict::Agrees
            } else {
                self.how.verdict.verdict()
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::words::{OnDifference, Tolerance};
    use super::*;
    use linkdyn_output::Column;

    fn results() -> Trajectory {
        let columns = [
            ("time", "s"),
            ("a.x", "m"),
            ("a.y", "m"),
            ("joint.b.fx", "N"),
        ];
        let mut table = Trajectory::new(
            columns
                .iter()
                .map(|&(name, unit)| Column::new(name, unit))
                .collect(),
        );
        table.push_row(&[0.0, 1.0, 0.0, 100.0]);
        table.push_row(&[0.1, 2.0, 0.0, f64::NAN]);
        table.push_row(&[0.2, 3.0, 0.0, -100.0]);
        table
    }

    fn table(text: &str) -> Table {
        Table::parse(text).expect("a table")
    }

    fn entry(column: &str, relative: f64, verdict: OnDifference) -> Compare {
        Compare {
            column: column.into(),
            tolerance_relative: relative,
            tolerance_absolute: 0.0,
            scale_at_least: 0.0,
            verdict,
        }
    }

    #[test]
    fn the_worst_value_of_each_group_is_named() {
        let reference = table(
            "time[s],a.x[m],a.y[m],joint.b.fx[N]\n0.1,2.0000001,0,\n0.2000000001,3,5e-10,-101\n",
        );
        let claims = compare(&reference, &results(), &[]).expect("compared");
        assert_eq!(claims.len(), 2);
        assert!(
            claims[0]
                .what
                .starts_with("a.y[m] at 0.2000000001 s, worst of 4 values in 2"),
            "{claims:?}"
        );
        assert_eq!(claims[0].verdict, Verdict::Agrees);
        assert_eq!(
            (claims[1].verdict, claims[1].ours.as_str()),
            (Verdict::Fault, "-100")
        );
    }

    #[test]
    fn entries_say_how_and_what_a_difference_is() {
        let reference = table("time[s],a.x[m],joint.b.fx[N]\n0.2,3.1,-101\n");
        let how = [
            entry("*.f?", 0.02, OnDifference::Fault),
            entry("a.x[m]", 0.01, OnDifference::Finding),
        ];
        let claims = compare(&reference, &results(), &how).expect("compared");
        assert_eq!(
            claims
                .iter()
                .map(|claim| claim.verdict.word())
                .collect::<Vec<_>>(),
            ["agrees", "finding"]
        );
    }

    #[test]
    fn a_tolerance_by_kind_is_relative_to_the_column_but_never_below_one() {
        let tolerance = Tolerance {
            position: 1e-3,
            velocity: 0.0,
            acceleration: 0.0,
            force: 1e-3,
            effort: 0.0,
        };
        // 0.0009 off at a scale below 1, 0.099 off at a scale of 100: within; 0.101 off: not.
        for (reference, verdicts) in [
            (
                "time[s],a.y[m],joint.b.fx[N]\n0,0.0009,100.099\n",
                [Verdict::Agrees, Verdict::Agrees],
            ),
            (
                "time[s],a.y[m],joint.b.fx[N]\n0,0.0011,100.102\n",
                [Verdict::Fault, Verdict::Fault],
            ),
        ] {
            let claims =
                compare(&table(reference), &results(), &tolerance.entries()).expect("compared");
            assert_eq!(
                claims.iter().map(|claim| claim.verdict).collect::<Vec<_>>(),
                verdicts,
                "{claims:?}"
            );
        }
    }

    #[test]
    fn missing_instants_and_cells_are_faults() {
        for reference in ["time[s],a.x[m]\n0.15,2\n", "time[s],joint.b.fx[N]\n0.1,0\n"] {
            let claims = compare(&table(reference), &results(), &[]).expect("compared");
            assert_eq!(
                (claims[0].verdict, claims[0].ours.as_str()),
                (Verdict::Fault, "no value"),
                "{reference}"
            );
        }
    }

    #[test]
    fn a_reference_that_can_not_be_compared_is_broken() {
        for (reference, said) in [
            ("a.x[m]\n1\n", "no column time[s]"),
            ("time[s],a.z[m]\n0,1\n", "no column \"a.z[m]\""),
            ("time[s],a.x[rad]\n0,1\n", "no column \"a.x[rad]\""),
            ("time[s],a.x[m]\n0,\n", "nothing to compare"),
        ] {
            let error = compare(&table(reference), &results(), &[]).expect_err(reference);
            assert!(error.contains(said), "{error}");
        }
    }

    #[test]
    fn a_zero_tolerance_is_met_by_equality_alone() {
        let how = [entry("*", 0.0, OnDifference::Fault)];
        let claims = compare(&table("time[s],a.x[m]\n0,1\n"), &results(), &how).expect("compared");
        assert_eq!(claims[0].verdict, Verdict::Agrees);
        let claims =
            compare(&table("time[s],a.x[m]\n0,1.5\n"), &results(), &how).expect("compared");
        assert_eq!(claims[0].verdict, Verdict::Fault);
    }
}
