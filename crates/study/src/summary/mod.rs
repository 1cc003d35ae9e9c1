//! What many values come to, in one pass and in memory that does not grow with them.
//!
//! Everything merges: the parts of a study are summed up where they are computed, and joined in the order of the variants, so that the
//! digits do not depend on who computed what. Values that are not finite do not exist; they are counted.

mod histogram;
mod indices;
mod moments;
mod quantiles;
mod response;
mod share;
mod sum;
mod tally;

pub use histogram::{Bins, Histogram};
pub use indices::{Index, Indices, SobolIndices};
pub use moments::Moments;
pub use quantiles::{EXACT, Quantiles};
pub use response::{Limits, Response, Summary, TAILS};
pub use share::Share;
pub use tally::Tally;
