//! `linkdyn allocate`: the cheapest tolerances that keep the limits of all outputs.

mod text;

use std::path::PathBuf;

use clap::Args;

use super::accuracy::{answer, answer_with, refuse};
use super::exit::{Exit, Failure};
use super::interrupt;
use super::open::{ModelOptions, Opened};
use super::streams::{complain, print};
use linkdyn_engine::analysis::Control;
use linkdyn_engine::analysis::accuracy::{
    Accuracy, Free, Levels, Limited, Scope, Sum, Unallocated, allocate,
};
use linkdyn_model::error::Complaint;
use linkdyn_model::{Parameter, Tolerance};
use linkdyn_output::replace;
use text::{page, quantity, to_json};

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Limits of an output of the model's `accuracy`, instead of all; may be given more than once
    #[arg(long = "output", value_name = "NAME")]
    outputs: Vec<String>,
    /// Add variances up, as for parts that scatter, and keep three standard deviations (99.73 %) within the limits, instead of all
    /// at their worst
    #[arg(long)]
    rss: bool,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Write the model with these tolerances to this file
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
}

const HELP: &str = "  linkdyn allocate clamp.json
  linkdyn allocate clamp.json --rss --write cheap.json

A tolerance is chosen for each parameter that has a \"cost\" a; it costs a/t for ±t. How: linkdyn docs theory.";

/// Most rounds in which limits are narrowed until the worst case keeps them.
const MOST_ROUNDS: usize = 12;
/// Digits of tolerances and costs.
const DIGITS: usize = 4;
/// Where a tolerance is written with few digits, it is this much narrower at least, so that it never gets wider.
const NARROWER: f64 = 1e-4;
/// A limit counts as kept when it is exceeded by less than this part: round-off.
const KEPT: f64 = 1e-9;

/// A tolerance that was chosen.
struct Chosen<'a> {
    parameter: &'a Parameter,
    cost: f64,
    /// Half width to first order.
    first: f64,
    /// Half width that keeps the limits.
    half: f64,
}

/// What was found.
struct Found<'a> {
    chosen: Vec<Chosen<'a>>,
    /// Parameters with a cost that no limit depends on.
    idle: Vec<&'a str>,
    /// Accuracy with the chosen tolerances.
    accuracy: Accuracy,
    rounds: usize,
}

impl Options {
    /// The outputs, whatever levels the model asks for.
    fn scope(&self, levels: Levels) -> Scope<'_> {
        Scope {
            outputs: &self.outputs,
            levels: Some(levels),
            ..Scope::default()
        }
    }
}

/// Chooses, checks, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let opened = options.model.open()?;
    let control = Control {
        interrupted: interrupt::watch(),
        ..Control::default()
    };
    let first = match answer(&opened, options.scope(Levels::First), &control) {
        Ok(first) => first,
        Err(refusal) => return refuse(&opened, refusal),
    };
    let found = match choose(options, &opened, &first, &control)? {
        Ok(found) => found,
        Err(message) => {
            complain(&message);
            return Ok(Exit::Stopped);
        }
    };
    let mut written = None;
    if let Some(path) = &options.write {
        let sets = sets(&opened, &found.chosen);
        let with = options
            .model
            .open_with(&sets)?
            .map_err(|said| opened.bad_input(said))?;
        let model = with.loaded.source.print(&with.loaded.model);
        replace(path, format!("{model:#}\n").as_bytes())?;
        written = Some(path.display().to_string());
    }
    print(&if options.json {
        format!("{:#}\n", to_json(&opened, options.rss, &found))
    } else {
        page(&opened, options.rss, &found, written.as_deref())
    })?;
    Ok(Exit::Done)
}

/// A parameter with a cost.
#[derive(Clone, Copy)]
struct Costly<'a> {
    parameter: &'a Parameter,
    cost: f64,
    /// As a source of deviations.
    free: Free,
}

/// The parameters with a cost.
fn costly<'a>(opened: &'a Opened, first: &Accuracy) -> Result<Vec<Costly<'a>>, Complaint> {
    if first.outputs.iter().all(|output| output.limits.is_none()) {
        let message = "no output has limits, so any tolerance will do";
        let hint = "as in \"limits\": [\"-0.1 deg\", \"0.1 deg\"]";
        return Err(Complaint::new("accuracy.outputs", message).hint(hint));
    }
    let costly = |parameter: &'a Parameter| {
        let name = format!("parameters.{}", parameter.name);
        let tolerance = parameter.tolerance.as_ref()?;
        Some(Costly {
            parameter,
            cost: tolerance.cost?,
            free: Free {
                source: first.sources.iter().position(|own| *own == name)?,
                scatter: tolerance.distribution.into(),
            },
        })
    };
    let all: Vec<_> = opened.loaded.parameters.iter().filter_map(costly).collect();
    if all.is_empty() {
        let message = "no parameter of the mechanism has a cost, so there is nothing to choose";
        let hint = "as in \"rod\": { \"value\": \"200 mm\", \"cost\": \"1 mm\" }: ±t costs cost/t";
        return Err(Complaint::new("parameters", message).hint(hint));
    }
    Ok(all)
}

