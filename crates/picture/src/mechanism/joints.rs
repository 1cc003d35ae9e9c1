//! How bodies and each kind of joint are drawn.

use super::cylinder::Lengths;
use super::parts::{At, Layer, Parts};
use super::places::turned;
use super::stops;
use crate::palette::{FORCE, GROUND, MUTED, PIN, STEEL};
use crate::shape::{
    Clearance, Joint, JointKind, PitchCircles, PitchLine, PointId, Profile, Pulleys,
};
use crate::sign::{
    Corner, Edge, OUTLINE, Outline, Paint, Sign, Stroke, along, area, bars, circle, line, metres,
};
use crate::symbols::{self, Rack};
use std::f64::consts::TAU;

/// Radius of a pin, and of the ring that marks a clearance, in bars.
const RADIUS: f64 = 0.62;
const RING: f64 = 1.2;
/// Radius of a ring of rubber around a pin.
const SLEEVE: f64 = 1.15;
/// Width of a beam, in bars.
const LEAF: f64 = 0.4;
/// Half the side of a weld, in bars.
const WELD: f64 = 0.7;
/// Distance from which on bearing and journal are seen apart, in bars.
const APART: f64 = 0.3;
/// Width of a guide on a body, in bars.
const GUIDE: f64 = 0.7;
/// A rack reaches beyond its wheel's way by this, in radii of the wheel.
const BEYOND: f64 = 0.6;
/// How much of the fill a cam and a roller have: what lies behind shows through.
const FILL: f64 = 0.55;
/// Width of a face, and how far it reaches beyond where it is touched, in bars.
const FACE: [f64; 2] = [0.7, 1.5];
/// Radius of the pin of a roller, in bars.
const ROLLER_PIN: f64 = 0.45;
/// Angle between corners of a round tip \[rad\].
const CORNER: f64 = 0.1;

/// A body: the convex hull of its points with rounded corners.
pub fn body() -> Stroke {
    Stroke {
        class: "body",
        outline: Outline::Body(1.0),
        fill: Some(Paint::FILL),
        edge: Some(Edge::BODY),
    }
}

/// A disc, white inside.
fn pin(radius: [f64; 2]) -> Stroke {
    circle(
        "pin",
        Corner::default(),
        radius,
        Paint::of(PIN),
        Edge::of(STEEL),
    )
}

