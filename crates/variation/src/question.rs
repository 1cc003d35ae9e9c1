//! What is asked of a system.

use super::corners::Corners;
use super::forces::ForceQuestion;
use super::geometry::Dimensions;
use super::output::Output;
use super::source::Source;
use super::statistics::Pins;
use super::wanted::{Levels, Wanted};
use linkdyn_engine::analysis::instants::OutputInstant;

/// What is asked of a system.
pub(super) struct Question<'q> {
    pub outputs: Vec<Wanted<Output>>,
    pub forces: ForceQuestion<'q>,
    pub sources: Vec<Source>,
    pub dimensions: &'q Dimensions,
    pub pins: Pins,
    pub levels: Levels,
    pub instants: Vec<OutputInstant>,
    /// Bounds of what the steps of parameters leave out (dimensions); `None` if they are not known.
    pub slack: Option<Vec<f64>>,
    /// Steps of the dimensions for deviations of the parameters.
    pub corners: &'q Corners<'q>,
}
