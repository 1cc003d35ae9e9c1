//! The words of a reference case, and how its columns are compared.

use serde::Deserialize;
use serde_json::Value;

use crate::Verdict;

/// The words of `case.json`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseWords {
    /// What it shows, in a line.
    pub about: String,
    /// Who measured or computed it.
    pub source: String,
    /// Name of a bundled model, or a model.
    pub model: Value,
    /// `PATH=VALUE`, put over the model.
    #[serde(default)]
    pub set: Vec<String>,
    /// How columns are compared, one by one.
    #[serde(default)]
    pub compare: Vec<Compare>,
    /// How they are compared by their units.
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
    /// Of lengths and angles.
    pub position: f64,
    /// Of their rates.
    pub velocity: f64,
    /// Of the rates of these.
    pub acceleration: f64,
    /// Of forces, torques and energies.
    pub force: f64,
    /// Of efforts of drivers.
    pub effort: f64,
}

impl Tolerance {
    /// One entry per unit, so that each unit's worst value is reported.
    pub(super) fn entries(&self) -> Vec<Compare> {
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
    /// Name of the column, or a pattern with `*`.
    pub column: String,
    /// Relative to the largest magnitude of the reference [–].
    #[serde(default)]
    pub tolerance_relative: f64,
    /// Added to it \[SI\].
    #[serde(default)]
    pub tolerance_absolute: f64,
    /// What the relative tolerance is relative to at least \[SI\].
    #[serde(default)]
    pub scale_at_least: f64,
    /// What a larger difference is.
    #[serde(default)]
    pub verdict: OnDifference,
}

/// What a difference beyond the tolerance is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OnDifference {
    /// What must hold and does not.
    #[default]
    Fault,
    /// A claim that is not reproduced, without a fault of ours in it.
    Finding,
}

impl OnDifference {
    pub(super) fn verdict(self) -> Verdict {
        match self {
            OnDifference::Fault => Verdict::Fault,
            OnDifference::Finding => {
                Verdict::Finding("What explains it stands in the case's SOURCE.md.")
            }
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
