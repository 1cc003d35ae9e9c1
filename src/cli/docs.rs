//! `linkdyn docs`: the book, which is built in.

use clap::Args;

use super::exit::{BadInput, Exit, Failure};
use super::streams::print;
use linkdyn_ask::near::did_you_mean;

#[derive(Debug, Args)]
pub struct Options {
    /// Print this page, as Markdown
    page: Option<String>,
}

/// Pages of the book, and what each is for.
const LIST: &str = "\
tutorial    a first model, from an empty file to a study of clearance
editor      a mechanism that moves while you draw it, in a browser
recipes     points from a drawing, a cylinder, a motor, a suspension, pandas
accuracy    what tolerances and clearances do, and how tight they must be
assemblies  all ways in which a mechanism closes, and the circuits that connect them
studies     many variants of a model: sweeps, samples of tolerances, clusters
synthesis   linkages for a wanted path, motion or function
optimise    parameters that meet a goal, are best, or let a point take a path
path-time   the fastest motion along a stroke, under limits of effort, speed and pin forces
python      runs, variants, studies and notebooks in Python
cluster     studies on many machines: Ray, Slurm, object stores, what it costs
fmu         mechanisms in programs that know FMI: inputs, outputs, states
models      the bundled models, with a picture of each
commands    what each command does, exit statuses, figures
format      reference of model files
coming-from the words of other programs, and how they are said here
exchange    mechanisms of other programs, read by linkdyn import
results     reference of columns, summary, events, the report
messages    what a message means and what to do
theory      equations of every element and method, with signs and sources
validation  answers that are not ours, and how far we are from them
performance how long things take
";

/// The text of a page.
fn text(page: &str) -> Option<&'static str> {
    Some(match page {
        "tutorial" => include_str!("../../docs/tutorial.md"),
        "editor" => include_str!("../../docs/editor.md"),
        "recipes" => include_str!("../../docs/recipes.md"),
        "accuracy" => include_str!("../../docs/accuracy.md"),
        "assemblies" => include_str!("../../docs/assemblies.md"),
        "studies" => include_str!("../../docs/studies.md"),
        "synthesis" => include_str!("../../docs/synthesis.md"),
        "optimise" => include_str!("../../docs/optimise.md"),
        "path-time" => include_str!("../../docs/path-time.md"),
        "python" => include_str!("../../docs/python.md"),
        "cluster" => include_str!("../../docs/cluster.md"),
        "fmu" => include_str!("../../docs/fmu.md"),
        "models" => include_str!("../../docs/models.md"),
        "commands" => include_str!("../../docs/commands.md"),
        "format" => include_str!("../../docs/format.md"),
        "coming-from" => include_str!("../../docs/coming-from.md"),
        "exchange" => include_str!("../../docs/exchange.md"),
        "results" => include_str!("../../docs/results.md"),
        "messages" => include_str!("../../docs/messages.md"),
        "theory" => include_str!("../../docs/theory.md"),
        "validation" => include_str!("../../docs/validation.md"),
        "performance" => include_str!("../../docs/performance.md"),
        _ => return None,
    })
}

/// Lists the pages, or prints one.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let Some(wanted) = &options.page else {
        print(&format!("{LIST}`linkdyn docs PAGE` prints a page.\n"))?;
        return Ok(Exit::Done);
    };
    let name = wanted.strip_suffix(".md").unwrap_or(wanted);
    let Some(text) = text(name) else {
        let known = LIST.lines().filter_map(|line| line.split(' ').next());
        let hint = did_you_mean(name, known, "`linkdyn docs` lists them");
        return Err(BadInput(vec![format!(
            "{wanted}: no page of that name ({hint})"
        )]));
    };
    print(text)?;
    Ok(Exit::Done)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_page_of_the_list_has_a_text() {
        let names = LIST.lines().filter_map(|line| line.split(' ').next());
        assert!(names.clone().all(|name| text(name).is_some()));
        assert_eq!(names.count(), 22);
    }
}
