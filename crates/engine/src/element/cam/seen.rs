//! What is seen of a cam: where it touches and how, its profile, and whether that can be made.

use super::{Cam, Touch, Way, inverse};
use crate::element::{Kinematics, direction};
use linkdyn_linear::math::{Vec2, perp};

/// What the contact is like at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meeting {
    /// Where it is \[m\].
    pub point: Vec2,
    /// n, global.
    pub normal: Vec2,
    /// Curvature of the profile, positive where it is convex [1/m].
    pub curvature: f64,
    /// From the follower's way to n \[rad\]; `None` if its way is not known.
    pub pressure: Option<f64>,
}

/// A corner of a profile, in the cam's frame from its point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Of the profile, and of the curve of a roller's centre \[m\].
    pub places: [Vec2; 2],
    /// How far along a face from the foot of the cam's point \[m\].
    pub along: f64,
    /// Of the profile [1/m].
    pub curvature: f64,
}

impl Cam {
    /// What the contact is like.
    pub fn meeting(&self, at: &Kinematics) -> Meeting {
        let [cam, follower] = [self.cam.place(at), self.follower.place(at)];
        let (point, normal, curvature, pressed) = match &self.touch {
            Touch::Face { normal, support } => {
                let n = at.poses[self.follower.body.0].turn(*normal);
                let [p, along, bend] = support.jet(self.turned(at), self.held(at));
                let point = cam + n * p + perp(n) * along;
                (point, n, inverse(p + bend), point)
            }
            Touch::Round { radius, curve } => {
                let foot = curve.foot(self.seen(at, follower - cam), self.held(at));
                let n = at.poses[self.cam.body.0].turn(foot.normal);
                let curvature = if curve.is_pitch() {
                    // the profile is parallel to the curve, r below it
                    foot.curvature * inverse(1.0 - foot.curvature * radius)
                } else {
                    foot.curvature
                };
                (follower - n * *radius, n, curvature, follower)
            }
        };
        let way = self.way.and_then(|way| match way {
            Way::Slide(body, axis) => Some(at.poses[body.0].turn(axis)),
            Way::Swing(pivot, _) => direction(perp(pressed - pivot.place(at))).map(|(way, _)| way),
        });
        let pressure = way.map(|way| {
            let way = if way.dot(&normal) < 0.0 { -way } else { way };
            perp(way).dot(&normal).atan2(way.dot(&normal))
        });
        Meeting {
            point,
            normal,
            curvature,
            pressure,
        }
    }

    /// A corner of the profile.
    pub fn corner(&self, u: f64) -> Corner {
        match &self.touch {
            Touch::Face { support, .. } => {
                let (n, [p, along, bend]) = (support.normal(-u), support.jet(-u, None));
                Corner {
                    places: [n * p + perp(n) * along; 2],
                    along,
                    curvature: inverse(p + bend),
                }
            }
            Touch::Round { radius, curve } => {
                let (place, normal, curvature) = curve.corner(u);
                let (places, curvature) = if curve.is_pitch() {
                    let profile = place - normal * *radius;
                    let own = curvature * inverse(1.0 - curvature * radius);
                    ([profile, place], own)
                } else {
                    ([place, place + normal * *radius], curvature)
                };
                Corner {
                    places,
                    along: 0.0,
                    curvature,
                }
            }
        }
    }

    /// Whether the profile can be made, or touched all around by what touches it: where it can't, the parameter of the curve, and
    /// the radius of curvature there \[m\].
    pub fn undercut(&self) -> Option<(f64, f64)> {
        let worst = match &self.touch {
            Touch::Face { support, .. } => support.least_radius(),
            Touch::Round { radius, curve } => curve.least_room(*radius),
        };
        (worst.1 <= 0.0).then_some(worst)
    }
}
