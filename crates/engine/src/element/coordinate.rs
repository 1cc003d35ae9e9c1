//! A coordinate of a body's frame held at a value: how `initial` values enter the assembly.
//!
//! ```text
//! φ = c + f − (x_O, y_O or θ),   O the frame's origin     (1)  [m or rad]
//! ```
//!
//! with f of a driver that leads it from where it is drawn, if there is one.

use super::algebra::{Algebraic, LinearForm};
use super::driven::DriveId;
use super::{Axis, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope};
use crate::motion::Jet;
use linkdyn_linear::bilinear::Number;
use linkdyn_linear::math::Vec2;

/// One coordinate of a body at a value.
#[derive(Debug, Clone)]
pub struct Coordinate {
    /// The frame's origin as a point of the body.
    pub origin: Marker,
    /// Which coordinate.
    pub axis: Axis,
    /// Its value \[m or rad\].
    pub value: f64,
    /// The driver of which the value is added.
    pub drive: Option<DriveId>,
}

impl Coordinate {
    /// f, f′, f″.
    fn driven(&self, at: &Kinematics) -> Jet {
        self.drive.map_or([0.0; 3], |drive| at.drive[drive.0])
    }

    /// How far it is from its value, of which nothing is added.
    pub fn off(&self, at: &Kinematics) -> f64 {
        let place = self.origin.place(at);
        self.value
            - match self.axis {
                Axis::X => place.x,
                Axis::Y => place.y,
                Axis::Theta => at.poses[self.origin.body.0].theta,
            }
    }
}

impl Equations for Coordinate {
    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        phi[0] = self.off(at) + self.driven(at)[0];
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        let rho = self.origin.rho(at);
        match self.axis {
            Axis::X => values.copy_from_slice(&[-1.0, rho.y]),
            Axis::Y => values.copy_from_slice(&[-1.0, -rho.x]),
            Axis::Theta => values[0] = -1.0,
        }
    }

    fn rate(&self, at: &Kinematics, phi_t: &mut [f64]) {
        phi_t[0] = self.driven(at)[1];
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let turn = self.origin.centripetal(at);
        gamma[0] = match self.axis {
            Axis::X => turn.x,
            Axis::Y => turn.y,
            Axis::Theta => 0.0,
        } - self.driven(at)[2];
    }
}

impl Constraint for Coordinate {
    fn rows(&self) -> &'static [Measure] {
        match self.axis {
            Axis::X | Axis::Y => &[Measure::Length],
            Axis::Theta => &[Measure::Angle],
        }
    }

    fn entries(&self) -> Vec<Entry> {
        let body: BodyId = self.origin.body;
        match self.axis {
            Axis::X | Axis::Y => vec![(0, body, self.axis), (0, body, Axis::Theta)],
            Axis::Theta => vec![(0, body, Axis::Theta)],
        }
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        vec![[(self.origin.body, Axis::Theta); 2]]
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let rho = self.origin.rho(at);
        let along = match self.axis {
            Axis::X => rho.x,
            Axis::Y => rho.y,
            Axis::Theta => 0.0,
        };
        values[0] = lambda[0] * along;
    }

    fn is_linear(&self, _row: usize) -> bool {
        self.axis == Axis::Theta
    }

    fn algebra(&self, drive: &[Jet]) -> Vec<Algebraic> {
        let value = self.value + self.drive.map_or(0.0, |own| drive[own.0][0]);
        let off = |at: Number| {
            LinearForm::point(self.origin.body, self.origin.s).minus(LinearForm::constant(at))
        };
        vec![match self.axis {
            Axis::X => Algebraic::Real(off(Number::new(value, 0.0))),
            Axis::Y => Algebraic::Imaginary(off(Number::new(0.0, value))),
            Axis::Theta => Algebraic::tied(BodyId::GROUND, self.origin.body, value),
        }]
    }

    fn reaction(&self, _at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        match self.axis {
            Axis::X => (Vec2::new(lambda[0], 0.0), 0.0),
            Axis::Y => (Vec2::new(0.0, lambda[0]), 0.0),
            Axis::Theta => (Vec2::zeros(), lambda[0]),
        }
    }
}
