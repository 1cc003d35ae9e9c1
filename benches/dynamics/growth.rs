//! How costs grow with the size of a mechanism.

use super::{Problem, load, run, set_tolerance, spread, without_rows};
use linkdyn_engine::analysis::Outcome;
use linkdyn_model::Checked;
use serde_json::json;

/// Prints the costs of loops by step, those of chains by evaluation, and what a long chain takes.
pub fn print() {
    growth("A02", "step", &[10, 100, 1000, 10_000], 1.12, |loops| {
        by(Problem::FourBars(loops), [0.2, 1.2], |outcome| {
            outcome.report.statistics.steps
        })
    });
    growth(
        "chain",
        "evaluation",
        &[10, 100, 1000, 3000],
        1.1,
        |links| {
            // The shorter the links, the faster they swing.
            let ends = [2.0, 12.0].map(|end| end / links as f64);
            by(Problem::Chain(links), ends, |outcome| {
                outcome.report.statistics.evaluations
            })
        },
    );
    long_chain();
}

/// CPU [s] by `count`, of steps or evaluations, without outputs between and without what is done once: the difference of a
/// longer and a shorter run.
fn by(problem: Problem, ends: [f64; 2], count: fn(&Outcome) -> u64) -> f64 {
    let mut json = problem.json();
    json["analysis"]["outputs"] = json!(2);
    let mut model = load(&json);
    set_tolerance(&mut model, 1e-6);
    let [short, long] = ends.map(|end| {
        let model = until(&model, end);
        let runs: Vec<Outcome> = (0..3).map(|_| run(&model)).map(without_rows).collect();
        let times = runs.iter().map(|outcome| outcome.report.solve.cpu);
        (spread(times.collect()).0, count(&runs[0]))
    });
    (long.0 - short.0) / (long.1 - short.1) as f64
}

fn until(model: &Checked, end: f64) -> Checked {
    let edited = model.edit(|model| {
        model.analysis.as_mut().expect("an analysis").end = Some(end);
    });
    edited.expect("legal")
}

/// Prints how a cost [s] grows from size to size.
fn growth(name: &str, unit: &str, sizes: &[usize], goal: f64, cost: impl Fn(usize) -> f64) {
    let costs: Vec<(usize, f64)> = sizes.iter().map(|&n| (n, cost(n))).collect();
    let exponent = |from: (usize, f64), to: (usize, f64)| {
        (to.1 / from.1).ln() / (to.0 as f64 / from.0 as f64).ln()
    };
    for (index, &now) in costs.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| costs[before]);
        let growth = before.map_or(String::new(), |before| {
            format!(", growing as N^{:.2}", exponent(before, now))
        });
        println!(
            "{name} N = {}: {:.1} µs per {unit}{growth}",
            now.0,
            now.1 * 1e6
        );
    }
    if let [first, .., last] = costs.as_slice() {
        println!(
            "from N = {} to {}: N^{:.2}, goal {goal}",
            first.0,
            last.0,
            exponent(*first, *last)
        );
    }
}

/// A chain of 1000 links over 0.1 s, and how far its tip is off that of a run with a thousandth of the tolerance.
fn long_chain() {
    let chain = Problem::Chain(1000);
    let mut model = until(&load(&chain.json()), 0.1);
    let tip = |outcome: &Outcome| {
        ["x", "y"].map(|axis| {
            let values = outcome.trajectory.values(&format!("l999.B.{axis}"));
            *values.expect("a column").last().expect("a row")
        })
    };
    let [exact, ours] = [1e-8, 1e-5].map(|tolerance| {
        set_tolerance(&mut model, tolerance);
        run(&model)
    });
    let ([x, y], [own_x, own_y]) = (tip(&exact), tip(&ours));
    println!(
        "chain-1000 for 0.1 s: {:.2} s, goal 3, tip off by {:.1e} m, {} steps, {} evaluations",
        ours.report.solve.cpu,
        (own_x - x).hypot(own_y - y),
        ours.report.statistics.steps,
        ours.report.statistics.evaluations
    );
}
