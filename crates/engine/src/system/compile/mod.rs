//! Words → numbers: the only place where a [`Model`] and a [`System`] meet.

mod contact_parameters;
mod needs;
mod roles;

use super::rows::{reach, size, spread};
use super::{
    Block, BodyData, ClearanceLink, ContactRows, DependentForce, DriverData, DriverId, Extent,
    ForceData, JointData, JointFriction, JointId, Mass, Origin, OutputPoint, Scale, System,
};
use crate::element::coordinate::Coordinate;
use crate::element::driven::{DriveId, Rotation, Translation};
use crate::element::fixed::Fixed;
use crate::element::following::FollowingFriction;
use crate::element::gear::Gear;
use crate::element::joint_friction::{GuideFriction, PinFriction};
use crate::element::journal::{Bearing, ContactId, Free, Journal, Surface};
use crate::element::load::{PointLoad, Torque};
use crate::element::prismatic::{Guide, Prismatic};
use crate::element::revolute::{OffsetId, Revolute};
use crate::element::slot::Slot;
use crate::element::spring::Spring;
use crate::element::torsion_spring::TorsionSpring;
use crate::element::{
    Axis, BodyId, Constraint, ConstraintDependentForce, Force as ForceElement, Layout, Marker,
    Measure, Pose,
};
use crate::motion::{Law, Spline};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::error::Complaint;
use linkdyn_model::{
    AnalysisKind, Body, Carrier, Checked, ClearanceModel, DriverKind, ForceKind, Frame, GROUND,
    JointKind, Model, Motion, PointRef, Value,
};
use needs::{Joints, bearing, clearance, missing};
use std::collections::HashMap;
use std::sync::Arc;

/// Compiles a model for an analysis, once: joints whose clearance is modelled by contact are open, for an assembly closed.
///
/// # Errors
/// Data that the analysis needs and the file lacks, all at once.
pub fn compile(model: &Checked, analysis: AnalysisKind) -> Result<System, Vec<Complaint>> {
    let system = lower(model, missing(model, analysis))?;
    Ok(match analysis {
        AnalysisKind::Assembly => system.closed(),
        AnalysisKind::Kinematics
        | AnalysisKind::InverseDynamics
        | AnalysisKind::Dynamics
        | AnalysisKind::Statics => system,
    })
}

/// Compiles a model for what needs no masses, with its journals free.
///
/// # Errors
/// Parameters that its joints need and the file lacks.
pub fn compile_geometry(model: &Checked) -> Result<System, Vec<Complaint>> {
    lower(model, Vec::new())
}

fn lower(model: &Model, mut complaints: Vec<Complaint>) -> Result<System, Vec<Complaint>> {
    let joints = Joints::new(model, &mut complaints);
    if complaints.is_empty() {
        Ok(Compiler::new(model, joints).build())
    } else {
        Err(complaints)
    }
}

/// A motion's law.
pub fn law(motion: &Motion) -> Law {
    match motion {
        Motion::Polynomial { coefficients } => Law::Polynomial(coefficients.clone()),
        Motion::Harmonic {
            offset,
            amplitude,
            frequency,
            phase,
        } => Law::Harmonic {
            offset: *offset,
            amplitude: *amplitude,
            frequency: *frequency,
            phase: *phase,
        },
        Motion::Table { points } => Law::Spline(Spline::natural(points)),
        Motion::ConstantVelocity { start, velocity } => Law::Polynomial(vec![*start, *velocity]),
        Motion::ConstantAcceleration {
            start,
            velocity,
            acceleration,
        } => Law::Polynomial(vec![*start, *velocity, 0.5 * acceleration]),
    }
}

/// The law of a value that may vary.
pub fn value_law(value: &Value) -> Law {
    match value {
        Value::Constant(value) => Law::Polynomial(vec![*value]),
        Value::Motion(motion) => law(motion),
    }
}

struct Compiler<'a> {
    model: &'a Model,
    joints: Joints<'a>,
    ids: HashMap<&'a str, BodyId>,
    /// Centre of mass in the body's frame, by body id.
    com: Vec<Vec2>,
    system: System,
}

