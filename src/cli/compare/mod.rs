//! `linkdyn compare`: one model with each model of a joint's clearance, and how far their results are apart.

mod figures;
mod report;

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;

use super::open::{ModelOptions, Opened};
use super::progress::Line;
use super::{BadInput, Exit, complain, interrupt, nearest, print};
use crate::files::{open_directory, write};
use crate::run::deadline;
use linkdyn_engine::analysis::{self, Control, Outcome};
use linkdyn_model::error::Complaint;
use linkdyn_model::{DriverKind, GROUND, JointKind, Model};
use linkdyn_output::comparison::{Comparison, Run};
use linkdyn_output::{Column, Directory, Trajectory, csv};
use report::Report;

/// The ladder of clearance models, simple ones first.
const LADDER: [&str; 5] = [
    "ideal",
    "massless_link",
    "two_state",
    "three_state",
    "contact",
];
const TABLE: &str = "compare.csv";
const SUMMARY: &str = "compare.json";
/// All joints that have a clearance.
const ALL: &str = "all";
/// What changes by less than this is round-off \[SI\].
const STILL: f64 = 1e-10;
/// Quantities of the last body that are compared where no columns are asked for.
const MOTION: [&str; 9] = ["x", "y", "angle", "vx", "vy", "omega", "ax", "ay", "alpha"];

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Joint whose clearance model changes; may be given more than once, or `all` that have a clearance
    #[arg(long = "joint", value_name = "NAME", required = true)]
    joints: Vec<String>,
    /// Clearance models, the first is what the others are compared with [default: ideal, massless_link, two_state,
    /// three_state and contact, as far as the file has their parameters]
    #[arg(long, value_name = "MODEL,…", value_delimiter = ',')]
    models: Vec<String>,
    /// Result columns to compare: names without unit, `*` any text, `?` one character [default: drivers' efforts, forces in
    /// the joints, motion of the last body that is not driven]
    #[arg(long, value_name = "PATTERN,…", value_delimiter = ',')]
    columns: Vec<String>,
    /// Write each model's results into a directory of its name below this one, and compare.csv, compare.json and a figure
    /// of each column (SVG)
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "Only \"model\" of the joints' clearance changes from run to run. joint.NAME.force is the magnitude of a \
joint's force.\n\nExit status: that of the run that went worst: 3 where one stopped early, 2 where a model asked for by \
--models can't be run; models of the default ladder that can't be run are skipped.";

/// What came of a model.
struct Rung {
    model: &'static str,
    /// The run, or why there is none.
    ran: Result<Outcome, String>,
}

