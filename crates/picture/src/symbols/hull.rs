//! Outlines of bodies: convex hulls with rounded corners.

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
