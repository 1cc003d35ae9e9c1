//! Benchmark mechanisms of forward dynamics, and their exact motion.
//!
//! A01 and A02 are of the IFToMM library of multibody benchmarks (A02 with any number of loops); the squeezing mechanism
//! of Andrews is that of the test set for initial value problem solvers.

use std::f64::consts::{FRAC_PI_2, PI};

use serde_json::{Value, json};

const GRAVITY: f64 = 9.81;

/// A01: a point mass of 1 kg on a massless rod of 1 m, released on the left.
pub fn pendulum() -> Value {
    json!({
        "format": "linkdyn/1", "name": "A01", "units": "SI", "gravity": [0, -GRAVITY],
        "bodies": {
            "ground": { "points": { "O": [0, 0] } },
            "rod": { "mass": 1, "inertia": 0, "com": [1, 0], "points": { "O": [0, 0], "P": [1, 0] },
                     "pose": { "position": [0, 0], "angle": PI } },
        },
        "joints": { "o": { "type": "revolute", "between": ["ground.O", "rod.O"] } },
        "initial": { "rod": { "angle": PI, "angular_velocity": 0 } },
        "points": ["rod.P"],
        "analysis": { "type": "dynamics", "end": 10, "outputs": 101 },
    })
}

/// A02: a row of `loops` parallel four-bars of uniform rods, 1 m and 1 kg each; upright, the joints above moving at 1 m/s.
pub fn four_bars(loops: usize) -> Value {
    let mut bodies = serde_json::Map::new();
    let mut joints = serde_json::Map::new();
    let feet: serde_json::Map<String, Value> = (0..=loops)
        .map(|i| (format!("O{i}"), json!([i, 0])))
        .collect();
    bodies.insert("ground".into(), json!({ "points": feet }));
    let rod = |x: f64, y: f64, angle: f64| {
        json!({ "mass": 1, "inertia": 1.0 / 12.0, "com": [0.5, 0], "points": { "A": [0, 0], "B": [1, 0] },
                "pose": { "position": [x, y], "angle": angle } })
    };
    let pin = |a: String, b: String| json!({ "type": "revolute", "between": [a, b] });
    for i in 0..=loops {
        bodies.insert(format!("rocker{i}"), rod(i as f64, 0.0, FRAC_PI_2));
        joints.insert(
            format!("foot{i}"),
            pin(format!("ground.O{i}"), format!("rocker{i}.A")),
        );
        if i < loops {
            bodies.insert(format!("coupler{i}"), rod(i as f64, 1.0, 0.0));
            joints.insert(
                format!("left{i}"),
                pin(format!("rocker{i}.B"), format!("coupler{i}.A")),
            );
            joints.insert(
                format!("right{i}"),
                pin(format!("coupler{i}.B"), format!("rocker{}.B", i + 1)),
            );
        }
    }
    json!({
        "format": "linkdyn/1", "name": format!("A02, N = {loops}"), "units": "SI", "gravity": [0, -GRAVITY],
        "bodies": bodies, "joints": joints,
        "initial": { "rocker0": { "angle": FRAC_PI_2, "angular_velocity": -1 } },
        "points": ["rocker0.B"],
        "analysis": { "type": "dynamics", "end": 10, "outputs": 101 },
    })
}

/// A chain of `links` uniform rods, 1 m and 1 kg in all, released horizontally; its tip is watched for a second.
pub fn chain(links: usize) -> Value {
    let length = 1.0 / links as f64;
    let mut bodies = serde_json::Map::new();
    let mut joints = serde_json::Map::new();
    bodies.insert("ground".into(), json!({ "points": { "O": [0, 0] } }));
    for k in 0..links {
        let link = json!({ "mass": length, "inertia": length.powi(3) / 12.0, "com": [0.5 * length, 0],
                           "points": { "A": [0, 0], "B": [length, 0] },
                           "pose": { "position": [k as f64 * length, 0] } });
        bodies.insert(format!("l{k}"), link);
        let before = k.checked_sub(1).map(|before| format!("l{before}.B"));
        let before = before.unwrap_or_else(|| "ground.O".into());
        let pin = json!({ "type": "revolute", "between": [before, format!("l{k}.A")] });
        joints.insert(format!("j{k}"), pin);
    }
    let tip = format!("l{}.B", links - 1);
    json!({ "format": "linkdyn/1", "name": "chain", "units": "SI", "gravity": [0, -GRAVITY],
            "bodies": bodies, "joints": joints, "points": [tip],
            "analysis": { "type": "dynamics", "end": 1, "outputs": 11 } })
}

/// Where the tip of such a chain is after a second, to some 1e-8 m: two programs agree on it to 1e-7 m, ours at rtol 1e-8 and
/// MuJoCo's Runge–Kutta method of order 4 with steps of 20 µs.
pub fn chain_tip(links: usize) -> [f64; 2] {
    match links {
        10 => [-0.894_316_852_3, -0.146_565_064_6],
        20 => [-0.896_844_652_9, -0.166_334_467_1],
        50 => [-0.900_227_057_3, -0.177_407_180_7],
        100 => [-0.903_875_317_9, -0.180_786_954_2],
        _ => panic!("no reference for {links} links"),
    }
}

