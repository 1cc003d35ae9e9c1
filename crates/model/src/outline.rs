//! Outlines of contacts as ways from point to point.

use std::f64::consts::TAU;

use crate::joint::JointKind;

/// Points this near, in parts of an outline, are one: coordinates are written with the digits of a drawing.
const NEAR: f64 = 1e-4;

/// A point of an outline \[m\], with the radius of the arc that leads to it, 0 where a straight does.
pub type Corner = ([f64; 2], f64);

impl JointKind {
    /// The whole outline of a contact in the first body's frame, repeated around a point of that; empty of other joints. Copies that
    /// end where the next begins are one way.
    ///
    /// A way is closed where it ends exactly where it began.
    pub fn outlines_around(&self, centre: [f64; 2]) -> Vec<Vec<Corner>> {
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
        let mut ways: Vec<Vec<Corner>> = Vec::new();
        for copy in 0..repeat {
            let (sin, cos) = (TAU * copy as f64 / repeat as f64).sin_cos();
            let corners = outline.iter().filter(|node| node.len() > 1).map(|node| {
                let d = [node[0] - centre[0], node[1] - centre[1]];
                let place = match copy {
                    0 => [node[0], node[1]],
                    _ => [
                        centre[0] + cos * d[0] - sin * d[1],
                        centre[1] + sin * d[0] + cos * d[1],
                    ],
                };
                (place, node.get(2).copied().unwrap_or(0.0))
            });
            let corners: Vec<Corner> = corners.collect();
            let end = ways.last().and_then(|way| way.last());
            match (end, corners.first()) {
                (Some((end, _)), Some((first, _))) if same(*end, *first) => {
                    let last = ways.len() - 1;
                    ways[last].extend_from_slice(&corners[1..]);
                }
                _ => ways.push(corners),
            }
        }
        for way in &mut ways {
            let first = way.first().map(|(first, _)| *first);
            if let (Some(first), Some((last, _))) = (first, way.last_mut())
                && same(*last, first)
            {
                *last = first;
            }
        }
        ways
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Teeth of a ratchet, whose end is written with five digits.
    #[test]
    fn copies_that_meet_but_for_rounding_are_one_way() {
        let kind = JointKind::Contact {
            outline: vec![vec![40.0, 0.0], vec![50.0, 0.0], vec![34.641, 20.0]],
            repeat: Some(12),
            radius: 0.0,
            arc: None,
            friction: None,
        };
        let ways = kind.outlines_around([0.0, 0.0]);
        assert_eq!((ways.len(), ways[0].len()), (1, 25));
        assert_eq!(ways[0].first(), ways[0].last());
    }
}
