//! Pins that yield: bushings of rubber.

use serde::{Deserialize, Serialize};

use crate::tolerance::Limits;

/// A pin that yields in all directions and holds no constraint.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Bushing {
    /// Force on the second body by how far its point is from the first [N/m].
    pub radial_stiffness: PerAxis,
    /// The same by the rate of that [N·s/m].
    pub radial_damping: PerAxis,
    /// Torque on the second body by its angle in the first [N·m/rad].
    pub torsional_stiffness: f64,
    /// The same by the rate of that [N·m·s/rad].
    pub torsional_damping: f64,
    /// θ₂ − θ₁ at which it exerts no torque \[rad\].
    pub free_angle: f64,
}

/// Two numbers, along x and along y of a body.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(from = "Limits", into = "Limits")]
pub struct PerAxis(pub [f64; 2]);

impl From<Limits> for PerAxis {
    fn from(given: Limits) -> Self {
        PerAxis(match given {
            Limits::One(one) => [one, one],
            Limits::Both(both) => both,
        })
    }
}

impl From<PerAxis> for Limits {
    fn from(PerAxis([x, y]): PerAxis) -> Self {
        if x == y {
            Limits::One(x)
        } else {
            Limits::Both([x, y])
        }
    }
}