/// Runs all, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, BadInput> {
    let opened = options.model.open()?;
    let joints = joints(&opened, &options.joints)?;
    let (models, wanted) = (models(&options.models)?, !options.models.is_empty());
    let directory = options.output.as_deref().map(open_output).transpose()?;
    let mut rungs = Vec::new();
    let mut exit = Exit::Done;
    for &model in &models {
        let rung = Rung {
            model,
            ran: run(options, &joints, model, directory.as_ref())?,
        };
        let ended = match &rung.ran {
            Ok(outcome) => Exit::from(outcome.report.status),
            Err(_) if wanted => Exit::BadInput,
            Err(_) => Exit::Done,
        };
        exit = worse(exit, ended);
        rungs.push(rung);
        // All runs have the columns of the first one, so that the others need not be waited for.
        if rungs.iter().filter(|rung| rung.ran.is_ok()).count() == 1 {
            let unmatched =
                compare(&opened.loaded.model, &joints, &rungs, &options.columns).unmatched;
            if !unmatched.is_empty() {
                return Err(BadInput(
                    unmatched.iter().map(|pattern| no_column(pattern)).collect(),
                ));
            }
        }
        // Also between two runs, and where a run ended before it looked.
        if interrupt::is_set() && rungs.len() < models.len() {
            exit = Exit::Interrupted;
            break;
        }
    }
    if rungs.iter().all(|rung| rung.ran.is_err()) {
        let reasons = rungs
            .iter()
            .filter_map(|rung| Some((rung.model, rung.ran.as_ref().err()?)));
        return Err(BadInput(
            reasons
                .map(|(model, why)| format!("{}: {model}: {why}", opened.label))
                .collect(),
        ));
    }
    let comparison = compare(&opened.loaded.model, &joints, &rungs, &options.columns);
    let curves = curves(&joints, &rungs);
    let report = Report {
        opened: &opened,
        joints: &joints,
        rungs: &rungs,
        wanted,
        comparison: &comparison,
        curves: &curves,
    };
    let mut written = Vec::new();
    if let Some(directory) = &directory {
        written.push(directory.write_with(TABLE, |file| csv::write(&comparison.curves, file))?);
        written.push(directory.write(SUMMARY, format!("{:#}\n", report.json()).as_bytes())?);
        for (name, figure) in figures::figures(&comparison.columns, &curves) {
            written.push(directory.write(&name, figure.as_bytes())?);
        }
    }
    print(&report.page(&written))?;
    if rungs.len() < models.len() {
        complain(&format!(
            "interrupted: {} left out",
            models[rungs.len()..].join(", ")
        ));
    }
    for rung in &rungs {
        match &rung.ran {
            Err(why) if wanted => complain(&format!("{}: {why}", rung.model)),
            Ok(outcome) if Exit::from(outcome.report.status) != Exit::Done => {
                let status = outcome.report.status.word();
                complain(&format!(
                    "{}: {}",
                    rung.model,
                    outcome.report.message.as_deref().unwrap_or(status)
                ));
            }
            Ok(_) | Err(_) => {}
        }
    }
    Ok(exit)
}

fn no_column(pattern: &str) -> String {
    format!("--columns {pattern:?}: matches no column (names without [unit], as in results.csv)")
}

/// What to tell of two ends: an interruption, then a stop, then bad input.
fn worse(a: Exit, b: Exit) -> Exit {
    let rank = |exit: Exit| match exit {
        Exit::Done => 0,
        Exit::Fault => 1,
        Exit::BadInput => 2,
        Exit::Stopped => 3,
        Exit::Interrupted => 4,
    };
    if rank(b) > rank(a) { b } else { a }
}

/// The joints of these names, each with a clearance.
fn joints(opened: &Opened, names: &[String]) -> Result<Vec<String>, BadInput> {
    let known = &opened.loaded.model.joints;
    let has_clearance = |kind: &JointKind| matches!(kind, JointKind::Revolute { clearance, .. } if clearance.is_some());
    let mut found: Vec<String> = Vec::new();
    let mut complaints = Vec::new();
    for name in names {
        match known.get(name) {
            Some(joint) if has_clearance(&joint.kind) => found.push(name.clone()),
            Some(joint) => complaints.push(without(name, &joint.kind)),
            None if name == ALL => {
                let all = known.iter().filter(|(_, joint)| has_clearance(&joint.kind));
                found.extend(all.map(|(name, _)| name.clone()));
                if found.is_empty() {
                    let said = Complaint::new(
                        "joints",
                        "no joint has a \"clearance\" whose model could be changed",
                    );
                    complaints.push(said.hint(ADD));
                }
            }
            None => {
                let said = Complaint::new(
                    "joints",
                    format!("there is no joint {name:?}, as --joint says"),
                );
                complaints.push(match nearest(name, known.keys().map(String::as_str)) {
                    Some(near) => said.hint(format!("did you mean {near:?}?")),
                    None => said.hint(format!(
                        "there are {}",
                        known.keys().cloned().collect::<Vec<_>>().join(", ")
                    )),
                });
            }
        }
    }
    let mut seen = std::collections::HashSet::new();
    found.retain(|name| seen.insert(name.clone()));
    if complaints.is_empty() {
        Ok(found)
    } else {
        Err(opened.bad_input(complaints))
    }
}

