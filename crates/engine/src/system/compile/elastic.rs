//! Elastic links among the bodies: a frame without mass, the amplitudes of its modes, and sections that these carry; or a chain of elements.

use super::Compiler;
use super::links::{LinkModel, ModalLink, axis, only_pins};
use crate::elastic::CarriedPoint;
use crate::element::beam::Beam;
use crate::element::coordinate::Coordinate;
use crate::element::journal::Free;
use crate::element::modal::ModalStiffness;
use crate::element::station::{Amplitude, AmplitudeShare, CarriedSection, Still};
use crate::element::{Axis, BodyId, Constraint, Layout, Marker, Pose};
use crate::system::{
    Block, BodyData, BodyPart, ElasticAxis, Extent, InnerBody, JointData, JointId, Origin,
};
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_model::{Body, ElasticLink};
use nalgebra::DMatrix;
use std::f64::consts::PI;
use std::sync::Arc;

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
                LinkModel::Modal(link) => self.place_link(name, body, own, &link),
                LinkModel::Chain(nodes) => self.place_chain(name, body, own, &nodes),
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
        self.system.layout = Layout::rigid(index + 1);
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
            origin: Vec2::zeros(),
            is_light: false,
            inner: Some(Box::new(InnerBody {
                link: link.to_owned(),
                part,
                carried: None,
            })),
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
    fn place_link(&mut self, name: &'a str, body: &Body, own: &ElasticLink, link: &ModalLink) {
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
        let carried = |at: BodyId, moved: &CarriedPoint| CarriedSection {
            frame,
            section: at,
            place: turned(direction, moved.place),
            shares: amplitudes
                .iter()
                .enumerate()
                .map(|(k, &amplitude)| AmplitudeShare {
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
            // The end of a chord does not deflect, and yet comes closer.
            let mut motions = moved.moves.iter().chain(moved.shortens.iter().flatten());
            let is_held = motions.all(|by| *by == Vec2::zeros());
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
                let last = self.system.bodies.last_mut();
                if let Some(inner) = last.and_then(|last| last.inner.as_mut()) {
                    inner.carried = Some(station.clone());
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
            stretches: own.axial == Some(true),
            shortens: link.modal.second.is_some(),
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
    direction * vector.x + perp(direction) * vector.y
}
