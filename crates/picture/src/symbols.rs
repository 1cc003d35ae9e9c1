//! Small signs: markers of curves.

use super::scene::{Ink, Pen, Place, Scene};
use super::style::Marker;

/// Half the size of a marker \[pt\].
const HALF: f64 = 1.9;

/// A marker, white inside.
pub fn marker(scene: &mut Scene, marker: Marker, [x, y]: Place, pen: Pen) {
    let pen = Pen {
        dash: &[],
        width: 0.8 * pen.width,
        ..pen
    };
    let white = Some(Ink::grey(255));
    let corners = |corners: &[[f64; 2]]| -> Vec<Place> {
        corners
            .iter()
            .map(|[dx, dy]| [x + HALF * dx, y + HALF * dy])
            .collect()
    };
    match marker {
        Marker::None => {}
        Marker::Circle => scene.circle("marker", [x, y], HALF, white, Some(pen)),
        Marker::Square => {
            let places = corners(&[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]);
            scene.area("marker", places, white, Some(pen));
        }
        Marker::Triangle => {
            scene.area(
                "marker",
                corners(&[[0.0, -1.2], [1.1, 0.8], [-1.1, 0.8]]),
                white,
                Some(pen),
            );
        }
        Marker::Diamond => {
            scene.area(
                "marker",
                corners(&[[0.0, -1.3], [1.1, 0.0], [0.0, 1.3], [-1.1, 0.0]]),
                white,
                Some(pen),
            );
        }
    }
}

/// Corners of an arc of a rounded hull \[rad\].
const ARC_STEP: f64 = 0.35;
/// Turns of a spring.
const COILS: usize = 7;

/// The support of a pin: a triangle on hatched ground; `bar` is half the width of a body.
pub fn support(scene: &mut Scene, [x, y]: Place, bar: f64, pen: Pen) {
    let foot = y + 2.6 * bar;
    scene.area(
        "support",
        [[x, y], [x + 1.6 * bar, foot], [x - 1.6 * bar, foot]],
        Some(Ink::grey(255)),
        Some(pen),
    );
    hatch(
        scene,
        [[x - 2.4 * bar, foot], [x + 2.4 * bar, foot]],
        [-0.7, 0.7],
        bar,
        pen,
    );
}

/// A guide that stands still: a line with hatching on the lower side, `ends` are the outermost places of the block.
pub fn ground_guide(scene: &mut Scene, [a, b]: [Place; 2], bar: f64) {
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    let [u, v] = if length > 0.0 {
        [(b[0] - a[0]) / length, (b[1] - a[1]) / length]
    } else {
        [1.0, 0.0]
    };
    // Across, towards the foot of the page, or to the right of an upright guide.
    let across = if u.abs() < 1e-9 {
        [1.0, 0.0]
    } else {
        [-v * u.signum(), u.abs()]
    };
    let shift = |[x, y]: Place, along: f64| {
        [
            x + along * u + BLOCK[1] * bar * across[0],
            y + along * v + BLOCK[1] * bar * across[1],
        ]
    };
    let over = (BLOCK[0] + 0.8) * bar;
    let slant = [across[0] - u, across[1] - v].map(|part| 0.7 * part);
    hatch(
        scene,
        [shift(a, -over), shift(b, over)],
        slant,
        bar,
        Pen::new(Ink::grey(20), 0.22 * bar),
    );
}

/// A line with short strokes on one side.
fn hatch(scene: &mut Scene, [a, b]: [Place; 2], slant: [f64; 2], bar: f64, pen: Pen) {
    scene.line(
        "ground",
        [a, b],
        Pen {
            width: 1.5 * pen.width,
            ..pen
        },
    );
    let strokes = ((b[0] - a[0]).hypot(b[1] - a[1]) / (0.9 * bar))
        .floor()
        .clamp(1.0, 200.0) as usize;
    for index in 0..strokes {
        let part = (index as f64 + 0.7) / strokes as f64;
        let from = [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])];
        scene.line(
            "hatch",
            [from, [from[0] + bar * slant[0], from[1] + bar * slant[1]]],
            Pen {
                width: 0.7 * pen.width,
                ..pen
            },
        );
    }
}

/// Half length and half height of a block, in bars.
const BLOCK: [f64; 2] = [2.4, 1.4];

/// A block on a guide along `direction` (on the page).
pub fn block(scene: &mut Scene, [x, y]: Place, [u, v]: [f64; 2], bar: f64, pen: Pen) {
    let corner = |a: f64, b: f64| [x + bar * (a * u - b * v), y + bar * (a * v + b * u)];
    let [a, b] = BLOCK;
    let corners = [corner(-a, -b), corner(a, -b), corner(a, b), corner(-a, b)];
    scene.area(
        "block",
        corners,
        Some(Ink::grey(235).faded(pen.ink.alpha)),
        Some(pen),
    );
}

/// A wheel by its pitch circle, with a spoke that shows how it turns.
pub fn wheel(scene: &mut Scene, [x, y]: Place, radius: f64, angle: f64, pen: Pen) {
    scene.circle(
        "wheel",
        [x, y],
        radius,
        None,
        Some(Pen {
            dash: &[8.0, 2.5, 1.5, 2.5],
            ..pen
        }),
    );
    scene.line(
        "spoke",
        [[x, y], [x + radius * angle.cos(), y + radius * angle.sin()]],
        pen,
    );
}

/// A coil spring.
pub fn spring(scene: &mut Scene, [a, b]: [Place; 2], bar: f64, pen: Pen) {
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    if length < 1e-9 {
        return;
    }
    let [u, v] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    let place =
        |along: f64, across: f64| [a[0] + along * u - across * v, a[1] + along * v + across * u];
    let straight = 0.15 * length;
    let step = (length - 2.0 * straight) / (2 * COILS) as f64;
    let mut places = vec![a, place(straight, 0.0)];
    for index in 0..2 * COILS {
        let side = if index % 2 == 0 {
            1.2 * bar
        } else {
            -1.2 * bar
        };
        places.push(place(straight + (index as f64 + 0.5) * step, side));
    }
    places.extend([place(length - straight, 0.0), b]);
    scene.line("spring", places, pen);
}

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
fn hull(places: &[Place]) -> Vec<Place> {
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
