//! Numbers at arrows.

use super::view::View;
use crate::font;
use crate::scene::{Anchor, Ink, Item, Place, Run, Scene};

/// Size of the letters, as a part of those below the picture.
const SIZE: f64 = 0.85;
/// Between an arrow and its number, and around a number, as parts of its size.
const AWAY: f64 = 0.35;
const AROUND: f64 = 0.15;
/// Lines that a number moves, at most, to keep clear of others.
const MOST_LINES: usize = 6;

/// Numbers of one pose, which do not cover each other.
pub struct Values<'v> {
    view: &'v View,
    ink: Ink,
    size: f64,
    /// Middles and half sizes of what is written.
    taken: Vec<[Place; 2]>,
}

impl<'v> Values<'v> {
    /// None yet.
    pub fn new(view: &'v View, ink: Ink) -> Self {
        let [[left, _], [right, _]] = view.corners;
        Values {
            view,
            ink,
            size: SIZE * font_size(right - left),
            taken: Vec::new(),
        }
    }

    /// Writes beyond the end of an arrow, in a direction of length one, inside the view.
    pub fn write(&mut self, scene: &mut Scene, end: Place, away: [f64; 2], text: &str) {
        let size = self.size;
        let half = [font::width(text, size) / 2.0, font::CAPITALS * size / 2.0];
        let half = half.map(|half| half + AROUND * size);
        // As far as the box reaches in that direction.
        let far = half[0] * away[0].abs() + half[1] * away[1].abs() + AWAY * size;
        let [low, high] = self.view.corners;
        let inside = |at: Place| -> Place {
            [0, 1].map(|k| at[k].min(high[k] - half[k]).max(low[k] + half[k]))
        };
        let mut at = inside([end[0] + far * away[0], end[1] + far * away[1]]);
        let step = if away[1] > 0.0 { half[1] } else { -half[1] };
        for _ in 0..MOST_LINES {
            let is_free = self
                .taken
                .iter()
                .all(|[other, wide]| (0..2).any(|k| (at[k] - other[k]).abs() >= half[k] + wide[k]));
            if is_free {
                break;
            }
            at = inside([at[0], at[1] + step]);
        }
        self.taken.push([at, half]);
        let [[left, top], [right, bottom]] =
            [-1.0, 1.0].map(|side| [0, 1].map(|k| at[k] + side * half[k]));
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
        scene.area("halo", corners, Some(Ink::grey(255).faded(0.7)), None);
        scene.items.push(Item::Label {
            class: "load-value",
            at: [at[0], at[1] + font::CAPITALS * size / 2.0],
            runs: vec![Run::plain(text)],
            size,
            anchor: Anchor::Middle,
            turned: false,
            ink: self.ink,
        });
    }
}

/// Size of letters for a picture of that width \[pt\].
pub fn font_size(width: f64) -> f64 {
    (0.032 * width).clamp(7.0, 14.0)
}
