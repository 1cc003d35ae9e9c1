//! Outlines of contacts as ways from point to point.

use std::f64::consts::TAU;

use crate::joint::JointKind;

/// Lengths below this part of an outline are none.
const NEAR: f64 = 1e-9;

/// A point of an outline \[m\], with the radius of the arc that leads to it, 0 where a straight does.
pub type Corner = ([f64; 2], f64);

impl JointKind {
    /// The whole outline of a contact in the first body's frame, repeated around a point of that; empty of other joints.
    ///
    /// It is closed where it ends exactly where it began.
    pub fn outline_around(&self, centre: [f64; 2]) -> Vec<Corner> {
        let JointKind::Contact {
            outline, repeat, ..
        } = self
        else {
            return Vec::new();
        };
        let size = outline
            .iter()
            .flatten()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let same = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) <= NEAR * size;
        let repeat = repeat.unwrap_or(1);
        let mut corners: Vec<Corner> = Vec::new();
        for copy in 0..repeat {
            let (sin, cos) = (TAU * copy as f64 / repeat as f64).sin_cos();
            for node in outline.iter().filter(|node| node.len() > 1) {
                let d = [node[0] - centre[0], node[1] - centre[1]];
                let place = match copy {
                    0 => [node[0], node[1]],
                    _ => [
                        centre[0] + cos * d[0] - sin * d[1],
                        centre[1] + sin * d[0] + cos * d[1],
                    ],
                };
                if corners.last().is_none_or(|(last, _)| !same(*last, place)) {
                    corners.push((place, node.get(2).copied().unwrap_or(0.0)));
                }
            }
        }
        let Some(&(first, _)) = corners.first() else {
            return corners;
        };
        match corners.last_mut() {
            Some((last, _)) if same(*last, first) => *last = first,
            _ if repeat > 1 => corners.push((first, 0.0)),
            _ => {}
        }
        corners
    }
}

/// The centre of an arc of a radius from one point to another, which turns left where the radius is positive; never more than half a
/// turn.
pub fn arc_centre(from: [f64; 2], to: [f64; 2], radius: f64) -> [f64; 2] {
    let half = [0.5 * (to[0] - from[0]), 0.5 * (to[1] - from[1])];
    let square = half[0] * half[0] + half[1] * half[1];
    let off = (radius * radius - square).max(0.0).sqrt() * radius.signum() / square.sqrt();
    [
        from[0] + half[0] - off * half[1],
        from[1] + half[1] + off * half[0],
    ]
}
