//! Friction of ideal joints, from their own reactions.
//!
//! ```text
//! revolute    N = |f|                     v = r (ω₂ − ω₁)      torque r T on the second body
//! prismatic   N = max(|f_n|, 2|τ|/L)      v = u·(Ṗ₂ − Ṗ₁)      force T u on the second body, at its point
//! ```
//!
//! T(v, N; z) by `crate::contact::friction`, against v, and the opposite on the first body. r is the pin's radius; f, f_n and
//! τ are what the joint's constraints carry.
//!
//! * A pin touches along one line, wherever that lies: N = |f| is that of a pin that fits loosely, without the factor 4/π of
//!   one that has run in; the shift of the reaction by the friction circle (r sin arctan μ) is the torque.
//! * A guide of length L, centred at the second body's point, presses with f_n/2 ± τ/L at its ends: N is the sum of both
//!   magnitudes. Without a length the torque is taken for that of a guide so long that it does not press. The guide is
//!   as thin as the line it is: friction on opposite faces has no lever.

use super::prismatic::Guide;
use super::{Applied, BodyId, ConstraintDependentForce, Kinematics};
use crate::contact::friction::Law;
use linkdyn_linear::math::Vec2;

/// Friction of a pin in its hole.
#[derive(Debug, Clone)]
pub struct PinFriction {
    /// The first body.
    pub first: BodyId,
    /// The second body.
    pub second: BodyId,
    /// r \[m\]
    pub radius: f64,
    /// Friction by the sliding velocity.
    pub law: Law,
}

impl PinFriction {
    /// v [m/s]
    fn sliding(&self, at: &Kinematics) -> f64 {
        self.radius * (at.twists[self.second.0].omega - at.twists[self.first.0].omega)
    }
}

impl ConstraintDependentForce for PinFriction {
    fn apply_unit(&self, _at: &Kinematics, to: &mut Applied) {
        to.add(self.first, Vec2::zeros(), -1.0);
        to.add(self.second, Vec2::zeros(), 1.0);
    }

    fn size(&self, at: &Kinematics, memory: f64, lambda: &[f64], slope: &mut [f64]) -> f64 {
        let normal = lambda[0].hypot(lambda[1]);
        let value = self.law.force(self.sliding(at), normal, memory);
        // Without load no direction is meant.
        let per_force = if normal > 0.0 {
            self.radius * value.d_normal / normal
        } else {
            0.0
        };
        slope
            .iter_mut()
            .zip(lambda)
            .for_each(|(slope, lambda)| *slope = per_force * lambda);
        self.radius * value.force
    }

    fn is_straight(&self) -> bool {
        false
    }

    fn reaction(&self, _at: &Kinematics, size: f64) -> (Vec2, f64) {
        (Vec2::zeros(), size)
    }

    fn memory_scale(&self) -> Option<f64> {
        self.law.deflection()
    }

    fn memory_rate(&self, at: &Kinematics, memory: f64) -> f64 {
        self.law.force(self.sliding(at), 0.0, memory).bristle_rate
    }
}

/// Friction of a slider on its guide.
#[derive(Debug, Clone)]
pub struct GuideFriction {
    /// The guide.
    pub guide: Guide,
    /// L \[m\]; `None` if the torque does not press.
    pub length: Option<f64>,
    /// Friction by the sliding velocity.
    pub law: Law,
}

impl GuideFriction {
    /// v [m/s]
    fn sliding(&self, at: &Kinematics) -> f64 {
        let Guide { first, second, .. } = &self.guide;
        self.guide
            .at(at)
            .u
            .dot(&(second.velocity(at) - first.velocity(at)))
    }
}

impl ConstraintDependentForce for GuideFriction {
    fn apply_unit(&self, at: &Kinematics, to: &mut Applied) {
        let u = self.guide.at(at).u;
        to.add_force(at, &self.guide.second, u);
        to.add_force(at, &self.guide.first, -u);
    }

    fn size(&self, at: &Kinematics, memory: f64, lambda: &[f64], slope: &mut [f64]) -> f64 {
        let pressure = [
            lambda[0].abs(),
            self.length
                .map_or(0.0, |length| 2.0 * lambda[1].abs() / length),
        ];
        let value = self
            .law
            .force(self.sliding(at), pressure[0].max(pressure[1]), memory);
        let sign = |x: f64| if x == 0.0 { 0.0 } else { x.signum() };
        slope.fill(0.0);
        match self.length {
            Some(length) if pressure[1] > pressure[0] => {
                slope[1] = value.d_normal * sign(lambda[1]) * 2.0 / length
            }
            _ => slope[0] = value.d_normal * sign(lambda[0]),
        }
        value.force
    }

