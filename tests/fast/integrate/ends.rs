//! Ends, refusals and what the problem is told.

use super::*;

#[test]
fn ends_are_hit_exactly_both_ways() {
    for method in Method::ALL {
        for (start, end) in [
            (0.0, 3.3),
            (1.0, -2.1),
            (0.1, 0.1 + 1e-12),
            (5.0, 5.0),
            (-7.7, 1e3 / 3.0),
        ] {
            let mut stepper = method.stepper(tolerance(2, 1e-8), Limits::default());
            let y = ode::harmonic_at(start);
            let reached = run(
                &mut *stepper,
                &mut Problem::new(2, ode::harmonic),
                start,
                &y,
                end,
            );
            assert_eq!(stepper.t(), end);
            let error = distance(&reached, &ode::harmonic_at(end));
            assert!(error < 1e-6, "{method:?} from {start} to {end}: {error:e}");
        }
        // ends one after the other, closer than a step
        let mut stepper = method.stepper(
            tolerance(2, 1e-8),
            Limits {
                max_step: Some(0.3),
                ..Limits::default()
            },
        );
        let mut problem = Problem::new(2, ode::harmonic);
        stepper.start(&mut problem, 0.0, &[1.0, 0.0], 0.01).unwrap();
        for i in 1..=500 {
            let end = f64::from(i) * 0.01;
            while stepper.t() != end {
                stepper.step(&mut problem, end).unwrap();
                assert!(stepper.t() <= end && stepper.t() - stepper.previous() <= 0.3 + 1e-15);
            }
        }
        assert!(stepper.counters().steps < 520, "{:?}", stepper.counters());
        let before = stepper.counters().steps;
        run(&mut *stepper, &mut problem, 0.0, &[1.0, 0.0], 30.0);
        assert!(
            stepper.counters().steps - before >= 100,
            "no step above 0.3"
        );
    }
}

#[test]
fn refusals_shorten_steps_and_end_in_failure() {
    for method in Method::ALL {
        // never beyond 1.0001, where bold steps lead
        let mut stepper = method.stepper(
            tolerance(2, 1e-5),
            Limits {
                initial_step: Some(3.0),
                ..Limits::default()
            },
        );
        let mut problem = Problem {
            allowed: |_, y| y[0].abs() < 1.0001,
            ..Problem::new(2, ode::harmonic)
        };
        let end = run(&mut *stepper, &mut problem, 0.0, &[1.0, 0.0], 20.0);
        assert!(distance(&end, &ode::harmonic_at(20.0)) < 1e-3 && stepper.counters().rejected > 0);

        // a wall at 1 that motion runs into, first as a refusal, then as values that are not finite
        let walls: [Problem; 2] = [
            Problem {
                allowed: |_, y| y[0] <= 1.0,
                ..Problem::new(1, |_, _, dy| dy[0] = 1.0)
            },
            Problem::new(1, |_, y, dy| {
                dy[0] = if y[0] <= 1.0 { 1.0 } else { f64::NAN }
            }),
        ];
        for mut problem in walls {
            let mut stepper = method.stepper(tolerance(1, 1e-6), Limits::default());
            stepper.start(&mut problem, 0.0, &[0.0], 9.0).unwrap();
            let failure = loop {
                if let Err(failure) = stepper.step(&mut problem, 9.0) {
                    break failure;
                }
            };
            let StepFailure::Refused { t } = failure else {
                panic!("{failure}")
            };
            assert!(
                (t - 1.0).abs() < 1e-12 && t == stepper.t() && stepper.y()[0] <= 1.0,
                "{method:?}: {failure}"
            );
            assert!(
                problem.evaluations < 5000,
                "{method:?}: {} evaluations",
                problem.evaluations
            );
            // what is left is the last accepted point
            let mut y = [0.0];
            stepper.interpolate(&mut problem, t, &mut y).unwrap();
            assert!(y == stepper.y() && stepper.previous() == t);
            assert!(stepper.step(&mut problem, 9.0).is_err(), "and again");
        }

        let mut problem = Problem {
            allowed: |_, _| false,
            ..Problem::new(1, |_, _, dy| dy[0] = 1.0)
        };
        let mut stepper = method.stepper(tolerance(1, 1e-6), Limits::default());
        assert_eq!(
            stepper.start(&mut problem, 2.0, &[0.0], 9.0),
            Err(StepFailure::Refused { t: 2.0 })
        );
    }
}

#[test]
fn poles_end_in_steps_too_small() {
    for method in Method::ALL {
        let limits = Limits {
            min_step: Some(1e-9),
            ..Limits::default()
        };
        let mut stepper = method.stepper(tolerance(1, 1e-6), limits);
        let mut problem = Problem::new(1, |_, y, dy| dy[0] = y[0] * y[0]);
        stepper.start(&mut problem, 0.0, &[1.0], 2.0).unwrap();
        let failure = loop {
            if let Err(failure) = stepper.step(&mut problem, 2.0) {
                break failure;
            }
        };
        let StepFailure::TooSmall { t, h } = failure else {
            panic!("{failure}")
        };
        assert!((t - 1.0).abs() < 1e-5 && h < 1e-9, "{method:?}: {failure}");
    }
}

#[test]
fn accepted_points_are_the_last_evaluated() {
    for method in Method::ALL {
        let mut watched = Watched(Problem::new(4, ode::kepler), 0.0, Vec::new());
        let mut stepper = method.stepper(tolerance(4, 1e-6), Limits::default());
        run(&mut *stepper, &mut watched, 0.0, &ode::kepler_at(0.0), 20.0);
        assert_eq!(watched.0.accepted, stepper.counters().steps + 1);
        assert_eq!(watched.0.evaluations, stepper.counters().evaluations);
    }
}

#[test]
fn runs_repeat_bit_by_bit() {
    for method in Method::ALL {
        for f in [ode::van_der_pol, ode::pendulum] {
            let bits = |stepper: &mut dyn Stepper| {
                let y = run(stepper, &mut Problem::new(2, f), 0.0, &[2.0, 0.0], 20.0);
                y.into_iter().map(f64::to_bits).collect::<Vec<_>>()
            };
            let [mut one, mut other] =
                [(); 2].map(|()| method.stepper(tolerance(2, 1e-6), Limits::default()));
            let first = bits(&mut *one);
            assert_eq!(first, bits(&mut *other));
            // a stepper used before gives the same, but for auto, which has learnt
            if method != Method::Auto {
                assert_eq!(first, bits(&mut *one));
            }
        }
    }
}
