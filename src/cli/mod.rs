//! The command line: one file or folder per command, and what they share.
//!
//! | file        | does                                                     |
//! | ----------- | -------------------------------------------------------- |
//! | `exit`      | exit statuses, bad input                                 |
//! | `streams`   | what goes to which stream                                |
//! | `created`   | files that are new                                       |
//! | `open`      | MODEL: reads a model                                     |
//! | `results`   | RESULTS: reads what a run has written                    |
//! | `measures`  | options that are numbers with limits                     |
//! | `watch`     | runs again when a file changes                           |
//! | `serve`     | pages served to this computer                            |
//! | `live`      | the page that shows the report of each of these runs     |
//! | `progress`  | the line that tells how far a run has come               |
//! | `interrupt` | Ctrl-C, and other signals to end                         |
//! | `threads`   | how many threads share the work                          |
//! | `gallery`   | pictures of the bundled models                           |

mod accuracy;
mod allocate;
mod animate;
mod answer_files;
mod assemblies;
mod chains;
mod check;
mod compare;
mod completions;
mod created;
mod docs;
mod edit;
mod exit;
mod export;
mod gallery;
mod import;
mod interrupt;
mod live;
mod man;
mod measures;
mod models;
mod modes;
mod new;
mod open;
mod optimise;
mod path_time;
mod plot;
mod progress;
mod replaced;
mod results;
mod run;
mod schema;
mod serve;
mod streams;
mod study;
mod synthesise;
mod threads;
mod validate;
mod watch;

use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser, Subcommand};

use exit::{Exit, Failure};
pub use streams::Said;
use streams::{complain, kept, remark};

use linkdyn_ask::caught;

/// Planar multibody dynamics of linkages: assembly, kinematics, forces, statics, motion.
#[derive(Debug, Parser)]
#[command(name = "linkdyn", version, after_help = exit_help())]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

fn exit_help() -> String {
    let code = Exit::code;
    format!(
        "Exit status: {} done, {} a check or validation found a fault, {} the input is bad, {} the solver cannot continue, \
         {} with `run --strict`: a response misses its limits, {} something can't be written, {} a fault of linkdyn itself, {} interrupted.\n\n\
         Begin with `linkdyn new`. `linkdyn docs tutorial` builds a model step by step; \
         `linkdyn docs messages` explains messages.",
        code(Exit::Done),
        code(Exit::Fault),
        code(Exit::BadInput),
        code(Exit::Stopped),
        code(Exit::Missed),
        code(Exit::Unwritten),
        code(Exit::Broken),
        code(Exit::Interrupted),
    )
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Write a starter model, explained by its notes
    New(new::Options),
    /// Read a mechanism from a file of another program: PMKS+, pylinkage, MJCF, URDF, SDF, DXF, SVG, CSV
    Import(import::Options),
    /// Run a model's analysis
    Run(run::Options),
    /// Edit a model file in a browser: drawing and text, with the motion beside
    Edit(edit::Options),
    /// Read, assemble and diagnose a model
    Check(check::Options),
    /// Run a model with each model of a joint's clearance, and compare
    Compare(compare::Options),
    /// What tolerances and clearances do to outputs: first order, worst found, certified
    Accuracy(accuracy::Options),
    /// The cheapest tolerances that keep the limits of outputs
    Allocate(allocate::Options),
    /// All assemblies, and the circuits that connect them
    Assemblies(Box<assemblies::Options>),
    /// Natural frequencies, damping ratios and shapes of small motions about the equilibrium
    Modes(modes::Options),
    /// Run many variants: sweeps of parameters, samples of tolerances; what comes out of them
    Study(Box<study::Options>),
    /// Find values of parameters: goals, least or greatest objectives under constraints, paths of points
    Optimise(Box<optimise::Options>),
    /// Linkages for a wanted path, motion or function: found, put through the engine, ranked
    Synthesise(synthesise::Options),
    /// The kinematic chains of so many bodies with pins
    Chains(chains::Options),
    /// The fastest motion along a stroke, under limits of effort, speed and joint forces
    PathTime(Box<path_time::Options>),
    /// Draw result columns as a figure
    Plot(Box<plot::Options>),
    /// Draw the mechanism in motion, as a film or as poses
    Animate(animate::Options),
    /// Write the model for other programs: MJCF, drawings, equations, a functional mock-up unit for co-simulation
    Export(export::Options),
    /// Run the bundled validation cases: reference, ours, difference, verdict
    Validate(validate::Options),
    /// List the bundled models, print one as JSON, or draw them
    Models(models::Options),
    /// Print the JSON Schema of model files
    Schema,
    /// Print a page of the documentation, or list the pages
    Docs(docs::Options),
    /// Print a script that completes commands and options in a shell
    Completions(completions::Options),
    /// Print a manual page, or write all of them
    Man(man::Options),
}

