//! Cost per instant of the six-bar lock, inverse dynamics with all reactions, beside its error; and of a `check`.
//!
//! `run` is a whole analysis of a model that is already read: compiling, assembly, following the path, 2000 instants with
//! all columns, no file. `instants` is the loop over 2000 instants alone: position, velocity, acceleration, all reactions.
//!
//! With `--json` the lock at a constant speed as JSON, for `validation/peers`: CPU time of the solve as the report has it,
//! and the forces of all joints with the effort of the driver at every 20th instant.

use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, Throughput, criterion_group};
use linkdyn_engine::analysis::sample::Sample;
use linkdyn_engine::analysis::{self, Control, assembly, driven};
use linkdyn_engine::mechanism::continuation::{Parameter, Path, follow};
use linkdyn_engine::mechanism::driven::Driven;
use linkdyn_engine::system::compile::compile;
use linkdyn_engine::system::{Inputs, System};
use linkdyn_model::bundled;
use linkdyn_model::{self, AnalysisKind, Checked};
use linkdyn_output::Trajectory;
use linkdyn_validation::table::Table;
use linkdyn_validation::{CASES, CaseKind};
use serde_json::json;

const INSTANTS: usize = 2000;
const FROM: f64 = -50.0;
const TO: f64 = 125.0;
/// Where the motion at a constant speed ends, before the change point [deg]; it takes a second.
const STEADY_TO: f64 = 110.0;

fn load(name: &str, sets: &[String]) -> Checked {
    let text = bundled::find(name).expect("bundled").text;
    linkdyn_model::load(text.as_bytes(), sets)
        .expect("a sound model")
        .model
}

/// The lock with 2000 instants over its range.
fn lock() -> Checked {
    let step = (TO - FROM) / (INSTANTS - 1) as f64;
    load(
        "watt-i-lock",
        &[format!("analysis.sample.step=\"{step} deg\"")],
    )
}

/// The lock at a constant speed, with its start and 2000 instants after it.
fn steady_lock() -> Checked {
    let sweep = STEADY_TO - FROM;
    let sets = [
        format!(
            r#"drivers.motor.motion={{"type":"constant_velocity","start":"{FROM} deg","velocity":"{sweep} deg/s"}}"#
        ),
        format!("analysis.sample.to=\"{STEADY_TO} deg\""),
        format!("analysis.sample.step=\"{} deg\"", sweep / INSTANTS as f64),
    ];
    load("watt-i-lock", &sets)
}

fn print_json() {
    let model = steady_lock();
    let runs: Vec<_> = (0..51)
        .map(|_| analysis::run(black_box(&model), &Control::default()).expect("runs"))
        .collect();
    let cpu = runs.iter().map(|outcome| outcome.report.solve.cpu);
    let trajectory = &runs[0].trajectory;
    assert_eq!(trajectory.len(), INSTANTS + 1);
    let forces = ["a", "b", "c", "d", "e", "f", "g"]
        .iter()
        .flat_map(|joint| [format!("joint.{joint}.fx"), format!("joint.{joint}.fy")]);
    let columns: Vec<Vec<f64>> = forces
        .chain(["driver.motor.effort".into()])
        .map(|name| trajectory.values(&name).expect("a column").to_vec())
        .collect();
    let row = |k: usize| columns.iter().map(|column| column[k]).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = (0..=INSTANTS).step_by(20).map(row).collect();
    let cpu = cpu.fold(f64::INFINITY, f64::min);
    println!("{}", json!({ "case": "lock", "cpu": cpu, "forces": rows }));
}

/// Inputs when the driver has this value [rad].
fn inputs_at(system: &System, value: f64) -> Inputs {
    let law = &system.drivers[0].law;
    let time = law.invert(value, 10.0).expect("within the range");
    let mut inputs = Inputs::at_time(system, time);
    inputs.drive[0][0] = value;
    inputs
}

/// Everything up to the loop over the instants.
fn prepare(system: &System) -> (Driven<'_>, Path) {
    let start = Inputs::at_time(system, 0.0);
    let assembled = assembly::assemble(system, &start).expect("assembles");
    let mut driven = Driven::new(system, &assembled.q, &start).expect("regular");
    let mut q = assembled.q;
    driven.correct(&mut q, &start).expect("converges");
    let range = (FROM.to_radians(), TO.to_radians());
    let parameter = (Parameter::of(system), start);
    let path = follow(&mut driven, parameter, (range.0, &q), range, &|_| false).expect("a path");
    (driven, path)
}

/// Largest difference by unit, relative to the largest value of its column or 1 in SI.
fn largest_differences(
    reference: &Table,
    ours: impl Fn(f64, &str) -> Option<f64>,
) -> Vec<(String, f64)> {
    let time = reference
        .columns
        .iter()
        .position(|column| column == "time[s]")
        .expect("a time");
    let mut worst: Vec<(String, f64)> = Vec::new();
    for (index, label) in reference.columns.iter().enumerate() {
        let scale = reference
            .rows
            .iter()
            .fold(1.0, |scale: f64, row| scale.max(row[index].abs()));
        let unit = label
            .rsplit_once('[')
            .map_or("", |(_, unit)| unit.trim_end_matches(']'));
        for row in &reference.rows {
            let Some(ours) = ours(row[time], label) else {
                continue;
            };
            let difference = (ours - row[index]).abs() / scale;
            match worst.iter_mut().find(|(known, _)| known == unit) {
                Some((_, largest)) => *largest = largest.max(difference),
                None => worst.push((unit.to_string(), difference)),
            }
        }
    }
    worst
}

