//! The part of a page that shows a mechanism.

use crate::scene::Place;

/// Half the width of a body, as a part of the width of the picture.
const BAR: f64 = 0.012;
/// Room around the mechanism, in bars.
const MARGIN: f64 = 6.5;
/// Height of a picture as a part of its width, at least and at most.
const PROPORTIONS: [f64; 2] = [0.3, 1.4];

/// Least and greatest x and y that are shown \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Least x and y.
    pub low: [f64; 2],
    /// Greatest x and y.
    pub high: [f64; 2],
}

impl Extent {
    /// Nothing yet.
    pub const EMPTY: Extent = Extent {
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };

    /// Takes a place in, with so much room around it.
    pub fn add(&mut self, place: [f64; 2], room: f64) {
        for (axis, value) in place.into_iter().enumerate() {
            self.low[axis] = self.low[axis].min(value - room);
            self.high[axis] = self.high[axis].max(value + room);
        }
    }

    /// Width and height \[m\].
    pub fn sizes(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.high[axis] - self.low[axis])
    }

    /// Height of a picture of that width, in which the mechanism fills its room.
    pub fn height(&self, width: f64) -> f64 {
        let margins = 2.0 * MARGIN * BAR * width;
        let [wide, high] = self.sizes();
        ((width - margins) * high / wide.max(1e-12) + margins)
            .clamp(PROPORTIONS[0] * width, PROPORTIONS[1] * width)
    }
}

/// Part of a page that shows the mechanism.
#[derive(Debug, Clone, Copy)]
pub struct View {
    /// Upper left and lower right corner of the part \[pt\].
    pub corners: [Place; 2],
    /// Where the least x and y lie.
    start: Place,
    origin: [f64; 2],
    /// Points per metre.
    pub scale: f64,
    /// Half the width of a body \[pt\].
    pub bar: f64,
}

impl View {
    /// The extent in the middle of a part of a page.
    pub fn new(extent: &Extent, [left, top]: Place, [width, height]: [f64; 2]) -> Self {
        let bar = BAR * width;
        let room = [width, height].map(|side| side - 2.0 * MARGIN * bar);
        let sizes = extent.sizes();
        let scales = [0, 1].map(|axis| room[axis] / sizes[axis].max(1e-12));
        let scale = scales[0].min(scales[1]);
        View {
            corners: [[left, top], [left + width, top + height]],
            start: [
                left + (width - sizes[0] * scale) / 2.0,
                top + (height + sizes[1] * scale) / 2.0,
            ],
            origin: extent.low,
            scale,
            bar,
        }
    }

    /// Where a place in global coordinates is on the page.
    pub fn place(&self, [x, y]: [f64; 2]) -> Place {
        [
            self.start[0] + (x - self.origin[0]) * self.scale,
            self.start[1] - (y - self.origin[1]) * self.scale,
        ]
    }

    /// Whether a place on the page lies in the part.
    pub fn shows(&self, [x, y]: Place) -> bool {
        let [[left, top], [right, bottom]] = self.corners;
        (left..=right).contains(&x) && (top..=bottom).contains(&y)
    }
}
