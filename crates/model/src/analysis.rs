//! What to compute, and for which instants.

use schemars::JsonSchema;
use serde::Deserialize;

use super::schema;

/// More rows than anybody can read or store.
pub(super) const MOST_OUTPUTS: usize = 10_000_000;

/// Kind of analysis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
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
}

/// Which instants are outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OutputsAt {
    /// Equally spaced ones.
    #[default]
    Equidistant,
    /// These, and those of located events.
    Events,
}

/// The wanted analysis.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
pub struct Analysis {
    #[serde(rename = "type")]
    pub kind: AnalysisKind,
    /// End time \[s\], start is 0.
    #[serde(default)]
    #[schemars(schema_with = "schema::time", extend("exclusiveMinimum" = 0))]
    pub end: Option<f64>,
    /// Number of equally spaced output instants, both ends included.
    #[serde(default)]
    #[schemars(schema_with = "schema::count", extend("minimum" = 2, "maximum" = MOST_OUTPUTS))]
    pub outputs: Option<usize>,
    /// Instead of both: outputs equally spaced in a driver's value.
    #[serde(default)]
    #[schemars(with = "Sample")]
    pub sample: Option<Sample>,
    /// Which instants are outputs: equally spaced ones alone, or those of located events, too.
    #[serde(default)]
    pub outputs_at: OutputsAt,
    #[serde(default)]
    pub solver: Solver,
    /// Patterns of the result columns to keep; `*` and `?` match the name without its `[unit]`; none means all.
    #[serde(default)]
    pub columns: Vec<String>,
    /// What the report's mechanical advantage and transmission angles are of.
    #[serde(default)]
    #[schemars(with = "Transmission")]
    pub transmission: Option<Transmission>,
}

/// From which driver to which body motion and force are transmitted.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
pub struct Transmission {
    /// Name of the driver; may be left out where there is only one.
    #[serde(default)]
    #[schemars(with = "String", extend("x-reference" = "driver"))]
    pub driver: Option<String>,
    /// The driven body: its slide where a prismatic joint holds it to ground, else its angle.
    #[schemars(extend("x-reference" = "body"))]
    pub output: String,
}

/// Outputs equally spaced in a driver's value (SI: rad or m).
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[schemars(extend("x-driven" = "driver of this sample"))]
pub struct Sample {
    /// Name of the driver.
    #[schemars(extend("x-reference" = "driver"))]
    pub driver: String,
    /// First value.
    #[schemars(schema_with = "schema::driven")]
    pub from: f64,
    /// Last value, always among the outputs.
    #[schemars(schema_with = "schema::driven")]
    pub to: f64,
    /// Spacing; the direction is that from `from` to `to`, the sign does not matter.
    #[schemars(schema_with = "schema::driven", extend("not" = {"const": 0}))]
    pub step: f64,
}

/// Solver settings; the defaults are right for most models.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Solver {
    /// Method of integration.
    pub method: String,
    /// Relative tolerance.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rtol: f64,
    /// Absolute tolerance, in SI units of each coordinate.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub atol: f64,
    /// Longest step \[s\].
    #[schemars(schema_with = "schema::time", extend("exclusiveMinimum" = 0))]
    pub max_step: Option<f64>,
    /// First step \[s\].
    #[schemars(schema_with = "schema::time", extend("exclusiveMinimum" = 0))]
    pub initial_step: Option<f64>,
    /// Time of the clock on the wall after which to give up \[s\].
    #[schemars(schema_with = "schema::time", extend("exclusiveMinimum" = 0))]
    pub max_wall_time: Option<f64>,
}

impl Default for Solver {
    fn default() -> Self {
        Solver {
            method: "auto".into(),
            rtol: 1e-6,
            atol: 1e-9,
            max_step: None,
            initial_step: None,
            max_wall_time: None,
        }
    }
}
