//! Springs, actuators, loads and torques.

use super::Compiler;
use super::laws::value_law;
use crate::element::actuator::Actuator;
use crate::element::cable::Tension;
use crate::element::formula::Strength;
use crate::element::load::{PointLoad, Torque};
use crate::element::quantity::Quantity;
use crate::element::spring::Spring;
use crate::element::torsion_spring::TorsionSpring;
use crate::element::{BodyId, Force as ForceElement, Marker};
use crate::system::{ForceData, ForceRole};
use linkdyn_model::{ForceKind, Frame, PointRef, Value};
use std::sync::Arc;

/// A force element, and what it is for results beside the equations.
type Lowered = (Arc<dyn ForceElement>, ForceRole);

impl Compiler<'_> {
    pub(super) fn add_forces(&mut self) {
        let mut stretches = Vec::new();
        for (name, force) in &self.model.forces {
            if let ForceKind::Cable { through, .. } = &force.kind {
                let (mut all, role) = self.lower_cable(through, &force.kind);
                self.system.forces.push(Arc::new(all.remove(0)));
                self.system.force_data.push(ForceData {
                    name: name.clone(),
                    role,
                });
                stretches.extend(all.into_iter().map(|stretch| (name, stretch)));
                continue;
            }
            let (element, role) = self.lower_force(&force.kind);
            self.system.forces.push(element);
            self.system.force_data.push(ForceData {
                name: name.clone(),
                role,
            });
        }
        // the rest of cables stands behind what the model numbers
        for (name, stretch) in stretches {
            self.system.force_data.push(ForceData {
                name: name.clone(),
                role: ForceRole::Stretch {
                    between: [stretch.first, stretch.second],
                },
            });
            self.system.forces.push(Arc::new(stretch));
        }
    }

    /// The stretches of a cable.
    fn lower_cable(
        &mut self,
        through: &[PointRef],
        kind: &ForceKind,
    ) -> (Vec<Actuator>, ForceRole) {
        let markers: Vec<Marker> = through.iter().map(|point| self.marker(point)).collect();
        let path = self.stretches(kind);
        let ForceKind::Cable {
            stiffness,
            damping,
            free_length,
            ..
        } = kind
        else {
            unreachable!("the caller has a cable");
        };
        let tension = Tension {
            stretches: path.len(),
            stiffness: *stiffness,
            damping: *damping,
            free_length: value_law(free_length),
        };
        let lengths = path.iter().copied().map(Quantity::Value);
        let rates = path.iter().copied().map(Quantity::Rate);
        let arguments = lengths.chain(rates).chain([Quantity::Time]).collect();
        let pull = Strength::OfMotion(self.own_formula(Arc::new(tension), arguments));
        let stretches = markers.windows(2).map(|pair| Actuator {
            first: pair[0],
            second: pair[1],
            force: pull.clone(),
        });
        let role = ForceRole::Cable {
            between: [markers[0].body, markers[1].body],
            path,
            pull: pull.clone(),
        };
        (stretches.collect(), role)
    }

    fn lower_force(&mut self, kind: &ForceKind) -> Lowered {
        match kind {
            ForceKind::Spring {
                between: ends,
                stiffness,
                damping,
                free_length,
            } => {
                let [first, second] = ends.each_ref().map(|end| self.marker(end));
                let between = [first.body, second.body];
                let spring = Spring {
                    first,
                    second,
                    stiffness: *stiffness,
                    damping: *damping,
                    free_length: value_law(free_length),
                };
                (Arc::new(spring), self.spring_role(kind, between))
            }
            ForceKind::Actuator {
                between: ends,
                force,
            } => {
                let [first, second] = ends.each_ref().map(|end| self.marker(end));
                let between = [first.body, second.body];
                let force = self.strength(force);
                let actuator = Actuator {
                    first,
                    second,
                    force,
                };
                (Arc::new(actuator), self.spring_role(kind, between))
            }
            ForceKind::GasSpring { between, .. } | ForceKind::Cylinder { between, .. } => {
                let [first, second] = between.each_ref().map(|end| self.marker(end));
                let force = self.push(kind);
                let actuator = Actuator {
                    first,
                    second,
                    force,
                };
                let between = [first.body, second.body];
                (Arc::new(actuator), self.spring_role(kind, between))
            }
            ForceKind::Cable { .. } => unreachable!("cables are compiled stretch by stretch"),
            ForceKind::TorsionSpring {
                between,
                stiffness,
                damping,
                free_angle,
            } => {
                let [first, second] = between.each_ref().map(|body| self.body(body));
                let between = [first, second];
                let spring = TorsionSpring {
                    first,
                    second,
                    stiffness: *stiffness,
                    damping: *damping,
                    free_angle: value_law(free_angle),
                };
                (Arc::new(spring), self.spring_role(kind, between))
            }
            ForceKind::Load { at, vector, frame } => self.lower_load(at, vector, *frame),
            ForceKind::Torque {
                body,
                value,
                relative_to,
            } => {
                let value = self.strength(value);
                self.lower_torque(body, relative_to.as_deref(), (value, None))
            }
            ForceKind::DcMotor {
                body, relative_to, ..
            } => {
                let value = self.motor(kind);
                self.lower_torque(body, relative_to.as_deref(), value)
            }
        }
    }

    fn lower_torque(
        &self,
        body: &str,
        relative_to: Option<&str>,
        (value, by_current): (Strength, Option<f64>),
    ) -> Lowered {
        let body = self.body(body);
        let other = relative_to.map(|name| self.body(name));
        let torque = Torque {
            body,
            relative_to: other.unwrap_or(BodyId::GROUND),
            value: value.clone(),
        };
        let role = ForceRole::Torque {
            value,
            body,
            between: other.map(|other| [body, other]),
            by_current,
        };
        (Arc::new(torque), role)
    }

    fn lower_load(&mut self, at: &PointRef, vector: &[Value; 2], frame: Frame) -> Lowered {
        let at = self.marker(at);
        let vector = vector.each_ref().map(|one| self.strength(one));
        let frame = match frame {
            Frame::Ground => BodyId::GROUND,
            Frame::Body => at.body,
        };
        let load = PointLoad {
            at,
            vector: vector.clone(),
            follows_body: frame != BodyId::GROUND,
        };
        (Arc::new(load), ForceRole::Load { at, vector, frame })
    }

    fn spring_role(&self, kind: &ForceKind, between: [BodyId; 2]) -> ForceRole {
        ForceRole::Spring {
            between,
            measured: self.stretches(kind)[0],
            is_actuator: !matches!(
                kind,
                ForceKind::Spring { .. } | ForceKind::TorsionSpring { .. }
            ),
        }
    }
}
