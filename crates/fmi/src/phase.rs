//! Which calls are legal when.
//!
//! ```text
//! Instantiated ─► Initialization ─► Step ◄─► Event       Reset leads back to the beginning from everywhere
//!                                     └────────┴──► Terminated
//! ```

/// Where an instance is in its life.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// It was made: parameters can be set.
    Instantiated,
    /// The motion is at its beginning, which follows parameters and inputs.
    Initialization,
    /// Steps can be taken.
    Step,
    /// An event is to be acknowledged.
    Event,
    /// The motion is over.
    Terminated,
    /// A fault of linkdyn left it in pieces.
    Broken,
}

impl Phase {
    /// Every one.
    pub const ALL: [Phase; 6] = [
        Phase::Instantiated,
        Phase::Initialization,
        Phase::Step,
        Phase::Event,
        Phase::Terminated,
        Phase::Broken,
    ];

    /// Where inputs can be set.
    pub const BEFORE_THE_END: [Phase; 4] = [
        Phase::Instantiated,
        Phase::Initialization,
        Phase::Step,
        Phase::Event,
    ];

    /// As messages say it.
    pub fn name(self) -> &'static str {
        match self {
            Phase::Instantiated => "before initialization",
            Phase::Initialization => "in initialization mode",
            Phase::Step => "in step mode",
            Phase::Event => "in event mode",
            Phase::Terminated => "after the end of the simulation",
            Phase::Broken => "after a fault of linkdyn",
        }
    }
}
