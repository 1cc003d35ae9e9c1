//! The teeth of a rack, where they mesh with those of its wheel.

use super::wheel::{DEPTH, FILL, RIM, teeth_count};
use crate::sign::{Corner, Edge, Paint, Sign, area, metres};

/// Where a rack's tooth changes between tip (1) and root (−1), as parts of its pitch: a tip where the wheel has its root.
const TOOTH: [[f64; 2]; 4] = [[0.0, 1.0], [0.3, 1.0], [0.45, -1.0], [0.85, -1.0]];
/// Most teeth that are drawn.
const MOST: f64 = 500.0;

/// A rack in axes along its line.
#[derive(Debug, Clone, Copy)]
pub struct Rack {
    /// Where the wheel touches the line \[m\].
    pub pitch_point: [f64; 2],
    /// Radius of the wheel \[m\]; negative where the line lies to the left of its centre.
    pub radius: f64,
    /// How far the wheel has turned to the left from the direction of the line \[rad\].
    pub angle: f64,
    /// How far the teeth reach from the pitch point, back and forth \[m\].
    pub reach: [f64; 2],
}

impl Rack {
    /// The teeth with a rim behind them; a bar is so many metres long.
    pub fn sign(&self, bar: f64) -> Sign {
        let (count, side) = (teeth_count(self.radius.abs(), bar), self.radius.signum());
        let pitch = std::f64::consts::TAU * self.radius.abs() / count;
        let at = |along: f64, across: f64| -> Corner {
            let [x, y] = self.pitch_point;
            metres(x + along, y + side * across)
        };
        // At the pitch point the wheel is at this part of its teeth, which go on along the rack or against it.
        let down = side * std::f64::consts::FRAC_PI_2;
        let part = (down + self.angle) * count / std::f64::consts::TAU;
        let ends = self.reach.map(|far| part - side * far / pitch);
        let first = ends[0].min(ends[1]).floor();
        let last = (ends[0].max(ends[1]).ceil()).min(first + MOST);
        let (mut corners, mut tooth) = (Vec::new(), first);
        while tooth < last {
            corners.extend(
                TOOTH.map(|[of, out]| at(-side * (tooth + of - part) * pitch, out * DEPTH * bar)),
            );
            tooth += 1.0;
        }
        let (Some(start), Some(end)) = (corners.first().copied(), corners.last().copied()) else {
            return Sign::new();
        };
        let behind = |corner: Corner, out: f64| corner.beyond(0.0, -side * (out + RIM) * bar);
        corners.extend([behind(end, -DEPTH), behind(start, DEPTH)]);
        vec![area("rack", corners, Paint::FILL.faded(FILL), Edge::BODY)]
    }
}
