//! Forward dynamics beside its error, against closed forms and published digits: a table, or with `--json NAME` the row of
//! that name (`A01-1e-6`, …) as JSON, for scripts.
//!
//! For each wanted error the loosest rtol of a ladder of half powers of ten is taken that meets it together with the
//! next tighter one, so that none is met by luck; atol is the same number. CPU time is that of the solve as the report
//! has it: from the first step to the last output, all result columns included.

use std::hint::black_box;

use cpu_time::ThreadTime;
use linkdyn_engine::analysis::sample::Sample;
use linkdyn_engine::analysis::{self, Control, Outcome, assembly, driven};
use linkdyn_engine::mechanism::continuation::{Parameter, follow};
use linkdyn_engine::mechanism::driven::Driven;
use linkdyn_engine::system::Inputs;
use linkdyn_engine::system::compile::compile;
use linkdyn_model::{self, AnalysisKind, Checked, bundled};
use linkdyn_output::Status;
use serde_json::{Value, json};

#[path = "../tests/common/benchmarks.rs"]
mod benchmarks;
#[path = "dynamics/growth.rs"]
mod growth;

/// What is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Problem {
    Pendulum,
    FourBars(usize),
    Squeezer,
    Chain(usize),
}

/// A row: a problem, the error wanted, the CPU time aimed at [ms].
struct Case {
    problem: Problem,
    error: f64,
    goal: f64,
}

const fn case(problem: Problem, error: f64, goal: f64) -> Case {
    Case {
        problem,
        error,
        goal,
    }
}

const CASES: [Case; 12] = [
    case(Problem::Pendulum, 1e-6, 1.0),
    case(Problem::FourBars(1), 1e-4, 1.5),
    case(Problem::FourBars(1), 1e-6, 3.0),
    case(Problem::FourBars(10), 1e-4, 6.0),
    case(Problem::FourBars(40), 1e-4, 30.0),
    case(Problem::FourBars(100), 1e-4, 80.0),
    case(Problem::FourBars(1000), 1e-3, 1000.0),
    case(Problem::Squeezer, 1e-3, 2.0),
    case(Problem::Squeezer, 1e-6, 5.0),
    case(Problem::Chain(10), 1e-5, 3.0),
    case(Problem::Chain(50), 1e-5, 60.0),
    case(Problem::Chain(100), 1e-5, 250.0),
];

impl Problem {
    fn json(self) -> Value {
        match self {
            Problem::Pendulum => benchmarks::pendulum(),
            Problem::FourBars(loops) => benchmarks::four_bars(loops),
            Problem::Squeezer => benchmarks::squeezer(),
            Problem::Chain(links) => benchmarks::chain(links),
        }
    }

    fn name(self) -> String {
        match self {
            Problem::Pendulum => "A01".into(),
            Problem::FourBars(loops) => format!("A02-{loops}"),
            Problem::Squeezer => "A03".into(),
            Problem::Chain(links) => format!("chain-{links}"),
        }
    }

    /// Largest distance of the point that is watched [m], or largest relative error of the angles at the end.
    fn error(self, outcome: &Outcome) -> f64 {
        let values = |name: &str| outcome.trajectory.values(name).expect("a column");
        let distance = |point: &str, exact: &dyn Fn(f64) -> [f64; 2]| {
            let (x, y) = (values(&format!("{point}.x")), values(&format!("{point}.y")));
            let off =
                |((t, x), y): ((&f64, &f64), &f64)| (x - exact(*t)[0]).hypot(y - exact(*t)[1]);
            values("time")
                .iter()
                .zip(&x)
                .zip(&y)
                .map(off)
                .fold(0.0, f64::max)
        };
        match self {
            Problem::Pendulum => distance("rod.P", &benchmarks::pendulum_place()),
            Problem::FourBars(loops) => distance("rocker0.B", &benchmarks::four_bars_place(loops)),
            Problem::Chain(links) => {
                let [x, y] = benchmarks::chain_tip(links);
                let tip = |axis| {
                    *values(&format!("l{}.B.{axis}", links - 1))
                        .last()
                        .expect("a row")
                };
                (tip("x") - x).hypot(tip("y") - y)
            }
            Problem::Squeezer => {
                let last = |body: usize| *values(&format!("k{body}.angle")).last().expect("a row");
                let angles = [
                    last(1),
                    last(2) - last(1),
                    last(3),
                    last(4) - last(5),
                    last(5),
                    last(6) - last(7),
                    last(7),
                ];
                let relative = |(ours, exact): (&f64, &f64)| ((ours - exact) / exact).abs();
                angles
                    .iter()
                    .zip(&benchmarks::SQUEEZER_END)
                    .map(relative)
                    .fold(0.0, f64::max)
            }
        }
    }
}

