//! The words of a question (`analysis` of a model) as the numbers that the analyses take. Below this no file names the model.

use super::channels::Contents;
use super::control::Stop;
use super::derived_columns::DerivedSelection;
use super::instants::{Equidistant, Instants, Sampled};
use super::transmission::Transmission;
use super::{driven, dynamics, dynamics::Exactness};
use crate::integrate::{Method, UnknownMethod};
use crate::mechanism::reduced::Solver;
use crate::system::System;
use linkdyn_model::error::Complaint;
use linkdyn_model::{Accelerations, Analysis, AnalysisKind, OutputsAt, Sample};
use linkdyn_output::{Column, Selection};

/// The settings of a run, in numbers.
#[derive(Debug, Clone)]
pub(super) struct Question {
    pub kind: Kind,
    /// What is computed.
    pub contents: Contents,
    /// Patterns of the columns that are wanted; none means all.
    pub columns: Vec<String>,
    /// Those that rows have; all where not given.
    pub kept: Option<Vec<Column>>,
    /// The transmission that is wanted, none within where its driver or body is not there.
    pub transmission: Option<Option<Transmission>>,
    /// Columns behind those that an analysis has.
    pub following: DerivedSelection,
    /// When there are outputs.
    pub instants: Instants,
    /// Located events are outputs, too.
    at_events: bool,
    /// A name that no method has is reported where a method is needed.
    method: Result<Method, UnknownMethod>,
    solver: Option<Solver>,
    wanted: Exactness,
    initial_step: Option<f64>,
    max_step: Option<f64>,
}

/// What has to be found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A position that closes.
    Position,
    /// A motion that the drivers prescribe.
    Prescribed,
    /// A motion that has to be integrated, unless nothing is free.
    Free,
    /// A position at rest.
    Rest,
    /// A motion so slow that it is at rest everywhere.
    Slow,
}

impl Question {
    /// What a model's analysis asks of the system that it was compiled to.
    pub fn new(system: &System, analysis: &Analysis) -> Result<Self, Complaint> {
        let solver = &analysis.solver;
        let contents = contents(analysis.kind);
        let instants = instants(system, analysis)?;
        fit(&instants, contents.columns(system).len())?;
        Ok(Question {
            kind: kind(system, analysis.kind),
            contents,
            following: DerivedSelection::in_results(system, contents, &analysis.columns),
            columns: analysis.columns.clone(),
            kept: None,
            transmission: analysis
                .transmission
                .as_ref()
                .map(|wanted| transmission(system, wanted)),
            instants,
            at_events: analysis.outputs_at == OutputsAt::Events,
            method: solver.method.parse(),
            solver: match solver.accelerations {
                Accelerations::Auto => None,
                Accelerations::Dense => Some(Solver::Tangents),
                Accelerations::Sparse => Some(Solver::Sparse),
            },
            wanted: Exactness {
                rtol: solver.rtol,
                atol: solver.atol,
            },
            initial_step: solver.initial_step,
            max_step: solver.max_step,
        })
    }

    /// Keeps the columns of rows that patterns ask for, where nothing else is read from rows afterwards.
    pub fn keep_asked(&mut self, system: &System) {
        let mut joints = system.joints.iter();
        let is_read = self.at_events
            || !self.following.is_empty()
            || !system.contacts.is_empty()
            || joints.any(|joint| joint.extras().belt.is_some());
        if !is_read && !self.columns.is_empty() {
            let columns = self.contents.columns(system);
            let kept = Selection::new(&columns, &self.columns).columns.into_iter();
            self.kept = Some(kept.map(|kept| columns[kept.index()].clone()).collect());
        }
    }

    /// For a motion that the drivers prescribe.
    pub fn driven(&self) -> driven::Settings {
        driven::Settings {
            instants: self.instants,
            at_events: self.at_events,
            contents: self.contents,
            kept: self.kept.clone(),
        }
    }

