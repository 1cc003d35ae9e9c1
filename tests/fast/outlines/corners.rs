//! Tips in hollow corners, and in closed outlines: they stay outside of the material.

use super::*;
use crate::impacts::completed as balanced;
use linkdyn_engine::analysis::Outcome;

/// A point of 1 kg that may touch an outline of the ground.
fn point(start: [f64; 2], speed: [f64; 2], outline: Value, more: Value, end: f64) -> Value {
    let mut model = disc(start, speed, outline, more, end);
    if model["joints"]["t"].get("radius") == Some(&json!(RADIUS)) {
        model["joints"]["t"]["radius"] = json!(0.0);
    }
    model
}

/// Along the floor of a tub into its corner, and back: whatever the steps, and whatever the corner.
#[test]
fn a_point_that_slides_into_a_corner_comes_back() {
    for lean in [-0.5, 0.0, 0.3, 2.0] {
        let tub = json!([
            [1.0 + lean, 1.0],
            [1.0, 0.0],
            [-1.0, 0.0],
            [-1.0 - lean, 1.0]
        ]);
        for max_step in [1.0, 1e-2] {
            let mut model = point(
                [0.0, 0.0],
                [0.7, 0.0],
                tub.clone(),
                json!({ "restitution": 0.3 }),
                4.0,
            );
            model["analysis"]["solver"]["max_step"] = json!(max_step);
            let run = balanced(&model);
            let (x, y) = (column(&run, "disc.x"), column(&run, "disc.y"));
            for (x, y) in x.iter().zip(&y) {
                let beyond = x.abs() - 1.0 - lean * y;
                assert!(*y > -1e-9 && beyond < 1e-9, "{lean}: {x}, {y}");
            }
            if lean == 0.0 {
                // At 0.7 m/s there, and at 0.21 m/s back.
                near(x[20], 1.0 - 0.21 * (4.0 - 1.0 / 0.7), 1e-9);
            }
        }
    }
}

/// Pressed into a corner that yields, a point is held by both of its walls.
#[test]
fn a_point_rests_in_a_corner_that_yields() {
    let stiffness = 4000.0;
    for slope in [0.3, 1.0, 3.0_f64] {
        let groove = json!([[1.0, slope], [0.0, 0.0], [-1.0, slope]]);
        let made = json!({ "stiffness": stiffness, "damping": 100.0 });
        let run = balanced(&point([0.0, 1e-3], [0.0; 2], groove, made, 3.0));
        // 2 K d cos² α = m g, with the walls at α from the horizontal
        let square = 1.0 / (1.0 + slope * slope);
        near(
            last(&run, "disc.y"),
            -GRAVITY / (2.0 * stiffness * square),
            1e-7,
        );
        near(last(&run, "disc.x"), 0.0, 1e-9);
        near(last(&run, "joint.t.fy"), GRAVITY, 1e-4);
    }
}

/// How far a disc or a point is inside of the walls of a box, at least [m].
fn clear(run: &Outcome, corners: &[[f64; 2]]) -> f64 {
    let (x, y) = (column(run, "disc.x"), column(run, "disc.y"));
    let places = x.into_iter().zip(y);
    places
        .map(|(x, y)| {
            let walls = corners.windows(2).map(|pair| {
                let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
                let length = (bx - ax).hypot(by - ay);
                // The material is on the left.
                -((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / length
            });
            walls.fold(f64::INFINITY, f64::min)
        })
        .fold(f64::INFINITY, f64::min)
}

/// Boxes of three to eight walls, rigid and yielding, discs and points in them.
#[test]
fn nothing_leaves_a_closed_box() {
    let mut seed = 3_u64;
    let mut number = |low: f64, high: f64| {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        low + (high - low) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    for round in 0..48_u32 {
        let walls = 3 + round % 6;
        let first = number(0.0, 2.0 * PI);
        let corner = |k: u32| {
            let angle = first - 2.0 * PI * f64::from(k % walls) / f64::from(walls);
            [angle.cos(), angle.sin()]
        };
        let corners: Vec<[f64; 2]> = (0..=walls).map(corner).collect();
        let radius = if round % 2 == 0 { 0.0 } else { 0.02 };
        let yields = round % 4 > 1;
        let made = match yields {
            true => json!({ "radius": radius, "stiffness": 1e5, "damping": 20.0 }),
            false => json!({ "radius": radius, "restitution": number(0.0, 0.9) }),
        };
        let speed = [number(-2.0, 2.0), number(-2.0, 2.0)];
        let mut model = point([0.0; 2], speed, json!(corners), made, 2.0);
        model["analysis"]["solver"] = json!({ "rtol": 1e-8, "max_step": 1e-3 });
        model["analysis"]["outputs"] = json!(101);
        let run = balanced(&model);
        let deep = if yields { 0.019 } else { 1e-9 };
        let clear = clear(&run, &corners) - radius;
        assert!(clear > -deep, "{round}: {clear:e} m");
    }
}
