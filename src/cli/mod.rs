//! The command line: one file per command, exit statuses, and what goes to which stream.
//!
//! Standard output carries what was asked for, standard error complaints and failures.

mod animate;
mod check;
mod compare;
mod interrupt;
mod measures;
mod models;
mod modes;
mod new;
mod open;
mod page;
mod plot;
mod plot_units;
mod progress;
mod results;
mod run;
mod schema;
mod shape;
mod summary;
mod validate;

use std::cell::RefCell;
use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser, Subcommand};

use linkdyn_output::{Status, WriteError};
use page::plain;

/// Planar multibody dynamics of linkages: assembly, kinematics, forces, statics, motion.
#[derive(Debug, Parser)]
#[command(name = "linkdyn", version, after_help = EXIT_HELP)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXIT_HELP: &str = "Exit status: 0 done, 1 a check or validation found a fault, 2 the input is bad, \
3 numerics or geometry forbid to go on, 130 interrupted.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Write a starter model, explained by its notes
    New(new::Options),
    /// Run a model's analysis
    Run(run::Options),
    /// Read, assemble and diagnose a model
    Check(check::Options),
    /// Run a model with each model of a joint's clearance, and compare
    Compare(compare::Options),
    /// Natural frequencies, damping ratios and shapes of small motions about the equilibrium
    Modes(modes::Options),
    /// Draw result columns as a figure
    Plot(Box<plot::Options>),
    /// Draw the mechanism in motion, as a film or as poses
    Animate(animate::Options),
    /// Run the bundled validation cases: reference, ours, difference, verdict
    Validate(validate::Options),
    /// List the bundled models, or print one as JSON
    Models(models::Options),
    /// Print the JSON Schema of model files
    Schema,
}

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Exit {
    Done,
    /// A check or validation found a fault.
    Fault,
    BadInput,
    /// Numerics or geometry forbid to go on.
    Stopped,
    Interrupted,
}

impl Exit {
    /// The exit status of the process.
    fn code(self) -> u8 {
        match self {
            Exit::Done => 0,
            Exit::Fault => 1,
            Exit::BadInput => 2,
            Exit::Stopped => 3,
            Exit::Interrupted => 130,
        }
    }
}

impl From<Status> for Exit {
    fn from(status: Status) -> Self {
        match status {
            Status::Completed | Status::CompletedWithGaps => Exit::Done,
            Status::Interrupted => Exit::Interrupted,
            Status::DeadCentre
            | Status::AssemblyFailed
            | Status::StepTooSmall
            | Status::Singular
            | Status::TimeLimit => Exit::Stopped,
        }
    }
}

/// Bad input: what to tell, a line each.
#[derive(Debug, PartialEq, Eq)]
struct BadInput(Vec<String>);

impl From<WriteError> for BadInput {
    fn from(error: WriteError) -> Self {
        BadInput(vec![error.to_string()])
    }
}

impl From<io::Error> for BadInput {
    fn from(error: io::Error) -> Self {
        BadInput(vec![format!("standard output can't be written: {error}")])
    }
}

/// Runs the command that the process was started with.
pub fn main() -> ExitCode {
    execute(std::env::args_os()).into()
}

/// What a command left that another program ran.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Said {
    /// The exit status.
    pub status: u8,
    pub stdout: String,
    pub stderr: String,
}

thread_local! {
    /// Takes the place of both streams while [`captured`] runs.
    static SAID: RefCell<Option<Said>> = const { RefCell::new(None) };
}

/// Runs a command in this process, its streams kept; the first argument is the program's name.
pub fn captured(arguments: impl IntoIterator<Item = OsString>) -> Said {
    SAID.set(Some(Said::default()));
    let status = execute(arguments);
    Said {
        status,
        ..SAID.take().unwrap_or_default()
    }
}

/// Runs a command; its exit status.
fn execute(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => return refuse(&error),
    };
    let exit = match arguments.command {
        Command::New(options) => new::execute(&options),
        Command::Run(options) => run::execute(&options),
        Command::Check(options) => check::execute(&options),
        Command::Compare(options) => compare::execute(&options),
        Command::Modes(options) => modes::execute(&options),
        Command::Plot(options) => plot::execute(&options),
        Command::Animate(options) => animate::execute(&options),
        Command::Validate(options) => validate::execute(&options),
        Command::Models(options) => models::execute(&options),
        Command::Schema => schema::execute(),
    };
    let exit = exit.unwrap_or_else(|BadInput(lines)| {
        lines.iter().for_each(|line| complain(line));
        Exit::BadInput
    });
    exit.code()
}

