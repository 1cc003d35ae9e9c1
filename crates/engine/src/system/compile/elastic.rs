//! Elastic links: a frame without mass, the amplitudes of its modes, and sections that these carry; or a chain of elastic elements.

use super::Compiler;
use crate::elastic::shapes::{Bar, Place};
use crate::elastic::{Modal, Moved, points};
use crate::element::beam::Beam;
use crate::element::coordinate::Coordinate;
use crate::element::journal::Free;
use crate::element::modal::ModalStiffness;
use crate::element::station::{Amplitude, Share, Station, Still};
use crate::element::{Axis, BodyId, Constraint, Marker, Pose};
use crate::system::{Block, BodyData, BodyPart, ElasticAxis, Extent, JointData, JointId, Origin};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::error::Complaint;
use linkdyn_model::{
    Body, DriverKind, ElasticFrame, ElasticLink, GROUND, Joint, JointKind, ModalData, Model,
    PointRef,
};
use nalgebra::DMatrix;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::Arc;

/// What an elastic body is made of.
pub(super) enum Made {
    /// Few amplitudes.
    Modal(Box<Link>),
    /// Elements between nodes on the axis.
    Chain(Vec<f64>),
}

/// A link by few amplitudes.
pub(super) struct Link {
    modal: Modal,
    /// Mass points: the mass of each \[kg\], and how they move.
    points: (f64, Vec<Moved>),
    /// How its named points move.
    named: Vec<(String, Moved)>,
    /// How places of its axis move, with w″ by each amplitude; none of modal data.
    axis: Vec<(Moved, Vec<f64>)>,
}

/// Parts into which the axis of a link is divided for drawings and internal forces.
const PARTS: usize = 32;

