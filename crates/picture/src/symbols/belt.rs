//! Belts: the strands between two pulleys, and the arcs around them.
//!
//! With e from centre to centre, n = e⊥ and sin β = (r₁ ∓ r₂)/ℓ (− of an open, + of a crossed belt), a strand leaves the first pulley
//! at sin β e ± cos β n from its centre, and meets the second one there, or opposite where the strands cross.

use super::wheel::{FILL, spokes};
use crate::palette::STEEL;
use crate::sign::{Corner, Edge, Paint, Sign, Stroke, along, circle, line};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Width of the belt, in bars.
const WIDTH: f64 = 0.45;
/// Angle between corners of its arcs \[rad\].
const CORNER: f64 = 0.05;

/// A belt from the centre of one pulley to that of the other, at that distance \[m\], closed: the first arc, a strand, the second arc;
/// nothing where pulleys overlap.
pub fn belt(radii: [f64; 2], crossed: bool, distance: f64) -> Option<Stroke> {
    let sign = if crossed { -1.0 } else { 1.0 };
    let sin = (radii[0] - sign * radii[1]) / distance;
    if sin.is_nan() || sin.abs() >= 1.0 {
        return None;
    }
    let leave = FRAC_PI_2 - sin.asin();
    let meet = if crossed { PI - leave } else { leave };
    let arc = |wheel: usize, from: f64, to: f64| -> Vec<Corner> {
        let corners = ((to - from).abs() / CORNER).ceil().max(1.0);
        let at = |k: usize| {
            let angle = from + (to - from) * k as f64 / corners;
            let [x, y] = [angle.cos(), -angle.sin()].map(|part| radii[wheel] * part);
            along(wheel as f64).beyond(x, y)
        };
        (0..=corners as usize).map(at).collect()
    };
    let mut corners = arc(0, leave, TAU - leave);
    // From the first pulley's side at −leave to the second's: the same side, or across.
    corners.extend(if crossed {
        arc(1, meet, -meet)
    } else {
        arc(1, -meet, meet)
    });
    corners.extend(corners.first().copied());
    Some(line("belt", corners, Edge::of(STEEL).wide(WIDTH)))
}

/// A pulley of that radius \[m\], with spokes that show how it turns.
pub fn pulley(radius: f64) -> Sign {
    let rim = circle(
        "pulley",
        Corner::default(),
        [radius, 0.0],
        Paint::FILL.faded(FILL),
        Edge::BODY,
    );
    [rim].into_iter().chain(spokes(radius)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sign::Outline;

    /// Strands touch both circles: they are square to the radius at both of their ends.
    #[test]
    fn strands_are_tangents() {
        let (radii, distance) = ([8.0, 17.0], 50.0);
        for crossed in [false, true] {
            let Outline::Line(corners) = belt(radii, crossed, distance).expect("strands").outline
            else {
                panic!("a line")
            };
            let place =
                |corner: &Corner| [corner.metres[0] + corner.along * distance, corner.metres[1]];
            let mut pieces: Vec<&[Corner]> = corners.windows(2).collect();
            // The longest pieces are the strands.
            let long = |piece: &[Corner]| {
                let [a, b] = [place(&piece[0]), place(&piece[1])];
                (b[0] - a[0]).hypot(b[1] - a[1])
            };
            pieces.sort_by(|a, b| long(b).total_cmp(&long(a)));
            for piece in &pieces[..2] {
                let [a, b] = [place(&piece[0]), place(&piece[1])];
                for end in *piece {
                    let [x, y] = end.metres;
                    assert!(
                        (x.hypot(y) - radii[end.along as usize]).abs() < 1e-9,
                        "on a pulley"
                    );
                    let dot = (b[0] - a[0]) * x + (b[1] - a[1]) * y;
                    assert!(dot.abs() < 1e-9, "{crossed}: {dot}");
                }
            }
        }
    }
}
