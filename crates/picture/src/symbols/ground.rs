//! What stands still: hatched lines, supports of pins, rails of a guide.

use super::line::BLOCK;
use crate::palette::{CARD, GROUND};
use crate::sign::{Corner, Edge, OUTLINE, Outline, Paint, Sign, Stroke, area, bars};

/// The support of a pin: a triangle on hatched ground.
pub fn support() -> Sign {
    let foot = -2.6;
    let corners = [bars(0.0, 0.0), bars(1.6, foot), bars(-1.6, foot)];
    let triangle = area("support", corners, Paint::of(CARD), Edge::of(GROUND));
    let ground = hatched_line(
        [bars(-2.4, foot), bars(2.4, foot)],
        f64::INFINITY,
        Edge::of(GROUND),
    );
    vec![triangle, ground]
}

/// A line with short strokes on its right side, seen from the first corner to the second; a bar is `bar` metres long where strokes
/// are counted.
pub fn hatched_line(ends: [Corner; 2], bar: f64, edge: Edge) -> Stroke {
    let [from, to] = &ends;
    let [x, y] = [0, 1].map(|k| (to.metres[k] - from.metres[k]) / bar + to.bars[k] - from.bars[k]);
    let strokes = (x.hypot(y) / 0.9).floor().clamp(1.0, 200.0) as usize;
    Stroke {
        class: "ground",
        outline: Outline::Ground(ends, strokes),
        fill: None,
        edge: Some(edge),
    }
}

/// Both rails of a guide that stands still; `ends` are the outermost places of the block.
pub fn rails([from, to]: [Corner; 2], bar: f64) -> Sign {
    let [over, away] = [BLOCK[0] + 0.8, BLOCK[1] + 0.5 * OUTLINE];
    let right = [from.beside(-over, -away), to.beside(over, -away)];
    // Backwards, so that its strokes are outside as well.
    let left = [to.beside(over, away), from.beside(-over, away)];
    [right, left]
        .map(|rail| hatched_line(rail, bar, Edge::BODY))
        .to_vec()
}