/// Andrews' squeezing mechanism, driven by a constant torque from rest, to 0.03 s.
pub fn squeezer() -> Value {
    let (beta, gamma, phi, delta, omega, epsilon) = (
        -0.06171389001427645_f64,
        0.45527981916307037_f64,
        0.2226683901658859,
        0.4873649795438425,
        -0.2226683901658859,
        1.2305474445498212,
    );
    let (a, b): ([f64; 2], [f64; 2]) = ([-0.06934, -0.00227], [-0.03635, 0.03273]);
    let from = |start: [f64; 2], angle: f64, along: f64, across: f64| {
        [
            start[0] + along * angle.cos() - across * angle.sin(),
            start[1] + along * angle.sin() + across * angle.cos(),
        ]
    };
    // Frames at F, H and G; those of the others are at the bearings O, B and A.
    let f = from([0.0, 0.0], beta, 0.007, 0.0);
    let h = from(a, delta, 0.04, 0.0);
    let g = from(a, epsilon, 0.0, -0.04);
    let body =
        |mass: f64, inertia: f64, com: [f64; 2], points: Value, position: [f64; 2], angle: f64| {
            json!({ "mass": mass, "inertia": inertia, "com": com, "points": points,
                "pose": { "position": position, "angle": angle } })
        };
    let pin = |a: &str, b: &str| json!({ "type": "revolute", "between": [a, b] });
    json!({
        "format": "linkdyn/1", "name": "A03", "units": "SI",
        "bodies": {
            "ground": { "points": { "O": [0, 0], "A": a, "B": b, "C": [0.014, 0.072] } },
            "k1": body(0.04325, 2.194e-6, [0.00092, 0.0], json!({ "O": [0, 0], "F": [0.007, 0] }), [0.0, 0.0], beta),
            "k2": body(0.00365, 4.410e-7, [-0.0115, 0.0], json!({ "F": [0, 0], "E": [-0.028, 0] }), f, beta),
            "k3": body(0.02373, 5.255e-6, [0.01874, 0.01043],
                       json!({ "B": [0, 0], "E": [0, -0.035], "D": [0.02, -0.018] }), b, gamma),
            "k4": body(0.00706, 5.667e-7, [0.0, -0.00579], json!({ "H": [0, 0], "E": [0, -0.02] }), h, phi + delta),
            "k5": body(0.07050, 1.169e-5, [0.02308, 0.00916], json!({ "A": [0, 0], "H": [0.04, 0] }), a, delta),
            "k6": body(0.00706, 5.667e-7, [0.00579, 0.0], json!({ "G": [0, 0], "E": [0.02, 0] }), g, omega + epsilon),
            "k7": body(0.05498, 1.912e-5, [0.01228, -0.00449], json!({ "A": [0, 0], "G": [0, -0.04] }), a, epsilon),
        },
        "joints": {
            "o": pin("ground.O", "k1.O"), "f": pin("k1.F", "k2.F"), "b": pin("ground.B", "k3.B"),
            "a5": pin("ground.A", "k5.A"), "h": pin("k5.H", "k4.H"), "a7": pin("ground.A", "k7.A"),
            "g": pin("k7.G", "k6.G"), "e3": pin("k2.E", "k3.E"), "e4": pin("k2.E", "k4.E"), "e6": pin("k2.E", "k6.E"),
        },
        "forces": {
            "spring": { "type": "spring", "between": ["ground.C", "k3.D"], "stiffness": 4530, "free_length": 0.07785 },
            "motor": { "type": "torque", "body": "k1", "value": 0.033 },
        },
        "initial": { "k1": { "angle": beta, "angular_velocity": 0 } },
        "analysis": { "type": "dynamics", "end": 0.03, "outputs": 2 },
    })
}

/// Angles of the squeezing mechanism at 0.03 s, to the digits of the test set: k1, k2 − k1, k3, k4 − k5, k5, k6 − k7, k7.
pub const SQUEEZER_END: [f64; 7] = [
    15.81077119629904,
    -15.75637105984298,
    0.04082224013073101,
    -0.5347301163226948,
    0.5244099658805304,
    0.5347301163226948,
    1.048080741042263,
];

/// Amplitude am(u, k) of Jacobi's elliptic functions by descending Landen steps, and the quarter period K(k).
fn amplitude(k: f64) -> (impl Fn(f64) -> f64, f64) {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    let mut ratios = Vec::new();
    while ratios.len() < 8 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
        ratios.push(c / a);
    }
    let am = move |u: f64| {
        let last = f64::from(1 << ratios.len()) * a * u;
        ratios
            .iter()
            .rev()
            .fold(last, |phi, ratio| 0.5 * (phi + (ratio * phi.sin()).asin()))
    };
    (am, FRAC_PI_2 / a)
}

/// Place of A01's mass.
pub fn pendulum_place() -> impl Fn(f64) -> [f64; 2] {
    let k = (0.25 * PI).sin();
    let (am, quarter) = amplitude(k);
    move |t| {
        let swing = 2.0 * (k * am(GRAVITY.sqrt() * t - quarter).sin()).asin();
        [swing.sin(), -swing.cos()]
    }
}

/// Place of A02's first upper joint: with θ from upright, θ″ = w² sin θ, all the way round.
pub fn four_bars_place(loops: usize) -> impl Fn(f64) -> [f64; 2] {
    let n = loops as f64;
    let w2 = GRAVITY * 3.0 * (3.0 * n + 1.0) / (2.0 * (4.0 * n + 1.0));
    let (am, quarter) = amplitude((4.0 * w2 / (1.0 + 4.0 * w2)).sqrt());
    move |t| {
        let theta = PI + 2.0 * am(0.5 * (1.0 + 4.0 * w2).sqrt() * t - quarter);
        [theta.sin(), theta.cos()]
    }
}
