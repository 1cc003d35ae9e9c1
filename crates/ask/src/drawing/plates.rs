//! Each body as a plate in its own frame: an outline around its points, holes, slots, and the curves that its joints give it.

use std::f64::consts::TAU;

use linkdyn_exchange::export::around;
use linkdyn_exchange::{Corner, Form};
use linkdyn_model::outline::{Corner as Node, arc_centre};
use linkdyn_model::{Checked, GROUND};
use linkdyn_picture::hull;
use linkdyn_picture::poses::{Pose, global};
use linkdyn_picture::shape::{Joint, JointKind, PitchCircles, Shape};

use super::poses::PlacedRows;
use crate::shape::with_profiles;

/// Width of a link in parts of the mechanism and of its shortest bar, and its hole in widths.
const WIDTH: f64 = 1.0 / 14.0;
const SHORTEST: f64 = 0.6;
pub const HOLE: f64 = 0.3;
/// Without a size \[m\].
const ANY: f64 = 0.02;
/// Widths that are round numbers.
const ROUND: [f64; 11] = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
/// Half the length and half the height of a block, in widths.
const BLOCK: [f64; 2] = [0.8, 0.5];
/// A rack reaches beyond its wheel's way by this, in radii of the wheel.
const BEYOND: f64 = 0.6;

/// A body in its own frame \[m\].
#[derive(Debug)]
pub struct Plate {
    pub name: String,
    /// Names and places of its points.
    pub points: Vec<(String, [f64; 2])>,
    /// Its outer line; none of a wheel or a block, which have one of their own.
    outline: Option<Form>,
    /// All lines but the outline: holes, slots, wheels, cams.
    pub inner: Vec<Form>,
    /// Centres of its holes.
    pub holes: Vec<[f64; 2]>,
}

impl Plate {
    /// All lines.
    pub fn all(&self) -> Vec<Form> {
        self.outline.iter().chain(&self.inner).cloned().collect()
    }

    pub fn is_empty(&self) -> bool {
        self.outline.is_none() && self.inner.is_empty()
    }
}

/// A round width of links for a mechanism in a pose \[m\].
pub fn width(model: &Checked, pose: &[Pose]) -> f64 {
    let shape = Shape::of_model(model);
    let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let mut places: Vec<[f64; 2]> = Vec::new();
    let mut bars: Vec<f64> = Vec::new();
    for (body, pose) in shape.bodies.iter().zip(pose) {
        let own: Vec<[f64; 2]> = body.points.iter().map(|(_, x, y)| [*x, *y]).collect();
        if body.name != GROUND {
            bars.extend(own.windows(2).map(|pair| distance(pair[0], pair[1])));
        }
        places.extend(own.iter().map(|at| global(*pose, *at)));
    }
    let first = places.first().copied().unwrap_or_default();
    let size = places
        .iter()
        .map(|at| distance(*at, first))
        .fold(0.0, f64::max);
    let shortest = bars.into_iter().filter(|bar| *bar > 1e-3 * size);
    let most = (WIDTH * size).min(SHORTEST * shortest.fold(f64::INFINITY, f64::min));
    if !most.is_normal() {
        return ANY;
    }
    let ten = 10f64.powf(most.log10().floor());
    let round = ROUND.iter().rev().find(|round| *round * ten <= most);
    // In millimetres, so that it is written as a round number.
    format!("{:.1e}", round.unwrap_or(&1.0) * ten)
        .parse()
        .unwrap_or(most)
}

/// The plates of all bodies, the ground first.
pub fn plates(model: &Checked, rows: &PlacedRows, width: f64, hole: f64) -> Vec<Plate> {
    let shape = with_profiles(model);
    let mut making = Making {
        bodies: shape.bodies.iter().map(|_| PlateDraft::default()).collect(),
        shape: &shape,
        rows,
        width,
        hole,
    };
    for (joint, own) in shape.joints.iter().zip(model.joints.values()) {
        making.add(joint);
        // Outlines of contacts with their arcs.
        let at = making.at(joint, 0);
        for way in own.kind.outlines_around(at) {
            making.put(joint, 0, outline(&way));
        }
    }
    let made = std::mem::take(&mut making.bodies);
    let bodies = shape.bodies.iter().zip(made);
    bodies
        .map(|(body, made)| made.plate(&body.name, &body.points, [width, hole]))
        .collect()
}

/// A plate while its joints are looked at.
#[derive(Default)]
struct PlateDraft {
    inner: Vec<Form>,
    holes: Vec<[f64; 2]>,
    /// Ends of slots, which its outline is around, too.
    slots: Vec<[f64; 2]>,
    has_block: bool,
}