fn words(differences: &[(String, f64)]) -> String {
    differences
        .iter()
        .map(|(unit, largest)| format!("{largest:.1e} [{unit}]"))
        .collect::<Vec<_>>()
        .join(", ")
}

fn reference() -> Table {
    let case = CASES
        .iter()
        .find(|case| case.name == "lock-ideal")
        .expect("bundled");
    let CaseKind::Reference(reference) = case.kind else {
        panic!("a reference case")
    };
    Table::parse(reference.reference).expect("a table")
}

/// Error of the run as the model has it, every 0.1 degree, over all columns of the reference.
fn error_of_run(table: &Table) {
    let outcome = analysis::run(&load("watt-i-lock", &[]), &Control::default()).expect("runs");
    let trajectory: &Trajectory = &outcome.trajectory;
    let times = trajectory.values("time").expect("a time");
    let differences = largest_differences(table, |time, label| {
        let row = times
            .iter()
            .position(|ours| (ours - time).abs() < 1e-9)
            .expect("a common instant");
        trajectory
            .column_index(label)
            .map(|column| trajectory.row(row)[column])
    });
    println!(
        "run, {} instants: error {}",
        trajectory.len(),
        words(&differences)
    );
}

/// Error of the loop at the instants of the reference: angles, their derivatives, reactions and the torque.
fn error_of_instants(table: &Table, system: &System, driven: &mut Driven, path: &Path) {
    let mut sample = Sample::new(system);
    let mut solved: Vec<(f64, Sample)> = Vec::new();
    let value = table
        .columns
        .iter()
        .position(|column| column == "driver.motor.value[rad]")
        .expect("a value");
    let time = table
        .columns
        .iter()
        .position(|column| column == "time[s]")
        .expect("a time");
    for row in &table.rows {
        let inputs = inputs_at(system, row[value]);
        driven::solve_instant(driven, path, &inputs, &mut sample).expect("regular");
        solved.push((row[time], sample.clone()));
    }
    let differences = largest_differences(table, |time, label| {
        let (_, sample) = solved.iter().find(|(at, _)| *at == time)?;
        let name = label.split('[').next()?;
        let (owner, quantity) = name.rsplit_once('.')?;
        if let Some(body) = system.bodies.iter().position(|body| body.name == owner) {
            let coordinates = match quantity {
                "angle" => &sample.q,
                "omega" => &sample.v,
                "alpha" => &sample.a,
                _ => return None,
            };
            return Some(coordinates[3 * body + 2]);
        }
        if let Some(joint) = system
            .joints
            .iter()
            .position(|joint| owner == format!("joint.{}", joint.name))
        {
            let row = system.blocks[joint].row();
            return match quantity {
                "fx" => Some(sample.lambda[row]),
                "fy" => Some(sample.lambda[row + 1]),
                _ => None,
            };
        }
        (name == "driver.motor.effort").then(|| sample.lambda[system.joint_rows()])
    });
    println!("instants: error {}", words(&differences));
}

/// Median time of some runs, per instant [µs].
fn per_instant(mut run: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..21)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2] / INSTANTS as f64 * 1e6
}

fn six_bar(criterion: &mut Criterion) {
    let table = reference();
    let model = lock();
    error_of_run(&table);
    let run = || {
        let outcome = analysis::run(black_box(&model), &Control::default()).expect("runs");
        assert_eq!(outcome.trajectory.len(), INSTANTS);
        black_box(outcome);
    };
    println!("run: {:.2} µs per instant", per_instant(run));

    let system = compile(&model, AnalysisKind::InverseDynamics).expect("compiles");
    let (mut driven, path) = prepare(&system);
    error_of_instants(&table, &system, &mut driven, &path);
    let values = (0..INSTANTS).map(|k| FROM + (TO - FROM) * k as f64 / (INSTANTS - 1) as f64);
    let inputs: Vec<Inputs> = values
        .map(|value| inputs_at(&system, value.to_radians()))
        .collect();
    let mut sample = Sample::new(&system);
    let mut instants = || {
        for inputs in &inputs {
            driven::solve_instant(&mut driven, &path, inputs, &mut sample).expect("regular");
            black_box(&sample);
        }
    };
    println!("instants: {:.2} µs per instant", per_instant(&mut instants));

    let mut group = criterion.benchmark_group("six-bar");
    group.throughput(Throughput::Elements(INSTANTS as u64));
    group.bench_function("run", |bencher| bencher.iter(run));
    group.bench_function("instants", |bencher| bencher.iter(&mut instants));
    group.finish();

    let four_bar = load("four-bar", &[]);
    criterion.bench_function("check four-bar", |bencher| {
        bencher.iter(|| black_box(analysis::check(black_box(&four_bar)).expect("sound")));
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_secs(1));
    targets = six_bar
}

fn main() {
    if std::env::args().any(|argument| argument == "--json") {
        print_json();
        return;
    }
    benches();
    Criterion::default().configure_from_args().final_summary();
}
