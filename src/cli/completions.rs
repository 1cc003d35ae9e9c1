//! `linkdyn completions`: scripts that complete commands and options in a shell.

use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

use super::Arguments;
use super::exit::{Exit, Failure};
use super::streams::print;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    /// The shell
    shell: Shell,
}

const HELP: &str = "  linkdyn completions bash > ~/.local/share/bash-completion/completions/linkdyn
  linkdyn completions zsh > ~/.zfunc/_linkdyn
  linkdyn completions fish > ~/.config/fish/completions/linkdyn.fish";

/// Prints the script of a shell.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    generate(
        options.shell,
        &mut Arguments::command(),
        "linkdyn",
        &mut script,
    );
    print(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Done)
}
