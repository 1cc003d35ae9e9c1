//! Draws bodies and joints of one pose, from the back to the front: wheels and guides of the ground, other guides, bodies,
//! blocks, pins.

use super::cams;
use super::cylinder::Lengths;
use super::sketch::Sketch;
use super::{outlines, stops, wheels};
use crate::palette;
use crate::scene::{Ink, Pen, Place, Scene};
use crate::shape::{Clearance, Joint, JointKind};
use crate::symbols::{self, Cylinder};

/// Radius of a pin, and of the ring that tells of a clearance, in bars.
const PIN: f64 = 0.62;
const RING: f64 = 1.2;
/// Radius of a ring of rubber around a pin.
const SLEEVE: f64 = 1.15;
/// Half the side of a weld, in bars.
const WELD: f64 = 0.7;
/// Distance from which on bearing and journal are seen apart, in bars.
const APART: f64 = 0.3;

/// Draws what would cover other poses: wheels, and guides that do not move.
pub fn draw_backdrop(scene: &mut Scene, sketch: &Sketch) {
    let mechanism = sketch.mechanism;
    for (joint, slides) in mechanism.shape.joints.iter().zip(&mechanism.slides) {
        wheels::draw(scene, sketch, joint, *slides);
        cams::draw_profile(scene, sketch, joint);
    }
    for (number, joint) in mechanism.shape.joints.iter().enumerate() {
        if joint.between[0].0 == 0 {
            outlines::draw_outline(scene, sketch, joint);
            draw_guide(scene, sketch, joint, mechanism.slides[number]);
        }
    }
}

/// Draws all but the backdrop.
pub fn draw(scene: &mut Scene, sketch: &Sketch) {
    let shape = &sketch.mechanism.shape;
    let (slides, cylinders) = (&sketch.mechanism.slides, &sketch.mechanism.cylinders);
    for (number, joint) in shape.joints.iter().enumerate() {
        if joint.between[0].0 != 0 && cylinders.of_joint[number].is_none() {
            draw_guide(scene, sketch, joint, slides[number]);
        }
    }
    for joint in &shape.joints {
        if joint.between[0].0 != 0 {
            outlines::draw_outline(scene, sketch, joint);
        }
        outlines::draw_tip(scene, sketch, joint);
    }
    for number in (1..shape.bodies.len()).filter(|number| !cylinders.holds[*number]) {
        let outline = sketch.outline(number);
        let (fill, pen) = sketch.of_body(number);
        scene.area("body", outline, Some(fill), Some(pen));
    }
    for (joint, lengths) in shape.joints.iter().zip(&cylinders.of_joint) {
        match lengths {
            Some(lengths) => draw_cylinder(scene, sketch, joint, lengths),
            None => draw_block(scene, sketch, joint),
        }
    }
    for (joint, slides) in shape.joints.iter().zip(slides) {
        stops::draw(scene, sketch, joint, *slides);
    }
    for joint in &shape.joints {
        cams::draw_follower(scene, sketch, joint);
    }
    for joint in &shape.joints {
        draw_pin(scene, sketch, joint);
    }
}

/// Rails on the ground, a rod on a body, or a slot.
fn draw_guide(scene: &mut Scene, sketch: &Sketch, joint: &Joint, slides: [f64; 2]) {
    let [low, high] = stops::reach(joint, slides);
    let (Some([u, v]), true) = (sketch.direction(joint), low <= high) else {
        return;
    };
    let (start, bar) = (sketch.at(joint.between[0]), sketch.bar());
    let end = |slide: f64| {
        let far = slide * sketch.view.scale;
        [start[0] + far * u, start[1] + far * v]
    };
    let ends = [end(low), end(high)];
    let body = joint.between[0].0;
    let (fill, pen) = sketch.of_body(body);
    match joint.kind {
        JointKind::Slot { .. } => symbols::slot(scene, ends, bar, (fill, pen)),
        JointKind::Prismatic { .. } if body == 0 => {
            symbols::rails(scene, ends, [u, v], bar, pen);
        }
        JointKind::Prismatic { .. } => {
            let width = 0.7 * bar;
            scene.line("guide", ends, Pen { width, ..pen });
        }
        JointKind::Revolute { .. }
        | JointKind::Gear { .. }
        | JointKind::Fixed
        | JointKind::Contact { .. }
        | JointKind::Cam(_)
        | JointKind::Rack { .. }
        | JointKind::Belt { .. }
        | JointKind::Bushing => {}
    }
}

