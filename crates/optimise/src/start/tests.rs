use super::*;
use crate::curve::{Node, residuals};
use std::f64::consts::{PI, TAU};

fn start(number: u64, points: u64, descents: usize) -> Start {
    Start {
        seed: 1,
        number,
        points,
        descents,
    }
}

/// Rastrigin 1974 in two variables: a valley around every whole number, the deepest at 0.
#[test]
fn starts_find_the_deepest_of_many_valleys() {
    let f = |x: &[f64]| {
        let each = x.iter().map(|x| x * x + 10.0 - 10.0 * (TAU * x).cos());
        Outcome::of(vec![each.sum()])
    };
    let bounds = Bounds::new(&[[-4.7, 5.2]; 2]);
    let settings = constrained::Settings::default();
    let find = |number| {
        let found = optimise(
            &mut { f },
            &[],
            &bounds,
            &start(number, 256, 4),
            None,
            &settings,
        );
        found.expect("two variables")
    };
    let all: Vec<Optimum> = (0..20).map(find).collect();
    let deepest = all
        .iter()
        .filter(|found| found.values[0].abs() < 1e-9)
        .count();
    assert!(deepest >= 5, "{deepest} of 20");
    // A start is the same whenever it is made.
    assert_eq!(find(7), all[7]);
    assert_ne!(all[6].x, all[7].x);
}

/// Place and two derivatives of a coupler point by closed form, in series of three terms.
fn four_bar(x: &[f64]) -> Option<Vec<Node>> {
    let [crank, coupler, rocker, px, py] = x else {
        return None;
    };
    let base = 300.0;
    let all = [base, *crank, *coupler, *rocker];
    let (least, most) = (
        all.iter().copied().fold(base, f64::min),
        all.iter().copied().fold(0.0, f64::max),
    );
    if least + most >= 0.499_99 * all.iter().sum::<f64>() || *crank > least {
        return None;
    }
    let count = 145;
    let node = |k: usize| {
        let s = TAU * k as f64 / f64::from(count - 1);
        let (sin, cos) = s.sin_cos();
        let a = [
            [crank * cos, -crank * sin, -crank * cos],
            [crank * sin, crank * cos, -crank * sin],
        ];
        // From the crankpin to the rocker's pivot: square of its length, angle.
        let (gx, gy) = (
            [base - a[0][0], -a[0][1], -a[0][2]],
            [-a[1][0], -a[1][1], -a[1][2]],
        );
        let square = [
            gx[0] * gx[0] + gy[0] * gy[0],
            2.0 * (gx[0] * gx[1] + gy[0] * gy[1]),
            2.0 * (gx[1] * gx[1] + gx[0] * gx[2] + gy[1] * gy[1] + gy[0] * gy[2]),
        ];
        let d = square[0].sqrt();
        let d = [
            d,
            square[1] / (2.0 * d),
            square[2] / (2.0 * d) - square[1] * square[1] / (4.0 * d * d * d),
        ];
        let turn = gx[0] * gy[1] - gy[0] * gx[1];
        let bend = gx[0] * gy[2] - gy[0] * gx[2];
        let angle = [
            gy[0].atan2(gx[0]),
            turn / square[0],
            bend / square[0] - turn * square[1] / (square[0] * square[0]),
        ];
        // cos of the angle at the crankpin: (l² + d² − r²)/(2 l d).
        let part = coupler * coupler - rocker * rocker;
        let c = (d[0] + part / d[0]) / (2.0 * coupler);
        let by_d = (1.0 - part / (d[0] * d[0])) / (2.0 * coupler);
        let by_dd = part / (d[0] * d[0] * d[0]) / coupler;
        let (c1, c2) = (by_d * d[1], by_d * d[2] + by_dd * d[1] * d[1]);
        let root = (1.0 - c * c).sqrt();
        let beta = [
            angle[0] + c.acos(),
            angle[1] - c1 / root,
            angle[2] - c2 / root - c * c1 * c1 / (root * root * root),
        ];
        let (sin, cos) = beta[0].sin_cos();
        let arm = [px * cos - py * sin, px * sin + py * cos];
        let across = [-arm[1], arm[0]];
        let of = |k: usize| {
            let first = a[k][1] + across[k] * beta[1];
            let second = a[k][2] + across[k] * beta[2] - arm[k] * beta[1] * beta[1];
            [a[k][0] + arm[k], first, second]
        };
        let (x, y) = (of(0), of(1));
        Node {
            s,
            p: [x[0], y[0]],
            d: [x[1], y[1]],
            dd: [x[2], y[2]],
        }
    };
    Some((0..count as usize).map(node).collect())
}

