//! Outlines of bodies: convex hulls with rounded corners.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::scene::Place;

/// Corners of an arc of a rounded hull \[rad\].
const ARC_STEP: f64 = 0.35;

/// The outline at distance `radius` around the convex hull of the corners.
pub fn rounded_hull(corners: &[Place], radius: f64) -> Vec<Place> {
    let hull = hull(corners);
    let mut outline = Vec::new();
    for (index, corner) in hull.iter().enumerate() {
        let before = hull[(index + hull.len() - 1) % hull.len()];
        let after = hull[(index + 1) % hull.len()];
        // Outwards is to the right of the way round (the page's y points down).
        let normal = |from: Place, to: Place| (-(to[0] - from[0])).atan2(to[1] - from[1]);
        let (start, mut end) = match hull.len() {
            1 => (0.0, std::f64::consts::TAU),
            _ => (normal(before, *corner), normal(*corner, after)),
        };
        while end < start - 1e-9 {
            end += std::f64::consts::TAU;
        }
        let steps = ((end - start) / ARC_STEP).ceil().clamp(1.0, 20.0) as usize;
        for step in 0..=steps {
            let angle = start + (end - start) * step as f64 / steps as f64;
            outline.push([
                corner[0] + radius * angle.cos(),
                corner[1] + radius * angle.sin(),
            ]);
        }
    }
    outline
}

/// The outline at distance `radius` around a line that bends a little.
pub fn ribbon(axis: &[Place], radius: f64) -> Vec<Place> {
    let last = axis.len().saturating_sub(1);
    let angle = |k: usize| {
        let [from, to] = [axis[k.saturating_sub(1)], axis[(k + 1).min(last)]];
        (to[1] - from[1]).atan2(to[0] - from[0])
    };
    let at = |k: usize, turn: f64| {
        let (sin, cos) = (angle(k) + turn).sin_cos();
        [axis[k][0] + radius * cos, axis[k][1] + radius * sin]
    };
    let steps = (PI / ARC_STEP).ceil() as usize;
    let around = |k: usize, start: f64| {
        let turn = move |step: usize| start + PI * step as f64 / steps as f64;
        (0..=steps).map(move |step| at(k, turn(step)))
    };
    // Along one side, around the end, back along the other, around the beginning.
    let ahead = (1..last).map(|k| at(k, -FRAC_PI_2));
    let back = (1..last).rev().map(|k| at(k, FRAC_PI_2));
    let ends = [around(last, -FRAC_PI_2), around(0, FRAC_PI_2)];
    let [end, beginning] = ends;
    ahead.chain(end).chain(back).chain(beginning).collect()
}

/// Convex hull, each corner once, anticlockwise in axes with y upwards (Andrew 1979).
pub fn hull(places: &[Place]) -> Vec<Place> {
    let mut sorted = places.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup_by(|a, b| (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9);
    if sorted.len() < 3 {
        return sorted;
    }
    let chain = |places: &mut dyn Iterator<Item = &Place>| {
        let mut chain: Vec<Place> = Vec::new();
        for place in places {
            while let [.., a, b] = chain[..] {
                if (b[0] - a[0]) * (place[1] - a[1]) - (b[1] - a[1]) * (place[0] - a[0]) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(*place);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut sorted.iter());
    hull.extend(chain(&mut sorted.iter().rev()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ribbon_is_everywhere_as_far_from_its_axis() {
        let axis = [0.0, 1.0, 2.0, 3.0].map(|x| [x, 0.1 * x * x]);
        let outline = ribbon(&axis, 0.5);
        for place in &outline {
            let far = axis.map(|at| (place[0] - at[0]).hypot(place[1] - at[1]));
            let nearest = far.into_iter().fold(f64::INFINITY, f64::min);
            assert!((nearest - 0.5).abs() < 1e-12, "{place:?}: {nearest}");
        }
        let edges = outline.iter().zip(outline.iter().cycle().skip(1));
        let area: f64 = edges.map(|(a, b)| (a[0] * b[1] - a[1] * b[0]) / 2.0).sum();
        assert!((area - (3.13 + 0.78)).abs() < 0.05, "{area}");
    }

    #[test]
    fn a_hull_leaves_inner_places_out() {
        let square = [
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 2.0],
            [0.0, 2.0],
            [1.0, 1.0],
            [1.0, 0.0],
        ];
        let found = hull(&square);
        assert_eq!(found.len(), 4, "{found:?}");
        assert!(!found.contains(&[1.0, 1.0]));
    }

    #[test]
    fn outlines_keep_their_distance() {
        // Perimeter of a hull with rounded corners: that of the hull + 2πr; here with chords instead of arcs.
        for (corners, perimeter) in [
            (vec![[1.0, 1.0]], 0.0),
            (vec![[0.0, 0.0], [3.0, 4.0]], 10.0),
            (vec![[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]], 12.0),
            (vec![[0.0, 0.0], [0.0, 0.0]], 0.0),
        ] {
            let outline = rounded_hull(&corners, 0.5);
            let length: f64 = (0..outline.len())
                .map(|i| (outline[i], outline[(i + 1) % outline.len()]))
                .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
                .sum();
            assert!(
                (length - perimeter - std::f64::consts::PI).abs() < 0.03,
                "{corners:?}: {length}"
            );
        }
    }
}
