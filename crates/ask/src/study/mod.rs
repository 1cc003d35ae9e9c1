//! Studies: many variants of a model, what comes out of each, and what that comes to.

mod display;
mod head;
mod inputs;
mod motions;
mod page;
mod question;
mod sample;
mod sums;
mod text;
mod variants;

use linkdyn_picture::study_page::Variant;
use linkdyn_study::chunks::{ChunkFault, Rows};
use serde::Serialize;

pub use display::Display;
pub use head::Head;
pub use inputs::quantity;
pub use question::{Study, Varied};
pub use sums::{Sums, Totals};
pub use variants::Variants;

/// Where the rows of a study are kept, in chunks.
pub trait Chunks: Sync {
    /// The chunks that are to be computed.
    ///
    /// # Errors
    /// Chunks of another study.
    fn to_do(&self) -> Result<Vec<u64>, ChunkFault>;
    /// The first rows of a chunk, where it was begun.
    fn begun(&self, chunk: u64) -> Rows;
    /// Keeps the first rows of a chunk.
    ///
    /// # Errors
    /// What can't be kept.
    fn keep(&self, chunk: u64, rows: &Rows) -> Result<(), ChunkFault>;
    /// Keeps a whole chunk.
    ///
    /// # Errors
    /// What can't be kept.
    fn finish(&self, chunk: u64, rows: &Rows) -> Result<(), ChunkFault>;
}

/// What a study comes to, as `study.json` says it.
#[derive(Debug, Serialize)]
pub struct Studied {
    /// What the study is.
    #[serde(flatten)]
    pub head: Head,
    /// The units in which it is reported.
    pub display: Display,
    /// What the variants come to.
    #[serde(rename = "summary")]
    pub totals: Totals,
    /// Variants that are drawn.
    #[serde(skip)]
    rows: Vec<Variant>,
}
