//! Blocks, slots, centres of mass.

use crate::palette::{CARD, INK};
use crate::sign::{
    Colour, Corner, Edge, OUTLINE, Outline, Paint, Sign, Stroke, area, bars, circle, line,
};

/// Half length and half height of a block, in bars.
pub const BLOCK: [f64; 2] = [2.4, 1.4];
/// Half widths of a slot, outside and inside, in bars.
const SLOT: [f64; 2] = [1.8, 1.05];

/// A block on a guide.
pub fn block() -> Sign {
    let [far, high] = BLOCK;
    let corners = [[-far, high], [far, high], [far, -high], [-far, -high]].map(|[x, y]| bars(x, y));
    vec![area("block", corners, Paint::FILL, Edge::BODY)]
}

/// A slot between the outermost places of its pin: a body with a groove.
pub fn slot(ends: [Corner; 2]) -> Sign {
    let groove = [(SLOT[0], Paint::FILL), (SLOT[1], Paint::of(CARD))].map(|(half, fill)| Stroke {
        class: "slot",
        outline: Outline::Hull(ends.to_vec(), half),
        fill: Some(fill),
        edge: Some(Edge::BODY),
    });
    // The way of the pin itself, for whoever edits the figure.
    let thin = Edge {
        paint: Paint {
            colour: Colour::Edge,
            alpha: 0.4,
        },
        ..Edge::BODY.wide(0.5 * OUTLINE)
    };
    groove
        .into_iter()
        .chain([line("guide", ends, thin)])
        .collect()
}

/// Radius of the sign of a centre of mass, in bars.
const MASS: f64 = 0.6;

/// A centre of mass: a quartered disc.
pub fn centre_of_mass() -> Sign {
    let edge = Edge::of(INK).wide(0.8 * OUTLINE);
    let mut sign = vec![circle(
        "mass",
        Corner::default(),
        [0.0, MASS],
        Paint::of(CARD),
        edge,
    )];
    for side in [1.0, -1.0] {
        let rim = (0..=8).map(|k| (f64::from(k) * std::f64::consts::FRAC_PI_2 / 8.0).sin_cos());
        let rim = rim.map(|(sin, cos)| bars(-side * MASS * cos, side * MASS * sin));
        let corners: Vec<Corner> = [Corner::default()].into_iter().chain(rim).collect();
        sign.push(area("mass", corners, Paint::of(INK), None));
    }
    sign
}
