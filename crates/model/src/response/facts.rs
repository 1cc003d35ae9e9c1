//! What responses may name beside columns: contacts, events, and numbers of the whole run. Names are those of
//! `summary.json`.

use crate::dimension::{Powers, powers};

/// The kinds of events, as `summary.json` names them.
pub const EVENTS: [&str; 13] = [
    "change_point",
    "dead_centre",
    "no_solution",
    "not_converged",
    "self_locking",
    "contact",
    "following",
    "stick",
    "slip",
    "latch",
    "unlatch",
    "close",
    "open",
];

const PLAIN: Powers = powers(0, 0, 0, 0);
const LENGTH: Powers = powers(1, 0, 0, 0);
const TIME: Powers = powers(0, 0, 1, 0);
const VELOCITY: Powers = powers(1, 0, -1, 0);
const FORCE: Powers = powers(1, 1, -2, 0);
const IMPULSE: Powers = powers(1, 1, -1, 0);
const ENERGY: Powers = powers(2, 1, -2, 0);

/// What a list has an entry for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum List {
    /// Each contact, of all joints or of the one with this number.
    Contacts(Option<usize>),
    /// Each event of the kind with this place in [`EVENTS`].
    Events(usize),
    /// Each bin of the wear of the joint with this number.
    Wear(usize),
}

/// What is reported about each entry of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Item {
    /// When it begins \[s\].
    Time,
    /// How long a contact lasts \[s\].
    Duration,
    /// Normal speed towards the bearing \[m/s\].
    ApproachSpeed,
    /// Normal speed away from the bearing \[m/s\].
    SeparationSpeed,
    /// Largest penetration \[m\].
    PeakPenetration,
    /// Largest normal force \[N\].
    PeakForce,
    /// Normal impulse \[N·s\].
    Impulse,
    /// Energy lost \[J\].
    EnergyLost,
    /// What a bin of wear counts \[J\].
    Wear,
}

impl Item {
    /// What is reported about contacts.
    pub const OF_CONTACTS: [Item; 8] = [
        Item::Time,
        Item::Duration,
        Item::ApproachSpeed,
        Item::SeparationSpeed,
        Item::PeakPenetration,
        Item::PeakForce,
        Item::Impulse,
        Item::EnergyLost,
    ];

    /// Its name and dimension.
    pub(crate) fn row(self) -> (&'static str, Powers) {
        match self {
            Item::Time => ("time", TIME),
            Item::Duration => ("duration", TIME),
            Item::ApproachSpeed => ("approach_speed", VELOCITY),
            Item::SeparationSpeed => ("separation_speed", VELOCITY),
            Item::PeakPenetration => ("peak_penetration", LENGTH),
            Item::PeakForce => ("peak_force", FORCE),
            Item::Impulse => ("impulse", IMPULSE),
            Item::EnergyLost => ("energy_lost", ENERGY),
            Item::Wear => ("wear", ENERGY),
        }
    }
}

/// A number of the whole run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fact {
    /// 1 where the run came to its end, else 0.
    Status,
    /// Degrees of freedom by Grübler's count.
    Grubler,
    /// Degrees of freedom by rank.
    Rank,
    /// Steps of the integration, or along the path.
    Steps,
    /// Newton's iterations.
    NewtonIterations,
    /// Largest residual of the constraints.
    ConstraintResidual,
    /// Largest power imbalance.
    PowerImbalance,
    /// Largest drift of energy.
    EnergyDrift,
    /// Largest imbalance of energy with contacts.
    EnergyImbalance,
    /// Largest force that is not balanced in an equilibrium.
    EquilibriumResidual,
    /// A sum over the contacts of the joint with this number.
    Clearance(usize, ClearanceSum),
}

/// A sum over all contacts of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClearanceSum {
    /// How many there are.
    Contacts,
    /// Changes between stick and slip.
    StickSlipChanges,
    /// \[s\]
    TimeInContact,
    /// \[J\]
    EnergyLost,
    /// \[N·s\]
    Impulse,
}

impl Fact {
    /// All but those of joints.
    pub(crate) const OF_RUNS: [Fact; 10] = [
        Fact::Status,
        Fact::Grubler,
        Fact::Rank,
        Fact::Steps,
        Fact::NewtonIterations,
        Fact::ConstraintResidual,
        Fact::PowerImbalance,
        Fact::EnergyDrift,
        Fact::EnergyImbalance,
        Fact::EquilibriumResidual,
    ];

    /// Its name; that of a sum is without its joint.
    pub fn name(self) -> &'static str {
        match self {
            Fact::Status => "status",
            Fact::Grubler => "mobility.grubler",
            Fact::Rank => "mobility.rank",
            Fact::Steps => "statistics.steps",
            Fact::NewtonIterations => "statistics.newton_iterations",
            Fact::ConstraintResidual => "quality.constraint_residual",
            Fact::PowerImbalance => "quality.power_imbalance",
            Fact::EnergyDrift => "quality.energy_drift",
            Fact::EnergyImbalance => "quality.energy_imbalance",
            Fact::EquilibriumResidual => "equilibrium.residual",
            Fact::Clearance(_, sum) => sum.row().0,
        }
    }

    /// Its dimension.
    pub(crate) fn powers(self) -> Powers {
        match self {
            Fact::Clearance(_, sum) => sum.row().1,
            Fact::Status
            | Fact::Grubler
            | Fact::Rank
            | Fact::Steps
            | Fact::NewtonIterations
            | Fact::ConstraintResidual
            | Fact::PowerImbalance
            | Fact::EnergyDrift
            | Fact::EnergyImbalance
            | Fact::EquilibriumResidual => PLAIN,
        }
    }
}

impl ClearanceSum {
    /// Every one.
    pub(crate) const ALL: [ClearanceSum; 5] = [
        ClearanceSum::Contacts,
        ClearanceSum::StickSlipChanges,
        ClearanceSum::TimeInContact,
        ClearanceSum::EnergyLost,
        ClearanceSum::Impulse,
    ];

    /// Its name and dimension.
    pub(crate) fn row(self) -> (&'static str, Powers) {
        match self {
            ClearanceSum::Contacts => ("contacts", PLAIN),
            ClearanceSum::StickSlipChanges => ("stick_slip_changes", PLAIN),
            ClearanceSum::TimeInContact => ("time_in_contact", TIME),
            ClearanceSum::EnergyLost => ("energy_lost", ENERGY),
            ClearanceSum::Impulse => ("impulse", IMPULSE),
        }
    }
}
