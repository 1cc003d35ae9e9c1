//! Signs: what is drawn of a part of a mechanism, in axes of its own, x along and y to the left.
//!
//! A corner lies so far along the sign, so many metres and so many bars from where the sign begins. A bar is half the width of a drawn
//! body: lengths in bars keep their size on the page, lengths in metres grow with the scale. With the origin o of the sign,
//! its direction u and its length ℓ on the page, the scale s and the size b of a bar, a corner is at
//!
//! ```text
//! o + x u + y u⊥,   (x, y) = along (ℓ, 0) + s metres + b bars
//! ```
//!
//! | file   | does                                                             |
//! | ------ | ---------------------------------------------------------------- |
//! | `seat` | draws signs in figures; pages do the same in `page/js/drawing.js` |
//! | `json` | signs for pages                                                  |

mod json;
mod seat;

pub use json::short;
pub use seat::Seat;

use crate::palette::Tone;

/// Width of outlines, in bars.
pub const OUTLINE: f64 = 0.2;
/// How much a body covers of what lies behind it.
const COVER: f64 = 0.9;

/// Where a corner of a sign lies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Corner {
    /// As a part of the length of the sign.
    pub along: f64,
    /// Along and to the left \[m\].
    pub metres: [f64; 2],
    /// Along and to the left, in bars.
    pub bars: [f64; 2],
}

/// A corner so many bars from the origin.
pub fn bars(x: f64, y: f64) -> Corner {
    Corner {
        bars: [x, y],
        ..Corner::default()
    }
}

/// A corner so far from the origin \[m\].
pub fn metres(x: f64, y: f64) -> Corner {
    Corner {
        metres: [x, y],
        ..Corner::default()
    }
}

/// A corner at a part of the length of the sign.
pub fn along(part: f64) -> Corner {
    Corner {
        along: part,
        ..Corner::default()
    }
}

impl Corner {
    /// The corner so many bars from this one.
    pub fn beside(self, x: f64, y: f64) -> Self {
        Corner {
            bars: [self.bars[0] + x, self.bars[1] + y],
            ..self
        }
    }

    /// The corner so far from this one \[m\].
    pub fn beyond(self, x: f64, y: f64) -> Self {
        Corner {
            metres: [self.metres[0] + x, self.metres[1] + y],
            ..self
        }
    }
}

/// A colour of a sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Colour {
    /// A colour of all pictures.
    Of(Tone),
    /// The fill of the body to which the sign belongs.
    Fill,
    /// The outline of that body.
    Edge,
}

/// A colour and how much it covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint {
    /// The colour.
    pub colour: Colour,
    /// How much it covers, 0 … 1.
    pub alpha: f64,
}

impl Paint {
    /// A covering colour.
    pub const fn of(tone: Tone) -> Self {
        Paint {
            colour: Colour::Of(tone),
            alpha: 1.0,
        }
    }

    /// The fill of a body.
    pub const FILL: Paint = Paint {
        colour: Colour::Fill,
        alpha: COVER,
    };

    /// The same, covering less.
    pub fn faded(self, factor: f64) -> Self {
        Paint {
            alpha: self.alpha * factor,
            ..self
        }
    }
}

/// How an edge is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Its colour.
    pub paint: Paint,
    /// Its width, in bars.
    pub width: f64,
    /// Lengths of dashes and gaps in turn, in widths of the line; empty: solid.
    pub dash: &'static [f64],
}

impl Edge {
    /// An outline in a colour.
    pub const fn of(tone: Tone) -> Self {
        Edge {
            paint: Paint::of(tone),
            ..Edge::BODY
        }
    }

    /// The outline of a body.
    pub const BODY: Edge = Edge {
        paint: Paint {
            colour: Colour::Edge,
            alpha: 1.0,
        },
        width: OUTLINE,
        dash: &[],
    };

    /// The same, of another width in bars.
    pub const fn wide(self, width: f64) -> Self {
        Edge { width, ..self }
    }
}

/// What a stroke goes along.
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// Straight from corner to corner.
    Line(Vec<Corner>),
    /// What corners enclose.
    Area(Vec<Corner>),
    /// A circle with its radius in metres or in bars, whichever is larger on the page.
    Circle(Corner, [f64; 2]),
    /// Ground: a line with so many short strokes on its right side.
    Ground([Corner; 2], usize),
    /// What lies within so many bars of the convex hull of corners.
    Hull(Vec<Corner>, f64),
    /// The hull of the points of the body, in the same way.
    Body(f64),
    /// A line that winds up with the angle between two bodies: least and greatest radius in bars.
    Coil([f64; 2], [usize; 2]),
}

/// A line, an area or a circle of a sign.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// What it is, to whoever edits or tests the SVG.
    pub class: &'static str,
    /// Where it is.
    pub outline: Outline,
    /// What it is filled with.
    pub fill: Option<Paint>,
    /// How its edge is drawn.
    pub edge: Option<Edge>,
}

/// A sign: its strokes, from below to above.
pub type Sign = Vec<Stroke>;

/// A line through corners.
pub fn line(class: &'static str, corners: impl Into<Vec<Corner>>, edge: Edge) -> Stroke {
    Stroke {
        class,
        outline: Outline::Line(corners.into()),
        fill: None,
        edge: Some(edge),
    }
}

/// A closed area.
pub fn area(
    class: &'static str,
    corners: impl Into<Vec<Corner>>,
    fill: impl Into<Option<Paint>>,
    edge: impl Into<Option<Edge>>,
) -> Stroke {
    Stroke {
        class,
        outline: Outline::Area(corners.into()),
        fill: fill.into(),
        edge: edge.into(),
    }
}

/// A circle.
pub fn circle(
    class: &'static str,
    centre: Corner,
    radius: [f64; 2],
    fill: impl Into<Option<Paint>>,
    edge: impl Into<Option<Edge>>,
) -> Stroke {
    Stroke {
        class,
        outline: Outline::Circle(centre, radius),
        fill: fill.into(),
        edge: edge.into(),
    }
}
