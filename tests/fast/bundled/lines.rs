//! Points on curves that are known.

use super::*;

/// A B = B P = B O4, so by Thales the angle A O4 P is right: |O4 P|² = |A P|² − |O4 A|² = (20 + 4 cos θ) r².
#[test]
fn the_hoecken_coupler_point_keeps_its_distance() {
    let outcome = solve(&load_bundled("stephenson-iii", &[]));
    let (x, y) = (
        values(&outcome, "coupler.P.x"),
        values(&outcome, "coupler.P.y"),
    );
    for (k, theta) in values(&outcome, "crank.angle").into_iter().enumerate() {
        let square = (x[k] - 0.04).powi(2) + y[k].powi(2);
        close(
            square / (0.02 * 0.02),
            20.0 + 4.0 * theta.cos(),
            20.0 * ROUND_OFF,
        );
    }
}

/// The point at distances `to_p` and `to_q` from `p` and `q`, on the left of the way from `p` to `q`.
fn triangle(p: [f64; 2], to_p: f64, q: [f64; 2], to_q: f64) -> [f64; 2] {
    let d = [q[0] - p[0], q[1] - p[1]];
    let length = d[0].hypot(d[1]);
    let along = (to_p * to_p - to_q * to_q + length * length) / (2.0 * length);
    let across = (to_p * to_p - along * along).sqrt();
    [
        p[0] + (d[0] * along - d[1] * across) / length,
        p[1] + (d[1] * along + d[0] * across) / length,
    ]
}

/// Jansen's foot \[m\] at an angle of the crank, triangle by triangle from his eleven numbers.
pub(super) fn jansens_foot(theta: f64) -> [f64; 2] {
    let pivot = [-38.0, -7.8];
    let pin = [15.0 * theta.cos(), 15.0 * theta.sin()];
    let top = triangle(pivot, 41.5, pin, 50.0);
    let rear = triangle(pivot, 40.1, top, 55.8);
    let low = triangle(pin, 61.9, pivot, 39.3);
    let knee = triangle(low, 36.7, rear, 39.4);
    let foot = triangle(low, 49.0, knee, 65.7);
    foot.map(|x| 1e-3 * x)
}

#[test]
fn jansens_foot_follows_from_his_eleven_numbers() {
    let outcome = solve(&load_bundled("jansen-leg", &[]));
    let angles = values(&outcome, "crank.angle");
    let known: Vec<[f64; 2]> = angles.into_iter().map(jansens_foot).collect();
    let ours = path(&outcome, "foot.tip");
    assert!(
        apart(&ours, &known) <= 10.0 * ROUND_OFF,
        "{:e}",
        apart(&ours, &known)
    );
    // Known of it: the foot is within half a millimetre of its lowest level for more than a third of the turn.
    let [low, _] = range(ours.iter().map(|p| p[1]));
    let flat = ours.iter().filter(|p| p[1] <= low + 0.5e-3).count();
    assert!(flat * 3 > ours.len(), "{flat} of {}", ours.len());
}

/// The same for Klann's two dyads, with the lengths of the drawing.
#[test]
fn klanns_foot_follows_from_the_drawing() {
    let outcome = solve(&load_bundled("klann-leg", &[]));
    let far = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let (o, low, up) = ([41.395, 26.641], [27.69, 19.705], [27.69, 31.092]);
    let (m, n, k, l, f) = (
        [36.033, 25.415],
        [21.501, 22.089],
        [10.879, 21.918],
        [19.432, 32.923],
        [0.0, 0.0],
    );
    let known: Vec<[f64; 2]> = values(&outcome, "crank.angle")
        .iter()
        .map(|theta| {
            let (sin, cos) = theta.sin_cos();
            let (x, y) = (m[0] - o[0], m[1] - o[1]);
            let pin = [o[0] + cos * x - sin * y, o[1] + sin * x + cos * y];
            let elbow = triangle(low, far(low, n), pin, far(m, n));
            let knee = triangle(elbow, far(n, k), pin, far(m, k));
            let hip = triangle(knee, far(k, l), up, far(up, l));
            let foot = triangle(hip, far(l, f), knee, far(k, f));
            foot.map(|x| 1e-2 * x)
        })
        .collect();
    let ours = path(&outcome, "leg.F");
    assert!(
        apart(&ours, &known) <= 10.0 * ROUND_OFF,
        "{:e}",
        apart(&ours, &known)
    );
    // It lifts its foot by two thirds of its stride.
    let ([left, right], [low, high]) = (
        range(ours.iter().map(|p| p[0])),
        range(ours.iter().map(|p| p[1])),
    );
    close((high - low) / (right - left), 2.0 / 3.0, 1e-3);
}

/// Inversion in the circle of radius √189 about O turns the circle of diameter 10 into the line x = 18.9.
#[test]
fn the_peaucellier_linkage_draws_an_exact_straight_line() {
    let outcome = solve(&load_bundled("peaucellier", &[]));
    let known: Vec<[f64; 2]> = values(&outcome, "crank.angle")
        .iter()
        .map(|alpha| [0.189, 0.189 * (0.5 * alpha).tan()])
        .collect();
    let ours = path(&outcome, "bar_aq.Q");
    assert!(
        apart(&ours, &known) <= ROUND_OFF,
        "{:e}",
        apart(&ours, &known)
    );
    let [low, high] = range(ours.iter().map(|p| p[1]));
    assert!(high - low > 0.15, "{low} to {high}");
}