const ADD: &str = "add \"clearance\": { \"model\": \"ideal\", \"radius\": …, and the parameters of the models to compare: \
\"bearing_radius\" and \"normal\" for contact, \"surface\" for two_state, \"impact\" for three_state }";

fn without(name: &str, kind: &JointKind) -> Complaint {
    let path = format!("joints.{name}");
    match kind {
        JointKind::Revolute { .. } => {
            Complaint::new(path, "has no \"clearance\" whose model could be changed").hint(ADD)
        }
        JointKind::Prismatic { .. }
        | JointKind::Slot { .. }
        | JointKind::Gear { .. }
        | JointKind::Fixed { .. } => {
            Complaint::new(path, "only a revolute joint can have a clearance")
                .hint("name another joint")
        }
    }
}

/// The models of these names, each once, or the whole ladder.
fn models(names: &[String]) -> Result<Vec<&'static str>, BadInput> {
    if names.is_empty() {
        return Ok(LADDER.to_vec());
    }
    let mut models = Vec::new();
    for name in names {
        let Some(model) = LADDER.into_iter().find(|model| model == name) else {
            let hint =
                nearest(name, LADDER.into_iter()).map(|near| format!(" (did you mean {near:?}?)"));
            let known = LADDER.join(", ");
            let hint = hint.unwrap_or_default();
            return Err(BadInput(vec![format!(
                "--models: there is no clearance model {name:?}, only {known}{hint}"
            )]));
        };
        if !models.contains(&model) {
            models.push(model);
        }
    }
    Ok(models)
}

fn open_output(path: &Path) -> Result<Directory, BadInput> {
    let directory = Directory::open(path)?;
    directory.expect_free(TABLE)?;
    directory.expect_free(SUMMARY)?;
    Ok(directory)
}

/// Runs with one clearance model and writes its results; inside, why it can't be run.
fn run(
    options: &Options,
    joints: &[String],
    model: &str,
    directory: Option<&Directory>,
) -> Result<Result<Outcome, String>, BadInput> {
    let started = Instant::now();
    let sets: Vec<String> = joints
        .iter()
        .map(|joint| format!("joints.{joint}.clearance.model={model}"))
        .collect();
    let opened = match options.model.open_with(&sets)? {
        Ok(opened) => opened,
        Err(complaints) => return Ok(Err(reason(&complaints))),
    };
    let deadline = deadline(&opened.loaded.model, started);
    let control = Control {
        deadline,
        interrupted: interrupt::watch(),
        ..Control::default()
    };
    let progress = control.progress.clone();
    let line = Line::start(started, model, move || progress.share());
    let ran = analysis::run(&opened.loaded.model, &control);
    drop(line);
    let mut outcome = match ran {
        Ok(outcome) => outcome,
        Err(complaints) => return Ok(Err(reason(&complaints))),
    };
    outcome
        .report
        .warnings
        .splice(0..0, opened.loaded.warnings.iter().cloned());
    if let Some(directory) = directory {
        let directory = open_directory(&directory.path().join(model))?;
        write(&directory, opened.origin(), &outcome)?;
    }
    Ok(Ok(outcome))
}

/// Complaints as a line; where they stand in the file does not matter here.
fn reason(complaints: &[Complaint]) -> String {
    let said = complaints.iter().map(
        |Complaint {
             path,
             message,
             hint,
             ..
         }| {
            let hint = hint
                .as_ref()
                .map(|hint| format!(" ({hint})"))
                .unwrap_or_default();
            format!("{path}: {message}{hint}")
        },
    );
    said.collect::<Vec<_>>().join("; ")
}

