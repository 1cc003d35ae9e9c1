//! `linkdyn assemblies`: every way in which a mechanism can be assembled, and the circuits that connect them.

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::answer_files;
use super::exit::{Exit, Failure};
use super::interrupt;
use super::measures::range;
use super::open::ModelOptions;
use super::progress::Line;
use super::streams::{complain, json, print, tell, tell_json};
use linkdyn_ask::assemblies::{Assemblies, Circuits, MOST, Workspace};
use linkdyn_ask::{ModelFile, Question};
use linkdyn_output::{Directory, Status};

const ASSEMBLIES: [&str; 2] = ["assemblies.json", "assemblies.html"];
const CIRCUITS: [&str; 2] = ["circuits.json", "circuits.html"];
const WORKSPACE: [&str; 2] = ["workspace.json", "workspace.html"];

#[derive(Debug, Args)]
#[command(after_help = HELP, group(ArgGroup::new("led").args(["circuits", "workspace"])))]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// The instant at which drivers have their values \[s\]
    #[arg(
        long,
        value_name = "TIME",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    at: f64,
    /// The most assemblies that are looked for
    #[arg(long, value_name = "N", default_value_t = MOST)]
    most: usize,
    /// Print the model in which assembly N is drawn
    #[arg(long, value_name = "N", conflicts_with_all = ["circuits", "json", "output"])]
    take: Option<usize>,
    /// Lead the driver through its values: which assemblies are connected by motion, and where it turns back
    #[arg(long, conflicts_with = "at")]
    circuits: bool,
    /// The driver that is led; needed if there are several
    #[arg(long, value_name = "DRIVER", requires = "circuits")]
    driver: Option<String>,
    /// Lead two drivers through their values: where they can stand, where assemblies meet, and where this point gets
    #[arg(long, value_name = "POINT", conflicts_with_all = ["at", "circuits", "take"])]
    workspace: Option<String>,
    /// Both of them; needed if there are more
    #[arg(
        long,
        value_name = "A,B",
        requires = "workspace",
        value_delimiter = ',',
        num_args = 1
    )]
    drivers: Vec<String>,
    /// Values of a driver at which all assemblies are looked for [default: 72; 49 of each for a workspace]
    #[arg(long, value_name = "N", requires = "led")]
    values: Option<usize>,
    /// Its least and greatest value [rad or m]; by default a full turn, or what its motion passes
    #[arg(long, value_name = "A:B", requires = "circuits", value_parser = range, allow_hyphen_values = true)]
    range: Option<[f64; 2]>,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Write assemblies.json and assemblies.html, in which they are drawn, into this directory (made where missing); with --circuits
    /// circuits.json and circuits.html, with --workspace workspace.json and workspace.html
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "  linkdyn assemblies jansen-leg -o out
  linkdyn assemblies mine.json --take 2 > other.json
  linkdyn assemblies watt-i-lock --circuits -o out
  linkdyn assemblies excavator --workspace bucket.tooth --drivers lift,crowd -o out

How they are found, and what the files hold: linkdyn docs assemblies.";

/// Finds, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let model = &options.model;
    let file = model.open()?;
    let directory = options.output.as_deref().map(Directory::open).transpose()?;
    if let Some(point) = &options.workspace {
        return mapped(options, &file, point, directory.as_ref());
    }
    let control = interrupt::control();
    let line = Line::watch(file.name(), &control);
    if options.circuits {
        let question = Circuits {
            driver: options.driver.clone(),
            values: options.values,
            range: options.range,
            most: Some(options.most),
        };
        let found = question.answer(&file, &control);
        drop(line);
        let found = found.map_err(|why| model.refuse(why))?;
        let page = found.html();
        let written = answer_files::write(
            directory.as_ref(),
            CIRCUITS,
            &json(&found)?,
            page.transpose(),
        )?;
        match options.json {
            true => tell_json(&found)?,
            false => tell(found.text(), &written)?,
        }
        return Ok(Exit::Done);
    }
    let question = Assemblies {
        at: options.at,
        most: options.most,
    };
    let found = question.answer(&file, &control);
    drop(line);
    let found = found.map_err(|why| model.refuse(why))?;
    if let Some(number) = options.take {
        let taken = found.drawn(number).map_err(|why| model.refuse(why))?;
        print(&taken.print())?;
        return Ok(Exit::Done);
    }
    let page = found.html();
    let written = answer_files::write(
        directory.as_ref(),
        ASSEMBLIES,
        &json(&found)?,
        page.transpose(),
    )?;
    match options.json {
        true => tell_json(&found)?,
        false => tell(found.text(), &written)?,
    }
    if interrupt::is_set() {
        return Ok(Exit::Interrupted);
    }
    if found.found.found.is_empty() {
        complain("there is no assembly: `linkdyn check` tells which loop does not close");
        return Ok(Exit::from(Status::AssemblyFailed));
    }
    Ok(Exit::Done)
}

/// The map of two drivers.
fn mapped(
    options: &Options,
    file: &ModelFile,
    point: &str,
    directory: Option<&Directory>,
) -> Result<Exit, Failure> {
    let drivers = match &options.drivers[..] {
        [] => None,
        [one, other] => Some([one.clone(), other.clone()]),
        _ => {
            let message = "--drivers: name two, as in --drivers left,right";
            return Err(Failure::BadInput(vec![message.to_owned()]));
        }
    };
    let question = Workspace {
        point: point.to_owned(),
        drivers,
        values: options.values,
        most: Some(options.most),
    };
    let control = interrupt::control();
    let line = Line::watch(file.name(), &control);
    let found = question.answer(file, &control);
    drop(line);
    let found = found.map_err(|why| options.model.refuse(why))?;
    let page = found.html().map(Some);
    let written = answer_files::write(directory, WORKSPACE, &json(&found)?, page)?;
    match options.json {
        true => tell_json(&found)?,
        false => tell(found.text(), &written)?,
    }
    Ok(Exit::Done)
}