impl Parts<'_> {
    /// The parts of all joints.
    pub fn add_joints(&mut self) {
        let mechanism = self.mechanism;
        for (number, joint) in mechanism.shape.joints.iter().enumerate() {
            let slides = mechanism.slides[number];
            match &joint.kind {
                JointKind::Revolute { clearance } => self.add_pin(joint, clearance.as_ref()),
                JointKind::Prismatic { axis } => match &mechanism.cylinders.of_joint[number] {
                    Some(lengths) => self.add_cylinder(joint, *axis, lengths, slides),
                    None => self.add_block(joint, *axis, slides),
                },
                JointKind::Slot { axis } => self.add_slot(joint, *axis, slides),
                JointKind::Gear { gear, .. } => self.add_gear(joint, gear.as_ref()),
                JointKind::Cam(profile) => self.add_cam(joint, profile),
                JointKind::Rack { rack } => self.add_rack(joint, *rack, slides),
                JointKind::Rolling { radii } => self.add_rolling(joint, *radii),
                JointKind::Belt { belt } => self.add_belt(joint, *belt),
                JointKind::Bushing => self.add_bushing(joint),
                JointKind::Beam => self.add_beam(joint),
                JointKind::Fixed => self.add_weld(joint),
                JointKind::Contact {
                    outlines,
                    radius,
                    arc,
                } => {
                    self.add_outlines(joint, outlines);
                    self.add_tip(joint, *radius, *arc);
                }
            }
            self.add_one_way(joint);
        }
    }

    /// The support of a joint on the ground.
    fn add_support(&mut self, joint: &Joint) {
        if joint.is_on_ground() {
            let held = joint.between[usize::from(joint.between[0].0 != 0)];
            self.upright(Layer::Pins, At::Point(held), symbols::support());
        }
    }

    fn add_pin(&mut self, joint: &Joint, clearance: Option<&Clearance>) {
        self.add_support(joint);
        let [first, second] = joint.between;
        let disc = vec![pin([0.0, RADIUS])];
        // A clearance that can be seen is seen.
        let is_open = self.for_all || self.distance(joint.between) > APART * self.bar;
        if is_open && !self.mechanism.pins_are_whole {
            self.on(Layer::Pins, first, first.0, disc.clone());
        }
        self.on(Layer::Pins, second, second.0, disc);
        if let Some(clearance) = clearance {
            // The clearance circle if it is large enough to be seen, otherwise a ring that marks it.
            let edge = Edge {
                dash: &[2.4, 1.8],
                ..Edge::of(FORCE)
            };
            let ring = circle(
                "clearance",
                Corner::default(),
                [clearance.radius, RING],
                None,
                edge,
            );
            self.on(Layer::Pins, first, first.0, vec![ring]);
        }
        self.add_arc(joint);
    }

    fn add_bushing(&mut self, joint: &Joint) {
        self.add_support(joint);
        let [first, second] = joint.between;
        let (rubber, edge) = (Paint::of(MUTED), Edge::of(STEEL));
        let sleeve = circle("bushing", Corner::default(), [0.0, SLEEVE], rubber, edge);
        self.on(Layer::Pins, first, first.0, vec![sleeve]);
        self.on(Layer::Pins, second, second.0, vec![pin([0.0, RADIUS])]);
    }

    /// The line between its ends: of a chain its parts are short.
    fn add_beam(&mut self, joint: &Joint) {
        self.add_support(joint);
        let bar = line("beam", [along(0.0), along(1.0)], Edge::of(STEEL).wide(LEAF));
        self.between(Layer::Springs, joint.between, vec![bar]);
    }

    fn add_weld(&mut self, joint: &Joint) {
        self.add_support(joint);
        let corners = [[-WELD, -WELD], [WELD, -WELD], [WELD, WELD], [-WELD, WELD]];
        let sign = area(
            "weld",
            corners.map(|[x, y]| bars(x, y)),
            Paint::of(STEEL),
            None,
        );
        self.upright(Layer::Pins, At::Point(joint.between[1]), vec![sign]);
    }

    fn add_slot(&mut self, joint: &Joint, axis: [f64; 2], slides: [f64; 2]) {
        let [first, second] = joint.between;
        let [low, high] = stops::reach_of_slot(joint, slides);
        if low <= high {
            let ends = [low, high].map(|end| metres(end, 0.0));
            self.with(
                guide_layer(first),
                first,
                (first.0, unit(axis)),
                first.0,
                symbols::slot(ends),
            );
        }
        self.on(Layer::Pins, second, second.0, vec![pin([0.0, RADIUS])]);
    }

    /// A block with its guide, rails on the ground or a rod on a body, and bars where it comes to its ends.
    fn add_block(&mut self, joint: &Joint, axis: [f64; 2], slides: [f64; 2]) {
        let [first, second] = joint.between;
        let along = (first.0, unit(axis));
        let [low, high] = stops::reach(joint, slides);
        if low <= high {
            let ends = [low, high].map(|end| metres(end, 0.0));
            let guide = match first.0 {
                0 => symbols::rails(ends, self.bar),
                _ => vec![line("guide", ends, Edge::BODY.wide(GUIDE))],
            };
            self.with(guide_layer(first), first, along, first.0, guide);
        }
        self.with(Layer::Blocks, second, along, second.0, symbols::block());
        if second.0 == 0 {
            let [far, away] = symbols::BLOCK;
            let ends = [bars(-far, -away), bars(far, -away)];
            let sign = symbols::hatched_line(ends, self.bar, Edge::of(GROUND));
            self.with(Layer::Blocks, second, along, 0, vec![sign]);
        }
        self.add_bars(joint, along, slides);
    }

    /// A driven slide between moving bodies: barrel, rod and piston.
    fn add_cylinder(&mut self, joint: &Joint, axis: [f64; 2], lengths: &Lengths, slides: [f64; 2]) {
        let [first, second] = joint.between;
        let along = (first.0, unit(axis));
        let [rod, barrel] =
            [lengths.rod, lengths.barrel].map(|ends| ends.map(|end| metres(end, 0.0)));
        let body = (Paint::FILL, Edge::BODY);
        self.with(
            Layer::Blocks,
            second,
            along,
            second.0,
            symbols::rod(rod, body),
        );
        self.with(
            Layer::Blocks,
            first,
            along,
            first.0,
            symbols::barrel(barrel, body),
        );
        self.with(
            Layer::Blocks,
            second,
            along,
            second.0,
            symbols::piston(rod[0], Edge::BODY),
        );
        self.add_bars(joint, along, slides);
    }

    /// Two wheels in mesh, a ring behind the wheel in it.
    fn add_gear(&mut self, joint: &Joint, gear: Option<&PitchCircles>) {
        let Some(gear) = gear else { return };
        let larger = usize::from(gear.radii[1] > gear.radii[0]);
        for k in [larger, 1 - larger] {
            let is_ring = gear.internal && k == larger;
            let at = joint.between[k];
            self.on(
                Layer::Wheels,
                at,
                at.0,
                symbols::wheel(gear.radii[k], is_ring, self.bar),
            );
        }
    }

    /// A wheel, and the teeth of its rack over all of its way.
    fn add_rack(&mut self, joint: &Joint, rack: PitchLine, [low, high]: [f64; 2]) {
        let [wheel, base] = joint.between;
        let length = rack.axis[0].hypot(rack.axis[1]);
        if length == 0.0 || low > high {
            return;
        }
        let axis = unit(rack.axis);
        let [u, v] = turned(self.pose[base.0], axis);
        let [[x, y], [x0, y0]] = joint.between.map(|end| self.place(end));
        let centre = [(x - x0) * u + (y - y0) * v, (y - y0) * u - (x - x0) * v];
        let beyond = BEYOND * rack.radius.abs();
        let sign = Rack {
            pitch_point: [centre[0], centre[1] - rack.radius],
            radius: rack.radius,
            angle: self.pose[wheel.0][2] - v.atan2(u),
            reach: [low - beyond - centre[0], high + beyond - centre[0]],
        };
        self.with(
            Layer::Wheels,
            base,
            (base.0, axis),
            base.0,
            sign.sign(self.bar),
        );
        self.on(
            Layer::Wheels,
            wheel,
            wheel.0,
            symbols::wheel(rack.radius.abs(), false, self.bar),
        );
    }

    /// Two discs, a ring behind the disc in it.
    fn add_rolling(&mut self, joint: &Joint, radii: [f64; 2]) {
        let ring = usize::from(radii[1] < 0.0);
        for k in [ring, 1 - ring] {
            let at = joint.between[k];
            let sign = match radii[k] < 0.0 {
                true => symbols::plain_ring(-radii[k], self.bar),
                false => symbols::pulley(radii[k]),
            };
            self.on(Layer::Wheels, at, at.0, sign);
        }
    }

    /// Two pulleys with the belt around them.
    fn add_belt(&mut self, joint: &Joint, pulleys: Pulleys) {
        for (at, radius) in joint.between.into_iter().zip(pulleys.radii) {
            self.on(Layer::Wheels, at, at.0, symbols::pulley(radius));
        }
        let belt = symbols::belt(pulleys.radii, pulleys.crossed, self.distance(joint.between));
        self.between(Layer::Wheels, joint.between, belt.into_iter().collect());
    }

    /// The true profile of a cam, and the roller or the face that touches it.
    fn add_cam(&mut self, joint: &Joint, cam: &Profile) {
        let [first, second] = joint.between;
        let corners: Vec<Corner> = cam.outline.iter().map(|[x, y]| metres(*x, *y)).collect();
        if corners.len() > 2 {
            let profile = area("cam", corners, Paint::FILL.faded(FILL), Edge::BODY);
            self.on(Layer::Wheels, first, first.0, vec![profile]);
        }
        if let Some(radius) = cam.roller {
            let fill = Paint::FILL.faded(FILL);
            let roller = circle("roller", Corner::default(), [radius, 0.0], fill, Edge::BODY);
            let pin = if ROLLER_PIN * self.bar < 0.5 * radius {
                pin([0.0, ROLLER_PIN])
            } else {
                pin([0.5 * radius, 0.0])
            };
            self.on(Layer::Followers, second, second.0, vec![roller, pin]);
        }
        if let Some(face) = cam.face
            && face != [0.0; 2]
        {
            let (reach, [width, beyond]) = (cam.reach.unwrap_or(0.0), FACE);
            let ends = [-1.0, 1.0].map(|side| metres(side * reach, 0.0).beside(side * beyond, 0.0));
            let sign = vec![line("face", ends, Edge::BODY.wide(width))];
            self.with(
                Layer::Followers,
                second,
                (second.0, unit(face)),
                second.0,
                sign,
            );
        }
    }

    /// Outlines that may be touched: a closed one is a plate, an open one a line, hatched where it stands still.
    fn add_outlines(&mut self, joint: &Joint, outlines: &[Vec<[f64; 2]>]) {
        let body = joint.between[0].0;
        let layer = match body {
            0 => Layer::Backdrop,
            _ => Layer::Outlines,
        };
        let [x, y] = self
            .mechanism
            .shape
            .point(joint.between[0])
            .unwrap_or_default();
        for outline in outlines {
            let corners: Vec<Corner> = outline.iter().map(|[u, v]| metres(u - x, v - y)).collect();
            let is_closed = outline.first() == outline.last();
            let sign: Sign = match (body, is_closed) {
                (_, true) => vec![area("outline", corners, Paint::FILL, Edge::BODY)],
                // The material is on the left of the way, hatched on the right of the way back.
                (0, false) => {
                    let pieces = corners.windows(2);
                    let back = |pair: &[Corner]| {
                        symbols::hatched_line([pair[1], pair[0]], self.bar, Edge::of(GROUND))
                    };
                    pieces.map(back).collect()
                }
                (_, false) => vec![line("outline", corners, Edge::BODY.wide(2.0 * OUTLINE))],
            };
            self.on(layer, joint.between[0], body, sign);
        }
    }

    /// The tip of a contact.
    fn add_tip(&mut self, joint: &Joint, radius: f64, arc: Option<[f64; 2]>) {
        let tip = match arc {
            None => circle(
                "tip",
                Corner::default(),
                [radius, 0.0],
                Paint::FILL,
                Edge::BODY,
            ),
            Some([from, to]) => {
                let turn = (to - from).rem_euclid(TAU);
                let parts = (turn / CORNER).ceil().max(1.0);
                let rim = (0..=parts as usize).map(|k| {
                    let (sin, cos) = (from + turn * k as f64 / parts).sin_cos();
                    metres(radius * cos, radius * sin)
                });
                area("tip", rim.collect::<Vec<_>>(), Paint::FILL, Edge::BODY)
            }
        };
        self.on(
            Layer::Outlines,
            joint.between[1],
            joint.between[1].0,
            vec![tip],
        );
    }
}

/// Guides of the ground stand behind all poses.
fn guide_layer((body, _): PointId) -> Layer {
    match body {
        0 => Layer::Backdrop,
        _ => Layer::Guides,
    }
}

/// The same direction, length one.
fn unit([u, v]: [f64; 2]) -> [f64; 2] {
    let length = u.hypot(v);
    if length > 0.0 {
        [u / length, v / length]
    } else {
        [1.0, 0.0]
    }
}
