//! What to compute, and for which instants.

/// Kind of analysis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnalysisKind {
    Assembly,
    Kinematics,
    InverseDynamics,
    Dynamics,
    Statics,
}

/// The wanted analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    pub kind: AnalysisKind,
    /// End time [s], start is 0.
    pub end: Option<f64>,
    /// Number of equally spaced output instants, both ends included.
    pub outputs: Option<usize>,
    /// Instead of both: outputs equally spaced in a driver's value.
    pub sample: Option<Sample>,
    pub solver: Solver,
    /// Patterns of the result columns to keep; none means all.
    pub columns: Vec<String>,
}

/// Outputs equally spaced in a driver's value (SI: rad or m).
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    pub driver: String,
    pub from: f64,
    pub to: f64,
    pub step: f64,
}

/// Solver settings; the defaults are right for most models.
#[derive(Debug, Clone, PartialEq)]
pub struct Solver {
    pub method: String,
    pub rtol: f64,
    /// In SI units of each coordinate.
    pub atol: f64,
    /// [s]
    pub max_step: Option<f64>,
    /// [s]
    pub initial_step: Option<f64>,
    /// [s]
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
