//! What acts on the bodies with a cross-section, element by element, and where.
//!
//! Each element's forces are what the equations of motion have of it, −Jᵀλ or its part of Q, as force and moment about the centre of mass;
//! where they act is a point of the element, about which the rest of the moment is a couple:
//!
//! ```text
//! joint                the point of each body; of slides, slots, cams and outlines where the second body touches
//! spring, load         the point of each body; a cable at each of its points
//! torque, rotation     the pin that joins both bodies (the body and ground, where no other is named), else the centre of mass
//! forces from outside  the centre of mass
//! ```

use crate::element::quantity::Measured;
use crate::element::{Applied, BodyId, Kinematics, Marker, Twist};
use crate::system::{
    BodyPart, DriverRole, Evaluation, ForceRole, Inputs, JointData, JointRole, Origin, Owner,
    System,
};
use linkdyn_linear::math::Vec2;

use super::super::sample::Sample;

/// A force and a torque on a moving body at a place.
#[derive(Debug, Clone, Copy)]
pub struct Action {
    pub body: usize,
    pub place: Vec2,
    pub force: Vec2,
    pub torque: f64,
}

/// All of an instant.
pub struct Actions(Vec<Action>);

impl Actions {
    /// Of the bodies with a cross-section, weight and inertia left out.
    pub fn new(system: &System, evaluation: &Evaluation, inputs: &Inputs, sample: &Sample) -> Self {
        let mut collected = Collected {
            system,
            at: evaluation.kinematics(inputs),
            bodies: cut_bodies(system),
            pull: vec![0.0; system.n()],
            actions: Vec::new(),
        };
        collected.blocks(&sample.lambda);
        collected.dependent(&sample.dependent_forces);
        evaluation.push_from_outside(inputs, &mut collected.pull);
        collected.settle(&[]);
        let still: Vec<Twist>;
        if system.is_slow {
            still = vec![Twist::default(); collected.at.twists.len()];
            collected.at.twists = &still;
            collected.forces();
        } else {
            collected.forces();
        }
        Actions(collected.actions)
    }

    /// Those on a body.
    pub fn on(&self, body: usize) -> impl Iterator<Item = &Action> {
        self.0.iter().filter(move |action| action.body == body)
    }
}

/// Bodies with a cross-section, and the sections of those that are elastic.
fn cut_bodies(system: &System) -> Vec<usize> {
    let sections = system.bodies.iter().enumerate().filter(|(_, data)| {
        let of = |body: &usize| system.bodies[*body].name == data.link();
        data.part() == BodyPart::Section && system.sections.keys().any(of)
    });
    let sections = sections.map(|(body, _)| body);
    system.sections.keys().copied().chain(sections).collect()
}

/// A body of an element, and where it acts on it.
type BodyEnd = (BodyId, Vec2);

/// What has been collected so far.
struct Collected<'a> {
    system: &'a System,
    at: Kinematics<'a>,
    /// Bodies with a cross-section.
    bodies: Vec<usize>,
    /// Generalized forces of one element (n), zero between elements.
    pull: Vec<f64>,
    actions: Vec<Action>,
}

