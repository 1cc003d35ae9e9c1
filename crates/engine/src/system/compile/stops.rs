//! The ends of joints' ways, and of the strokes of springs and actuators.

use super::Compiler;
use crate::contact::impact::Sense;
use crate::contact::{friction, normal};
use crate::element::journal::Free;
use crate::element::pair::{Compliant, ContactId, Pair, Rigid, Shape, Surface};
use crate::element::stop::{Side, Stop, Way};
use crate::system::{ContactRows, JointId, Origin, Owner};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::{JointKind, Latch, PointRef, Stops};
use std::sync::Arc;

impl Compiler<'_> {
    /// Stops stand behind all other contacts but outlines, and their rows behind all others.
    pub(super) fn add_stops(&mut self) {
        for (k, joint) in self.model.joints.values().enumerate() {
            let way = match &joint.kind {
                JointKind::Prismatic { axis, .. } | JointKind::Slot { axis, .. } => {
                    Way::Along(unit(Vec2::from(*axis)))
                }
                // The gate lets turning and sliding joints alone have limits.
                JointKind::Revolute { .. }
                | JointKind::Gear { .. }
                | JointKind::Fixed { .. }
                | JointKind::Contact { .. }
                | JointKind::Cam(_)
                | JointKind::Rack { .. }
                | JointKind::Belt { .. }
                | JointKind::Bushing(_) => Way::Turn,
            };
            let owner = Owner::Joint(JointId(k));
            self.add_ends(owner, &joint.between, way, &joint.stops);
        }
        for (k, force) in self.model.forces.values().enumerate() {
            let stroke = &force.stroke;
            let Some(between) = force.kind.ends() else {
                continue;
            };
            let stops = Stops {
                limits: stroke.limits,
                restitution: stroke.restitution,
                stiffness: stroke.stop_stiffness,
                damping: stroke.stop_damping,
                ..Stops::default()
            };
            self.add_ends(Owner::Force(k), between, Way::Apart, &stops);
        }
    }

    /// Stops at the ends that there are.
    fn add_ends(&mut self, owner: Owner, between: &[PointRef; 2], way: Way, stops: &Stops) {
        let limits = stops.limits.unwrap_or_default();
        for (side, limit) in [Side::Lower, Side::Upper].into_iter().zip(limits) {
            let Some(limit) = limit else { continue };
            let id = ContactId(self.system.contacts.len());
            let [first, second] = [0, 1].map(|end: usize| self.marker(&between[end]));
            let arm = if way == Way::Turn {
                self.system.size
            } else {
                1.0
            };
            let pair = Pair {
                shape: Shape::Stop(Stop {
                    first,
                    second,
                    way,
                    side,
                    limit,
                    arm,
                    size: self.system.size,
                }),
                surface: surface(stops, arm, side),
            };
            let block = self.system.blocks.len();
            self.push_block(Arc::new(Free), Origin::Stop(id));
            let rows = ContactRows::of(&pair, id, owner, block);
            self.system.contact_rows.push(rows);
            self.system.contacts.push(pair);
            if let Owner::Joint(joint) = owner {
                let ends = &mut self.system.joints[joint.0].stops;
                ends.get_or_insert_default()[side.index()] = Some(id);
            }
        }
    }
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
            sense: Sense::Kinematic,
            latch: latches.then(|| stops.release.map_or(f64::INFINITY, |pull| pull / arm)),
        }),
    }
}
