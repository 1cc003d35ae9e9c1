//! Points and directions of bodies in global axes.

use crate::poses::{Pose, global};
use crate::shape::{Bending, Body, PointId, Shape};
use crate::symbols;

/// A point in global coordinates. The shape was checked: every point that is named is there.
pub fn place(shape: &Shape, pose: &[Pose], point: PointId) -> [f64; 2] {
    let [x, y] = shape.point(point).unwrap_or_default();
    let [u, v] = shape.bodies[point.0]
        .bending
        .as_ref()
        .map_or([0.0; 2], |own| {
            let far = |place: &[f64; 2]| (place[0] - x).hypot(place[1] - y);
            let places = own.places.iter().map(far).enumerate();
            let nearest = places.min_by(|(_, one), (_, other)| one.total_cmp(other));
            nearest.map_or([0.0; 2], |(k, _)| deflection(own, pose, k))
        });
    global(pose[point.0], [x + u, y + v])
}

/// How a place of an axis is moved in the frame of its body, where the poses have the amplitudes.
fn deflection(bending: &Bending, pose: &[Pose], place: usize) -> [f64; 2] {
    let amplitudes = bending.amplitudes.iter().map(|[of, k]| pose[*of][*k]);
    let moves = amplitudes.zip(&bending.moves[place]);
    moves.fold([0.0; 2], |[x, y], (q, [u, v])| [x + q * u, y + q * v])
}

/// The axis of a bar that bends, in global coordinates, where the poses have its amplitudes.
pub fn bent(shape: &Shape, pose: &[Pose], body: usize) -> Option<Vec<[f64; 2]>> {
    let Body {
        points, bending, ..
    } = shape.bodies.get(body)?;
    let bending = bending.as_ref()?;
    let points: Vec<[f64; 2]> = points.iter().map(|(_, x, y)| [*x, *y]).collect();
    if bending.amplitudes.is_empty() || symbols::hull(&points).len() > 2 {
        return None;
    }
    let deflected = |(k, [x, y]): (usize, &[f64; 2])| {
        let [u, v] = deflection(bending, pose, k);
        global(pose[body], [x + u, y + v])
    };
    let places = bending.places.iter().enumerate();
    Some(places.map(deflected).collect())
}

/// A direction of a body in global axes.
pub fn turned([_, _, angle]: Pose, direction: [f64; 2]) -> [f64; 2] {
    global([0.0, 0.0, angle], direction)
}
