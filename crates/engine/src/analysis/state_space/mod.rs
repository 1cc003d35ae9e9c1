//! A mechanism as a linear system, about rest or along a motion.
//!
//! ```text
//! ẋ = f(x, w),  y = h(x, w)       x = (p, ṗ, z | s, ṡ)     w inputs, y columns of results
//! δẋ = A δx + B δw                A = ∂f/∂x, B = ∂f/∂w
//! δy = C δx + D δw                C = ∂h/∂x, D = ∂h/∂w
//! ```
//!
//! p are minimal coordinates and the values of drivers that are let go (see [`crate::mechanism::released`]), z integrated states, and
//! s the values of drivers whose accelerations are inputs. f and h are evaluated to round-off, with all constraints, at places about
//! the point: the derivatives are those of [`crate::mechanism::ridders`], with their errors. ∂ṗ/∂x and what belongs to s are known.
//! What a motion holds at its point is held: phases of contacts, sides of kinks, time.
//!
//! (Kailath, Linear Systems, Prentice-Hall 1980, ch. 2.)

mod inputs;
mod linear;
mod outputs;
mod points;

use super::control::{Control, Stop};
use linkdyn_model::Checked;
use linkdyn_model::error::Complaints;
use linkdyn_output::{Equilibrium, Status};
use points::OperatingPoint;

/// What is to be linearised, and where.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StateSpaceQuestion {
    /// Inputs: `driver.NAME`, `driver.NAME.acceleration`, `force.NAME`, `BODY.POINT.fx`, `BODY.POINT.fy`, `BODY.torque`.
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

/// Linearises a model: once about rest, or at each of the instants, in their order.
///
/// # Errors
/// See [`NoLinearSystem`].
pub fn state_space(
    model: &Checked,
    question: &StateSpaceQuestion,
    control: &Control,
) -> Result<Vec<LinearSystem>, NoLinearSystem> {
    let mut found = Vec::new();
    let mut told = |point: OperatingPoint| {
        found.push(linear::about(model, question, point)?);
        Ok(())
    };
    match question.at.is_empty() {
        true => points::at_rest(model, question.pose, control, &mut told)?,
        false => points::along(model, &question.at, control, &mut told)?,
    }
    let wanted = question.at.iter();
    let order = wanted.filter_map(|time| {
        let mut systems = found.iter();
        systems.find(|system| system.time == Some(*time)).cloned()
    });
    Ok(match question.at.is_empty() {
        true => found,
        false => order.collect(),
    })
}