impl Collected<'_> {
    /// −Jᵀλ of all that holds or drives.
    fn blocks(&mut self, lambda: &[f64]) {
        let system = self.system;
        let mut values = Vec::new();
        for block in &system.blocks {
            let entries = &system.entries[block.entries()];
            let column = |entry: &crate::system::JacobianEntry| Some(entry.column()? as usize);
            let is_own = |column: usize| {
                let mut bodies = self.bodies.iter();
                bodies.any(|body| system.layout.moving(*body).range().contains(&column))
            };
            let is_inner =
                matches!(block.origin, Origin::Joint(id) if !system.joints[id.0].is_own());
            if is_inner || !entries.iter().filter_map(column).any(is_own) {
                continue;
            }
            values.resize(entries.len(), 0.0);
            block.constraint.jacobian(&self.at, &mut values);
            for (entry, value) in entries.iter().zip(&values) {
                if let Some(column) = column(entry) {
                    self.pull[column] -= value * lambda[entry.row as usize];
                }
            }
            self.settle(&self.ends_of(&block.origin));
            let columns = entries.iter().filter_map(column);
            columns.for_each(|column| self.pull[column] = 0.0);
        }
    }

    /// Friction by multipliers.
    fn dependent(&mut self, sizes: &[f64]) {
        for (dependent, size) in self.system.dependent_forces.iter().zip(sizes) {
            let ends = self.ends_of(&self.system.blocks[dependent.block].origin);
            self.collect(&ends, |at, to| dependent.force.apply_unit(at, to), *size);
        }
    }

    /// Springs, loads and torques, belts, bushings and beams, contacts.
    fn forces(&mut self) {
        let system = self.system;
        let joints = || system.joints.iter();
        let belts = joints().filter(|joint| {
            let belt = joint.extras().belt.as_deref();
            belt.is_some_and(crate::element::belt::Belt::acts)
        });
        let yields = |joint: &&JointData| {
            let extras = joint.extras();
            extras.bushing.is_some() || extras.beam.is_some()
        };
        let yielding = joints().filter(yields);
        // Those of joints stand behind those of the model.
        let mut behind = belts.chain(yielding);
        for (index, force) in system.forces.iter().enumerate() {
            let ends = match (system.force_data.get(index), behind.by_ref()) {
                (Some(data), _) => self.ends_of_force(&data.role),
                (None, behind) => behind.next().map(|joint| self.ends_of_joint(joint)),
            };
            let ends = ends.unwrap_or([(BodyId::GROUND, Vec2::zeros()); 2]);
            self.collect(&ends, |at, to| force.apply(at, to), 1.0);
        }
        for (index, contact) in system.contacts.iter().enumerate() {
            let ends = self.ends_of(&Origin::Stop(crate::element::pair::ContactId(index)));
            let at = self.at;
            self.collect(
                &ends,
                |_, to| contact.apply(&at, &at.contacts[index], to),
                1.0,
            );
        }
    }

    /// Takes what one element exerts, so many times.
    fn collect(
        &mut self,
        ends: &[BodyEnd; 2],
        apply: impl FnOnce(&Kinematics, &mut Applied),
        times: f64,
    ) {
        let is_own =
            |(body, _): &BodyEnd| body.index().is_some_and(|body| self.bodies.contains(&body));
        if !ends.iter().any(is_own) {
            return;
        }
        apply(
            &self.at,
            &mut Applied::to(&mut self.pull, &self.system.layout),
        );
        self.pull.iter_mut().for_each(|pull| *pull *= times);
        self.settle(ends);
        self.pull.fill(0.0);
    }

    /// Takes the generalized forces at hand, which act at these ends, and at the centre of mass of what is not among them.
    fn settle(&mut self, ends: &[BodyEnd]) {
        for body in &self.bodies {
            let [x, y, moment] = self.system.layout.moving(*body).read(&self.pull);
            if [x, y, moment] == [0.0; 3] {
                continue;
            }
            let (force, centre) = (Vec2::new(x, y), self.at.poses[body + 1].r);
            let end = ends.iter().find(|end| end.0.index() == Some(*body));
            let place = end.map_or(centre, |end| end.1);
            self.actions.push(Action {
                body: *body,
                place,
                force,
                torque: moment - (place - centre).perp(&force),
            });
        }
    }

    fn end(&self, marker: &Marker) -> BodyEnd {
        (marker.body, marker.place(&self.at))
    }

    fn ends_of(&self, origin: &Origin) -> [BodyEnd; 2] {
        let joint = |index: usize| self.ends_of_joint(&self.system.joints[index]);
        match origin {
            Origin::Joint(id) => joint(id.0),
            Origin::Driver(id) => match self.system.drivers[id.0].role {
                DriverRole::Rotation { body, relative_to } => self.pin([relative_to, body]),
                DriverRole::Translation { joint: id } => joint(id.0),
                DriverRole::Length { between } => between.map(|end| self.end(&end)),
                DriverRole::Coordinate { origin, .. } => [self.end(&origin); 2],
            },
            Origin::Stop(id) => match self.system.owner_of(*id) {
                Owner::Joint(id) => joint(id.0),
                Owner::Force(force) => {
                    let ends = self.ends_of_force(&self.system.force_data[force].role);
                    ends.unwrap_or([(BodyId::GROUND, Vec2::zeros()); 2])
                }
            },
            Origin::Initial(_) => [(BodyId::GROUND, Vec2::zeros()); 2],
        }
    }

    fn ends_of_joint(&self, joint: &JointData) -> [BodyEnd; 2] {
        let [first, second] = joint.points().map(|point| self.end(&point));
        let cam = joint.extras().cam.as_ref();
        let place = match joint.role() {
            JointRole::Prismatic { .. } | JointRole::Slot { .. } | JointRole::Contact => second.1,
            _ => match cam {
                Some(cam) => cam.meeting(&self.at).point,
                None => return [first, second],
            },
        };
        [(first.0, place), (second.0, place)]
    }

    fn ends_of_force(&self, role: &ForceRole) -> Option<[BodyEnd; 2]> {
        let of = |measured: &Measured| match measured {
            Measured::Distance { first, second } | Measured::Along { first, second, .. } => {
                [self.end(first), self.end(second)]
            }
            Measured::Turn { first, second, .. } => self.pin([*first, *second]),
        };
        Some(match role {
            ForceRole::Spring { measured, .. } => of(measured),
            ForceRole::Cable { path, .. } => of(path.first()?),
            ForceRole::Stretch { between } => between.map(|end| self.end(&end)),
            ForceRole::Load { at, .. } => [self.end(at); 2],
            ForceRole::Torque { body, between, .. } => {
                self.pin(between.unwrap_or([*body, BodyId::GROUND]))
            }
        })
    }

    /// Where a pin joins two bodies; their centres of mass where none does.
    fn pin(&self, bodies: [BodyId; 2]) -> [BodyEnd; 2] {
        let mut joints = self.system.joints.iter();
        let pin = joints.find(|joint| {
            let [first, second] = joint.bodies();
            let turns = matches!(joint.role(), JointRole::Revolute | JointRole::Bushing);
            turns && (bodies == [first, second] || bodies == [second, first])
        });
        match pin {
            Some(joint) => joint.points().map(|point| self.end(&point)),
            None => bodies.map(|body| (body, self.at.poses[body.0].r)),
        }
    }
}
