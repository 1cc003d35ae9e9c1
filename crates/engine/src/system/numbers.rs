//! The numbers of a mechanism's geometry and mass, in one order: what differs between mechanisms of one structure.

use super::System;
use crate::element::mapped;

impl System {
    /// Whether [`System::renumber`] reaches all numbers that its motion depends on and, with forces, what its joints carry.
    pub(crate) fn is_numbered(&self, with_forces: bool) -> bool {
        let mut keep = |value| value;
        let mut blocks = self.blocks.iter();
        let constraints = blocks.all(|block| block.constraint.renumbered(&mut keep).is_some());
        let carries = !self.forces.is_empty() || !self.dependent_forces.is_empty();
        constraints
            && self.joints.iter().all(super::JointData::is_numbered)
            && self.contacts.is_empty()
            && self.initial.is_empty()
            && self.initial_rates.is_empty()
            && self.sections.is_empty()
            && self.measured.is_empty()
            && self.outputs.is_empty()
            && !(with_forces && carries)
    }

    /// Replaces each number by what `number` makes of it: of the equations, by blocks; of joints, points, bodies and masses.
    /// Lengths by which residuals are measured stay.
    pub(crate) fn renumber(&mut self, number: &mut dyn FnMut(f64) -> f64) {
        for (index, block) in self.blocks.iter_mut().enumerate() {
            let joint = self.joints.get_mut(index);
            block.constraint = match joint.and_then(|joint| joint.renumber_pin(number)) {
                Some(pin) => pin,
                None => block
                    .constraint
                    .renumbered(number)
                    .expect("numbered equations"),
            };
        }
        self.joints
            .iter_mut()
            .for_each(|joint| joint.renumber_points(number));
        for point in &mut self.points {
            point.marker = point.marker.map(number);
        }
        for body in &mut self.bodies {
            body.origin = mapped(&body.origin, number);
        }
        self.mass.renumber(number);
    }
}
