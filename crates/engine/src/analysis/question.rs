//! The words of a question about motion, as the numbers that [`super::dynamics`] takes.

use super::channels::Contents;
use super::control::{Control, Stop};
use super::driven;
use super::dynamics::{self, Settings, Start, Wanted};
use super::instants::instants;
use crate::integrate::{Method, UnknownMethod};
use crate::system::System;
use linkdyn_model::error::Complaint;
use linkdyn_model::{Analysis, OutputsAt};
use linkdyn_output::{Report, Trajectory};

/// Runs a motion: the outputs, and rows of peaks between them. Where nothing is free, it is that of the drivers.
///
/// # Errors
/// Faults of the input, and a start that is impossible.
pub fn run(
    system: &System,
    analysis: &Analysis,
    contents: Contents,
    control: &Control,
) -> Result<(Trajectory, Trajectory, Report), Stop> {
    let start = Start::of(system)?;
    if start.is_driven(system) {
        let (trajectory, report) = driven::run(system, analysis, control)?;
        return Ok((trajectory, Trajectory::default(), report));
    }
    let settings = settings(system, analysis, contents)?;
    dynamics::run(system, start, &settings, control)
}

/// What is asked for, in numbers.
fn settings(system: &System, analysis: &Analysis, contents: Contents) -> Result<Settings, Stop> {
    if analysis.sample.is_some() && system.contacts.is_empty() {
        return Err(Stop::Input(vec![
            Complaint::new(
                "analysis.sample",
                "outputs at driver values need a motion that is prescribed",
            )
            .hint("give \"end\" and \"outputs\" instead"),
        ]));
    }
    let solver = &analysis.solver;
    let method: Method = solver.method.parse().map_err(|unknown: UnknownMethod| {
        let path = "analysis.solver.method";
        Stop::Input(vec![Complaint::new(path, unknown.to_string())])
    })?;
    let instants = instants(system, analysis).map_err(Stop::Input)?;
    Ok(Settings {
        method,
        wanted: Wanted {
            rtol: solver.rtol,
            atol: solver.atol,
        },
        initial_step: solver.initial_step,
        max_step: solver.max_step,
        instants: instants.iter().map(|instant| instant.time).collect(),
        events_are_outputs: analysis.outputs_at == OutputsAt::Events,
        contents,
        columns: analysis.columns.clone(),
    })
}
