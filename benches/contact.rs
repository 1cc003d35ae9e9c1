//! Contact dynamics beside its error: the slider-crank with a worn piston pin against its reference, and the lock with seven
//! contact joints.
//!
//! For each wanted error the loosest rtol of a ladder of half powers of ten is taken that meets it together with the next
//! tighter one. CPU time is that of the solve as the report has it: from the first step to the last output, all result
//! columns included.

use std::hint::black_box;

use linkdyn_engine::analysis::{self, Control, Outcome};
use linkdyn_model::bundled;
use linkdyn_model::{self, Checked};
use linkdyn_output::Status;
use linkdyn_validation::table::Table;

const MODEL: &str = include_str!("../validation/slider-crank-clearance/model.json");
const REFERENCE: &str = include_str!("../validation/slider-crank-clearance/reference.csv");
const CLEARANCE: f64 = 5e-4;
const ROD: f64 = 0.12;
/// Wanted error as a part of the clearance, and the CPU time aimed at [s].
const CASES: [(f64, f64); 2] = [(1e-2, 0.05), (1e-3, 0.1)];
/// Clearance of all joints of the lock: steel on steel, as in `validation/lock`.
const LOCK: &str = r#"{ "model": "contact", "radius": "100 um", "bearing_radius": "10 mm",
    "normal": { "law": "lankarani_nikravesh", "restitution": 0.9,
                "elastic": { "young_modulus": "207 GPa", "poisson_ratio": 0.3 } } }"#;
const LOCK_JOINTS: [&str; 7] = ["a", "b", "c", "d", "e", "f", "g"];

fn load(text: &str, sets: &[String]) -> Checked {
    linkdyn_model::load(text.as_bytes(), sets)
        .unwrap_or_else(|said| panic!("{said:?}"))
        .model
}

fn run(model: &Checked) -> Outcome {
    let outcome = analysis::run(black_box(model), &Control::default())
        .unwrap_or_else(|said| panic!("{said:?}"));
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    outcome
}

/// Least CPU of the solve in some runs, and the last of them.
fn least(model: &Checked, repetitions: usize) -> (f64, Outcome) {
    let runs = (0..repetitions)
        .map(|_| run(model))
        .map(|outcome| (outcome.report.solve.cpu, outcome));
    runs.reduce(|best, next| (best.0.min(next.0), next.1))
        .expect("at least one")
}

/// Error of the slider and of the rod's end, as a part of the clearance.
fn error(outcome: &Outcome, reference: &Table) -> f64 {
    let off = |name: &str| {
        let index = reference
            .columns
            .iter()
            .position(|column| column == name)
            .expect("a column");
        let ours = outcome.trajectory.values(name).expect("a column");
        assert_eq!(ours.len(), reference.rows.len());
        ours.iter()
            .zip(&reference.rows)
            .map(|(a, row)| (a - row[index]).abs())
            .fold(0.0, f64::max)
    };
    off("slider.x[m]").max(ROD * off("rod.angle[rad]")) / CLEARANCE
}

fn slider_crank(wanted: f64, goal: f64, reference: &Table) {
    let at = |half: u32| {
        let rtol = 10f64.powf(-0.5 * f64::from(half));
        (
            rtol,
            load(MODEL, &[format!("analysis.solver.rtol={rtol:e}")]),
        )
    };
    let meets = |half: u32| error(&run(&at(half).1), reference) <= wanted;
    let half = (6..24)
        .find(|half| meets(*half) && meets(half + 1))
        .expect("an error that is met");
    let (rtol, model) = at(half);
    let (cpu, outcome) = least(&model, 11);
    let error = error(&outcome, reference);
    let verdict = if cpu <= goal { "" } else { "  missed" };
    println!(
        "slider-crank, wanted {wanted:.0e}: rtol {rtol:.1e}, error {error:.1e}, {:.1} ms, goal {:.0} ms, {} steps, {} evaluations{verdict}",
        cpu * 1e3,
        goal * 1e3,
        outcome.report.statistics.steps,
        outcome.report.statistics.evaluations
    );
}

/// The whole motion of the bundled model, from rest.
fn lock() {
    let text = bundled::find("watt-i-lock").expect("bundled").text;
    let clearances =
        LOCK_JOINTS.map(|joint| format!("joints.{joint}.clearance={}", LOCK.replace('\n', " ")));
    for rtol in ["1e-4", "1e-6"] {
        let sets = [
            clearances.as_slice(),
            &[format!("analysis.solver.rtol={rtol}")],
        ]
        .concat();
        let outcome = run(&load(text, &sets));
        let contacts: u64 = outcome
            .report
            .clearances
            .iter()
            .map(|sums| sums.episodes)
            .sum();
        println!(
            "lock, seven contacts, rtol {rtol}: {:.1} s, {} steps, {} evaluations, {contacts} contacts, {:.0e} of the energy missing",
            outcome.report.solve.cpu,
            outcome.report.statistics.steps,
            outcome.report.statistics.evaluations,
            outcome.report.quality.energy_imbalance.unwrap_or(f64::NAN)
        );
    }
}

fn main() {
    let reference = Table::parse(REFERENCE).expect("a table");
    for (wanted, goal) in CASES {
        slider_crank(wanted, goal, &reference);
    }
    lock();
}
