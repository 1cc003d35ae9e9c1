//! What a sustained contact does.

/// A contact that is a constraint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sustained {
    /// First row: the distance of the surfaces.
    pub row: usize,
    /// Its multiplier at the point of the last evaluation \[N\].
    pub normal_force: f64,
    pub grip: Grip,
}

/// What a sustained contact does along the surface.
#[derive(Debug, Clone, Copy)]
pub(super) enum Grip {
    /// It is smooth.
    None,
    /// Its friction is this force that depends on multipliers.
    Slides(usize),
    /// It sticks, by the second row; its multiplier at the point of the last evaluation \[N\].
    Sticks(f64),
}
