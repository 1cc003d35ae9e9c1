//! Places along and across a line from one place to another; what is drawn along a line.

use crate::scene::{Ink, Pen, Place, Scene};

/// A line and its direction on the page.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    start: Place,
    /// Unit vector from the start to the end.
    pub along: [f64; 2],
    /// Distance of start and end \[pt\].
    pub length: f64,
}

impl Line {
    /// From one place to another; none where both are the same.
    pub fn between([start, end]: [Place; 2]) -> Option<Self> {
        let [dx, dy] = [end[0] - start[0], end[1] - start[1]];
        let length = dx.hypot(dy);
        (length > 1e-9).then(|| Line {
            start,
            along: [dx / length, dy / length],
            length,
        })
    }

    /// From a place in a direction of length one.
    pub fn from(start: Place, along: [f64; 2]) -> Self {
        Line {
            start,
            along,
            length: 0.0,
        }
    }

    /// The place so far along from the start, and so far to the right \[pt\].
    pub fn at(&self, far: f64, right: f64) -> Place {
        let [u, v] = self.along;
        [
            self.start[0] + far * u - right * v,
            self.start[1] + far * v + right * u,
        ]
    }
}

/// Half length and half height of a block, in bars.
pub const BLOCK: [f64; 2] = [2.4, 1.4];

/// A block on a guide along `direction`.
pub fn block(
    scene: &mut Scene,
    centre: Place,
    direction: [f64; 2],
    bar: f64,
    (fill, pen): (Ink, Pen),
) {
    let line = Line::from(centre, direction);
    let [far, high] = BLOCK.map(|size| size * bar);
    let corners = [[-far, -high], [far, -high], [far, high], [-far, high]];
    let corners = corners.map(|[along, across]| line.at(along, across));
    scene.area("block", corners, Some(fill), Some(pen));
}

/// Half widths of a slot, outside and inside, in bars.
const SLOT: [f64; 2] = [1.8, 1.05];

/// A slot between the outermost places of its pin: a body with a groove.
pub fn slot(scene: &mut Scene, ends: [Place; 2], bar: f64, (fill, pen): (Ink, Pen)) {
    let white = Ink::grey(255).faded(pen.ink.alpha);
    for (half, ink) in [(SLOT[0], fill), (SLOT[1], white)] {
        let outline = super::hull::rounded_hull(&ends, half * bar);
        scene.area("slot", outline, Some(ink), Some(pen));
    }
    // The way of the pin itself, for whoever edits the figure.
    let thin = Pen::new(pen.ink.faded(0.4), 0.5 * pen.width);
    scene.line("guide", ends, thin);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_of_a_line_to_the_right_is_below() {
        let line = Line::between([[1.0, 2.0], [4.0, 2.0]]).expect("a line");
        assert_eq!((line.length, line.at(1.0, 0.5)), (3.0, [2.0, 2.5]));
        assert!(Line::between([[1.0, 2.0]; 2]).is_none());
    }
}
