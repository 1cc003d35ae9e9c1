//! A mechanism whose positions are a curve of its one independent coordinate.

use super::accepted::Accepted;
use super::extrapolation::Extrapolation;
use super::place::{Given, Placed, PositionSource};
use super::profile::{Profile, SAMPLES, Terms, Told};
use crate::mechanism::continuation::{End, HALF_TURN, Parameter, Path, Source, follow};
use crate::mechanism::driven::{Driven, Failure};
use crate::system::{Inputs, System};
use linkdyn_linear::math::dot;
use std::cell::Cell;

/// Farthest point that is looked for from the last accepted one: a stage that lies farther is one of a step that is far too long.
/// In sizes of the mechanism, or radians.
const FARTHEST: f64 = 100.0;

/// Steps along it, before it is left where it is: a turn takes some dozens, unless a body reaches very far.
const MOST_STEPS: u32 = 20_000;

/// S and S' are known to no less than this [rad or sizes].
const KNOWN: f64 = 1e-12;
/// As well as this the curve is known where a position near it is wanted, which the constraints correct.
const CLOSE: f64 = 1e-8;

/// The curve, as far as it was followed.
#[derive(Clone)]
pub(super) struct CoordinateCurve<'s> {
    path: Option<Path>,
    /// Where positions come from beyond the curve's ends.
    pub beyond: Extrapolation<'s>,
    /// What the equation of motion is along it, where weights alone act.
    profile: Option<Box<Profile>>,
}

impl<'s> CoordinateCurve<'s> {
    /// Not followed yet.
    pub fn new(system: &System, beyond: Extrapolation<'s>) -> Self {
        CoordinateCurve {
            path: None,
            beyond,
            profile: (!system.looks_at_places()).then(|| Box::new(Profile::new())),
        }
    }

    /// ü at (u, u̇) from what is known along the curve to this tolerance, where that is at hand; all else (n) is room.
    pub fn acceleration(
        &mut self,
        [u, rate]: [f64; 2],
        tolerance: f64,
        driven: &Driven,
        [q, force]: [&mut [f64]; 2],
        [tangent, bend]: [&mut [f64]; 2],
    ) -> Option<f64> {
        let (path, profile) = (self.path.as_mut()?, self.profile.as_mut()?);
        let u = path.within_turn(u);
        let told = profile.at(u, rate);
        if let Told::Acceleration(acceleration) = told {
            return Some(acceleration);
        }
        // Stages of steps that are far too long lie where the curve has not been.
        if !matches!(told, Told::Wanted) || !path.holds(u) {
            return None;
        }
        path.tolerance = tolerance.max(KNOWN);
        let system = driven.system;
        system
            .mass
            .weigh(&system.layout, system.gravity.into(), force);
        let mut samples = [[0.0; 4]; SAMPLES];
        let mut each = samples.iter_mut().zip(profile.places(u));
        let all_known = each.all(|(sample, u)| {
            let source = path.guess(u, q, tangent, bend);
            *sample = terms(system, force, tangent, bend);
            matches!(source, Some(Source::Known | Source::Bridged { .. }))
        });
        profile.take(u, all_known.then_some(&samples), path.tolerance);
        match profile.at(u, rate) {
            Told::Acceleration(acceleration) => Some(acceleration),
            Told::Wanted | Told::Nothing => None,
        }
    }

    /// What was followed, where that has begun.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_ref()
    }

    /// Whether it was followed, and is closed.
    pub fn comes_round(&self) -> bool {
        self.path.as_ref().is_some_and(|path| path.turn.is_some())
    }

    /// Position (and on bridged stretches S, S') at u from the curve, which is followed farther where u needs it.
    fn guess(
        &mut self,
        given: Given,
        tolerance: f64,
        driven: &mut Driven,
        [q, tangent, bend]: &mut [&mut [f64]; 3],
    ) -> Option<Source> {
        let u = given.u[0];
        for attempt in 0..2 {
            if let Some(path) = &mut self.path {
                path.tolerance = tolerance;
                if let Some(source) = path.guess(u, q, tangent, bend) {
                    return Some(source);
                }
                // Beyond a dead centre of the coordinate there is no curve to follow.
                let reached = if u < path.covered().0 {
                    path.low
                } else {
                    path.high
                };
                if reached != End::Reached {
                    return None;
                }
            }
            if attempt == 0 && !self.follow(u, given.accepted, given.inputs, driven) {
                return None;
            }
        }
        None
    }

    /// Follows the curve around the last accepted point, far enough to hold `u`; whether that was possible.
    fn follow(
        &mut self,
        u: f64,
        accepted: &Accepted,
        inputs: &Inputs,
        driven: &mut Driven,
    ) -> bool {
        let system = driven.system;
        let column = driven.independent[0].column;
        // Of a curve that comes round nothing is kept: it holds all u but those that are no numbers.
        let Some(&centre) = accepted.here.q.get(column) else {
            return false;
        };
        let angle = system.layout.is_angle(column);
        let unit = if angle { 1.0 } else { system.size };
        let distance = (u - centre).abs();
        if distance.is_nan() || distance > FARTHEST * unit {
            return false;
        }
        let reach = (if angle { HALF_TURN } else { system.size }).max(1.5 * distance);
        let mut inputs = inputs.clone();
        inputs.drive.iter_mut().for_each(|jet| jet[1..].fill(0.0));
        let left = Cell::new(MOST_STEPS);
        let found = follow(
            driven,
            (Parameter::Coordinate, inputs),
            (centre, &accepted.here.q),
            (centre - reach, centre + reach),
            &|_| {
                left.set(left.get().saturating_sub(1));
                left.get() == 0
            },
        );
        self.path = found.ok();
        if let Some(path) = &mut self.path
            && angle
        {
            path.close_turn(system, centre);
        }
        if let Some(path) = &mut self.path {
            path.leave_out(system, unit);
        }
        if let (Some(path), Some(profile)) = (&self.path, &mut self.profile) {
            profile.restart(unit, path.covered());
        }
        self.path.is_some()
    }
}

/// The terms of the equation of motion where the tangent and its derivative are these.
fn terms(system: &System, force: &[f64], tangent: &[f64], bend: &[f64]) -> Terms {
    let sizes = tangent.iter().zip(force).map(|(s, q)| (s * q).abs());
    [
        system.mass.product(tangent, tangent),
        system.mass.product(tangent, bend),
        dot(tangent, force),
        sizes.sum(),
    ]
}

impl<'s> PositionSource<'s> for CoordinateCurve<'s> {
    fn place(
        &mut self,
        given: Given,
        driven: &mut Driven<'s>,
        mut to: [&mut [f64]; 3],
    ) -> Result<Placed, Failure> {
        let tolerance = given.known_to.map_or(CLOSE, |known_to| known_to.max(KNOWN));
        match self.guess(given, tolerance, driven, &mut to) {
            Some(Source::Regular) => Ok(Placed::Guess),
            Some(Source::Known) if given.known_to.is_none() => Ok(Placed::Close),
            Some(Source::Known) => Ok(Placed::Known),
            Some(Source::Bridged { .. }) => Ok(Placed::Smooth),
            None => self.beyond.place(given, driven, to),
        }
    }

    fn forget(&mut self) {
        self.path = None;
    }
}
