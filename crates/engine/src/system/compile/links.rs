//! What elastic links are made of: their modes and mass points, or the nodes of a chain, before they have places among the bodies.

use crate::elastic::shapes::{Bar, Place};
use crate::elastic::{CarriedPoint, Modal, points};
use crate::element::{Constraint, Marker};
use crate::system::JointData;
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::error::Complaint;
use linkdyn_model::{
    Body, DriverKind, ElasticFrame, ElasticLink, GROUND, Joint, JointKind, ModalData, Model,
    PointRef, SectionShape,
};
use nalgebra::DMatrix;
use std::collections::HashMap;
use std::sync::Arc;

/// What an elastic body is made of.
pub(super) enum LinkModel {
    /// Few amplitudes.
    Modal(Box<ModalLink>),
    /// Elements between nodes on the axis.
    Chain(Vec<f64>),
}

/// A link by few amplitudes.
pub(super) struct ModalLink {
    pub(super) modal: Modal,
    /// Mass points: the mass of each \[kg\], and how they move.
    pub(super) points: (f64, Vec<CarriedPoint>),
    /// How its named points move.
    pub(super) named: Vec<(String, CarriedPoint)>,
    /// How places of its axis move, with w″ by each amplitude; none of modal data.
    pub(super) axis: Vec<(CarriedPoint, Vec<f64>)>,
}

/// Parts into which the axis of a link is divided for drawings and internal forces.
const PARTS: usize = 32;

/// Elastic bodies by their names, and where points of them are once these have been placed.
#[derive(Default)]
pub(super) struct Elastic<'a> {
    pub(super) made: Vec<(&'a str, LinkModel)>,
    pub(super) places: HashMap<(&'a str, String), Marker>,
    /// Joints that hold what belongs to the links, behind those of the model.
    pub(super) holds: Vec<(JointData, Arc<dyn Constraint>)>,
}

impl<'a> Elastic<'a> {
    /// Of a model, with complaints about what can't be a body.
    pub(super) fn new(model: &'a Model, complaints: &mut Vec<Complaint>) -> Self {
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
    pub(super) fn place(&self, body: &str, point: &str) -> Option<Marker> {
        if self.places.is_empty() {
            return None;
        }
        let mut places = self.places.iter();
        let found = places.find(|((of, at), _)| *of == body && at == point);
        found.map(|(_, marker)| *marker)
    }

    /// Where the frame of an elastic body has its origin, in the body's frame \[m\].
    pub(super) fn origin(&self, name: &str, body: &Body) -> Option<Vec2> {
        self.made.iter().find(|(own, _)| *own == name)?;
        Some(axis(body, body.elastic.as_deref()?).0)
    }
}

/// Beginning \[m\], direction and length \[m\] of the axis.
pub(super) fn axis(body: &Body, elastic: &ElasticLink) -> (Vec2, Vec2, f64) {
    let [from, to] = elastic.ends(body).unwrap_or([[0.0; 2], [1.0, 0.0]]);
    let (from, to) = (Vec2::from(from), Vec2::from(to));
    (from, unit(to - from), (to - from).norm())
}

fn made(
    model: &Model,
    name: &str,
    body: &Body,
    elastic: &ElasticLink,
) -> Result<LinkModel, Complaint> {
    let (from, direction, length) = axis(body, elastic);
    let along = |place: &[f64; 2]| {
        (Vec2::from(*place) - from)
            .dot(&direction)
            .clamp(0.0, length)
    };
    if let Some(elements) = elastic.elements {
        let places = body.points.values().map(along);
        return Ok(LinkModel::Chain(nodes(places.collect(), length, elements)));
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
                places: with_cracks(places(model, name, body, &along, length), elastic, length),
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
                format!("a list of {n} is expected, this one has {}", list.len()),
            )
            .hint("one for each amplitude: bending shapes first, slowest first, then axial ones"));
        }
    }
    let Some(points) = points::points(&modal) else {
        return Err(Complaint::new(
            path,
            "these numbers belong to no body: a deflection would have no kinetic energy, or a negative one",
        )
        .hint("mass and inertia, \"mass\", \"momentum\", \"radial\", \"angular_momentum\" and \"gyroscopic\" are integrals over one body"));
    };
    Ok(LinkModel::Modal(Box::new(ModalLink {
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

/// Places on a bar with its cracks, which are hinges.
fn with_cracks(mut places: Vec<Place>, elastic: &ElasticLink, length: f64) -> Vec<Place> {
    let Some(SectionShape::Rectangle { width, height }) = elastic.section else {
        return places;
    };
    for crack in elastic.cracks.iter().flatten() {
        let young = elastic.young().unwrap_or(0.0);
        let compliance = 1.0 / crack.stiffness(young, [width, height]);
        let near = |place: &Place| (place.x - crack.at).abs() < 1e-9 * length;
        let index = match places.iter().position(near) {
            Some(index) => index,
            None => {
                let index = places.iter().filter(|place| place.x < crack.at).count();
                let x = crack.at;
                places.insert(
                    index,
                    Place {
                        x,
                        ..Place::default()
                    },
                );
                index
            }
        };
        // Of two in one place each yields.
        let before = places[index].hinge.map_or(0.0, |hinge| 1.0 / hinge);
        places[index].hinge = Some(1.0 / (before + compliance));
    }
    places
}

/// Whether nothing at a point asks how its section turns: ideal pins without friction alone are there.
pub(super) fn only_pins(model: &Model, name: &str, point: &str) -> bool {
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
fn given_point(data: &ModalData, point: &str, place: Vec2) -> CarriedPoint {
    let n = data.mass.len();
    let own = data.points.get(point);
    CarriedPoint {
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
