//! Models as files of other programs.

mod mjcf;

pub use mjcf::mjcf;

use crate::source::LeftOut;

/// A model that was written.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Exported {
    /// The text of the file.
    pub text: String,
    /// What of the model it lacks.
    pub left_out: Vec<LeftOut>,
}
