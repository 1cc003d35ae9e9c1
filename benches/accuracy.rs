//! What `accuracy` costs beside the run of the same mechanism, and random deviations against what it certifies:
//! `cargo bench --bench accuracy -- --samples 100000 --seed 1 --only NAME --details`.
//!
//! `--only` takes the mechanisms whose name has this in it; `--details` prints every output.
//!
//! Costs are in kinematic runs of the same mechanism, medians of ratios of times of the clock that were taken beside each other; all
//! joints have clearances and all numbers of the geometry tolerances. First of the commands `accuracy` and `run`, from start to end,
//! without and with the files that they write. Then of library calls in one process, by level, with the poses of the stroke on one
//! thread, and on all that the machine has, which the command takes; a run has one, and here nothing of it is read, told or written.
//! Then each case is solved `--samples` times with random deviations, and as many times again with
//! deviations that climb from the farthest ones on. Exit status 1 where one left a certified bound.

#[path = "accuracy/commands.rs"]
mod commands;
// The tests use the rest.
#[allow(dead_code)]
#[path = "../tests/common/accuracy/newton.rs"]
mod newton;
#[allow(dead_code)]
#[path = "../tests/common/accuracy/samples.rs"]
mod samples;
#[allow(dead_code)]
#[path = "../tests/common/accuracy/told.rs"]
mod told;

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::process::ExitCode;
use std::time::Instant;

use commands::{Place, waits};
use linkdyn_engine::analysis::{Control, run};
use linkdyn_model::{GROUND, Model};
use linkdyn_variation::{Levels, Scope};
use samples::{Case, DEGREE, Sampler, case, read};
use serde_json::{Value, json};
use told::{Random, Told, bare, parametric, spoil, tolerate};

/// V1 to V4 of the references, and the random linkages of `validation/`, each at three positions.
const CASES: &[Case] = &[
    case("four-bar", 60.0 * DEGREE, 5e-5, 0.0, true),
    case("four-bar", 60.0 * DEGREE, 5e-4, 1e-4, true),
    case("four-bar", 60.0 * DEGREE, 2e-3, 1e-4, true),
    case("slider-crank", 90.0 * DEGREE, 5e-5, 0.0, true),
    case("slider-crank", 60.0 * DEGREE, 5e-5, 0.0, true),
    case("watt-i-lock", -46.0 * DEGREE, 1e-5, 1e-6, true),
    case("watt-i-lock", 0.0, 1e-5, 1e-6, true),
    case("watt-i-lock", 60.0 * DEGREE, 1e-5, 1e-6, true),
    case("watt-i-lock", 90.0 * DEGREE, 1e-5, 1e-6, true),
    case("watt-i-lock", 105.0 * DEGREE, 1e-5, 0.0, true),
    case("watt-i-lock", 114.0 * DEGREE, 1e-5, 0.0, true),
    case("watt-i-lock", 116.0 * DEGREE, 1e-5, 0.0, true),
    case("watt-i-lock", CHANGE_POINT, 1e-5, 0.0, false),
    case("watt-i-lock", CHANGE_POINT, 1e-4, 0.0, false),
    case("accuracy-random-1", -60.4 * DEGREE, 1e-5, 1e-5, true),
    case("accuracy-random-1", -40.4 * DEGREE, 1e-4, 1e-5, true),
    case("accuracy-random-1", -20.4 * DEGREE, 1e-5, 1e-5, true),
    case("accuracy-random-2", -89.7 * DEGREE, 1e-5, 1e-5, true),
    case("accuracy-random-2", -69.7 * DEGREE, 1e-4, 1e-5, true),
    case("accuracy-random-2", -49.7 * DEGREE, 1e-5, 1e-5, true),
    case("accuracy-random-3", 26.9 * DEGREE, 1e-5, 1e-5, true),
    case("accuracy-random-3", 46.9 * DEGREE, 2e-5, 1e-5, true),
    case("accuracy-random-3", 66.9 * DEGREE, 1e-5, 1e-5, true),
];

/// Of the lock.
const CHANGE_POINT: f64 = 117.512206516644 * DEGREE;
/// A worst case that was found is exceeded by more than this.
const PAST: f64 = 1.0 + 1e-9;
/// Instants of the runs that costs are measured on.
const INSTANTS: usize = 201;
/// Pairs of runs.
const PAIRS: usize = 21;

struct Options {
    samples: usize,
    seed: u64,
    only: Option<String>,
    details: bool,
}

