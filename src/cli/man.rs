//! `linkdyn man`: manual pages, one of the command and one of each of its commands.

use std::path::PathBuf;

use clap::{Args, CommandFactory};
use clap_mangen::Man;

use super::Arguments;
use super::exit::{BadInput, Exit, Failure};
use super::streams::print;
use linkdyn_ask::near::did_you_mean;
use linkdyn_ask::text::Page;
use linkdyn_output::Directory;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    /// Print the page of this command; left out, that of linkdyn
    #[arg(conflicts_with = "output")]
    command: Option<String>,
    /// Write all pages into this directory
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "  linkdyn man run | man -l -
  linkdyn man -o ~/.local/share/man/man1";

/// Prints a page, or writes all.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let pages = pages()?;
    if let Some(folder) = &options.output {
        let folder = Directory::open(folder)?;
        let mut told = Page::default();
        for (name, text) in &pages {
            let written = folder.write(&format!("{name}.1"), text.as_bytes())?;
            told.line(written.display().to_string());
        }
        print(told.text())?;
        return Ok(Exit::Done);
    }
    let wanted = match &options.command {
        Some(command) => format!("linkdyn-{command}"),
        None => "linkdyn".to_string(),
    };
    let Some((_, text)) = pages.iter().find(|(name, _)| *name == wanted) else {
        let commands = pages.iter().filter_map(|(name, _)| name.split_once('-'));
        let typed = options.command.as_deref().unwrap_or_default();
        let hint = did_you_mean(
            typed,
            commands.map(|(_, command)| command),
            "`linkdyn --help` lists them",
        );
        return Err(BadInput(vec![format!(
            "{typed}: no command of that name ({hint})"
        )]));
    };
    print(text)?;
    Ok(Exit::Done)
}

/// Name and text of every page.
fn pages() -> Result<Vec<(String, String)>, Failure> {
    let mut whole = Arguments::command().disable_help_subcommand(true);
    whole.build();
    let own = whole.get_subcommands().map(|command| {
        // clap wants names that live as long as the program: a page shows the one that is displayed.
        let name = format!("linkdyn-{}", command.get_name());
        (name.clone(), command.clone().display_name(name))
    });
    let all = std::iter::once(("linkdyn".to_string(), whole.clone())).chain(own);
    let mut pages = Vec::new();
    for (name, command) in all {
        let mut text = Vec::new();
        let man = Man::new(command).source(concat!("linkdyn ", env!("CARGO_PKG_VERSION")));
        man.render(&mut text)?;
        pages.push((name, String::from_utf8_lossy(&text).into_owned()));
    }
    Ok(pages)
}
