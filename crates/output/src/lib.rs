//! Results: the trajectory (columns with name and unit) and the report (why it stopped, counters, events).

#![warn(missing_docs)]

pub mod channel;
mod column;
pub mod comparison;
pub mod csv;
mod event;
mod extremes;
pub mod files;
pub mod read;
mod read_error;
mod selection;
mod status;
pub mod stopwatch;
pub mod summary;
mod trajectory;
mod unbounded;

pub use channel::StateQuantity;
pub use channel::{
    BodyQuantity, Channel, DriverQuantity, EnergyQuantity, JointQuantity, LoadQuantity,
    PointQuantity, RelativeQuantity, SectionQuantity, ShakingQuantity, TransmissionQuantity,
};
pub use column::{Column, ColumnId, ColumnView};
pub use comparison::Comparison;
pub use event::{Episode, Event, EventKind};
pub use extremes::Extremes;
pub use files::{Directory, WriteError, replace};
pub use read::Table;
pub use selection::{Selection, matches};
pub use status::Status;
pub use stopwatch::Stopwatch;
pub use summary::Summary;
pub use trajectory::Trajectory;
pub use unbounded::Unbounded;

/// Name of the column that is always first and always kept.
pub const TIME: &str = "time";

/// A joint's contacts over the whole run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ClearanceSums {
    /// Name of the joint.
    pub joint: String,
    /// How often the journal touched its bearing.
    pub episodes: u64,
    /// Changes between stick and slip.
    pub switches: u64,
    /// \[s\]
    pub time_in_contact: f64,
    /// \[J\]
    pub energy_lost: f64,
    /// ∫N dt [N·s]
    pub impulse: f64,
    /// ∫N |v_t| dt \[J\] by angle of the contact in the bearing's body: as many equal bins as there are, the first begins at 0.
    pub wear: Vec<f64>,
}

/// What a joint does at one of its stops over the whole run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StopSums {
    /// Name of the joint.
    pub joint: String,
    /// `lower` or `upper`; `contact` of a joint of that kind.
    pub stop: &'static str,
    /// How often it came there.
    pub episodes: u64,
    /// \[s\]
    pub time_in_contact: f64,
    /// \[J\]
    pub energy_lost: f64,
    /// ∫N dt [N·s], of a turning joint [N·m·s].
    pub impulse: f64,
}

impl StopSums {
    /// Nothing yet.
    pub fn of(joint: String, stop: &'static str) -> Self {
        StopSums {
            joint,
            stop,
            episodes: 0,
            time_in_contact: 0.0,
            energy_lost: 0.0,
            impulse: 0.0,
        }
    }
}

/// Degrees of freedom, counted and by rank.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mobility {
    /// By Grübler's count.
    pub grubler: i64,
    /// By the rank of the constraints.
    pub rank: i64,
    /// Number of drivers.
    pub drivers: usize,
    /// Joints with constraints that others already impose.
    pub redundant: Vec<String>,
    /// Joints whose reaction is a least-norm choice.
    pub reactions_not_unique: Vec<String>,
}

/// Work done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Steps of the integration, or along the path.
    pub steps: u64,
    /// Steps that were repeated with a smaller size.
    pub rejected: u64,
    /// Newton's iterations.
    pub newton_iterations: u64,
    /// Evaluations of the equations.
    pub evaluations: u64,
    /// Factorisations of matrices.
    pub factorisations: u64,
}

/// How good the result is.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Quality {
    /// Largest constraint residual over all outputs, divided by the mechanism's size [–].
    pub constraint_residual: f64,
    /// Largest power imbalance over all outputs, divided by the largest power that flows [–]; `None` if no forces are computed.
    pub power_imbalance: Option<f64>,
    /// Largest change of kinetic + potential energy over a conservative motion, divided by the largest kinetic energy [–].
    pub energy_drift: Option<f64>,
    /// Largest change of kinetic + potential + contact energy + dissipated − work, divided by the largest of these [–]; of
    /// motions with contacts.
    pub energy_imbalance: Option<f64>,
    /// Largest force that is left over on a link with a cross-section, divided by the largest sum of those on one [–]; of links with
    /// one.
    pub section_imbalance: Option<f64>,
}

/// What statics found out about its equilibrium.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Equilibrium {
    /// `stable`, `indifferent` or `unstable`.
    pub stability: &'static str,
    /// The coordinates that the stiffness is by, `crank.angle`; `x` and `y` are those of the centre of mass.
    pub coordinates: Vec<String>,
    /// Eigenvalues of the reduced stiffness, ascending [N/m or N·m].
    pub stiffness: Vec<f64>,
    /// Largest force that is not balanced, relative to the largest force and stiffness [–].
    pub residual: f64,
}

/// Wall and process CPU seconds of a stage.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Stage {
    /// By the clock on the wall \[s\].
    pub wall: f64,
    /// Of all cores together \[s\].
    pub cpu: f64,
}

/// Why a motion could not be followed any further.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reason {
    /// Up to where it is known \[s\].
    pub time: f64,
    /// What the solver found.
    pub cause: String,
    /// Largest residual of the constraints, lengths by the mechanism's size, where they could not be met \[–\].
    pub residual: Option<f64>,
    /// Rows of the constraints that take the largest part in it.
    pub rows: Vec<usize>,
    /// What makes these rows, `joint "b"`.
    pub owners: Vec<String>,
}

/// Everything about a run but its columns.
#[derive(Debug, Clone, Default)]
pub struct Report {
    /// How the run ended.
    pub status: Status,
    /// Why a run that did not complete stopped, in a sentence or two; for standard error.
    pub message: Option<String>,
    /// The same in parts, where the equations of a motion were the reason.
    pub reason: Option<Reason>,
    /// Degrees of freedom.
    pub mobility: Mobility,
    /// Work done.
    pub statistics: Statistics,
    /// How good the result is.
    pub quality: Quality,
    /// Of statics alone.
    pub equilibrium: Option<Equilibrium>,
    /// What to doubt.
    pub warnings: Vec<String>,
    /// What happened, by time.
    pub events: Vec<Event>,
    /// Columns without bound.
    pub unbounded: Vec<Unbounded>,
    /// Joints with clearance by contact.
    pub clearances: Vec<ClearanceSums>,
    /// Joints with stops.
    pub stops: Vec<StopSums>,
    /// Time of the assembly.
    pub assemble: Stage,
    /// Time of the analysis.
    pub solve: Stage,
}
