//! Models as files of other programs.

mod dxf;
pub mod equations;
mod mjcf;
mod outline;
mod svg;

pub use dxf::dxf;
pub use mjcf::mjcf;
pub use outline::{Layer, Sheet, around};
pub use svg::svg;

use crate::source::LeftOut;

/// A model that was written.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Exported {
    /// The text of the file.
    pub text: String,
    /// What of the model it lacks.
    pub left_out: Vec<LeftOut>,
}