impl<'a> Compiler<'a> {
    fn new(model: &'a Model, joints: Joints<'a>) -> Self {
        let mut ids = HashMap::from([(GROUND, BodyId::GROUND)]);
        let mut com = vec![Vec2::zeros()];
        for (name, body) in model.bodies.iter().filter(|(name, _)| *name != GROUND) {
            ids.insert(name, BodyId(com.len()));
            com.push(body.com.map_or(Vec2::zeros(), Vec2::from));
        }
        let system = System {
            layout: Layout::rigid(com.len() - 1),
            bodies: Vec::new(),
            joints: Vec::new(),
            drivers: Vec::new(),
            points: Vec::new(),
            blocks: Vec::new(),
            initial: Vec::new(),
            initial_rates: Vec::new(),
            forces: Vec::new(),
            force_data: Vec::new(),
            dependent_forces: Vec::new(),
            contacts: Vec::new(),
            contact_rows: Vec::new(),
            gravity: Vec2::from(model.gravity),
            mass: Mass::default(),
            masses_known: true,
            entries: Vec::new(),
            measures: Vec::new(),
            links: 0,
            guess: Vec::new(),
            size: 1.0,
            scale: Scale::SI,
            display: model.display.clone(),
            reach: 0.0,
            extents: Vec::new(),
        };
        Compiler {
            model,
            joints,
            ids,
            com,
            system,
        }
    }

    fn build(mut self) -> System {
        self.add_bodies();
        self.system.extents = self.extents();
        self.system.size = size(&self.system.extents);
        self.system.reach = reach(&self.system.extents);
        self.add_joints();
        self.add_drivers();
        self.add_initial();
        self.add_forces();
        self.system.scale = Scale::of(&self.system);
        for point in &self.model.points {
            let marker = self.marker(point);
            self.system.points.push(OutputPoint {
                name: format!("{}.{}", point.body, point.point),
                marker,
            });
        }
        self.system
    }

    fn body(&self, name: &str) -> BodyId {
        self.ids[name]
    }

    fn marker(&self, point: &PointRef) -> Marker {
        let body = self.body(&point.body);
        let place = self.model.bodies[&point.body].points[&point.point];
        Marker {
            body,
            s: Vec2::from(place) - self.com[body.0],
        }
    }

    fn add_bodies(&mut self) {
        for (name, body) in self.model.bodies.iter().filter(|(name, _)| *name != GROUND) {
            let com = self.com[self.body(name).0];
            let pose = Pose::new(
                body.pose.position[0],
                body.pose.position[1],
                body.pose.angle,
            );
            let centre = pose.r + pose.turn(com);
            self.system
                .guess
                .extend([centre.x, centre.y, body.pose.angle]);
            let (mass, inertia) = (body.mass.unwrap_or(0.0), body.inertia.unwrap_or(0.0));
            self.system.mass.push_rigid(mass, inertia);
            self.system.masses_known &= body.mass.is_some() && body.inertia.is_some();
            self.system.bodies.push(BodyData {
                name: name.clone(),
                origin: -com,
                mass: body.mass,
                inertia: body.inertia,
            });
        }
    }

    /// How far each body reaches, ground first.
    fn extents(&self) -> Vec<Extent> {
        let extent = |body: &Body| {
            let mut points: Vec<Vec2> = body.points.values().map(|&p| Vec2::from(p)).collect();
            points.extend(body.com.map(Vec2::from));
            let places = points.iter().flat_map(|point| point.iter());
            Extent {
                spread: spread(&points),
                reach: places.fold(0.0, |most: f64, x| most.max(x.abs())),
                origin: Some(Vec2::from(body.pose.position)),
            }
        };
        let ground = self.model.bodies.get(GROUND);
        let moving = self.model.bodies.iter();
        let moving = moving.filter(|(name, _)| *name != GROUND);
        [ground.map_or(Extent::default(), extent)]
            .into_iter()
            .chain(moving.map(|(_, body)| extent(body)))
            .collect()
    }

    fn push_block(&mut self, constraint: Arc<dyn Constraint>, origin: Origin) {
        self.system.push_block(constraint, origin);
    }

