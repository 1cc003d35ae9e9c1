//! Contacts that yield and are pressed at rest.

use super::pair::{Compliant, Contact, Pair, Phase, Surface};
use super::{Applied, Force, Kinematics, Slope};
use crate::contact::friction;

/// A contact that yields and is pressed, as a force at rest: N = K δ, to either side.
#[derive(Debug, Clone)]
pub struct Yielding(Pair);

/// It presses whatever its depth.
const PRESSED: Contact = Contact {
    phase: Phase::Contact,
    approach: 0.0,
    piece: 0,
    bristle: 0.0,
    anchor: 0.0,
};

impl Yielding {
    /// A contact by its law across the surface alone; none of rigid surfaces.
    pub fn of(pair: &Pair) -> Option<Yielding> {
        let Surface::Compliant(laws) = &pair.surface else {
            return None;
        };
        let smooth = Compliant {
            friction: friction::Law::None,
            ..laws.clone()
        };
        Some(Yielding(Pair {
            shape: pair.shape.clone(),
            surface: Surface::Compliant(smooth),
        }))
    }
}

impl Force for Yielding {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        self.0.apply(at, &PRESSED, to);
    }

    fn slopes(&self) -> Vec<Slope> {
        self.0.slopes()
    }

    fn slope(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        self.0.slope(at, &PRESSED, position, velocity);
    }

    fn potential(&self, at: &Kinematics) -> f64 {
        let depth = self.0.shape.read(at).penetration;
        self.0.stored(depth.abs(), &PRESSED)
    }

    fn is_conservative(&self) -> bool {
        false
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        -self.0.read(at, &PRESSED).dissipation
    }
}
