//! Contact dynamics beside its error: the slider-crank with a worn piston pin against its reference, and the lock with seven
//! contact joints; with `--json NAME` the slider-crank's row of that name (`clearance-1e-2`, …) as JSON, for scripts.
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
use serde_json::json;

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

/// The slider-crank at the loosest tolerance that meets an error.
struct Row {
    rtol: f64,
    error: f64,
    cpu: f64,
    outcome: Outcome,
}

fn measure(wanted: f64, reference: &Table) -> Row {
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
    Row {
        rtol,
        error,
        cpu,
        outcome,
    }
}

fn slider_crank(wanted: f64, goal: f64, reference: &Table) {
    let row = measure(wanted, reference);
    let verdict = if row.cpu <= goal { "" } else { "  missed" };
    println!(
        "slider-crank, wanted {wanted:.0e}: rtol {:.1e}, error {:.1e}, {:.1} ms, goal {:.0} ms, {} steps, {} evaluations{verdict}",
        row.rtol,
        row.error,
        row.cpu * 1e3,
        goal * 1e3,
        row.outcome.report.statistics.steps,
        row.outcome.report.statistics.evaluations
    );
}

fn print_json(name: &str, reference: &Table) {
    let case = CASES
        .iter()
        .find(|(wanted, _)| format!("clearance-{wanted:e}") == name);
    let (wanted, _) = case.unwrap_or_else(|| panic!("no row is called {name}"));
    let row = measure(*wanted, reference);
    let json = json!({ "case": name, "error": row.error, "cpu": row.cpu, "tolerance": row.rtol,
                       "steps": row.outcome.report.statistics.steps });
    println!("{json}");
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
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
        .collect();
    if let [flag, names @ ..] = arguments.as_slice()
        && flag == "--json"
    {
        names.iter().for_each(|name| print_json(name, &reference));
        return;
    }
    for (wanted, goal) in CASES {
        slider_crank(wanted, goal, &reference);
    }
    lock();
}
