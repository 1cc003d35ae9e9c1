//! Integrators: order, accuracy beside SciPy's, stiff problems, dense output, refusals and the end of steps.

mod ends;

use crate::ode;
use crate::ode::{Problem, SOLVED, distance, fixed, run, sample, tolerance};
use linkdyn_engine::integrate::{
    Dop853, Limits, Method, Ode, Radau, Refused, StepFailure, Stepper, Tolerance,
};

/// log₂ of the ratio of errors.
fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

/// Slope of the line through (log x, log y) that fits best.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let (mx, my) = (
        logs.iter().map(|p| p.0).sum::<f64>() / n,
        logs.iter().map(|p| p.1).sum::<f64>() / n,
    );
    let covariance: f64 = logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum();
    covariance / logs.iter().map(|(x, _)| (x - mx) * (x - mx)).sum::<f64>()
}

#[test]
fn dop853_is_of_order_8_and_its_dense_output_of_7() {
    for (solved, h) in SOLVED.iter().zip([1.0, 0.5, 0.1]) {
        let errors = [h, 0.5 * h].map(|h| {
            let (tolerance, limits) = fixed(solved.start().len(), h);
            let mut stepper = Dop853::new(tolerance, limits);
            let mut problem = solved.problem();
            stepper
                .start(&mut problem, 0.0, &solved.start(), 8.0)
                .unwrap();
            let (mut dense, mut y) = (0.0_f64, solved.start());
            while stepper.t() != 8.0 {
                let (from, at) = (stepper.t(), stepper.y().to_vec());
                stepper.step(&mut problem, 8.0).unwrap();
                for part in [0.25, 0.5, 0.75] {
                    let t = from + part * (stepper.t() - from);
                    stepper.interpolate(&mut problem, t, &mut y).unwrap();
                    dense = dense.max(distance(&y, &(solved.at)(t)));
                }
                stepper.interpolate(&mut problem, from, &mut y).unwrap();
                assert!(distance(&y, &at) < 1e-14, "the start of the step");
                stepper
                    .interpolate(&mut problem, stepper.t(), &mut y)
                    .unwrap();
                assert_eq!(y, stepper.y());
            }
            (distance(stepper.y(), &(solved.at)(8.0)), dense)
        });
        let (end, dense) = (
            order(errors[0].0, errors[1].0),
            order(errors[0].1, errors[1].1),
        );
        println!(
            "dop853, {}: {errors:?} order {end:.2}, dense {dense:.2}",
            solved.name
        );
        assert!(end > 7.5 && dense > 7.0, "{}: {end}, {dense}", solved.name);
    }
}

#[test]
fn radau5_is_of_order_5_and_its_dense_output_of_3() {
    for (solved, h) in SOLVED.iter().zip([0.25, 0.25, 0.0625]) {
        let errors = [h, 0.5 * h].map(|h| {
            // a tolerance that the steps meet, and that Newton's iteration goes by
            let n = solved.start().len();
            let limits = Limits {
                initial_step: Some(h),
                max_step: Some(h),
                min_step: Some(h),
                ..Limits::default()
            };
            let mut stepper = Radau::new(tolerance(n, 1e-3), limits);
            let mut problem = solved.problem();
            stepper
                .start(&mut problem, 0.0, &solved.start(), 8.0)
                .unwrap();
            let (mut dense, mut y) = (0.0_f64, solved.start());
            while stepper.t() != 8.0 {
                let from = stepper.t();
                stepper.step(&mut problem, 8.0).unwrap();
                for part in [0.3, 0.5, 0.8] {
                    let t = from + part * (stepper.t() - from);
                    stepper.interpolate(&mut problem, t, &mut y).unwrap();
                    dense = dense.max(distance(&y, &(solved.at)(t)));
                }
            }
            assert_eq!(stepper.counters().steps, (8.0 / h) as u64);
            (distance(stepper.y(), &(solved.at)(8.0)), dense)
        });
        let (end, dense) = (
            order(errors[0].0, errors[1].0),
            order(errors[0].1, errors[1].1),
        );
        println!(
            "radau5, {}: {errors:?} order {end:.2}, dense {dense:.2}",
            solved.name
        );
        assert!(dense > 3.0, "{}: {dense}", solved.name);
    }
    // the order by a ladder of tolerances, as error over steps
    for solved in &SOLVED {
        let points: Vec<(f64, f64)> = (5..=10)
            .map(|power| {
                let n = solved.start().len();
                let mut stepper = Radau::new(tolerance(n, 10_f64.powi(-power)), Limits::default());
                let end = run(
                    &mut stepper,
                    &mut solved.problem(),
                    0.0,
                    &solved.start(),
                    20.0,
                );
                (
                    stepper.counters().steps as f64,
                    distance(&end, &(solved.at)(20.0)),
                )
            })
            .collect();
        let order = -slope(&points);
        println!("radau5, {}: order {order:.2} {points:?}", solved.name);
        assert!((4.5..5.6).contains(&order), "{}: {order}", solved.name);
    }
}

