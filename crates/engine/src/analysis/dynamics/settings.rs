//! The settings of a run of forward dynamics.

use crate::analysis::channels::Contents;
use crate::integrate::Method;
use crate::mechanism::reduced::Solver;
use linkdyn_output::Column;

/// How exact a motion shall be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exactness {
    /// Relative tolerance [–].
    pub rtol: f64,
    /// Absolute tolerance, in SI units of each coordinate.
    pub atol: f64,
}

/// The question, in numbers.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Method of integration.
    pub method: Method,
    /// Who solves for accelerations; what costs least where not given.
    pub solver: Option<Solver>,
    /// How exact it shall be.
    pub wanted: Exactness,
    /// First step \[s\]; chosen from the motion where not given.
    pub initial_step: Option<f64>,
    /// Longest step \[s\].
    pub max_step: Option<f64>,
    /// Instants of the outputs, by time \[s\].
    pub instants: Vec<f64>,
    /// Located events are outputs, too.
    pub events_are_outputs: bool,
    /// What is computed.
    pub contents: Contents,
    /// Patterns of the columns whose extremes are looked for between the outputs; an empty list means all columns.
    pub watched: Option<Vec<String>>,
    /// Columns that rows have; all where not given.
    pub kept: Option<Vec<Column>>,
}
