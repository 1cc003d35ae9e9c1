//! Hock and Schittkowski, Test Examples for Nonlinear Programming Codes, 1981, by their numbers, from the starts given there.

use super::*;

fn run(
    f: impl Fn(&[f64]) -> Vec<f64>,
    kinds: &[Kind],
    ranges: &[[f64; 2]],
    start: &[f64],
) -> (Optimum, usize) {
    let mut count = 0;
    let mut counted = |x: &[f64]| {
        count += 1;
        Outcome::of(f(x))
    };
    let found = minimise(
        &mut counted,
        kinds,
        &Bounds::new(ranges),
        start,
        &Settings::default(),
    );
    (found, count)
}

fn assert_near(found: &Optimum, value: f64, x: &[f64], within: [f64; 2]) {
    assert!(
        (found.values[0] - value).abs() <= within[0],
        "{found:?} is not {value}"
    );
    for (found_x, x) in found.x.iter().zip(x) {
        assert!((found_x - x).abs() <= within[1], "{found:?} is not at {x}");
    }
}

fn assert_kept(found: &Optimum, kinds: &[Kind]) {
    for (kind, value) in kinds.iter().zip(&found.values[1..]) {
        assert!(kind.violation(*value) <= 1e-9, "{found:?}");
    }
}

#[test]
fn hock_schittkowski_1_rosenbrock() {
    let f = |x: &[f64]| vec![100.0 * (x[1] - x[0] * x[0]).powi(2) + (1.0 - x[0]).powi(2)];
    let (found, count) = run(f, &[], &[[-10.0, 10.0], [-1.5, 10.0]], &[-2.0, 1.0]);
    assert_eq!(found.ended, Ended::Optimum, "{found:?}");
    assert_near(&found, 0.0, &[1.0, 1.0], [1e-10, 1e-5]);
    assert!(count < 400, "{count}");
}

#[test]
fn hock_schittkowski_6() {
    let kinds = [Kind::Equal];
    let f = |x: &[f64]| vec![(1.0 - x[0]).powi(2), 10.0 * (x[1] - x[0] * x[0])];
    let (found, count) = run(f, &kinds, &[[-10.0, 10.0]; 2], &[-1.2, 1.0]);
    assert_eq!(found.ended, Ended::Optimum, "{found:?}");
    assert_near(&found, 0.0, &[1.0, 1.0], [1e-10, 1e-5]);
    assert_kept(&found, &kinds);
    assert!(count < 400, "{count}");
}

#[test]
fn hock_schittkowski_7() {
    let kinds = [Kind::Equal];
    let f = |x: &[f64]| {
        let square = 1.0 + x[0] * x[0];
        vec![square.ln() - x[1], square * square + x[1] * x[1] - 4.0]
    };
    let (found, _) = run(f, &kinds, &[[-10.0, 10.0]; 2], &[2.0, 2.0]);
    assert_eq!(found.ended, Ended::Optimum, "{found:?}");
    assert_near(
        &found,
        -(3.0_f64.sqrt()),
        &[0.0, 3.0_f64.sqrt()],
        [1e-8, 1e-5],
    );
    assert_kept(&found, &kinds);
}

/// Its second derivatives vanish at the optimum (1, 1, 1), so that the way there is long.
#[test]
fn hock_schittkowski_26() {
    let kinds = [Kind::Equal];
    let f = |x: &[f64]| {
        vec![
            (x[0] - x[1]).powi(2) + (x[1] - x[2]).powi(4),
            (1.0 + x[1] * x[1]) * x[0] + x[2].powi(4) - 3.0,
        ]
    };
    let (found, _) = run(f, &kinds, &[[-10.0, 10.0]; 3], &[-2.6, 2.0, 2.0]);
    assert_eq!(found.ended, Ended::Optimum, "{found:?}");
    assert_near(&found, 0.0, &[1.0; 3], [1e-7, 3e-2]);
    assert_kept(&found, &kinds);
}

#[test]
fn hock_schittkowski_71() {
    let kinds = [Kind::AtMost, Kind::Equal];
    let f = |x: &[f64]| {
        vec![
            x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2],
            25.0 - x[0] * x[1] * x[2] * x[3],
            x.iter().map(|x| x * x).sum::<f64>() - 40.0,
        ]
    };
    let (found, count) = run(f, &kinds, &[[1.0, 5.0]; 4], &[1.0, 5.0, 5.0, 1.0]);
    assert_eq!(found.ended, Ended::Optimum, "{found:?}");
    let x = [1.0, 4.7429994, 3.8211503, 1.3794082];
    assert_near(&found, 17.0140173, &x, [1e-7, 1e-6]);
    assert_kept(&found, &kinds);
    assert!((found.multipliers[0] - 0.5522937).abs() < 1e-5, "{found:?}");
    assert!((found.multipliers[1] - 0.1614686).abs() < 1e-5, "{found:?}");
    assert_eq!(found.x[0], 1.0, "the bound itself");
    assert!(count < 400, "{count}");
}

