//! `linkdyn check`: reads, assembles and diagnoses a model.

use std::path::PathBuf;

use clap::Args;
use serde_json::{Map, Value, json};

use super::diagnosis;
use super::exit::{Exit, Failure};
use super::open::{ModelOptions, Opened, bad_input};
use super::optimise;
use super::page::{Page, names, number, shorten, wrapped};
use super::refused;
use super::responses;
use super::streams::{complain, print};
use super::study;
use super::tolerances;
use super::words::{analysis_words, mobility, status_words};
use linkdyn_engine::analysis::{self, Check, Lack};
use linkdyn_model::AnalysisKind;
use linkdyn_model::error::Complaints;
use linkdyn_output::{Directory, Mobility, Status};

/// Width of long texts on the page.
const WIDTH: usize = 96;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Print the diagnosis as JSON
    #[arg(long)]
    json: bool,
    /// Write check.html into this directory (made where missing): the model with its names, loops, and what is wrong at its place
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "  linkdyn check mine.json
  linkdyn check lock --json

What a message means, and what to do: linkdyn docs messages.";

/// Diagnoses and tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let opened = match options.model.open_with(&[])? {
        Ok(opened) => opened,
        Err(complaints) => return refuse(options, complaints),
    };
    let directory = options.output.as_deref().map(Directory::open).transpose()?;
    let mut check =
        analysis::check(&opened.loaded.model).map_err(|complaints| opened.bad_input(complaints))?;
    let suspicious = suspicious(&opened, &mut check);
    check.warnings.splice(
        0..0,
        opened.loaded.warnings.iter().chain(&suspicious).cloned(),
    );
    let lacks: Vec<String> = check.lacks.iter().map(lack_words).collect();
    let written = directory
        .map(|directory| diagnosis::write(&directory, &opened, &check, &verdict(&check), &lacks))
        .transpose()?;
    print(&if options.json {
        format!("{:#}\n", to_json(&opened, &check, &suspicious))
    } else {
        page(&opened, &check, written)
    })?;
    check
        .faults
        .iter()
        .for_each(|fault| complain(&format!("{}: {fault}", opened.label)));
    if !check.refused.is_empty() {
        return Err(opened.bad_input(Complaints(check.refused)));
    }
    match Exit::from(check.status) {
        Exit::Done if check.faults.is_empty() => Ok(Exit::Done),
        Exit::Done => Ok(Exit::Fault),
        exit @ (Exit::Fault
        | Exit::BadInput
        | Exit::Stopped
        | Exit::Unwritten
        | Exit::Broken
        | Exit::Interrupted) => {
            complain(check.message.as_deref().unwrap_or(check.status.word()));
            Ok(exit)
        }
    }
}

/// Tells why a model is refused, with a page where one was asked for.
fn refuse(options: &Options, complaints: Complaints) -> Result<Exit, Failure> {
    if let Some(output) = &options.output {
        let written = refused::write(&Directory::open(output)?, &options.model, &complaints)?;
        let mut page = Page::default();
        page.row("written", written.display().to_string());
        if !options.json {
            print(page.text())?;
        }
    }
    Err(bad_input(&options.model.label(), complaints))
}

/// The diagnosis for people.
fn page(opened: &Opened, check: &Check, written: Option<PathBuf>) -> String {
    let model = &opened.loaded.model;
    let mut page = Page::default();
    page.line(format!(
        "{} ({}): {}",
        opened.name,
        opened.label,
        verdict(check)
    ));
    let parts = [
        ("moving bodies", check.bodies),
        ("joints", check.joints),
        ("drivers", model.drivers.len()),
    ];
    let parts = parts.map(|(what, n)| format!("{what} {n}"));
    page.row(
        "parts",
        format!("{}, forces {}", parts.join(", "), model.forces.len()),
    );
    let loops = check.loops.iter().zip(&check.loop_bodies);
    let loops: Vec<String> = loops
        .map(|(joints, bodies)| format!("{joints}  (through {})", bodies.join(", ")))
        .collect();
    page.rows(
        "loops",
        if loops.is_empty() {
            vec!["none".to_string()]
        } else {
            folded(loops)
        },
    );
    page.rows("mobility", wrapped(&check.words, WIDTH));
    match &check.open {
        None => page.row("", mobility(&check.mobility)),
        Some(open) => {
            page.row("", format!("ideal pins: {}", mobility(&check.mobility)));
            page.row("", format!("free journals: {}", mobility(&open.mobility)));
        }
    }
    let residual = check.assembly_residual;
    let assembly = format!("constraint residual {}", number(residual, 2));
    page.row(
        "assembly",
        if residual.is_nan() {
            "none".to_string()
        } else {
            assembly
        },
    );
    let parameters = &opened.loaded.parameters;
    let resolved = parameters
        .iter()
        .map(|p| format!("{} = {} {}", p.name, number(p.value, 6), p.unit));
    page.rows(
        "parameters",
        resolved.map(|text| text.trim_end().to_string()),
    );
    tolerances::rows(&mut page, &opened.loaded);
    responses::rows(&mut page, opened);
    if let Some(own) = &opened.loaded.model.study {
        page.rows("study", study::rows(own));
    }
    optimise::rows(&mut page, opened);
    page.rows(
        "lacking",
        folded(check.lacks.iter().map(lack_words).collect()),
    );
    page.rows("warnings", folded(check.warnings.clone()));
    page.rows(
        "written",
        written.iter().map(|path| path.display().to_string()),
    );
    page.text().to_string()
}

