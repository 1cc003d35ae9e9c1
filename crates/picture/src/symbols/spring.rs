//! Springs and dampers, straight ones and those around a pin.

use super::line::Line;
use crate::scene::{Pen, Place, Scene};

/// Strokes of a straight spring.
const STROKES: usize = 14;
/// Half the width of a straight spring or damper, in bars.
const WIDTH: f64 = 1.2;
/// How far a spring and the damper beside it lie from the line between their ends, in bars.
const ASIDE: f64 = 1.6;
/// Turns of a coil, and its least and greatest radius, in bars.
const TURNS: f64 = 2.0;
const COIL: [f64; 2] = [1.1, 2.1];
/// How far its legs reach from the pin, in bars.
const LEGS: f64 = 3.4;
/// Pieces of a bent line.
const PIECES: usize = 60;

/// A spring.
pub fn spring(scene: &mut Scene, ends: [Place; 2], bar: f64, pen: Pen) {
    let Some(line) = Line::between(ends) else {
        return;
    };
    let [low, high] = coils(&line);
    let places = [line.at(0.0, 0.0), line.at(low, 0.0)];
    let places = places.into_iter().chain(strokes(&line, 0.0, bar));
    let places = places.chain([line.at(high, 0.0), ends[1]]);
    scene.line("spring", places.collect::<Vec<_>>(), pen);
}

/// A spring and a damper side by side, between two bars.
pub fn damped_spring(scene: &mut Scene, ends: [Place; 2], bar: f64, pen: Pen) {
    let Some(line) = Line::between(ends) else {
        return;
    };
    let [low, high] = coils(&line);
    let (spring, damper) = (-ASIDE * bar, ASIDE * bar);
    let places = [line.at(low, spring)].into_iter();
    let places = places.chain(strokes(&line, spring, bar));
    let places = places.chain([line.at(high, spring)]);
    scene.line("spring", places.collect::<Vec<_>>(), pen);
    draw_dashpot(scene, &line, ([low, high], damper), bar, pen);
    for (end, at) in ends.into_iter().zip([low, high]) {
        scene.line("spring", [end, line.at(at, 0.0)], pen);
        scene.line("spring", [line.at(at, spring), line.at(at, damper)], pen);
    }
}

/// Where the strokes of a spring begin and end along a line \[pt\].
fn coils(line: &Line) -> [f64; 2] {
    [0.15 * line.length, 0.85 * line.length]
}

/// Corners of the strokes of a spring so far to the right of a line \[pt\].
fn strokes(line: &Line, right: f64, bar: f64) -> impl Iterator<Item = Place> {
    let [low, high] = coils(line);
    let step = (high - low) / STROKES as f64;
    (0..STROKES).map(move |index| {
        let side = if index % 2 == 0 { WIDTH } else { -WIDTH };
        line.at(low + (index as f64 + 0.5) * step, right + side * bar)
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
pub fn dashpot(scene: &mut Scene, ends: [Place; 2], bar: f64, pen: Pen) {
    if let Some(line) = Line::between(ends) {
        draw_dashpot(scene, &line, ([0.0, line.length], 0.0), bar, pen);
    }
}

/// A damper from one place along a line to another, so far to the right of it \[pt\].
fn draw_dashpot(
    scene: &mut Scene,
    line: &Line,
    ([from, to], right): ([f64; 2], f64),
    bar: f64,
    pen: Pen,
) {
    for stroke in DASHPOT {
        let places = stroke
            .iter()
            .map(|[s, d]| line.at(from + s * (to - from), right + d * WIDTH * bar));
        scene.line("damper", places.collect::<Vec<_>>(), pen);
    }
}

/// A place around a pin; the angle counts to the left.
fn around([x, y]: Place, radius: f64, angle: f64) -> Place {
    [x + radius * angle.cos(), y - radius * angle.sin()]
}

/// A coil around a pin, which winds up with the angle between both bodies \[rad\], with a leg along each of them.
pub fn coil(scene: &mut Scene, centre: Place, [from, to]: [f64; 2], bar: f64, pen: Pen) {
    let turn = to - from;
    let sweep = TURNS * std::f64::consts::TAU + turn.sin().atan2(turn.cos());
    let place = |piece: usize| {
        let part = piece as f64 / PIECES as f64;
        let radius = COIL[0] + part * (COIL[1] - COIL[0]);
        around(centre, radius * bar, from + sweep * part)
    };
    scene.line("coil", (0..=PIECES).map(place).collect::<Vec<_>>(), pen);
    for (radius, angle) in COIL.into_iter().zip([from, from + sweep]) {
        let leg = [radius, LEGS].map(|radius| around(centre, radius * bar, angle));
        scene.line("leg", leg, pen);
    }
}

/// A damper bent around a pin, from the angle of one body on \[rad\].
pub fn round_dashpot(scene: &mut Scene, centre: Place, from: f64, bar: f64, pen: Pen) {
    let [low, high] = COIL;
    let bent = |[s, d]: [f64; 2]| {
        let radius = (low + high) / 2.0 + d * (high - low) / 2.0;
        around(centre, radius * bar, from + s * 0.8 * std::f64::consts::TAU)
    };
    for stroke in DASHPOT {
        let mut places = vec![bent(stroke[0])];
        for pair in stroke.windows(2) {
            let part = |k: usize| {
                let part = k as f64 / 16.0;
                [0, 1].map(|i| pair[0][i] + part * (pair[1][i] - pair[0][i]))
            };
            places.extend((1..=16).map(|k| bent(part(k))));
        }
        scene.line("damper", places, pen);
    }
}
