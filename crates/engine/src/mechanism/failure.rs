//! Why there is no solution from a guess.

use linkdyn_linear::lu::Singular;
use thiserror::Error;

/// Why there is no solution from a guess.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum Failure {
    /// The Jacobian is singular.
    #[error("the Jacobian is singular")]
    Singular,
    /// Newton does not converge; scaled residual.
    #[error("Newton's iteration does not converge, {}", left(*residual))]
    Diverged {
        /// Largest residual, lengths by the mechanism's size [–].
        residual: f64,
    },
    /// The independent constraints are met, the redundant ones are not.
    #[error("the redundant constraints do not hold, residual {residual:e}")]
    Inconsistent {
        /// Largest residual, lengths by the mechanism's size [–].
        residual: f64,
    },
    /// A force that depends on multipliers grows beyond all bounds with them.
    #[error("force {force} grows beyond all bounds with what it depends on")]
    Locked {
        /// Number of the force, among those that depend on constraints.
        force: usize,
    },
}

impl From<Singular> for Failure {
    fn from(_: Singular) -> Self {
        Failure::Singular
    }
}

/// What is left of the constraints, in words where it is no number.
fn left(residual: f64) -> String {
    if residual.is_finite() {
        format!("residual {residual:e}")
    } else {
        "it leaves the range of numbers".into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// "residual NaN" came into summaries.
    #[test]
    fn a_residual_that_is_no_number_is_told_in_words() {
        for (residual, expected) in [
            (2e-3, "Newton's iteration does not converge, residual 2e-3"),
            (
                f64::NAN,
                "Newton's iteration does not converge, it leaves the range of numbers",
            ),
        ] {
            assert_eq!(Failure::Diverged { residual }.to_string(), expected);
        }
    }
}
