//! The gradient of the responses of a variant, from its motion and the mechanisms around it.

use super::super::around::Around;
use super::super::mechanisms::Mechanisms;
use super::super::slopes::{Along, Depth, Slopes, Wanted};
use super::{Beside, place};
use crate::analysis::clearance_link::{balance, carried};
use crate::analysis::responses::Dual;
use crate::mechanism::driven::Driven;
use crate::system::System;

/// A time, and whether derivatives by time are wanted there.
type At = (f64, bool);
/// The needed columns, where they are known.
type Found = Option<Vec<Dual<f64>>>;

/// The instants of a motion with the derivatives of the needed columns.
struct Instants<'i, 'f, 's> {
    beside: &'i mut Beside<'f>,
    driven: Driven<'s>,
    slopes: Slopes,
    arounds: &'i [Option<Around>],
    /// What was worked out, by time and whether its derivatives by time are there.
    known: Vec<(At, Found)>,
}

impl Beside<'_> {
    /// Keeps motions from now on, for derivatives.
    pub fn keep_motion(&mut self) {
        self.keeps = true;
    }

    /// Whether the motion of these values is kept.
    pub fn has(&self, values: &[f64]) -> bool {
        self.kept.as_deref() == Some(values)
    }

    /// Derivatives of the responses by the values whose motion is kept, which matter over some lengths, by responses; NaN where
    /// one is not known.
    pub fn differentiate(
        &mut self,
        (values, lengths): (&[f64], &[f64]),
        mechanisms: &mut Mechanisms,
        gradient: &mut [f64],
    ) {
        gradient.fill(f64::NAN);
        if self.nodes.len() < 2 {
            return;
        }
        let responses = self.responses;
        let numbers = lengths.iter().copied().enumerate();
        let arounds: Vec<Option<Around>> = numbers
            .map(|number| Around::new(mechanisms, responses, values, number))
            .collect();
        let Some(system) = mechanisms.at(values, 1.0) else {
            return;
        };
        let solver = self.solver();
        let outputs = self.track.stations.iter().filter(|one| one.is_output);
        let rows: Vec<f64> = outputs.map(|one| one.instant.time).collect();
        let evaluation = self.evaluation.clone();
        let parameters = evaluation.parameters_with(values.len(), |place, k| {
            arounds[k]
                .as_ref()
                .map_or(f64::NAN, |around| around.named[place])
        });
        let mut instants = Instants {
            driven: Driven::take_up(&system, solver),
            slopes: Slopes::new(&system, self.track.places.len()),
            beside: self,
            arounds: &arounds,
            known: Vec::new(),
        };
        evaluation.differentiate(
            &rows,
            (&parameters, lengths),
            gradient,
            &mut |time, flows| instants.at((time, flows)),
        );
        let solver = instants.driven.set_aside();
        self.solver = Some(solver);
    }

    fn depth(&self) -> Depth {
        match (self.track.channels.are_positions(), self.track.reactions) {
            (true, _) => Depth::Positions,
            (false, false) => Depth::Motion,
            (false, true) => Depth::Forces,
        }
    }
}

impl Instants<'_, '_, '_> {
    /// The needed columns at a time, each with its derivatives by the values, and by time where that is asked for; none where
    /// they are not known.
    fn at(&mut self, at: At) -> Found {
        let known = self.known.iter().find(|(own, _)| *own == at);
        if let Some((_, known)) = known {
            return known.clone();
        }
        let found = self.work_out(at);
        self.known.push((at, found.clone()));
        found
    }

    fn work_out(&mut self, (time, flows): At) -> Found {
        self.place(time)?;
        let Instants {
            beside,
            driven,
            slopes,
            arounds,
            ..
        } = self;
        let system = driven.system;
        let wanted = Wanted {
            channels: &beside.track.channels,
            places: &beside.track.places,
            depth: beside.depth(),
        };
        let instant = (&beside.inputs, &beside.sample);
        let step = Slopes::time_step(system, &beside.sample);
        let parameters = arounds.iter().map(|one| one.as_ref().map(Along::Parameter));
        let all = parameters.chain(flows.then_some(Some(Along::Time(step))));
        let all = all.map(|along| slopes.along(driven, instant, &along?, wanted));
        let all: Vec<Option<Vec<f64>>> = all.collect();
        let values = wanted.places.iter().map(|&place| beside.row[place]);
        let columns = values.enumerate().map(|(column, value)| {
            let of = |own: &Option<Vec<f64>>| own.as_ref().map_or(f64::NAN, |own| own[column]);
            let slopes = all.iter().map(of).enumerate();
            Dual {
                value,
                slope: Ok(slopes.filter(|(_, slope)| *slope != 0.0).collect()),
            }
        });
        Some(columns.collect())
    }

    /// Takes the mechanism to a time, with the factors there; its row stands in `row`.
    fn place(&mut self, time: f64) -> Option<()> {
        let Instants { beside, driven, .. } = self;
        let system: &System = driven.system;
        let Beside {
            nodes,
            inputs,
            sample,
            track,
            row,
            ..
        } = &mut **beside;
        if !place(driven, nodes, time, inputs, &mut sample.q) {
            return None;
        }
        driven.evaluation.set_position(&sample.q);
        driven.factor(inputs).ok()?;
        driven.velocity(inputs, &mut sample.v);
        driven.acceleration(inputs, &mut sample.a);
        if track.reactions {
            balance(system, &driven.evaluation, inputs, sample);
            carried(driven, inputs, sample).ok()?;
        }
        row.clear();
        track
            .channels
            .push_row(system, &driven.evaluation, inputs, sample, row);
        Some(())
    }
}
