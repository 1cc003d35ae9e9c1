//! Ends of joints' ways: bars across a guide, the round end of a slot, an arc between two pegs about a pin.

use super::sketch::Sketch;
use crate::palette;
use crate::scene::{Pen, Place, Scene};
use crate::shape::{Joint, JointKind};
use crate::symbols;
use linkdyn_model::OneWay;

/// Half the height of a bar, in bars.
const HIGH: f64 = 2.0;
/// Radii between which a peg lies, and of the arc, in bars.
const PEG: [f64; 2] = [3.0, 4.6];
const ARC: f64 = 3.8;
/// Angle between corners of the arc \[rad\].
const CORNER: f64 = 0.1;
/// Radius of the arrow about a pin with a one-way clutch, in bars, how far it goes round, and the length \[rad\] and half the
/// width, in bars, of its head.
const ROUND: f64 = 1.6;
const TURN: f64 = 4.5;
const HEAD: [f64; 2] = [0.5, 0.6];
/// An end this much of the stroke beyond it is drawn.
const NEAR: f64 = 0.5;

/// The ends of a joint's way that are near enough to its stroke to be drawn.
fn near(joint: &Joint, [low, high]: [f64; 2]) -> [Option<f64>; 2] {
    let far = NEAR * (high - low);
    let [lower, upper] = joint.limits.unwrap_or_default();
    [
        lower.filter(|end| (low - end).abs() <= far),
        upper.filter(|end| (end - high).abs() <= far),
    ]
}

/// How far a guide goes: a slot to its ends.
pub fn reach(joint: &Joint, slides: [f64; 2]) -> [f64; 2] {
    let [lower, upper] = near(joint, slides);
    let [low, high] = slides;
    match joint.kind {
        JointKind::Slot { .. } => [lower.unwrap_or(low), upper.unwrap_or(high)],
        JointKind::Prismatic { .. } => [
            lower.map_or(low, |end| low.min(end)),
            upper.map_or(high, |end| high.max(end)),
        ],
        JointKind::Revolute { .. }
        | JointKind::Gear { .. }
        | JointKind::Fixed
        | JointKind::Contact { .. }
        | JointKind::Cam(_)
        | JointKind::Rack { .. }
        | JointKind::Belt { .. }
        | JointKind::Bushing => slides,
    }
}

/// Draws the stops of a joint.
pub fn draw(scene: &mut Scene, sketch: &Sketch, joint: &Joint, slides: [f64; 2]) {
    let pen = sketch.pen(palette::STEEL);
    if let Some(way) = joint.one_way {
        arrow(scene, sketch, joint, way, pen);
    }
    if joint.limits.is_none() {
        return;
    }
    match joint.kind {
        JointKind::Prismatic { .. } => bars(scene, sketch, joint, slides, pen),
        JointKind::Revolute { .. } => arc(scene, sketch, joint, pen),
        JointKind::Slot { .. }
        | JointKind::Gear { .. }
        | JointKind::Fixed
        | JointKind::Contact { .. }
        | JointKind::Cam(_)
        | JointKind::Rack { .. }
        | JointKind::Belt { .. }
        | JointKind::Bushing => {}
    }
}

/// Bars where the block of a slide comes to its ends.
fn bars(scene: &mut Scene, sketch: &Sketch, joint: &Joint, slides: [f64; 2], pen: Pen) {
    let Some([u, v]) = sketch.direction(joint) else {
        return;
    };
    let ([x, y], bar) = (sketch.at(joint.between[0]), sketch.bar());
    for (end, side) in near(joint, slides).into_iter().zip([-1.0, 1.0]) {
        let Some(end) = end else { continue };
        let far = end * sketch.view.scale + side * symbols::BLOCK[0] * bar;
        let at = |across: f64| [x + far * u - across * v, y + far * v + across * u];
        let width = 0.6 * bar;
        scene.line(
            "stop",
            [at(-HIGH * bar), at(HIGH * bar)],
            Pen { width, ..pen },
        );
    }
}

/// Pegs about a pin, between which the second body can turn.
fn arc(scene: &mut Scene, sketch: &Sketch, joint: &Joint, pen: Pen) {
    let Some(from) = direction_of(sketch, joint) else {
        return;
    };
    let [x, y] = sketch.at(joint.between[0]);
    let bar = sketch.bar();
    let base = sketch.pose[joint.between[0].0][2] + from;
    let at = |angle: f64, radius: f64| -> Place {
        let (sin, cos) = (base + angle).sin_cos();
        [x + radius * bar * cos, y - radius * bar * sin]
    };
    let ends = joint.limits.unwrap_or_default();
    for end in ends.into_iter().flatten() {
        let width = 0.6 * bar;
        scene.line(
            "stop",
            PEG.map(|radius| at(end, radius)),
            Pen { width, ..pen },
        );
    }
    if let [Some(low), Some(high)] = ends {
        let high = high.min(low + std::f64::consts::TAU);
        let corners = ((high - low) / CORNER).ceil().max(1.0);
        let places: Vec<Place> = (0..=corners as usize)
            .map(|k| at(low + (high - low) * k as f64 / corners, ARC))
            .collect();
        let width = 0.5 * pen.width;
        scene.line("stop", places, Pen { width, ..pen });
    }
}

/// An arrow about a pin, the way in which its one-way clutch lets the second body turn.
fn arrow(scene: &mut Scene, sketch: &Sketch, joint: &Joint, way: OneWay, pen: Pen) {
    let [x, y] = sketch.at(joint.between[0]);
    let bar = sketch.bar();
    let base = sketch.pose[joint.between[0].0][2];
    let sign = match way {
        OneWay::Forward => 1.0,
        OneWay::Backward => -1.0,
    };
    let at = |angle: f64, radius: f64| -> Place {
        let (sin, cos) = (base + sign * angle).sin_cos();
        [x + radius * bar * cos, y - radius * bar * sin]
    };
    let width = 0.5 * pen.width;
    let corners = (TURN / CORNER).ceil();
    let way: Vec<Place> = (0..=corners as usize)
        .map(|k| at(TURN * k as f64 / corners, ROUND))
        .collect();
    scene.line("clutch", way, Pen { width, ..pen });
    let head = [-1.0, 1.0].map(|side| at(TURN - HEAD[0], ROUND + side * HEAD[1]));
    let tip = at(TURN, ROUND);
    scene.line("clutch", [head[0], tip, head[1]], Pen { width, ..pen });
}

/// Where the second body of a pin lies, in its own frame \[rad\].
fn direction_of(sketch: &Sketch, joint: &Joint) -> Option<f64> {
    let (body, number) = joint.between[1];
    let points = &sketch.mechanism.shape.bodies.get(body)?.points;
    let (_, x, y) = points.get(number)?;
    let sum = points
        .iter()
        .fold([0.0; 2], |[u, v], (_, a, b)| [u + a - x, v + b - y]);
    Some(if sum == [0.0; 2] {
        0.0
    } else {
        sum[1].atan2(sum[0])
    })
}
