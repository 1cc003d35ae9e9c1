//! A mechanism whose positions are a curve of its one pin.

use super::Reduced;
use crate::mechanism::continuation::{End, HALF_TURN, Parameter, Source, follow};
use crate::mechanism::driven::Failure;

/// Farthest point that is looked for from the last accepted one: a stage that lies farther is one of a step that is far too long.
/// In sizes of the mechanism, or radians.
const FARTHEST: f64 = 100.0;

impl Reduced<'_> {
    /// The point at hand on the smooth branch near a change point.
    pub(super) fn evaluate_bridged(&mut self, time: f64, rate: f64) -> Result<(), Failure> {
        let system = self.driven.system;
        for (v, s) in self.v.iter_mut().zip(&self.tangent) {
            *v = rate * s;
        }
        for (a, bend) in self.a.iter_mut().zip(&self.bend) {
            *a = rate * rate * bend;
        }
        self.motions.copy_from_slice(&self.tangent);
        self.driven.evaluation.set_position(&self.q);
        self.driven.evaluation.set_velocity(&self.v);
        self.driven
            .evaluation
            .eval_force(system, &self.inputs, &mut self.force);
        self.eval_balance();
        self.finish(time)
    }

    /// Position (and on bridged stretches S, S′) at u from the curve, which is followed farther where u needs it.
    pub(super) fn on_curve(&mut self, u: f64) -> Option<Source> {
        for attempt in 0..2 {
            if let Some(curve) = &self.curve {
                if let Some(source) = curve.guess(u, &mut self.q, &mut self.tangent, &mut self.bend)
                {
                    return Some(source);
                }
                // Beyond a dead centre of the pin there is no curve to follow.
                let reached = if u < curve.covered().0 {
                    curve.low
                } else {
                    curve.high
                };
                if reached != End::Reached {
                    return None;
                }
            }
            if attempt == 0 && !self.follow_curve(u) {
                return None;
            }
        }
        None
    }

    /// Follows the curve around the last accepted point, far enough to hold `u`; whether that was possible.
    pub(super) fn follow_curve(&mut self, u: f64) -> bool {
        let system = self.driven.system;
        let column = self.driven.pins[0].column;
        let centre = self.here.q[column];
        let angle = system.layout.is_angle(column);
        let unit = if angle { 1.0 } else { system.size };
        let distance = (u - centre).abs();
        if distance.is_nan() || distance > FARTHEST * unit {
            return false;
        }
        let reach = (if angle { HALF_TURN } else { system.size }).max(1.5 * distance);
        let mut inputs = self.inputs.clone();
        inputs.drive.iter_mut().for_each(|jet| jet[1..].fill(0.0));
        let start = self.here.q.clone();
        let found = follow(
            &mut self.driven,
            (Parameter::Pin, inputs),
            (centre, &start),
            (centre - reach, centre + reach),
            &|_| false,
        );
        self.curve = found.ok();
        if let Some(curve) = &mut self.curve
            && angle
        {
            curve.close_turn(system, centre);
        }
        self.curve.is_some()
    }
}
