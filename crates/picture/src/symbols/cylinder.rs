//! A hydraulic or pneumatic cylinder.

use crate::sign::{Corner, Edge, OUTLINE, Paint, Sign, Stroke, area};

/// Half widths of barrel and rod, and half the length of a piston, in bars.
const BARREL: f64 = 1.7;
const ROD: f64 = 0.56;
const PISTON: f64 = 0.5;
/// How much of the fill a barrel has: the piston shows through.
const FILL: f64 = 0.55;

fn strip(
    class: &'static str,
    [from, to]: [Corner; 2],
    half: f64,
    fill: Paint,
    edge: Option<Edge>,
) -> Stroke {
    let corners = [
        from.beside(0.0, half),
        to.beside(0.0, half),
        to.beside(0.0, -half),
        from.beside(0.0, -half),
    ];
    area(class, corners, fill, edge)
}

/// The rod from its piston to its free end.
pub fn rod(ends: [Corner; 2], (fill, edge): (Paint, Edge)) -> Sign {
    vec![strip("rod", ends, ROD, fill, Some(edge))]
}

/// The barrel.
pub fn barrel(ends: [Corner; 2], (fill, edge): (Paint, Edge)) -> Sign {
    vec![strip("barrel", ends, BARREL, fill.faded(FILL), Some(edge))]
}

/// The piston.
pub fn piston(at: Corner, edge: Edge) -> Sign {
    let ends = [at.beside(-PISTON, 0.0), at.beside(PISTON, 0.0)];
    vec![strip("piston", ends, BARREL - OUTLINE, edge.paint, None)]
}
