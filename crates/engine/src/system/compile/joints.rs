//! Joints: the constraints of the ideal ones, journals in bearings, friction.

use super::needs::bearing;
use super::{Compiler, roles};
use crate::element::beam::Beam;
use crate::element::belt::Belt;
use crate::element::bushing::Bushing;
use crate::element::cam::Cam;
use crate::element::fixed::Fixed;
use crate::element::joint_friction::{GuideFriction, PinFriction};
use crate::element::journal::{Bearing, Free, Journal};
use crate::element::pair::{ContactId, Pair, Shape};
use crate::element::prismatic::{Guide, Prismatic};
use crate::element::revolute::{OffsetId, Revolute};
use crate::element::rolling::Rolling;
use crate::element::slot::Slot;
use crate::element::{Constraint, ConstraintDependentForce, Marker, Measure};
use crate::system::{
    ClearanceLink, ContactRows, DependentForce, JointData, JointFriction, JointId, Origin, Owner,
};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::{Clearance, ClearanceModel, GROUND, Joint, JointKind};
use std::sync::Arc;

/// A point is on a line where it is no further off, in parts of its distance.
const ON_LINE: f64 = 1e-4;

/// What a joint becomes.
pub(super) struct Made {
    constraint: Arc<dyn Constraint>,
    /// The same, of an ideal pin.
    pin: Option<Arc<Revolute>>,
    /// Whether it carries a torque.
    torque: bool,
    link: Option<ClearanceLink>,
    contact: Option<ContactId>,
    pub(super) belt: Option<Box<Belt>>,
    pub(super) bushing: Option<Box<Bushing>>,
    pub(super) beam: Option<Box<Beam>>,
    cam: Option<Arc<Cam>>,
}

impl Made {
    pub(super) fn of(constraint: Arc<dyn Constraint>, torque: bool) -> Made {
        Made {
            constraint,
            pin: None,
            torque,
            link: None,
            contact: None,
            belt: None,
            bushing: None,
            beam: None,
            cam: None,
        }
    }
}

