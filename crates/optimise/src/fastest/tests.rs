//! Closed forms, another formulation by another solver, and numbers of a third one.

use super::*;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT,
    SolverStatus, SupportedConeT,
};

fn grid(count: usize, length: f64) -> Vec<f64> {
    (0..=count)
        .map(|k| length * k as f64 / count as f64)
        .collect()
}

fn below(interval: usize, part: f64, of: Affine, most: f64) -> Limit {
    Limit {
        interval,
        part,
        of: Limited::Below(of),
        most,
        scale: most.abs(),
    }
}

const PACE: Affine = Affine {
    acceleration: 1.0,
    square: 0.0,
    rest: 0.0,
};
const SPEED: Affine = Affine {
    acceleration: 0.0,
    square: 1.0,
    rest: 0.0,
};

/// |ẍ| ≤ most in every interval.
fn paced(count: usize, most: f64) -> Vec<Limit> {
    let of = |k| [PACE, PACE.negative()].map(|of| below(k, 0.0, of, most));
    (0..count).flat_map(of).collect()
}

#[test]
fn bang_bang_takes_the_time_of_the_closed_form() {
    for (count, length, most) in [
        (2, 1.0, 1.0),
        (400, 3.0, 7.0),
        (400, 1e-3, 2e4),
        (3000, 50.0, 1e-3),
    ] {
        let nodes = grid(count, length);
        let limits = paced(count, most);
        let problem = Problem {
            nodes: &nodes,
            ends: [0.0, 0.0],
            limits: &limits,
        };
        let found = problem.solve().unwrap();
        let time = 2.0 * (length / most).sqrt();
        assert!(
            (found.time / time - 1.0).abs() < 1e-11,
            "{} {time}",
            found.time
        );
        assert!(found.gap < 1e-11, "{}", found.gap);
        // T goes with the root of the limit.
        let worth: f64 = found.worth.iter().sum();
        assert!((worth / (0.5 * time) - 1.0).abs() < 1e-6, "{worth} {time}");
    }
}

#[test]
fn a_trapezoid_takes_the_time_of_the_closed_form() {
    let (count, length, most, speed) = (400, 2.0, 5.0, 2.0_f64);
    let nodes = grid(count, length);
    let mut limits = paced(count, most);
    limits.extend((0..count).map(|k| below(k, 1.0, SPEED, speed * speed)));
    let problem = Problem {
        nodes: &nodes,
        ends: [0.0, 0.0],
        limits: &limits,
    };
    let found = problem.solve().unwrap();
    let time = length / speed + speed / most;
    assert!(
        (found.time / time - 1.0).abs() < 1e-11,
        "{} {time}",
        found.time
    );
    let kept = found.squares.iter().all(|b| *b <= 4.0 * (1.0 + 1e-9));
    assert!(kept && (found.squares[200] - 4.0).abs() < 1e-8);
}

/// Torque, speed and the forces of `joints` pins along a path that bends.
fn bent(count: usize, joints: usize) -> (Vec<f64>, Vec<Limit>) {
    let nodes = grid(count, 1.0);
    let mut limits = Vec::new();
    for interval in 0..count {
        for part in [0.0, 1.0] {
            let (sin, cos) = (3.0 * (interval as f64 + part) / count as f64).sin_cos();
            let of = |acceleration, square, rest| Affine {
                acceleration,
                square,
                rest,
            };
            let torque = of(1.0 + 0.3 * cos, -0.45 * sin, 0.5 * cos);
            let force = [of(cos, -sin, 0.2), of(sin, cos, 0.3)];
            limits.extend([torque, torque.negative()].map(|of| below(interval, part, of, 1.5)));
            limits.extend((0..joints).map(|joint| Limit {
                interval,
                part,
                of: Limited::Within(force),
                most: 1.7 + joint as f64,
                scale: 1.7 + joint as f64,
            }));
        }
        limits.push(below(interval, 1.0, SPEED, 1.0));
    }
    (nodes, limits)
}

