//! Why a response has no value.

use linkdyn_model::response::Fact;
use linkdyn_output::Status;

/// Why a response has no value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reason {
    /// The run ended before its end.
    Early(Status),
    /// A needed column, by its place among them, has no value at this time.
    Gap(f64, usize),
    /// A needed column, by its place among them, may be empty at single instants, and is where it counts.
    Empty(usize),
    /// The arithmetic has no finite result, at this time or at the end.
    NotFinite(Option<f64>),
    /// It grows without end near this time.
    Endless(f64),
    /// The equation of this reducer never holds.
    NeverReached(usize),
    /// There are no rows, contacts or events for this reducer.
    Nothing(usize),
    /// A contact or event that begins at this time has no such value.
    NoItem(f64),
    /// This run has no such number.
    NoFact(Fact),
}
