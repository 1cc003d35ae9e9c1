//! Dependent coordinates one after the other, where constraints say them so, and the general way where they do not.

use super::sparse::{difference, solved};
use super::*;
use crate::allocations::compiled;
use crate::benchmarks::chain;
use linkdyn_engine::analysis::assembly::assemble;
use linkdyn_engine::mechanism::reduced::{Reduced, Solver};
use linkdyn_engine::system::{Inputs, System};

/// Differences from tangents, by the largest value of the unit.
const SAME: f64 = 1e-7;

/// A tree: links on a cart on a fixed rail, one with a flange welded to it, from which two branches hang, and springs.
fn tree() -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0], "P": [1.0, 1.5] } },
        "cart": { "mass": 2.0, "inertia": 0.1, "com": [0.1, 0.05], "points": { "O": [0.0, 0.0] } },
        "trunk": rod(0.6, [0.0, 0.0], -1.2),
        "flange": rod(0.3, [0.217, -0.559], 0.3),
        "left": rod(0.5, [0.217, -0.559], -2.0), "twig": rod(0.4, [0.009, -1.014], -1.0),
        "right": rod(0.5, [0.504, -0.470], -0.5), "tip": rod(0.4, [0.943, -0.710], -0.2),
    });
    let joints = json!({
        "rail": { "type": "prismatic", "between": ["ground.O", "cart.O"], "axis": [1.0, 0.3] },
        "o": pin("cart.O", "trunk.A"),
        "weld": { "type": "fixed", "between": ["trunk.B", "flange.A"], "angle": 1.5 },
        "l": pin("trunk.B", "left.A"), "t": pin("left.B", "twig.A"),
        "r": pin("flange.B", "right.A"), "u": pin("right.B", "tip.A"),
    });
    let mut tree = model(bodies, joints, json!({}));
    tree["forces"] = json!({ "s": { "type": "spring", "between": ["ground.P", "tip.B"],
        "stiffness": 30.0, "free_length": 0.8 } });
    tree["analysis"] = dynamics(1.0, 11, 1e-10);
    tree
}

/// A chain, its first link driven.
fn driven() -> Value {
    let mut driven = chain(8);
    driven["drivers"] = json!({ "motor": { "type": "rotation", "body": "l0",
        "motion": { "type": "harmonic", "offset": 0.0, "amplitude": 0.5, "frequency": 1.5 } } });
    driven["analysis"] = dynamics(0.6, 11, 1e-10);
    driven
}

/// A chain between two pins of the ground: a loop.
fn hung() -> Value {
    let mut hung = chain(8);
    hung["bodies"]["ground"]["points"]["E"] = json!([0.9, 0.0]);
    for k in 0..8 {
        // an arc
        let angle = 0.75 - 0.2 * f64::from(k);
        hung["bodies"][format!("l{k}")]["pose"]["angle"] = json!(-angle);
    }
    hung["joints"]["end"] = pin("l7.B", "ground.E");
    hung["analysis"] = dynamics(0.3, 11, 1e-10);
    hung
}

/// A chain with a block that slides on a link.
fn with_turning_rail() -> Value {
    let mut sliding = chain(6);
    sliding["bodies"]["block"] = json!({ "mass": 0.1, "inertia": 1e-4, "com": [0.0, 0.01],
        "points": { "O": [0.0, 0.0] }, "pose": { "position": [0.55, 0.0] } });
    sliding["joints"]["rail"] =
        json!({ "type": "prismatic", "between": ["l3.A", "block.O"], "axis": [1.0, 0.0] });
    sliding["analysis"] = dynamics(0.3, 11, 1e-10);
    sliding
}

/// A chain with friction in its pins, which asks for multipliers at every point.
fn rubbing() -> Value {
    let mut rubbing = chain(6);
    for (_, joint) in rubbing["joints"].as_object_mut().expect("joints") {
        joint["friction"] =
            json!({ "law": "threlfall", "coefficient": 0.1, "threshold_velocity": 0.01 });
        joint["pin_radius"] = json!(0.01);
    }
    rubbing["analysis"] = dynamics(0.3, 11, 1e-10);
    rubbing
}

