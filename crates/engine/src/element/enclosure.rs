//! The material that a closed outline bounds.
//!
//! The outline goes round a point by its winding number, Σ of the angles under which its pieces are seen, in turns: once around
//! what it encloses, and not around what is outside. The material is on its left: inside of one that goes round
//! counter-clockwise, outside of one that goes round clockwise.

use super::{Kinematics, Marker};
use linkdyn_linear::math::Vec2;
use std::f64::consts::TAU;
use std::ops::Range;

/// Where a piece begins and ends.
pub type Ends = [Vec2; 2];

/// The centre of an arc, and whether it turns left.
pub type Arc = (Vec2, bool);

/// A closed outline.
#[derive(Debug, Clone, PartialEq)]
pub struct Enclosure {
    /// Whose outline it is: any point of its body.
    pub outline: Marker,
    /// The centre of the tip.
    pub tip: Marker,
    /// Its pieces from the point of the body \[m\], in the body's frame.
    pub ways: Vec<(Ends, Option<Arc>)>,
    /// The contacts that they are.
    pub edges: Range<usize>,
}

/// The angle under which a way is seen from a point, in parts of a turn.
fn seen([from, to]: Ends, arc: Option<Arc>, point: Vec2) -> f64 {
    let (a, b) = (from - point, to - point);
    let angle = (a.x * b.y - a.y * b.x).atan2(a.dot(&b)) / TAU;
    let Some((centre, left)) = arc else {
        return angle;
    };
    // Between an arc and its chord the way is seen from the other side.
    let way = to - from;
    let side = way.x * (point.y - from.y) - way.y * (point.x - from.x);
    let is_between = (side < 0.0) == left && (point - centre).norm() < (from - centre).norm();
    match (is_between, left) {
        (false, _) => angle,
        (true, true) => angle + 1.0,
        (true, false) => angle - 1.0,
    }
}

impl Enclosure {
    /// How often the outline goes round a point of its body.
    fn turns(&self, point: Vec2) -> f64 {
        let ways = self.ways.iter();
        ways.map(|&(ends, arc)| seen(ends, arc, point))
            .sum::<f64>()
            .round()
    }

    /// Twice the area within the corners, below 0 where they go round clockwise \[m²\].
    fn area(&self) -> f64 {
        let ways = self.ways.iter();
        ways.map(|([a, b], arc)| {
            // The middle of an arc, where both of two are half a turn.
            let middle = arc.map(|(centre, left)| {
                let off = Vec2::new(b.y - a.y, a.x - b.x).normalize();
                centre + off * (a - centre).norm() * if left { 1.0 } else { -1.0 }
            });
            let cross = |a: &Vec2, b: &Vec2| a.x * b.y - a.y * b.x;
            middle.map_or_else(
                || cross(a, b),
                |middle| cross(a, &middle) + cross(&middle, b),
            )
        })
        .sum()
    }

    /// Whether the tip's centre is in the material.
    pub fn has_inside(&self, at: &Kinematics) -> bool {
        let away = self.tip.place(at) - self.outline.place(at);
        let (sin, cos) = at.poses[self.outline.body.0].theta.sin_cos();
        let point = Vec2::new(cos * away.x + sin * away.y, cos * away.y - sin * away.x);
        self.is_material(point)
    }

    fn is_material(&self, point: Vec2) -> bool {
        let outside = if self.area() < 0.0 { -1.0 } else { 0.0 };
        self.turns(point) > outside
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::marker;
    use super::*;

    fn enclosure(nodes: &[[f64; 3]]) -> Enclosure {
        let place = |node: &[f64; 3]| Vec2::new(node[0], node[1]);
        let ways = nodes.windows(2).map(|pair| {
            let ends = [place(&pair[0]), place(&pair[1])];
            // Every arc here is about the origin.
            let arc = (pair[1][2] != 0.0).then(|| (Vec2::zeros(), pair[1][2] > 0.0));
            (ends, arc)
        });
        Enclosure {
            outline: marker(1, 0.0, 0.0),
            tip: marker(2, 0.0, 0.0),
            ways: ways.collect(),
            edges: 0..0,
        }
    }

    fn is_inside(of: &Enclosure, x: f64, y: f64) -> bool {
        of.is_material(Vec2::new(x, y))
    }

    /// What goes round counter-clockwise is solid, what goes round clockwise a hole.
    #[test]
    fn the_material_is_on_the_left() {
        let square = [
            [1.0, 1.0, 0.0],
            [-1.0, 1.0, 0.0],
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
        ];
        let mut hole = square;
        hole.reverse();
        for (x, y, within) in [
            (0.0, 0.0, true),
            (0.9, -0.9, true),
            (1.1, 0.0, false),
            (-3.0, 1.0, false),
        ] {
            assert_eq!(is_inside(&enclosure(&square), x, y), within, "{x}, {y}");
            assert_eq!(is_inside(&enclosure(&hole), x, y), !within, "{x}, {y}");
        }
    }

    /// A disc and a drum of two halves, and a crescent between an arc and its chord.
    #[test]
    fn arcs_count_between_them_and_their_chords() {
        let round =
            |radius: f64| enclosure(&[[1.0, 0.0, 0.0], [-1.0, 0.0, radius], [1.0, 0.0, radius]]);
        let half = enclosure(&[[1.0, 0.0, 0.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
        for (x, y) in [(0.0, 0.9), (0.3, -0.9), (0.9, 0.1), (0.9, 0.9), (-1.1, 0.2)] {
            let within = f64::hypot(x, y) < 1.0;
            assert_eq!(is_inside(&round(1.0), x, y), within, "{x}, {y}");
            assert_eq!(is_inside(&round(-1.0), x, y), !within, "{x}, {y}");
            assert_eq!(is_inside(&half, x, y), within && y > 0.0, "{x}, {y}");
        }
    }
}
