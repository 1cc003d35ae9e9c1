//! Inputs: `"inputs": { "torque": "2 N*m" }`, which formulas name as `input.torque` and a program sets while the motion goes on.

use serde::{Deserialize, Serialize};

/// A number from outside: constant in a run, set between the steps of a simulation.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
pub struct ModelInput {
    /// Its value until it is set, in SI.
    pub start: f64,
    /// Its SI unit; empty of a plain number.
    #[serde(default)]
    pub unit: String,
}