    /// For a motion that is integrated.
    ///
    /// # Errors
    /// Outputs at values of a driver that prescribes nothing, and a name that no method has.
    pub fn dynamics(&self, system: &System) -> Result<dynamics::Settings, Stop> {
        if matches!(self.instants, Instants::Sampled(_)) && !system.has_journals() {
            let message = "outputs at driver values need a motion that is prescribed";
            let hint = "give \"end\" and \"outputs\" instead";
            return Err(Complaint::new("analysis.sample", message).hint(hint).into());
        }
        let method = self.method.clone().map_err(|unknown| {
            let path = "analysis.solver.method";
            Complaint::new(path, unknown.to_string())
        })?;
        let instants = self.instants.list(system)?;
        Ok(dynamics::Settings {
            method,
            solver: self.solver,
            wanted: self.wanted,
            initial_step: self.initial_step,
            max_step: self.max_step,
            instants: instants.iter().map(|instant| instant.time).collect(),
            events_are_outputs: self.at_events,
            contents: self.contents,
            watched: (!system.contacts.is_empty()).then(|| self.columns.clone()),
            kept: self.kept.clone(),
        })
    }
}

/// Numbers that a run keeps in memory at most \[bytes\]; what is written from them takes about as much again.
const MOST: f64 = 1e9;

/// Whether a table of so many columns has room in memory, where it would otherwise end the process.
fn fit(instants: &Instants, columns: usize) -> Result<(), Complaint> {
    let rows = instants.count();
    let row = (columns * size_of::<f64>()) as f64;
    if rows.is_nan() || rows * row <= MOST {
        return Ok(());
    }
    let message = format!(
        "{rows:.0} outputs with {columns} columns each are {:.1} GB, and at most {} GB are kept",
        rows * row / 1e9,
        MOST / 1e9
    );
    let hint = format!("ask for at most {:.0} outputs", (MOST / row).floor());
    Err(Complaint::new(instants.word(), message).hint(hint))
}

/// Journals that move freely in their bearings leave the mechanism free to move, however it is driven.
fn kind(system: &System, kind: AnalysisKind) -> Kind {
    match kind {
        AnalysisKind::Assembly => Kind::Position,
        AnalysisKind::Kinematics | AnalysisKind::InverseDynamics if !system.has_journals() => {
            Kind::Prescribed
        }
        AnalysisKind::Kinematics | AnalysisKind::InverseDynamics | AnalysisKind::Dynamics => {
            Kind::Free
        }
        AnalysisKind::Statics => Kind::Rest,
        AnalysisKind::QuasiStatics => Kind::Slow,
    }
}

/// What an analysis leaves in the results.
fn contents(kind: AnalysisKind) -> Contents {
    let (velocities, accelerations, reactions) = match kind {
        AnalysisKind::Assembly => (true, false, false),
        AnalysisKind::Kinematics => (true, true, false),
        AnalysisKind::InverseDynamics | AnalysisKind::Dynamics => (true, true, true),
        AnalysisKind::Statics | AnalysisKind::QuasiStatics => (false, false, true),
    };
    Contents {
        velocities,
        accelerations,
        reactions,
        friction: reactions && kind != AnalysisKind::Statics,
    }
}

/// When an analysis has outputs: at t = 0 where it does not say.
pub fn instants(system: &System, analysis: &Analysis) -> Result<Instants, Complaint> {
    if let Some(sample) = &analysis.sample {
        return sampled(system, sample).map(Instants::Sampled);
    }
    Ok(match (analysis.end, analysis.outputs) {
        (Some(end), Some(outputs)) => Instants::Equidistant(Equidistant { end, outputs }),
        _ => Instants::Start,
    })
}

fn sampled(system: &System, sample: &Sample) -> Result<Sampled, Complaint> {
    let driver = system.drivers.iter().position(|d| d.name == sample.driver);
    let driver = driver.ok_or_else(|| {
        let message = format!("no driver \"{}\"", sample.driver);
        Complaint::new("analysis.sample.driver", message)
    })?;
    Ok(Sampled {
        driver,
        from: sample.from,
        to: sample.to,
        step: sample.step,
    })
}

/// The transmission that an analysis names; `None` if its driver or body is not there.
pub(super) fn transmission(
    system: &System,
    wanted: &linkdyn_model::Transmission,
) -> Option<Transmission> {
    let driver = match &wanted.driver {
        Some(name) => {
            let mut drivers = system.drivers.iter();
            drivers.position(|driver| driver.name == *name)
        }
        None => (system.drivers.len() == 1).then_some(0),
    }?;
    let mut bodies = system.bodies.iter();
    let output = bodies.position(|body| body.name == wanted.output)?;
    Some(Transmission { driver, output })
}
