//! The bundled lock with rigid journals that rub: which motions go to their end, and how long that takes.
//!
//! Sets of journals of 0.1 mm with restitution 0.5, by friction. CPU time is that of the solve as the report has it. A motion counts that completes
//! within the limit, 20 s, at which it is stopped. Of one that does not it says how far it came and why, and whose contacts kept it busy.
//!
//! ```text
//! cargo bench --bench jams                    ten sets with three coefficients
//! cargo bench --bench jams -- --list b        six sets with five
//! cargo bench --bench jams -- def abc:0.2     these sets, or this one motion
//! ```

use cpu_time::ProcessTime;
use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_model::Checked;
use linkdyn_output::{ClearanceSums, Status};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

/// CPU time within which a motion has to complete [s].
const LIMIT: f64 = 20.0;

/// Journals, by the letters of their joints, and coefficients of friction.
const LISTS: [(&str, &[&str], &[f64]); 2] = [
    (
        "a",
        &[
            "a", "ab", "abc", "def", "cdef", "defg", "abdef", "abcg", "abcdef", "abcdefg",
        ],
        &[0.2, 0.3, 0.5],
    ),
    (
        "b",
        &["a", "ab", "abc", "def", "abcg", "abcdefg"],
        &[0.2, 0.3, 0.4, 0.5, 0.6],
    ),
];

fn lock(joints: &str, friction: f64) -> Checked {
    let text = linkdyn_model::bundled::find("watt-i-lock")
        .expect("bundled")
        .text;
    let clearance = |joint: char| {
        format!(
            r#"joints.{joint}.clearance={{ "model": "three_state", "radius": "100 um", "bearing_radius": "10 mm",
                "impact": {{ "restitution": 0.5, "friction": {friction} }} }}"#
        )
    };
    let sets: Vec<String> = joints.chars().map(clearance).collect();
    linkdyn_model::load(text.as_bytes(), &sets)
        .unwrap_or_else(|said| panic!("{said:?}"))
        .model
}

/// Runs a motion, and stops it at the limit of CPU time, on however busy a machine.
fn run_within(limit: f64, model: &Checked) -> Outcome {
    let control = Control::default();
    let is_done = AtomicBool::new(false);
    thread::scope(|scope| {
        scope.spawn(|| {
            let watch = ProcessTime::now();
            while !is_done.load(Ordering::Relaxed) {
                if watch.elapsed().as_secs_f64() > limit {
                    control.interrupted.store(true, Ordering::Relaxed);
                }
                thread::sleep(Duration::from_millis(20));
            }
        });
        let outcome = run(model, &control);
        is_done.store(true, Ordering::Relaxed);
        outcome.unwrap_or_else(|said| panic!("{said:?}"))
    })
}

/// How a motion went, in a line, and whether it completed.
fn told(joints: &str, friction: f64, outcome: &Outcome) -> (String, bool) {
    let report = &outcome.report;
    let times = outcome.trajectory.values("time").expect("a column");
    let sum = |count: fn(&ClearanceSums) -> u64| report.clearances.iter().map(count).sum::<u64>();
    let why = match report.status {
        Status::Interrupted => {
            let busiest = report.clearances.iter();
            let busiest = busiest.max_by_key(|sums| sums.episodes + sums.switches);
            busiest.map_or_else(String::new, |sums| {
                format!("{LIMIT} s are over: joint {:?} is the busiest", sums.joint)
            })
        }
        _ => report.message.clone().unwrap_or_default(),
    };
    let line = format!(
        "{joints:>8} {friction:>4} {:>14} {:>7.4} s {:>6.1} s CPU {:>7} steps {:>6} contacts {:>6} switches, energy {:>7.0e}  {why}",
        report.status.word(),
        times.last().unwrap_or(&0.0),
        report.solve.cpu,
        report.statistics.steps,
        sum(|sums| sums.episodes),
        sum(|sums| sums.switches),
        report.quality.energy_imbalance.unwrap_or(f64::NAN),
    );
    (line, report.status == Status::Completed)
}

/// Whether a motion was asked for by `words`; all are where none were.
fn is_wanted(words: &[String], joints: &str, friction: f64) -> bool {
    let names = [joints.to_string(), format!("{joints}:{friction}")];
    words.is_empty() || words.iter().any(|word| names.contains(word))
}

fn main() {
    let (mut list, mut words) = ("a".to_string(), Vec::new());
    let mut given = std::env::args().skip(1);
    while let Some(word) = given.next() {
        match word.as_str() {
            // What cargo says to every bench.
            "--bench" => {}
            "--list" => list = given.next().expect("a list"),
            _ => words.push(word),
        }
    }
    let (_, sets, frictions) = LISTS
        .into_iter()
        .find(|(name, ..)| *name == list)
        .expect("list a or b");
    let (mut completed, mut all) = (0, 0);
    for &joints in sets {
        for &friction in frictions {
            if is_wanted(&words, joints, friction) {
                let outcome = run_within(LIMIT, &lock(joints, friction));
                let (line, is_completed) = told(joints, friction, &outcome);
                println!("{line}");
                (completed, all) = (completed + usize::from(is_completed), all + 1);
            }
        }
    }
    println!("{completed} of {all} complete within {LIMIT} s");
}
