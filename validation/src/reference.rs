//! Reference cases: a model, and a table of what it must give.
//!
//! `case.json`:
//!
//! ```text
//! about      a line for people
//! source     who measured, published or computed the reference
//! model      name of a bundled model, or a model itself
//! set        overrides of the model, ["analysis.outputs=11"]; may be left out
//! compare    [{ column, tolerance_relative, tolerance_absolute, verdict }]; may be left out
//! tolerance  { position, velocity, acceleration, force, effort }, one number for all columns of a kind; may be left out
//! ```
//!
//! `reference.csv` has some of the columns of `results.csv`, under the same names, at some of its instants (equal to 1e-9 s); a
//! cell left empty is not compared. `column` is a pattern for names with or without `[unit]`; a column belongs to the first entry that matches, one that
//! none matches is held against [`default_tolerance`]. The tolerance of a value is absolute + relative·max |reference| over its
//! column, since a relative error of a value that passes zero says nothing. `verdict` says what a larger difference is: `fault` (default) or `finding`.
//!
//! A number of `tolerance` is held against columns that no entry of `compare` matches, and means |ours − reference| ≤ tolerance · max(1, max |reference|)
//! in SI units: `position` for m and rad (values of drivers too), `velocity`, `acceleration`, `force` for joint forces, joint
//! torques and energies, `effort` for the efforts of drivers.

use serde::Deserialize;
use serde_json::Value;

use super::table::Table;
use super::{CaseError, Claim, Setting, Verdict};
use linkdyn_engine::analysis;
use linkdyn_model::bundled;
use linkdyn_output::matches;
use linkdyn_output::{Directory, Status, Trajectory, csv};

/// Largest distance of instants that count as the same \[s\].
const SAME_INSTANT: f64 = 1e-9;

/// The files of a reference case.
#[derive(Debug, Clone, Copy)]
pub struct ReferenceCase {
    /// Text of `case.json`.
    pub case: &'static str,
    /// Text of `reference.csv`.
    pub reference: &'static str,
}

/// The words of `case.json`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseWords {
    pub about: String,
    pub source: String,
    pub model: Value,
    #[serde(default)]
    pub set: Vec<String>,
    #[serde(default)]
    pub compare: Vec<Compare>,
    #[serde(default)]
    pub tolerance: Option<Tolerance>,
}

impl CaseWords {
    /// How columns are compared: what `compare` says, then what `tolerance` says.
    pub fn comparisons(&self) -> Vec<Compare> {
        let mut entries = self.compare.clone();
        entries.extend(self.tolerance.iter().flat_map(Tolerance::entries));
        entries
    }
}

/// Tolerances by kind of column, relative to the largest magnitude in the column or 1 SI unit, whichever is more.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerance {
    pub position: f64,
    pub velocity: f64,
    pub acceleration: f64,
    pub force: f64,
    pub effort: f64,
}

impl Tolerance {
    /// One entry per unit, so that each unit's worst value is told.
    fn entries(&self) -> Vec<Compare> {
        let Tolerance {
            position,
            velocity,
            acceleration,
            force,
            effort,
        } = *self;
        let by_column = [
            ("driver.*.effort", effort),
            ("*[m]", position),
            ("*[rad]", position),
            ("*[m/s]", velocity),
            ("*[rad/s]", velocity),
            ("*[m/s^2]", acceleration),
            ("*[rad/s^2]", acceleration),
            ("*[N]", force),
            ("*[N*m]", force),
            ("*[J]", force),
        ];
        let entry = |(column, tolerance): (&str, f64)| Compare {
            column: column.into(),
            tolerance_relative: tolerance,
            tolerance_absolute: 0.0,
            scale_at_least: 1.0,
            verdict: OnDifference::Fault,
        };
        by_column.into_iter().map(entry).collect()
    }
}

/// How some columns are compared.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compare {
    pub column: String,
    #[serde(default)]
    pub tolerance_relative: f64,
    #[serde(default)]
    pub tolerance_absolute: f64,
    /// What the relative tolerance is relative to at least \[SI\].
    #[serde(default)]
    pub scale_at_least: f64,
    #[serde(default)]
    pub verdict: OnDifference,
}

