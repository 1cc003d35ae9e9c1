//! Forces under tolerance and clearance: what drivers exert, and what joints carry.
//!
//! A force at a pose comes from statics or inverse dynamics of the mechanism with its sources off. A pin without friction
//! carries its force along the line of centres, so that the load says where the journal is:
//!
//! ```text
//! φ(q, p) + e = 0,   J v = −φ_t,   J a = γ,   M a + Jᵀ λ = Q        at rest v = a = 0
//! e_i = −c_i λ_i/|λ_i|      pin: the massless link under the given load, c_i from its least to its greatest clearance
//! e_i = −c_i sign λ_i       slot, slide, gear: the side of the force (of a slide with length, force or torque)
//! ė = 0                     the gaps are held at the instant
//! ```
//!
//! So a clearance is one number, from the ideal joint on to one side; a zone is two, all else is one number of both signs.
//! With all of them in p, y = λ(p) or what a joint shows of it:
//!
//! ```text
//! first order    Σ reach of ∂y/∂p, sides of the gaps held: they turn by what is off, which is of second order   `slopes`
//! worst found    y at a corner, gaps where the displaced load presses them                                     `corner`
//! certified      none: y is no equation of positions alone
//! ```

mod corner;
mod loaded;
mod question;
mod slopes;

use super::answer::{Contribution, OutputAccuracy, PoseAccuracy};
use super::poses::NominalPose;
use super::poses::Poses;
use super::source::Scatter;
use super::source::{Pair, Source, length};
use super::statistics::{Pins, capability};
use super::wanted::Levels;
use corner::Corner;
use linkdyn_engine::analysis::in_line::{singular_text, stressed_rows};
use linkdyn_engine::analysis::instants::OutputInstant;
use linkdyn_engine::system::System;
use loaded::{Carried, Loaded, Systems, Without};
pub(super) use question::{Force, ForceQuestion, Making, Owner};
use question::{Posed, room};
use slopes::{Slope, slopes};

/// Errors of derivatives above this part of what all sources do, or a thousandth of it of the force itself, leave no first order:
/// a kink leaves as much as the derivative.
const UNSURE: f64 = 1e-6;

/// The poses that are asked about: those of forces at a value of a driver (`held`), and all instants.
pub(super) fn poses(
    question: &ForceQuestion,
    held: Vec<Option<NominalPose>>,
    instants: &[OutputInstant],
    way: &mut Poses,
) -> Vec<Posed> {
    let (mut poses, mut over) = (Vec::new(), Vec::new());
    for (output, ((_, wanted), stand)) in question.outputs.iter().zip(held).enumerate() {
        match stand {
            None => over.push((output, wanted.output)),
            Some(stand) => poses.push(Posed {
                stand,
                exact: wanted.at,
                forces: vec![(output, wanted.output)],
            }),
        }
    }
    let stroke = instants.iter().filter(|_| !over.is_empty());
    poses.extend(stroke.filter_map(|instant| {
        Some(Posed {
            stand: way.stand(instant, None)?,
            exact: instant.exact,
            forces: over.clone(),
        })
    }));
    poses
}

