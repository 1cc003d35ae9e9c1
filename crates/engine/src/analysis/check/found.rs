//! What a diagnosis finds.

use linkdyn_model::AnalysisKind;
use linkdyn_model::error::Complaint;
use linkdyn_output::{Mobility, Status};

/// The analyses that a model may be asked for.
pub const ANALYSES: [AnalysisKind; 5] = [
    AnalysisKind::Kinematics,
    AnalysisKind::InverseDynamics,
    AnalysisKind::Dynamics,
    AnalysisKind::Statics,
    AnalysisKind::QuasiStatics,
];

/// What `check` finds.
#[derive(Debug, Clone, Default)]
pub struct Check {
    /// `Completed` where the model assembles, and its own analysis has a first instant.
    pub status: Status,
    /// Why not.
    pub message: Option<String>,
    /// Moving bodies.
    pub bodies: usize,
    /// All joints.
    pub joints: usize,
    /// Each as the names of its joints.
    pub loops: Vec<String>,
    /// The bodies that each loop goes through, ground left out.
    pub loop_bodies: Vec<Vec<String>>,
    /// The joints of each loop, in order.
    pub loop_joints: Vec<Vec<String>>,
    /// Moving bodies, with x, y, angle of their frames as they assemble [m, m, rad]; `None` if they do not.
    pub poses: Vec<(String, [f64; 3])>,
    /// With ideal pins.
    pub mobility: Mobility,
    /// With journals free in their bearings, where some are.
    pub open: Option<Open>,
    /// What the mobility means for each analysis, in a sentence.
    pub words: String,
    /// Largest constraint residual after assembly, divided by the mechanism's size [–]; NaN where there is none.
    pub assembly_residual: f64,
    /// Why `run` refuses the model's own analysis (exit status 2).
    pub refused: Vec<Complaint>,
    /// What each analysis that can't be run lacks; an analysis that is not listed can be run.
    pub missing: Vec<(AnalysisKind, Vec<String>)>,
    /// The data among that, by what is missing.
    pub lacks: Vec<Lack>,
    /// Allowed, and yet probably a slip.
    pub suspicious: Vec<Complaint>,
    /// What to doubt.
    pub warnings: Vec<String>,
    /// Faults of the model that do not keep it from being read (exit status 1).
    pub faults: Vec<String>,
}

impl Check {
    /// The analyses that can be run, but for the assembly.
    pub fn possible(&self) -> impl Iterator<Item = AnalysisKind> {
        let is_missing = |kind| self.missing.iter().any(|(missing, _)| *missing == kind);
        ANALYSES.into_iter().filter(move |kind| !is_missing(*kind))
    }
}

/// A mechanism whose journals move freely in their bearings.
#[derive(Debug, Clone)]
pub struct Open {
    /// The joints of these journals.
    pub joints: Vec<String>,
    /// Degrees of freedom of the open mechanism.
    pub mobility: Mobility,
}

/// Bodies that lack the same data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lack {
    /// Names of the bodies.
    pub bodies: Vec<String>,
    /// `mass`, `inertia`.
    pub keys: Vec<&'static str>,
    /// The analyses that need it.
    pub analyses: Vec<AnalysisKind>,
}

/// Why a motion is not prescribed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Undriven {
    /// Something is free to move; in words.
    TooFew(String),
    /// Drivers fight each other; in words.
    TooMany(String),
    /// Nothing can start from here.
    Singular(String),
}
