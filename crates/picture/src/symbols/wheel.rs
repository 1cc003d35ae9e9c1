//! Toothed wheels.

use crate::sign::{Colour, Corner, Edge, Paint, Sign, Stroke, area, circle, line, metres};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Length of a tooth with its gap along the pitch circle, half its depth, and the rim of an internal wheel, in bars.
const PITCH: f64 = 2.0;
pub(super) const DEPTH: f64 = 0.42;
pub(super) const RIM: f64 = 1.5;
/// Least and greatest number of teeth: they are a sign, not those of the wheel.
const TEETH: [f64; 2] = [8.0, 240.0];
/// Where a tooth changes between root (−1) and tip (1), as parts of its pitch.
const TOOTH: [[f64; 2]; 4] = [[0.0, -1.0], [0.3, -1.0], [0.45, 1.0], [0.85, 1.0]];
/// Pieces of the rim of an internal wheel.
const PIECES: usize = 90;
/// How much of the fill a wheel has: what lies behind shows through.
pub(super) const FILL: f64 = 0.45;

/// A corner around the origin; the angle counts to the right.
fn around(radius: f64, angle: f64) -> Corner {
    metres(radius * angle.cos(), -radius * angle.sin())
}

/// Two spokes of that length \[m\].
pub(super) fn spokes(reach: f64) -> impl Iterator<Item = Stroke> {
    let dashed = Edge {
        paint: Paint {
            colour: Colour::Edge,
            alpha: 0.6,
        },
        dash: &[3.0, 2.0],
        ..Edge::BODY
    };
    [0.0, FRAC_PI_2].into_iter().map(move |quarter| {
        line(
            "spoke",
            [reach, -reach].map(|radius| around(radius, quarter)),
            dashed,
        )
    })
}

/// Number of teeth of a wheel with that radius, where a bar is so long \[m\].
pub(super) fn teeth_count(radius: f64, bar: f64) -> f64 {
    (TAU * radius / (PITCH * bar))
        .round()
        .clamp(TEETH[0], TEETH[1])
}

/// A wheel with that radius of its pitch circle, with a sign that shows how it turns; a bar is so many metres long.
pub fn wheel(radius: f64, internal: bool, bar: f64) -> Sign {
    let count = teeth_count(radius, bar);
    let tooth = |k: usize| {
        TOOTH.map(|[part, out]| around(radius + out * DEPTH * bar, TAU * (k as f64 + part) / count))
    };
    let teeth: Vec<Corner> = (0..count as usize).flat_map(tooth).collect();
    let fill = Paint::FILL.faded(FILL);
    if internal {
        return ring(teeth, radius + RIM * bar, fill);
    }
    let reach = (radius - 2.0 * DEPTH * bar).max(0.0);
    [area("wheel", teeth, fill, Edge::BODY)]
        .into_iter()
        .chain(spokes(reach))
        .collect()
}

/// A ring without teeth, of that radius inside; a bar is so many metres long.
pub fn plain_ring(radius: f64, bar: f64) -> Sign {
    [radius, radius + RIM * bar]
        .map(|radius| circle("wheel", Corner::default(), [radius, 0.0], None, Edge::BODY))
        .into()
}

/// A ring with teeth inside: its area goes around outside, and back inside.
fn ring(teeth: Vec<Corner>, outside: f64, fill: Paint) -> Sign {
    let rim = |k: usize| around(outside, TAU * k as f64 / PIECES as f64);
    let mut corners: Vec<Corner> = (0..=PIECES).map(rim).collect();
    corners.extend(teeth.first());
    corners.extend(teeth.iter().rev());
    vec![
        area("wheel", corners, fill, None),
        area("wheel", teeth, None, Edge::BODY),
        circle("wheel", Corner::default(), [outside, 0.0], None, Edge::BODY),
    ]
}
