//! A driven motion at times between its outputs.

use super::super::channels::Channels;
use super::super::sample::Sample;
use crate::mechanism::continuation::{Parameter, Path, Source};
use crate::mechanism::driven::Driven;
use crate::system::{Inputs, System};

use super::super::clearance_link::{balance, carried};
use super::outputs::rest;

/// A motion that was followed, and can be asked for more of its rows.
pub struct Between<'s> {
    driven: Driven<'s>,
    path: Path,
    reactions: bool,
    inputs: Inputs,
    sample: Sample,
}

impl<'s> Between<'s> {
    /// Of a motion; `None` if its rows depend on the ones before, as with massless links.
    pub fn new(driven: Driven<'s>, path: Path, reactions: bool) -> Option<Self> {
        let system: &System = driven.system;
        (system.links == 0).then(|| Between {
            inputs: Inputs::still(system),
            sample: Sample::new(system),
            driven,
            path,
            reactions,
        })
    }

    /// Appends the row at a time; whether it is known there: near a change point it is not.
    pub fn row(&mut self, channels: &Channels, time: f64, row: &mut Vec<f64>) -> bool {
        self.solve(time).is_some_and(|()| {
            channels.push_row(
                self.driven.system,
                &self.driven.evaluation,
                &self.inputs,
                &self.sample,
                row,
            );
            true
        })
    }

    /// Position and velocity (n) at a time with what is prescribed there, where it is known.
    pub fn point(&mut self, time: f64) -> Option<(&[f64], &[f64], &Inputs)> {
        self.solve(time)?;
        Some((&self.sample.q, &self.sample.v, &self.inputs))
    }

    fn solve(&mut self, time: f64) -> Option<()> {
        let system = self.driven.system;
        self.inputs.set_time(system, time);
        let s = match self.path.parameter {
            Parameter::DriverValue => self.inputs.drive[0][0],
            Parameter::Time | Parameter::Coordinate => time,
        };
        let Sample { q, v, a, .. } = &mut self.sample;
        if !self.path.holds(s) || self.path.guess(s, q, v, a) != Some(Source::Regular) {
            return None;
        }
        self.driven.prepare(q, &self.inputs).ok()?;
        self.driven.correct(q, &self.inputs).ok()?;
        self.driven.factor(&self.inputs).ok()?;
        self.driven.velocity(&self.inputs, v);
        self.driven.acceleration(&self.inputs, a);
        if self.reactions {
            let Between {
                driven,
                inputs,
                sample,
                ..
            } = self;
            balance(system, &driven.evaluation, inputs, sample);
            carried(driven, inputs, sample).ok()?;
            rest(driven, sample);
        }
        Some(())
    }
}
