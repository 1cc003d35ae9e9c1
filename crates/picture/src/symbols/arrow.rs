//! Arrows: straight ones of forces and slides, round ones of torques and rotations.

use super::line::Line;
use crate::scene::{Pen, Place, Scene};

/// Length and half the width of a head, in bars.
const HEAD: [f64; 2] = [1.7, 0.75];
/// Where a round arrow begins and ends \[rad\], counted to the left from the right.
const ROUND: [f64; 2] = [-3.8, 0.4];
/// Pieces of a round arrow.
const PIECES: usize = 40;

/// An arrow with its head at the second place.
pub fn arrow(scene: &mut Scene, class: &'static str, ends: [Place; 2], bar: f64, pen: Pen) {
    let Some(line) = Line::between(ends) else {
        return;
    };
    let tip = (HEAD[0] * bar).min(line.length);
    scene.line(class, [ends[0], line.at(line.length - 0.8 * tip, 0.0)], pen);
    head(scene, class, &line, tip, pen);
}

/// The head at the end of a line.
fn head(scene: &mut Scene, class: &'static str, line: &Line, tip: f64, pen: Pen) {
    let (neck, wide) = (line.length - tip, tip * HEAD[1] / HEAD[0]);
    let corners = [
        line.at(line.length, 0.0),
        line.at(neck, wide),
        line.at(neck, -wide),
    ];
    scene.area(class, corners, Some(pen.ink), None);
}

/// An arrow around a place, to the left or to the right; its radius in bars.
pub fn round_arrow(
    scene: &mut Scene,
    class: &'static str,
    (centre, radius): (Place, f64),
    left: bool,
    bar: f64,
    pen: Pen,
) {
    let side = if left { 1.0 } else { -1.0 };
    // To the right it is the same arrow, seen in a mirror that stands upright.
    let place = |angle: f64, radius: f64| {
        let [x, y] = [angle.cos(), angle.sin()].map(|part| radius * bar * part);
        [centre[0] + side * x, centre[1] - y]
    };
    let tip = HEAD[0] / radius;
    let [start, end] = ROUND;
    let arc = (0..=PIECES).map(|k| start + (end - 0.8 * tip - start) * k as f64 / PIECES as f64);
    scene.line(
        class,
        arc.map(|angle| place(angle, radius)).collect::<Vec<_>>(),
        pen,
    );
    if let Some(line) = Line::between([place(end - tip, radius), place(end, radius)]) {
        head(scene, class, &line, line.length, pen);
    }
}
