//! Samples of a family against what is known of it without samples: V1 of the references, the bundled four-bar at 60°
//! whose four lengths have tolerances of 0.05 mm.

use linkdyn_engine::analysis::{Control, Family};
use linkdyn_model::{Given, bundled};
use linkdyn_study::design::{Design, Grid, Layout, Method, Samples};
use linkdyn_study::distribution::{Distribution, Shape};
use linkdyn_study::summary::Moments;

/// Crank, coupler, rocker, base.
const LENGTHS: [&str; 4] = ["crank", "coupler", "rocker", "base"];
/// Rocker angle \[rad\], with 40 digits cut to a double.
const NOMINAL: f64 = 1.702_781_923_353_858_6;
/// Its derivatives by the lengths [rad/m].
const GRADIENT: [f64; 4] = [4.730_382_752, -4.410_178_112, -5.287_010_607, 1.718_278_408];
/// Tolerance of each length \[m\], at three standard deviations.
const TOLERANCE: f64 = 5e-5;

fn family() -> Family {
    let text = bundled::find("four-bar").expect("bundled").text;
    let sets = [
        "analysis={\"type\":\"kinematics\",\"end\":1e-3,\"outputs\":2}",
        "responses.swing=first(rocker.angle)",
    ];
    let loaded = linkdyn_model::load(text.as_bytes(), &sets.map(str::to_owned)).expect("sound");
    let family = Family::new(&loaded, &LENGTHS, Given::Deviations).expect("it runs");
    assert!(family.is_tracked());
    family
}

fn scatter() -> Distribution {
    let normal = Shape::Normal { sigma: 3.0 };
    Distribution::new(normal, -TOLERANCE, TOLERANCE).expect("limits")
}

/// Moments of the angle's deviation over samples.
fn moments(family: &Family, method: Method, points: u64, seed: u64) -> Moments {
    let grid = Grid::new(Vec::new()).expect("one point");
    let samples = Samples::new(method, Layout::Plain, points, LENGTHS.len(), seed);
    let scatter = vec![scatter(); LENGTHS.len()];
    let design = Design::of_samples(grid, samples.expect("some"), scatter).expect("they fit");
    let mut member = family.begin();
    let (mut row, mut angle) = ([0.0; LENGTHS.len()], [0.0]);
    let mut moments = Moments::default();
    for number in 0..points {
        design.row(number, &mut row);
        let ended = member.run(&row, &Control::default(), &mut angle);
        assert_eq!(ended.expect("sound").missing, None);
        moments.push(angle[0] - NOMINAL);
    }
    moments
}

#[test]
fn mean_and_deviation_are_within_three_standard_errors() {
    let points = 100_000;
    let family = family();
    let squares = GRADIENT.map(|slope| (slope * scatter().deviation()).powi(2));
    let expected = squares.iter().sum::<f64>().sqrt();
    for (method, seed) in [(Method::MonteCarlo, 1), (Method::MonteCarlo, 2)] {
        let found = moments(&family, method, points, seed);
        let (mean, deviation) = (
            found.mean().expect("some"),
            found.deviation().expect("some"),
        );
        let n = points as f64;
        // The mean is off by half the curvature times the variances, a ten-thousandth of the deviation.
        assert!(
            mean.abs() <= 3.0 * expected / n.sqrt(),
            "seed {seed}: mean {mean:e}"
        );
        let error = (deviation - expected).abs();
        assert!(
            error <= 3.0 * expected / (2.0 * n).sqrt(),
            "seed {seed}: deviation {deviation:e}, not {expected:e}"
        );
    }
}

/// By a straight line through the logarithms.
fn order(errors: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = errors.iter().map(|(n, e)| (n.ln(), e.ln())).collect();
    let count = logs.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|log| log.0), mean(|log| log.1));
    let over: f64 = logs.iter().map(|log| (log.0 - x) * (log.1 - y)).sum();
    over / logs.iter().map(|log| (log.0 - x).powi(2)).sum::<f64>()
}

#[test]
fn the_error_of_sobol_points_falls_faster_than_that_of_random_ones() {
    let family = family();
    let sobol = Method::Sobol { scrambled: true };
    let mean = |method, points, seed| moments(&family, method, points, seed).mean().expect("some");
    let exact = (0..4)
        .map(|seed| mean(sobol, 1 << 16, 100 + seed))
        .sum::<f64>()
        / 4.0;
    let fall = |method: Method| {
        let errors = (6..=12).map(|power| {
            let points = 1_u64 << power;
            let squares = (0..12).map(|seed| (mean(method, points, seed) - exact).powi(2));
            (points as f64, (squares.sum::<f64>() / 12.0).sqrt())
        });
        order(&errors.collect::<Vec<_>>())
    };
    let (sobol, random) = (fall(sobol), fall(Method::MonteCarlo));
    assert!(sobol <= -0.9, "as N^{sobol:.3}");
    assert!(
        (-0.75..=-0.3).contains(&random),
        "random points as N^{random:.3}"
    );
}