fn options() -> Result<Options, String> {
    let mut options = Options {
        samples: 100_000,
        seed: 1,
        only: None,
        details: false,
    };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or(format!("{word} wants a value"));
        let number = |text: String| {
            text.parse::<u64>()
                .map_err(|error| format!("{text}: {error}"))
        };
        match word.as_str() {
            // Cargo says that this is a benchmark.
            "--bench" => {}
            "--samples" => options.samples = number(value()?)? as usize,
            "--seed" => options.seed = number(value()?)?,
            "--only" => options.only = Some(value()?),
            "--details" => options.details = true,
            other => return Err(format!("there is no option {other}")),
        }
    }
    Ok(options)
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Asks for columns, each under a name of its own.
fn ask<'c>(json: &Value, columns: impl Iterator<Item = &'c str>) -> Value {
    let mut json = json.clone();
    let columns = columns.enumerate();
    let names = columns.map(|(k, column)| (format!("o{k}"), json!({ "column": column })));
    let outputs: serde_json::Map<String, Value> = names.collect();
    json["accuracy"] = json!({ "outputs": outputs });
    json
}

/// What a level may cost by output, in kinematic runs.
const ALLOWED: f64 = 1.5;
/// Outputs beside the first.
const FURTHER: usize = 4;
/// The levels by name.
const LEVELS: [(&str, Levels); 3] = [
    ("first order", Levels::First),
    ("worst found", Levels::Worst),
    ("certified", Levels::Certified),
];

/// Columns beside the first: of bodies all over the mechanism, angles and places.
fn others(model: &Model, first: &str) -> Vec<String> {
    let bodies = model.bodies.keys().filter(|name| *name != GROUND);
    let columns = bodies.flat_map(|body| ["angle", "x", "y"].map(|own| format!("{body}.{own}")));
    let columns: Vec<String> = columns.filter(|column| column != first).collect();
    // Not the first ones, which are of a body that is driven.
    let place = |k: usize| (k + 1) * (columns.len() - 1) / FURTHER;
    (0..FURTHER).map(|k| columns[place(k)].clone()).collect()
}

/// A mechanism, and what is asked of it.
struct Priced {
    plain: Value,
    /// One output, the same again, and others.
    asked: [Value; 3],
}

/// The same, read.
struct Read {
    plain: Told,
    asked: [Told; 3],
}

impl Priced {
    fn new(model: &Model, column: &str, others: &[String]) -> Priced {
        let mut json = parametric(model, INSTANTS);
        spoil(&mut json, 1e-5);
        tolerate(&mut json, 1e-6);
        let mixed = [column]
            .into_iter()
            .chain(others.iter().map(String::as_str));
        Priced {
            plain: bare(model, INSTANTS),
            asked: [
                ask(&json, [column].into_iter()),
                ask(&json, [column; 1 + FURTHER].into_iter()),
                ask(&json, mixed),
            ],
        }
    }

    fn read(&self) -> Read {
        let read = |json| Told::read(json).expect("legal");
        Read {
            plain: read(&self.plain),
            asked: self.asked.each_ref().map(read),
        }
    }

    /// Times of the commands.
    fn tell_commands(&self, name: &str) {
        let place = Place::new(name);
        let asked = [&self.asked[0], &self.asked[2]];
        let each = waits(&place, &self.plain, asked, 1 + FURTHER);
        for (mut waits, what) in each.into_iter().zip(["", ", with their files"]) {
            let [first, other, mean] = waits.costs.each_mut().map(|costs| verdict(costs));
            println!(
                "    commands{what}: run {:.2} ms, first output {first}, another one {other}, mean of {} {mean}",
                waits.run * 1e3,
                1 + FURTHER
            );
        }
    }
}

impl Read {
    /// Seconds of a kinematic run.
    fn run(&self) -> f64 {
        let start = Instant::now();
        black_box(run(&self.plain.loaded.model, &Control::default()).expect("runs"));
        start.elapsed().as_secs_f64()
    }

    /// Seconds of the questions.
    fn ask(&self, levels: Levels, threads: NonZeroUsize) -> [f64; 3] {
        let scope = Scope {
            levels: Some(levels),
            threads: Some(threads),
            ..Scope::default()
        };
        [0, 1, 2].map(|k| {
            let told = &self.asked[k];
            let start = Instant::now();
            black_box(told.ask_for(&told.loaded.model, scope).expect("answers"));
            start.elapsed().as_secs_f64()
        })
    }
}

/// Costs in kinematic runs: of the first output, of the same again, of another one, and the mean of all.
type Costs = [Vec<f64>; 4];