/// All levels of forces at poses, with the places of the outputs.
pub(super) fn answer(
    system: &System,
    asked: &super::Question,
    poses: &[Posed],
) -> Vec<(usize, OutputAccuracy)> {
    let question = &asked.forces;
    let blank = question
        .outputs
        .iter()
        .map(|(place, wanted)| (*place, OutputAccuracy::blank(wanted)));
    let mut found: Vec<(usize, OutputAccuracy)> = blank.collect();
    if found.is_empty() {
        return found;
    }
    let mut systems = Systems::new(system, &asked.sources, question);
    let nominal = poses.iter().map(|posed| nominal(&systems, posed));
    let nominal: Vec<Result<Carried, Without>> = nominal.collect();
    let slopes = slopes(&mut systems, poses, &nominal);
    for ((posed, nominal), slopes) in poses.iter().zip(&nominal).zip(&slopes) {
        for (force, &(output, _)) in posed.forces.iter().enumerate() {
            let value = nominal
                .as_ref()
                .map_or(f64::NAN, |carried| carried.values[force]);
            let mut pose = PoseAccuracy::at(system, &posed.stand, value);
            match nominal {
                Err(without) => pose.missing = Some(lack(system, posed, *without)),
                Ok(nominal) => {
                    let slopes = &slopes[force];
                    let largest = nominal.largest;
                    if first_order(asked, slopes, largest, &mut pose) {
                        let limits = question.outputs[output].1.limits;
                        let spread = limits.zip(pose.moments);
                        pose.capability = spread
                            .and_then(|(limits, [mean, sigma])| capability(limits, mean, sigma));
                        if asked.levels > Levels::First {
                            let mut corner = Corner {
                                systems: &mut systems,
                                posed,
                                force,
                                nominal,
                                slopes,
                            };
                            let found = [-1.0, 1.0].map(|side| corner.farthest(side));
                            pose.take(system, found);
                        }
                    }
                }
            }
            found[output].1.poses.push(pose);
        }
    }
    found
}

/// What is carried at a pose with nothing off.
fn nominal(systems: &Systems, posed: &Posed) -> Result<Carried, Without> {
    if posed.stand.self_stress.is_some() {
        return Err(Without::Position);
    }
    let nothing = vec![[0.0; 2]; systems.sources.len()];
    let loaded = Loaded::new(systems, &systems.nominal, posed);
    let mut loaded = loaded.ok_or(Without::Position)?;
    loaded.carry(posed, &posed.stand.q, &nothing, &nothing)
}

/// Sets first order and spread of a force at a pose; whether there are any.
fn first_order(
    asked: &super::Question,
    slopes: &[[Slope; 2]],
    largest: f64,
    pose: &mut PoseAccuracy,
) -> bool {
    let (mut size, mut error) = (0.0, 0.0);
    let mut contributions = Vec::with_capacity(slopes.len());
    let sources = asked.sources.iter().zip(slopes).zip(&asked.forces.scales);
    for ((source, slope), scale) in sources {
        let g = slope.map(|slope| slope.by);
        let most = source.room.most();
        let width = if most > 0.0 { most } else { 1e-3 * scale };
        size += length(g) * width;
        error += (slope[0].error + slope[1].error) * width;
        let [mean, variance] = moments(source, g, asked.pins);
        let by = Contribution {
            sensitivity: if g[1] == 0.0 { g[0] } else { length(g) },
            reach: room(source).reach(g),
            variance,
        };
        contributions.push((by, mean));
    }
    let force = pose.nominal.abs().max(1e-3 * largest);
    // Not a number where a derivative was not found.
    let is_known = error <= UNSURE * (size + 1e-3 * force);
    if is_known {
        pose.contribute(contributions);
    } else {
        pose.missing = Some("does not exist: the force has no derivative here (friction that changes its direction, a kink of a law, or a singular position close by)".into());
    }
    is_known
}

/// Why there is no force at a pose.
fn lack(system: &System, posed: &Posed, without: Without) -> String {
    match without {
        Without::Locked(force) => linkdyn_engine::analysis::words::locked(system, force),
        Without::Position => {
            let stress = posed.stand.self_stress.as_deref().unwrap_or_default();
            let what = singular_text(system, &stressed_rows(system, stress));
            let what = what.map_or_else(String::new, |what| format!(" ({what})"));
            format!(
                "does not exist: in a singular position{what} whatever is off changes efforts and joint forces without bound"
            )
        }
    }
}

/// Mean and variance of the force by a source: a clearance is anywhere from least to greatest, its side that of the load.
fn moments(source: &Source, g: Pair, pins: Pins) -> [f64; 2] {
    match source.clearance() {
        Some(_) if pins == Pins::None => [0.0, 0.0],
        Some([least, most]) => {
            let variance = Scatter::Uniform.variance(0.5 * (most - least));
            [0.5 * (least + most) * g[0], variance * g[0] * g[0]]
        }
        None => source.moments(g, pins),
    }
}