/// T by second-order cones, r_k² ≤ b_k and 1 ≤ d_k (r_k + r_{k+1}), as Verscheure and others write it, from rest to rest.
fn by_cones(nodes: &[f64], limits: &[Limit]) -> f64 {
    let inner = nodes.len() - 2;
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    let mut right: Vec<f64> = Vec::new();
    let mut push = |constant: f64, terms: &[(usize, f64)]| {
        for (column, value) in terms {
            rows.push(right.len());
            columns.push(*column);
            values.push(-value);
        }
        right.push(constant);
    };
    let terms = |limit: &Limit, of: &Affine, sign: f64| {
        let k = limit.interval;
        let slope = of.acceleration / (2.0 * (nodes[k + 1] - nodes[k]));
        let both = [
            (k, of.square * (1.0 - limit.part) - slope),
            (k + 1, of.square * limit.part + slope),
        ];
        let known = both
            .into_iter()
            .filter(|(node, _)| (1..=inner).contains(node));
        known
            .map(|(node, value)| (node - 1, sign * value))
            .collect::<Vec<_>>()
    };
    let mut cones: Vec<SupportedConeT<f64>> = Vec::new();
    for limit in limits {
        match &limit.of {
            Limited::Below(of) => {
                push(limit.most - of.rest, &terms(limit, of, -1.0));
                cones.push(NonnegativeConeT(1));
            }
            Limited::Within(of) => {
                push(limit.most, &[]);
                of.iter()
                    .for_each(|of| push(of.rest, &terms(limit, of, 1.0)));
                cones.push(SecondOrderConeT(3));
            }
        }
    }
    for node in 0..inner {
        push(1.0, &[(node, 1.0)]);
        push(-1.0, &[(node, 1.0)]);
        push(0.0, &[(inner + node, 2.0)]);
        cones.push(SecondOrderConeT(3));
    }
    let mut costs = vec![0.0; 2 * inner];
    for k in 0..=inner {
        let d = 2 * inner + k;
        costs.push(2.0 * (nodes[k + 1] - nodes[k]));
        let roots = [k, k + 1]
            .into_iter()
            .filter(|node| (1..=inner).contains(node));
        let roots: Vec<(usize, f64)> = roots.map(|node| (inner + node - 1, 1.0)).collect();
        push(0.0, &[&roots[..], &[(d, 1.0)]].concat());
        push(0.0, &[&roots[..], &[(d, -1.0)]].concat());
        push(2.0, &[]);
        cones.push(SecondOrderConeT(3));
    }
    let width = costs.len();
    let matrix = CscMatrix::new_from_triplets(right.len(), width, rows, columns, values);
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(1e-10)
        .tol_gap_rel(1e-10)
        .tol_feas(1e-10)
        .build()
        .unwrap();
    let flat = CscMatrix::zeros((width, width));
    let mut solver = DefaultSolver::new(&flat, &costs, &matrix, &right, &cones, settings).unwrap();
    solver.solve();
    let status = solver.solution.status;
    assert!(
        matches!(status, SolverStatus::Solved | SolverStatus::AlmostSolved),
        "{status}"
    );
    solver.solution.obj_val
}

#[test]
fn cones_and_a_general_solver_find_the_same() {
    for joints in [0, 1, 4] {
        let (nodes, limits) = bent(100, joints);
        let problem = Problem {
            nodes: &nodes,
            ends: [0.0, 0.0],
            limits: &limits,
        };
        let (found, cones) = (problem.solve().unwrap(), by_cones(&nodes, &limits));
        assert!(
            (found.time / cones - 1.0).abs() < 1e-9,
            "{} {cones}",
            found.time
        );
        assert!(
            found.gap < 1e-11 && found.iterations < 25,
            "{}",
            found.iterations
        );
    }
}

#[test]
fn more_of_a_limit_is_worth_what_it_says() {
    let (nodes, mut limits) = bent(100, 1);
    let time = |limits: &[Limit]| {
        let problem = Problem {
            nodes: &nodes,
            ends: [0.0, 0.0],
            limits,
        };
        problem.solve().unwrap()
    };
    let before = time(&limits);
    let step = 1e-5;
    let is_force = |limit: &Limit| matches!(limit.of, Limited::Within(_));
    let worth = limits
        .iter()
        .zip(&before.worth)
        .filter(|(limit, _)| is_force(limit));
    let worth: f64 = worth.map(|(_, worth)| worth).sum();
    for limit in limits.iter_mut().filter(|limit| is_force(limit)) {
        limit.most *= 1.0 + step;
    }
    let gained = (before.time - time(&limits).time) / step;
    assert!((gained / worth - 1.0).abs() < 1e-3, "{gained} {worth}");
}

#[test]
fn what_no_law_keeps_is_said_by_how_much() {
    // Weight of 3 along the path, and a drive of 2: ẍ + 3 ≤ 2, 3 − … ≥ −2.
    let nodes = grid(40, 1.0);
    let of = Affine { rest: 3.0, ..PACE };
    let limits: Vec<Limit> = (0..40)
        .flat_map(|k| [of, of.negative()].map(|of| below(k, 0.0, of, 2.0)))
        .collect();
    let problem = Problem {
        nodes: &nodes,
        ends: [0.0, 0.0],
        limits: &limits,
    };
    assert_eq!(problem.solve(), None);
    let (wider, weights) = problem.lacks().unwrap();
    assert!(
        (weights.iter().sum::<f64>() - 1.0).abs() < 1e-6,
        "{weights:?}"
    );
    assert!((wider - 0.5).abs() < 1e-6, "{wider}");
    // Nothing bounds the speed.
    let limits = [below(0, 0.0, Affine::default(), 1.0)];
    let problem = Problem {
        limits: &limits,
        ..problem
    };
    assert_eq!(problem.solve(), None);
}

/// Prints how long it takes: `cargo test --release -p linkdyn-optimise speed -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn speed() {
    for joints in [0, 1, 4] {
        let (nodes, limits) = bent(400, joints);
        let problem = Problem {
            nodes: &nodes,
            ends: [0.0, 0.0],
            limits: &limits,
        };
        let clock = std::time::Instant::now();
        let rounds = 20;
        let found = (0..rounds)
            .map(|_| problem.solve().unwrap())
            .next_back()
            .unwrap();
        let each = clock.elapsed() / rounds;
        eprintln!(
            "{joints} joints: {each:?}, {} iterations, gap {:e}",
            found.iterations, found.gap
        );
    }
}
