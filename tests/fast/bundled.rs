//! Every bundled model runs, and says one thing each that is known without running it.

use crate::benchmarks;
use crate::models::{checked, load_bundled, solve, values};
use linkdyn::bundled;
use linkdyn_engine::analysis::{Control, Outcome, modes};
use linkdyn_output::Status;
use std::f64::consts::{FRAC_PI_6, PI, SQRT_2, TAU};

/// A few ulps of the sizes that occur (0.1 … 1 m, some rad), through a solution of some ten equations.
const ROUND_OFF: f64 = 1e-13;

#[track_caller]
fn close(ours: f64, known: f64, tolerance: f64) {
    assert!(
        (ours - known).abs() <= tolerance,
        "{ours} instead of {known}, off by {:e}",
        ours - known
    );
}

#[test]
fn every_model_runs_and_tells_about_itself() {
    for bundled in bundled::MODELS {
        let loaded = linkdyn_model::load(bundled.text.as_bytes(), &[]).expect(bundled.name);
        assert!(
            loaded.warnings.is_empty(),
            "{}: {:?}",
            bundled.name,
            loaded.warnings
        );
        let model = loaded.model;
        assert!(
            model.name.is_some() && model.about.is_some() && model.source.is_some(),
            "{}",
            bundled.name
        );
        let outcome = solve(&model);
        assert_eq!(
            outcome.report.status,
            Status::Completed,
            "{}: {:?}",
            bundled.name,
            outcome.report.message
        );
        // The redundant crank is what that model is for.
        let expected = usize::from(bundled.name == "parallel-crank");
        assert_eq!(
            outcome.report.warnings.len(),
            expected,
            "{}: {:?}",
            bundled.name,
            outcome.report.warnings
        );
    }
}

/// The rocker's angle from the triangle O4 A B (Freudenstein's loop, solved by the law of cosines).
#[test]
fn the_four_bar_closes_by_the_law_of_cosines() {
    let outcome = solve(&load_bundled("four-bar", &[]));
    let (crank, rocker) = (
        values(&outcome, "crank.angle"),
        values(&outcome, "rocker.angle"),
    );
    for (theta, psi) in crank.into_iter().zip(rocker) {
        let (dx, dy) = (0.1 * theta.cos() - 0.3, 0.1 * theta.sin());
        let diagonal = dx.hypot(dy);
        let corner =
            ((diagonal * diagonal + 0.2 * 0.2 - 0.25 * 0.25) / (2.0 * diagonal * 0.2)).acos();
        close((psi - (dy.atan2(dx) - corner)).sin(), 0.0, ROUND_OFF);
    }
}

#[test]
fn the_slider_crank_strokes_twice_its_crank() {
    let outcome = solve(&load_bundled("slider-crank", &[]));
    let x = values(&outcome, "piston.x");
    let (low, high) = x.iter().fold((f64::MAX, f64::MIN), |(low, high), &x| {
        (low.min(x), high.max(x))
    });
    close(high - low, 2.0 * 0.05, ROUND_OFF);
    assert!(
        values(&outcome, "piston.y")
            .iter()
            .all(|y| y.abs() <= ROUND_OFF)
    );
    // At the outer dead centre the piston is decelerated by r ω² (1 + r/l).
    let omega = TAU * 50.0;
    let known = -0.05 * omega * omega * (1.0 + 0.05 / 0.2);
    close(
        values(&outcome, "piston.ax")[0],
        known,
        ROUND_OFF * known.abs(),
    );
}

/// The arm turns where it touches the crank's circle: its swing is 2 asin(r/d), and the crank turns by π + swing on the way
/// forth and by π − swing on the way back, a time ratio of 2 for r/d = 1/2.
#[test]
fn the_quick_return_is_quick_by_its_time_ratio() {
    let outcome = solve(&load_bundled("quick-return", &[]));
    let angle = outcome.trajectory.column_index("arm.angle").expect("there");
    let extremes = outcome.trajectory.extremes()[angle].expect("there");
    close(extremes.max - extremes.min, 2.0 * FRAC_PI_6, ROUND_OFF);
    // Starts at the lower turning point, 120 instants a third of a turn.
    let turns = values(&outcome, "driver.motor.value")
        .iter()
        .position(|theta| *theta > PI * 7.0 / 6.0 - 1e-9);
    close(extremes.max_time, 240.0 / 360.0, 1e-12);
    assert_eq!(turns, Some(240));
    let omega = values(&outcome, "arm.omega");
    let forth = omega.iter().filter(|omega| **omega > 1e-9).count() as f64;
    let back = omega.iter().filter(|omega| **omega < -1e-9).count() as f64;
    close((forth + 1.0) / (back + 1.0), 2.0, 1e-12);
}