/// Not more texts than anybody reads, none wider than the page.
fn folded(texts: Vec<String>) -> Vec<String> {
    shorten(texts)
        .iter()
        .flat_map(|text| wrapped(text, WIDTH))
        .collect()
}

/// `mass and inertia of coupler, rocker: for inverse dynamics, dynamics`.
fn lack_words(lack: &Lack) -> String {
    let kinds: Vec<&str> = lack
        .analyses
        .iter()
        .map(|kind| analysis_words(*kind))
        .collect();
    format!(
        "{} of {}: for {}",
        lack.keys.join(" and "),
        names(&lack.bodies),
        kinds.join(", ")
    )
}

/// What looks like a slip, with its place.
fn suspicious(opened: &Opened, check: &mut Check) -> Vec<String> {
    let degrees = opened
        .loaded
        .document
        .pointer("/units/angle")
        .and_then(Value::as_str)
        == Some("deg");
    let mut found = analysis::suspicious(&opened.loaded.model, degrees);
    // In a mechanism of doubtful lengths springs are not blamed for theirs.
    let doubtful = found
        .iter()
        .any(|complaint| complaint.path.ends_with(".points"));
    let mut others = std::mem::take(&mut check.suspicious);
    others.retain(|complaint| !(doubtful && complaint.path.ends_with(".free_length")));
    found.extend(others);
    found
        .into_iter()
        .map(|complaint| opened.loaded.source.place(complaint).to_string())
        .collect()
}

/// The first line's last word.
fn verdict(check: &Check) -> String {
    match check.status {
        _ if !check.refused.is_empty() => "refused".into(),
        Status::Completed if check.faults.is_empty() => "sound".into(),
        Status::Completed => "faulty".into(),
        other => status_words(other),
    }
}

/// The diagnosis for programs.
fn to_json(opened: &Opened, check: &Check, suspicious: &[String]) -> Value {
    let model = &opened.loaded.model;
    let parameters = opened.loaded.parameters.iter();
    let parameters = parameters.map(|p| (p.name.clone(), tolerances::to_json(p)));
    let words = |kind: AnalysisKind| analysis_words(kind).replace(' ', "_");
    let refused = check.refused.iter().cloned();
    let refused = refused.map(|complaint| opened.loaded.source.place(complaint).to_string());
    let refused: Vec<String> = refused.collect();
    let missing = check
        .missing
        .iter()
        .map(|(kind, what)| (words(*kind), json!(what)));
    let lacks = check.lacks.iter().map(|lack| {
        let kinds: Vec<String> = lack.analyses.iter().map(|kind| words(*kind)).collect();
        json!({ "bodies": lack.bodies, "keys": lack.keys, "for": kinds })
    });
    let open = check.open.as_ref().map(|open| {
        let Mobility { grubler, rank, .. } = open.mobility;
        json!({ "joints": open.joints, "grubler": grubler, "rank": rank })
    });
    json!({
        "status": check.status.word(),
        "message": check.message,
        "model": { "name": opened.name, "sha256": opened.sha256 },
        "parameters": parameters.collect::<Map<String, Value>>(),
        "responses": responses::to_json(opened),
        "bodies": check.bodies,
        "joints": check.joints,
        "drivers": model.drivers.len(),
        "forces": model.forces.len(),
        "loops": check.loops,
        "loop_bodies": check.loop_bodies,
        "mobility": {
            "words": check.words,
            "grubler": check.mobility.grubler,
            "rank": check.mobility.rank,
            "drivers": check.mobility.drivers,
            "redundant": check.mobility.redundant,
            "reactions_not_unique": check.mobility.reactions_not_unique,
            "free_journals": open,
        },
        "assembly_residual": check.assembly_residual,
        "refused": refused,
        "missing": missing.collect::<Map<String, Value>>(),
        "lacks": lacks.collect::<Vec<Value>>(),
        "suspicious": suspicious,
        "warnings": check.warnings,
        "faults": check.faults,
    })
}
