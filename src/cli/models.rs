//! `linkdyn models`: the bundled models.

use clap::Args;
use serde_json::Value;

use super::page::Page;
use super::{BadInput, Exit, nearest, print};
use crate::bundled::{self, Bundled};

#[derive(Debug, Args)]
pub struct Options {
    /// Print this one as JSON
    name: Option<String>,
}

/// Lists the models, or prints one as it is.
pub fn execute(options: &Options) -> Result<Exit, BadInput> {
    match &options.name {
        None => print(&list())?,
        Some(name) => match bundled::find(name) {
            Some(model) => print(model.text)?,
            None => return Err(unknown(name)),
        },
    }
    Ok(Exit::Done)
}

/// A line per model: name, aliases, what it is.
fn list() -> String {
    let names: Vec<String> = bundled::MODELS.iter().map(name_and_aliases).collect();
    let width = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let mut page = Page::default();
    for (model, name) in bundled::MODELS.iter().zip(&names) {
        page.line(format!("{name:width$}  {}", about(model)).trim_end());
    }
    page.text().to_string()
}

fn name_and_aliases(model: &Bundled) -> String {
    let aliases: String = model.aliases.iter().map(|alias| format!(", {alias}")).collect();
    format!("{}{aliases}", model.name)
}

/// The model's line about itself, or its name.
fn about(model: &Bundled) -> String {
    let document: Value = serde_json::from_str(model.text).unwrap_or_default();
    let word = |key: &str| document.get(key).and_then(Value::as_str).map(String::from);
    word("about").or_else(|| word("name")).unwrap_or_default()
}

fn unknown(name: &str) -> BadInput {
    let hint = match nearest(name, bundled::names()) {
        Some(near) => format!("did you mean {near:?}?"),
        None => "`linkdyn models` lists them".into(),
    };
    BadInput(vec![format!("{name}: no bundled model of that name ({hint})")])
}
