//! Why a motion can't be followed any further, from the solver that finds it up to the report.

use super::flow::Flow;
use crate::element::pair::ContactId;
use crate::mechanism::failure::Failure;
use linkdyn_output::Reason;
use thiserror::Error;

/// Why a motion can't be followed any further.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum Fault {
    /// The tolerances ask for shorter steps than the time resolves.
    #[error("at t = {t} s the tolerances ask for steps shorter than {h:e} s")]
    TooSmall {
        /// Where \[s\].
        t: f64,
        /// Shorter than this \[s\].
        h: f64,
    },
    /// A step that was taken can't be taken again in parts.
    #[error("the step from t = {t} s can't be divided below {h:e} s")]
    Indivisible {
        /// Its beginning \[s\].
        t: f64,
        /// The shortest part \[s\].
        h: f64,
    },
    /// The formula of the force with this index jumps back and forth.
    #[error("a formula jumps back and forth without end")]
    Chatters {
        /// Index of the force.
        force: usize,
    },
    /// The formula of the force with this index has no value.
    #[error("a formula has no value")]
    NoValue {
        /// Index of the force.
        force: usize,
    },
    /// The joint of this contact closes where its ends do not meet.
    #[error("a joint closes with its ends {} m and {} rad apart", gap[0], gap[1])]
    Apart {
        /// Index of the contact.
        contact: usize,
        /// Gap \[m\] and angle \[rad\].
        gap: [f64; 2],
    },
    /// What this contact would hold is driven on.
    #[error("what closes is driven on at {left} m/s")]
    Driven {
        /// Index of the contact.
        contact: usize,
        /// How fast, at the mechanism's size [m/s].
        left: f64,
    },
    /// A tip is in the material of its outline, and touches it nowhere.
    #[error("a tip is inside its outline without touching it")]
    Inside {
        /// Index of a contact of the outline.
        contact: usize,
    },
    /// The mechanism can't be evaluated.
    #[error(transparent)]
    Unsolved(#[from] Failure),
}

impl Fault {
    /// The same of a step that is taken again.
    pub fn of_part(self) -> Fault {
        match self {
            Fault::TooSmall { t, h } => Fault::Indivisible { t, h },
            Fault::Indivisible { .. }
            | Fault::Chatters { .. }
            | Fault::NoValue { .. }
            | Fault::Apart { .. }
            | Fault::Driven { .. }
            | Fault::Inside { .. }
            | Fault::Unsolved(_) => self,
        }
    }

    /// In parts for the report, of a motion that is known up to `time`.
    pub fn reason(self, flow: &mut Flow, time: f64) -> Reason {
        let residual = match self {
            Fault::Unsolved(
                Failure::Diverged { residual } | Failure::Inconsistent { residual },
            ) => Some(residual),
            Fault::Unsolved(Failure::Singular | Failure::Locked { .. })
            | Fault::TooSmall { .. }
            | Fault::Chatters { .. }
            | Fault::NoValue { .. }
            | Fault::Apart { .. }
            | Fault::Driven { .. }
            | Fault::Inside { .. }
            | Fault::Indivisible { .. } => None,
        };
        let system = flow.system();
        let rows = match self {
            Fault::Unsolved(Failure::Locked { force }) => {
                // Rows that contacts hold may have forces of their own, which are gone with them.
                let own = system.dependent_forces.get(force);
                own.map_or_else(Vec::new, |own| system.blocks[own.block].rows().collect())
            }
            Fault::Unsolved(
                Failure::Singular | Failure::Diverged { .. } | Failure::Inconsistent { .. },
            ) => flow.equations.strained_rows(),
            Fault::TooSmall { .. }
            | Fault::Indivisible { .. }
            | Fault::Chatters { .. }
            | Fault::Apart { .. }
            | Fault::Driven { .. }
            | Fault::Inside { .. }
            | Fault::NoValue { .. } => Vec::new(),
        };
        let owner = |row: &usize| system.origin_name(&system.block_of_row(*row).origin);
        let mut owners: Vec<String> = rows.iter().map(owner).collect();
        owners.dedup();
        if let Fault::Chatters { force } | Fault::NoValue { force } = self {
            owners.push(system.owner(force));
        }
        if let Fault::Apart { contact, .. }
        | Fault::Driven { contact, .. }
        | Fault::Inside { contact } = self
        {
            owners.push(system.contact_name(ContactId(contact)));
        }
        Reason {
            time,
            cause: self.to_string(),
            residual,
            rows,
            owners,
        }
    }
}
