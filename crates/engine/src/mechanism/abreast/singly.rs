//! Equations that are evaluated one mechanism after the other.

use crate::element::{BodyId, Constraint, Equations, Kinematics, Pose, Twist};
use crate::motion::Jet;
use linkdyn_linear::math::{Lanes, Vec2, Vector, WIDTH};
use nalgebra::SimdValue;
use std::sync::{Arc, Mutex, PoisonError};

/// The constraints of the mechanisms.
pub struct Singly {
    each: [Arc<dyn Constraint>; WIDTH],
    bodies: Vec<BodyId>,
    room: Mutex<ScalarRoom>,
}

/// What one of them looks at, and what it says.
#[derive(Default)]
struct ScalarRoom {
    poses: Vec<Pose>,
    twists: Vec<Twist>,
    drive: Vec<Jet>,
    values: Vec<f64>,
}

fn one(a: &Vector<Lanes>, lane: usize) -> Vec2 {
    Vec2::new(a.x.extract(lane), a.y.extract(lane))
}

impl Singly {
    pub fn new(each: [Arc<dyn Constraint>; WIDTH]) -> Self {
        let mut bodies: Vec<BodyId> = each[0].entries().iter().map(|entry| entry.1).collect();
        bodies.sort_unstable();
        bodies.dedup();
        Singly {
            each,
            bodies,
            room: Mutex::default(),
        }
    }

    fn evaluate(
        &self,
        at: &Kinematics<Lanes>,
        what: impl Fn(&dyn Constraint, &Kinematics, &mut [f64]),
        values: &mut [Lanes],
    ) {
        let mut room = self.room.lock().unwrap_or_else(PoisonError::into_inner);
        let ScalarRoom {
            poses,
            twists,
            drive,
            values: own,
        } = &mut *room;
        poses.resize(at.poses.len(), Pose::GROUND);
        twists.resize(at.twists.len(), Twist::default());
        drive.resize(at.drive.len(), [0.0; 3]);
        own.resize(values.len(), 0.0);
        for (lane, constraint) in self.each.iter().enumerate() {
            for &BodyId(body) in &self.bodies {
                let (pose, twist) = (&at.poses[body], &at.twists[body]);
                poses[body] = Pose {
                    r: one(&pose.r, lane),
                    theta: pose.theta.extract(lane),
                    cos: pose.cos.extract(lane),
                    sin: pose.sin.extract(lane),
                };
                twists[body] = Twist {
                    v: one(&twist.v, lane),
                    omega: twist.omega.extract(lane),
                };
            }
            for (own, all) in drive.iter_mut().zip(at.drive) {
                *own = all.map(|value| value.extract(lane));
            }
            let of_one = Kinematics {
                poses,
                twists,
                drive,
                offset: &[],
                sides: &[],
                states: &[],
                contacts: &[],
                time: at.time,
            };
            what(&**constraint, &of_one, own);
            for (all, own) in values.iter_mut().zip(&*own) {
                all.replace(lane, *own);
            }
        }
    }
}

impl Equations<Lanes> for Singly {
    fn position(&self, at: &Kinematics<Lanes>, phi: &mut [Lanes]) {
        self.evaluate(at, |one, at, phi| one.position(at, phi), phi);
    }

    fn jacobian(&self, at: &Kinematics<Lanes>, values: &mut [Lanes]) {
        self.evaluate(at, |one, at, values| one.jacobian(at, values), values);
    }

    fn rate(&self, at: &Kinematics<Lanes>, phi_t: &mut [Lanes]) {
        self.evaluate(at, |one, at, phi_t| one.rate(at, phi_t), phi_t);
    }

    fn gamma(&self, at: &Kinematics<Lanes>, gamma: &mut [Lanes]) {
        self.evaluate(at, |one, at, gamma| one.gamma(at, gamma), gamma);
    }
}
