//! Outlines and the tips that may touch them.

use super::Compiler;
use crate::element::edge::{Edge, End, Piece, Sector};
use crate::element::enclosure::Enclosure;
use crate::element::journal::Journal;
use crate::element::pair::{ContactId, Pair, Shape, Surface};
use crate::element::straight::Straight;
use crate::element::{BodyId, Marker};
use crate::system::{ContactRows, JointId, Owner};
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_model::outline::{Corner, arc_centre};
use linkdyn_model::{Joint, JointKind};
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

/// How deep rigid surfaces are looked for behind the outline, in parts of the mechanism; a tip without radius on one that yields, in
/// parts of the outline, too.
const DEEPEST_RIGID: f64 = 1e-4;
const DEEPEST_POINT: f64 = 1e-2;
/// Sine of a turn between pieces that is none, and the way around a corner, in parts of the mechanism, that is none.
const SMOOTH: f64 = 1e-9;
/// Tangent of half a turn that leaves no material: of a spike.
const SPIKE: f64 = 1e3;

/// A piece of an outline in the frame of its body.
#[derive(Debug, Clone, Copy)]
enum OutlinePiece {
    Straight([Vec2; 2]),
    /// An arc about a centre, which turns left where the radius is positive.
    Arc {
        ends: [Vec2; 2],
        centre: Vec2,
        radius: f64,
    },
}

impl OutlinePiece {
    /// From one point to another, by an arc where there is a radius.
    fn between(from: [f64; 2], to: [f64; 2], radius: f64) -> OutlinePiece {
        let ends = [from, to].map(Vec2::from);
        if radius == 0.0 {
            return OutlinePiece::Straight(ends);
        }
        OutlinePiece::Arc {
            ends,
            centre: arc_centre(from, to, radius).into(),
            radius,
        }
    }

    /// Directions of the way at its beginning and at its end.
    fn directions(&self) -> [Vec2; 2] {
        match self {
            OutlinePiece::Straight([from, to]) => [(to - from).normalize(); 2],
            OutlinePiece::Arc {
                ends,
                centre,
                radius,
            } => ends.map(|end| perp(end - centre).normalize() * radius.signum()),
        }
    }

    fn ends(&self) -> [Vec2; 2] {
        match self {
            OutlinePiece::Straight(ends) | OutlinePiece::Arc { ends, .. } => *ends,
        }
    }

    /// The straight way from end to end \[m\].
    fn chord(&self) -> f64 {
        let [from, to] = self.ends();
        (to - from).norm()
    }
}

impl Compiler<'_> {
    /// Pieces of outlines stand behind all other contacts. They have rows only where they are held, behind all others.
    pub(super) fn add_edges(&mut self) {
        for (k, (name, joint)) in self.model.joints.iter().enumerate() {
            if let JointKind::Contact {
                outline,
                radius,
                arc,
                ..
            } = &joint.kind
            {
                let first = self.system.contacts.len();
                let surface = self.joints.surfaces[name.as_str()].clone();
                let tip = arc.map(|[from, to]| Sector::between(from, to));
                let [end, _] = &joint.between;
                let centre = self.model.bodies[&end.body].points[&end.point];
                let deepest = self.deepest(&surface, *radius, span(outline));
                for corners in joint.kind.outlines_around(centre) {
                    let (ways, own) = (ways(&corners), self.system.contacts.len());
                    let touching = self.tip(joint, *radius, deepest);
                    let pieces = touching.pieces(&ways);
                    // What is no full circle may be inside where it is not round.
                    if tip.is_none() && after(&ways, ways.len() - 1).is_some() {
                        let edges = own..own + pieces.len();
                        let enclosure = touching.enclosure(&ways, edges);
                        self.system.enclosures.push(Arc::new(enclosure));
                    }
                    for (piece, ends) in pieces {
                        let edge = Edge {
                            piece,
                            tip,
                            deepest,
                            size: self.system.size,
                            ends,
                        };
                        self.add_edge(k, edge, &surface);
                    }
                }
                let edges = first..self.system.contacts.len();
                self.system.joints[k].change_extras(|extras| extras.edges = edges);
            }
        }
    }

    /// A tip of this radius that comes in from the side deeper than this is behind the surface \[m\].
    fn deepest(&self, surface: &Surface, radius: f64, span: f64) -> f64 {
        match surface {
            Surface::Rigid(_) => DEEPEST_RIGID * self.system.size,
            Surface::Compliant(_) if radius > 0.0 => radius,
            Surface::Compliant(_) => DEEPEST_POINT * self.system.size.max(span),
        }
    }

    /// The tip of a contact, for a way of its outline whose pieces come next.
    fn tip(&self, joint: &Joint, radius: f64, deepest: f64) -> Tip {
        let [outline, centre] = [0, 1].map(|end: usize| self.marker(&joint.between[end]));
        Tip {
            body: outline.body,
            com: self.com[outline.body.0],
            centre,
            radius,
            deepest,
            size: self.system.size,
            first: self.system.contacts.len(),
        }
    }

    fn add_edge(&mut self, joint: usize, edge: Edge, surface: &Surface) {
        let pair = Pair {
            shape: Shape::Edge(edge),
            surface: surface.clone(),
        };
        let id = ContactId(self.system.contacts.len());
        let rows = ContactRows::of(&pair, id, Owner::Joint(JointId(joint)), None);
        self.system.push_contact(pair, rows);
    }
}

