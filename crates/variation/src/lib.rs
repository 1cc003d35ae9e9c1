//! Variation: how far tolerances and clearances carry an output of a driven mechanism.
//!
//! With φ(q) + B e = 0, e what the sources are off, and λ the multipliers of a unit load on the output y with the drivers locked, one
//! back substitution with the factors of J gives all influences at once (virtual work; Innocenti 2002, Parenti-Castelli and Venanzi
//! 2005):
//!
//! ```text
//! λ = J⁻ᵀ ∂yᵀ,   dy = −λᵀB e,   dy/dp = ∂y/∂p − λᵀ ∂φ/∂p
//! ```
//!
//! ```text
//! sources          which deviations are allowed, and which of them an influence asks for         `source`
//! first order      Σ reach of each source with the influences at the nominal position            `geometry`, `displaced`
//! worst found      an ascent from there, each step to a displaced position                       `ascent`
//!                  near change points along the output: the share of all that it needs           `path`
//! certified        a bound that nothing exceeds, where an interval Newton step contracts         `enclosure`, `changes`
//! forces           driving forces and joint forces, from statics or inverse dynamics             `forces`
//! spread           standard deviation, capability                                                `statistics`
//! least cost       tolerances that keep limits                                                   `allocate`, `rooms`
//! ```

mod allocate;
mod answer;
mod ascent;
mod changes;
mod corners;
mod displaced;
mod enclosure;
mod forces;
mod geometry;
mod levels;
mod limits;
mod output;
mod path;
mod poses;
mod question;
mod rooms;
mod source;
mod statistics;
mod stroke;
mod wanted;
mod words;

pub use allocate::{Room, Sum, Unallocated, allocate};
pub use answer::{Accuracy, Contribution, OutputAccuracy, PoseAccuracy};
pub use rooms::{Free, Limited};
pub use source::Scatter;
pub use statistics::{Capability, Pins};
pub use wanted::Levels;
pub use words::{Deviating, Of, Parameters, Refusal, Scope, accuracy};

use displaced::Mechanism;
use levels::PoseAnalysis;
use linkdyn_engine::analysis::Control;
use linkdyn_engine::system::System;
use poses::{Halt, NominalPose, Unmet, Way};
use question::Question;
use std::num::NonZeroUsize;
use wanted::Wanted;

/// Asks the question.
///
/// # Errors
/// Faults of the input; no assembly; a start that is singular; poses that the motion does not have.
fn run(
    system: &System,
    question: &Question,
    threads: NonZeroUsize,
    control: &Control,
) -> Result<Accuracy, Halt> {
    let way = Way::new(system, &question.instants, control)?;
    let mut places = way.poses();
    let mut unreached = Vec::new();
    let mut stand_of = |name: &str, at: Option<(usize, f64)>| {
        let (driver, value) = at?;
        let stand = places.stand_at(driver, value);
        let unmet = |by| Unmet {
            output: name.to_owned(),
            value,
            by,
        };
        stand.map_err(|by| unreached.push(unmet(by))).ok()
    };
    let wanted = question.outputs.iter();
    let stands: Vec<Option<NominalPose>> = wanted.map(|own| stand_of(&own.name, own.at)).collect();
    let wanted = question.forces.outputs.iter();
    let held: Vec<Option<NominalPose>> =
        wanted.map(|(_, own)| stand_of(&own.name, own.at)).collect();
    if !unreached.is_empty() {
        return Err(Halt::Unreached(unreached));
    }
    let mut outputs: Vec<OutputAccuracy> =
        question.outputs.iter().map(OutputAccuracy::blank).collect();
    let mut analysis = PoseAnalysis::new(Mechanism::new(way.another()?, question));
    let mut along = Vec::new();
    for (index, stand) in stands.iter().enumerate() {
        match stand {
            Some(stand) => outputs[index].poses = analysis.answer(&[index], stand),
            None => along.push(index),
        }
    }
    if !along.is_empty() {
        for poses in stroke::poses(&way, question, &along, threads)? {
            for (&index, pose) in along.iter().zip(poses) {
                outputs[index].poses.push(pose);
            }
        }
    }
    let poses = forces::poses(&question.forces, held, &question.instants, &mut places);
    for (place, answer) in forces::answer(system, question, &poses) {
        outputs.insert(place, answer);
    }
    let sources = question.sources.iter();
    Ok(Accuracy {
        levels: question.levels,
        sources: sources.map(|source| source.name.clone()).collect(),
        outputs,
    })
}