/// Elastic bodies by their names, and where points of them are once these have been placed.
#[derive(Default)]
pub(super) struct Elastic<'a> {
    made: Vec<(&'a str, Made)>,
    places: HashMap<(&'a str, String), Marker>,
    /// Joints that hold what belongs to the links, behind those of the model.
    holds: Vec<(JointData, Arc<dyn Constraint>)>,
}

impl<'a> Elastic<'a> {
    /// Of a model, with complaints about what can't be a body.
    pub fn new(model: &'a Model, complaints: &mut Vec<Complaint>) -> Self {
        let mut elastic = Elastic::default();
        for (name, body) in &model.bodies {
            let Some(own) = body.elastic.as_deref() else {
                continue;
            };
            match made(model, name, body, own) {
                Ok(made) => elastic.made.push((name, made)),
                Err(complaint) => complaints.push(complaint),
            }
        }
        elastic
    }

    /// Where a point of an elastic body is, in place of its body.
    pub fn place(&self, body: &str, point: &str) -> Option<Marker> {
        if self.places.is_empty() {
            return None;
        }
        let mut places = self.places.iter();
        let found = places.find(|((of, at), _)| *of == body && at == point);
        found.map(|(_, marker)| *marker)
    }

    /// Where the frame of an elastic body has its origin, in the body's frame \[m\].
    pub fn origin(&self, name: &str, body: &Body) -> Option<Vec2> {
        self.made.iter().find(|(own, _)| *own == name)?;
        Some(axis(body, body.elastic.as_deref()?).0)
    }
}

/// Beginning \[m\], direction and length \[m\] of the axis.
fn axis(body: &Body, elastic: &ElasticLink) -> (Vec2, Vec2, f64) {
    let [from, to] = elastic.ends(body).unwrap_or([[0.0; 2], [1.0, 0.0]]);
    let (from, to) = (Vec2::from(from), Vec2::from(to));
    (from, unit(to - from), (to - from).norm())
}

fn made(model: &Model, name: &str, body: &Body, elastic: &ElasticLink) -> Result<Made, Complaint> {
    let (from, direction, length) = axis(body, elastic);
    let along = |place: &[f64; 2]| {
        (Vec2::from(*place) - from)
            .dot(&direction)
            .clamp(0.0, length)
    };
    if let Some(elements) = elastic.elements {
        let places = body.points.values().map(along);
        return Ok(Made::Chain(nodes(places.collect(), length, elements)));
    }
    let path = format!("bodies.{name}.elastic");
    let (mut modal, named, axis) = match (&elastic.modal, elastic.bar()) {
        (Some(data), _) => {
            let moved = |(point, place): (&String, &[f64; 2])| {
                let off = Vec2::from(*place) - from;
                let place = Vec2::new(off.dot(&direction), direction.perp(&off));
                (point.clone(), given_point(data, point, place))
            };
            let named = body.points.iter().map(moved).collect();
            (given(data, body, from, direction), named, Vec::new())
        }
        (None, Some(bar)) => {
            let bar = Bar {
                length,
                bending: bar.bending,
                axial: bar.axial.filter(|_| elastic.axial == Some(true)),
                mass: bar.mass,
                rotary: bar.rotary,
                is_chord: elastic.frame != Some(ElasticFrame::Tangent),
                modes: elastic.modes.unwrap_or(2),
                places: places(model, name, body, &along, length),
            };
            let shapes = bar.shapes().ok_or_else(|| {
                Complaint::new(
                    &path,
                    "the bar can't be held: its numbers are too far apart",
                )
                .hint("correct its stiffness and its length")
            })?;
            let shortens = elastic.foreshortening != Some(false);
            let moved = |(point, place): (&String, &[f64; 2])| {
                let mut moved = shapes.moved(along(place));
                moved.shortens.retain(|_| shortens);
                (point.clone(), moved)
            };
            let named = body.points.iter().map(moved).collect();
            let mut modal = shapes.modal();
            modal.second = modal.second.filter(|_| shortens);
            let places = (0..=PARTS).map(|k| {
                let x = length * k as f64 / PARTS as f64;
                let mut curvature: Vec<f64> = shapes.bent_at(x).iter().map(|jet| jet[2]).collect();
                let mut moved = shapes.moved(x);
                curvature.resize(moved.moves.len(), 0.0);
                moved.shortens.retain(|_| shortens);
                (moved, curvature)
            });
            let axis = places.collect();
            (modal, named, axis)
        }
        // The gate has complained.
        (None, None) => {
            return Err(Complaint::new(
                &path,
                "it is not known what the link is made of",
            ));
        }
    };
    modal.damp(elastic.damping);
    let n = modal.count();
    for (key, list) in [
        ("amplitudes", &elastic.amplitudes),
        ("rates", &elastic.rates),
    ] {
        if let Some(list) = list.as_ref().filter(|list| list.len() != n) {
            return Err(Complaint::new(
                format!("{path}.{key}"),
                format!("{} numbers for {n} amplitudes", list.len()),
            )
            .hint(
                "give one for each amplitude: bending shapes first, slowest first, then axial ones",
            ));
        }
    }
    let Some(points) = points::points(&modal) else {
        return Err(Complaint::new(
            path,
            "these numbers belong to no body: a deflection would have no kinetic energy, or a negative one",
        )
        .hint("mass and inertia, \"mass\", \"momentum\", \"radial\", \"angular_momentum\" and \"gyroscopic\" are integrals over one body"));
    };
    Ok(Made::Modal(Box::new(Link {
        modal,
        points,
        named,
        axis,
    })))
}

/// Nodes of a chain: at all places, and between these so many that elements are about as long.
fn nodes(places: Vec<f64>, length: f64, elements: usize) -> Vec<f64> {
    let mut nodes: Vec<f64> = vec![0.0];
    for place in ascending(places, length).into_iter().skip(1) {
        let from = nodes.last().copied().unwrap_or(0.0);
        let parts = (elements as f64 * (place - from) / length).round().max(1.0);
        let between = (1..=parts as usize).map(|k| from + (place - from) * k as f64 / parts);
        nodes.extend(between);
    }
    nodes
}

/// Places, both ends among them, each once.
fn ascending(mut places: Vec<f64>, length: f64) -> Vec<f64> {
    places.extend([0.0, length]);
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| (*a - *b).abs() < 1e-9 * length);
    places
}

/// Where something acts on a bar.
fn places(
    model: &Model,
    name: &str,
    body: &Body,
    along: &dyn Fn(&[f64; 2]) -> f64,
    length: f64,
) -> Vec<Place> {
    let mut acted: Vec<(f64, bool)> = Vec::new();
    let is_driven = |joint: &Joint| {
        let ends = joint.between.each_ref().map(|end| end.body.as_str());
        model.drivers.values().any(|driver| match &driver.kind {
            DriverKind::Rotation { body, relative_to } => {
                let other = relative_to.as_deref().unwrap_or(GROUND);
                ends == [body, other] || ends == [other, body]
            }
            DriverKind::Translation { .. }
            | DriverKind::Length { .. }
            | DriverKind::Point { .. } => false,
        })
    };
    for (point, place) in &body.points {
        let x = along(place);
        for joint in model.joints.values() {
            let is_here = |end: &PointRef| end.body == name && end.point == *point;
            if joint.between.iter().any(is_here) {
                let is_pin = matches!(joint.kind, JointKind::Revolute { .. });
                acted.push((x, !is_pin || is_driven(joint)));
            }
        }
        if model.forces_name(name, point) {
            acted.push((x, false));
        }
    }
    let all = ascending(acted.iter().map(|(x, _)| *x).collect(), length);
    let near = |x: f64| {
        acted
            .iter()
            .filter(move |(own, _)| (own - x).abs() < 1e-8 * length)
    };
    all.into_iter()
        .map(|x| Place {
            x,
            is_pushed: near(x).next().is_some(),
            is_turned: near(x).any(|(_, turns)| *turns),
            hinge: None,
        })
        .collect()
}

