//! Arrows: straight ones of forces and slides, round ones of torques and rotations.

use crate::sign::{Corner, Edge, Sign, Stroke, along, area, bars, line};

/// Length and half the width of a head, in bars.
pub const HEAD: [f64; 2] = [1.7, 0.75];
/// Width of arrows, in bars.
const WIDTH: f64 = 0.32;
/// Where a round arrow begins and ends \[rad\], counted to the left from the right.
const ROUND: [f64; 2] = [-3.8, 0.4];
/// Pieces of a round arrow.
const PIECES: usize = 40;
/// Distance of the second head of an arrow that is cut, in bars.
const SECOND: f64 = 1.4;

/// An arrow along a line, from one corner to another.
pub fn arrow(class: &'static str, [from, to]: [Corner; 2], edge: Edge) -> Sign {
    let shaft = line(
        class,
        [from, to.beside(-0.8 * HEAD[0], 0.0)],
        edge.wide(WIDTH),
    );
    vec![shaft, head(class, to, edge)]
}

/// An arrow over the whole length of a line, and the same with a second head, for a force that is larger than it is drawn.
pub fn force_arrows(class: &'static str, edge: Edge) -> [Sign; 2] {
    let one = arrow(class, [along(0.0), along(1.0)], edge);
    let mut two = one.clone();
    two.push(head(class, along(1.0).beside(-SECOND, 0.0), edge));
    [one, two]
}

fn head(class: &'static str, tip: Corner, edge: Edge) -> Stroke {
    let corners = [
        tip,
        tip.beside(-HEAD[0], HEAD[1]),
        tip.beside(-HEAD[0], -HEAD[1]),
    ];
    area(class, corners, edge.paint, None)
}

/// An arrow around the origin, to the left or to the right; its radius in bars.
pub fn round_arrow(class: &'static str, radius: f64, left: bool, edge: Edge) -> Sign {
    // To the right it is the same arrow, seen in a mirror that stands upright.
    let side = if left { 1.0 } else { -1.0 };
    let place = |angle: f64| bars(side * radius * angle.cos(), radius * angle.sin());
    let (tip, [start, end]) = (HEAD[0] / radius, ROUND);
    let arc = (0..=PIECES).map(|k| start + (end - 0.8 * tip - start) * k as f64 / PIECES as f64);
    let arc: Vec<Corner> = arc.map(place).collect();
    let (neck, point) = (place(end - tip), place(end));
    // Half the width of the head goes with its length.
    let [x, y] = [0, 1].map(|k| HEAD[1] / HEAD[0] * (point.bars[k] - neck.bars[k]));
    let corners = [point, neck.beside(y, -x), neck.beside(-y, x)];
    vec![
        line(class, arc, edge.wide(WIDTH)),
        area(class, corners, edge.paint, None),
    ]
}