impl PlateDraft {
    fn hole(&mut self, at: [f64; 2]) {
        if !self.holes.contains(&at) {
            self.holes.push(at);
        }
    }

    fn plate(
        mut self,
        name: &str,
        points: &[(String, f64, f64)],
        [width, hole]: [f64; 2],
    ) -> Plate {
        let mut points: Vec<(String, [f64; 2])> = points
            .iter()
            .map(|(name, x, y)| (name.clone(), [*x, *y]))
            .collect();
        // Of the ground only pins are drawn: its other points are ends of springs, and of ways.
        points.retain(|(_, at)| name != GROUND || self.holes.contains(at));
        let places = points.iter().map(|(_, at)| *at).chain(self.slots);
        let corners = hull(&places.collect::<Vec<_>>());
        let is_closed = |form: &Form| match form {
            Form::Line { closed, .. } => *closed,
            Form::Circle { .. } => true,
            Form::Point(_) | Form::Text { .. } => false,
        };
        let is_own = corners.len() < 2 && (self.has_block || self.inner.iter().any(is_closed));
        let outline = (!corners.is_empty() && !is_own).then(|| around(&corners, width / 2.0));
        let holes = self.holes.iter().map(|centre| Form::Circle {
            centre: *centre,
            radius: hole / 2.0,
        });
        self.inner.extend(holes);
        let marks = points.iter().filter(|(_, at)| !self.holes.contains(at));
        self.inner.extend(marks.map(|(_, at)| Form::Point(*at)));
        Plate {
            name: name.to_owned(),
            outline,
            inner: self.inner,
            holes: self.holes,
            points,
        }
    }
}

struct Making<'m> {
    bodies: Vec<PlateDraft>,
    shape: &'m Shape,
    rows: &'m PlacedRows,
    width: f64,
    hole: f64,
}