/// The tracer by Thales, as in `the_hoecken_coupler_point_keeps_its_distance`, and the published quality of its line.
#[test]
fn the_hoecken_line_is_straight_to_a_quarter_of_a_percent() {
    let outcome = solve(&load_bundled("hoeken", &[]));
    let angles = values(&outcome, "crank.angle");
    let known: Vec<[f64; 2]> = angles
        .iter()
        .map(|theta| {
            let (sin, cos) = theta.sin_cos();
            let stretch = ((20.0 + 4.0 * cos) / (5.0 - 4.0 * cos)).sqrt();
            [0.025 * (2.0 + stretch * sin), 0.025 * stretch * (2.0 - cos)]
        })
        .collect();
    let ours = path(&outcome, "coupler.P");
    assert!(
        apart(&ours, &known) <= ROUND_OFF,
        "{:e}",
        apart(&ours, &known)
    );
    let line: Vec<[f64; 2]> = ours
        .into_iter()
        .zip(&angles)
        .filter(|(_, theta)| theta.cos() <= 1e-9)
        .map(|(p, _)| p)
        .collect();
    let ([left, right], [low, high]) = (
        range(line.iter().map(|p| p[0])),
        range(line.iter().map(|p| p[1])),
    );
    close(right - left, 4.0 * 0.025, ROUND_OFF);
    // 0.244 % to its last digit.
    close((high - low) / (right - left), 0.00244, 5e-6);
}

/// The middle M lies on the perpendicular bisector of the coupler's ends turned about the pivots; at upright and level it
/// is as high as the ground is long.
#[test]
fn the_chebyshev_line_touches_three_times() {
    let outcome = solve(&load_bundled("chebyshev", &[]));
    let known: Vec<[f64; 2]> = values(&outcome, "coupler.angle")
        .iter()
        .map(|phi| {
            let (sin, cos) = phi.sin_cos();
            let stretch = ((20.0 - 4.0 * cos) / (5.0 + 4.0 * cos)).sqrt();
            [0.025 * (2.0 - stretch * sin), 0.025 * stretch * (2.0 + cos)]
        })
        .collect();
    let ours = path(&outcome, "coupler.M");
    assert!(
        apart(&ours, &known) <= ROUND_OFF,
        "{:e}",
        apart(&ours, &known)
    );
    for (row, x) in [(0, 0.0), (90, 0.05), (180, 0.1)] {
        close(ours[row][0], x, ROUND_OFF);
        close(ours[row][1], 0.1, ROUND_OFF);
    }
    let [low, high] = range(ours.iter().map(|p| p[1]));
    close(low, 0.1, ROUND_OFF);
    close((high - low) / 0.1, 0.00244, 5e-6);
}

/// Watt's curve: with the pivots at ±a, arms b and coupler 2c, r² = b² − (a sin θ ± √(c² − a² cos² θ))², here in arms and
/// without its root.
#[test]
fn watts_coupler_point_runs_on_his_curve() {
    let outcome = solve(&load_bundled("watt-straight-line", &[]));
    let ours = path(&outcome, "coupler.M");
    let (a, b, c) = (0.5 * 5f64.sqrt(), 1.0, 0.5);
    let mut tried = 0;
    for [x, y] in &ours {
        let (x, y) = (10.0 * x - 1.0, 10.0 * y + 0.5);
        let radius = x.hypot(y);
        // The angle from the line of the pivots, which falls by 1 in 2; in the middle there is none.
        if radius < 1e-3 {
            continue;
        }
        let (cos, sin) = (
            (2.0 * x - y) / (5f64.sqrt() * radius),
            (x + 2.0 * y) / (5f64.sqrt() * radius),
        );
        let root_square = c * c - a * a * cos * cos;
        let sum = b * b - radius * radius - a * a * sin * sin - root_square;
        // Round-off of the angle grows as 1/r.
        close(
            sum * sum,
            4.0 * a * a * sin * sin * root_square,
            ROUND_OFF / radius,
        );
        tried += 1;
    }
    assert_eq!(tried, 100);
    // Straight to 4.1e-5 of the arm while the beam swings by 10 degrees from the middle.
    let side = |k: usize| (ours[k][0] - 0.1) / 0.1;
    close(side(70).abs(), 4.098e-5, 5e-9);
    // Half the last digit of both.
    close(ours[70][1] + 0.05, 0.01738803, 5e-9);
}

/// The knuckle's angle from the quadrilateral L BL BU U by two triangles over its diagonal BL–U.
#[test]
fn the_camber_follows_from_two_triangles() {
    let outcome = solve(&load_bundled("double-wishbone", &[]));
    let ([l, u], [bl, bu]) = (
        [[350.0, 215.0], [420.0, 470.0]],
        [[710.0, 190.0], [675.0_f64, 475.0]],
    );
    let far = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let direction = |p: [f64; 2], q: [f64; 2]| (q[1] - p[1]).atan2(q[0] - p[0]);
    let camber = values(&outcome, "knuckle.angle");
    for (k, arm) in values(&outcome, "lower_arm.angle").into_iter().enumerate() {
        let ball = far(l, bl);
        let ball = [
            l[0] + ball * (direction(l, bl) + arm).cos(),
            l[1] + ball * (direction(l, bl) + arm).sin(),
        ];
        let upper = triangle(u, far(u, bu), ball, far(bl, bu));
        let upper = if upper[1] > ball[1] {
            upper
        } else {
            triangle(ball, far(bl, bu), u, far(u, bu))
        };
        close(
            camber[k],
            direction(ball, upper) - direction(bl, bu),
            ROUND_OFF,
        );
    }
    // Bump makes the top lean inwards, as it should.
    let [_, highest] = range(values(&outcome, "knuckle.hub.y").into_iter());
    let at = values(&outcome, "knuckle.hub.y")
        .iter()
        .position(|y| *y == highest)
        .expect("there");
    assert!(
        camber[at] > 1f64.to_radians(),
        "{}",
        camber[at].to_degrees()
    );
}