/// Whether nothing at a point asks how its section turns: ideal pins without friction alone are there.
fn only_pins(model: &Model, name: &str, point: &str) -> bool {
    let is_here = |end: &PointRef| end.body == name && end.point == point;
    let is_plain = |joint: &Joint| match &joint.kind {
        JointKind::Revolute {
            clearance,
            friction,
            ..
        } => clearance.is_none() && friction.is_none() && joint.stops == Default::default(),
        _ => false,
    };
    let mut joints = model.joints.values();
    joints.all(|joint| !joint.between.iter().any(is_here) || is_plain(joint))
}

fn matrix(rows: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j])
}

/// A body by matrices of the file, in axes from `from` to `to`.
fn given(data: &ModalData, body: &Body, from: Vec2, direction: Vec2) -> Modal {
    let n = data.mass.len();
    let zero = || DMatrix::zeros(n, n);
    let (mass, inertia) = (body.mass.unwrap_or(0.0), body.inertia.unwrap_or(0.0));
    let off = body.com.map_or(Vec2::zeros(), Vec2::from) - from;
    let com = Vec2::new(off.dot(&direction), direction.perp(&off));
    Modal {
        rigid: (mass, com * mass, inertia + mass * com.norm_squared()),
        matrices: [
            matrix(&data.mass),
            matrix(&data.stiffness),
            data.damping.as_deref().map_or_else(zero, matrix),
        ],
        momentum: data.momentum.iter().map(|&both| Vec2::from(both)).collect(),
        moments: [data.radial.clone(), data.angular_momentum.clone()],
        gyroscopic: data.gyroscopic.as_deref().map_or_else(zero, matrix),
        second: None,
    }
}

/// How a point of such a body moves; one that is not named stays in the frame.
fn given_point(data: &ModalData, point: &str, place: Vec2) -> Moved {
    let n = data.mass.len();
    let own = data.points.get(point);
    Moved {
        place,
        moves: own.map_or(vec![Vec2::zeros(); n], |own| {
            own.displacement
                .iter()
                .map(|&both| Vec2::from(both))
                .collect()
        }),
        turns: own.map_or(vec![0.0; n], |own| own.rotation.clone()),
        shortens: Vec::new(),
    }
}

impl<'a> Compiler<'a> {
    /// Places what elastic bodies consist of behind the bodies of the model.
    pub(super) fn place_elastic(&mut self) {
        let model = self.model;
        for (name, made) in std::mem::take(&mut self.elastic.made) {
            let body = &model.bodies[name];
            let Some(own) = body.elastic.as_deref() else {
                continue;
            };
            match made {
                Made::Modal(link) => self.place_link(name, body, own, &link),
                Made::Chain(nodes) => self.place_chain(name, body, own, &nodes),
            }
        }
    }

    /// A body of an elastic link, where the frame of this is drawn.
    fn push_part(
        &mut self,
        link: &str,
        (part, point): (BodyPart, &str),
        pose: [f64; 3],
        mass: f64,
    ) -> BodyId {
        let index = self.system.bodies.len();
        self.system.layout = crate::element::Layout::rigid(index + 1);
        self.system.guess.extend(pose);
        self.system.mass.push_rigid(mass, 0.0);
        let own = match part {
            BodyPart::Amplitudes { first, count: 1 } => format!("{link}.q{}", first + 1),
            BodyPart::Amplitudes { first, .. } => format!("{link}.q{}-q{}", first + 1, first + 2),
            BodyPart::Node(k) => format!("{link}.node{k}"),
            BodyPart::Section => format!("{link}.section_{point}"),
            BodyPart::Own | BodyPart::MassPoint => link.to_owned(),
        };
        self.system.bodies.push(BodyData {
            name: own,
            link: link.to_owned(),
            origin: Vec2::zeros(),
            is_light: false,
            part,
            carried: None,
        });
        self.system.extents.push(Extent::default());
        self.com.push(Vec2::zeros());
        BodyId::moving(index)
    }

