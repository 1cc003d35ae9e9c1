//! Forces under tolerance and clearance: efforts of drivers, and what joints carry.
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
mod slopes;

pub(super) use loaded::{Force, Owner};

use super::answer::{Contribution, OutputAccuracy, PoseAccuracy};
use super::displaced::Stand;
use super::poses::Poses;
use super::source::{Influence, Play};
use super::statistics::{Pins, Spread, capability};
use super::{Levels, Wanted};
use crate::analysis::in_line::{singular_text, stressed_rows};
use crate::analysis::instants::OutputInstant;
use crate::system::System;
use corner::Corner;
use loaded::{Carried, Loaded, Systems, Without};
use slopes::{Slope, slopes};

/// Makes the system with parameters (in the order of their sources) and zones (in theirs) off; none where that is no legal
/// model.
pub(super) type Making<'c> = dyn Fn(&[f64], &[[f64; 2]]) -> Option<System> + Sync + 'c;

/// Errors of derivatives above this part of what all sources do leave no first order.
const UNSURE: f64 = 1e-6;
/// So do errors above this part of the force itself.
const UNSURE_OF_FORCE: f64 = 1e-9;

/// What is asked of forces.
pub(super) struct Question<'q> {
    /// Forces with their places among all outputs.
    pub outputs: Vec<(usize, Wanted<Force>)>,
    /// Nothing moves.
    pub at_rest: bool,
    /// What the number of each source is measured by [SI].
    pub scales: Vec<f64>,
    pub making: &'q Making<'q>,
}

/// A pose, and the forces that are asked about there.
pub(super) struct Posed {
    pub stand: Stand,
    /// Driver and value that say which pose it is, whatever its motion.
    pub exact: Option<(usize, f64)>,
    pub forces: Vec<Force>,
    /// Numbers of the outputs.
    pub outputs: Vec<usize>,
}

