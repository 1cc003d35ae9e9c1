//! What rolls: wheels in mesh, racks with their wheels.

use super::places::turned;
use super::sketch::Sketch;
use crate::palette;
use crate::scene::Scene;
use crate::shape::{Joint, JointKind, PitchCircles, PitchLine, Pulleys};
use crate::symbols::{self, Belt, Rack, Wheel};

/// A rack reaches beyond its wheel's way by this, in radii of the wheel.
const BEYOND: f64 = 0.6;

/// Draws what rolls at a joint; `slides` is the way of a wheel along its rack \[m\].
pub fn draw(scene: &mut Scene, sketch: &Sketch, joint: &Joint, slides: [f64; 2]) {
    match joint.kind {
        JointKind::Gear {
            gear: Some(gear), ..
        } => pair(scene, sketch, joint, gear),
        JointKind::Rack { rack } => wheel_on_rack(scene, sketch, joint, rack, slides),
        JointKind::Belt { belt } => belt_on_pulleys(scene, sketch, joint, belt),
        JointKind::Gear { gear: None, .. }
        | JointKind::Revolute { .. }
        | JointKind::Prismatic { .. }
        | JointKind::Slot { .. }
        | JointKind::Cam(_)
        | JointKind::Bushing
        | JointKind::Fixed
        | JointKind::Contact { .. } => {}
    }
}

/// Two wheels in mesh, a ring behind the wheel in it.
fn pair(scene: &mut Scene, sketch: &Sketch, joint: &Joint, gear: PitchCircles) {
    let larger = usize::from(gear.radii[1] > gear.radii[0]);
    for k in [larger, 1 - larger] {
        let internal = gear.internal && k == larger;
        let wheel = wheel_of(sketch, joint, k, gear.radii[k], internal);
        let body = joint.between[k].0;
        symbols::wheel(scene, &wheel, sketch.bar(), sketch.of_body(body));
    }
}

/// A wheel of a joint, of that radius \[m\].
fn wheel_of(sketch: &Sketch, joint: &Joint, k: usize, radius: f64, internal: bool) -> Wheel {
    Wheel {
        centre: sketch.at(joint.between[k]),
        radius: radius * sketch.view.scale,
        angle: sketch.pose[joint.between[k].0][2],
        internal,
    }
}

/// A wheel, and the teeth of its rack over all of its way.
fn wheel_on_rack(
    scene: &mut Scene,
    sketch: &Sketch,
    joint: &Joint,
    line: PitchLine,
    [low, high]: [f64; 2],
) {
    let [wheel_body, rack_body] = joint.between.map(|(body, _)| body);
    let [u, v] = turned(sketch.pose[rack_body], line.axis);
    let length = u.hypot(v);
    if length == 0.0 || low > high {
        return;
    }
    let along = [u / length, -v / length];
    // n = a⊥, upwards on a page whose y goes down.
    let towards = [along[1], -along[0]].map(|part| part * line.radius.signum());
    let wheel = wheel_of(sketch, joint, 0, line.radius.abs(), false);
    let [x, y] = sketch.at(joint.between[1]);
    let here = (wheel.centre[0] - x) * along[0] + (wheel.centre[1] - y) * along[1];
    let beyond = BEYOND * line.radius.abs();
    let reach = [low - beyond, high + beyond].map(|far| far * sketch.view.scale - here);
    let rack = Rack {
        wheel,
        along,
        towards,
        reach,
    };
    symbols::rack(scene, &rack, sketch.bar(), sketch.of_body(rack_body));
    symbols::wheel(scene, &wheel, sketch.bar(), sketch.of_body(wheel_body));
}

/// Two pulleys with the belt around them.
fn belt_on_pulleys(scene: &mut Scene, sketch: &Sketch, joint: &Joint, pulleys: Pulleys) {
    let wheels = [0, 1].map(|k| wheel_of(sketch, joint, k, pulleys.radii[k], false));
    for (wheel, (body, _)) in wheels.iter().zip(joint.between) {
        symbols::pulley(scene, wheel, sketch.of_body(body));
    }
    let belt = Belt {
        pulleys: wheels,
        crossed: pulleys.crossed,
    };
    symbols::belt(scene, &belt, sketch.bar(), sketch.pen(palette::STEEL));
}
