//! Springs, loads and torques.

use super::Compiler;
use super::laws::value_law;
use crate::element::load::{PointLoad, Torque};
use crate::element::spring::Spring;
use crate::element::torsion_spring::TorsionSpring;
use crate::element::{BodyId, Force as ForceElement};
use crate::system::ForceData;
use linkdyn_model::{ForceKind, Frame};
use std::sync::Arc;

impl Compiler<'_> {
    pub(super) fn add_forces(&mut self) {
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