/// Times of a kinematic run, of the commands, and by level of accuracy for one output, the same again, and others, over the same
/// instants. The times of a round are taken beside each other, so that what else the machine does falls on all of them.
fn cost(name: &str, column: &str) {
    let model = read(name);
    let others = others(&model, column);
    let questions = Priced::new(&model, column, &others);
    let priced = questions.read();
    let answer = priced.asked[0].answer();
    let poses = &answer.outputs[0].poses;
    let certified = poses.iter().filter(|pose| pose.certified.is_some()).count();
    let all = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let mut threads = vec![NonZeroUsize::MIN, all];
    threads.dedup();
    let mut runs = Vec::new();
    let mut parts: Vec<[Costs; 3]> = vec![Default::default(); threads.len()];
    for _ in 0..PAIRS {
        for (threads, parts) in threads.iter().zip(&mut parts) {
            let run = priced.run();
            runs.push(run);
            for ((_, levels), [first, further, other, mean]) in LEVELS.iter().zip(parts) {
                let [of_one, of_same, of_mixed] = priced.ask(*levels, *threads);
                first.push(of_one / run);
                further.push((of_same - of_one) / FURTHER as f64 / run);
                other.push((of_mixed - of_one) / FURTHER as f64 / run);
                mean.push(of_mixed / (1 + FURTHER) as f64 / run);
            }
        }
    }
    println!(
        "{name}: {} bodies, {} sources, {} poses, {certified} certified, run {:.3} ms; in such runs:",
        model.bodies.len() - 1,
        answer.sources.len(),
        poses.len(),
        median(&mut runs) * 1e3,
    );
    questions.tell_commands(name);
    for (threads, parts) in threads.iter().zip(&mut parts) {
        println!("    library, threads: {threads}");
        parts
            .iter_mut()
            .zip(LEVELS)
            .for_each(|(part, (level, _))| tell(level, part));
    }
    println!("    the others: {}", others.join(", "));
}

/// The median, and whether it is allowed.
fn verdict(costs: &mut [f64]) -> String {
    let cost = median(costs);
    let verdict = if cost <= ALLOWED { "holds" } else { "exceeds" };
    format!("{cost:6.2} ({verdict} {ALLOWED})")
}

fn tell(level: &str, costs: &mut Costs) {
    let [first, further, other, mean] = costs.each_mut().map(|costs| verdict(costs));
    println!(
        "    {level:11} first output {first}, the same again {further}, another one {other}, mean of {} {mean}",
        1 + FURTHER
    );
}

/// Tries a case; whether nothing left its bounds.
fn sample(case: &Case, options: &Options) -> bool {
    let start = Instant::now();
    let mut sampler = Sampler::new(case);
    let mut random = Random(options.seed);
    sampler.run(options.samples, &mut random);
    let tried = &sampler.tried;
    let [solved, tries] = tried.solved;
    let [bounded, outputs] = tried.bounded;
    println!(
        "{} at {:.3} deg, c {:e}, t {:e}: {solved} of {tries} solved, {bounded} of {outputs} outputs bounded, {:.1} s",
        case.name,
        case.at / DEGREE,
        case.c,
        case.t,
        start.elapsed().as_secs_f64()
    );
    if bounded > 0 {
        let (most, of) = &tried.certified;
        println!("    closest to a certified bound: {most:.9} of it ({of})");
    }
    let (most, of) = &tried.found;
    println!(
        "    worst found: exceeded by more than 1e-9 of it on {} of {} sides; farthest 1 {:+.1e} ({of})",
        tried
            .sides
            .iter()
            .filter(|(_, _, part)| *part > PAST)
            .count(),
        2 * outputs,
        most - 1.0
    );
    if options.details {
        for (of, found, part) in &tried.sides {
            println!("    {of:24} {found:+.9e}: {part:.9}");
        }
    }
    for beyond in &tried.beyond {
        println!("    BEYOND {beyond}");
    }
    let is_whole = !case.is_certain || (bounded == outputs && solved == tries);
    if !is_whole {
        println!("    NOT ALL certified and solved");
    }
    tried.beyond.is_empty() && is_whole
}

fn main() -> ExitCode {
    let options = match options() {
        Ok(options) => options,
        Err(fault) => {
            eprintln!("error: {fault}");
            return ExitCode::from(2);
        }
    };
    let wanted = |name: &str| {
        options
            .only
            .as_deref()
            .is_none_or(|only| name.contains(only))
    };
    let costs = [
        ("four-bar", "rocker.angle"),
        ("slider-crank", "piston.x"),
        ("watt-i-lock", "link2.angle"),
        ("accuracy-random-3", "bar12.angle"),
    ];
    for (name, column) in costs.iter().filter(|(name, _)| wanted(name)) {
        cost(name, column);
    }
    let mut is_within = true;
    for case in CASES.iter().filter(|case| wanted(case.name)) {
        is_within &= sample(case, &options);
    }
    if is_within {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
