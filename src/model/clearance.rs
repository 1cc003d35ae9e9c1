//! Clearance of a revolute joint: which model, and the parameters of all of them.

/// The rung of the ladder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClearanceModel {
    Ideal,
    MasslessLink,
    TwoState,
    ThreeState,
    Contact,
}

/// Clearance of a revolute joint. Parameters of the models that later versions run are kept as written.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearance {
    pub model: ClearanceModel,
    /// Radial clearance: bearing radius − journal radius [m]; needed by every model but `ideal`.
    pub radius: Option<f64>,
}
