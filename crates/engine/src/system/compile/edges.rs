//! Outlines and the tips that may touch them.

use super::Compiler;
use super::contact_parameters::compared;
use crate::contact::impact::Sense;
use crate::contact::{friction, normal};
use crate::element::Marker;
use crate::element::edge::{Edge, Piece, Sector};
use crate::element::journal::{Free, Journal};
use crate::element::pair::{Compliant, ContactId, Pair, Rigid, Shape, Surface};
use crate::element::straight::Straight;
use crate::system::{ContactRows, JointId, Origin, Owner};
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_model::outline::{Corner, arc_centre};
use linkdyn_model::{Joint, JointKind};
use std::sync::Arc;

/// How deep rigid surfaces are looked for behind the outline, in parts of the mechanism; a tip without radius on one that yields.
const DEEPEST_RIGID: f64 = 1e-4;
const DEEPEST_POINT: f64 = 1e-2;
/// Sine of a turn between pieces that is none.
const SMOOTH: f64 = 1e-9;

/// A piece of an outline in the frame of its body.
#[derive(Debug, Clone, Copy)]
enum Way {
    Straight([Vec2; 2]),
    /// An arc about a centre, which turns left where the radius is positive.
    Arc {
        ends: [Vec2; 2],
        centre: Vec2,
        radius: f64,
    },
}

impl Way {
    /// From one point to another, by an arc where there is a radius.
    fn between(from: [f64; 2], to: [f64; 2], radius: f64) -> Way {
        let ends = [from, to].map(Vec2::from);
        if radius == 0.0 {
            return Way::Straight(ends);
        }
        Way::Arc {
            ends,
            centre: arc_centre(from, to, radius).into(),
            radius,
        }
    }

    /// Directions of the way at its beginning and at its end.
    fn directions(&self) -> [Vec2; 2] {
        match self {
            Way::Straight([from, to]) => [(to - from).normalize(); 2],
            Way::Arc {
                ends,
                centre,
                radius,
            } => ends.map(|end| perp(end - centre).normalize() * radius.signum()),
        }
    }
}

impl Compiler<'_> {
    /// Pieces of outlines stand behind all other contacts, and their rows behind all others.
    pub(super) fn add_edges(&mut self) {
        for (k, (name, joint)) in self.model.joints.iter().enumerate() {
            if let JointKind::Contact { radius, arc, .. } = &joint.kind {
                let first = self.system.contacts.len();
                let surface = self.joints.surfaces[name.as_str()].clone();
                let tip = arc.map(|[from, to]| Sector::between(from, to));
                let [end, _] = &joint.between;
                let centre = self.model.bodies[&end.body].points[&end.point];
                for corners in joint.kind.outlines_around(centre) {
                    for piece in self.pieces(joint, &ways(&corners), *radius) {
                        self.add_edge(k, piece, (tip, *radius), &surface);
                    }
                }
                let edges = first..self.system.contacts.len();
                self.system.joints[k].change_extras(|extras| extras.edges = edges);
            }
        }
    }

    fn add_edge(
        &mut self,
        joint: usize,
        piece: Piece,
        (tip, radius): (Option<Sector>, f64),
        surface: &Surface,
    ) {
        let size = self.system.size;
        let deepest = match surface {
            Surface::Rigid(_) => DEEPEST_RIGID * size,
            Surface::Compliant(_) if radius > 0.0 => radius,
            Surface::Compliant(_) => DEEPEST_POINT * size,
        };
        let pair = Pair {
            shape: Shape::Edge(Edge {
                piece,
                tip,
                deepest,
                size,
            }),
            surface: surface.clone(),
        };
        let id = ContactId(self.system.contacts.len());
        let block = self.system.blocks.len();
        self.push_block(Arc::new(Free), Origin::Stop(id));
        let rows = ContactRows::of(&pair, id, Owner::Joint(JointId(joint)), block);
        self.system.contact_rows.push(rows);
        self.system.contacts.push(pair);
    }

    /// What a tip of this radius may touch: the ways, and corners between them.
    fn pieces(&self, joint: &Joint, ways: &[Way], radius: f64) -> Vec<Piece> {
        let [outline, tip] = [0, 1].map(|end: usize| self.marker(&joint.between[end]));
        let body = outline.body;
        let marker = |place: Vec2| Marker {
            body,
            s: place - self.com[body.0],
        };
        let round = |centre: Vec2, bearing_radius: f64, sector: Sector| {
            let journal = Journal {
                bearing: marker(centre),
                journal: tip,
                clearance: bearing_radius - radius,
                bearing_radius,
            };
            Piece::Round(journal, sector)
        };
        let angle = |way: Vec2| way.y.atan2(way.x);
        let mut pieces = Vec::new();
        for (k, way) in ways.iter().enumerate() {
            pieces.push(match *way {
                Way::Straight(ends) => {
                    let size = self.system.size;
                    Piece::Straight(Straight::new(ends.map(marker), tip, radius, size))
                }
                Way::Arc {
                    ends: [from, to],
                    centre,
                    radius,
                } => {
                    let [from, to] = [from, to].map(|end| angle(end - centre));
                    match radius > 0.0 {
                        true => round(centre, -radius, Sector::between(from, to)),
                        false => round(centre, -radius, Sector::between(to, from)),
                    }
                }
            });
            let Some((next, corner)) = after(ways, k) else {
                continue;
            };
            let (u, v) = (way.directions()[1], next.directions()[0]);
            let turn = u.x * v.y - u.y * v.x;
            let is_convex = turn > SMOOTH || (turn.abs() <= SMOOTH && u.dot(&v) < 0.0);
            if is_convex && radius > 0.0 {
                let [from, to] = [u, v].map(|way| angle(-perp(way)));
                pieces.push(round(corner, -0.0, Sector::between(from, to)));
            }
        }
        pieces
    }
}

/// The way after another, and where they meet; none after the end of an open outline.
fn after(ways: &[Way], k: usize) -> Option<(&Way, Vec2)> {
    let ends = |way: &Way| match way {
        Way::Straight(ends) | Way::Arc { ends, .. } => *ends,
    };
    let next = &ways[(k + 1) % ways.len()];
    let [_, to] = ends(&ways[k]);
    (ends(next)[0] == to).then_some((next, to))
}

fn ways(corners: &[Corner]) -> Vec<Way> {
    let pairs = corners.windows(2);
    pairs
        .map(|pair| Way::between(pair[0].0, pair[1].0, pair[1].1))
        .collect()
}

/// What an outline and a tip are made of; friction as it stands in the file.
pub(super) fn surface(joint: &Joint, friction: friction::Law, coefficient: f64) -> Surface {
    let stops = &joint.stops;
    match stops.stiffness {
        Some(stiffness) => Surface::Compliant(Compliant {
            normal: normal::Law::KelvinVoigt {
                stiffness,
                damping: stops.damping.unwrap_or(0.0),
            },
            friction,
        }),
        None => Surface::Rigid(Rigid {
            restitution: stops.restitution.unwrap_or(0.0),
            friction: coefficient,
            sense: stops.sense.map_or(Sense::Kinematic, compared),
            latch: None,
        }),
    }
}
