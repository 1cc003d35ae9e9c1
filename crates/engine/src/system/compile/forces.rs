//! Springs, actuators, loads and torques.

use super::Compiler;
use super::laws::value_law;
use crate::element::actuator::Actuator;
use crate::element::load::{PointLoad, Torque};
use crate::element::spring::Spring;
use crate::element::torsion_spring::TorsionSpring;
use crate::element::{BodyId, Force as ForceElement};
use crate::system::{ForceData, ForceRole};
use linkdyn_model::{ForceKind, Frame, PointRef, Value};
use std::sync::Arc;

/// A force element, and what it is for results beside the equations.
type Lowered = (Arc<dyn ForceElement>, ForceRole);

impl Compiler<'_> {
    pub(super) fn add_forces(&mut self) {
        for (name, force) in &self.model.forces {
            let (element, role) = self.lower_force(&force.kind);
            self.system.forces.push(element);
            self.system.force_data.push(ForceData {
                name: name.clone(),
                role,
            });
        }
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
                let body = self.body(body);
                let other = relative_to.as_deref().map(|name| self.body(name));
                let value = self.strength(value);
                let torque = Torque {
                    body,
                    relative_to: other.unwrap_or(BodyId::GROUND),
                    value: value.clone(),
                };
                let between = other.map(|other| [body, other]);
                (Arc::new(torque), ForceRole::Torque { value, between })
            }
        }
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
        (Arc::new(load), ForceRole::Load { vector, frame })
    }

    fn spring_role(&self, kind: &ForceKind, between: [BodyId; 2]) -> ForceRole {
        ForceRole::Spring {
            between,
            measured: self.stretch(kind),
            is_actuator: matches!(kind, ForceKind::Actuator { .. }),
        }
    }
}
