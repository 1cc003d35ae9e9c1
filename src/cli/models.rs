//! `linkdyn models`: the bundled models.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::Value;

use super::exit::{BadInput, Exit, Failure};
use super::gallery;
use super::streams::print;
use linkdyn_ask::near::did_you_mean;
use linkdyn_ask::text::{Page, wrapped};
use linkdyn_model::bundled::{self, Bundled, NotBundled};
use linkdyn_output::Directory;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    /// Print this one as JSON
    name: Option<String>,
    /// Number of loops of nfourbar, the model that comes in any size (also a MODEL everywhere: nfourbar:40)
    #[arg(long, value_name = "N", requires = "name")]
    n: Option<String>,
    /// Draw this one, or all, as PNG into this directory instead
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "  linkdyn models
  linkdyn models slider-crank > mine.json
  linkdyn models -o pictures

What each of them is tested against: linkdyn docs models.";

/// Width of the list.
const WIDTH: usize = 110;

/// Lists the models, or prints one as it is.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let Some(name) = &options.name else {
        match &options.output {
            Some(path) => pictures(bundled::MODELS.iter().map(|model| model.name), path)?,
            None => print(&list())?,
        }
        return Ok(Exit::Done);
    };
    if let (Some((stem, size)), Some(n)) = (name.split_once(':'), &options.n) {
        return Err(BadInput(vec![format!(
            "{name}: --n {n} beside the size {size} (give one: {stem}:{n}, or {name} without --n)"
        )]));
    }
    let sized = options
        .n
        .as_ref()
        .map_or_else(|| name.clone(), |n| format!("{name}:{n}"));
    match bundled::text(&sized) {
        Ok(text) => match &options.output {
            Some(path) => pictures(std::iter::once(sized.as_str()), path)?,
            None => print(&text)?,
        },
        Err(NotBundled::Unknown) => return Err(unknown(name)),
        Err(why @ (NotBundled::OneSize(_) | NotBundled::BadSize)) => {
            return Err(BadInput(vec![format!("{sized}: {why}")]));
        }
    }
    Ok(Exit::Done)
}

/// Draws models and tells the files.
fn pictures<'a>(names: impl Iterator<Item = &'a str>, path: &Path) -> Result<(), Failure> {
    let mut page = Page::default();
    for written in gallery::draw(names, &Directory::open(path)?)? {
        page.line(written.display().to_string());
    }
    Ok(print(page.text())?)
}

/// A paragraph per model: name, aliases, what it is.
fn list() -> String {
    let names: Vec<String> = bundled::MODELS.iter().map(name_and_aliases).collect();
    let indent = 2 + names
        .iter()
        .map(|name| name.chars().count())
        .max()
        .unwrap_or(0);
    let mut page = Page::default();
    for (model, name) in bundled::MODELS.iter().zip(&names) {
        for (index, line) in wrapped(&about(model), WIDTH - indent).iter().enumerate() {
            let label = if index == 0 { name.as_str() } else { "" };
            page.line(format!("{label:indent$}{line}").trim_end());
        }
    }
    page.text().to_string()
}

fn name_and_aliases(model: &Bundled) -> String {
    let aliases: String = model
        .aliases
        .iter()
        .map(|alias| format!(", {alias}"))
        .collect();
    format!("{}{aliases}", model.name)
}

/// The model's line about itself, or its name.
fn about(model: &Bundled) -> String {
    let document: Value = serde_json::from_str(model.text).unwrap_or_default();
    let word = |key: &str| document.get(key).and_then(Value::as_str).map(String::from);
    word("about").or_else(|| word("name")).unwrap_or_default()
}

fn unknown(name: &str) -> Failure {
    let hint = did_you_mean(name, bundled::names(), "`linkdyn models` lists them");
    BadInput(vec![format!(
        "{name}: no bundled model of that name ({hint})"
    )])
}
