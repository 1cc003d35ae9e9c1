//! Planar multibody engine for linkages.

pub mod error;
pub mod model;
pub mod output;
