use super::*;

fn fit(f: &mut Function, ranges: &[[f64; 2]], start: &[f64]) -> Fitted {
    least_squares(f, &Bounds::new(ranges), start, &Settings::default())
}

/// Rosenbrock 1960: zero at (1, 1).
#[test]
fn rosenbrock() {
    let mut f = |x: &[f64]| Outcome::of(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]);
    let found = fit(&mut f, &[[-10.0, 10.0]; 2], &[-1.2, 1.0]);
    assert_eq!(found.ended, Ended::Solved, "{found:?}");
    assert!(found.x.iter().all(|x| (x - 1.0).abs() < 1e-12), "{found:?}");
}

/// Powell 1970, problem 3 of Moré, Garbow, Hillstrom 1981: zero at (1.098…e-5, 9.106…).
#[test]
fn powell_badly_scaled() {
    let mut f = |x: &[f64]| {
        Outcome::of(vec![
            1e4 * x[0] * x[1] - 1.0,
            (-x[0]).exp() + (-x[1]).exp() - 1.0001,
        ])
    };
    let found = fit(&mut f, &[[0.0, 20.0]; 2], &[0.0, 1.0]);
    assert_eq!(found.ended, Ended::Solved, "{found:?}");
    assert!((found.x[0] / 1.098159e-5 - 1.0).abs() < 1e-6, "{found:?}");
    assert!((found.x[1] / 9.106146 - 1.0).abs() < 1e-6, "{found:?}");
}

/// Kowalik and Osborne 1968, problem 15 of Moré, Garbow, Hillstrom 1981: 3.07505…e-4.
#[test]
fn kowalik_osborne() {
    let y = [
        0.1957, 0.1947, 0.1735, 0.1600, 0.0844, 0.0627, 0.0456, 0.0342, 0.0323, 0.0235, 0.0246,
    ];
    let u = [
        4.0, 2.0, 1.0, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625,
    ];
    let mut f = |x: &[f64]| {
        let of = |(y, u): (&f64, &f64)| y - x[0] * (u * u + u * x[1]) / (u * u + u * x[2] + x[3]);
        Outcome::of(y.iter().zip(&u).map(of).collect())
    };
    let found = fit(&mut f, &[[0.0, 1.0]; 4], &[0.25, 0.39, 0.415, 0.39]);
    assert_eq!(found.ended, Ended::Minimum, "{found:?}");
    let sum = 2.0 * cost(&found.residuals);
    assert!((sum - 3.07505e-4).abs() < 1e-9, "{sum}");
    assert!(found.slope < 1e-7, "{}", found.slope);
}

/// The nearest point of a box: (2, 1) from (3, 0.5), with a bound that holds and one that does not.
#[test]
fn bounds_hold() {
    let mut f = |x: &[f64]| {
        assert!(
            (0.0..=2.0).contains(&x[0]) && (1.0..=5.0).contains(&x[1]),
            "{x:?}"
        );
        Outcome::of(vec![x[0] - 3.0, x[1] - 0.5, 0.1 * (x[2] - 0.25).powi(2)])
    };
    let found = fit(
        &mut f,
        &[[0.0, 2.0], [1.0, 5.0], [0.0, 1.0]],
        &[0.5, 4.0, 0.9],
    );
    assert_eq!(found.x[..2], [2.0, 1.0], "{found:?}");
    assert!((found.x[2] - 0.25).abs() < 1e-3, "{found:?}");
}

/// √x − 0.1 from 1, where a full step leads to negative x: no value is there.
#[test]
fn a_step_to_nowhere_is_shortened() {
    let mut missed = 0;
    let mut f = |x: &[f64]| match x[0] < 0.0 {
        true => {
            missed += 1;
            Outcome::Missing
        }
        false => Outcome::of(vec![x[0].sqrt() - 0.1]),
    };
    let found = fit(&mut f, &[[-1.0, 3.0]], &[1.0]);
    assert_eq!(found.ended, Ended::Solved, "{found:?}");
    assert!((found.x[0] - 0.01).abs() < 1e-13, "{found:?}");
    assert!(missed > 0);
}

#[test]
fn no_values_at_all_and_being_stopped_are_said() {
    let found = fit(&mut |_: &[f64]| Outcome::Missing, &[[0.0, 1.0]], &[0.5]);
    assert_eq!((found.ended, found.residuals), (Ended::NoValues, vec![]));
    let mut left = 7;
    let mut f = |x: &[f64]| {
        left -= 1;
        match left {
            0 => Outcome::Stopped,
            _ => Outcome::of(vec![x[0].exp() - 4.0]),
        }
    };
    let found = fit(&mut f, &[[0.0, 5.0]], &[0.5]);
    assert_eq!(found.ended, Ended::Stopped);
    assert_eq!(found.residuals.len(), 1);
}