/// A chain of which a pin is locked for a while: another mechanism in between.
fn locking() -> Value {
    let mut locking = chain(6);
    locking["joints"]["j3"]["lock"] = json!({ "from": "time >= 0.1 s", "until": "time >= 0.2 s" });
    locking["analysis"] = dynamics(0.3, 11, 1e-10);
    locking
}

/// Whether no position of a run was iterated for, or next to none: the first choice of coordinates may be another one.
fn is_said(run: &Outcome) -> bool {
    let done = run.report.statistics;
    assert!(done.evaluations > 200, "{done:?}");
    100 * done.newton_iterations < done.evaluations
}

/// Both ways give what tangents give, and each mechanism goes its own.
#[test]
fn open_trees_need_no_iteration_and_others_do() {
    for (name, model, is_open) in [
        ("chain", chain(8), true),
        ("tree", tree(), true),
        ("driven", driven(), true),
        ("friction", rubbing(), true),
        ("lock", locking(), true),
        ("loop", hung(), false),
        ("turning rail", with_turning_rail(), false),
    ] {
        let solver = json!({ "rtol": 1e-10, "atol": 1e-13 });
        let [dense, sparse] = ["dense", "sparse"].map(|way| solved(&model, way, &solver));
        for run in [&dense, &sparse] {
            assert_eq!(run.report.status, Status::Completed, "{name}");
        }
        let (worst, _) = difference(&dense, &sparse);
        println!("{name}: {worst:e}, {:?}", sparse.report.statistics);
        assert!(worst < SAME, "{name}: off by {worst:e}");
        assert_eq!(is_said(&sparse), is_open, "{name}");
        assert!(!is_said(&dense), "{name}");
    }
}

/// Where centres of mass are follows from the angles, to round-off, however long a motion has gone on; energy is kept as well as steps
/// are good.
#[test]
fn chains_stay_closed_however_long_they_fall() {
    let links = 6;
    let length = 1.0 / links as f64;
    let mut drifts = Vec::new();
    for rtol in [1e-6, 1e-9] {
        let mut long = chain(links);
        long["analysis"] = dynamics(20.0, 101, rtol);
        let run = completed(&long);
        assert!(is_said(&run));
        let of = |k: usize, what: &str| column(&run, &format!("l{k}.{what}"));
        let mut at = vec![[0.0; 4]; run.trajectory.len()];
        for k in 0..links {
            let columns = ["x", "y", "vx", "vy"].map(|what| of(k, what));
            let (angle, omega) = (of(k, "angle"), of(k, "omega"));
            for (row, at) in at.iter_mut().enumerate() {
                for (place, column) in at.iter().zip(&columns) {
                    let off = (place - column[row]).abs();
                    assert!(off < 1e-13, "link {k}, row {row}: {off:e}");
                }
                let (sin, cos) = angle[row].sin_cos();
                let turn = length * omega[row];
                let along = [length * cos, length * sin, -turn * sin, turn * cos];
                at.iter_mut().zip(along).for_each(|(at, more)| *at += more);
            }
        }
        let residual = run.report.quality.constraint_residual;
        assert!(residual < 4e-15, "{residual:e}");
        drifts.push(energy_drift(&run));
    }
    assert!(
        drifts[0] < 1e-4 && drifts[1] < 1e-2 * drifts[0],
        "{drifts:?}"
    );
}