fn load(json: &Value) -> Checked {
    linkdyn_model::load(json.to_string().as_bytes(), &[])
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

/// Minimum and median.
fn spread(mut times: Vec<f64>) -> (f64, f64) {
    times.sort_by(f64::total_cmp);
    (times[0], times[times.len() / 2])
}

struct Row {
    tolerance: f64,
    error: f64,
    /// CPU of the solve, minimum and median, and of assembly [s].
    solve: (f64, f64),
    assemble: f64,
    load: f64,
    steps: u64,
    evaluations: u64,
}

fn measure(case: &Case) -> Row {
    let json = case.problem.json();
    let watch = ThreadTime::now();
    let mut model = load(&json);
    let load = watch.elapsed().as_secs_f64();
    let mut met = None;
    let mut taken = None;
    for half in 2..=24 {
        let tolerance = 10f64.powf(-0.5 * f64::from(half));
        set_tolerance(&mut model, tolerance);
        let outcome = run(&model);
        let error = case.problem.error(&outcome);
        if error > case.error {
            met = None;
        } else if met.is_some() {
            taken = met;
            break;
        } else {
            met = Some((tolerance, error));
        }
    }
    let (tolerance, error) =
        taken.unwrap_or_else(|| panic!("{} never meets {}", case.problem.name(), case.error));
    set_tolerance(&mut model, tolerance);
    let first = run(&model);
    let repetitions = ((0.5 / first.report.solve.cpu.max(1e-4)) as usize).clamp(3, 200);
    let runs: Vec<Outcome> = (0..repetitions)
        .map(|_| run(&model))
        .map(without_rows)
        .collect();
    Row {
        tolerance,
        error,
        solve: spread(
            runs.iter()
                .map(|outcome| outcome.report.solve.cpu)
                .collect(),
        ),
        assemble: spread(
            runs.iter()
                .map(|outcome| outcome.report.assemble.cpu)
                .collect(),
        )
        .0,
        load,
        steps: first.report.statistics.steps,
        evaluations: first.report.statistics.evaluations,
    }
}

fn without_rows(mut outcome: Outcome) -> Outcome {
    outcome.trajectory = Default::default();
    outcome
}

fn set_tolerance(model: &mut Checked, tolerance: f64) {
    let edited = model.edit(|model| {
        let solver = &mut model.analysis.as_mut().expect("an analysis").solver;
        (solver.rtol, solver.atol) = (tolerance, tolerance);
    });
    *model = edited.expect("legal");
}

/// CPU per instant [µs] of the driven Watt-I lock: position, velocity, acceleration, all reactions.
fn driven_instant() -> (f64, f64) {
    const INSTANTS: usize = 2000;
    let range = (-50f64.to_radians(), 110f64.to_radians());
    let text = bundled::find("watt-i-lock").expect("bundled").text;
    let model = linkdyn_model::load(text.as_bytes(), &[])
        .expect("a sound model")
        .model;
    let system = compile(&model, AnalysisKind::InverseDynamics).expect("compiles");
    let start = Inputs::at_time(&system, 0.0);
    let mut q = assembly::assemble(&system, &start).expect("assembles").q;
    let mut solver = Driven::new(&system, &q, &start).expect("regular");
    solver.correct(&mut q, &start).expect("converges");
    let parameter = Parameter::of(&system);
    let path = follow(
        &mut solver,
        (parameter, start.clone()),
        (range.0, &q),
        range,
        &|_| false,
    )
    .expect("a path");
    let inputs: Vec<Inputs> = (0..INSTANTS)
        .map(|k| range.0 + (range.1 - range.0) * k as f64 / INSTANTS as f64)
        .map(|value| {
            let time = system.drivers[0]
                .law
                .invert(value, 10.0)
                .expect("within the range");
            let mut inputs = Inputs::at_time(&system, time);
            inputs.drive[0][0] = value;
            inputs
        })
        .collect();
    let mut sample = Sample::new(&system);
    let times = (0..51).map(|_| {
        let watch = ThreadTime::now();
        for inputs in &inputs {
            driven::solve_instant(&mut solver, &path, inputs, &mut sample).expect("regular");
            black_box(&sample);
        }
        watch.elapsed().as_secs_f64() / INSTANTS as f64 * 1e6
    });
    spread(times.collect())
}

fn print_json(name: &str) {
    let case = CASES
        .iter()
        .find(|case| format!("{}-{:e}", case.problem.name(), case.error) == name);
    let case = case.unwrap_or_else(|| panic!("no row is called {name}"));
    let row = measure(case);
    let json = json!({ "case": name, "error": row.error, "cpu": row.solve.0, "tolerance": row.tolerance,
                       "steps": row.steps });
    println!("{json}");
}

fn main() {
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
        .collect();
    if let [flag, names @ ..] = arguments.as_slice()
        && flag == "--json"
    {
        names.iter().for_each(|name| print_json(name));
        return;
    }
    println!(
        "{:<12} {:>7} {:>8} {:>9} {:>9} {:>9} {:>8} {:>6} {:>7} {:>9} {:>8}",
        "row",
        "wanted",
        "rtol",
        "error",
        "min ms",
        "med. ms",
        "goal ms",
        "steps",
        "evals",
        "assemble",
        "load ms"
    );
    for case in &CASES {
        let row = measure(case);
        let verdict = if row.solve.0 * 1e3 <= case.goal {
            ""
        } else {
            "  missed"
        };
        println!(
            "{:<12} {:>7.0e} {:>8.1e} {:>9.1e} {:>9.3} {:>9.3} {:>8} {:>6} {:>7} {:>9.3} {:>8.3}{verdict}",
            case.problem.name(),
            case.error,
            row.tolerance,
            row.error,
            row.solve.0 * 1e3,
            row.solve.1 * 1e3,
            case.goal,
            row.steps,
            row.evaluations,
            row.assemble * 1e3,
            row.load * 1e3
        );
    }
    let (least, median) = driven_instant();
    println!("driven six-bar, per instant: {least:.2} µs (median {median:.2}), goal 5");
    growth::print();
}
