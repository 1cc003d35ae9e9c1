//! Springs and dampers, straight ones and those around a pin.

use crate::palette::INK;
use crate::sign::{Corner, Edge, Outline, Sign, Stroke, along, bars, line};

/// Strokes of a straight spring.
const STROKES: usize = 14;
/// Half the width of a straight spring or damper, in bars.
const WIDTH: f64 = 1.2;
/// Distance of a spring and its parallel damper from the line between their ends, in bars.
const ASIDE: f64 = 1.6;
/// Where the strokes of a spring begin and end, as parts of its length.
const COILS: [f64; 2] = [0.15, 0.85];
/// Least and greatest radius of a coil around a pin, and how far its legs reach, in bars.
const COIL: [f64; 2] = [1.1, 2.1];
const LEGS: f64 = 3.4;
/// How far a damper reaches around a pin \[rad\].
const BENT: f64 = 0.8 * std::f64::consts::TAU;

const EDGE: Edge = Edge::of(INK);

/// A spring.
pub fn spring() -> Sign {
    let [low, high] = COILS;
    let corners = [along(0.0), along(low)].into_iter().chain(strokes(0.0));
    let corners = corners.chain([along(high), along(1.0)]);
    vec![line("spring", corners.collect::<Vec<_>>(), EDGE)]
}

/// A spring and a damper side by side, between two bars.
pub fn damped_spring() -> Sign {
    let at = |part: f64, side: f64| along(part).beside(0.0, side * ASIDE);
    let [low, high] = COILS;
    let coils = [at(low, 1.0)]
        .into_iter()
        .chain(strokes(ASIDE))
        .chain([at(high, 1.0)]);
    let mut sign = vec![line("spring", coils.collect::<Vec<_>>(), EDGE)];
    sign.extend(straight_dashpot(COILS, -ASIDE));
    for (end, part) in [0.0, 1.0].into_iter().zip(COILS) {
        sign.push(line("spring", [along(end), along(part)], EDGE));
        sign.push(line("spring", [at(part, 1.0), at(part, -1.0)], EDGE));
    }
    sign
}

/// Corners of the strokes of a spring so far to the left of its line, in bars.
fn strokes(left: f64) -> impl Iterator<Item = Corner> {
    let [low, high] = COILS;
    let step = (high - low) / STROKES as f64;
    (0..STROKES).map(move |index| {
        let side = if index % 2 == 0 { -WIDTH } else { WIDTH };
        along(low + (index as f64 + 0.5) * step).beside(0.0, left + side)
    })
}

/// The strokes of a damper between 0 and 1 along and −1 and 1 across: rod, cup, piston, rod.
const DASHPOT: [&[[f64; 2]]; 4] = [
    &[[0.0, 0.0], [0.4, 0.0]],
    &[[0.7, 1.0], [0.4, 1.0], [0.4, -1.0], [0.7, -1.0]],
    &[[0.58, 0.7], [0.58, -0.7]],
    &[[0.58, 0.0], [1.0, 0.0]],
];

/// A damper.
pub fn dashpot() -> Sign {
    straight_dashpot([0.0, 1.0], 0.0).collect()
}

/// A damper between two parts of a line, so far to the left of it, in bars.
fn straight_dashpot([from, to]: [f64; 2], left: f64) -> impl Iterator<Item = Stroke> {
    DASHPOT.into_iter().map(move |stroke| {
        let corners = stroke
            .iter()
            .map(|[s, d]| along(from + s * (to - from)).beside(0.0, left - d * WIDTH));
        line("damper", corners.collect::<Vec<_>>(), EDGE)
    })
}

/// A corner around a pin; the angle counts to the left.
fn around(radius: f64, angle: f64) -> Corner {
    bars(radius * angle.cos(), radius * angle.sin())
}

/// A coil around a pin, which winds up with the angle between both bodies.
pub fn coil(bodies: [usize; 2]) -> Sign {
    vec![Stroke {
        class: "coil",
        outline: Outline::Coil(COIL, bodies),
        fill: None,
        edge: Some(EDGE),
    }]
}

/// The legs of a coil, each along its own body.
pub fn legs() -> [Sign; 2] {
    COIL.map(|radius| vec![line("leg", [bars(radius, 0.0), bars(LEGS, 0.0)], EDGE)])
}

/// A damper bent around a pin.
pub fn round_dashpot() -> Sign {
    let [low, high] = COIL;
    let bent = |[s, d]: [f64; 2]| around((low + high) / 2.0 + d * (high - low) / 2.0, s * BENT);
    let stroke = |stroke: &[[f64; 2]]| {
        let mut corners = vec![bent(stroke[0])];
        for pair in stroke.windows(2) {
            let part =
                |k: usize| [0, 1].map(|i| pair[0][i] + k as f64 / 16.0 * (pair[1][i] - pair[0][i]));
            corners.extend((1..=16).map(|k| bent(part(k))));
        }
        line("damper", corners, EDGE)
    };
    DASHPOT.into_iter().map(stroke).collect()
}