/// A tip, and the outline that it may touch.
struct Tip {
    body: BodyId,
    /// Of the outline's body.
    com: Vec2,
    centre: Marker,
    radius: f64,
    deepest: f64,
    size: f64,
    /// The contact that the first piece is.
    first: usize,
}

/// How one way goes on as the next.
enum Seam {
    /// Around a corner.
    Corner(Piece),
    /// At once; for a point by the tangent of half the turn.
    Over(f64),
    /// The next stands in the way: how far each goes on.
    Hollow([f64; 2]),
}

impl Tip {
    fn marker(&self, place: Vec2) -> Marker {
        Marker {
            body: self.body,
            s: place - self.com,
        }
    }

    fn round(&self, centre: Vec2, bearing_radius: f64, [from, to]: [Vec2; 2]) -> Piece {
        let angle = |way: Vec2| way.y.atan2(way.x);
        let journal = Journal {
            bearing: self.marker(centre),
            journal: self.centre,
            clearance: bearing_radius - self.radius,
            bearing_radius,
        };
        Piece::Round(journal, Sector::between(angle(from), angle(to)))
    }

    fn piece(&self, way: &OutlinePiece) -> Piece {
        match *way {
            OutlinePiece::Straight(ends) => {
                let ends = ends.map(|end| self.marker(end));
                Piece::Straight(Straight::new(ends, self.centre, self.radius, self.size))
            }
            OutlinePiece::Arc {
                ends,
                centre,
                radius,
            } => {
                let [from, to] = ends.map(|end| end - centre);
                match radius > 0.0 {
                    true => self.round(centre, -radius, [from, to]),
                    false => self.round(centre, -radius, [to, from]),
                }
            }
        }
    }

    fn seam(&self, [way, next]: [&OutlinePiece; 2], corner: Vec2) -> Seam {
        let (u, v) = (way.directions()[1], next.directions()[0]);
        let turn = CornerTurn::between(u, v);
        if turn.is_hollow() {
            // The centre of a tip with a radius does not come to the corner.
            let reach = match self.radius > 0.0 {
                true => 0.0,
                false => turn.reach(self.deepest),
            };
            Seam::Hollow([next, way].map(|other| reach.min(0.5 * other.chord())))
        } else if turn.angle * self.radius > SMOOTH * self.size {
            Seam::Corner(self.round(corner, -0.0, [u, v].map(|way| -perp(way))))
        } else {
            let is_point = self.radius == 0.0;
            Seam::Over(if is_point {
                turn.half().min(SPIKE)
            } else {
                0.0
            })
        }
    }

