//! The questions that can be asked of a model. Each is a value; its answer is a value that serialises to the JSON of the
//! command, tells itself in words, and makes a page.
//!
//! ```text
//! ModelFile ──► question ──► answer ──► serde: JSON     text(): words     html(): a page
//! ```
//!
//! Nothing here prints, or reads arguments or files: a question is given what it needs ([`ModelFile`]), who may interrupt it
//! (`Control`), and where its rows are kept (`study::Chunks`).

pub mod accuracy;
pub mod allocate;
pub mod assemblies;
pub mod check;
pub mod compare;
pub mod drawing;
pub mod editor;
pub mod hand;
pub mod modes;
pub mod near;
pub mod optimise;
pub mod path_time;
pub mod run;
pub mod shape;
pub mod state_space;
pub mod study;
pub mod synthesise;
pub mod text;

mod broken;
mod model_file;
mod put;
mod question;
mod scatter;
mod unanswered;

pub use broken::caught;
pub use model_file::{ModelFile, Subject, Text, Varying};
pub use put::{Put, read, with_responses};
pub use question::Question;
pub use unanswered::Unanswered;

/// The version that answers.
pub const ENGINE: &str = env!("CARGO_PKG_VERSION");
