//! `linkdyn check`: reads, assembles and diagnoses a model.

use clap::Args;
use serde_json::{Map, Value, json};

use super::open::{ModelOptions, Opened};
use super::page::{Page, number};
use super::summary::{analysis_words, mobility, status_words};
use super::{BadInput, Exit, complain, print};
use crate::analysis::{self, Check};
use crate::output::Status;

#[derive(Debug, Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Print the diagnosis as JSON
    #[arg(long)]
    json: bool,
}

/// Diagnoses and tells.
pub fn execute(options: &Options) -> Result<Exit, BadInput> {
    let opened = options.model.open()?;
    let mut check = analysis::check(&opened.loaded.model).map_err(|complaints| opened.bad_input(complaints))?;
    check.warnings.splice(0..0, opened.loaded.warnings.iter().cloned());
    print(&if options.json { format!("{:#}\n", to_json(&opened, &check)) } else { page(&opened, &check) })?;
    check.faults.iter().for_each(|fault| complain(&format!("{}: {fault}", opened.label)));
    match Exit::from(check.status) {
        Exit::Done if check.faults.is_empty() => Ok(Exit::Done),
        Exit::Done => Ok(Exit::Fault),
        exit @ (Exit::Fault | Exit::BadInput | Exit::Stopped | Exit::Interrupted) => {
            complain(check.message.as_deref().unwrap_or(check.status.word()));
            Ok(exit)
        }
    }
}

/// The diagnosis for people.
fn page(opened: &Opened, check: &Check) -> String {
    let model = &opened.loaded.model;
    let mut page = Page::default();
    page.line(format!("{} ({}): {}", opened.name, opened.label, verdict(check)));
    let parts = [("moving bodies", check.bodies), ("joints", check.joints), ("drivers", model.drivers.len())];
    let parts = parts.map(|(what, n)| format!("{what} {n}"));
    page.row("parts", format!("{}, forces {}", parts.join(", "), model.forces.len()));
    page.rows("loops", if check.loops.is_empty() { vec!["none".to_string()] } else { check.loops.clone() });
    page.row("mobility", mobility(&check.mobility));
    page.row("assembly", format!("constraint residual {}", number(check.assembly_residual, 2)));
    let parameters = &opened.loaded.parameters;
    let resolved = parameters.iter().map(|p| format!("{} = {} {}", p.name, number(p.value, 6), p.unit));
    page.rows("parameters", resolved.map(|text| text.trim_end().to_string()));
    let missing = check.missing.iter().map(|(kind, what)| format!("{}: {}", analysis_words(*kind), what.join("; ")));
    page.rows("missing for", missing);
    page.rows("warnings", &check.warnings);
    page.text().to_string()
}

/// The first line's last word.
fn verdict(check: &Check) -> String {
    match check.status {
        Status::Completed if check.faults.is_empty() => "sound".into(),
        Status::Completed => "faulty".into(),
        other => status_words(other),
    }
}

/// The diagnosis for programs.
fn to_json(opened: &Opened, check: &Check) -> Value {
    let model = &opened.loaded.model;
    let parameters = opened.loaded.parameters.iter();
    let parameters = parameters.map(|p| (p.name.clone(), json!({ "value": p.value, "unit": p.unit })));
    let missing = check.missing.iter().map(|(kind, what)| (analysis_words(*kind).replace(' ', "_"), json!(what)));
    json!({
        "status": check.status.word(),
        "message": check.message,
        "model": { "name": opened.name, "sha256": opened.sha256 },
        "parameters": parameters.collect::<Map<String, Value>>(),
        "bodies": check.bodies,
        "joints": check.joints,
        "drivers": model.drivers.len(),
        "forces": model.forces.len(),
        "loops": check.loops,
        "mobility": {
            "grubler": check.mobility.grubler,
            "rank": check.mobility.rank,
            "drivers": check.mobility.drivers,
            "redundant": check.mobility.redundant,
            "reactions_not_unique": check.mobility.reactions_not_unique,
        },
        "assembly_residual": check.assembly_residual,
        "missing": missing.collect::<Map<String, Value>>(),
        "warnings": check.warnings,
        "faults": check.faults,
    })
}
