//! Planar multibody engine for linkages.

pub mod analysis;
pub mod bundled;
#[doc(hidden)]
pub mod cli;
pub mod error;
pub mod graph;
pub mod model;
pub mod output;
pub mod validation;
