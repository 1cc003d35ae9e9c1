//! An assembled mechanism.

use linkdyn_linear::rank::RankReport;
use linkdyn_output::Mobility;

/// An assembled mechanism.
#[derive(Debug, Clone)]
pub struct Assembled {
    /// Coordinates (n).
    pub q: Vec<f64>,
    /// Rank of the joints' rows.
    pub joints: RankReport,
    /// Of joints and drivers together.
    pub all: RankReport,
    /// Degrees of freedom.
    pub mobility: Mobility,
    /// Newton's iterations that it took.
    pub iterations: u64,
    /// In which direction the way from the drawing reaches it (n, scaled), where it is a singular position that lies elsewhere.
    pub arrival: Option<Vec<f64>>,
    /// What to doubt of it.
    pub warnings: Vec<String>,
}