#[test]
fn hock_schittkowski_100() {
    let kinds = [Kind::AtMost; 4];
    let f = |x: &[f64]| {
        let p = |x: f64, n: i32| x.powi(n);
        vec![
            p(x[0] - 10.0, 2)
                + 5.0 * p(x[1] - 12.0, 2)
                + p(x[2], 4)
                + 3.0 * p(x[3] - 11.0, 2)
                + 10.0 * p(x[4], 6)
                + 7.0 * p(x[5], 2)
                + p(x[6], 4)
                - 4.0 * x[5] * x[6]
                - 10.0 * x[5]
                - 8.0 * x[6],
            2.0 * p(x[0], 2) + 3.0 * p(x[1], 4) + x[2] + 4.0 * p(x[3], 2) + 5.0 * x[4] - 127.0,
            7.0 * x[0] + 3.0 * x[1] + 10.0 * p(x[2], 2) + x[3] - x[4] - 282.0,
            23.0 * x[0] + p(x[1], 2) + 6.0 * p(x[5], 2) - 8.0 * x[6] - 196.0,
            4.0 * p(x[0], 2) + p(x[1], 2) - 3.0 * x[0] * x[1] + 2.0 * p(x[2], 2) + 5.0 * x[5]
                - 11.0 * x[6],
        ]
    };
    let (found, _) = run(
        f,
        &kinds,
        &[[-10.0, 10.0]; 7],
        &[1.0, 2.0, 0.0, 4.0, 0.0, 1.0, 1.0],
    );
    assert_eq!(found.ended, Ended::Optimum, "{found:?}");
    let x = [
        2.330499, 1.951372, -0.4775414, 4.365726, -0.6244870, 1.038131, 1.594227,
    ];
    assert_near(&found, 680.6300573, &x, [1e-6, 1e-4]);
    assert_kept(&found, &kinds);
}

/// x ≤ −1 within 0 ≤ x ≤ 1.
#[test]
fn constraints_that_cannot_be_kept_are_said() {
    let kinds = [Kind::AtMost];
    let (found, _) = run(
        |x| vec![x[0] * x[0], x[0] + 1.0],
        &kinds,
        &[[0.0, 1.0]],
        &[0.7],
    );
    assert_eq!(found.ended, Ended::Infeasible, "{found:?}");
    assert!(found.x[0] < 1e-9, "{found:?}");
}

/// The least largest of two, where slopes jump: x₀² = (x₀ − 2)²/4 at x₀ = ⅔. Differences see it blurred by their step, 2.4e-5,
/// which leaves the second variable, of whose distance the square counts, open by the root of that.
#[test]
fn a_kink_is_found() {
    let f =
        |x: &[f64]| vec![(x[0] * x[0]).max(0.25 * (x[0] - 2.0).powi(2)) + (x[1] - x[0]).powi(2)];
    let (found, _) = run(f, &[], &[[-2.0, 2.0]; 2], &[1.5, 1.5]);
    assert_near(
        &found,
        4.0 / 9.0,
        &[2.0 / 3.0; 2],
        [2.4e-5, 2.4e-5_f64.sqrt()],
    );
    assert!(
        matches!(found.ended, Ended::Optimum | Ended::Stuck),
        "{found:?}"
    );
}

/// The optimum lies where values end, and beyond there are none.
#[test]
fn steps_to_nowhere_are_shortened() {
    let mut f = |x: &[f64]| match x[0] * x[0] + x[1] * x[1] > 1.0 {
        true => Outcome::Missing,
        false => Outcome::of(vec![(x[0] - 0.6).powi(2) + (x[1] - 0.7).powi(2)]),
    };
    let bounds = Bounds::new(&[[-5.0, 5.0]; 2]);
    let found = minimise(&mut f, &[], &bounds, &[-0.5, -0.5], &Settings::default());
    assert_eq!(found.ended, Ended::Optimum, "{found:?}");
    assert_near(&found, 0.0, &[0.6, 0.7], [1e-12, 1e-6]);
}

/// Madsen 1975: the greatest of three magnitudes is least, 0.61643244, where two are equal.
#[test]
fn a_least_greatest_of_several_is_an_optimum() {
    let pieces = |x: &[f64]| {
        let first = x[0] * x[0] + x[1] * x[1] + x[0] * x[1];
        [first, x[0].sin(), x[1].cos()]
    };
    let f = |x: &[f64]| vec![pieces(x).into_iter().map(f64::abs).fold(0.0, f64::max)];
    let (found, count) = run(f, &[], &[[-4.0, 4.0]; 2], &[3.0, 1.0]);
    println!("{found:?} after {count}");
    assert!(
        (found.values[0] - 0.616_432_43).abs() < 1e-5,
        "{found:?} after {count}"
    );
    assert_eq!(found.ended, Ended::Optimum, "{found:?}");
}

/// Charalambous and Bandler 1976 (CB2): 1.9522245 at (1.139038, 0.899560), from (1, −0.1).
#[test]
fn charalambous_bandler() {
    let f = |x: &[f64]| {
        let pieces = [
            x[0] * x[0] + x[1].powi(4),
            (2.0 - x[0]).powi(2) + (2.0 - x[1]).powi(2),
            2.0 * (x[1] - x[0]).exp(),
        ];
        vec![pieces.into_iter().fold(f64::NEG_INFINITY, f64::max)]
    };
    let (found, count) = run(f, &[], &[[-4.0, 4.0]; 2], &[1.0, -0.1]);
    println!("{found:?} after {count}");
    assert_near(&found, 1.952_224_5, &[1.139_038, 0.899_560], [1e-5, 1e-3]);
    assert_eq!(found.ended, Ended::Optimum, "{found:?}");
}
