//! Belts: the strands between two pulleys, and the arcs around them.
//!
//! With e from centre to centre, n = e⊥ and sin β = (r₁ ∓ r₂)/ℓ (− of an open, + of a crossed belt), a strand leaves the first pulley
//! at sin β e ± cos β n from its centre, and meets the second one there, or opposite where the strands cross.

use super::wheel::{FILL, Wheel};
use crate::scene::{Ink, Pen, Place, Scene};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Width of the belt, in bars.
const WIDTH: f64 = 0.45;
/// Angle between corners of its arcs \[rad\].
const CORNER: f64 = 0.05;

/// Two pulleys and their belt on the page.
#[derive(Debug, Clone, Copy)]
pub struct Belt {
    /// The pulleys.
    pub pulleys: [Wheel; 2],
    /// Whether the strands cross.
    pub crossed: bool,
}

impl Belt {
    /// The belt all around, closed: the first arc, a strand, the second arc; none where pulleys overlap.
    fn loop_of(&self) -> Option<Vec<Place>> {
        let [first, second] = &self.pulleys;
        let [x, y] = [0, 1].map(|k| second.centre[k] - first.centre[k]);
        let length = x.hypot(y);
        let sign = if self.crossed { -1.0 } else { 1.0 };
        let sin = (first.radius - sign * second.radius) / length;
        if sin.is_nan() || sin.abs() >= 1.0 {
            return None;
        }
        let (psi, leave) = (y.atan2(x), FRAC_PI_2 - sin.asin());
        let meet = if self.crossed {
            std::f64::consts::PI - leave
        } else {
            leave
        };
        let arc = |wheel: &Wheel, from: f64, to: f64| -> Vec<Place> {
            let corners = ((to - from).abs() / CORNER).ceil().max(1.0);
            let at = |k: usize| {
                let angle = psi + from + (to - from) * k as f64 / corners;
                let [x, y] = wheel.centre;
                [
                    x + wheel.radius * angle.cos(),
                    y + wheel.radius * angle.sin(),
                ]
            };
            (0..=corners as usize).map(at).collect()
        };
        let mut places = arc(first, leave, TAU - leave);
        // From the first pulley's side at −leave to the second's: the same side, or across.
        places.extend(if self.crossed {
            arc(second, meet, -meet)
        } else {
            arc(second, -meet, meet)
        });
        places.extend(places.first().copied());
        Some(places)
    }
}

/// Draws a belt.
pub fn belt(scene: &mut Scene, belt: &Belt, bar: f64, pen: Pen) {
    if let Some(places) = belt.loop_of() {
        let width = WIDTH * bar;
        scene.line("belt", places, Pen { width, ..pen });
    }
}

/// Draws a pulley with spokes that show how it turns.
pub fn pulley(scene: &mut Scene, wheel: &Wheel, (fill, pen): (Ink, Pen)) {
    let fill = Some(fill.faded(FILL));
    scene.circle("pulley", wheel.centre, wheel.radius, fill, Some(pen));
    wheel.spokes(scene, wheel.radius, pen);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strands touch both circles: they are square to the radius at both of their ends.
    #[test]
    fn strands_are_tangents() {
        let wheel = |x: f64, y: f64, radius: f64| Wheel {
            centre: [x, y],
            radius,
            angle: 0.0,
            internal: false,
        };
        let pulleys = [wheel(10.0, 20.0, 8.0), wheel(50.0, -10.0, 17.0)];
        for crossed in [false, true] {
            let places = Belt { pulleys, crossed }.loop_of().expect("strands");
            // The longest pieces are the strands.
            let mut pieces: Vec<&[Place]> = places.windows(2).collect();
            let long =
                |piece: &[Place]| (piece[1][0] - piece[0][0]).hypot(piece[1][1] - piece[0][1]);
            pieces.sort_by(|a, b| long(b).total_cmp(&long(a)));
            let ends: Vec<Place> = pieces[..2]
                .iter()
                .flat_map(|piece| piece.to_vec())
                .collect();
            for (k, end) in ends.iter().enumerate() {
                let [a, b] = [&ends[k - k % 2], &ends[k - k % 2 + 1]];
                let along = [b[0] - a[0], b[1] - a[1]];
                let near = pulleys.iter().find(|wheel| {
                    let far = (end[0] - wheel.centre[0]).hypot(end[1] - wheel.centre[1]);
                    (far - wheel.radius).abs() < 1e-9
                });
                let centre = near.expect("on a pulley").centre;
                let dot = along[0] * (end[0] - centre[0]) + along[1] * (end[1] - centre[1]);
                assert!(dot.abs() < 1e-9, "{crossed}: {dot}");
            }
        }
    }
}