#[test]
fn the_plate_on_parallel_cranks_does_not_turn() {
    let outcome = solve(&load_bundled("parallel-crank", &[]));
    for (column, scale) in [
        ("plate.angle", 1.0),
        ("plate.omega", TAU),
        ("plate.alpha", TAU * TAU),
    ] {
        let largest = values(&outcome, column)
            .iter()
            .fold(0.0, |m: f64, value| m.max(value.abs()));
        assert!(largest <= ROUND_OFF * scale, "{column}: {largest:e}");
    }
    assert_eq!(
        (
            outcome.report.mobility.grubler,
            outcome.report.mobility.rank
        ),
        (0, 1)
    );
    // Vertical equilibrium: what the ground carries is the weight and what lifts the masses.
    let carried = ["p", "q", "r"].map(|joint| values(&outcome, &format!("joint.{joint}.fy")));
    let lift = values(&outcome, "plate.ay");
    for k in 0..lift.len() {
        // Centres of the cranks at half their length move by half of what the plate does.
        let known = 5.8 * 9.81 + (4.0 + 3.0 * 0.6 * 0.5) * lift[k];
        close(carried.iter().map(|fy| fy[k]).sum(), known, 1e-11);
    }
}

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

/// The change point as computed with 50 digits (`validation/lock-ideal/SOURCE.md`).
#[test]
fn the_lock_passes_its_change_point() {
    let outcome = solve(&load_bundled("lock", &[]));
    let events = &outcome.report.events;
    assert_eq!(
        events.iter().map(|event| event.kind).collect::<Vec<_>>(),
        ["change_point"]
    );
    let value = events[0].value.expect("a driver value").to_degrees();
    close(value, 117.512206516641, 1e-8);
    println!("change point off by {:e} deg", value - 117.512206516641);
}