    fn drawn_pose(&self, body: BodyId) -> Pose {
        let columns = self.system.layout.columns(body);
        let [x, y, theta] = columns.map_or([0.0; 3], |columns| columns.read(&self.system.guess));
        Pose::new(x, y, theta)
    }

    /// A link by few amplitudes.
    fn place_link(&mut self, name: &'a str, body: &Body, own: &ElasticLink, link: &Link) {
        let (_, direction, _) = axis(body, own);
        let frame = self.body(name);
        let n = link.modal.count();
        let start = |list: &Option<Vec<f64>>, k: usize| list.as_ref().map_or(0.0, |list| list[k]);
        let mut amplitudes = Vec::with_capacity(n);
        for first in (0..n).step_by(2) {
            let count = (n - first).min(2);
            let value = |k: usize| {
                if k < count {
                    start(&own.amplitudes, first + k)
                } else {
                    0.0
                }
            };
            let part = BodyPart::Amplitudes { first, count };
            let at = self.push_part(name, (part, ""), [value(0), value(1), 0.0], 0.0);
            let origin = Marker {
                body: at,
                s: Vec2::zeros(),
            };
            // What is no amplitude stays where it is.
            for (axis, number) in [(Axis::X, first), (Axis::Y, first + 1)] {
                if number >= n {
                    continue;
                }
                amplitudes.push(Amplitude { body: at, axis });
                let held = |value: f64| Coordinate {
                    origin,
                    axis,
                    value,
                    drive: None,
                };
                let key = format!("{name}.q{}", number + 1);
                let block = Block::alone(
                    Arc::new(held(start(&own.amplitudes, number))),
                    Origin::Initial(Box::new(key.clone())),
                );
                self.system
                    .starts
                    .push(held(start(&own.amplitudes, number)));
                self.system.initial.push(block);
                let rate = held(start(&own.rates, number));
                self.system
                    .initial_rates
                    .push((format!("{key}_rate"), rate));
            }
            let rest: &[Axis] = if count == 2 {
                &[Axis::Theta]
            } else {
                &[Axis::Y, Axis::Theta]
            };
            let still = Still {
                body: at,
                axes: rest,
            };
            self.hold(name, [frame, at], Arc::new(still));
        }
        let carried = |at: BodyId, moved: &Moved| Station {
            frame,
            section: at,
            place: turned(direction, moved.place),
            shares: amplitudes
                .iter()
                .enumerate()
                .map(|(k, &amplitude)| Share {
                    amplitude,
                    moves: turned(direction, moved.moves[k]),
                    turns: moved.turns[k],
                })
                .collect(),
            shortens: moved
                .shortens
                .iter()
                .flatten()
                .map(|&second| turned(direction, second))
                .collect(),
        };
        let (mass, points) = &link.points;
        let masses = points.iter().map(|moved| (None, moved, *mass));
        let named = link
            .named
            .iter()
            .map(|(point, moved)| (Some(point), moved, 0.0));
        for (point, moved, mass) in masses.chain(named) {
            let place = turned(direction, moved.place);
            let is_held = moved.moves.iter().all(|by| *by == Vec2::zeros());
            let is_still = is_held
                && (moved.turns.iter().all(|by| *by == 0.0)
                    || point.is_some_and(|point| only_pins(self.model, name, point)));
            let marker = if point.is_some() && is_still {
                Marker {
                    body: frame,
                    s: place,
                }
            } else {
                let pose = self.drawn_pose(frame);
                let at = pose.r + pose.turn(place);
                let place = [at.x, at.y, pose.theta];
                let part = match point {
                    Some(point) => (BodyPart::Section, point.as_str()),
                    None => (BodyPart::MassPoint, ""),
                };
                let section = self.push_part(name, part, place, mass);
                let station = Arc::new(carried(section, moved));
                if let Some(data) = self.system.bodies.last_mut() {
                    data.carried = Some(station.clone());
                }
                self.hold(name, [frame, section], station);
                Marker {
                    body: section,
                    s: Vec2::zeros(),
                }
            };
            if let Some(point) = point {
                self.elastic.places.insert((name, point.clone()), marker);
            }
        }
        self.system.axes.push(ElasticAxis {
            body: frame.0 - 1,
            stations: link
                .axis
                .iter()
                .map(|(moved, _)| carried(frame, moved))
                .collect(),
            curvatures: link.axis.iter().map(|(_, by)| by.clone()).collect(),
            amplitudes: amplitudes.clone(),
            frequencies: link.modal.frequencies(),
            is: [own.axial == Some(true), link.modal.second.is_some()],
            heavy: own.bar().map_or([0.0; 2], |bar| {
                let (_, _, length) = axis(body, own);
                [bar.mass * length, bar.rotary * length]
            }),
        });
        let rows = |matrix: &DMatrix<f64>| matrix.transpose().iter().copied().collect();
        let [_, stiffness, damping] = &link.modal.matrices;
        self.elastic_forces.push(Arc::new(ModalStiffness {
            amplitudes,
            stiffness: rows(stiffness),
            damping: rows(damping),
        }));
    }

