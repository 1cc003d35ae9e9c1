//! `linkdyn docs`: the book, which is built in.

use clap::Args;

use super::exit::{BadInput, Exit, Failure};
use super::streams::print;
use linkdyn_ask::near::did_you_mean;
use linkdyn_ask::text::Page;

#[derive(Debug, Args)]
pub struct Options {
    /// Print this page, as Markdown
    page: Option<String>,
}

/// Pages of the book: name, what it is for, text.
const PAGES: [(&str, &str, &str); 15] = [
    (
        "tutorial",
        "a first model, from an empty file to a study of clearance",
        include_str!("../../docs/tutorial.md"),
    ),
    (
        "recipes",
        "points from a drawing, a cylinder, a motor, a suspension, pandas",
        include_str!("../../docs/recipes.md"),
    ),
    (
        "accuracy",
        "what tolerances and clearances do, and how tight they must be",
        include_str!("../../docs/accuracy.md"),
    ),
    (
        "studies",
        "many variants of a model: sweeps, samples of tolerances, clusters",
        include_str!("../../docs/studies.md"),
    ),
    (
        "optimise",
        "parameters that meet a goal, are best, or let a point take a path",
        include_str!("../../docs/optimise.md"),
    ),
    (
        "python",
        "runs, variants, studies and notebooks in Python",
        include_str!("../../docs/python.md"),
    ),
    (
        "cluster",
        "studies on many machines: Ray, Slurm, object stores, what it costs",
        include_str!("../../docs/cluster.md"),
    ),
    (
        "models",
        "the bundled models, with a picture of each",
        include_str!("../../docs/models.md"),
    ),
    (
        "commands",
        "what each command does, exit statuses, figures",
        include_str!("../../docs/commands.md"),
    ),
    (
        "format",
        "reference of model files",
        include_str!("../../docs/format.md"),
    ),
    (
        "results",
        "reference of columns, summary, events, the report",
        include_str!("../../docs/results.md"),
    ),
    (
        "messages",
        "what a message means and what to do",
        include_str!("../../docs/messages.md"),
    ),
    (
        "theory",
        "equations of every element and method, with signs and sources",
        include_str!("../../docs/theory.md"),
    ),
    (
        "validation",
        "answers that are not ours, and how far we are from them",
        include_str!("../../docs/validation.md"),
    ),
    (
        "performance",
        "how long things take",
        include_str!("../../docs/performance.md"),
    ),
];

/// Lists the pages, or prints one.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let Some(wanted) = &options.page else {
        let mut list = Page::default();
        for (name, about, _) in PAGES {
            list.line(format!("{name:12}{about}"));
        }
        list.line("`linkdyn docs PAGE` prints a page.");
        print(list.text())?;
        return Ok(Exit::Done);
    };
    let name = wanted.strip_suffix(".md").unwrap_or(wanted);
    let Some((_, _, text)) = PAGES.iter().find(|(known, ..)| *known == name) else {
        let hint = did_you_mean(
            name,
            PAGES.iter().map(|(known, ..)| *known),
            "`linkdyn docs` lists them",
        );
        return Err(BadInput(vec![format!(
            "{wanted}: no page of that name ({hint})"
        )]));
    };
    print(text)?;
    Ok(Exit::Done)
}