impl Making<'_> {
    /// Place of a point of a joint in its body.
    fn at(&self, joint: &Joint, end: usize) -> [f64; 2] {
        self.shape.point(joint.between[end]).unwrap_or_default()
    }

    fn put(&mut self, joint: &Joint, end: usize, form: Form) {
        // What several joints touch is cut once.
        let inner = &mut self.bodies[joint.between[end].0].inner;
        if !inner.contains(&form) {
            inner.push(form);
        }
    }

    fn circle(&mut self, joint: &Joint, end: usize, radius: f64) {
        let centre = self.at(joint, end);
        if radius > 0.0 {
            self.put(joint, end, Form::Circle { centre, radius });
        }
    }

    /// A straight through a point of a joint between two places along a direction of its body.
    fn straight(&mut self, joint: &Joint, end: usize, [u, v]: [f64; 2], ends: [f64; 2]) {
        let [x, y] = self.at(joint, end);
        let line = ends.map(|s| [x + s * u, y + s * v]);
        self.put(joint, end, Form::line(line, false));
    }

    fn add(&mut self, joint: &Joint) {
        let [first, second] = joint.between.map(|(body, _)| body);
        match &joint.kind {
            JointKind::Revolute { .. } | JointKind::Bushing => {
                for (body, end) in [(first, 0), (second, 1)] {
                    let at = self.at(joint, end);
                    self.bodies[body].hole(at);
                }
            }
            JointKind::Slot { .. } => {
                let Some(axis) = joint.axis() else { return };
                let [low, high] = self.reach(joint, axis);
                let [x, y] = self.at(joint, 0);
                let ends = [low, high].map(|s| [x + s * axis[0], y + s * axis[1]]);
                // Both ends at one place are a hole.
                self.bodies[first]
                    .inner
                    .push(around(&hull(&ends), self.hole / 2.0));
                self.bodies[first].slots.extend(ends);
                let at = self.at(joint, 1);
                self.bodies[second].hole(at);
            }
            JointKind::Prismatic { .. } => {
                let Some(axis) = joint.axis() else { return };
                let reach = self.reach(joint, axis);
                self.straight(joint, 0, axis, reach);
                if second != 0 {
                    let turn = self.rows.pose[first][2] - self.rows.pose[second][2];
                    let [u, v] = global([0.0, 0.0, turn], axis);
                    let [x, y] = self.at(joint, 1);
                    let [long, high] = BLOCK.map(|part| part * self.width);
                    let corners = [[-long, -high], [long, -high], [long, high], [-long, high]];
                    let corners = corners.map(|[s, n]| [x + s * u - n * v, y + s * v + n * u]);
                    self.put(joint, 1, Form::line(corners, true));
                    self.bodies[second].has_block = true;
                }
            }
            JointKind::Gear { ratio, gear } => {
                let centres = [0, 1].map(|end| {
                    let body = joint.between[end].0;
                    global(self.rows.pose[body], self.at(joint, end))
                });
                let far = (centres[1][0] - centres[0][0]).hypot(centres[1][1] - centres[0][1]);
                let wheels = gear.or_else(|| PitchCircles::of_wheels(*ratio, far, 0));
                for (end, radius) in wheels
                    .into_iter()
                    .flat_map(|gear| [0, 1].into_iter().zip(gear.radii))
                {
                    self.circle(joint, end, radius);
                }
            }
            JointKind::Rolling { radii } => {
                (0..2).for_each(|end| self.circle(joint, end, radii[end].abs()));
            }
            JointKind::Belt { belt } => {
                (0..2).for_each(|end| self.circle(joint, end, belt.radii[end]));
            }
            JointKind::Rack { rack } => {
                let radius = rack.radius.abs();
                self.circle(joint, 0, radius);
                // The wheel is the first body: its way is seen from the rack.
                let mut turned = joint.clone();
                turned.between.reverse();
                let [low, high] = self.rows.reach(self.shape, &turned, rack.axis);
                let ends = [low - BEYOND * radius, high + BEYOND * radius];
                self.straight(joint, 1, rack.axis, ends);
            }
            JointKind::Cam(cam) => {
                let [x, y] = self.at(joint, 0);
                let mut places: Vec<[f64; 2]> =
                    cam.outline.iter().map(|[u, v]| [x + u, y + v]).collect();
                if places.first() == places.last() {
                    places.pop();
                }
                if places.len() > 2 {
                    self.put(joint, 0, Form::line(places, true));
                }
                if let Some(radius) = cam.roller {
                    self.circle(joint, 1, radius);
                    let at = self.at(joint, 1);
                    self.bodies[second].hole(at);
                }
                if let Some([u, v]) = cam.face.filter(|face| *face != [0.0; 2]) {
                    let length = u.hypot(v);
                    let reach = cam.reach.unwrap_or(0.0) + 0.5 * self.width;
                    self.straight(joint, 1, [u / length, v / length], [-reach, reach]);
                }
            }
            JointKind::Contact { radius, arc, .. } => match arc {
                None => self.circle(joint, 1, *radius),
                Some([from, to]) => {
                    let [x, y] = self.at(joint, 1);
                    let at = |angle: f64| [x + radius * angle.cos(), y + radius * angle.sin()];
                    let turn = (to - from).rem_euclid(TAU);
                    let begin = Corner {
                        place: at(*from),
                        bulge: (turn / 4.0).tan(),
                    };
                    let tip = Form::Line {
                        corners: vec![begin, Corner::straight(at(*to))],
                        closed: false,
                    };
                    self.put(joint, 1, tip);
                }
            },
            JointKind::Beam | JointKind::Fixed => {}
        }
    }

    /// How far a slide goes: to its ends, else as far as it moves.
    fn reach(&self, joint: &Joint, axis: [f64; 2]) -> [f64; 2] {
        let [low, high] = self.rows.reach(self.shape, joint, axis);
        let [lower, upper] = joint.limits.unwrap_or_default();
        [lower.unwrap_or(low), upper.unwrap_or(high)]
    }
}

/// A way of straights and arcs; the radius of an arc stands at its end.
fn outline(way: &[Node]) -> Form {
    let closed = way.len() > 2 && way.first().map(|(at, _)| at) == way.last().map(|(at, _)| at);
    let arcs = way.windows(2).map(|pair| bulge(pair[0].0, pair[1]));
    let bulges = arcs.chain([0.0]);
    let corners = way.iter().zip(bulges).map(|((place, _), bulge)| Corner {
        place: *place,
        bulge,
    });
    let mut corners: Vec<Corner> = corners.collect();
    if closed {
        corners.pop();
    }
    Form::Line { corners, closed }
}

fn bulge(from: [f64; 2], (to, radius): Node) -> f64 {
    if radius == 0.0 || from == to {
        return 0.0;
    }
    let [x, y] = arc_centre(from, to, radius);
    let angle = |[u, v]: [f64; 2]| (v - y).atan2(u - x);
    let turn = match radius > 0.0 {
        true => (angle(to) - angle(from)).rem_euclid(TAU),
        false => -(angle(from) - angle(to)).rem_euclid(TAU),
    };
    (turn / 4.0).tan()
}