    /// A joint of what belongs to a link.
    fn hold(&mut self, name: &str, bodies: [BodyId; 2], constraint: Arc<dyn Constraint>) {
        let points = bodies.map(|body| Marker {
            body,
            s: Vec2::zeros(),
        });
        let data = JointData::inner(name, points);
        self.elastic.holds.push((data, constraint));
    }

    /// A chain of elements between rigid parts; the first of these is the body itself.
    fn place_chain(&mut self, name: &'a str, body: &Body, own: &ElasticLink, nodes: &[f64]) {
        let (_, direction, length) = axis(body, own);
        let Some(bar) = own.bar() else { return };
        let frame = self.body(name);
        let angle = direction.y.atan2(direction.x);
        // ζ of the first mode of the bar on two pins.
        let slowest = (PI / length).powi(2) * (bar.bending / bar.mass).sqrt();
        let mut ends = vec![frame];
        for (k, x) in nodes.iter().enumerate().skip(1) {
            let pose = self.drawn_pose(frame);
            let at = pose.r + pose.turn(direction * *x);
            let part = BodyPart::Node(k);
            let id = self.push_part(name, (part, ""), [at.x, at.y, pose.theta], 0.0);
            ends.push(id);
        }
        for (k, &body) in ends.iter().enumerate() {
            let before = if k == 0 { 0.0 } else { nodes[k] - nodes[k - 1] };
            let behind = nodes.get(k + 1).map_or(0.0, |next| next - nodes[k]);
            let part = (before + behind) / 2.0;
            let inertia = bar.mass * (before.powi(3) + behind.powi(3)) / 24.0 + bar.rotary * part;
            if let Some(columns) = self.system.layout.columns(body) {
                self.system
                    .mass
                    .set_rigid(columns, bar.mass * part, inertia);
            }
        }
        for (k, pair) in ends.windows(2).enumerate() {
            let [first, second] = [pair[0], pair[1]].map(|body| Marker {
                body,
                s: Vec2::zeros(),
            });
            let beam = Beam {
                first,
                second,
                stiffness: [bar.axial.unwrap_or(0.0), bar.bending, f64::INFINITY],
                length: nodes[k + 1] - nodes[k],
                angles: [angle; 2],
                damping: 2.0 * own.damping / slowest,
            };
            let data = JointData::inner(name, [first, second]);
            self.elastic.holds.push((data, Arc::new(Free)));
            self.elastic_forces.push(Arc::new(beam));
        }
        for (point, place) in &body.points {
            let (from, ..) = axis(body, own);
            let x = (Vec2::from(*place) - from).dot(&direction);
            let near = |k: &usize| (nodes[*k] - x).abs();
            let node = (0..nodes.len()).min_by(|a, b| near(a).total_cmp(&near(b)));
            let marker = Marker {
                body: ends[node.unwrap_or(0)],
                s: Vec2::zeros(),
            };
            self.elastic.places.insert((name, point.clone()), marker);
        }
    }

    /// Holds what belongs to elastic links, behind the joints of the model.
    pub(super) fn hold_elastic(&mut self) {
        for (data, constraint) in std::mem::take(&mut self.elastic.holds) {
            let id = JointId(self.system.joints.len());
            self.system.joints.push(data);
            self.push_block(constraint, Origin::Joint(id));
        }
    }
}

/// A vector of the axes along a direction, in the axes in which that is given.
fn turned(direction: Vec2, vector: Vec2) -> Vec2 {
    direction * vector.x + linkdyn_linear::math::perp(direction) * vector.y
}
