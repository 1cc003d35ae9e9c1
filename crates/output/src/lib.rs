//! Results: the trajectory (columns with name and unit) and the report (why it stopped, counters, events).

pub mod channel;
mod column;
pub mod comparison;
pub mod csv;
mod extremes;
pub mod files;
pub mod read;
mod selection;
pub mod stopwatch;
pub mod summary;
mod trajectory;

pub use channel::{
    BodyQuantity, Channel, DriverQuantity, EnergyQuantity, JointQuantity, LoadQuantity,
    PointQuantity, ShakingQuantity, TransmissionQuantity,
};
pub use column::{Column, ColumnId, ColumnView};
pub use comparison::Comparison;
pub use extremes::Extremes;
pub use files::{Directory, WriteError};
pub use read::Table;
pub use selection::{Selection, matches};
pub use stopwatch::Stopwatch;
pub use summary::Summary;
pub use trajectory::Trajectory;

/// Name of the column that is always first and always kept.
pub const TIME: &str = "time";

/// Why the run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Status {
    #[default]
    Completed,
    CompletedWithGaps,
    DeadCentre,
    AssemblyFailed,
    StepTooSmall,
    Singular,
    TimeLimit,
    Interrupted,
}

/// Something that happened at an instant or over an interval.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Event {
    /// `change_point`, `dead_centre`, `no_solution`, `not_converged`, …
    pub kind: &'static str,
    /// Start \[s\].
    pub time: f64,
    /// End of an interval \[s\].
    pub end_time: Option<f64>,
    pub driver: Option<String>,
    /// Driver value at `time` [rad or m].
    pub value: Option<f64>,
    /// Driver value at `end_time`.
    pub end_value: Option<f64>,
    /// Joint with clearance.
    pub joint: Option<String>,
    /// Of events `contact`.
    pub episode: Option<Episode>,
    /// What a reader should know.
    pub note: Option<String>,
}

/// One time that a journal touches its bearing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Episode {
    /// \[s\]; the end is none where the run ends before.
    pub start: f64,
    pub end: Option<f64>,
    /// Normal speeds towards and away from the bearing's surface [m/s].
    pub approach_speed: f64,
    pub separation_speed: Option<f64>,
    /// \[m\]
    pub peak_penetration: f64,
    /// Largest normal force \[N\].
    pub peak_force: f64,
    /// Normal impulse ∫N dt [N·s].
    pub impulse: f64,
    /// By damping and friction \[J\].
    pub energy_lost: f64,
}

/// A joint's contacts over the whole run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ClearanceSums {
    pub joint: String,
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

/// Degrees of freedom, counted and by rank.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mobility {
    pub grubler: i64,
    pub rank: i64,
    pub drivers: usize,
    /// Joints with constraints that others already impose.
    pub redundant: Vec<String>,
    /// Joints whose reaction is a least-norm choice.
    pub reactions_not_unique: Vec<String>,
}

/// Work done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Statistics {
    pub steps: u64,
    pub rejected: u64,
    pub newton_iterations: u64,
    pub evaluations: u64,
    pub factorisations: u64,
}

/// How good the result is.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Quality {
    /// Largest constraint residual over all outputs, divided by the mechanism's size [–].
    pub constraint_residual: f64,
    /// Largest power imbalance over all outputs, divided by the largest power that flows [–]; none where no forces are computed.
    pub power_imbalance: Option<f64>,
    /// Largest change of kinetic + potential energy over a conservative motion, divided by the largest kinetic energy [–].
    pub energy_drift: Option<f64>,
    /// Largest change of kinetic + potential + contact energy + dissipated − work, divided by the largest of these [–]; of
    /// motions with contacts.
    pub energy_imbalance: Option<f64>,
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
    pub wall: f64,
    pub cpu: f64,
}

/// Everything about a run but its columns.
#[derive(Debug, Clone, Default)]
pub struct Report {
    pub status: Status,
    /// Why a run that did not complete stopped, in a sentence or two; for standard error.
    pub message: Option<String>,
    pub mobility: Mobility,
    pub statistics: Statistics,
    pub quality: Quality,
    /// Of statics alone.
    pub equilibrium: Option<Equilibrium>,
    pub warnings: Vec<String>,
    pub events: Vec<Event>,
    /// Joints with clearance by contact.
    pub clearances: Vec<ClearanceSums>,
    pub assemble: Stage,
    pub solve: Stage,
}
