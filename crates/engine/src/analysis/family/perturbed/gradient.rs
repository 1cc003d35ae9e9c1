//! The gradient of the responses of a variant, from its motion and the mechanisms around it.

use super::super::around::Around;
use super::super::mechanisms::Mechanisms;
use super::super::needs::{Depth, State, duals};
use super::super::slopes::{Along, Slopes, WantedColumns};
use super::{PerturbedSolver, VariantMarch, place};
use crate::analysis::clearance_link::{balance, carried};
use crate::analysis::derived::Derived;
use crate::analysis::responses::Dual;
use crate::mechanism::driven::Driven;
use crate::system::System;

/// A time, and whether derivatives by time are wanted there.
type TimeOfSlopes = (f64, bool);
/// The needed columns, where they are known.
type Found = Option<Vec<Dual<f64>>>;

/// The instants of a motion with the derivatives of the needed columns.
struct GradientInstants<'i, 'f, 's> {
    perturbed: &'i mut PerturbedSolver<'f>,
    driven: Driven<'s>,
    slopes: Slopes<'f>,
    arounds: &'i [Option<Around>],
    /// What makes of rows what follows from them: of the mechanisms around this one, and of itself.
    derived: Vec<Vec<Derived<'i>>>,
    own: Option<Derived<'s>>,
    /// What was worked out, by time and whether its derivatives by time are there.
    known: Vec<(TimeOfSlopes, Found)>,
}

impl PerturbedSolver<'_> {
    /// Keeps motions from now on, for derivatives.
    pub fn keep_motion(&mut self, nominal: &System) {
        if !self.keeps
            && let Some(mut march) = VariantMarch::new(self.track, nominal, true)
        {
            if self.depth == Depth::Forces {
                march.weigh();
            }
            self.march = march;
            self.keeps = true;
        }
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
        let arounds = Around::all(mechanisms, responses, values, lengths);
        let Some(system) = mechanisms.at(values, 1.0) else {
            return;
        };
        let solver = self.solver();
        let outputs = self.track.stations.iter().filter(|one| one.is_output);
        let rows: Vec<f64> = outputs.map(|one| one.instant.time).collect();
        let evaluation = self.evaluation.clone();
        let parameters = Around::parameters(&arounds, &evaluation);
        let needs = &self.track.needs;
        let wanted = WantedColumns {
            needs,
            depth: needs.depth(self.track.reactions),
        };
        let mut instants = GradientInstants {
            derived: Around::derived(&arounds, needs),
            own: needs.derived(&system),
            driven: Driven::take_up(&system, solver),
            slopes: Slopes::new(&system, wanted),
            perturbed: self,
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
}

impl GradientInstants<'_, '_, '_> {
    /// The needed columns at a time, each with its derivatives by the values, and by time if that is requested; `None` if
    /// they are not known.
    fn at(&mut self, at: TimeOfSlopes) -> Found {
        let known = self.known.iter().find(|(own, _)| *own == at);
        if let Some((_, known)) = known {
            return known.clone();
        }
        let found = self.work_out(at);
        self.known.push((at, found.clone()));
        found
    }

    fn work_out(&mut self, (time, flows): TimeOfSlopes) -> Found {
        self.place(time)?;
        let GradientInstants {
            perturbed,
            driven,
            slopes,
            arounds,
            derived,
            own,
            ..
        } = self;
        let instant = (&perturbed.inputs, &perturbed.sample);
        let around = arounds.iter().zip(derived).map(|(around, derived)| {
            let along = Along::Parameter(around.as_ref()?);
            slopes.along(driven, instant, &along, derived)
        });
        let mut all: Vec<Option<Vec<f64>>> = around.collect();
        if flows {
            let step = Slopes::time_step(driven.system, &perturbed.sample);
            all.push(slopes.along(driven, instant, &Along::Time(step), own.as_mut_slice()));
        }
        Some(duals(&perturbed.room.values, &all))
    }

    /// Takes the mechanism to a time, with the factors there; its row stands in `row`.
    fn place(&mut self, time: f64) -> Option<()> {
        let GradientInstants {
            perturbed,
            driven,
            own,
            ..
        } = self;
        let system: &System = driven.system;
        let PerturbedSolver {
            nodes,
            inputs,
            sample,
            track,
            room,
            ..
        } = &mut **perturbed;
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
        let state = State {
            system,
            evaluation: &driven.evaluation,
            inputs,
            sample,
        };
        track.needs.read(state, own.as_mut(), room);
        Some(())
    }
}
