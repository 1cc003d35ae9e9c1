//! A sign on the page of a figure.

use super::{Colour, Corner, Edge, Outline, Paint, Stroke, bars};
use crate::palette;
use crate::scene::{Ink, Pen, Place, Scene};
use crate::symbols::{ribbon, rounded_hull};

/// Corners of a coil.
const PIECES: usize = 60;

/// Where a sign is on the page, and in which colours.
#[derive(Debug, Clone, Copy)]
pub struct Seat {
    /// Where it begins.
    pub origin: Place,
    /// Its direction on the page, length one.
    pub along: [f64; 2],
    /// Its length \[pt\].
    pub length: f64,
    /// Points per metre.
    pub scale: f64,
    /// Points per bar, of places and of widths of lines.
    pub bar: [f64; 2],
    /// Whose colours it has.
    pub body: usize,
    /// How much of the colours is left, 0 … 1.
    pub strength: f64,
}

impl Seat {
    /// A corner in the axes of the sign, y to the right as on a page \[pt\].
    fn local(&self, corner: &Corner) -> Place {
        let [x, y] = corner.metres.map(|part| part * self.scale);
        let [beside, left] = corner.bars.map(|part| part * self.bar[0]);
        // What counts from the end does not go back behind the beginning: a rod that is longer than its cylinder.
        let x = match corner.along > 0.0 {
            true => (corner.along * self.length + x).max(0.0),
            false => x,
        };
        [x + beside, -y - left]
    }

    fn turned(&self, [x, y]: Place) -> Place {
        let [u, v] = self.along;
        [
            self.origin[0] + x * u - y * v,
            self.origin[1] + x * v + y * u,
        ]
    }

    fn place(&self, corner: &Corner) -> Place {
        self.turned(self.local(corner))
    }

    fn ink(&self, paint: Paint) -> Ink {
        let tone = match paint.colour {
            Colour::Of(tone) => tone,
            Colour::Fill => palette::body(self.body).fill,
            Colour::Edge => palette::body(self.body).line,
        };
        Ink::new(tone.light).faded(paint.alpha).faded(self.strength)
    }

    fn pen(&self, edge: Edge) -> Pen {
        Pen {
            ink: self.ink(edge.paint),
            width: edge.width * self.bar[1],
            dash: edge.dash,
        }
    }

    /// Draws a stroke; `points` are those of the body, in the axes of the sign, and `angles` those of all bodies.
    pub fn draw(
        &self,
        scene: &mut Scene,
        stroke: &Stroke,
        points: impl Iterator<Item = Corner>,
        angles: impl Fn(usize) -> f64,
    ) {
        let (class, fill) = (stroke.class, stroke.fill.map(|paint| self.ink(paint)));
        let pen = stroke.edge.map(|edge| self.pen(edge));
        let hull = |corners: Vec<Place>, radius: f64| -> Vec<Place> {
            let outline = rounded_hull(&corners, radius * self.bar[0]);
            outline
                .into_iter()
                .map(|place| self.turned(place))
                .collect()
        };
        let places = |corners: &[Corner]| -> Vec<Place> {
            corners.iter().map(|corner| self.place(corner)).collect()
        };
        match &stroke.outline {
            Outline::Line(corners) => {
                if let Some(pen) = pen {
                    scene.line(class, places(corners), pen);
                }
            }
            Outline::Area(corners) => scene.area(class, places(corners), fill, pen),
            Outline::Circle(centre, [metres, bars]) => {
                let radius = (metres * self.scale).max(bars * self.bar[0]);
                scene.circle(class, self.place(centre), radius, fill, pen);
            }
            Outline::Ground(ends, strokes) => {
                if let Some(pen) = pen {
                    self.draw_ground(scene, ends.map(|end| self.place(&end)), *strokes, pen);
                }
            }
            Outline::Hull(corners, radius) => {
                let corners = corners.iter().map(|corner| self.local(corner));
                scene.area(class, hull(corners.collect(), *radius), fill, pen);
            }
            Outline::Body(radius) => {
                let corners = points.map(|corner| self.local(&corner));
                scene.area(class, hull(corners.collect(), *radius), fill, pen);
            }
            Outline::Coil(radii, bodies) => {
                let corners = coil(*radii, bodies.map(angles));
                if let Some(pen) = pen {
                    scene.line(class, places(&corners), pen);
                }
            }
        }
    }
}

impl Seat {
    /// Draws the stroke that is a body about an axis which bends; whether it is one, and there is an axis.
    pub fn draw_bent(&self, scene: &mut Scene, stroke: &Stroke, axis: &[Place]) -> bool {
        let Outline::Body(radius) = stroke.outline else {
            return false;
        };
        if axis.len() > 1 {
            let fill = stroke.fill.map(|paint| self.ink(paint));
            let pen = stroke.edge.map(|edge| self.pen(edge));
            let outline = ribbon(axis, radius * self.bar[0]);
            scene.area(stroke.class, outline, fill, pen);
        }
        axis.len() > 1
    }

    fn draw_ground(&self, scene: &mut Scene, [from, to]: [Place; 2], strokes: usize, pen: Pen) {
        let wide = |factor: f64| Pen {
            width: factor * pen.width,
            ..pen
        };
        scene.line("ground", [from, to], wide(1.5));
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let length = x.hypot(y);
        if length < 1e-9 {
            return;
        }
        let [u, v] = [x, y].map(|part| 0.7 * self.bar[0] * part / length);
        for index in 0..strokes {
            let part = (index as f64 + 0.7) / strokes as f64;
            let [x, y] = [from[0] + part * x, from[1] + part * y];
            scene.line("hatch", [[x, y], [x - u - v, y - v + u]], wide(0.7));
        }
    }
}

/// A coil of two turns and the angle between two bodies.
fn coil([low, high]: [f64; 2], [from, to]: [f64; 2]) -> Vec<Corner> {
    let turn = to - from;
    let sweep = 2.0 * std::f64::consts::TAU + turn.sin().atan2(turn.cos());
    let corner = |piece: usize| {
        let part = piece as f64 / PIECES as f64;
        let (radius, angle) = (low + part * (high - low), from + sweep * part);
        bars(radius * angle.cos(), radius * angle.sin())
    };
    (0..=PIECES).map(corner).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{OUTLINE, along, metres};
    use super::*;

    const SEAT: Seat = Seat {
        origin: [100.0, 50.0],
        along: [0.0, -1.0],
        length: 30.0,
        scale: 1000.0,
        bar: [5.0, 4.0],
        body: 1,
        strength: 0.5,
    };

    #[test]
    fn corners_go_with_length_scale_and_bars() {
        // Upwards on the page; its left is the page's left.
        for (corner, place) in [
            (along(1.0), [100.0, 20.0]),
            (metres(0.01, 0.02), [80.0, 40.0]),
            (bars(1.0, 2.0), [90.0, 45.0]),
            (
                along(0.5).beyond(0.001, 0.0).beside(0.0, -1.0),
                [105.0, 34.0],
            ),
        ] {
            let found = SEAT.place(&corner);
            assert!(
                (0..2).all(|k| (found[k] - place[k]).abs() < 1e-12),
                "{corner:?}: {found:?}"
            );
        }
        assert_eq!(SEAT.pen(Edge::BODY).width, OUTLINE * 4.0);
        assert_eq!(SEAT.ink(Paint::FILL).alpha, 0.45);
    }
}