impl Compiler<'_> {
    pub(super) fn add_joints(&mut self) {
        let model = self.model;
        self.system.joints.reserve_exact(model.joints.len());
        for (k, (name, joint)) in model.joints.iter().enumerate() {
            let points = [0, 1].map(|side: usize| self.marker(&joint.between[side]));
            let made = match &joint.kind {
                JointKind::Belt { .. } => self.belt(name, joint, points),
                kind => self.joint(k, name, kind, points),
            };
            let friction = self.friction(k, name, &joint.kind, points);
            let role = roles::joint_role(&joint.kind);
            let mut data = match made.pin {
                Some(pin) => JointData::pin(name, pin),
                None => JointData::of(name, role, points, made.torque),
            };
            data.change_extras(|extras| {
                extras.clearance = made.link;
                extras.contact = made.contact;
                extras.cam = made.cam;
                extras.bearing = joint.kind.clearance().map(bearing);
                extras.drawn = self.drawn_slot(joint);
                extras.friction = friction;
                extras.belt = made.belt;
                extras.bushing = made.bushing;
                extras.beam = made.beam;
            });
            self.system.joints.push(data);
            let mut constraint = made.constraint;
            if let Some(active) = &joint.stops.active {
                self.closed.insert(k, constraint.clone());
                if active.from.is_some() {
                    constraint = Arc::new(Free);
                }
            }
            self.push_block(constraint, Origin::Joint(JointId(k)));
        }
    }

    /// The stretch of a slot without limits that its body's points on its line draw; `None` if there is but one.
    fn drawn_slot(&self, joint: &Joint) -> Option<Box<[f64; 2]>> {
        let own = &joint.between[0];
        let JointKind::Slot { axis, .. } = &joint.kind else {
            return None;
        };
        // Points of the ground stand for all that is there.
        if own.body == GROUND || joint.stops.limits.is_some() {
            return None;
        }
        let axis = unit(Vec2::from(*axis));
        let points = &self.model.bodies[&own.body].points;
        let origin = Vec2::from(points[&own.point]);
        let places = points.values().map(|place| Vec2::from(*place) - origin);
        let on_line = places.filter(|place| place.perp(&axis).abs() <= ON_LINE * place.norm());
        let slides = on_line.map(|place| place.dot(&axis));
        let [low, high] = slides.fold([0.0_f64; 2], |[low, high], s| [low.min(s), high.max(s)]);
        (low < high).then(|| Box::new([low, high]))
    }

    fn joint(&mut self, k: usize, name: &str, kind: &JointKind, points: [Marker; 2]) -> Made {
        let [first, second] = points;
        let guide = |axis: &[f64; 2]| Guide {
            first,
            second,
            axis: unit(Vec2::from(*axis)),
        };
        let mut cam = None;
        let (constraint, torque): (Arc<dyn Constraint>, bool) = match kind {
            JointKind::Revolute { clearance, .. } => {
                return self.revolute(k, name, clearance.as_deref(), points);
            }
            JointKind::Prismatic { axis, angle, .. } => {
                let (guide, angle) = (guide(axis), *angle);
                (Arc::new(Prismatic { guide, angle }), true)
            }
            JointKind::Slot { axis, .. } => (Arc::new(Slot { guide: guide(axis) }), false),
            JointKind::Gear { ratio, angle, .. } => {
                let carrier = &self.joints.carriers[name];
                (Arc::new(self.gear(points, *ratio, *angle, carrier)), true)
            }
            // Its rows come into force where it touches.
            JointKind::Contact { .. } => (Arc::new(Free), false),
            JointKind::Cam(_) => {
                let made = Arc::new(self.cam(name, points));
                cam = Some(made.clone());
                let torque = made.is_face();
                (made, torque)
            }
            JointKind::Rack {
                axis,
                radius,
                offset,
            } => (Arc::new(self.rack(points, *axis, *radius, *offset)), true),
            JointKind::Rolling { radii, offset } => {
                let drawn = Rolling {
                    first,
                    second,
                    radii: *radii,
                    offset: 0.0,
                };
                let offset = offset.unwrap_or_else(|| self.as_drawn(|at| drawn.rolled(at)));
                (Arc::new(Rolling { offset, ..drawn }), true)
            }
            JointKind::Bushing(given) => return Made::bushing(given, points),
            JointKind::Beam(given) => return self.beam(given, points),
            // The caller has taken belts.
            JointKind::Belt { .. } => (Arc::new(Free), true),
            JointKind::Fixed { angle } => {
                let angle = *angle;
                let weld = Fixed {
                    first,
                    second,
                    angle,
                };
                (Arc::new(weld), true)
            }
        };
        Made {
            cam,
            ..Made::of(constraint, torque)
        }
    }

    /// A pin: ideal, at the end of a massless link, or a journal that is free in its bearing.
    fn revolute(
        &mut self,
        k: usize,
        name: &str,
        clearance: Option<&Clearance>,
        points: [Marker; 2],
    ) -> Made {
        let [first, second] = points;
        let pin = |offset| Revolute {
            first,
            second,
            offset,
        };
        let own = Arc::new(pin(None));
        let ideal = Made {
            pin: Some(own.clone()),
            ..Made::of(own, false)
        };
        let Some(clearance) = clearance else {
            return ideal;
        };
        match clearance.model {
            ClearanceModel::Ideal => ideal,
            ClearanceModel::MasslessLink => {
                let offset = self.system.links;
                self.system.links += 1;
                Made {
                    constraint: Arc::new(pin(Some(OffsetId(offset as u32)))),
                    pin: None,
                    link: Some(ClearanceLink {
                        offset,
                        radius: clearance.radius.unwrap_or(0.0),
                    }),
                    ..ideal
                }
            }
            ClearanceModel::TwoState | ClearanceModel::ThreeState | ClearanceModel::Contact => {
                let contact = ContactId(self.system.contacts.len());
                self.add_contact((k, contact), name, bearing(clearance), points);
                Made {
                    constraint: Arc::new(Free),
                    pin: None,
                    contact: Some(contact),
                    ..ideal
                }
            }
        }
    }

    /// A journal in its bearing, with all rows that may come into force for it.
    fn add_contact(
        &mut self,
        (joint, id): (usize, ContactId),
        name: &str,
        bearing: Bearing,
        points: [Marker; 2],
    ) {
        let [first, second] = points;
        let journal = Journal {
            bearing: first,
            journal: second,
            clearance: bearing.clearance,
            bearing_radius: bearing.bearing_radius,
        };
        let pair = Pair {
            shape: Shape::Journal(journal),
            surface: self.joints.surfaces[name].clone(),
        };
        let pin = Revolute {
            first,
            second,
            offset: None,
        };
        let closed: Option<Arc<dyn Constraint>> = Some(Arc::new(pin));
        let rows = ContactRows {
            closed,
            ..ContactRows::of(&pair, id, Owner::Joint(JointId(joint)), Some(joint))
        };
        self.system.push_contact(pair, rows);
    }

    /// Friction of an ideal joint, where it has some.
    fn friction(
        &mut self,
        joint: usize,
        name: &str,
        kind: &JointKind,
        points: [Marker; 2],
    ) -> Option<JointFriction> {
        let law = *self.joints.frictions.get(name)?;
        let [first, second] = points;
        let (force, measure): (Arc<dyn ConstraintDependentForce>, Measure) = match kind {
            JointKind::Revolute { pin_radius, .. } => {
                let radius = (*pin_radius)?;
                (
                    Arc::new(PinFriction {
                        first: first.body,
                        second: second.body,
                        radius,
                        law,
                    }),
                    Measure::Angle,
                )
            }
            JointKind::Prismatic {
                axis, guide_length, ..
            } => {
                let guide = Guide {
                    first,
                    second,
                    axis: unit(Vec2::from(*axis)),
                };
                (
                    Arc::new(GuideFriction {
                        guide,
                        length: *guide_length,
                        law,
                    }),
                    Measure::Length,
                )
            }
            _ => return None,
        };
        // Blocks stand in the order of the joints.
        self.system.dependent_forces.push(DependentForce {
            force,
            block: joint,
        });
        Some(JointFriction {
            force: self.system.dependent_forces.len() - 1,
            measure,
        })
    }
}
