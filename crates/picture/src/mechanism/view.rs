//! The part of a page that shows a mechanism.

use crate::scene::{Place, Scene};

/// Half the width of a body, as a part of the width of the picture.
const BAR: f64 = 0.012;
/// Room for signs before it is known how far they reach, in bars: the longest arrow has it.
const WIDE: f64 = 14.0;
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
}

/// Room around the mechanism for supports, blocks and arrows, in bars: left, top, right, bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margins(pub [f64; 4]);

impl Margins {
    /// Enough for every sign.
    pub const WIDE: Margins = Margins([WIDE; 4]);

    /// Of both sides together, and above and below together, where half a body is `bar` wide \[pt\].
    fn both(&self, bar: f64) -> [f64; 2] {
        let [left, top, right, bottom] = self.0;
        [(left + right) * bar, (top + bottom) * bar]
    }
}

/// What all pictures of a mechanism show: its extent, and room around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Where its points go.
    pub extent: Extent,
    /// Room for signs.
    pub margins: Margins,
}

impl Frame {
    /// Height of a picture of that width, in which the mechanism fills its room.
    pub fn height(&self, width: f64) -> f64 {
        let [beside, above] = self.margins.both(BAR * width);
        let [wide, high] = self.extent.sizes();
        ((width - beside) * high / wide.max(1e-12) + above)
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
    /// The frame in the middle of a part of a page.
    pub fn new(frame: &Frame, [left, top]: Place, [width, height]: [f64; 2]) -> Self {
        let bar = BAR * width;
        let margins = frame.margins.both(bar);
        let room = [width - margins[0], height - margins[1]];
        let sizes = frame.extent.sizes();
        let scales = [0, 1].map(|axis| room[axis] / sizes[axis].max(1e-12));
        let scale = scales[0].min(scales[1]);
        let spare = [0, 1].map(|axis| (room[axis] - sizes[axis] * scale) / 2.0);
        let [beside, above, ..] = frame.margins.0.map(|margin| margin * bar);
        View {
            corners: [[left, top], [left + width, top + height]],
            start: [
                left + beside + spare[0],
                top + above + spare[1] + sizes[1] * scale,
            ],
            origin: frame.extent.low,
            scale,
            bar,
        }
    }

    /// How far the items of a scene reach beyond the places of an extent, in bars: left, top, right, bottom.
    pub fn overhang(&self, extent: &Extent, scene: &Scene) -> [f64; 4] {
        let [left, bottom] = self.place(extent.low);
        let [right, top] = self.place(extent.high);
        let [low, high] = scene.bounds();
        [
            left - low[0],
            top - low[1],
            high[0] - right,
            high[1] - bottom,
        ]
        .map(|far| far / self.bar)
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
