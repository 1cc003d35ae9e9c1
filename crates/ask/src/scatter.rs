//! How a parameter scatters by its tolerance.

use linkdyn_model::{Distribution as Words, Tolerance};
use linkdyn_study::distribution::{Distribution, Shape};

use crate::Unanswered;

/// The distribution of a parameter by its tolerance, and its word.
///
/// # Errors
/// Limits that no such distribution has.
pub fn distribution(
    parameter: &str,
    by: &Tolerance,
) -> Result<(Distribution, &'static str), Unanswered> {
    let (shape, word) = match by.distribution {
        Words::Normal { sigma } => (Shape::Normal { sigma }, "normal"),
        Words::Uniform => (Shape::Uniform, "uniform"),
        Words::Triangular => (Shape::Triangular, "triangular"),
    };
    let distribution = Distribution::new(shape, by.lower, by.upper);
    let bad = |fault| Unanswered::question(format!("parameters.{parameter}.tolerance: {fault}"));
    Ok((distribution.map_err(bad)?, word))
}