/// Tolerances that keep all limits; inside, why there are none.
fn choose<'a>(
    options: &Options,
    opened: &'a Opened,
    first: &Accuracy,
    control: &Control,
) -> Result<Result<Found<'a>, String>, Failure> {
    let all = costly(opened, first).map_err(|complaint| opened.bad_input(complaint.into()))?;
    let sum = if options.rss {
        Sum::Squares
    } else {
        Sum::Worst
    };
    let free: Vec<Free> = all.iter().map(|one| one.free).collect();
    let rooms = first.rooms(&free, sum, &|_| 1.0);
    let matters = |k: &usize| rooms.iter().any(|limited| limited.room.weights[*k] > 0.0);
    let (used, idle): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(matters);
    let idle = idle
        .iter()
        .map(|&k| all[k].parameter.name.as_str())
        .collect();
    let used: Vec<Costly> = used.iter().map(|&k| all[k]).collect();
    let free: Vec<Free> = used.iter().map(|one| one.free).collect();
    let costs: Vec<f64> = used.iter().map(|one| one.cost).collect();
    let mut parts = vec![1.0; first.outputs.len()];
    let mut linear: Option<Vec<f64>> = None;
    let mut last = None;
    for rounds in 1..=MOST_ROUNDS {
        let limited = last
            .as_ref()
            .unwrap_or(first)
            .rooms(&free, sum, &|output| parts[output]);
        let rooms: Vec<_> = limited.iter().map(|limited| limited.room.clone()).collect();
        let halves = match allocate(&costs, &rooms, sum) {
            Ok(halves) => halves,
            Err(why) => return Ok(Err(told(opened, first, &limited, why))),
        };
        let linear = linear.get_or_insert_with(|| halves.clone());
        let chosen: Vec<Chosen> = used
            .iter()
            .zip(halves.iter().zip(&*linear))
            .map(|(one, (half, first))| Chosen {
                parameter: one.parameter,
                cost: one.cost,
                first: *first,
                half: *half,
            })
            .collect();
        let parameters = with_tolerances(&opened.loaded.parameters, &chosen);
        let scope = options.scope(Levels::Certified);
        let Ok(accuracy) = answer_with(opened, &parameters, scope, control) else {
            return Ok(Err(
                "the mechanism can't be had with these tolerances".into()
            ));
        };
        let exceeded = narrow(&accuracy, &mut parts);
        if options.rss || !exceeded {
            return Ok(Ok(Found {
                chosen,
                idle,
                accuracy,
                rounds,
            }));
        }
        last = Some(accuracy);
    }
    Ok(Err("no tolerances were found whose worst case keeps all limits: near singular positions it is not proportional to them".into()))
}

/// Narrows the parts of the limits that may be used where a worst case exceeds them; whether one does.
fn narrow(accuracy: &Accuracy, parts: &mut [f64]) -> bool {
    let mut exceeded = false;
    for (part, output) in parts.iter_mut().zip(&accuracy.outputs) {
        if let Some(used) = output.used().filter(|used| *used > 1.0) {
            *part /= used;
            exceeded |= used > 1.0 + KEPT;
        }
    }
    exceeded
}

/// Why nothing could be chosen.
fn told(opened: &Opened, first: &Accuracy, limited: &[Limited], why: Unallocated) -> String {
    let display = &opened.loaded.model.display;
    match why {
        Unallocated::NoRoom(number) => {
            let output = &first.outputs[limited[number].output];
            let pose = &output.poses[limited[number].pose];
            let at =
                pose.drivers
                    .iter()
                    .zip(&*pose.driver_units)
                    .map(|(value, unit)| match *unit {
                        "rad" => display.angle(*value),
                        _ => display.length(*value),
                    });
            format!(
                "the limits of {} leave no room for tolerances where the drivers stand at {}: what has no cost uses them up (widen the limits, or narrow the clearances)",
                output.name,
                at.collect::<Vec<_>>().join(", ")
            )
        }
        Unallocated::Free(_) => "a parameter has no influence on any limit".into(),
        Unallocated::Unsolved(why) => format!("the cone program was not solved: {why}"),
    }
}

/// The parameters, with the tolerances that were chosen.
fn with_tolerances(all: &[Parameter], chosen: &[Chosen]) -> Vec<Parameter> {
    let mut all = all.to_vec();
    for parameter in &mut all {
        let own = chosen
            .iter()
            .find(|own| own.parameter.name == parameter.name);
        if let (Some(own), Some(tolerance)) = (own, &mut parameter.tolerance) {
            let middle = tolerance.middle();
            (tolerance.lower, tolerance.upper) = (middle - own.half, middle + own.half);
        }
    }
    all
}

/// `--set` of the tolerances: with few digits, never wider than they are, or with all where the middle is off the value.
fn sets(opened: &Opened, chosen: &[Chosen]) -> Vec<String> {
    let set = |chosen: &Chosen| {
        let Chosen {
            parameter, half, ..
        } = chosen;
        let middle = parameter.tolerance.as_ref().map_or(0.0, Tolerance::middle);
        let words = if middle == 0.0 {
            let half = half * (1.0 - NARROWER);
            quoted(parameter, quantity(opened, parameter, half, DIGITS + 1))
        } else {
            let [low, high] = [middle - half, middle + half]
                .map(|value| quoted(parameter, format!("{value:e}{}", unit(parameter))));
            format!("[{low}, {high}]")
        };
        format!("parameters.{}.tolerance={words}", parameter.name)
    };
    chosen.iter().map(set).collect()
}

/// A quantity as JSON has it: a plain number as it is, with a unit in quotes.
fn quoted(parameter: &Parameter, quantity: String) -> String {
    match parameter.unit.as_str() {
        "" => quantity,
        _ => format!("\"{quantity}\""),
    }
}

fn unit(parameter: &Parameter) -> String {
    match parameter.unit.as_str() {
        "" => String::new(),
        unit => format!(" {unit}"),
    }
}