fn compare(model: &Model, joints: &[String], rungs: &[Rung], patterns: &[String]) -> Comparison {
    let outcomes = rungs
        .iter()
        .filter_map(|rung| Some((rung.model, rung.ran.as_ref().ok()?)));
    let tables: Vec<(&str, Trajectory)> = outcomes
        .map(|(name, outcome)| (name, with_forces(outcome.trajectory.clone(), joints)))
        .collect();
    let runs: Vec<Run> = tables
        .iter()
        .map(|(name, trajectory)| Run { name, trajectory })
        .collect();
    if !patterns.is_empty() {
        return Comparison::new(&runs, patterns);
    }
    let mut usual = vec!["driver.*.effort".to_string()];
    usual.extend(joints.iter().flat_map(|joint| {
        ["force", "fx", "fy"].map(|quantity| format!("joint.{joint}.{quantity}"))
    }));
    if let Some(last) = last_body(model) {
        // A slider does not turn, a body on the ground's pin stays in place.
        let moves = |name: &String| {
            let values = || {
                runs.iter()
                    .filter_map(|run| run.trajectory.values(name))
                    .flatten()
            };
            let (low, high) = (
                values().fold(f64::INFINITY, f64::min),
                values().fold(f64::NEG_INFINITY, f64::max),
            );
            high - low > STILL
        };
        usual.extend(
            MOTION
                .map(|quantity| format!("{last}.{quantity}"))
                .into_iter()
                .filter(moves),
        );
    }
    // Kinematics has no forces, `analysis.columns` may have left out any.
    Comparison {
        unmatched: Vec::new(),
        ..Comparison::new(&runs, &usual)
    }
}

/// What each model's curves are drawn from: its outputs, and the rows of peaks between them.
fn curves(joints: &[String], rungs: &[Rung]) -> Vec<(&'static str, Trajectory)> {
    let ran = rungs
        .iter()
        .filter_map(|rung| Some((rung.model, rung.ran.as_ref().ok()?)));
    ran.map(|(model, outcome)| (model, with_forces(outcome.curves().into_owned(), joints)))
        .collect()
}

/// The last body that no driver turns by itself, or the last.
fn last_body(model: &Model) -> Option<&String> {
    let turned = |name: &String| {
        model
            .drivers
            .values()
            .any(|driver| matches!(&driver.kind, DriverKind::Rotation { body, .. } if body == name))
    };
    let mut bodies = model.bodies.keys().filter(|name| *name != GROUND);
    bodies
        .clone()
        .rfind(|name| !turned(name))
        .or(bodies.next_back())
}

/// The table with the magnitude of the joints' forces.
fn with_forces(mut table: Trajectory, joints: &[String]) -> Trajectory {
    for joint in joints {
        let components =
            ["fx", "fy"].map(|quantity| table.values(&format!("joint.{joint}.{quantity}")));
        if let [Some(fx), Some(fy)] = components {
            let magnitudes: Vec<f64> = fx.iter().zip(&fy).map(|(x, y)| x.hypot(*y)).collect();
            table.push_column(
                Column::new(format!("joint.{joint}.force"), "N"),
                &magnitudes,
            );
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_are_known_by_name_and_taken_once() {
        let models = |names: &[&str]| {
            models(
                &names
                    .iter()
                    .map(|name| (*name).to_string())
                    .collect::<Vec<_>>(),
            )
        };
        assert_eq!(models(&[]), Ok(LADDER.to_vec()));
        assert_eq!(
            models(&["contact", "ideal", "contact"]),
            Ok(vec!["contact", "ideal"])
        );
        let said = models(&["contacts"]).expect_err("unknown");
        assert!(
            said.0[0].ends_with("(did you mean \"contact\"?)"),
            "{said:?}"
        );
    }

    #[test]
    fn the_worst_end_counts() {
        assert_eq!(worse(Exit::BadInput, Exit::Stopped), Exit::Stopped);
        assert_eq!(worse(Exit::Interrupted, Exit::BadInput), Exit::Interrupted);
        assert_eq!(worse(Exit::Done, Exit::Done), Exit::Done);
    }
}