/// What a difference beyond the tolerance is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OnDifference {
    #[default]
    Fault,
    Finding,
}

impl OnDifference {
    fn verdict(self) -> Verdict {
        match self {
            OnDifference::Fault => Verdict::Fault,
            OnDifference::Finding => Verdict::Finding,
        }
    }
}

/// Tolerance of columns that a case says nothing about, by their unit: what inverse dynamics and kinematics must reach
/// against a reference of full double precision.
pub fn default_tolerance(unit: &str) -> Compare {
    let absolute = match unit {
        "m" | "rad" => 1e-9,
        "m/s" | "rad/s" => 1e-8,
        // Accelerations, forces, torques, energies.
        _ => 1e-6,
    };
    Compare {
        column: format!("*[{unit}]"),
        tolerance_relative: 1e-6,
        tolerance_absolute: absolute,
        scale_at_least: 0.0,
        verdict: OnDifference::Fault,
    }
}

impl ReferenceCase {
    /// The words of the case.
    ///
    /// # Errors
    /// When `case.json` is not what it should be.
    pub fn read(&self) -> Result<CaseWords, CaseError> {
        serde_json::from_str(self.case)
            .map_err(|error| CaseError::Broken(format!("case.json: {error}")))
    }

    /// Runs the model and compares.
    ///
    /// # Errors
    /// When the case can't be run, or its results can't be written.
    pub fn run(&self, setting: &Setting) -> Result<Vec<Claim>, CaseError> {
        let words = self.read()?;
        let table = Table::parse(self.reference)
            .map_err(|said| CaseError::Broken(format!("reference.csv: {said}")))?;
        let broken = |complaints: Vec<linkdyn_model::error::Complaint>| {
            let complaints: Vec<String> = complaints.iter().map(ToString::to_string).collect();
            CaseError::Broken(format!("model: {}", complaints.join("; ")))
        };
        let loaded =
            linkdyn_model::load(&model_bytes(&words.model)?, &words.set).map_err(broken)?;
        let outcome = analysis::run(&loaded.model, &setting.control).map_err(broken)?;
        if let Some(output) = &setting.output {
            Directory::open(output)?
                .write_with("results.csv", |file| csv::write(&outcome.trajectory, file))?;
        }
        match outcome.report.status {
            Status::Interrupted => Err(CaseError::Interrupted),
            // A run that stopped early is compared too: the missing instants show.
            Status::Completed
            | Status::CompletedWithGaps
            | Status::DeadCentre
            | Status::AssemblyFailed
            | Status::StepTooSmall
            | Status::Singular
            | Status::TimeLimit => compare(&table, &outcome.trajectory, &words.comparisons())
                .map_err(CaseError::Broken),
        }
    }
}

/// The text of the case's model.
fn model_bytes(model: &Value) -> Result<Vec<u8>, CaseError> {
    match model {
        Value::String(name) => match bundled::find(name) {
            Some(bundled) => Ok(bundled.text.as_bytes().to_vec()),
            None => Err(CaseError::Broken(format!(
                "case.json: no bundled model {name:?}"
            ))),
        },
        model => Ok(model.to_string().into_bytes()),
    }
}

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

    /// What the worst value says; none where nothing was compared.
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
            claims.iter().map(|claim| claim.verdict).collect::<Vec<_>>(),
            [Verdict::Agrees, Verdict::Finding]
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

    #[test]
    fn the_words_of_a_case_are_read() {
        let case = r#"{ "about": "a", "source": "s", "model": "four-bar",
            "compare": [{ "column": "*", "tolerance_relative": 1e-3, "verdict": "finding" }] }"#;
        let words = ReferenceCase {
            case,
            reference: "",
        }
        .read()
        .expect("valid");
        assert_eq!(words.compare[0].verdict, OnDifference::Finding);
        assert!(
            model_bytes(&words.model)
                .expect("bundled")
                .starts_with(b"{")
        );
        let broken = ReferenceCase {
            case: r#"{ "abuot": "a" }"#,
            reference: "",
        }
        .read()
        .expect_err("misspelt");
        assert!(broken.to_string().contains("abuot"), "{broken}");
    }
}