/// What clap has to say: a fault of the arguments, or the help or version that was asked for.
fn refuse(error: &clap::Error) -> u8 {
    let tip = misspelt(error).map(|near| format!("\n  tip: did you mean {near:?}?\n"));
    let is_kept = kept(|said| {
        let text = error.render().to_string();
        if error.use_stderr() {
            said.stderr += &text
        } else {
            said.stdout += &text
        }
        said.stderr += tip.as_deref().unwrap_or_default();
    });
    if !is_kept {
        // A closed stream is no reason to fail.
        let _ = error.print();
        if let Some(tip) = tip {
            let _ = write!(io::stderr(), "{tip}");
        }
    }
    if error.use_stderr() {
        Exit::BadInput.code()
    } else {
        Exit::Done.code()
    }
}

/// Lets `put` have the streams that are kept; whether they are.
fn kept(put: impl FnOnce(&mut Said)) -> bool {
    SAID.with_borrow_mut(|said| said.as_mut().map(put).is_some())
}

/// The command that was meant by an unknown one of which two letters have changed places or so, which clap does not see.
fn misspelt(error: &clap::Error) -> Option<String> {
    let (Some(ContextValue::String(typed)), None) = (
        error.get(ContextKind::InvalidSubcommand),
        error.get(ContextKind::SuggestedSubcommand),
    ) else {
        return None;
    };
    let commands = Arguments::command();
    let names = commands.get_subcommands().map(clap::Command::get_name);
    let near = names
        .map(|name| (strsim::osa_distance(typed, name), name))
        .min()?;
    (near.0 <= typed.len() / 3).then(|| near.1.to_string())
}

/// Writes one line to standard error; there is nobody to tell if that fails.
fn complain(line: &str) {
    let line = format!("error: {}\n", plain(line));
    if !kept(|said| said.stderr += &line) {
        let _ = io::stderr().write_all(line.as_bytes());
    }
}

/// Writes to standard output; a reader that has gone away (`| head`) is no error.
fn print(text: &str) -> io::Result<()> {
    if kept(|said| said.stdout += text) {
        return Ok(());
    }
    let mut stdout = io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// The known name that was probably meant, in words; else `otherwise`.
fn did_you_mean<'a>(
    name: &str,
    known: impl Iterator<Item = &'a str> + Clone,
    otherwise: &str,
) -> String {
    match nearest(name, known) {
        Some(near) => format!("did you mean {near:?}?"),
        None => otherwise.to_string(),
    }
}

/// The known name nearest to `name`, where one is near: misspelt, or a part of it.
fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str> + Clone) -> Option<&'a str> {
    let name = name.to_lowercase();
    let similarity = |other: &str| strsim::jaro_winkler(&name, &other.to_lowercase());
    let near = known
        .clone()
        .map(|other| (similarity(other), other))
        .filter(|(similarity, _)| *similarity >= 0.75);
    let near = near
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, other)| other);
    near.or_else(|| {
        known
            .into_iter()
            .find(|other| name.len() > 3 && other.to_lowercase().contains(&name))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn statuses_have_the_exit_codes_of_the_contract() {
        for (status, code) in [
            (Status::Completed, 0),
            (Status::CompletedWithGaps, 0),
            (Status::DeadCentre, 3),
            (Status::AssemblyFailed, 3),
            (Status::StepTooSmall, 3),
            (Status::Singular, 3),
            (Status::TimeLimit, 3),
            (Status::Interrupted, 130),
        ] {
            assert_eq!(Exit::from(status).code(), code, "{status:?}");
        }
    }

    #[test]
    fn near_names_are_found_and_far_ones_not() {
        let known = ["four-bar", "slider-crank", "watt-i-lock"];
        assert_eq!(nearest("fourbar", known.into_iter()), Some("four-bar"));
        assert_eq!(
            nearest("Slider-Cranck", known.into_iter()),
            Some("slider-crank")
        );
        assert_eq!(nearest("crank", known.into_iter()), Some("slider-crank"));
        assert_eq!(nearest("zzz", known.into_iter()), None);
    }
}