/// Largest error at t = 1, 2, … 20 of SciPy 1.17.1, `solve_ivp(method="DOP853", rtol=r, atol=r, t_eval=…)`, for
/// r = 1e-5, 1e-6, … 1e-11.
const SCIPY: [[f64; 7]; 3] = [
    [
        3.08e-5, 3.09e-6, 3.32e-7, 4.16e-8, 3.84e-9, 3.35e-10, 3.51e-11,
    ],
    [
        5.41e-5, 1.07e-5, 7.10e-7, 3.35e-8, 3.80e-9, 2.38e-10, 3.26e-11,
    ],
    [
        6.01e-3, 1.99e-4, 6.67e-5, 6.33e-6, 3.07e-7, 4.15e-8, 2.26e-9,
    ],
];

#[test]
fn dop853_is_as_accurate_as_scipy_and_follows_the_tolerance() {
    for (solved, scipy) in SOLVED.iter().zip(SCIPY) {
        let (mut points, mut ratios) = (Vec::new(), 1.0);
        for (power, scipy) in (5..).zip(scipy) {
            let r = 10_f64.powi(-power);
            let mut stepper = Dop853::new(tolerance(solved.start().len(), r), Limits::default());
            let samples = sample(&mut stepper, &mut solved.problem(), &solved.start(), 20.0);
            let error = solved.error(&samples);
            println!(
                "{} {r:e}: {error:.3e}, {:.2} of SciPy's",
                solved.name,
                error / scipy
            );
            // single runs of few steps scatter, in SciPy too: 26 steps for the pendulum at 1e-6
            let scatter = if solved.name == "pendulum" { 3.0 } else { 1.5 };
            assert!(
                error <= scatter * scipy,
                "{} at {r:e}: {error:e} beside {scipy:e}",
                solved.name
            );
            ratios *= error / scipy;
            assert!(!stepper.stiff());
            points.push((r, error));
        }
        let (slope, mean) = (slope(&points), f64::powf(ratios, 1.0 / 7.0));
        println!(
            "{}: slope {slope:.3}, {mean:.2} of SciPy's errors in the mean",
            solved.name
        );
        assert!(mean <= 1.2, "{}: {mean}", solved.name);
        assert!((0.8..1.2).contains(&slope), "{}: {slope}", solved.name);
    }
}

/// Van der Pol's y(2000) and Robertson's y(1e11): Mazzia and Magherini, Test Set for Initial Value Problem Solvers,
/// release 2.4, 2008 (the first one in its scaled form at 2).
#[test]
fn radau5_and_auto_solve_stiff_problems() {
    for method in [Method::Radau, Method::Auto] {
        for (r, most) in [(1e-4, 3000), (1e-6, 5000), (1e-8, 10000)] {
            let mut stepper = method.stepper(tolerance(2, r), Limits::default());
            let mut problem = Problem::new(2, ode::van_der_pol);
            let end = run(&mut *stepper, &mut problem, 0.0, &[2.0, 0.0], 2000.0);
            let error = (end[0] / 1.706167732170483 - 1.0).abs();
            println!(
                "{method:?}, van der Pol {r:e}: {error:.1e} {:?}",
                stepper.counters()
            );
            assert!(
                error < 5.0 * r && problem.evaluations < most,
                "{method:?} at {r:e}: {error:e}"
            );
            assert_eq!(stepper.counters().evaluations, problem.evaluations);

            let tolerance = Tolerance {
                rtol: r,
                atol: vec![1e-4 * r, 1e-8 * r, 1e-4 * r],
                cap: Vec::new(),
            };
            let mut stepper = method.stepper(tolerance, Limits::default());
            let mut problem = Problem::new(3, ode::robertson);
            let end = run(&mut *stepper, &mut problem, 0.0, &[1.0, 0.0, 0.0], 1e11);
            let error = distance(
                &end,
                &[
                    2.083340149701255e-8,
                    8.333360770334713e-14,
                    0.999999979166505,
                ],
            );
            println!(
                "{method:?}, Robertson {r:e}: {error:.1e} {:?}",
                stepper.counters()
            );
            assert!(
                error < 1e-6 * r.sqrt() && problem.evaluations < most,
                "{method:?} at {r:e}: {error:e}"
            );
            assert_eq!(stepper.stiff(), method == Method::Auto);
        }
    }
}

