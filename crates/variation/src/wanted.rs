//! What is wanted: an output, and how much of it.

/// How much is asked; each level has those before it, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Levels {
    /// First order, contributions, spread and lost motion.
    First,
    /// And the worst found.
    Worst,
    /// And the certified bound.
    #[default]
    Certified,
}

/// An output that is wanted.
pub(super) struct Wanted<Of> {
    pub name: String,
    pub of: String,
    pub output: Of,
    /// Its unit: `rad`, `m`, `N` or `N*m`.
    pub unit: &'static str,
    /// Driver and its value [rad or m] at the pose; none: all instants.
    pub at: Option<(usize, f64)>,
    /// Allowed deviations, in the unit of the output.
    pub limits: Option<[f64; 2]>,
}
