//! `linkdyn export --fmu`: a functional mock-up unit, a ZIP file with a description, the model, and the library that moves it.
//!
//! | file          | does                                         |
//! | ------------- | -------------------------------------------- |
//! | `description` | `modelDescription.xml`                       |
//! | `inputs`      | drivers as inputs                            |
//! | `library`     | the prebuilt libraries, and for which system |
//! | `archive`     | the ZIP file                                 |

mod archive;
mod description;
mod inputs;
mod library;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::exit::{BadInput, Exit, Failure};
use crate::cli::open::ModelOptions;
use crate::cli::results::write_file;
use crate::cli::streams::print;
use crate::error::Error;
use crate::fmu::{Interface, MODEL, STEERED, default_outputs, token};
use crate::mechanism::Mechanism;
use archive::Entry;
use description::Description;
use library::Library;
use linkdyn_ask::near::did_you_mean;
use linkdyn_ask::text::{Page, count, number};
use linkdyn_model::analysis::AnalysisKind;
use linkdyn_output::matches;

/// Options of `--fmu`.
#[derive(Debug, Args)]
#[command(next_help_heading = "Options of --fmu")]
pub struct FmuOptions {
    /// Version of the interface: 2 or 3
    #[arg(long, value_name = "VERSION", default_value_t = 3, value_parser = clap::value_parser!(u8).range(2..=3), requires = "fmu")]
    fmi: u8,
    /// Result column that is an output; * stands for any text, ? for one character; may be given more than once [default: places of
    /// points, drivers, measures, states and outputs]
    #[arg(long = "output", value_name = "COLUMN", requires = "fmu")]
    outputs: Vec<String>,
    /// Input in addition to those of the model: driver.NAME.effort lets a driver go, so that its torque or force comes from outside;
    /// driver.NAME.acceleration leads it; may be given more than once
    #[arg(long = "input", value_name = "COLUMN", requires = "fmu")]
    inputs: Vec<String>,
    /// Prebuilt library of the engine, in addition to that of this command; once for each system
    #[arg(long = "library", value_name = "FILE", requires = "fmu")]
    libraries: Vec<PathBuf>,
}

/// Writes the unit.
pub fn export(model: &ModelOptions, options: &FmuOptions, file: &Path) -> Result<Exit, Failure> {
    if file.extension().is_none_or(|ending| ending != "fmu") {
        return Err(BadInput(vec![format!(
            "{}: the name of the file must end in .fmu",
            file.display()
        )]));
    }
    let libraries = library::all(&options.libraries)?;
    let (mechanism, steered) = inputs::given(model.open()?, &options.inputs, model)?;
    let mechanism = with_outputs(&mechanism, options, model)?;
    // What can't begin here begins nowhere.
    let drivers: Vec<&str> = steered.iter().map(String::as_str).collect();
    let begun = mechanism.steered_simulation(&drivers);
    begun.map_err(|why| model.refuse(why))?;
    let text = mechanism.to_json();
    let steering = match steered.is_empty() {
        true => String::new(),
        false => serde_json::json!(steered).to_string(),
    };
    let interface = Interface::new(&mechanism, &steered).map_err(|why| model.refuse(why))?;
    let description = Description {
        version: options.fmi,
        mechanism: &mechanism,
        interface: &interface,
        token: &token(text.as_bytes(), steering.as_bytes()),
    };
    let identifier = description.identifier();
    let mut entries = vec![
        Entry::new("modelDescription.xml", description.xml()),
        Entry::new("documentation/index.html", description.page()),
        Entry::new(format!("resources/{MODEL}"), text),
    ];
    if !steered.is_empty() {
        entries.push(Entry::new(format!("resources/{STEERED}"), steering));
    }
    for Library { system, bytes } in libraries {
        let path = system.path(options.fmi, &identifier);
        entries.push(Entry::new(path, bytes));
    }
    let written = write_file(file, &archive::zip(entries)?)?;
    let bytes = std::fs::metadata(&written).map_or(0, |about| about.len());
    let mut page = Page::default();
    let outputs = interface.outputs().count();
    page.line(format!(
        "{}: FMI {}.0 for co-simulation, {}, {}, {}, {} MB",
        written.display(),
        options.fmi,
        count(interface.parameters().count(), "parameter"),
        count(interface.inputs().count(), "input"),
        count(outputs, "output"),
        number(bytes as f64 / 1e6, 3)
    ));
    print(page.text())?;
    Ok(Exit::Done)
}

/// The mechanism with the requested columns alone, and what it can't be exported without.
fn with_outputs(
    mechanism: &Mechanism,
    options: &FmuOptions,
    model: &ModelOptions,
) -> Result<Mechanism, Failure> {
    let label = model.label();
    let kind = mechanism
        .model()
        .analysis
        .as_ref()
        .map(|analysis| analysis.kind);
    if kind != Some(AnalysisKind::Dynamics) {
        let kind = kind.map_or("missing".into(), |kind| serde_json::json!(kind).to_string());
        let driver = mechanism.model().drivers.keys().next();
        let hint = driver.map_or(String::new(), |driver| {
            format!(
                "--input driver.{driver}.effort lets a driver go, so that its torque or force moves the mechanism; "
            )
        });
        return Err(BadInput(vec![format!(
            "{label}: analysis.type is {kind}: a functional mock-up unit moves by \"dynamics\" ({hint}--set analysis.type=dynamics where forces move it)"
        )]));
    }
    let wanted = match &options.outputs[..] {
        [] => default_outputs(mechanism),
        wanted => wanted.to_vec(),
    };
    let columns = serde_json::json!(wanted).to_string();
    let chosen = mechanism.set("analysis.columns", &columns);
    let chosen = chosen.map_err(|why: Error| model.refuse(why))?;
    let faults = options.outputs.iter().filter_map(|pattern| {
        let mut names = chosen.columns().map(|(name, _)| name);
        if names.any(|name| name != linkdyn_output::TIME && matches(pattern, name)) {
            return None;
        }
        let known: Vec<&str> = mechanism.columns().map(|(name, _)| name).collect();
        let hint = did_you_mean(
            pattern,
            known.into_iter(),
            &format!("`linkdyn run {label} -o -` prints their names"),
        );
        Some(format!(
            "--output {pattern}: matches no result column ({hint})"
        ))
    });
    let faults: Vec<String> = faults.collect();
    match faults.is_empty() {
        true => Ok(chosen),
        false => Err(BadInput(faults)),
    }
}
