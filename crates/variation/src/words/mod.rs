//! The words of a question about accuracy as numbers. No other file of `accuracy` names the model.
//!
//! ```text
//! dimensions   all dimensions of a model, and where they stand
//! gears        what gears take from a model
//! forces       what a question about forces needs, and what it is refused for
//! names        points and columns of a model by name
//! outputs      what is asked about
//! parameters   what parameters do to the dimensions
//! question     all of it put together
//! sources      what may be off
//! ```

mod dimensions;
mod forces;
mod gears;
mod motions;
mod names;
mod outputs;
mod parameters;
mod question;
mod sources;

pub use parameters::{Deviating, Parameters};
pub use question::{Of, Refusal, Scope, accuracy};
