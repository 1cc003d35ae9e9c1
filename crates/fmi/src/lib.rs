//! The library in a functional mock-up unit: co-simulation by FMI 2.0 and 3.0 of the model that lies in the unit's `resources`.
//!
//! ```text
//! importer ──C──► entries     pointers, texts, panics; the only place of `unsafe`
//!                    │
//!                 instance    values of variables, steps, states; `phase`: which calls are legal when
//!                    │
//!                 motion      the simulation, and what was done to it
//!                    │
//!                 linkdyn     Mechanism, Simulation
//! ```
//!
//! Why `unsafe`: the interface is one of C functions that take pointers from the importer, which no other language can check. Each entry
//! turns them into slices and texts, refuses null, and hands over to safe code; a panic ends there, and is told as a fatal status.
//!
//! An instance shares nothing with others: as many as wanted live in a process, each in one thread at a time.

mod entries;
mod instance;
mod motion;
mod phase;
mod refusal;
mod state;
mod uri;

pub use instance::{Instance, Log, Made, Start, Stepped};
pub use refusal::{Refusal, Severity};
pub use state::State;
