use std::f64::consts::PI;

use super::*;
use crate::design::{Layout, Method, Samples};

/// Ishigami and Homma 1990, a = 7, b = 0.1, of three numbers from −π to π.
fn ishigami(x: &[f64]) -> f64 {
    let (first, second, third) = (x[0].sin(), x[1].sin(), x[2].powi(4));
    first + 7.0 * second * second + 0.1 * third * first
}

fn collect(points: u64, method: Method, seed: u64) -> SobolIndices {
    let samples = Samples::new(method, Layout::Saltelli, points, 3, seed).expect("legal");
    let mut all = SobolIndices::new(3);
    let mut u = [0.0; 3];
    for point in 0..points {
        let rows = (0..5).map(|part| {
            samples.row(5 * point + part, &mut u);
            ishigami(&u.map(|u| PI * (2.0 * u - 1.0)))
        });
        all.push(&rows.collect::<Vec<f64>>());
    }
    all
}

/// The closed form: V = a²/8 + bπ⁴/5 + b²π⁸/18 + 1/2, V₁ = (1 + bπ⁴/5)²/2, V₂ = a²/8, V₁₃ = 8 b²π⁸/225.
fn closed_form() -> ([f64; 3], [f64; 3]) {
    let (a, b) = (7.0_f64, 0.1_f64);
    let v = a * a / 8.0 + b * PI.powi(4) / 5.0 + b * b * PI.powi(8) / 18.0 + 0.5;
    let v1 = 0.5 * (1.0 + b * PI.powi(4) / 5.0).powi(2);
    let (v2, v13) = (a * a / 8.0, 8.0 * b * b * PI.powi(8) / 225.0);
    ([v1 / v, v2 / v, 0.0], [(v1 + v13) / v, v2 / v, v13 / v])
}

#[test]
fn ishigami_has_the_published_indices() {
    let (first, total) = closed_form();
    // The digits that are published for it.
    for (found, printed) in first
        .iter()
        .chain(&total)
        .zip([0.3139, 0.4424, 0.0, 0.5576, 0.4424, 0.2437])
    {
        assert!((found - printed).abs() < 5e-5, "{found} {printed}");
    }
    // 2^14 scrambled Sobol points err by less than a third of the standard error of random ones, which is below 0.02 with 2^14.
    let found = collect(1 << 14, Method::Sobol { scrambled: true }, 1);
    let found = found.indices(1).expect("it scatters");
    for (found, expected) in found
        .first
        .iter()
        .chain(&found.total)
        .zip(first.iter().chain(&total))
    {
        println!("{expected:.4} {found:?}");
        assert!(
            (found.value - expected).abs() < 0.005,
            "{found:?} {expected}"
        );
        assert!(
            found.lower <= *expected && *expected <= found.upper,
            "{found:?} {expected}"
        );
        assert!(found.upper - found.lower < 0.08, "{found:?}");
    }
    assert_eq!((found.points, found.left_out), (1 << 14, 0));
}

/// Intervals of 95 % of random points hold the true index in about 95 % of studies: of 6 × 60 at least 90 %.
#[test]
fn intervals_hold_what_they_promise() {
    let (first, total) = closed_form();
    let mut held = 0;
    for seed in 0..60 {
        let found = collect(600, Method::MonteCarlo, seed)
            .indices(seed)
            .expect("it scatters");
        let all = found.first.iter().chain(&found.total);
        held += all
            .zip(first.iter().chain(&total))
            .filter(|(found, expected)| (found.lower..=found.upper).contains(expected))
            .count();
    }
    println!("{held} of 360");
    assert!((324..=356).contains(&held), "{held} of 360");
}

#[test]
fn points_with_a_row_without_value_are_left_out() {
    let mut all = SobolIndices::new(1);
    for point in 0..40 {
        let [a, b] = [f64::from(point * 7 % 11), f64::from(point * 5 % 13)];
        all.push(&[a, if point == 3 { f64::NAN } else { b }, b]);
    }
    let found = all.indices(0).expect("it scatters");
    assert_eq!((found.points, found.left_out), (39, 1));
    let mut still = SobolIndices::new(1);
    (0..5).for_each(|_| still.push(&[0.1, 0.1, 0.1]));
    assert_eq!(still.indices(0), None);
    assert_eq!(SobolIndices::new(2).indices(0), None);
}
