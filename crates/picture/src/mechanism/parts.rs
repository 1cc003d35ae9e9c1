//! Parts: a sign, what it stands at, what it turns with.

use super::moving::Mechanism;
use super::places::{bent, place, turned};
use super::view::View;
use crate::poses::{Pose, global};
use crate::scene::{Place, Scene};
use crate::shape::PointId;
use crate::sign::{Seat, Sign, metres};
use crate::symbols;

/// What is drawn in front of what, from the back to the front.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Wheels, racks, belts, profiles of cams.
    Wheels,
    /// Guides and outlines of the ground: the last that would cover other poses.
    Backdrop,
    /// Guides of bodies.
    Guides,
    /// Outlines that move, and tips.
    Outlines,
    /// Bodies.
    Bodies,
    /// Blocks and cylinders.
    Blocks,
    /// Ends of ways.
    Stops,
    /// What touches a cam.
    Followers,
    /// Pins and welds.
    Pins,
    /// Springs and dampers between points: the last that is drawn of several poses.
    Springs,
    /// Springs and dampers around pins.
    Coils,
    /// Arrows of drivers: the last that figures draw.
    Drivers,
    /// Centres of mass.
    Centres,
}

/// Where a part stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum At {
    /// At a point.
    Point(PointId),
    /// At the origin of a body.
    Origin(usize),
    /// At the centre of mass of a body.
    Mass(usize),
}

/// Which way a part points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turn {
    /// Along a direction of a body, of length one.
    With(usize, [f64; 2]),
    /// Towards a point.
    Towards(PointId),
}

/// A part of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Behind or in front of what it is.
    pub layer: Layer,
    /// Where it stands.
    pub at: At,
    /// Which way it points.
    pub turn: Turn,
    /// Whose colours it has.
    pub body: usize,
    /// What is drawn.
    pub sign: Sign,
}

/// The parts of a mechanism while they are found.
pub struct Parts<'a> {
    pub mechanism: &'a Mechanism,
    /// A pose of all bodies, ground first.
    pub pose: &'a [Pose],
    /// Length of a bar where signs are counted out over a length \[m\].
    pub bar: f64,
    /// Whether the parts are to serve in all poses, not in this one alone.
    pub for_all: bool,
    found: Vec<Part>,
}

impl<'a> Parts<'a> {
    /// All parts, from the back to the front.
    pub fn of(mechanism: &'a Mechanism, pose: &'a [Pose], bar: f64, for_all: bool) -> Vec<Part> {
        let mut parts = Parts {
            mechanism,
            pose,
            bar,
            for_all,
            found: Vec::new(),
        };
        parts.add_joints();
        parts.add_bodies();
        parts.add_forces();
        parts.add_drivers();
        parts.found.sort_by_key(|part| part.layer);
        parts.found
    }

    /// A part that points along a direction of a body.
    pub fn with(
        &mut self,
        layer: Layer,
        at: PointId,
        (body, axis): (usize, [f64; 2]),
        of: usize,
        sign: Sign,
    ) {
        let (at, turn) = (At::Point(at), Turn::With(body, axis));
        self.found.push(Part {
            layer,
            at,
            turn,
            body: of,
            sign,
        });
    }

    /// A part that points along the x axis of the body whose colours it has.
    pub fn on(&mut self, layer: Layer, at: PointId, body: usize, sign: Sign) {
        self.with(layer, at, (body, [1.0, 0.0]), body, sign);
    }

    /// A part at a pin or a body that points along the x axis of a body.
    pub fn at(&mut self, layer: Layer, at: At, body: usize, sign: Sign) {
        let turn = Turn::With(body, [1.0, 0.0]);
        self.found.push(Part {
            layer,
            at,
            turn,
            body,
            sign,
        });
    }

    /// A part that stands upright, whatever moves.
    pub fn upright(&mut self, layer: Layer, at: At, sign: Sign) {
        self.at(layer, at, 0, sign);
    }

    /// A part from one point to another.
    pub fn between(&mut self, layer: Layer, [from, to]: [PointId; 2], sign: Sign) {
        let (at, turn) = (At::Point(from), Turn::Towards(to));
        self.found.push(Part {
            layer,
            at,
            turn,
            body: 0,
            sign,
        });
    }

    /// A point in global axes \[m\].
    pub fn place(&self, point: PointId) -> [f64; 2] {
        place(&self.mechanism.shape, self.pose, point)
    }

    /// Distance of two points \[m\].
    pub fn distance(&self, ends: [PointId; 2]) -> f64 {
        let [[x, y], [u, v]] = ends.map(|end| self.place(end));
        (u - x).hypot(v - y)
    }

    /// Where something turns: around a pin, else at a body.
    pub fn around(&self, pin: Option<usize>, body: usize) -> At {
        let shape = &self.mechanism.shape;
        match pin {
            Some(joint) => At::Point(shape.joints[joint].between[1]),
            None if shape.point((body, 0)).is_some() => At::Point((body, 0)),
            None => At::Origin(body),
        }
    }

    fn add_bodies(&mut self) {
        let mechanism = self.mechanism;
        for body in 1..mechanism.shape.bodies.len() {
            if !mechanism.cylinders.holds[body] {
                self.at(
                    Layer::Bodies,
                    At::Origin(body),
                    body,
                    vec![super::joints::body()],
                );
            }
            if mechanism.shape.bodies[body].com.is_some() {
                self.upright(Layer::Centres, At::Mass(body), symbols::centre_of_mass());
            }
        }
    }
}

impl Part {
    /// Draws the part in a pose, in so much of its colours.
    pub fn draw(
        &self,
        scene: &mut Scene,
        mechanism: &Mechanism,
        view: &View,
        pose: &[Pose],
        strength: f64,
    ) {
        let point = |point: PointId| view.place(place(&mechanism.shape, pose, point));
        let origin = match self.at {
            At::Point(at) => point(at),
            At::Origin(body) => view.place([pose[body][0], pose[body][1]]),
            At::Mass(body) => {
                let com = mechanism.shape.bodies[body].com.unwrap_or_default();
                view.place(global(pose[body], com))
            }
        };
        let (along, length) = match self.turn {
            Turn::With(body, axis) => {
                let [u, v] = turned(pose[body], axis);
                ([u, -v], 0.0)
            }
            Turn::Towards(to) => {
                let [u, v] = point(to);
                let [u, v] = [u - origin[0], v - origin[1]];
                let length = u.hypot(v);
                // Between two points at one place there is nothing.
                if length < 1e-9 {
                    return;
                }
                ([u / length, v / length], length)
            }
        };
        let seat = Seat {
            origin,
            along,
            length,
            scale: view.scale,
            bar: [view.bar; 2],
            body: self.body,
            strength,
        };
        let points = &mechanism.shape.bodies[self.body].points;
        let bent = bent(&mechanism.shape, pose, self.body).unwrap_or_default();
        let axis: Vec<Place> = bent.into_iter().map(|at| view.place(at)).collect();
        for stroke in &self.sign {
            if seat.draw_bent(scene, stroke, &axis) {
                continue;
            }
            let corners = points.iter().map(|(_, x, y)| metres(*x, *y));
            seat.draw(scene, stroke, corners, |body| pose[body][2]);
        }
    }
}

/// Where a point of a pose is on the page.
pub fn on_page(mechanism: &Mechanism, view: &View, pose: &[Pose], point: PointId) -> Place {
    view.place(place(&mechanism.shape, pose, point))
}