/// Stiff springs in the pins of a chain: the implicit method asks how coordinates follow.
#[test]
fn implicit_steps_follow_the_same_coordinates() {
    let mut stiff = chain(8);
    for k in 1..8 {
        stiff["forces"][format!("s{k}")] = json!({ "type": "torsion_spring",
            "between": [format!("l{}", k - 1), format!("l{k}")], "stiffness": 50.0, "damping": 5.0 });
    }
    let runs = [("radau5", "sparse"), ("dop853", "dense")].map(|(method, way)| {
        let solver = json!({ "method": method, "rtol": 1e-8, "atol": 1e-11 });
        stiff["analysis"] = json!({ "type": "dynamics", "end": 0.5, "outputs": 11 });
        solved(&stiff, way, &solver)
    });
    let angle = |run: &Outcome, k: usize| column(run, &format!("l{k}.angle"));
    for k in 0..8 {
        let (own, other) = (angle(&runs[0], k), angle(&runs[1], k));
        let off = own.iter().zip(&other);
        let off = off.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()));
        assert!(off < 1e-5, "link {k}: {off:e}");
    }
    assert!(is_said(&runs[0]));
    assert!(10 * runs[0].report.statistics.steps < runs[1].report.statistics.steps);
}

/// Three links whose centres of mass are at their ends, level.
fn weighted() -> Value {
    let mut weighted = chain(3);
    for k in 0..3 {
        weighted["bodies"][format!("l{k}")]["com"] = json!([1.0 / 3.0, 0.0]);
    }
    weighted
}

/// At rest, with these coordinates for the independent ones.
fn start<'s>(system: &'s System, columns: &[usize]) -> (Reduced<'s>, Vec<f64>) {
    let q = assemble(system, &Inputs::at_time(system, 0.0))
        .expect("assembles")
        .q;
    let v = vec![0.0; q.len()];
    let reduced = Reduced::new(system, columns, (&q, &v, 0.0), Some(Solver::Sparse));
    let reduced = reduced.expect("regular");
    let mut y = vec![0.0; 2 * columns.len()];
    reduced.state(&mut y);
    (reduced, y)
}

/// A step by the classical Runge–Kutta method.
fn step(reduced: &mut Reduced, time: f64, h: f64, y: &mut [f64]) {
    let f = reduced.freedom();
    let mut sum = vec![0.0; 2 * f];
    let mut slope = vec![0.0; 2 * f];
    for (part, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
        let at: Vec<f64> = y
            .iter()
            .zip(&slope)
            .map(|(y, k)| y + part * h * k)
            .collect();
        let there = reduced.evaluate_within(time + part * h, &at);
        there.expect("a regular point");
        slope[..f].copy_from_slice(&at[f..]);
        slope[f..].copy_from_slice(reduced.accelerations());
        sum.iter_mut()
            .zip(&slope)
            .for_each(|(sum, k)| *sum += weight * k);
    }
    y.iter_mut()
        .zip(&sum)
        .for_each(|(y, sum)| *y += h / 6.0 * sum);
    reduced.accept(time + h, y);
}

/// Where a height is chosen and not an angle there is no such order, until the link falls so far that the angle moves more: the motion
/// goes on with it, and is the same.
#[test]
fn another_choice_in_the_middle_of_a_motion_goes_on_the_other_way() {
    let system = compiled(&weighted());
    let angles = [2, 5, 8];
    let (mut said, mut y) = start(&system, &angles);
    // The height of the last link's centre of mass.
    let (mut other, mut z) = start(&system, &[2, 5, 7]);
    assert!(said.independent_columns().eq(angles) && other.independent_columns().eq([2, 5, 7]));
    let (h, mut changes) = (1e-4, Vec::new());
    for k in 0..7000 {
        let time = h * f64::from(k);
        let before = other.work().newton_iterations;
        step(&mut said, time, h, &mut y);
        step(&mut other, time, h, &mut z);
        let iterated = other.work().newton_iterations > before;
        assert_eq!(iterated, changes.is_empty(), "at {time}");
        let off = said.position().iter().zip(other.position());
        let off = off.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()));
        assert!(off < 1e-8, "{off:e} at {time}");
        assert!(other.residual() < 1e-14 && said.residual() < 1e-14);
        if other.choose_better().expect("regular") {
            other.state(&mut z);
            changes.push(time);
        }
        assert!(!said.choose_better().expect("regular"));
    }
    println!("changed at {changes:?}");
    assert!(changes.len() == 1 && other.independent_columns().eq(angles));
    assert_eq!(said.work().newton_iterations, 0);
}
