//! A variant at rest: the equilibrium of `statics`, and its derivatives.

use super::around::Around;
use super::ended::Ended;
use super::mechanisms::Mechanisms;
use super::needs::{Needs, Room, State, duals};
use super::slopes::{Along, Slopes, WantedColumns};
use crate::analysis::control::{Control, Stop};
use crate::analysis::responses::{Evaluation, Responses};
use crate::analysis::{equilibrium, statics};
use crate::mechanism::equilibrium::Stability;
use crate::mechanism::linearised_system::LinearisedSystem;
use crate::system::System;
use linkdyn_output::{Report, Status};

/// One thread's variant.
pub struct Resting<'f> {
    needs: &'f Needs,
    responses: &'f Responses,
    evaluation: Evaluation<'f>,
    room: Room,
    /// Whether equilibria are kept for derivatives, and the last one.
    keeps: bool,
    kept: Option<Kept>,
}

/// An equilibrium.
struct Kept {
    values: Vec<f64>,
    stability: Stability,
    /// Coordinates that determine the rest, and the position (n).
    columns: Vec<usize>,
    q: Vec<f64>,
}

impl<'f> Resting<'f> {
    pub fn new(needs: &'f Needs, responses: &'f Responses) -> Self {
        Resting {
            needs,
            responses,
            evaluation: responses.begin(),
            room: needs.room(),
            keeps: false,
            kept: None,
        }
    }

    /// Keeps equilibria from now on, for derivatives.
    pub fn keep_motion(&mut self) {
        self.keeps = true;
    }

    /// Whether the equilibrium of these values is kept.
    pub fn has(&self, values: &[f64]) -> bool {
        self.kept.as_ref().is_some_and(|kept| kept.values == values)
    }

    /// Works out the responses; `None` if only a run of the model can tell what is wrong with it.
    pub fn run(
        &mut self,
        values: &[f64],
        mechanisms: &mut Mechanisms,
        control: &Control,
        responses: &mut [f64],
    ) -> Option<Ended> {
        self.kept = None;
        let system = mechanisms.at(values, 1.0)?;
        mechanisms.tell(values, self.responses, &mut self.evaluation);
        self.evaluation.restart();
        let status = match self.rest(&system, values, control) {
            Ok(()) => Status::Completed,
            Err(Stop::Failed { status, .. }) => status,
            Err(Stop::Input(_)) => return None,
        };
        let report = Report {
            status,
            ..Report::default()
        };
        self.evaluation.finish(&report, responses);
        Some(Ended {
            status,
            ..Ended::whole(responses)
        })
    }

    /// Moves a mechanism into its equilibrium, and reads the row there.
    fn rest(&mut self, system: &System, values: &[f64], control: &Control) -> Result<(), Stop> {
        statics::refuse(system)?;
        let (assembled, mut held) = equilibrium::start(system, 0.0, false)?;
        let balance = equilibrium::balance(&mut held, &assembled, control, None)?;
        self.read(&mut held);
        self.evaluation.row(&self.room.values);
        self.kept = self.keeps.then(|| Kept {
            values: values.to_vec(),
            stability: balance.stability,
            columns: held.columns(),
            q: held.q.clone(),
        });
        Ok(())
    }

    fn read(&mut self, held: &mut LinearisedSystem) {
        let sample = statics::sample(held);
        let system = held.driven.system;
        let state = State {
            system,
            evaluation: &held.driven.evaluation,
            inputs: &held.inputs,
            sample: &sample,
        };
        let mut derived = self.needs.derived(system);
        self.needs.read(state, derived.as_mut(), &mut self.room);
    }

    /// Derivatives of the responses by the values whose equilibrium is kept, which matter over some lengths, by responses; NaN
    /// where one is not known, as beside an equilibrium that is not stable: another one is found there.
    pub fn differentiate(
        &mut self,
        (values, lengths): (&[f64], &[f64]),
        mechanisms: &mut Mechanisms,
        gradient: &mut [f64],
    ) {
        gradient.fill(f64::NAN);
        let kept = self.kept.take();
        if let Some(kept) = &kept
            && kept.stability == Stability::Stable
        {
            let arounds = Around::all(mechanisms, self.responses, values, lengths);
            if let Some(system) = mechanisms.at(values, 1.0)
                && let Ok(mut held) = LinearisedSystem::new(&system, &kept.columns, &kept.q, 0.0)
            {
                self.follow(&mut held, &arounds, lengths, gradient);
            }
        }
        self.kept = kept;
    }

    fn follow(
        &mut self,
        held: &mut LinearisedSystem,
        arounds: &[Option<Around>],
        lengths: &[f64],
        gradient: &mut [f64],
    ) {
        self.read(held);
        let wanted = WantedColumns {
            needs: self.needs,
            depth: self.needs.depth(true),
        };
        let mut slopes = Slopes::new(held.driven.system, wanted);
        let Some(equilibrium) = slopes.equilibrium(held) else {
            return;
        };
        let mut derived = Around::derived(arounds, self.needs);
        let each = arounds.iter().zip(&mut derived);
        let each = each.map(|(around, derived)| {
            let along = Along::Parameter(around.as_ref()?);
            slopes.at_rest(held, &equilibrium, &along, derived)
        });
        let all: Vec<Option<Vec<f64>>> = each.collect();
        let columns = duals(&self.room.values, &all);
        let parameters = Around::parameters(arounds, &self.evaluation);
        let time = held.inputs.time;
        self.evaluation
            .differentiate(&[time], (&parameters, lengths), gradient, &mut |_, _| {
                Some(columns.clone())
            });
    }
}
