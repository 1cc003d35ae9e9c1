//! Equilibria from drawings near rest: four rods between two pins, which have two degrees of freedom.
//!
//! ```text
//! V(α, δ) = g Σ m y      α, δ: angles of the outer rods; the inner two hang between their tips
//! ```
//!
//! An equilibrium is a least V: its derivatives by differences vanish there.

use crate::linkage::Random;
use crate::mechanisms::{column, completed, pin};
use serde_json::{Value, json};

const G: f64 = 9.81;
const PIVOTS: [[f64; 2]; 2] = [[0.0, 0.0], [2.3, 0.1]];
const OUTER: [f64; 2] = [0.8, 0.9];
const INNER: [f64; 2] = [0.7, 0.75];

/// Poses of the four rods (place and angle) at the outer rods' angles; the inner ones' pin below the line of the tips.
fn poses([alpha, delta]: [f64; 2]) -> Option<[([f64; 2], f64); 4]> {
    let tip = |k: usize, angle: f64| {
        [
            PIVOTS[k][0] + OUTER[k] * angle.cos(),
            PIVOTS[k][1] + OUTER[k] * angle.sin(),
        ]
    };
    let (p, q) = (tip(0, alpha), tip(1, delta));
    let d = [q[0] - p[0], q[1] - p[1]];
    let distance = d[0].hypot(d[1]);
    let along =
        (distance * distance + INNER[0] * INNER[0] - INNER[1] * INNER[1]) / (2.0 * distance);
    let height = (INNER[0] * INNER[0] - along * along).sqrt();
    let pin = [
        p[0] + (along * d[0] + height * d[1]) / distance,
        p[1] + (along * d[1] - height * d[0]) / distance,
    ];
    let towards = |from: [f64; 2], to: [f64; 2]| (to[1] - from[1]).atan2(to[0] - from[0]);
    let last = std::f64::consts::PI + delta;
    height.is_finite().then(|| {
        [
            (PIVOTS[0], alpha),
            (p, towards(p, pin)),
            (pin, towards(pin, q)),
            (q, last),
        ]
    })
}

/// Mass and centre of mass of each rod; the last one goes from its tip to its pivot.
const RODS: [(f64, [f64; 2]); 4] = [
    (1.0, [0.4, 0.0]),
    (1.3, [0.3, 0.1]),
    (0.7, [0.3, 0.0]),
    (0.9, [0.3, 0.0]),
];

fn potential(angles: [f64; 2]) -> Option<f64> {
    let heights = poses(angles)?
        .into_iter()
        .zip(RODS)
        .map(|((place, angle), (mass, com))| {
            G * mass * (place[1] + com[0] * angle.sin() + com[1] * angle.cos())
        });
    Some(heights.sum())
}

fn model(poses: [([f64; 2], f64); 4]) -> Value {
    let lengths = [OUTER[0], INNER[0], INNER[1], OUTER[1]];
    let mut bodies = json!({ "ground": { "points": { "O": PIVOTS[0], "E": PIVOTS[1] } } });
    for (k, (place, angle)) in poses.into_iter().enumerate() {
        let (mass, com) = RODS[k];
        bodies[["a", "b", "c", "d"][k]] = json!({ "mass": mass, "inertia": 0.1, "com": com,
            "points": { "A": [0, 0], "B": [lengths[k], 0] }, "pose": { "position": place, "angle": angle } });
    }
    json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0, -G], "bodies": bodies,
        "joints": { "o": pin("ground.O", "a.A"), "p": pin("a.B", "b.A"), "q": pin("b.B", "c.A"),
                    "r": pin("c.B", "d.A"), "e": pin("d.B", "ground.E") },
        "analysis": { "type": "statics" } })
}

#[test]
fn statics_finds_the_equilibrium_from_drawings_near_rest() {
    let count = std::env::var("LINKDYN_STARTS").ok();
    let count: usize = count.map_or(60, |count| count.parse().expect("a number"));
    let mut random = Random(7);
    let mut tried = 0;
    while tried < count {
        let angles = [-1.0 + 0.6 * random.signed(), -2.3 + 0.6 * random.signed()];
        let Some(poses) = poses(angles) else { continue };
        tried += 1;
        let run = completed(&model(poses));
        let found = [
            column(&run, "a.angle")[0],
            column(&run, "d.angle")[0] - std::f64::consts::PI,
        ];
        let v = |x: f64, y: f64| potential([found[0] + x, found[1] + y]).expect("an assembly");
        let h = 1e-4;
        let slope = [v(h, 0.0) - v(-h, 0.0), v(0.0, h) - v(0.0, -h)].map(|d| d / (2.0 * h));
        assert!(
            slope.iter().all(|slope| slope.abs() < 1e-5),
            "{angles:?}: {slope:?}"
        );
        let least = [
            v(h, 0.0),
            v(-h, 0.0),
            v(0.0, h),
            v(0.0, -h),
            v(h, h),
            v(h, -h),
        ];
        assert!(
            least.iter().all(|around| *around > v(0.0, 0.0)),
            "{angles:?}"
        );
    }
}
