//! Ends of joints' ways: hatched stops across a guide, the round end of a slot, an arc between two hatched stops about a pin.

use super::parts::{Layer, Parts};
use crate::palette::STEEL;
use crate::shape::{Joint, PointId};
use crate::sign::{Corner, Edge, OUTLINE, Stroke, bars, line, metres};
use crate::symbols;
use linkdyn_model::OneWay;

/// Half the height of a stop of a slide, in bars.
const HIGH: f64 = 2.0;
/// Radii between which a peg lies, and of the arc, in bars.
const PEG: [f64; 2] = [2.4, 5.6];
const ARC: f64 = 3.8;
/// Angle between corners of the arc \[rad\].
const CORNER: f64 = 0.1;
/// Radius of the arrow about a pin with a one-way clutch, in bars, how far it goes round, and the length \[rad\] and half the
/// width, in bars, of its head.
const ROUND: f64 = 1.6;
const TURN: f64 = 4.5;
const HEAD: [f64; 2] = [0.5, 0.6];
/// An end this much of the stroke beyond it is drawn.
const NEAR: f64 = 0.5;

/// The ends of a joint's way that are near enough to its stroke to be drawn.
fn near(joint: &Joint, [low, high]: [f64; 2]) -> [Option<f64>; 2] {
    let far = NEAR * (high - low);
    let [lower, upper] = joint.limits.unwrap_or_default();
    [
        lower.filter(|end| (low - end).abs() <= far),
        upper.filter(|end| (end - high).abs() <= far),
    ]
}

/// How far a guide goes.
pub fn reach(joint: &Joint, slides: [f64; 2]) -> [f64; 2] {
    let ([lower, upper], [low, high]) = (near(joint, slides), slides);
    [
        lower.map_or(low, |end| low.min(end)),
        upper.map_or(high, |end| high.max(end)),
    ]
}

/// How far a slot goes: to its ends.
pub fn reach_of_slot(joint: &Joint, slides: [f64; 2]) -> [f64; 2] {
    let [lower, upper] = near(joint, slides);
    [lower.unwrap_or(slides[0]), upper.unwrap_or(slides[1])]
}

/// A corner around a pin; the angle counts to the left.
fn around(radius: f64, angle: f64) -> Corner {
    bars(radius * angle.cos(), radius * angle.sin())
}

/// Corners of an arc around a pin.
fn arc(radius: f64, from: f64, to: f64) -> Vec<Corner> {
    let corners = ((to - from).abs() / CORNER).ceil().max(1.0);
    let at = |k: usize| around(radius, from + (to - from) * k as f64 / corners);
    (0..=corners as usize).map(at).collect()
}

/// A block that a part runs against, hatched on the right side of its face.
fn stop(face: [Corner; 2]) -> Stroke {
    Stroke {
        class: "stop",
        ..symbols::hatched_line(face, f64::INFINITY, Edge::of(STEEL))
    }
}

impl Parts<'_> {
    /// Bars where the block of a slide comes to its ends.
    pub fn add_bars(&mut self, joint: &Joint, along: (usize, [f64; 2]), slides: [f64; 2]) {
        for (end, side) in near(joint, slides).into_iter().zip([-1.0, 1.0]) {
            let Some(end) = end else { continue };
            let at = metres(end, 0.0).beside(side * symbols::BLOCK[0], 0.0);
            // Hatched on the side to which the block does not come.
            let bar = [at.beside(0.0, -side * HIGH), at.beside(0.0, side * HIGH)];
            let sign = vec![stop(bar)];
            self.with(Layer::Stops, joint.between[0], along, along.0, sign);
        }
    }

    /// Pegs about a pin, between which the second body can turn.
    pub fn add_arc(&mut self, joint: &Joint) {
        let (Some(ends), Some(from)) = (joint.limits, self.direction_of(joint.between[1])) else {
            return;
        };
        let [low, high] = ends.map(|end| end.map(|end| PEG.map(|radius| around(radius, end))));
        // Hatched outside of the travel.
        let high = high.map(|[inner, outer]| [outer, inner]);
        let mut sign: Vec<_> = low.into_iter().chain(high).map(stop).collect();
        if let [Some(low), Some(high)] = ends {
            let high = high.min(low + std::f64::consts::TAU);
            sign.push(line(
                "stop",
                arc(ARC, low, high),
                Edge::of(STEEL).wide(0.5 * OUTLINE),
            ));
        }
        let first = joint.between[0];
        self.with(
            Layer::Stops,
            first,
            (first.0, [from.cos(), from.sin()]),
            first.0,
            sign,
        );
    }

    /// An arrow about a pin, the way in which its one-way clutch lets the second body turn.
    pub fn add_one_way(&mut self, joint: &Joint) {
        let sign = match joint.one_way {
            None => return,
            Some(OneWay::Forward) => 1.0,
            Some(OneWay::Backward) => -1.0,
        };
        let edge = Edge::of(STEEL).wide(0.5 * OUTLINE);
        let [back, tip, front] = [(HEAD[0], -HEAD[1]), (0.0, 0.0), (HEAD[0], HEAD[1])]
            .map(|(before, out)| around(ROUND + out, sign * (TURN - before)));
        let strokes = vec![
            line("clutch", arc(ROUND, 0.0, sign * TURN), edge),
            line("clutch", [back, tip, front], edge),
        ];
        self.on(Layer::Stops, joint.between[0], joint.between[0].0, strokes);
    }

    /// Where the body of a pin lies, in its own frame \[rad\].
    fn direction_of(&self, (body, number): PointId) -> Option<f64> {
        let points = &self.mechanism.shape.bodies.get(body)?.points;
        let (_, x, y) = points.get(number)?;
        let [u, v] = points
            .iter()
            .fold([0.0; 2], |[u, v], (_, a, b)| [u + a - x, v + b - y]);
        Some(if [u, v] == [0.0; 2] { 0.0 } else { v.atan2(u) })
    }
}
