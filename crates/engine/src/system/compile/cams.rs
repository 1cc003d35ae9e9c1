//! Cams: the curve that touches, and how the follower is guided.

use super::Compiler;
use crate::element::cam::{Cam, Way};
use crate::element::{BodyId, Marker};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::{Joint, JointKind};

impl Compiler<'_> {
    /// A cam and its follower.
    pub(super) fn cam(&self, name: &str, [cam, follower]: [Marker; 2]) -> Cam {
        let mut made = Cam {
            cam,
            follower,
            touch: self.joints.touches[name].clone(),
            way: self.way(cam.body, follower.body),
            kink: None,
        };
        let before = self.system.joints.iter();
        let before = before.filter(|data| {
            data.extras()
                .cam
                .as_ref()
                .is_some_and(|cam| cam.kink.is_some())
        });
        made.kink = made.has_breaks().then(|| before.count());
        made
    }

    /// How a body is guided, where one joint does it alone beside a cam.
    fn way(&self, cam: BodyId, follower: BodyId) -> Option<Way> {
        if follower == BodyId::GROUND {
            return None;
        }
        let way = |joint: &Joint| {
            let bodies = [0, 1].map(|end: usize| self.body(&joint.between[end].body));
            let own = bodies.iter().position(|&body| body == follower)?;
            if bodies[1 - own] == cam {
                return None;
            }
            match &joint.kind {
                JointKind::Prismatic { axis, .. } => {
                    Some(Way::Slide(bodies[0], unit(Vec2::from(*axis))))
                }
                JointKind::Revolute { .. } => {
                    let pivot = self.marker(&joint.between[own]);
                    Some(Way::Swing(pivot, bodies[1 - own]))
                }
                _ => None,
            }
        };
        let mut ways = self.model.joints.values().filter_map(way);
        ways.next().filter(|_| ways.next().is_none())
    }

    /// How far the profiles of a body reach from its points \[m\].
    pub(super) fn profiles(&self, body: &str) -> f64 {
        let of = |joint: &Joint| match &joint.kind {
            JointKind::Cam(cam) if joint.between[0].body == body => Some(cam.profile.reach()),
            _ => None,
        };
        let reaches = self.model.joints.values().filter_map(of);
        reaches.fold(0.0, f64::max)
    }
}
