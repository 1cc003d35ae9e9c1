//! What questions have in common.

use linkdyn_engine::analysis::Control;

use crate::{ModelFile, Unanswered};

/// A question that can be asked of a model.
pub trait Question {
    /// What it is answered with.
    type Answer;

    /// Answers it; `control` may interrupt it, and sees its progress.
    ///
    /// # Errors
    /// Why it has no answer.
    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Self::Answer, Unanswered>;
}
