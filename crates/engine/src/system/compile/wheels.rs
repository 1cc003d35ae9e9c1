//! What rolls: wheels in mesh, on racks, and with belts; and what yields: bushings and beams.

use super::Compiler;
use super::joints::Made;
use crate::element::beam::Beam;
use crate::element::belt::{Belt, Strands};
use crate::element::bushing::Bushing;
use crate::element::gear::Gear;
use crate::element::journal::Free;
use crate::element::rack::Rack;
use crate::element::{BodyColumns, BodyId, Constraint, Kinematics, Marker, Pose, direction};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::{self as model, Carrier, Joint, JointKind};
use std::sync::Arc;

impl Made {
    /// A pin in rubber, which holds nothing and is a force.
    pub(super) fn bushing(given: &model::Bushing, [first, second]: [Marker; 2]) -> Made {
        let bushing = Bushing {
            first,
            second,
            stiffness: Vec2::from(given.radial_stiffness.0),
            damping: Vec2::from(given.radial_damping.0),
            torsion: [given.torsional_stiffness, given.torsional_damping],
            free_angle: given.free_angle,
        };
        let mut made = Made::of(Arc::new(Free), true);
        made.bushing = Some(Box::new(bushing));
        made
    }
}

impl Compiler<'_> {
    /// An elastic bar, which holds nothing and is a force; without a length or angles it is straight and unloaded as drawn.
    pub(super) fn beam(&self, given: &model::Beam, [first, second]: [Marker; 2]) -> Made {
        let section = &given.section;
        let (area, moment) = (section.shape.area(), section.shape.second_moment());
        // Without a modulus the gate has complained.
        let young = section.stiffness().unwrap_or_default();
        let shear = section.poisson_ratio.map_or(f64::INFINITY, |nu| {
            young / (2.0 * (1.0 + nu)) * section.shape.shear_area(nu)
        });
        let d: Vec2 = [0, 1]
            .map(|k: usize| self.as_drawn(|at| (second.place(at) - first.place(at))[k]))
            .into();
        let direction = d.y.atan2(d.x);
        let drawn = [first, second].map(|end| direction - self.drawn_angle(end.body));
        let mut made = Made::of(Arc::new(Free), true);
        made.beam = Some(Box::new(Beam {
            first,
            second,
            stiffness: [young * area, young * moment, shear],
            length: given.length.unwrap_or(d.norm()),
            angles: given.angles.unwrap_or(drawn),
            damping: given.damping_time,
        }));
        made
    }

    /// A number of the poses as drawn.
    pub(super) fn as_drawn(&self, number: impl Fn(&Kinematics) -> f64) -> f64 {
        let place = |columns: BodyColumns| {
            let [x, y, theta] = columns.read(&self.system.guess);
            Pose::new(x, y, theta)
        };
        let moving = self.system.layout.bodies().map(place);
        let poses: Vec<Pose> = [Pose::GROUND].into_iter().chain(moving).collect();
        number(&Kinematics {
            poses: &poses,
            twists: &[],
            drive: &[],
            offset: &[],
            sides: &[],
            contacts: &[],
            states: &[],
            time: 0.0,
        })
    }

    /// A gear pair; without an angle it meshes as drawn.
    pub(super) fn gear(
        &self,
        wheels: [Marker; 2],
        ratio: f64,
        angle: Option<f64>,
        carrier: &Carrier,
    ) -> Gear {
        let [first, second] = wheels;
        let span = Vec2::from(carrier.centres[1]) - Vec2::from(carrier.centres[0]);
        let carrier = self.body(carrier.body);
        let from_carrier = |wheel: Marker| self.drawn_angle(wheel.body) - self.drawn_angle(carrier);
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

    /// A rack; without an offset it meshes as drawn.
    pub(super) fn rack(
        &self,
        [first, second]: [Marker; 2],
        axis: [f64; 2],
        radius: f64,
        offset: Option<f64>,
    ) -> Rack {
        let rack = Rack {
            first,
            second,
            axis: unit(Vec2::from(axis)),
            radius,
            offset: 0.0,
        };
        let offset = offset.unwrap_or_else(|| self.as_drawn(|at| rack.rolled(at)));
        Rack { offset, ..rack }
    }

    /// Two pulleys; a belt that stretches holds nothing, and is a force.
    pub(super) fn belt(&self, name: &str, joint: &Joint, [first, second]: [Marker; 2]) -> Made {
        let JointKind::Belt {
            radii,
            strands,
            pretension,
            ..
        } = &joint.kind
        else {
            return Made::of(Arc::new(Free), true);
        };
        let found = &self.joints.carriers[name];
        let carrier = self.body(found.body);
        let held = Vec2::from(found.centres[1]) - Vec2::from(found.centres[0]);
        // A carrier that does not hold the centres has their line as the poses draw it.
        let drawn = || {
            let span = |at: &Kinematics| second.place(at) - first.place(at);
            let back = Pose::new(0.0, 0.0, -self.drawn_angle(carrier));
            [0, 1]
                .map(|k: usize| self.as_drawn(|at| back.turn(span(at))[k]))
                .into()
        };
        let line: Vec2 = if held == Vec2::zeros() { drawn() } else { held };
        let (axis, distance) = direction(line).unwrap_or((Vec2::x(), 0.0));
        let stops = &joint.stops;
        let mut belt = Belt {
            first,
            second,
            carrier,
            axis,
            radii: *radii,
            crossed: *strands == model::Strands::Crossed,
            offset: 0.0,
            distance,
            pretension: pretension.unwrap_or(0.0),
            elastic: stops
                .stiffness
                .map(|stiffness| [stiffness, stops.damping.unwrap_or(0.0)]),
        };
        // As drawn: the line of centres stands in the carrier where it is drawn.
        let from_carrier = |wheel: Marker| self.drawn_angle(wheel.body) - self.drawn_angle(carrier);
        belt.offset = belt.apart([from_carrier(first), from_carrier(second)]);
        let constraint: Arc<dyn Constraint> = match belt.elastic {
            None => Arc::new(belt.clone()),
            Some(_) => Arc::new(Free),
        };
        let mut made = Made::of(constraint, true);
        made.belt = Some(Box::new(belt));
        made
    }

    /// What belts exert beside their constraints, and bushings: behind all forces of the model.
    pub(super) fn add_strands(&mut self) {
        let belts = self
            .system
            .joints
            .iter()
            .filter_map(|joint| joint.extras().belt.as_deref());
        let strands: Vec<Strands> = belts
            .filter(|belt| belt.acts())
            .cloned()
            .map(Strands)
            .collect();
        for strands in strands {
            self.system.forces.push(Arc::new(strands));
        }
        let joints = self.system.joints.iter();
        for joint in joints {
            let extras = joint.extras();
            if let Some(bushing) = extras.bushing.as_deref() {
                self.system.forces.push(Arc::new(*bushing));
            }
            if let Some(beam) = extras.beam.as_deref() {
                self.system.forces.push(Arc::new(*beam));
            }
        }
        self.system.forces.append(&mut self.elastic_forces);
    }

    /// Angle of a body as drawn \[rad\].
    fn drawn_angle(&self, body: BodyId) -> f64 {
        let columns = self.system.layout.columns(body);
        columns.map_or(0.0, |columns| self.system.guess[columns.theta()])
    }
}
