//! Commands on a mutant of a model.

use std::fs;
use std::path::Path;

use linkdyn::cli::Said;
use linkdyn_engine::analysis::{self, Control};
use linkdyn_model::error::Complaint;
use linkdyn_model::{self, DriverKind, JointKind, Loaded, Model};

use super::super::rng::Rng;
use super::super::runner::caught;
use super::super::{Fuzzer, Mutant};
use super::{Find, Trial, is_odd};

/// Time that a command without a limit may take [s].
const CHECK: f64 = 2.0;
/// Time that one with many runs may take [s].
const SLOW: f64 = 20.0;
/// Rows that are wanted at most.
const MOST_ROWS: f64 = 2000.0;

/// The words of a command line that name the mutant: its file and its `--set`s.
struct Base(Vec<String>);

impl Base {
    fn new(file: String, mutant: &Mutant) -> Self {
        let mut words = vec![file];
        words.extend(sets(&mutant.sets));
        Base(words)
    }

    /// A command on it, with more `--set`s and options.
    fn with(&self, command: &str, more: &[String], options: &[&str]) -> Vec<String> {
        let options = options.iter().map(|word| word.to_string());
        std::iter::once(command.to_string())
            .chain(self.0.iter().cloned())
            .chain(sets(more))
            .chain(options)
            .collect()
    }
}

fn sets(values: &[String]) -> impl Iterator<Item = String> {
    values
        .iter()
        .flat_map(|set| ["--set".to_string(), set.clone()])
}

/// A mutant of a model.
pub fn model(fuzzer: &Fuzzer, mut rng: Rng, mutant: &Mutant) -> Vec<Find> {
    let mut trial = Trial {
        fuzzer,
        finds: Vec::new(),
        odd: is_odd(mutant),
    };
    let file = trial.path("mutant.json");
    let _ = fs::write(&file, &mutant.bytes);
    let base = Base::new(file, mutant);
    match caught(|| linkdyn_model::load(&mutant.bytes, &mutant.sets)) {
        Ok(Ok(loaded)) => accepted(&mut trial, &mut rng, &base, &loaded),
        Ok(Err(complaints)) => refused(&mut trial, &mut rng, &base, &complaints),
        Err(words) => trial.find("panic", "load", words),
    }
    trial.finds
}

fn refused(trial: &mut Trial, rng: &mut Rng, base: &Base, complaints: &[Complaint]) {
    trial.complaints("load", complaints);
    if rng.once_in(8)
        && let Some(said) = trial.run(&base.with("check", &[], &[]), &[2], CHECK)
        && said.status != 2
    {
        trial.find(
            "status",
            "check",
            format!("exit status {} of a model that is refused", said.status),
        );
    }
}

fn accepted(trial: &mut Trial, rng: &mut Rng, base: &Base, loaded: &Loaded) {
    let limit = trial.fuzzer.limit;
    let options: &[&str] = if rng.once_in(2) { &["--json"] } else { &[] };
    if let Some(said) = trial.run(&base.with("check", &[], options), &[1, 2, 3], CHECK)
        && said.stdout.starts_with('{')
    {
        trial.json("check --json", &said.stdout);
    }
    if loaded.model.analysis.is_some() {
        let sets = limits(limit, loaded);
        run(trial, rng, base, &sets, loaded);
    }
    if rng.once_in(2) {
        let kind = rng.word(&[
            "assembly",
            "kinematics",
            "inverse_dynamics",
            "dynamics",
            "statics",
        ]);
        let end = [0.01, 0.3, 2.0][rng.below(3)];
        let analysis = format!(
            "analysis={{\"type\":\"{kind}\",\"end\":\"{end} s\",\"outputs\":12,\"solver\":{{\"max_wall_time\":\"{limit} s\"}}}}"
        );
        run(trial, rng, base, &[analysis], loaded);
    }
    if rng.once_in(3) {
        modes(trial, rng, base);
    }
    if loaded.model.accuracy.is_some() && rng.once_in(4) {
        let options = ["--levels", "worst", "--threads", "1"];
        trial.run(&base.with("accuracy", &[], &options), &[2, 3], SLOW);
    }
    if rng.once_in(8) {
        study(trial, base, &limits(limit, loaded), loaded);
    }
    if rng.once_in(4) && has_clearance(&loaded.model) && loaded.model.analysis.is_some() {
        compare(trial, base, &limits(limit, loaded));
    }
}

/// What `run` refuses `check` refuses, in the same words, and nothing else.
fn refuses_alike(trial: &mut Trial, arguments: &[String], run: &Said) {
    let Some(check) = trial.run(arguments, &[1, 2, 3], CHECK) else {
        return;
    };
    let [run, check] = [run, &check].map(|said| (said.status == 2).then_some(&said.stderr));
    if run != check {
        let what = format!("run {run:?}, check {check:?}");
        trial.find("refusal", &arguments.join(" "), what);
    }
}

