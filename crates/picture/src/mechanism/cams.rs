//! Cams: the true profile, and the roller or the face that touches it.

use super::places::turned;
use super::sketch::Sketch;
use crate::palette;
use crate::poses::global;
use crate::scene::{Ink, Pen, Place, Scene};
use crate::shape::{Joint, JointKind};

/// How much of the fill a cam and a roller have: what lies behind shows through.
const FILL: f64 = 0.55;
/// Width of a face, and how far it reaches beyond where it is touched, in bars.
const FACE: f64 = 0.7;
const BEYOND: f64 = 1.5;
/// Radius of the pin of a roller, in bars.
const PIN: f64 = 0.45;

/// Draws the profile of a cam, behind the bodies.
pub fn draw_profile(scene: &mut Scene, sketch: &Sketch, joint: &Joint) {
    let JointKind::Cam(cam) = &joint.kind else {
        return;
    };
    let (body, point) = joint.between[0];
    let from = sketch
        .mechanism
        .shape
        .point((body, point))
        .unwrap_or_default();
    let corner = |[x, y]: &[f64; 2]| -> Place {
        let place = global(sketch.pose[body], [from[0] + x, from[1] + y]);
        sketch.view.place(place)
    };
    let corners: Vec<Place> = cam.outline.iter().map(corner).collect();
    if corners.len() > 2 {
        let (fill, pen) = sketch.of_body(body);
        scene.area("cam", corners, Some(fill.faded(FILL)), Some(pen));
    }
}

/// Draws the roller or the face of a follower.
pub fn draw_follower(scene: &mut Scene, sketch: &Sketch, joint: &Joint) {
    let JointKind::Cam(cam) = &joint.kind else {
        return;
    };
    let (at, bar) = (sketch.at(joint.between[1]), sketch.bar());
    let body = joint.between[1].0;
    let (fill, pen) = sketch.of_body(body);
    if let Some(radius) = cam.roller {
        let radius = radius * sketch.view.scale;
        scene.circle("roller", at, radius, Some(fill.faded(FILL)), Some(pen));
        let white = Some(Ink::grey(255).faded(sketch.strength));
        let steel = Some(sketch.pen(palette::STEEL));
        scene.circle("pin", at, (PIN * bar).min(0.5 * radius), white, steel);
    }
    if let Some(face) = cam.face {
        let [u, v] = turned(sketch.pose[body], face);
        let length = u.hypot(v);
        if length > 0.0 {
            let reach = cam.reach.unwrap_or(0.0) * sketch.view.scale + BEYOND * bar;
            let end = |far: f64| [at[0] + far * u / length, at[1] - far * v / length];
            let width = FACE * bar;
            scene.line("face", [end(-reach), end(reach)], Pen { width, ..pen });
        }
    }
}
