//! The ends of joints' ways, and of the strokes of springs and actuators.

use super::Compiler;
use super::contact_parameters::compared;
use crate::contact::impact::Sense;
use crate::contact::{friction, normal};
use crate::element::clasp::Clasp;
use crate::element::journal::Free;
use crate::element::pair::{Compliant, ContactId, Pair, Rigid, Shape, Surface};
use crate::element::stop::{HeldStop, Side, Stop, Travel};
use crate::system::{ContactRows, JointId, LOCK, ONE_WAY, Origin, Owner};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::{JointKind, Latch, OneWay, PointRef, Stops};
use std::sync::Arc;

/// What has an end.
struct StopOwner<'m> {
    owner: Owner,
    between: &'m [PointRef; 2],
    way: Travel,
}

impl Compiler<'_> {
    /// Stops stand behind all other contacts but outlines, and their rows behind all others.
    pub(super) fn add_stops(&mut self) {
        for (k, joint) in self.model.joints.values().enumerate() {
            let end = StopOwner {
                owner: Owner::Joint(JointId(k)),
                between: &joint.between,
                way: way(&joint.kind),
            };
            self.add_ends(&end, &joint.stops);
            if let Some(way) = joint.stops.one_way {
                // What turns forward alone is held against turning back.
                let side = match way {
                    OneWay::Forward => Side::Lower,
                    OneWay::Backward => Side::Upper,
                };
                self.add_stop(&end, (side, ONE_WAY, None), rigid(None));
            }
            if let Some(lock) = &joint.stops.lock {
                let release = lock.release.map(|release| release / self.arm(end.way));
                let material = rigid(Some(release.unwrap_or(f64::INFINITY)));
                let id = self.add_stop(&end, (Side::Upper, LOCK, None), material);
                self.timed.push((id, lock));
            }
            if let Some(active) = &joint.stops.active {
                let id = self.add_clasp(k, active.release);
                self.timed.push((id, active));
            }
        }
        for (k, force) in self.model.forces.values().enumerate() {
            let stroke = &force.stroke;
            let Some(between) = force.kind.ends() else {
                continue;
            };
            let stops = Stops {
                limits: force.limits(),
                restitution: stroke.restitution,
                stiffness: stroke.stop_stiffness,
                damping: stroke.stop_damping,
                ..Stops::default()
            };
            let end = StopOwner {
                owner: Owner::Force(k),
                between,
                way: Travel::Apart,
            };
            self.add_ends(&end, &stops);
        }
    }

    /// L of a way: at which an angle is measured \[m\], or 1 of a length.
    fn arm(&self, way: Travel) -> f64 {
        match way {
            Travel::Turn => self.system.size,
            Travel::Along(_) | Travel::Apart => 1.0,
        }
    }

    /// Stops at the limits that there are.
    fn add_ends(&mut self, end: &StopOwner, stops: &Stops) {
        let limits = stops.limits.unwrap_or_default();
        for (side, limit) in [Side::Lower, Side::Upper].into_iter().zip(limits) {
            if let Some(limit) = limit {
                let material = surface(stops, self.arm(end.way), side);
                self.add_stop(end, (side, side.index(), Some(limit)), material);
            }
        }
    }

    /// A joint that closes and opens as a whole; its rows are those of the joint.
    fn add_clasp(&mut self, k: usize, release: Option<f64>) -> ContactId {
        let id = ContactId(self.system.contacts.len());
        let constraint = self.closed[&k].clone();
        let pair = Pair {
            shape: Shape::Clasp(Clasp {
                constraint,
                size: self.system.size,
            }),
            surface: rigid(Some(release.unwrap_or(f64::INFINITY))),
        };
        let rows = ContactRows::of(&pair, id, Owner::Joint(JointId(k)), Some(k));
        self.system.push_contact(pair, rows);
        self.system.joints[k].change_extras(|extras| extras.clasp = Some(id));
        id
    }

    /// A stop at a limit; without one it holds where the joint is: a lock, or a one-way clutch.
    fn add_stop(
        &mut self,
        end: &StopOwner,
        (side, index, limit): (Side, usize, Option<f64>),
        surface: Surface,
    ) -> ContactId {
        let id = ContactId(self.system.contacts.len());
        let [first, second] = [0, 1].map(|k: usize| self.marker(&end.between[k]));
        let pair = Pair {
            shape: Shape::Stop(Stop {
                first,
                second,
                way: end.way,
                side,
                limit: limit.unwrap_or(0.0),
                arm: self.arm(end.way),
                size: self.system.size,
                kept: limit.is_none().then_some(HeldStop {
                    id,
                    is_lock: index == LOCK,
                }),
            }),
            surface,
        };
        let block = self.system.blocks.len();
        self.push_block(Arc::new(Free), Origin::Stop(id));
        let rows = ContactRows::of(&pair, id, end.owner, Some(block));
        self.system.push_contact(pair, rows);
        if let Owner::Joint(joint) = end.owner {
            self.system.joints[joint.0].change_extras(|extras| {
                extras.stops.get_or_insert_default()[index] = Some(id);
            });
        }
        id
    }
}

/// What of a joint has ends.
fn way(kind: &JointKind) -> Travel {
    // The gate lets turning and sliding joints alone have stops.
    match kind.guide() {
        Some(axis) => Travel::Along(unit(Vec2::from(axis))),
        None => Travel::Turn,
    }
}

/// What has neither rebound nor friction; where it latches, with the pull that it holds.
fn rigid(latch: Option<f64>) -> Surface {
    Surface::Rigid(Rigid {
        restitution: 0.0,
        friction: 0.0,
        sense: Sense::Kinematic,
        latch,
    })
}

/// What stops are made of; stiffness and damping are by the square of the arm at which an angle is measured.
fn surface(stops: &Stops, arm: f64, side: Side) -> Surface {
    let latches = stops.latch.map_or([false; 2], Latch::sides)[side.index()];
    match stops.stiffness {
        Some(stiffness) => Surface::Compliant(Compliant {
            normal: normal::Law::KelvinVoigt {
                stiffness: stiffness / (arm * arm),
                damping: stops.damping.unwrap_or(0.0) / (arm * arm),
            },
            friction: friction::Law::None,
        }),
        None => Surface::Rigid(Rigid {
            restitution: stops.restitution.unwrap_or(0.0),
            friction: 0.0,
            sense: stops.sense.map_or(Sense::Kinematic, compared),
            latch: latches.then(|| stops.release.map_or(f64::INFINITY, |pull| pull / arm)),
        }),
    }
}
