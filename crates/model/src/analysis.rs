//! What to compute, and for which instants.

use serde::{Deserialize, Serialize};

/// More rows than anybody can read or store.
pub(super) const MOST_OUTPUTS: usize = 10_000_000;

/// Kind of analysis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum AnalysisKind {
    /// Puts the parts together, nothing more.
    Assembly,
    /// Positions, velocities and accelerations of a driven mechanism.
    Kinematics,
    /// Kinematics, and the forces and torques that this motion needs.
    InverseDynamics,
    /// The motion that forces and masses bring about.
    Dynamics,
    /// Equilibrium.
    Statics,
    /// Equilibrium at every instant of a motion that is so slow that nothing has inertia.
    QuasiStatics,
}

/// Which instants are outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum OutputsAt {
    /// Equally spaced ones.
    #[default]
    Equidistant,
    /// These, and those of located events.
    Events,
}

/// Who solves for the accelerations of forward dynamics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Accelerations {
    /// What costs least.
    #[default]
    Auto,
    /// Small dense matrices of the independent coordinates' tangents.
    Dense,
    /// One sparse matrix of all coordinates and constraints.
    Sparse,
}

/// The wanted analysis.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Analysis {
    /// What is computed.
    #[serde(rename = "type")]
    pub kind: AnalysisKind,
    /// End time \[s\], start is 0.
    pub end: Option<f64>,
    /// Number of equally spaced output instants, both ends included.
    pub outputs: Option<usize>,
    /// Instead of both: outputs equally spaced in a driver's value.
    pub sample: Option<Sample>,
    /// Which instants are outputs: equally spaced ones alone, or those of located events, too.
    #[serde(default)]
    pub outputs_at: OutputsAt,
    /// How it is solved.
    #[serde(default)]
    pub solver: Solver,
    /// Patterns of the result columns to keep; `*` and `?` match the name without its `[unit]`; none means all.
    #[serde(default)]
    pub columns: Vec<String>,
    /// What the report's mechanical advantage and transmission angles are of.
    pub transmission: Option<Transmission>,
}

/// From which driver to which body motion and force are transmitted.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Transmission {
    /// Name of the driver; may be left out where there is only one.
    pub driver: Option<String>,
    /// The driven body: its slide where a prismatic joint holds it to ground, else its angle.
    pub output: String,
}

/// Outputs equally spaced in a driver's value (SI: rad or m).
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Sample {
    /// Name of the driver.
    pub driver: String,
    /// First value.
    pub from: f64,
    /// Last value, always among the outputs.
    pub to: f64,
    /// Spacing; the direction is that from `from` to `to`, the sign does not matter.
    pub step: f64,
}

/// Solver settings; the defaults are right for most models.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(default)]
pub struct Solver {
    /// Method of integration.
    pub method: String,
    /// Who solves for accelerations: by few dense numbers or many sparse ones.
    pub accelerations: Accelerations,
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance, in SI units of each coordinate.
    pub atol: f64,
    /// Longest step \[s\].
    pub max_step: Option<f64>,
    /// First step \[s\].
    pub initial_step: Option<f64>,
    /// Time of the clock on the wall after which to give up \[s\].
    pub max_wall_time: Option<f64>,
}

impl Default for Solver {
    fn default() -> Self {
        Solver {
            method: "auto".into(),
            accelerations: Accelerations::Auto,
            rtol: 1e-6,
            atol: 1e-9,
            max_step: None,
            initial_step: None,
            max_wall_time: None,
        }
    }
}
