//! What stands still: hatched lines, supports of pins, rails of a guide.

use super::line::{BLOCK, Line};
use crate::scene::{Ink, Pen, Place, Scene};

/// The support of a pin: a triangle on hatched ground.
pub fn support(scene: &mut Scene, [x, y]: Place, bar: f64, pen: Pen) {
    let foot = y + 2.6 * bar;
    let corners = [[x, y], [x + 1.6 * bar, foot], [x - 1.6 * bar, foot]];
    let white = Ink::grey(255).faded(pen.ink.alpha);
    scene.area("support", corners, Some(white), Some(pen));
    let ends = [[x - 2.4 * bar, foot], [x + 2.4 * bar, foot]];
    hatched_line(scene, ends, bar, pen);
}

/// A line with short strokes on its right side, seen from the first place to the second.
pub fn hatched_line(scene: &mut Scene, ends: [Place; 2], bar: f64, pen: Pen) {
    let wide = Pen {
        width: 1.5 * pen.width,
        ..pen
    };
    scene.line("ground", ends, wide);
    let Some(line) = Line::between(ends) else {
        return;
    };
    let strokes = (line.length / (0.9 * bar)).floor().clamp(1.0, 200.0) as usize;
    let thin = Pen {
        width: 0.7 * pen.width,
        ..pen
    };
    for index in 0..strokes {
        let far = line.length * (index as f64 + 0.7) / strokes as f64;
        let stroke = [line.at(far, 0.0), line.at(far - 0.7 * bar, 0.7 * bar)];
        scene.line("hatch", stroke, thin);
    }
}

/// Both rails of a guide that stands still; `ends` are the outermost places of the block.
pub fn rails(scene: &mut Scene, [from, to]: [Place; 2], direction: [f64; 2], bar: f64, pen: Pen) {
    let [over, away] = [(BLOCK[0] + 0.8) * bar, BLOCK[1] * bar + 0.5 * pen.width];
    let [start, end] = [Line::from(from, direction), Line::from(to, direction)];
    let right = [start.at(-over, away), end.at(over, away)];
    // Backwards, so that its strokes are outside as well.
    let left = [end.at(over, -away), start.at(-over, -away)];
    for rail in [right, left] {
        hatched_line(scene, rail, bar, pen);
    }
}
