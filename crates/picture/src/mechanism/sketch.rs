//! What all drawing of one pose needs.

use super::moving::Mechanism;
use super::places::{place, turned};
use super::view::View;
use crate::palette::{self, Tone};
use crate::poses::Pose;
use crate::scene::{Ink, Pen, Place};
use crate::shape::{Joint, PointId};
use crate::symbols;

/// Width of outlines, in bars.
const OUTLINE: f64 = 0.2;
/// How much a body covers of what lies behind it.
const COVER: f64 = 0.9;

/// One pose on its way to the page.
pub struct Sketch<'a> {
    /// What is drawn.
    pub mechanism: &'a Mechanism,
    /// Where on the page.
    pub view: &'a View,
    /// Poses of all bodies, ground first.
    pub pose: &'a [Pose],
    /// How much of the colours is left, 0 … 1.
    pub strength: f64,
}

impl Sketch<'_> {
    /// Where a point is on the page.
    pub fn at(&self, point: PointId) -> Place {
        self.view
            .place(place(&self.mechanism.shape, self.pose, point))
    }

    /// The first point of a body on the page, or its origin.
    pub fn body_at(&self, body: usize) -> Place {
        if self.mechanism.shape.point((body, 0)).is_some() {
            return self.at((body, 0));
        }
        let [x, y, _] = self.pose[body];
        self.view.place([x, y])
    }

    /// The outline of a body. It is found in the body's own frame, so that it has the same corners in every pose.
    pub fn outline(&self, body: usize) -> Vec<Place> {
        let [x, y, angle] = self.pose[body];
        let [left, top] = self.view.place([x, y]);
        let (sin, cos) = angle.sin_cos();
        let scale = self.view.scale;
        let points = self.mechanism.shape.bodies[body].points.iter();
        let corners: Vec<Place> = points.map(|(_, u, v)| [scale * u, -scale * v]).collect();
        let outline = symbols::rounded_hull(&corners, self.bar());
        let on_page = |[u, v]: Place| [left + cos * u + sin * v, top - sin * u + cos * v];
        outline.into_iter().map(on_page).collect()
    }

    /// Direction of a guide on the page, length one.
    pub fn direction(&self, joint: &Joint) -> Option<[f64; 2]> {
        let [x, y] = turned(self.pose[joint.between[0].0], joint.axis()?);
        Some([x, -y])
    }

    /// Half the width of a body \[pt\].
    pub fn bar(&self) -> f64 {
        self.view.bar
    }

    /// A colour as this pose has it.
    pub fn ink(&self, tone: Tone) -> Ink {
        Ink::new(tone.light).faded(self.strength)
    }

    /// An outline in a colour.
    pub fn pen(&self, tone: Tone) -> Pen {
        Pen::new(self.ink(tone), OUTLINE * self.bar())
    }

    /// Fill and outline of a body.
    pub fn of_body(&self, number: usize) -> (Ink, Pen) {
        let colours = palette::body(number);
        (self.ink(colours.fill).faded(COVER), self.pen(colours.line))
    }
}