/// The poses that are asked about: those of forces at a value of a driver (`held`), and all instants.
pub(super) fn poses(
    question: &Question,
    held: Vec<Option<Stand>>,
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
                forces: vec![wanted.output],
                outputs: vec![output],
            }),
        }
    }
    let stroke = instants.iter().filter(|_| !over.is_empty());
    poses.extend(stroke.filter_map(|instant| {
        Some(Posed {
            stand: way.stand(instant, None)?,
            exact: instant.exact,
            forces: over.iter().map(|(_, force)| *force).collect(),
            outputs: over.iter().map(|(output, _)| *output).collect(),
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
    let (question, pins) = (&asked.forces, asked.pins);
    if question.outputs.is_empty() {
        return Vec::new();
    }
    let named = asked.sources.iter();
    let plays: Vec<Play> = named.map(|named| named.play.clone()).collect();
    let mut systems = Systems::new(system, &plays, question.making);
    let at_rest = question.at_rest;
    let nominal: Vec<Result<Carried, Without>> = poses
        .iter()
        .map(|posed| nominal(system, &plays, posed, at_rest))
        .collect();
    let known: Vec<Option<Carried>> = nominal.iter().map(|n| n.clone().ok()).collect();
    let slopes = slopes(&mut systems, poses, &known, &question.scales, at_rest);
    let mut found: Vec<(usize, OutputAccuracy)> = question
        .outputs
        .iter()
        .map(|(place, wanted)| {
            let empty = OutputAccuracy {
                name: wanted.name.clone(),
                of: wanted.of.clone(),
                unit: wanted.output.unit,
                limits: wanted.limits,
                poses: Vec::new(),
            };
            (*place, empty)
        })
        .collect();
    for (index, posed) in poses.iter().enumerate() {
        for (force, &output) in posed.outputs.iter().enumerate() {
            let value = known[index]
                .as_ref()
                .map_or(f64::NAN, |carried| carried.values[force]);
            let mut pose = PoseAccuracy::at(system, &posed.stand, value);
            match &nominal[index] {
                Err(without) => pose.missing = Some(lack(system, posed, *without)),
                Ok(nominal) => {
                    let mut corner = Corner {
                        systems: &mut systems,
                        posed,
                        force,
                        nominal,
                        slopes: &slopes[index][force],
                        at_rest,
                    };
                    let limits = question.outputs[output].1.limits;
                    let scales = &question.scales;
                    levels(&corner, &plays, (pins, limits, scales), &mut pose);
                    if asked.levels > Levels::First && pose.first.is_some() {
                        let found = [-1.0, 1.0].map(|side| corner.farthest(side));
                        pose.take(system, found);
                    }
                }
            }
            found[output].1.poses.push(pose);
        }
    }
    found
}

/// What is carried at a pose with nothing off.
fn nominal(
    system: &System,
    plays: &[Play],
    posed: &Posed,
    at_rest: bool,
) -> Result<Carried, Without> {
    if posed.stand.self_stress.is_some() {
        return Err(Without::Position);
    }
    let nothing = vec![[0.0; 2]; plays.len()];
    let loaded = Loaded::new([system, system], plays, posed, at_rest);
    loaded
        .ok_or(Without::Position)?
        .carry(posed, None, &nothing, &nothing)
}

/// First order and spread of a force at a pose.
fn levels(
    corner: &Corner,
    plays: &[Play],
    (pins, limits, scales): (Pins, Option<[f64; 2]>, &[f64]),
    pose: &mut PoseAccuracy,
) {
    let (mut first, mut mean, mut variance) = ([0.0; 2], 0.0, 0.0);
    let (mut size, mut error) = (0.0, 0.0);
    let mut contributions = Vec::with_capacity(plays.len());
    for ((play, slope), scale) in plays.iter().zip(corner.slopes).zip(scales) {
        let g = slope_of(play, slope);
        let reach = reach(play, g);
        let [middle, square] = spread(play, g, pins);
        let width = width(play, *scale);
        size += g[0].hypot(g[1]) * width;
        error += error_of(play, slope) * width;
        first = [first[0] + reach[0], first[1] + reach[1]];
        mean += middle;
        variance += square;
        contributions.push(Contribution {
            sensitivity: if g[1] == 0.0 { g[0] } else { g[0].hypot(g[1]) },
            reach,
            variance: square,
        });
    }
    let force = pose.nominal.abs().max(1e-3 * corner.nominal.largest);
    // Not a number where a derivative was not found.
    let is_known = error <= UNSURE * size + UNSURE_OF_FORCE * force;
    if !is_known {
        pose.missing = Some("does not exist: the force has no derivative here (friction that changes its direction, a kink of a law, or a singular position close by)".into());
        return;
    }
    pose.contributions = contributions;
    pose.first = Some(first);
    let sigma = variance.sqrt();
    pose.moments = Some([mean, sigma]);
    pose.capability = limits.and_then(|limits| capability(limits, mean, sigma));
}

/// Why there is no force at a pose.
fn lack(system: &System, posed: &Posed, without: Without) -> String {
    match without {
        Without::Locked(force) => crate::analysis::words::locked(system, force),
        Without::Position => {
            let stress = posed.stand.self_stress.as_deref().unwrap_or_default();
            let rows = stressed_rows(system, stress);
            let what =
                singular_text(system, &rows).map_or_else(String::new, |what| format!(" ({what})"));
            format!(
                "does not exist: in a singular position{what} whatever is off changes efforts and joint forces without bound"
            )
        }
    }
}

fn slope_of(play: &Play, slope: &[Slope; 2]) -> Influence {
    match play {
        Play::Zone { .. } => [slope[0].by, slope[1].by],
        Play::Pin { .. }
        | Play::Sides { .. }
        | Play::Guided { .. }
        | Play::Driver { .. }
        | Play::Parameter { .. } => [slope[0].by, 0.0],
    }
}

fn error_of(play: &Play, slope: &[Slope; 2]) -> f64 {
    match play {
        Play::Zone { .. } => slope[0].error + slope[1].error,
        Play::Pin { .. }
        | Play::Sides { .. }
        | Play::Guided { .. }
        | Play::Driver { .. }
        | Play::Parameter { .. } => slope[0].error,
    }
}

/// Least and greatest clearance, where the play is one.
fn clearance(play: &Play) -> Option<[f64; 2]> {
    match play {
        Play::Pin { clearance: c, .. }
        | Play::Sides { half: c, .. }
        | Play::Guided { half: c, .. } => Some(*c),
        Play::Driver { .. } | Play::Zone { .. } | Play::Parameter { .. } => None,
    }
}

/// How far a source may be off, or how far its number goes where it says nothing.
fn width(play: &Play, scale: f64) -> f64 {
    let off = match play {
        Play::Driver { half, .. } => *half,
        Play::Zone { radius, .. } => *radius,
        Play::Parameter { lower, upper, .. } => lower.abs().max(upper.abs()),
        Play::Pin { clearance: c, .. }
        | Play::Sides { half: c, .. }
        | Play::Guided { half: c, .. } => c[1],
    };
    if off > 0.0 { off } else { 1e-3 * scale }
}

/// How far a source carries the force down and up.
fn reach(play: &Play, g: Influence) -> [f64; 2] {
    match clearance(play) {
        Some([least, most]) => {
            let (a, b) = (least * g[0], most * g[0]);
            [a.min(b), a.max(b)]
        }
        None => play.reach(g),
    }
}

/// Where a source carries the force farthest to a side (±1).
fn extreme(play: &Play, g: Influence, side: f64) -> Influence {
    match clearance(play) {
        Some([least, most]) => [if side * g[0] >= 0.0 { most } else { least }, 0.0],
        None => play.extreme(g, side),
    }
}

/// Mean and variance of the force by a source: a clearance is anywhere from least to greatest, its side that of the load.
fn spread(play: &Play, g: Influence, pins: Pins) -> [f64; 2] {
    match clearance(play) {
        Some(_) if pins == Pins::None => [0.0, 0.0],
        Some([least, most]) => [
            0.5 * (least + most) * g[0],
            ((most - least) * g[0]).powi(2) / 12.0,
        ],
        None => Spread::new(play, pins).moments(g),
    }
}

/// What a force of 1 N makes of a force that is asked about [N or N·m].
fn sizes(system: &System, force: &Force) -> f64 {
    match force.unit {
        "N" => 1.0,
        _ => system.size,
    }
}
