//! The teeth of a rack, where they mesh with those of its wheel.

use super::wheel::{DEPTH, FILL, RIM, Wheel};
use crate::scene::{Ink, Pen, Place, Scene};

/// Where a rack's tooth changes between tip (1) and root (−1), as parts of its pitch: a tip where the wheel has its root.
const TOOTH: [[f64; 2]; 4] = [[0.0, 1.0], [0.3, 1.0], [0.45, -1.0], [0.85, -1.0]];
/// Most teeth that are drawn.
const MOST: f64 = 500.0;

/// A rack on the page.
#[derive(Debug, Clone, Copy)]
pub struct Rack {
    /// Its wheel.
    pub wheel: Wheel,
    /// Direction of its line, length one.
    pub along: [f64; 2],
    /// Direction from its line to the wheel's centre, length one.
    pub towards: [f64; 2],
    /// How far it reaches from the pitch point, back and forth \[pt\].
    pub reach: [f64; 2],
}

impl Rack {
    /// A place by its distance along the line from the pitch point, and across it \[pt\].
    fn at(&self, along: f64, across: f64) -> Place {
        [0, 1].map(|k| {
            let base = self.wheel.centre[k] - self.wheel.radius * self.towards[k];
            base + along * self.along[k] + across * self.towards[k]
        })
    }

    /// The outline of its teeth.
    fn teeth(&self, bar: f64) -> Vec<Place> {
        let count = self.wheel.count(bar);
        let pitch = std::f64::consts::TAU * self.wheel.radius / count;
        // At the pitch point the wheel is at this part of its teeth, which go on along the rack or against it.
        let [x, y] = self.towards.map(|part| -part);
        let part = (y.atan2(x) + self.wheel.angle) * count / std::f64::consts::TAU;
        let side = (x * self.along[1] - y * self.along[0]).signum();
        let [back, forth] = self.reach.map(|far| far / pitch);
        let ends = [side * back, side * forth].map(|far| part + far);
        let first = ends[0].min(ends[1]).floor();
        let last = (ends[0].max(ends[1]).ceil()).min(first + MOST);
        let mut places = Vec::new();
        let mut tooth = first;
        while tooth < last {
            places.extend(TOOTH.map(|[of, out]| {
                let along = side * (tooth + of - part) * pitch;
                self.at(along, out * DEPTH * bar)
            }));
            tooth += 1.0;
        }
        places
    }
}

/// Draws the teeth with a rim behind them.
pub fn rack(scene: &mut Scene, rack: &Rack, bar: f64, (fill, pen): (Ink, Pen)) {
    let mut outline = rack.teeth(bar);
    let (Some(first), Some(last)) = (outline.first().copied(), outline.last().copied()) else {
        return;
    };
    let behind = |[x, y]: Place, out: f64| {
        let far = (out + RIM) * bar;
        [x - far * rack.towards[0], y - far * rack.towards[1]]
    };
    outline.extend([behind(last, -DEPTH), behind(first, DEPTH)]);
    scene.area("rack", outline, Some(fill.faded(FILL)), Some(pen));
}
