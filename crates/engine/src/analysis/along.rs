//! A driven mechanism anywhere along the stroke of a driver, at any speed and acceleration: what a motion law asks of it before the law
//! is known.
//!
//! The model's driver goes from one end of the stroke to the other in a second, at constant velocity. Its path is followed as in a
//! run, so that places on it are on its branch. At each place the position is solved once; velocities, accelerations and reactions follow from
//! the same factors for each pair of rates.

use super::assembly::{assemble, check_driven};
use super::channels::Channels;
use super::clearance_link::{balance, carried};
use super::control::{Control, Stop};
use super::driven::{describe, path, refuse};
use super::in_line::{singular_text, stressed_rows};
use super::question::Kind;
use super::run::Prepared;
use super::sample::Sample;
use crate::mechanism::continuation::{
    End, Parameter, Path, SingularKind, SingularPosition, Source,
};
use crate::mechanism::driven::Driven;
use crate::system::{Inputs, System};
use linkdyn_model::error::Complaint;
use linkdyn_output::{Column, Status};
use std::sync::Arc;

/// A mechanism along a stroke.
pub struct AlongStroke<'s> {
    system: &'s System,
    channels: Channels,
    driven: Driven<'s>,
    path: Path,
    driver: usize,
    inputs: Inputs,
    sample: Sample,
}

/// An instant that is wanted: rates of the driver's value, and the time that forces see \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rates {
    /// ṡ [1/s]
    pub velocity: f64,
    /// s̈ [1/s²]
    pub acceleration: f64,
    /// \[s\]
    pub time: f64,
}

impl<'s> AlongStroke<'s> {
    /// Follows the driver, which moves from the first end of its stroke at t = 0 to the other at t = 1 s.
    ///
    /// # Errors
    /// What runs refuse, and strokes with a singular position.
    pub fn new(prepared: &'s Prepared, driver: usize, control: &Control) -> Result<Self, Stop> {
        let (system, question) = prepared.parts();
        refuse(system, true, false)?;
        if question.kind != Kind::Prescribed || system.links > 0 {
            let message = "joints with clearance leave more free than the drivers prescribe";
            let complaint = Complaint::new("joints", message);
            return Err(complaint.hint("remove their \"clearance\"").into());
        }
        let start = Inputs::at_time(system, 0.0);
        let assembled = assemble(system, &start)?;
        check_driven(system, &assembled, &start)?;
        let singular = |_| {
            let message = "the start of the stroke is a singular position; begin beside it";
            Stop::failed(Status::Singular, message.into())
        };
        let mut q = assembled.q;
        let mut driven = Driven::new(system, &q, &start).map_err(singular)?;
        driven.correct(&mut q, &start).map_err(singular)?;
        let law = &system.drivers[driver].law;
        let range = match Parameter::of(system) {
            Parameter::Time | Parameter::Coordinate => (0.0, 1.0),
            Parameter::DriverValue => {
                let [from, to] = [0.0, 1.0].map(|t| law.value(t));
                (from.min(to), from.max(to))
            }
        };
        let first = match Parameter::of(system) {
            Parameter::Time | Parameter::Coordinate => 0.0,
            Parameter::DriverValue => start.drive[0][0],
        };
        let path = path(&mut driven, (first, &q), range, control).map_err(singular)?;
        let along = AlongStroke {
            channels: Channels::new(system, question.contents),
            sample: Sample::new(system),
            inputs: start,
            system,
            driven,
            path,
            driver,
        };
        match along.obstacle(range, control) {
            Some(why) => Err(why),
            None => Ok(along),
        }
    }

    /// What is singular on the stroke.
    fn obstacle(&self, (low, high): (f64, f64), control: &Control) -> Option<Stop> {
        let (name, path) = (&self.system.drivers[self.driver].name, &self.path);
        let ends = [path.low, path.high];
        if ends.contains(&End::Interrupted) {
            let status = control.stop().unwrap_or(Status::Interrupted);
            return Some(Stop::failed(status, "interrupted".into()));
        }
        let stuck = ends.into_iter().find_map(|end| match end {
            End::Stuck { s } => Some(s),
            End::Reached | End::DeadCentre { .. } | End::Interrupted => None,
        });
        if let Some(s) = stuck {
            let message = format!(
                "driver \"{name}\" can't be followed beyond {}; end the stroke before it",
                self.place(s)
            );
            return Some(Stop::failed(Status::Singular, message));
        }
        let edge = 1e-10 * (high - low);
        let singular = path.singular_between(low - edge, high + edge);
        let SingularPosition {
            kind,
            s,
            self_stress,
        } = singular.first()?;
        let at = self.place(*s);
        let what = singular_text(self.system, &stressed_rows(self.system, self_stress));
        let what = what.map_or_else(String::new, |what| format!(", where {what}"));
        let (status, message) = match kind {
            SingularKind::DeadCentre => (
                Status::DeadCentre,
                format!(
                    "dead centre: driver \"{name}\" can't go on beyond {at}{what}. End the stroke before it, or drive another body"
                ),
            ),
            SingularKind::ChangePoint => (
                Status::Singular,
                format!(
                    "change point at {at}{what}: there joint forces have no bound or no value. End the stroke before it"
                ),
            ),
        };
        Some(Stop::failed(status, message))
    }

    /// The driver's value at a parameter of the path, in words.
    fn place(&self, s: f64) -> String {
        let value = match self.path.parameter {
            Parameter::DriverValue => s,
            Parameter::Time | Parameter::Coordinate => {
                self.system.drivers[self.driver].law.value(s)
            }
        };
        self.system.driver_value(self.driver, value)
    }

    /// The columns of rows.
    pub fn columns(&self) -> &Arc<[Column]> {
        self.channels.columns()
    }

    /// Rows at a part of the stroke, one for each pair of rates, one behind the other.
    ///
    /// # Errors
    /// Why there are none.
    pub fn rows(&mut self, part: f64, rates: &[Rates], rows: &mut Vec<f64>) -> Result<(), String> {
        let system = self.system;
        rows.clear();
        self.inputs.set_time(system, part);
        let value = self.inputs.drive[self.driver][0];
        let s = match self.path.parameter {
            Parameter::DriverValue => value,
            Parameter::Time | Parameter::Coordinate => part,
        };
        let fault = |why: String| {
            format!(
                "no solution at {}: {why}",
                system.driver_value(self.driver, value)
            )
        };
        let (driven, inputs, sample) = (&mut self.driven, &mut self.inputs, &mut self.sample);
        let Sample { q, v, a, .. } = &mut *sample;
        match self.path.guess(s, q, v, a) {
            Some(Source::Regular | Source::Known) => {}
            Some(Source::Bridged { .. }) | None => {
                return Err(fault("the constraints are singular there".into()));
            }
        }
        let found = driven.prepare(q, inputs);
        let found = found.and_then(|()| driven.correct(q, inputs));
        let found = found.and_then(|_| driven.factor(inputs));
        found.map_err(|why| fault(describe(system, why)))?;
        for wanted in rates {
            inputs.time = wanted.time;
            inputs.drive[self.driver] = [value, wanted.velocity, wanted.acceleration];
            driven.velocity(inputs, &mut sample.v);
            driven.acceleration(inputs, &mut sample.a);
            balance(system, &driven.evaluation, inputs, sample);
            carried(driven, inputs, sample).map_err(|why| fault(describe(system, why)))?;
            self.channels
                .push_row(system, &driven.evaluation, inputs, sample, rows);
        }
        Ok(())
    }
}