    fn add_joints(&mut self) {
        for (k, (name, joint)) in self.model.joints.iter().enumerate() {
            let (first, second) = (
                self.marker(&joint.between[0]),
                self.marker(&joint.between[1]),
            );
            let (mut link, mut contact) = (None, None);
            let (constraint, torque): (Arc<dyn Constraint>, bool) = match &joint.kind {
                JointKind::Revolute { clearance, .. } => {
                    let pin = |offset| Revolute {
                        first,
                        second,
                        offset,
                    };
                    let constraint: Arc<dyn Constraint> = match clearance.as_deref() {
                        None => Arc::new(pin(None)),
                        Some(clearance) => match clearance.model {
                            ClearanceModel::Ideal => Arc::new(pin(None)),
                            ClearanceModel::MasslessLink => {
                                let offset = self.system.links;
                                self.system.links += 1;
                                link = Some(ClearanceLink {
                                    offset,
                                    radius: clearance.radius.unwrap_or(0.0),
                                });
                                Arc::new(pin(Some(OffsetId(offset))))
                            }
                            ClearanceModel::TwoState
                            | ClearanceModel::ThreeState
                            | ClearanceModel::Contact => {
                                contact = Some(ContactId(self.system.contacts.len()));
                                self.add_contact(k, name, bearing(clearance), [first, second]);
                                Arc::new(Free)
                            }
                        },
                    };
                    (constraint, false)
                }
                JointKind::Prismatic { axis, angle, .. } => {
                    let guide = Guide {
                        first,
                        second,
                        axis: unit(Vec2::from(*axis)),
                    };
                    (
                        Arc::new(Prismatic {
                            guide,
                            angle: *angle,
                        }),
                        true,
                    )
                }
                JointKind::Slot { axis } => {
                    let guide = Guide {
                        first,
                        second,
                        axis: unit(Vec2::from(*axis)),
                    };
                    (Arc::new(Slot { guide }), false)
                }
                JointKind::Gear { ratio, angle, .. } => (
                    Arc::new(self.gear(
                        [first, second],
                        *ratio,
                        *angle,
                        &self.joints.carriers[name.as_str()],
                    )),
                    true,
                ),
                JointKind::Fixed { angle } => (
                    Arc::new(Fixed {
                        first,
                        second,
                        angle: *angle,
                    }),
                    true,
                ),
            };
            let friction = self.friction(k, name, &joint.kind, [first, second]);
            self.system.joints.push(JointData {
                name: name.clone(),
                role: roles::joint_role(&joint.kind),
                bodies: [first.body, second.body],
                points: [first, second],
                torque,
                clearance: link,
                contact,
                bearing: clearance(&joint.kind).map(bearing),
                friction,
            });
            self.push_block(constraint, Origin::Joint(JointId(k)));
        }
    }