    /// What a closed outline bounds.
    fn enclosure(&self, ways: &[OutlinePiece], edges: Range<usize>) -> Enclosure {
        let ways = ways.iter().map(|way| match *way {
            OutlinePiece::Straight(ends) => (ends, None),
            OutlinePiece::Arc {
                ends,
                centre,
                radius,
            } => (ends, Some((centre, radius > 0.0))),
        });
        Enclosure {
            outline: self.marker(Vec2::zeros()),
            tip: self.centre,
            ways: ways.collect(),
            edges,
        }
    }

    /// What it may touch: the ways, and corners between them, with how each goes on.
    fn pieces(&self, ways: &[OutlinePiece]) -> Vec<(Piece, [End; 2])> {
        let over = |index: usize| End {
            next: Some(ContactId(self.first + index)),
            ..End::default()
        };
        let mut pieces: Vec<(Piece, [End; 2])> = Vec::new();
        let mut begins = End::default();
        for (k, way) in ways.iter().enumerate() {
            let own = pieces.len();
            pieces.push((self.piece(way), [begins, End::default()]));
            begins = End::default();
            let Some((next, corner)) = after(ways, k) else {
                continue;
            };
            let is_last = k + 1 == ways.len();
            // The first follows the last.
            let follows = |index: usize| if is_last { 0 } else { index };
            let (ends, goes_on) = match self.seam([way, next], corner) {
                Seam::Corner(corner) => {
                    pieces.push((corner, [over(own), over(follows(own + 2))]));
                    (over(own + 1), over(own + 1))
                }
                Seam::Over(lean) => {
                    let ends = [over(follows(own + 1)), over(own)];
                    ends.map(|end| End { lean, ..end }).into()
                }
                Seam::Hollow(beyond) => beyond
                    .map(|beyond| End {
                        beyond,
                        ..End::default()
                    })
                    .into(),
            };
            pieces[own].1[1] = ends;
            match is_last {
                true => pieces[0].1[0] = goes_on,
                false => begins = goes_on,
            }
        }
        pieces
    }
}

/// How an outline turns where two ways meet \[rad\]: left, around a convex corner, above 0.
struct CornerTurn {
    angle: f64,
}

impl CornerTurn {
    fn between(u: Vec2, v: Vec2) -> Self {
        let (sin, cos) = (u.x * v.y - u.y * v.x, u.dot(&v));
        let angle = match sin.abs() <= SMOOTH {
            true if cos > 0.0 => 0.0,
            true => PI,
            false => sin.atan2(cos),
        };
        CornerTurn { angle }
    }

    fn is_hollow(&self) -> bool {
        self.angle < 0.0
    }

    /// Tangent of half of it.
    fn half(&self) -> f64 {
        (0.5 * self.angle.abs()).tan()
    }

    /// How far along one way a point is past the corner that is on it, and less deep than this in the other \[m\].
    fn reach(&self, depth: f64) -> f64 {
        let sin = self.angle.sin().abs();
        match self.angle.cos() > 0.0 {
            true => depth / sin,
            false => depth * self.half(),
        }
    }
}

/// How far an outline reaches along an axis \[m\].
fn span(outline: &[Vec<f64>]) -> f64 {
    let along = |axis: usize| {
        let places = || outline.iter().filter_map(move |node| node.get(axis));
        let most = places().fold(f64::NEG_INFINITY, |most: f64, x| most.max(*x));
        most - places().fold(most, |least: f64, x| least.min(*x))
    };
    along(0).max(along(1))
}

/// The way after another, and where they meet; none after the end of an open outline.
fn after(ways: &[OutlinePiece], k: usize) -> Option<(&OutlinePiece, Vec2)> {
    let next = &ways[(k + 1) % ways.len()];
    let [_, to] = ways[k].ends();
    (next.ends()[0] == to).then_some((next, to))
}

fn ways(corners: &[Corner]) -> Vec<OutlinePiece> {
    let pairs = corners.windows(2);
    pairs
        .map(|pair| OutlinePiece::between(pair[0].0, pair[1].0, pair[1].1))
        .collect()
}