/// A mass on a spring of 1 N/m with a damper of 1e5 N s/m, driven.
fn overdamped(t: f64, y: &[f64], dy: &mut [f64]) {
    (dy[0], dy[1]) = (y[1], t.cos() - y[0] - 1e5 * y[1]);
}

#[test]
fn auto_changes_once_and_stays() {
    let mut stepper = Method::Auto.stepper(tolerance(2, 1e-6), Limits::default());
    let mut problem = Problem::new(2, overdamped);
    stepper
        .start(&mut problem, 0.0, &[1.0, 0.0], 100.0)
        .unwrap();
    let (mut before, mut y) = (0, [0.0; 2]);
    while stepper.t() != 100.0 {
        stepper.step(&mut problem, 100.0).unwrap();
        assert!(stepper.previous() < stepper.t());
        stepper
            .interpolate(
                &mut problem,
                0.5 * (stepper.previous() + stepper.t()),
                &mut y,
            )
            .unwrap();
        assert!((y[0] - 1.0).abs() < 1e-2);
        before += u64::from(!stepper.stiff());
    }
    assert!(before < 100, "found stiff after {before} steps");
    assert!(stepper.counters().steps < 400, "{:?}", stepper.counters());
    // dop853 alone is bound by stability
    let mut explicit = Method::Dop853.stepper(tolerance(2, 1e-6), Limits::default());
    run(&mut *explicit, &mut problem, 0.0, &[1.0, 0.0], 1.0);
    assert!(explicit.counters().steps > 10_000);
    // started again, it knows
    let jacobians = stepper.counters().jacobians;
    run(&mut *stepper, &mut problem, 0.0, &[1.0, 0.0], 1.0);
    assert!(stepper.counters().jacobians > jacobians && stepper.stiff());
}

/// Thirty oscillators, whose stiffness changes, that an explicit method follows at the edge of its stability: an implicit one that has to follow them as
/// well takes more evaluations, most of them for its Jacobians.
#[test]
fn auto_goes_back_where_implicit_steps_cost_more() {
    let vibrations = |t: f64, y: &[f64], dy: &mut [f64]| {
        for (k, (dy, y)) in dy.chunks_exact_mut(2).zip(y.chunks_exact(2)).enumerate() {
            let stiffness = 1e4 * (1.0 + 0.1 * k as f64) * (1.0 + 0.2 * (20.0 * t).sin());
            (dy[0], dy[1]) = (
                y[1],
                1e3 * (30.0 * t).cos() - stiffness * y[0] - 350.0 * y[1],
            );
        }
    };
    let start = [0.1, 0.0].repeat(30);
    let evaluations = |method: Method| {
        let mut tolerance = tolerance(60, 1e-2);
        tolerance.atol.fill(3e-2);
        let mut stepper = method.stepper(tolerance, Limits::default());
        run(
            &mut *stepper,
            &mut Problem::new(60, vibrations),
            0.0,
            &start,
            100.0,
        );
        println!("{method:?} {:?}", stepper.counters());
        stepper.counters()
    };
    let [auto, explicit, implicit] = [Method::Auto, Method::Dop853, Method::Radau].map(evaluations);
    assert!(
        implicit.evaluations > explicit.evaluations,
        "{implicit:?}, {explicit:?}"
    );
    assert!(auto.jacobians > 0, "there was no trial: {auto:?}");
    let more = auto.evaluations as f64 / explicit.evaluations as f64;
    assert!(more < 1.1, "{auto:?}, {explicit:?}");
}

#[test]
fn smooth_motion_is_not_found_stiff() {
    for solved in &SOLVED {
        for power in 2..=10 {
            let mut stepper = Dop853::new(
                tolerance(solved.start().len(), 10_f64.powi(-power)),
                Limits::default(),
            );
            run(
                &mut stepper,
                &mut solved.problem(),
                0.0,
                &solved.start(),
                1000.0,
            );
            assert!(!stepper.stiff(), "{} at 1e-{power}", solved.name);
        }
    }
}

/// Watches that the last evaluation before `accept` is at the point accepted.
struct Watched(Problem, f64, Vec<f64>);

impl Ode for Watched {
    fn dimension(&self) -> usize {
        self.0.n
    }

    fn eval(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused> {
        (self.1, self.2) = (t, y.to_vec());
        self.0.eval(t, y, dy)
    }

    fn accept(&mut self, t: f64, y: &[f64]) {
        assert!(t == self.1 && y == self.2);
        self.0.accept(t, y);
    }
}
