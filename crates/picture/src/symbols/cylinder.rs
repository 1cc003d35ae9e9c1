//! A hydraulic or pneumatic cylinder.

use super::line::Line;
use crate::scene::{Ink, Pen, Place, Scene};

/// Half widths of barrel and rod, and half the length of a piston, in bars.
const BARREL: f64 = 1.7;
const ROD: f64 = 0.56;
const PISTON: f64 = 0.5;
/// How much of the fill a barrel has: the piston shows through.
const FILL: f64 = 0.55;

/// Where barrel and rod begin and end along the axis \[pt\].
#[derive(Debug, Clone, Copy)]
pub struct Cylinder {
    /// Where distances count from.
    pub origin: Place,
    /// The axis, length one.
    pub along: [f64; 2],
    /// Both ends of the barrel.
    pub barrel: [f64; 2],
    /// The piston, and the free end of the rod.
    pub rod: [f64; 2],
}

/// A cylinder with fill and outline of its barrel and of its rod.
pub fn cylinder(
    scene: &mut Scene,
    cylinder: &Cylinder,
    bar: f64,
    barrel: (Ink, Pen),
    rod: (Ink, Pen),
) {
    let line = Line::from(cylinder.origin, cylinder.along);
    let strip = |[from, to]: [f64; 2], half: f64| {
        [[from, half], [to, half], [to, -half], [from, -half]].map(|[far, off]| line.at(far, off))
    };
    let [piston, _] = cylinder.rod;
    scene.area(
        "rod",
        strip(cylinder.rod, ROD * bar),
        Some(rod.0),
        Some(rod.1),
    );
    let shell = strip(cylinder.barrel, BARREL * bar);
    scene.area("barrel", shell, Some(barrel.0.faded(FILL)), Some(barrel.1));
    let reach = [piston - PISTON * bar, piston + PISTON * bar];
    let inside = BARREL * bar - barrel.1.width;
    scene.area("piston", strip(reach, inside), Some(rod.1.ink), None);
}