    /// A journal in its bearing, with all rows that may come into force for it.
    fn add_contact(&mut self, joint: usize, name: &str, bearing: Bearing, points: [Marker; 2]) {
        let [first, second] = points;
        let journal = Journal {
            bearing: first,
            journal: second,
            clearance: bearing.clearance,
            bearing_radius: bearing.bearing_radius,
            surface: self.joints.surfaces[name].clone(),
        };
        let friction: Option<Arc<dyn ConstraintDependentForce>> = match &journal.surface {
            Surface::Rigid(rigid) if rigid.friction > 0.0 => Some(Arc::new(FollowingFriction {
                journal: journal.clone(),
                law: rigid.friction_law(),
            })),
            Surface::Rigid(_) | Surface::Compliant(_) => None,
        };
        self.system.contact_rows.push(ContactRows {
            block: joint,
            closed: Arc::new(Revolute {
                first,
                second,
                offset: None,
            }),
            sustained: Arc::new(journal.following()),
            friction,
        });
        self.system.contacts.push(journal);
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
            JointKind::Slot { .. } | JointKind::Gear { .. } | JointKind::Fixed { .. } => {
                return None;
            }
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

    /// A gear pair; without an angle it meshes as drawn.
    fn gear(&self, wheels: [Marker; 2], ratio: f64, angle: Option<f64>, carrier: &Carrier) -> Gear {
        let [first, second] = wheels;
        let span = Vec2::from(carrier.centres[1]) - Vec2::from(carrier.centres[0]);
        let carrier = self.body(carrier.body);
        let drawn = |body: BodyId| {
            let columns = self.system.layout.columns(body);
            columns.map_or(0.0, |columns| self.system.guess[columns.theta()])
        };
        let from_carrier = |wheel: Marker| drawn(wheel.body) - drawn(carrier);
        let angle = angle.unwrap_or_else(|| from_carrier(second) - ratio * from_carrier(first));
        Gear {
            first,
            second,
            carrier,
            axis: unit(span),
            distance: span.norm(),
            ratio,
            angle,
        }
    }

    fn add_drivers(&mut self) {
        for (k, (name, driver)) in self.model.drivers.iter().enumerate() {
            let drive = DriveId(k);
            let (constraint, measure): (Arc<dyn Constraint>, Measure) = match &driver.kind {
                DriverKind::Rotation { body, relative_to } => {
                    let relative_to = relative_to
                        .as_deref()
                        .map_or(BodyId::GROUND, |name| self.body(name));
                    (
                        Arc::new(Rotation {
                            body: self.body(body),
                            relative_to,
                            drive,
                        }),
                        Measure::Angle,
                    )
                }
                DriverKind::Translation { joint } => {
                    let joint = &self.model.joints[joint];
                    let axis = match &joint.kind {
                        JointKind::Prismatic { axis, .. } | JointKind::Slot { axis } => {
                            unit(Vec2::from(*axis))
                        }
                        // The loader lets translations drive prismatic joints and slots only.
                        JointKind::Revolute { .. }
                        | JointKind::Gear { .. }
                        | JointKind::Fixed { .. } => Vec2::x(),
                    };
                    let (first, second) = (
                        self.marker(&joint.between[0]),
                        self.marker(&joint.between[1]),
                    );
                    (
                        Arc::new(Translation {
                            guide: Guide {
                                first,
                                second,
                                axis,
                            },
                            drive,
                        }),
                        Measure::Length,
                    )
                }
            };
            self.system.drivers.push(DriverData {
                name: name.clone(),
                role: self.driver_role(&driver.kind),
                law: law(&driver.motion),
                measure,
            });
            self.push_block(constraint, Origin::Driver(DriverId(k)));
        }
    }

    fn add_initial(&mut self) {
        for (name, initial) in &self.model.initial {
            let body = self.body(name);
            let origin = Marker {
                body,
                s: -self.com[body.0],
            };
            let values = [
                (Axis::X, "x", "vx", initial.x, initial.vx),
                (Axis::Y, "y", "vy", initial.y, initial.vy),
                (
                    Axis::Theta,
                    "angle",
                    "angular_velocity",
                    initial.angle,
                    initial.angular_velocity,
                ),
            ];
            for (axis, key, rate_key, value, rate) in values {
                if let Some(value) = value {
                    let constraint = Coordinate {
                        origin,
                        axis,
                        value,
                    };
                    self.system.initial.push(Block {
                        rows: 1,
                        entries: constraint.entries().len(),
                        constraint: Arc::new(constraint),
                        origin: Origin::Initial(format!("{name}.{key}")),
                        row: 0,
                        entry: 0,
                    });
                }
                if let Some(rate) = rate {
                    let row = Coordinate {
                        origin,
                        axis,
                        value: rate,
                    };
                    self.system
                        .initial_rates
                        .push((format!("{name}.{rate_key}"), row));
                }
            }
        }
    }

    fn add_forces(&mut self) {
        for (name, force) in &self.model.forces {
            let element: Arc<dyn ForceElement> = match &force.kind {
                ForceKind::Spring {
                    between,
                    stiffness,
                    damping,
                    free_length,
                } => Arc::new(Spring {
                    first: self.marker(&between[0]),
                    second: self.marker(&between[1]),
                    stiffness: *stiffness,
                    damping: *damping,
                    free_length: value_law(free_length),
                }),
                ForceKind::TorsionSpring {
                    between,
                    stiffness,
                    damping,
                    free_angle,
                } => Arc::new(TorsionSpring {
                    first: self.body(&between[0]),
                    second: self.body(&between[1]),
                    stiffness: *stiffness,
                    damping: *damping,
                    free_angle: value_law(free_angle),
                }),
                ForceKind::Load { at, vector, frame } => Arc::new(PointLoad {
                    at: self.marker(at),
                    vector: [value_law(&vector[0]), value_law(&vector[1])],
                    follows_body: match frame {
                        Frame::Ground => false,
                        Frame::Body => true,
                    },
                }),
                ForceKind::Torque {
                    body,
                    value,
                    relative_to,
                } => Arc::new(Torque {
                    body: self.body(body),
                    relative_to: relative_to
                        .as_deref()
                        .map_or(BodyId::GROUND, |name| self.body(name)),
                    value: value_law(value),
                }),
            };
            self.system.forces.push(element);
            self.system.force_data.push(ForceData {
                name: name.clone(),
                role: self.force_role(&force.kind),
            });
        }
    }
}
