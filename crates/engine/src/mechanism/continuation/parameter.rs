//! What a path goes by, how it ends, and where it is singular.

use crate::mechanism::driven::Driven;
use crate::system::{Inputs, System};

/// What the path's parameter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// The value of the only driver [rad or m].
    DriverValue,
    /// Time \[s\].
    Time,
    /// The value of the only independent coordinate [rad or m], drivers standing still.
    Coordinate,
}

impl Parameter {
    /// One driver: its value; several or none: time.
    pub fn of(system: &System) -> Self {
        if system.drivers.len() == 1 {
            Parameter::DriverValue
        } else {
            Parameter::Time
        }
    }

    /// Inputs at `s`, derivatives with respect to s.
    pub(super) fn set(self, driven: &mut Driven, s: f64, inputs: &mut Inputs) {
        match self {
            Parameter::DriverValue => inputs.drive[0] = [s, 1.0, 0.0],
            Parameter::Time => inputs.set_time(driven.system, s),
            Parameter::Coordinate => driven.independent[0].jet = [s, 1.0, 0.0],
        }
    }

    /// Prediction error accepted, in rad or mechanism sizes: far below any distance of branches but at their crossings.
    /// Where an integrator asks for values at its own points, nodes must be so near that the polynomial through four of them is the
    /// curve to round-off.
    pub(super) fn prediction(self) -> f64 {
        match self {
            Parameter::DriverValue | Parameter::Time => 1e-6,
            Parameter::Coordinate => 1e-7,
        }
    }

    /// Newton step after which the same factors serve once more, scaled \[–\]: they are made anew at the node in any case.
    pub(super) fn chord(self) -> f64 {
        match self {
            Parameter::DriverValue | Parameter::Time => 0.0,
            Parameter::Coordinate => 1e-6,
        }
    }

    /// Nodes that predict the next one, where there are so many.
    pub(super) fn predictors(self) -> usize {
        match self {
            Parameter::DriverValue | Parameter::Time => 2,
            Parameter::Coordinate => 3,
        }
    }
}

/// Kinds of singular positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SingularKind {
    /// Constraints lose rank, motion goes on.
    ChangePoint,
    /// The driver turns back.
    DeadCentre,
}

/// A located singular position.
#[derive(Debug, Clone, PartialEq)]
pub struct SingularPosition {
    /// What happens there.
    pub kind: SingularKind,
    /// Its parameter.
    pub s: f64,
    /// Left null vector over all rows (m): the self-stress whose multipliers have no bound there. Empty on the path of
    /// an independent coordinate, or where it is not known.
    pub self_stress: Vec<f64>,
}

/// How a path ended on one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// The range is covered.
    Reached,
    /// A dead centre at s.
    DeadCentre {
        /// Value of the path's parameter [rad, m or s].
        s: f64,
    },
    /// No step is small enough at s, and it is no dead centre.
    Stuck {
        /// Value of the path's parameter [rad, m or s].
        s: f64,
    },
    /// Somebody asked to stop.
    Interrupted,
}
