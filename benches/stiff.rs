//! A row of masses with stiff springs beside its closed form: error and CPU time, by the number of masses; with `--json` the rows
//! as JSON, for `validation/peers/stiff.py`.
//!
//! As in `dynamics`, of a ladder of tolerances the loosest is taken that meets the error together with the next tighter one,
//! and CPU time is that of the solve as the report has it.

use linkdyn_engine::analysis::{self, Control, Outcome};
use linkdyn_model::Checked;
use linkdyn_output::{Report, Status};
use serde_json::json;

#[path = "../tests/common/row.rs"]
mod row;

/// Error that is wanted, of a motion of 1 m [m].
const ERROR: f64 = 1e-6;
const MASSES: [usize; 3] = [10, 100, 1000];

fn run(model: &Checked) -> Outcome {
    let outcome = analysis::run(model, &Control::default()).expect("a sound model");
    let report = &outcome.report;
    assert_eq!(report.status, Status::Completed, "{:?}", report.message);
    outcome
}

/// Largest error of a displacement at an output [m].
fn error(row: &row::Row, outcome: &Outcome) -> f64 {
    let values = |name: &str| outcome.trajectory.values(name).expect("a column");
    let times = values("time").to_vec();
    let of_mass = |j: usize| {
        let x = values(&format!("m{j}.x")).to_vec();
        let off = x
            .iter()
            .zip(&times)
            .map(|(x, t)| (x - row.place(j, *t)).abs());
        off.fold(0.0, f64::max)
    };
    (0..row.masses).map(of_mass).fold(0.0, f64::max)
}

struct Measured {
    tolerance: f64,
    error: f64,
    cpu: f64,
    report: Report,
}

fn measure(masses: usize, method: &str) -> Measured {
    let row = row::Row::new(masses);
    let text = row.json(method).to_string();
    let mut model = linkdyn_model::load(text.as_bytes(), &[])
        .unwrap_or_else(|said| panic!("{said:?}"))
        .model;
    let (mut met, mut taken) = (None, None);
    for half in 4..=24 {
        let tolerance = 10f64.powf(-0.5 * f64::from(half));
        let edited = model.edit(|model| {
            let solver = &mut model.analysis.as_mut().expect("an analysis").solver;
            (solver.rtol, solver.atol) = (tolerance, tolerance);
        });
        model = edited.expect("legal");
        let outcome = run(&model);
        let error = error(&row, &outcome);
        if error > ERROR {
            met = None;
        } else if met.is_some() {
            taken = met;
            break;
        } else {
            met = Some((tolerance, error, model.clone()));
        }
    }
    let (tolerance, error, model) = taken.unwrap_or_else(|| panic!("{masses} never meet {ERROR}"));
    let repetitions = if masses > 100 { 3 } else { 10 };
    let reports = (0..repetitions).map(|_| run(&model).report);
    let report = reports
        .min_by(|a, b| a.solve.cpu.total_cmp(&b.solve.cpu))
        .expect("at least one run");
    Measured {
        tolerance,
        error,
        cpu: report.solve.cpu,
        report,
    }
}

fn main() {
    let as_json = std::env::args().any(|argument| argument == "--json");
    let method = std::env::args().find(|argument| argument == "auto");
    let method = method.as_deref().unwrap_or("radau5");
    let mut first: Option<(usize, f64)> = None;
    for masses in MASSES {
        let found = measure(masses, method);
        if as_json {
            let row = json!({ "masses": masses, "error": found.error, "cpu": found.cpu,
                "tolerance": found.tolerance, "steps": found.report.statistics.steps });
            println!("{row}");
            continue;
        }
        let statistics = &found.report.statistics;
        let growth = first.map_or(String::new(), |(n, cpu)| {
            let power = (found.cpu / cpu).ln() / (masses as f64 / n as f64).ln();
            format!(", N^{power:.2} from N = {n}")
        });
        first.get_or_insert((masses, found.cpu));
        println!(
            "N = {masses:>4}: rtol {:.0e}, error {:.1e} m, {:.2} ms, {} steps ({} rejected), {} evaluations{growth}",
            found.tolerance,
            found.error,
            found.cpu * 1e3,
            statistics.steps,
            statistics.rejected,
            statistics.evaluations,
        );
    }
}