/// Runs the command that the process was started with.
pub fn main() -> ExitCode {
    execute(std::env::args_os()).into()
}

/// Runs a command in this process, its streams kept; the first argument is the program's name.
pub fn captured(arguments: impl IntoIterator<Item = OsString>) -> Said {
    streams::keep(|| execute(arguments))
}

/// The same, for a program that has its own way with Ctrl-C: this flag interrupts the command.
pub fn hosted(arguments: impl IntoIterator<Item = OsString>, interrupted: Arc<AtomicBool>) -> Said {
    interrupt::hosted(interrupted, || captured(arguments))
}

/// Runs a command; its exit status.
fn execute(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => return refuse(&error),
    };
    let done = caught(|| arguments.command.execute()).unwrap_or_else(|said| {
        Err(Failure::Broken(format!(
            "this is a fault of linkdyn itself, not of the input: {said} (please report it with the model and this command)"
        )))
    });
    let exit = done.unwrap_or_else(|failure| {
        let (exit, lines) = failure.parts();
        lines.iter().for_each(|line| complain(line));
        exit
    });
    if matches!(exit, Exit::BadInput | Exit::Stopped) {
        advise();
    }
    exit.code()
}

impl Command {
    fn execute(self) -> Result<Exit, Failure> {
        match self {
            Command::New(options) => new::execute(&options),
            Command::Import(options) => import::execute(&options),
            Command::Run(options) => run::execute(&options),
            Command::Edit(options) => edit::execute(&options),
            Command::Check(options) => check::execute(&options),
            Command::Compare(options) => compare::execute(&options),
            Command::Accuracy(options) => accuracy::execute(&options),
            Command::Allocate(options) => allocate::execute(&options),
            Command::Modes(options) => modes::execute(&options),
            Command::Study(options) => study::execute(&options),
            Command::Optimise(options) => optimise::execute(&options),
            Command::Assemblies(options) => assemblies::execute(&options),
            Command::Synthesise(options) => synthesise::execute(&options),
            Command::Chains(options) => chains::execute(&options),
            Command::PathTime(options) => path_time::execute(&options),
            Command::Plot(options) => plot::execute(&options),
            Command::Animate(options) => animate::execute(&options),
            Command::Export(options) => export::execute(&options),
            Command::Validate(options) => validate::execute(&options),
            Command::Models(options) => models::execute(&options),
            Command::Schema => schema::execute(),
            Command::Docs(options) => docs::execute(&options),
            Command::Completions(options) => completions::execute(&options),
            Command::Man(options) => man::execute(&options),
        }
    }
}

/// Tells people, not programs, where messages are explained.
fn advise() {
    if !kept(|_| ()) && io::stderr().is_terminal() {
        remark("`linkdyn docs messages` explains messages");
    }
}

/// What clap has to say: a fault of the arguments, or the help or version that was requested.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_consistent() {
        Arguments::command().debug_assert();
    }
}
