//! Toothed wheels.

use crate::scene::{Ink, Pen, Place, Scene};

/// Length of a tooth with its gap along the pitch circle, half its depth, and the rim of an internal wheel, in bars.
const PITCH: f64 = 2.0;
pub(super) const DEPTH: f64 = 0.42;
pub(super) const RIM: f64 = 1.5;
/// Least and greatest number of teeth: they are a sign, not those of the wheel.
const TEETH: [f64; 2] = [8.0, 240.0];
/// Where a tooth changes between root (−1) and tip (1), as parts of its pitch.
const TOOTH: [[f64; 2]; 4] = [[0.0, -1.0], [0.3, -1.0], [0.45, 1.0], [0.85, 1.0]];
/// How much of the fill a wheel has: what lies behind shows through.
pub(super) const FILL: f64 = 0.45;

/// A wheel with its pitch circle on the page.
#[derive(Debug, Clone, Copy)]
pub struct Wheel {
    /// Where it turns.
    pub centre: Place,
    /// Radius of the pitch circle \[pt\].
    pub radius: f64,
    /// How far it has turned to the left \[rad\].
    pub angle: f64,
    /// Teeth inside of a ring.
    pub internal: bool,
}

impl Wheel {
    fn at(&self, radius: f64, angle: f64) -> Place {
        let turned = angle - self.angle;
        [
            self.centre[0] + radius * turned.cos(),
            self.centre[1] + radius * turned.sin(),
        ]
    }

    /// Draws two spokes of that length \[pt\].
    pub(super) fn spokes(&self, scene: &mut Scene, reach: f64, pen: Pen) {
        let dashed = Pen {
            dash: &[3.0, 2.0],
            ink: pen.ink.faded(0.6),
            ..pen
        };
        for quarter in [0.0, std::f64::consts::FRAC_PI_2] {
            let ends = [reach, -reach].map(|radius| self.at(radius, quarter));
            scene.line("spoke", ends, dashed);
        }
    }

    /// Number of its teeth.
    pub(super) fn count(&self, bar: f64) -> f64 {
        (std::f64::consts::TAU * self.radius / (PITCH * bar))
            .round()
            .clamp(TEETH[0], TEETH[1])
    }

    fn teeth(&self, bar: f64) -> Vec<Place> {
        let around = std::f64::consts::TAU;
        let count = self.count(bar);
        let tooth = |k: usize| {
            TOOTH.map(|[part, out]| {
                let angle = around * (k as f64 + part) / count;
                self.at(self.radius + out * DEPTH * bar, angle)
            })
        };
        (0..count as usize).flat_map(tooth).collect()
    }
}

/// Draws a wheel with a sign that shows how it turns.
pub fn wheel(scene: &mut Scene, wheel: &Wheel, bar: f64, (fill, pen): (Ink, Pen)) {
    let teeth = wheel.teeth(bar);
    let fill = Some(fill.faded(FILL));
    if wheel.internal {
        ring(scene, wheel, teeth, bar, (fill, pen));
        return;
    }
    scene.area("wheel", teeth, fill, Some(pen));
    let reach = (wheel.radius - 2.0 * DEPTH * bar).max(0.0);
    wheel.spokes(scene, reach, pen);
}

/// A ring with teeth inside: its area goes around outside, and back inside.
fn ring(
    scene: &mut Scene,
    wheel: &Wheel,
    teeth: Vec<Place>,
    bar: f64,
    (fill, pen): (Option<Ink>, Pen),
) {
    let outside = wheel.radius + RIM * bar;
    let pieces = 90;
    let rim = |k: usize| wheel.at(outside, std::f64::consts::TAU * k as f64 / pieces as f64);
    let mut places: Vec<Place> = (0..=pieces).map(rim).collect();
    places.extend(teeth.first());
    places.extend(teeth.iter().rev());
    scene.area("wheel", places, fill, None);
    scene.area("wheel", teeth, None, Some(pen));
    scene.circle("wheel", wheel.centre, outside, None, Some(pen));
}