    fn is_straight(&self) -> bool {
        false
    }

    fn reaction(&self, at: &Kinematics, size: f64) -> (Vec2, f64) {
        (self.guide.at(at).u * size, 0.0)
    }

    fn memory_scale(&self) -> Option<f64> {
        self.law.deflection()
    }

    fn memory_rate(&self, at: &Kinematics, memory: f64) -> f64 {
        self.law.force(self.sliding(at), 0.0, memory).bristle_rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::{Marker, Pose, Twist};

    /// A slider at 30° on the ground's guide, 2 m/s along it, and a body that turns with 5 rad/s.
    fn at<'a>(poses: &'a [Pose; 2], twists: &'a [Twist; 2]) -> Kinematics<'a> {
        Kinematics {
            poses,
            twists,
            drive: &[],
            offset: &[],
            sides: &[],
            states: &[],
            contacts: &[],
            time: 0.0,
        }
    }

    const COULOMB: Law = Law::Coulomb {
        coefficient: 0.2,
        threshold: 0.01,
    };

    #[test]
    fn a_pin_rubs_with_radius_times_its_load() {
        let (poses, twists) = (
            [Pose::GROUND; 2],
            [
                Twist::default(),
                Twist {
                    v: Vec2::zeros(),
                    omega: 5.0,
                },
            ],
        );
        let at = at(&poses, &twists);
        let pin = PinFriction {
            first: BodyId(0),
            second: BodyId(1),
            radius: 0.01,
            law: COULOMB,
        };
        let mut slope = [0.0; 2];
        let size = pin.size(&at, 0.0, &[3.0, -4.0], &mut slope);
        assert!((size + 0.2 * 5.0 * 0.01).abs() < 1e-16, "{size}");
        assert!(
            (slope[0] + 0.002 * 0.6).abs() < 1e-16 && (slope[1] - 0.002 * 0.8).abs() < 1e-16,
            "{slope:?}"
        );
        // The other way round.
        let turned = PinFriction {
            first: BodyId(1),
            second: BodyId(0),
            ..pin
        };
        assert_eq!(turned.size(&at, 0.0, &[-3.0, 4.0], &mut slope), -size);
        assert_eq!(turned.size(&at, 0.0, &[0.0, 0.0], &mut slope), 0.0);
    }

    #[test]
    fn a_guide_rubs_with_both_its_ends() {
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        let along = Vec2::new(cos, sin);
        let poses = [Pose::GROUND, Pose::new(3.0 * cos, 3.0 * sin, 0.0)];
        let twists = [
            Twist::default(),
            Twist {
                v: along * -2.0,
                omega: 0.0,
            },
        ];
        let at = at(&poses, &twists);
        let marker = |body: usize| Marker {
            body: BodyId(body),
            s: Vec2::zeros(),
        };
        let guide = Guide {
            first: marker(0),
            second: marker(1),
            axis: along,
        };
        let size = |length: Option<f64>, lambda: [f64; 2]| {
            let mut slope = [0.0; 2];
            let friction = GuideFriction {
                guide: guide.clone(),
                length,
                law: COULOMB,
            };
            let size = friction.size(&at, 0.0, &lambda, &mut slope);
            // Sizes are homogeneous in λ.
            assert!(
                (slope[0] * lambda[0] + slope[1] * lambda[1] - size).abs() < 1e-14,
                "{slope:?}"
            );
            size
        };
        let close =
            |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-14, "{found} {wanted}");
        close(size(None, [-10.0, 7.0]), 2.0);
        // Ends with −5 ± 0.5/0.2 N both press downwards, with −5 ± 2/0.2 N each on its own side.
        close(size(Some(0.2), [-10.0, 0.5]), 0.2 * (7.5 + 2.5));
        close(size(Some(0.2), [-10.0, -2.0]), 0.2 * (15.0 + 5.0));
        let friction = GuideFriction {
            guide: guide.clone(),
            length: None,
            law: COULOMB,
        };
        let (force, torque) = friction.reaction(&at, 2.0);
        assert_eq!((force, torque), (along * 2.0, 0.0));
    }
}
