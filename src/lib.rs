//! Planar multibody engine for linkages.

pub mod analysis;
pub mod bundled;
#[doc(hidden)]
pub mod cli;
pub mod element;
pub mod error;
pub mod graph;
pub mod math;
pub mod model;
pub mod motion;
pub mod output;
pub mod solve;
pub mod system;
pub mod validation;
