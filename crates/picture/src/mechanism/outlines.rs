//! Outlines of contacts, and the tips that may touch them.

use super::places::turned;
use super::sketch::Sketch;
use crate::palette;
use crate::scene::{Pen, Place, Scene};
use crate::shape::{Joint, JointKind};
use crate::symbols;
use std::f64::consts::TAU;

/// Angle between corners of a tip \\[rad\\].
const CORNER: f64 = 0.1;

/// Draws the outline of a contact: a closed one as a plate, an open one as a line, hatched where it stands still.
pub fn draw_outline(scene: &mut Scene, sketch: &Sketch, joint: &Joint) {
    let JointKind::Contact { outlines, .. } = &joint.kind else {
        return;
    };
    let body = joint.between[0].0;
    let pose = sketch.pose[body];
    let at = |place: &[f64; 2]| -> Place {
        let [x, y] = turned(pose, *place);
        sketch.view.place([pose[0] + x, pose[1] + y])
    };
    for outline in outlines {
        let places: Vec<Place> = outline.iter().map(at).collect();
        let (fill, pen) = sketch.of_body(body);
        let is_closed = outline.first() == outline.last();
        match (body, is_closed) {
            (_, true) => scene.area("outline", places, Some(fill), Some(pen)),
            (0, false) => {
                // The material is on the left of the way, hatched on the right of the way back.
                for pair in places.windows(2) {
                    let back = [pair[1], pair[0]];
                    symbols::hatched_line(scene, back, sketch.bar(), sketch.pen(palette::GROUND));
                }
            }
            (_, false) => {
                let width = 2.0 * pen.width;
                scene.line("outline", places, Pen { width, ..pen });
            }
        }
    }
}

/// Draws the tip of a contact, where it can be seen at this scale.
pub fn draw_tip(scene: &mut Scene, sketch: &Sketch, joint: &Joint) {
    let JointKind::Contact { radius, arc, .. } = &joint.kind else {
        return;
    };
    let [x, y] = sketch.at(joint.between[1]);
    let body = joint.between[1].0;
    let (fill, pen) = sketch.of_body(body);
    let radius = radius * sketch.view.scale;
    let Some([from, to]) = *arc else {
        scene.circle("tip", [x, y], radius, Some(fill), Some(pen));
        return;
    };
    let (from, turn) = (sketch.pose[body][2] + from, (to - from).rem_euclid(TAU));
    let parts = (turn / CORNER).ceil().max(1.0);
    let rim = (0..=parts as usize).map(|k| {
        let (sin, cos) = (from + turn * k as f64 / parts).sin_cos();
        [x + radius * cos, y - radius * sin]
    });
    scene.area("tip", rim.collect::<Vec<Place>>(), Some(fill), Some(pen));
}