/// The bundled four-bar: from 25 points of its coupler's curve all but its base is found again, by every start.
#[test]
fn a_coupler_curve_is_found_again() {
    let truth = [100.0, 250.0, 200.0, 125.0, 80.0];
    let points: Vec<[f64; 2]> = four_bar(&truth)
        .expect("a crank")
        .iter()
        .step_by(6)
        .map(|node| node.p)
        .collect();
    assert_eq!(points.len(), 25);
    let bounds = Bounds::new(&[
        [50.0, 400.0],
        [50.0, 400.0],
        [50.0, 400.0],
        [-250.0, 250.0],
        [-250.0, 250.0],
    ]);
    let mut steps = 0;
    for number in 0..5 {
        let mut f = |x: &[f64]| {
            steps += 1;
            let nodes = four_bar(x).and_then(|nodes| residuals(&nodes, &points));
            nodes.map_or(Outcome::Missing, Outcome::of)
        };
        let settings = least_squares::Settings {
            enough: 1e-9,
            ..least_squares::Settings::default()
        };
        let found =
            fit(&mut f, &bounds, &start(number, 64, 40), None, &settings).expect("five variables");
        let worst = found
            .residuals
            .iter()
            .fold(0.0_f64, |most, r| most.max(r.abs()));
        assert!(worst < 1e-8, "start {number}: {worst} mm, {found:?}");
    }
    assert!(steps < 60_000, "{steps}");
}

/// What is known to be good is tried first; points are spread over all starts.
#[test]
fn the_given_point_comes_first() {
    let mut f = |x: &[f64]| Outcome::of(vec![(x[0] - 2.0).powi(2), 0.3 * (PI * x[0]).sin()]);
    let bounds = Bounds::new(&[[-10.0, 10.0]]);
    let settings = least_squares::Settings::default();
    let found =
        fit(&mut f, &bounds, &start(0, 8, 1), Some(&[1.9]), &settings).expect("one variable");
    assert!((found.x[0] - 2.0).abs() < 1e-6, "{found:?}");
    let mut seen: Vec<f64> = (0..4)
        .flat_map(|number| {
            start(number, 8, 1)
                .candidates(&bounds)
                .expect("one variable")
        })
        .map(|x| x[0])
        .collect();
    seen.sort_by(f64::total_cmp);
    for (k, x) in seen.iter().enumerate() {
        let stratum = ((x + 10.0) / 20.0 * 32.0).floor();
        assert_eq!(stratum, k as f64, "{seen:?}");
    }
}

#[test]
fn being_stopped_leaves_the_best() {
    let mut left = 40;
    let mut f = |x: &[f64]| {
        left -= 1;
        match left < 0 {
            true => Outcome::Stopped,
            false => Outcome::of(vec![x[0] - 0.3, (x[1] - 0.4).sin() + x[0]]),
        }
    };
    let bounds = Bounds::new(&[[0.0, 1.0]; 2]);
    let found = fit(
        &mut f,
        &bounds,
        &start(0, 32, 9),
        None,
        &least_squares::Settings::default(),
    );
    let found = found.expect("two variables");
    assert_eq!(found.ended, Ended::Stopped);
    assert_eq!(found.residuals.len(), 2, "{found:?}");
}

#[test]
fn being_stopped_early_leaves_the_best_that_was_seen() {
    let bounds = Bounds::new(&[[0.0, 1.0]]);
    for most in [0, 9] {
        let mut left = most;
        let mut seen = f64::INFINITY;
        let mut f = |x: &[f64]| {
            if left == 0 {
                return Outcome::Stopped;
            }
            left -= 1;
            seen = seen.min((x[0] - 0.3).abs());
            Outcome::of(vec![x[0] - 0.3])
        };
        let settings = least_squares::Settings::default();
        let found = fit(&mut f, &bounds, &start(0, 32, 9), None, &settings).expect("one variable");
        assert_eq!(found.ended, Ended::Stopped);
        assert_eq!(found.residuals.is_empty(), most == 0, "{found:?}");
        if most > 0 {
            assert_eq!((found.x[0] - 0.3).abs(), seen);
        }
    }
}
