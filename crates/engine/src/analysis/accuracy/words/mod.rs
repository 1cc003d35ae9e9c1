//! The words of a question about accuracy as numbers. No other file of `accuracy` names the model.
//!
//! ```text
//! gears        what gears take from a model
//! names        points, columns and dimensions of a model by name
//! parameters   what parameters do to the dimensions
//! question     what may be off, and what is asked about
//! ```

mod gears;
mod names;
mod parameters;
mod question;

pub use question::{Deviating, Parameters, Refusal, accuracy};