/// Barrel, rod and piston of a driven slide.
fn draw_cylinder(scene: &mut Scene, sketch: &Sketch, joint: &Joint, lengths: &Lengths) {
    let Some(along) = sketch.direction(joint) else {
        return;
    };
    let [[x, y], end] = joint.between.map(|end| sketch.at(end));
    let slide = along[0] * (end[0] - x) + along[1] * (end[1] - y);
    let scale = sketch.view.scale;
    let cylinder = Cylinder {
        origin: [x, y],
        along,
        barrel: lengths.barrel.map(|far| far * scale),
        rod: lengths.rod.map(|far| slide + far * scale),
    };
    let [barrel, rod] = joint.between.map(|(body, _)| sketch.of_body(body));
    symbols::cylinder(scene, &cylinder, sketch.bar(), barrel, rod);
}

/// The block of a prismatic joint.
fn draw_block(scene: &mut Scene, sketch: &Sketch, joint: &Joint) {
    let (JointKind::Prismatic { .. }, Some([u, v])) = (&joint.kind, sketch.direction(joint)) else {
        return;
    };
    let (centre, bar) = (sketch.at(joint.between[1]), sketch.bar());
    let body = joint.between[1].0;
    symbols::block(scene, centre, [u, v], bar, sketch.of_body(body));
    if body == 0 {
        let side = |far: f64| {
            let [along, across] = [far * bar, 1.4 * bar];
            [
                centre[0] + along * u - across * v,
                centre[1] + along * v + across * u,
            ]
        };
        symbols::hatched_line(
            scene,
            [side(-2.4), side(2.4)],
            bar,
            sketch.pen(palette::GROUND),
        );
    }
}

/// A pin with its support, or a weld.
fn draw_pin(scene: &mut Scene, sketch: &Sketch, joint: &Joint) {
    let bar = sketch.bar();
    let [first, second] = joint.between.map(|end| sketch.at(end));
    let on_ground = if joint.between[0].0 == 0 {
        first
    } else {
        second
    };
    let support = |scene: &mut Scene| {
        if joint.is_on_ground() {
            symbols::support(scene, on_ground, bar, sketch.pen(palette::GROUND));
        }
    };
    let pin = |scene: &mut Scene, at: Place| {
        let white = Some(Ink::grey(255).faded(sketch.strength));
        scene.circle(
            "pin",
            at,
            PIN * bar,
            white,
            Some(sketch.pen(palette::STEEL)),
        );
    };
    match &joint.kind {
        JointKind::Revolute { clearance } => {
            support(scene);
            // A clearance that can be seen is seen.
            let apart = (first[0] - second[0]).hypot(first[1] - second[1]);
            if apart > APART * bar && !sketch.mechanism.pins_are_whole {
                pin(scene, first);
            }
            pin(scene, second);
            draw_clearance(scene, sketch, clearance.as_ref(), first);
        }
        JointKind::Bushing => {
            support(scene);
            let rubber = Some(sketch.ink(palette::MUTED));
            let sleeve = Some(sketch.pen(palette::STEEL));
            scene.circle("bushing", first, SLEEVE * bar, rubber, sleeve);
            pin(scene, second);
        }
        JointKind::Slot { .. } => pin(scene, second),
        JointKind::Fixed => {
            support(scene);
            let half = WELD * bar;
            let [x, y] = second;
            let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
            let corners = corners.map(|[dx, dy]| [x + dx, y + dy]);
            scene.area("weld", corners, Some(sketch.ink(palette::STEEL)), None);
        }
        JointKind::Prismatic { .. }
        | JointKind::Gear { .. }
        | JointKind::Contact { .. }
        | JointKind::Cam(_)
        | JointKind::Rack { .. }
        | JointKind::Belt { .. } => {}
    }
}

/// The room of the journal's centre where it can be seen at this scale, else a ring that tells of it.
fn draw_clearance(
    scene: &mut Scene,
    sketch: &Sketch,
    clearance: Option<&Clearance>,
    bearing: Place,
) {
    if let Some(clearance) = clearance {
        let radius = (clearance.radius * sketch.view.scale).max(RING * sketch.bar());
        let pen = Pen {
            dash: &[2.4, 1.8],
            ..sketch.pen(palette::FORCE)
        };
        scene.circle("clearance", bearing, radius, None, Some(pen));
    }
}
