//! Files for other programs.

mod dxf;
mod outline;
mod svg;

pub use dxf::dxf;
pub use outline::{Layer, Sheet, around};
pub use svg::svg;
