//! Bad models and what is said about them: edits of the base model.

use super::{Case, GEAR};

pub mod analysis;
pub mod bodies;
pub mod clearances;
pub mod drivers;
pub mod elastic;
pub mod expressions;
pub mod inputs;
pub mod joints;
pub mod laws;
pub mod parts;
pub mod sections;
pub mod sets;
pub mod slips;
pub mod syntax;
pub mod tolerances;
pub mod words;
pub mod yielding;