/// The path of a point.
fn path(outcome: &Outcome, point: &str) -> Vec<[f64; 2]> {
    values(outcome, &format!("{point}.x"))
        .into_iter()
        .zip(values(outcome, &format!("{point}.y")))
        .map(|(x, y)| [x, y])
        .collect()
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

/// Largest distance of two paths.
fn apart(ours: &[[f64; 2]], known: &[[f64; 2]]) -> f64 {
    assert_eq!(ours.len(), known.len());
    ours.iter()
        .zip(known)
        .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
        .fold(0.0, f64::max)
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

/// Triangle by triangle from Jansen's eleven numbers.
#[test]
fn jansens_foot_follows_from_his_eleven_numbers() {
    let outcome = solve(&load_bundled("jansen-leg", &[]));
    let pivot = [-38.0, -7.8];
    let known: Vec<[f64; 2]> = values(&outcome, "crank.angle")
        .iter()
        .map(|theta| {
            let pin = [15.0 * theta.cos(), 15.0 * theta.sin()];
            let top = triangle(pivot, 41.5, pin, 50.0);
            let rear = triangle(pivot, 40.1, top, 55.8);
            let low = triangle(pin, 61.9, pivot, 39.3);
            let knee = triangle(low, 36.7, rear, 39.4);
            let foot = triangle(low, 49.0, knee, 65.7);
            foot.map(|x| 1e-3 * x)
        })
        .collect();
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

/// The ram stands still where the pin crosses the line of the ram: α = asin(d/r) = 30° below, time ratio
/// (180 + 2α)/(180 − 2α) = 2; its stroke is twice the arm.
#[test]
fn the_whitworth_ram_comes_back_in_half_the_time() {
    let outcome = solve(&load_bundled("whitworth", &[]));
    let (x, v) = (values(&outcome, "ram.x"), values(&outcome, "ram.vx"));
    let [left, right] = range(x.iter().copied());
    close(right - left, 2.0 * 0.1, ROUND_OFF);
    for dead_centre in [0, 240, 360] {
        close(v[dead_centre], 0.0, 10.0 * ROUND_OFF);
    }
    assert!(v[1..240].iter().all(|v| *v > 0.0) && v[241..360].iter().all(|v| *v < 0.0));
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

/// The library's own six digits, and the pendulum's elliptic functions.
#[test]
fn the_pendulum_swings_as_published() {
    let outcome = solve(&load_bundled("pendulum", &[]));
    let ours = path(&outcome, "rod.P");
    for (row, published) in [
        (10, [-0.391049, -0.920370]),
        (20, [0.986292, -0.165011]),
        (30, [0.884132, -0.467237]),
    ] {
        // Half their last digit.
        assert!(
            apart(&ours[row..=row], &[published]) <= 0.71e-6,
            "{:?}",
            ours[row]
        );
    }
    let place = benchmarks::pendulum_place();
    let known: Vec<[f64; 2]> = values(&outcome, "time").into_iter().map(place).collect();
    assert!(apart(&ours, &known) <= 1e-6, "{:e}", apart(&ours, &known));
}

/// ω² = (2 ∓ √2) g/l about its rest. Let go level, both masses begin to fall freely: no force along the rods holds them.
#[test]
fn the_double_pendulum_has_its_two_frequencies() {
    let found = modes(
        &checked(&load_bundled("double-pendulum", &[])),
        false,
        &Control::default(),
    )
    .expect("sound");
    let ours: Vec<f64> = found.modes.iter().map(|mode| mode.frequency()).collect();
    assert_eq!(ours.len(), 2);
    for (ours, factor) in ours.iter().zip([2.0 - SQRT_2, 2.0 + SQRT_2]) {
        close(*ours, (factor * 9.81).sqrt(), 1e-12);
    }
    let outcome = solve(&load_bundled("double-pendulum", &[]));
    close(values(&outcome, "upper.alpha")[0], -9.81, 1e-12);
    close(values(&outcome, "lower.alpha")[0], 0.0, 1e-12);
    close(values(&outcome, "lower.P.ay")[0], -9.81, 1e-12);
}

/// The closed form for two loops and for the library's forty, and there its own digits too.
#[test]
fn the_row_of_four_bars_moves_as_published() {
    for (name, loops) in [("nfourbar", 2), ("nfourbar:40", 40)] {
        let text = bundled::text(name).expect("a model");
        let sets = [
            "analysis.end=20",
            "analysis.outputs=401",
            "analysis.solver.rtol=1e-11",
            "analysis.solver.atol=1e-13",
        ];
        let outcome = solve(
            &linkdyn_model::load(text.as_bytes(), &sets.map(String::from))
                .expect(name)
                .model,
        );
        assert_eq!(outcome.report.status, Status::Completed, "{name}");
        let ours = path(&outcome, "rocker0.B");
        let known: Vec<[f64; 2]> = values(&outcome, "time")
            .into_iter()
            .map(benchmarks::four_bars_place(loops))
            .collect();
        println!("{name}: off by {:e}", apart(&ours, &known));
        assert!(
            apart(&ours, &known) <= 5e-6,
            "{name}: {:e}",
            apart(&ours, &known)
        );
        if loops == 40 {
            // The library's run is off by up to 4e-6 itself.
            for (row, published) in [
                (2, [0.101676, 0.994818]),
                (200, [0.180513, 0.983573]),
                (400, [0.410902, 0.911679]),
            ] {
                assert!(
                    apart(&ours[row..=row], &[published]) <= 1e-5,
                    "{:?}",
                    ours[row]
                );
            }
        }
    }
}

/// The angles at 0.03 s to the digits of the test set; β has turned by 15.8 rad by then.
#[test]
fn andrews_squeezer_ends_where_the_test_set_says() {
    let outcome = solve(&load_bundled("andrews-squeezer", &[]));
    let last = |body: &str| {
        *values(&outcome, &format!("{body}.angle"))
            .last()
            .expect("rows")
    };
    let (of, fe, bde, ge, ag, he, ah) = (
        last("OF"),
        last("FE"),
        last("BDE"),
        last("GE"),
        last("AG"),
        last("HE"),
        last("AH"),
    );
    for (ours, known) in [of, fe - of, bde, ge - ag, ag, he - ah, ah]
        .into_iter()
        .zip(benchmarks::SQUEEZER_END)
    {
        close(ours, known, 1e-6);
    }
}

/// The equilibrium as published, to its last digit.
#[test]
fn the_four_bar_hangs_in_its_spring_as_published() {
    let outcome = solve(&load_bundled("four-bar-spring", &[]));
    for body in ["left", "right"] {
        close(
            values(&outcome, &format!("{body}.angle"))[0],
            2.23433101898,
            5e-11,
        );
    }
    let found = modes(
        &checked(&load_bundled(
            "four-bar-spring",
            &["forces.diagonal.damping=0"],
        )),
        false,
        &Control::default(),
    );
    // ω² = V″/(5/3 m l²), see validation/four-bar-spring.
    close(
        found.expect("sound").modes[0].frequency(),
        (7.687524905947409_f64 / (5.0 / 3.0)).sqrt(),
        1e-11,
    );
}

/// Ideal, the slider is decelerated by r ω² (1 + r/l) at its outer dead centre. With the massless link the pin touches its
/// bearing everywhere, on the side to which the force presses it: at the dead centres, where all lies in line, on the outside.
#[test]
fn the_piston_pin_touches_its_bearing() {
    let ideal = solve(&load_bundled(
        "slider-crank-clearance",
        &["joints.wristpin.clearance.model=ideal"],
    ));
    let omega = 5000.0 / 60.0 * TAU;
    let known = -0.05 * omega * omega * (1.0 + 0.05 / 0.12);
    close(
        values(&ideal, "slider.ax")[0],
        known,
        10.0 * ROUND_OFF * known.abs(),
    );

    let link = [
        "joints.wristpin.clearance.model=massless_link",
        "analysis.type=inverse_dynamics",
        "analysis.end=12 ms",
        "analysis.outputs=37",
    ];
    let outcome = solve(&load_bundled("slider-crank-clearance", &link));
    let [ex, ey, fx, fy] =
        ["ex", "ey", "fx", "fy"].map(|name| values(&outcome, &format!("joint.wristpin.{name}")));
    for k in 0..ex.len() {
        close(ex[k].hypot(ey[k]), 5e-4, ROUND_OFF);
        let force = fx[k].hypot(fy[k]);
        close((ex[k] * fx[k] + ey[k] * fy[k]) / (5e-4 * force), -1.0, 1e-9);
    }
    let x = values(&outcome, "slider.x");
    close(x[0], 0.17 + 5e-4, ROUND_OFF);
    close(x[18], 0.12 - 0.05 - 5e-4, ROUND_OFF);
}

/// The first three impacts to the digits of another program in other coordinates (rod angle and slider), and the number of all
/// (validation/slider-crank-clearance).
#[test]
fn the_worn_piston_pin_strikes_when_another_program_says() {
    let outcome = solve(&load_bundled(
        "slider-crank-clearance",
        &["analysis.solver.rtol=1e-9"],
    ));
    let impacts: Vec<_> = outcome
        .report
        .events
        .iter()
        .filter_map(|event| event.episode)
        .collect();
    assert_eq!(impacts.len(), 24);
    let known = [
        (2.272860e-4, 4.38578),
        (5.733549e-4, 2.26735),
        (7.191476e-4, 2.11926),
    ];
    for (impact, (time, speed)) in impacts.iter().zip(known) {
        close(impact.start, time, 0.5e-10);
        close(impact.approach_speed, speed, 0.5e-5);
    }
}

/// Twice the lengths: twice every arm and centre of mass, four times the square of the radius of gyration.
#[test]
fn bundled_models_change_size_as_a_whole() {
    let mut resized = 0;
    for bundled in bundled::MODELS {
        let document: serde_json::Value = serde_json::from_str(bundled.text).expect("JSON");
        let Some(parameters) = document["parameters"].as_object() else {
            continue;
        };
        let lengths = parameters.iter().filter_map(|(name, value)| {
            let (number, unit) = value.as_str().filter(|_| name != "note")?.split_once(' ')?;
            let number: f64 = number.parse().ok()?;
            ["m", "cm", "mm"]
                .contains(&unit)
                .then(|| format!("parameters.{name}={} {unit}", 2.0 * number))
        });
        let sets: Vec<String> = lengths.collect();
        assert!(!sets.is_empty(), "{}", bundled.name);
        let small = linkdyn_model::load(bundled.text.as_bytes(), &[])
            .expect("sound")
            .model;
        let loaded = linkdyn_model::load(bundled.text.as_bytes(), &sets).expect("sound");
        assert!(
            loaded.warnings.is_empty(),
            "{}: {:?}",
            bundled.name,
            loaded.warnings
        );
        for (name, body) in small.bodies.iter().filter(|(name, _)| *name != "ground") {
            let (what, large) = (
                format!("{} {name}", bundled.name),
                &loaded.model.bodies[name],
            );
            let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
            let twice = |a: [f64; 2], b: [f64; 2]| near(a[0], 2.0 * b[0]) && near(a[1], 2.0 * b[1]);
            assert!(
                body.points
                    .iter()
                    .all(|(point, at)| twice(large.points[point], *at)),
                "{what}"
            );
            let arm = body
                .points
                .values()
                .fold(0.0, |arm: f64, at| arm.max(at[0].hypot(at[1])));
            let (Some(mass), Some(inertia), Some(com)) = (body.mass, body.inertia, body.com) else {
                continue;
            };
            // A body of one point, such as a piston, is the same at every stroke.
            if arm > 0.0 {
                let (m, j) = (large.mass.expect("mass"), large.inertia.expect("inertia"));
                assert!(twice(large.com.expect("com"), com), "{what}");
                // A point mass is as heavy as it was.
                assert!(
                    inertia == 0.0 || m >= 2.0 * mass,
                    "{what}: {m} kg and {mass} kg"
                );
                assert!(
                    near(j / m, 4.0 * inertia / mass),
                    "{what}: {j} kg m^2 and {inertia} kg m^2"
                );
            }
        }
        resized += 1;
    }
    assert!(resized >= 16, "{resized}");
}
