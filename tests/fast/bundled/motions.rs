//! Motions and equilibria with published numbers.

use super::*;

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

/// Beyond the dead centre the lever lies on its stop, and the ram is where the triangle of lever and link has it. The workpiece
/// presses by its stiffness, and by virtual work turns the lever on: dx/dθ = −a sin θ x/(x − a cos θ).
#[test]
fn the_clamp_holds_its_workpiece() {
    let outcome = solve(&load_bundled("toggle-clamp", &[]));
    let last = |name: &str| *values(&outcome, name).last().expect("rows");
    let (a, b) = (0.06, 0.12);
    let (sin, cos) = 5.0_f64.to_radians().sin_cos();
    let slide = a * cos + (b * b - a * a * sin * sin).sqrt();
    close(last("ram.x"), slide, 1e-10);
    let press = 4e6 * (slide - 0.178);
    close(last("joint.guide.stop"), -press, 1e-6 * press);
    let lever = a * sin * slide / (slide - a * cos);
    close(
        last("joint.pivot.stop"),
        20.0 + press * lever,
        1e-6 * press * lever,
    );
}

/// At the line of centres the wheel turns 2.414214 times as fast as the crank, and where that is locked neither way of a torque turns
/// it.
#[test]
fn the_geneva_wheel_is_turned_and_held() {
    let crank = std::f64::consts::PI;
    for torque in ["0 N*m", "50 N*mm", "-50 N*mm"] {
        let mut loaded = load_bundled("geneva", &[]);
        if torque != "0 N*m" {
            let mut json: serde_json::Value =
                serde_json::from_str(bundled::find("geneva").expect("bundled").text).expect("JSON");
            json["forces"] = serde_json::json!({ "load": { "type": "torque", "body": "wheel", "value": torque } });
            let sound = linkdyn_model::load(json.to_string().as_bytes(), &[]).expect("sound");
            loaded = sound.model.into_model();
        }
        let outcome = solve(&loaded);
        let (motor, wheel) = (
            values(&outcome, "crank.angle"),
            values(&outcome, "wheel.angle"),
        );
        for (motor, wheel) in motor.iter().zip(&wheel) {
            let turn = (motor + 0.5 * crank).rem_euclid(2.0 * crank) - 0.5 * crank;
            if (0.6 * crank..1.4 * crank).contains(&turn) {
                let rest = ((wheel - 0.25 * crank) / (0.5 * crank)).fract().abs();
                close(rest.min(1.0 - rest), 0.0, 2e-3);
            }
        }
        if torque == "0 N*m" {
            let rates = values(&outcome, "wheel.omega");
            let most = rates
                .iter()
                .fold(0.0, |most: f64, rate| most.max(rate.abs()));
            let lambda = 0.5_f64.sqrt();
            assert!(most <= lambda / (1.0 - lambda) * crank * (1.0 + 1e-9));
        }
    }
}

/// s = h (35 z⁴ − 84 z⁵ + 70 z⁶ − 20 z⁷) of the cam's rise, and its two derivatives by the cam's angle, of z = angle/110°.
fn lifted(z: f64) -> [f64; 3] {
    let (lift, span) = (0.012, 110.0_f64.to_radians());
    let rest = 1.0 - z;
    [
        lift * z.powi(4) * (35.0 + z * (-84.0 + z * (70.0 - 20.0 * z))),
        lift / span * 140.0 * (z * rest).powi(3),
        lift / (span * span) * 420.0 * (z * rest).powi(2) * (1.0 - 2.0 * z),
    ]
}

/// tan μ = s′/(r_b + r + s) of a central roller. The cam presses the follower with N cos μ = m (g + s″ ω²) + k (s + preload), and
/// would have to pull it from the least ω on at which that is nothing: in the second half of the rise.
#[test]
fn the_cam_lifts_presses_and_lets_go() {
    let outcome = solve(&load_bundled("cam-roller", &[]));
    let [angles, heights, pressures] =
        ["cam.angle", "follower.y", "joint.lobe.pressure_angle"].map(|name| values(&outcome, name));
    let rise = angles.iter().zip(&heights).zip(&pressures);
    for ((angle, height), pressure) in rise.take(110) {
        let [s, s1, _] = lifted(angle / 110.0_f64.to_radians());
        close(*height, 0.038 + s, 1e-12);
        close(*pressure, (s1 / (0.038 + s)).atan(), 1e-10);
    }
    let places = || (0..=100_000).map(|k| f64::from(k) / 100_000.0);
    let lean = |z: f64| {
        let [s, s1, _] = lifted(z);
        (s1 / (0.038 + s)).atan()
    };
    let peak = places().map(lean).fold(0.0, f64::max);
    let found = pressures.iter().copied().fold(0.0, f64::max);
    // rows stand a degree apart
    assert!(found <= peak && found > peak - 1e-4, "{found} of {peak}");
    let lifting = |z: f64| {
        let [s, _, s2] = lifted(z);
        let pressed = 0.4 * 9.81 + 6000.0 * (0.006 + s);
        if s2 < 0.0 {
            (pressed / (0.4 * -s2)).sqrt()
        } else {
            f64::INFINITY
        }
    };
    let speed = places().map(lifting).fold(f64::INFINITY, f64::min);
    for (part, lifts) in [(0.999, false), (1.001, true)] {
        let set = format!("parameters.speed={} rad/s", part * speed);
        let outcome = solve(&load_bundled("cam-roller", &[&set]));
        let least = values(&outcome, "joint.lobe.normal_force")
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        assert_eq!(least < 0.0, lifts, "{least} N at {} rad/s", part * speed);
        let warnings = &outcome.report.warnings;
        assert_eq!(
            warnings.iter().any(|one| one.contains("would lift off")),
            lifts,
            "{warnings:?}"
        );
    }
}
