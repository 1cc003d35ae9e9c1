//! The ends of joints' ways.

use super::Compiler;
use crate::contact::impact::Sense;
use crate::contact::{friction, normal};
use crate::element::journal::Free;
use crate::element::pair::{Compliant, ContactId, Pair, Rigid, Shape, Surface};
use crate::element::stop::{Side, Stop};
use crate::system::{ContactRows, JointId, Origin};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::{Joint, JointKind, Latch, Stops};
use std::sync::Arc;

impl Compiler<'_> {
    /// Stops stand behind all other contacts, and their rows behind all others.
    pub(super) fn add_stops(&mut self) {
        for (k, joint) in self.model.joints.values().enumerate() {
            let limits = joint.stops.limits.unwrap_or_default();
            for (side, limit) in [Side::Lower, Side::Upper].into_iter().zip(limits) {
                if let Some(limit) = limit {
                    self.add_stop((k, joint), side, limit);
                }
            }
        }
    }

    fn add_stop(&mut self, (k, joint): (usize, &Joint), side: Side, limit: f64) {
        let id = ContactId(self.system.contacts.len());
        let [first, second] = [0, 1].map(|end: usize| self.marker(&joint.between[end]));
        let axis = match &joint.kind {
            JointKind::Prismatic { axis, .. } | JointKind::Slot { axis, .. } => {
                Some(unit(Vec2::from(*axis)))
            }
            // The gate lets turning and sliding joints alone have limits.
            JointKind::Revolute { .. }
            | JointKind::Gear { .. }
            | JointKind::Fixed { .. }
            | JointKind::Contact { .. }
            | JointKind::Cam(_)
            | JointKind::Rack { .. }
            | JointKind::Belt { .. }
            | JointKind::Bushing(_) => None,
        };
        let arm = axis.map_or(self.system.size, |_| 1.0);
        let pair = Pair {
            shape: Shape::Stop(Stop {
                first,
                second,
                axis,
                side,
                limit,
                arm,
                size: self.system.size,
            }),
            surface: surface(&joint.stops, arm, side),
        };
        let block = self.system.blocks.len();
        self.push_block(Arc::new(Free), Origin::Stop(id));
        let rows = ContactRows::of(&pair, id, JointId(k), block);
        self.system.contact_rows.push(rows);
        self.system.contacts.push(pair);
        self.system.joints[k].stops.get_or_insert_default()[side.index()] = Some(id);
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
