//! Accuracy: how far tolerances and clearances carry an output of a driven mechanism.
//!
//! With φ(q) + e = 0, e the gaps that clearances leave, and λ the multipliers of a unit load on the output y with the drivers
//! locked, one back substitution with the factors of J gives all influences at once (virtual work; Innocenti 2002,
//! Parenti-Castelli and Venanzi 2005):
//!
//! ```text
//! λ = J⁻ᵀ ∂yᵀ,   dy = −λ·e,   dy/dp = ∂y/∂p − λᵀ ∂φ/∂p
//! ```
//!
//! ```text
//! first order      Σ reach of each source with the influences at the nominal position             `source`
//! worst found      stationary under all sources, at the displaced position                        `worst`, `climb`, near change points `reach`
//! needed           the share of all sources that a deviation needs                                `needed`
//! certified        a bound that nothing exceeds, where an interval Newton step contracts          `enclosure`
//! forces           efforts and joint forces, from statics or inverse dynamics                     `forces`
//! spread           standard deviation, capability                                                 `statistics`
//! least cost       tolerances that keep limits                                                    `allocate`
//! ```

mod allocate;
mod answer;
mod chosen;
mod climb;
mod corners;
mod dimensions;
mod displaced;
mod enclosure;
mod forces;
mod grip;
mod held;
mod levels;
mod needed;
mod output;
mod poses;
mod reach;
mod rooms;
mod search;
mod sorted;
mod source;
mod statistics;
mod stroke;
mod transposed;
mod turn;
mod words;
mod worst;

pub use allocate::{Room, Sum, Unallocated, allocate};
pub use answer::{Accuracy, Contribution, OutputAccuracy, PoseAccuracy};
pub use levels::Levels;
pub use rooms::{Free, Limited};
pub use statistics::{Capability, Pins, Scatter};
pub use words::{Deviating, Parameters, Refusal, Scope, accuracy};

use super::control::Control;
use super::instants::OutputInstant;
use crate::system::System;
use corners::Corners;
use dimensions::Dimensions;
use displaced::{Mechanism, Stand};
use levels::Asked;
use output::Output;
use poses::{Halt, Unmet, Way};
use source::Play;
use std::num::NonZeroUsize;
use stroke::Stroke;

/// What is asked of a system.
struct Question<'q> {
    pub outputs: Vec<Wanted<Output>>,
    pub forces: forces::Question<'q>,
    pub sources: Vec<Named>,
    pub dimensions: &'q Dimensions,
    pub pins: Pins,
    pub levels: Levels,
    pub instants: Vec<OutputInstant>,
    /// Bounds of what the steps of parameters leave out (dimensions); none where they are not known.
    pub slack: Option<Vec<f64>>,
    /// Steps of the dimensions for deviations of the parameters.
    pub corners: &'q Corners<'q>,
}

/// An output that is wanted.
struct Wanted<Of> {
    pub name: String,
    pub of: String,
    pub output: Of,
    /// Driver and its value [rad or m] at the pose; none: all instants.
    pub at: Option<(usize, f64)>,
    /// Allowed deviations, in the unit of the output.
    pub limits: Option<[f64; 2]>,
}

/// A source and what the file calls it.
struct Named {
    pub name: String,
    pub play: Play,
}

/// Asks the question.
///
/// # Errors
/// Faults of the input; no assembly; a start that is singular; poses that the motion does not have.
fn run(
    system: &System,
    question: &Question,
    (threads, control): (NonZeroUsize, &Control),
) -> Result<Accuracy, Halt> {
    let way = Way::new(system, &question.instants, control)?;
    let mut places = way.poses();
    let named = question.sources.iter();
    let plays: Vec<Play> = named.map(|named| named.play.clone()).collect();
    let mechanism = Mechanism::new(way.another()?, question, &plays);
    let mut unreached = Vec::new();
    let mut stand_of = |name: &str, at: Option<(usize, f64)>| {
        let (driver, value) = at?;
        let stand = places.stand_at(driver, value);
        stand
            .map_err(|by| {
                unreached.push(Unmet {
                    output: name.to_owned(),
                    value,
                    by,
                })
            })
            .ok()
    };
    let wanted = question.outputs.iter();
    let stands: Vec<Option<Stand>> = wanted.map(|own| stand_of(&own.name, own.at)).collect();
    let wanted = question.forces.outputs.iter();
    let held: Vec<Option<Stand>> = wanted.map(|(_, own)| stand_of(&own.name, own.at)).collect();
    if !unreached.is_empty() {
        return Err(Halt::Unreached(unreached));
    }
    let mut asked = Asked::new(system, question, mechanism);
    let mut outputs: Vec<OutputAccuracy> = question.outputs.iter().map(blank).collect();
    let along: Vec<usize> = (0..outputs.len())
        .filter(|&index| stands[index].is_none())
        .collect();
    for (index, stand) in stands.iter().enumerate() {
        if let Some(stand) = stand {
            outputs[index].poses = asked.poses(&[index], stand);
        }
    }
    if !along.is_empty() {
        let stroke = Stroke {
            way: &way,
            question,
            plays: &plays,
            outputs: &along,
        };
        let answers = stroke.poses(threads)?;
        for &index in &along {
            outputs[index].poses.reserve_exact(answers.len());
        }
        for poses in answers {
            for (&index, pose) in along.iter().zip(poses) {
                outputs[index].poses.push(pose);
            }
        }
    }
    let poses = forces::poses(&question.forces, held, &question.instants, &mut places);
    for (place, answer) in forces::answer(system, question, &poses) {
        outputs.insert(place, answer);
    }
    let named = question.sources.iter();
    Ok(Accuracy {
        levels: question.levels,
        sources: named.map(|named| named.name.clone()).collect(),
        outputs,
    })
}

/// An output without poses.
fn blank(wanted: &Wanted<Output>) -> OutputAccuracy {
    OutputAccuracy {
        name: wanted.name.clone(),
        of: wanted.of.clone(),
        unit: if wanted.output.is_angle() { "rad" } else { "m" },
        limits: wanted.limits,
        poses: Vec::new(),
    }
}
