//! `linkdyn export --equations`: the equations of motion as a text.

use std::path::Path;

use clap::ValueEnum;
use linkdyn_ask::ModelFile;
use linkdyn_ask::text::{Page, count};
use linkdyn_engine::analysis::Prepared;
use linkdyn_exchange::export::equations::{BodyState, Equations, Linkage, StartState};
use linkdyn_model::error::Complaints;
use linkdyn_model::{Accelerations, Analysis, AnalysisKind, GROUND, Model, OutputsAt, Solver};
use linkdyn_output::Trajectory;

use crate::cli::exit::{Exit, Failure};
use crate::cli::interrupt;
use crate::cli::open::ModelOptions;
use crate::cli::results::write_file;
use crate::cli::streams::print;

/// In what the equations are written.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Language {
    /// A module of Python
    Python,
    /// A document
    Latex,
}

/// A motion that is long enough to have a start \[s\].
const INSTANT: f64 = 1e-9;

/// Writes the equations.
pub fn export(model: &ModelOptions, language: Language, file: &Path) -> Result<Exit, Failure> {
    let read = model.open()?;
    let refuse = |complaints: Complaints| model.refuse(read.refused(complaints));
    let linkage = Linkage::of(read.model(), read.name()).map_err(refuse)?;
    let state = start(model, &read)?;
    let equations = linkage.at(&state).map_err(refuse)?;
    let text = match language {
        Language::Python => equations.python(),
        Language::Latex => equations.latex().map_err(refuse)?,
    };
    write_file(file, text.as_bytes())?;
    let mut page = Page::default();
    page.line(format!("{}: {}", file.display(), told(&equations)));
    print(page.text())?;
    Ok(Exit::Done)
}

/// What the equations are, in a sentence.
fn told(equations: &Equations) -> String {
    let linkage = &equations.linkage;
    let names = equations.independent.iter();
    let names = names.map(|&k| linkage.coordinates[k].identifier.as_str());
    let independent = match names.collect::<Vec<_>>().as_slice() {
        [] => "all follow from drivers".to_owned(),
        names => format!("independent: {}", names.join(", ")),
    };
    format!(
        "{}, {independent}",
        count(linkage.coordinates.len(), "coordinate")
    )
}

/// State, accelerations and efforts at t = 0, as `dynamics` has them.
fn start(options: &ModelOptions, read: &ModelFile) -> Result<StartState, Failure> {
    let refuse = |complaints| options.refuse(read.refused(complaints));
    let model = read.model().edit(only_moves).map_err(refuse)?;
    let prepared = Prepared::new(&model).map_err(refuse)?;
    let outcome = prepared.run(&interrupt::control()).map_err(refuse)?;
    let state = state_of(&model, &outcome.trajectory);
    state.ok_or_else(|| {
        let why = outcome.report.message.as_deref();
        let why = why.unwrap_or("the start has no accelerations");
        Failure::Stopped(format!("{}: {why}", options.label()))
    })
}

/// Leaves the mechanism and its motion alone.
fn only_moves(model: &mut Model) {
    model.analysis = Some(Analysis {
        kind: AnalysisKind::Dynamics,
        end: Some(INSTANT),
        outputs: Some(2),
        sample: None,
        outputs_at: OutputsAt::Equidistant,
        solver: Solver {
            accelerations: Accelerations::Auto,
            ..Solver::default()
        },
        columns: Vec::new(),
        transmission: None,
    });
    model.points.clear();
    model.measures.clear();
    model.outputs.clear();
    model.responses.clear();
    model.accuracy = None;
    model.study = None;
    model.optimise = None;
}

/// The first row of a motion; none where a number of it does not exist.
fn state_of(model: &Model, motion: &Trajectory) -> Option<StartState> {
    let row = motion.rows().next()?;
    let value = |name: String| {
        let value = row[motion.column_index(&name)?];
        value.is_finite().then_some(value)
    };
    let moving = model.bodies.keys().filter(|name| *name != GROUND);
    let bodies = moving.map(|body| {
        let of = |quantity: &str| value(format!("{body}.{quantity}"));
        Some(BodyState {
            position: [of("x")?, of("y")?],
            angle: of("angle")?,
            velocity: [of("vx")?, of("vy")?],
            omega: of("omega")?,
            acceleration: [of("ax")?, of("ay")?],
            alpha: of("alpha")?,
        })
    });
    let drivers = model.drivers.keys();
    let efforts = drivers.map(|driver| value(format!("driver.{driver}.effort")));
    Some(StartState {
        bodies: bodies.collect::<Option<_>>()?,
        efforts: efforts.collect::<Option<_>>()?,
    })
}
