//! The words of a model file (`linkdyn/1`): what the user wrote, checked, with every number already in SI units.
//!
//! This module knows names, units and places in a file; it knows no equations. `system::compile` turns it into numbers.

pub mod analysis;
pub mod body;
pub mod clearance;
pub mod driver;
pub mod force;
pub mod joint;

pub use analysis::{Analysis, AnalysisKind, Sample, Solver};
pub use body::{Body, Initial, Pose};
pub use clearance::{Clearance, ClearanceModel};
pub use driver::{Driver, DriverKind, Motion};
pub use force::{Force, ForceKind, Frame, Value};
pub use joint::{Joint, JointKind, PointRef};

use indexmap::IndexMap;

/// The reserved name of the fixed body.
pub const GROUND: &str = "ground";

/// A whole model: order of the maps is the order in the file. All numbers are SI (m, kg, s, rad, N …).
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    pub name: Option<String>,
    pub about: Option<String>,
    pub source: Option<String>,
    /// Acceleration of gravity [m/s²], zero where left out.
    pub gravity: [f64; 2],
    /// All bodies, `ground` among them where the file has it.
    pub bodies: IndexMap<String, Body>,
    pub joints: IndexMap<String, Joint>,
    pub drivers: IndexMap<String, Driver>,
    pub forces: IndexMap<String, Force>,
    pub initial: IndexMap<String, Initial>,
    /// Body points whose motion is wanted among the results.
    pub points: Vec<PointRef>,
    pub analysis: Option<Analysis>,
}