fn modes(trial: &mut Trial, rng: &mut Rng, base: &Base) {
    let folder = trial.path("modes");
    let all = ["-o", folder.as_str(), "--pose"];
    let arguments = base.with("modes", &[], if rng.once_in(3) { &all } else { &all[..2] });
    if let Some(said) = trial.run(&arguments, &[2, 3], CHECK)
        && said.status == 0
    {
        trial.table("modes", &Path::new(&folder).join("modes.csv"), true);
    }
}

/// A study of two variants; a panic in one is a row.
fn study(trial: &mut Trial, base: &Base, sets: &[String], loaded: &Loaded) {
    let moving = loaded.model.bodies.keys().find(|name| *name != "ground");
    let (Some(parameter), Some(body)) = (loaded.parameters.first(), moving) else {
        return;
    };
    let (name, value, unit) = (&parameter.name, parameter.value, &parameter.unit);
    let (vary, response) = (
        format!(
            "parameters.{name}={value:?} {unit}, {:?} {unit}",
            1.01 * value
        ),
        format!("own = max({body}.x)"),
    );
    let options = ["--vary", &vary, "--response", &response, "--threads", "1"];
    if let Some(said) = trial.run(&base.with("study", sets, &options), &[2, 3], SLOW)
        && said.stdout.contains("failed: ")
    {
        trial.find("panic", "study", said.stdout);
    }
}

fn compare(trial: &mut Trial, base: &Base, sets: &[String]) {
    let folder = trial.path("compared");
    let _ = fs::remove_dir_all(&folder);
    let arguments = base.with("compare", sets, &["--joint", "all", "-o", &folder]);
    if let Some(said) = trial.run(&arguments, &[2, 3], 5.0 * trial.fuzzer.limit)
        && said.status != 2
    {
        trial.table("compare", &Path::new(&folder).join("compare.csv"), false);
        let text = fs::read_to_string(Path::new(&folder).join("compare.json")).unwrap_or_default();
        trial.json("compare", &text);
    }
}

fn has_clearance(model: &Model) -> bool {
    model.joints.values().any(|joint| {
        matches!(
            &joint.kind,
            JointKind::Revolute {
                clearance: Some(_),
                ..
            }
        )
    })
}

/// A limit of time, and of rows where there would be very many.
fn limits(limit: f64, loaded: &Loaded) -> Vec<String> {
    let mut sets = vec![format!("analysis.solver.max_wall_time=\"{limit} s\"")];
    let Some(analysis) = &loaded.model.analysis else {
        return sets;
    };
    if analysis
        .outputs
        .is_some_and(|outputs| outputs as f64 > MOST_ROWS)
    {
        sets.push("analysis.outputs=101".into());
    }
    if let Some(sample) = &analysis.sample {
        let rows = ((sample.to - sample.from) / sample.step).abs();
        if rows > MOST_ROWS {
            let step = sample.step.abs() * rows / 100.0;
            let unit = if loaded
                .model
                .drivers
                .get(&sample.driver)
                .is_some_and(|driver| matches!(driver.kind, DriverKind::Rotation { .. }))
            {
                "rad"
            } else {
                "m"
            };
            sets.push(format!("analysis.sample.step=\"{step:e} {unit}\""));
        }
    }
    sets
}

/// `run -o`, its files, and sometimes pictures of them.
fn run(trial: &mut Trial, rng: &mut Rng, base: &Base, sets: &[String], loaded: &Loaded) {
    let folder = trial.path("out");
    for name in ["results.csv", "summary.json", "report.html"] {
        let _ = fs::remove_file(Path::new(&folder).join(name));
    }
    let arguments = base.with("run", sets, &["-o", &folder]);
    let Some(said) = trial.run(&arguments, &[2, 3], trial.fuzzer.limit) else {
        return;
    };
    refuses_alike(trial, &base.with("check", sets, &[]), &said);
    if said.status == 2 {
        // The complaints of an analysis are those of the command.
        if let Ok(Err(complaints)) = caught(|| {
            analysis::run(
                &loaded.model,
                &Control {
                    interrupted: std::sync::Arc::new(true.into()),
                    ..Control::default()
                },
            )
        }) {
            trial.complaints("run", &complaints);
        }
        return;
    }
    let rows = trial.files(&arguments.join(" "), &said, Path::new(&folder));
    if rows > 0 && rng.once_in(6) {
        trial.pictures(rng, &folder);
    }
}
