//! `linkdyn new`: a starter model, explained by its notes.

use std::path::PathBuf;

use clap::Args;

use super::created::{create, quoted};
use super::exit::{BadInput, Exit, Failure};
use super::streams::print;
use linkdyn_ask::near::did_you_mean;
use linkdyn_ask::text::Page;

/// Starter models: name, what it is for, file.
const TEMPLATES: [(&str, &str, &str); 5] = [
    (
        "four-bar",
        "a driven loop: motion, joint forces, motor torque",
        include_str!("templates/four-bar.json"),
    ),
    (
        "slider-crank",
        "a piston with a load",
        include_str!("templates/slider-crank.json"),
    ),
    (
        "pendulum",
        "forward dynamics from initial values",
        include_str!("templates/pendulum.json"),
    ),
    (
        "spring-mass",
        "a spring and a damper, natural frequency",
        include_str!("templates/spring-mass.json"),
    ),
    (
        "clearance",
        "a worn pin in a four-bar",
        include_str!("templates/clearance.json"),
    ),
];

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    /// Which starter model: four-bar, slider-crank, pendulum, spring-mass or clearance
    #[arg(default_value = "four-bar")]
    template: String,
    /// Write it into this file [default: TEMPLATE.json]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file where it exists
    #[arg(long)]
    force: bool,
}

const HELP: &str = "  linkdyn new -o mine.json
  linkdyn new clearance -o worn.json

How a model is made, step by step: linkdyn docs tutorial. All that may stand in it: linkdyn docs format.";

/// Writes the model and tells what to type next.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let name = options.template.as_str();
    let Some((_, about, text)) = TEMPLATES.iter().find(|(known, ..)| *known == name) else {
        let known = TEMPLATES.map(|(known, ..)| known);
        let hint = did_you_mean(
            name,
            known.into_iter(),
            &format!("there are {}", known.join(", ")),
        );
        return Err(BadInput(vec![format!(
            "{name}: no template of that name ({hint})"
        )]));
    };
    let path = options
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{name}.json")));
    let shown = path.display();
    create(
        &path,
        text.as_bytes(),
        options.force,
        &format!("{name}.json"),
    )?;
    let file = quoted(&shown.to_string());
    let mut page = Page::default();
    page.line(format!("{shown}: {about}; its notes explain it. Next:"));
    page.line(format!("  linkdyn check {file}"));
    page.line(format!("  linkdyn run {file} -o out"));
    page.line("  linkdyn docs tutorial   tells how a model is made, step by step");
    page.line("  linkdyn docs format     tells all that may stand in it");
    print(page.text())?;
    Ok(Exit::Done)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_help_names_every_template() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/cli/templates");
        assert_eq!(
            std::fs::read_dir(folder).expect("templates/").count(),
            TEMPLATES.len()
        );
    }
}
