//! What is asked for, and answered with.

use crate::analysis::control::Stop;
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_output::{Equilibrium, Status};

/// What is to be linearised, and where.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StateSpaceQuestion {
    /// Inputs: `driver.NAME`, `driver.NAME.acceleration`, `input.NAME`, `force.NAME`, `BODY.POINT.fx`, `BODY.POINT.fy`, `BODY.torque`.
    pub inputs: Vec<String>,
    /// Columns of results, or patterns of them; the minimal coordinates where none are given.
    pub outputs: Vec<String>,
    /// About the assembled position, instead of the equilibrium.
    pub pose: bool,
    /// Instants of the motion of the model's analysis \[s\]; about rest where none are given.
    pub at: Vec<f64>,
}

/// A state, an input or an output, at the point.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// In SI.
    pub unit: String,
    /// Its value at the point.
    pub value: f64,
}

/// The linear system about a point.
#[derive(Debug, Clone, Default)]
pub struct LinearSystem {
    /// When that is \[s\]; at rest `None`.
    pub time: Option<f64>,
    /// The equilibrium, or the pose.
    pub equilibrium: Option<Equilibrium>,
    /// x, with x₀.
    pub states: Vec<Variable>,
    /// w, with w₀.
    pub inputs: Vec<Variable>,
    /// y, with y₀.
    pub outputs: Vec<Variable>,
    /// ẋ at the point: it drifts where that is not zero.
    pub rates: Vec<f64>,
    /// A by rows.
    pub a: Vec<Vec<f64>>,
    /// B by rows.
    pub b: Vec<Vec<f64>>,
    /// C by rows.
    pub c: Vec<Vec<f64>>,
    /// D by rows.
    pub d: Vec<Vec<f64>>,
    /// Largest error that an entry of A, B, C, D may have, in parts of the largest entry of its row \[–\].
    pub errors: [f64; 4],
    /// What contacts do at the point.
    pub phases: Vec<String>,
    /// Eigenvalues of A, slowest first, of a pair that with im > 0 alone [1/s, rad/s].
    pub poles: Vec<[f64; 2]>,
    /// D − C A⁻¹ B; `None` if a pole is zero.
    pub gain: Option<Vec<Vec<f64>>>,
    /// What to doubt.
    pub warnings: Vec<String>,
}

/// Why there is no linear system.
#[derive(Debug, Clone)]
pub enum NoLinearSystem {
    /// The model has faults.
    Model(Complaints),
    /// The question does not fit the model: why.
    Question(String),
    /// The solver cannot continue.
    Failed {
        /// How it ends.
        status: Status,
        /// Why.
        message: String,
    },
}

impl From<Stop> for NoLinearSystem {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Input(complaints) => NoLinearSystem::Model(complaints.into()),
            Stop::Failed { status, message } => NoLinearSystem::Failed { status, message },
        }
    }
}

impl From<Complaints> for NoLinearSystem {
    fn from(complaints: Complaints) -> Self {
        NoLinearSystem::Model(complaints)
    }
}

impl From<Complaint> for NoLinearSystem {
    fn from(complaint: Complaint) -> Self {
        NoLinearSystem::Model(complaint.into())
    }
}
