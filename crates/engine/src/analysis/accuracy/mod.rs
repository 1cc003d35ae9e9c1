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
//! worst found      stationary under all sources, at the displaced position                        `worst`, near change points `reach`
//! needed           the share of all sources that a deviation needs                                `needed`
//! certified        a bound that nothing exceeds, where an interval Newton step contracts          `enclosure`
//! forces           efforts and joint forces, from statics or inverse dynamics                     `forces`
//! spread           standard deviation, capability                                                 `statistics`
//! least cost       tolerances that keep limits                                                    `allocate`
//! ```

mod allocate;
mod answer;
mod dimensions;
mod displaced;
mod enclosure;
mod forces;
mod grip;
mod needed;
mod output;
mod poses;
mod reach;
mod rooms;
mod source;
mod statistics;
mod words;
mod worst;

pub use allocate::{Room, Sum, Unallocated, allocate};
pub use answer::{Accuracy, Contribution, OutputAccuracy, PoseAccuracy};
pub use rooms::Limited;
pub use statistics::{Capability, Pins, Scatter};
pub use words::{Deviating, Parameters, Refusal, accuracy};

use super::clearance_link;
use super::control::Control;
use super::instants::OutputInstant;
use super::sample::Sample;
use crate::system::System;
use dimensions::Dimensions;
use displaced::{Corners, Mechanism, Stand};
use output::{Load, Output};
use poses::{Halt, Unmet, Way};
use source::Play;
use statistics::{capability, moments};

/// What is asked of a system.
struct Question<'q> {
    pub outputs: Vec<Wanted<Output>>,
    pub forces: forces::Question<'q>,
    pub sources: Vec<Named>,
    pub dimensions: &'q Dimensions,
    pub pins: Pins,
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
fn run(system: &System, question: &Question, control: &Control) -> Result<Accuracy, Halt> {
    let mut way = Way::new(system, &question.instants, control)?;
    let named = question.sources.iter();
    let plays: Vec<Play> = named.map(|named| named.play.clone()).collect();
    let mechanism = Mechanism::new(
        way.another()?,
        question.dimensions,
        &plays,
        question.corners,
    );
    let mut unreached = Vec::new();
    let mut stand_of = |name: &str, at: Option<(usize, f64)>| {
        let (driver, value) = at?;
        let stand = way.stand_at(driver, value);
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
    let mut asked = Asked {
        system,
        question,
        sample: Sample::new(system),
        mechanism,
    };
    let mut outputs = Vec::with_capacity(question.outputs.len());
    for (wanted, stand) in question.outputs.iter().zip(stands) {
        let poses = match stand {
            Some(stand) => vec![asked.pose(wanted, &stand)],
            None => {
                let stands = question.instants.iter();
                let stands = stands.filter_map(|instant| way.stand(instant, None));
                stands.map(|stand| asked.pose(wanted, &stand)).collect()
            }
        };
        outputs.push(OutputAccuracy {
            name: wanted.name.clone(),
            of: wanted.of.clone(),
            unit: if wanted.output.is_angle() { "rad" } else { "m" },
            limits: wanted.limits,
            poses,
        });
    }
    let poses = forces::poses(&question.forces, held, &question.instants, &mut way);
    for (place, answer) in forces::answer(system, question, &poses) {
        outputs.insert(place, answer);
    }
    let named = question.sources.iter();
    Ok(Accuracy {
        sources: named.map(|named| named.name.clone()).collect(),
        outputs,
    })
}

/// A question on its way through the poses.
struct Asked<'a> {
    system: &'a System,
    question: &'a Question<'a>,
    mechanism: Mechanism<'a>,
    sample: Sample,
}

impl Asked<'_> {
    /// All levels at one pose.
    fn pose(&mut self, wanted: &Wanted<Output>, stand: &Stand) -> PoseAccuracy {
        let output = &wanted.output;
        let mechanism = &mut self.mechanism;
        mechanism.shifts.fill(linkdyn_linear::math::Vec2::zeros());
        mechanism.take(&stand.q, stand);
        let nominal = mechanism.value(stand, output, 0.0);
        let mut pose = PoseAccuracy::at(self.system, stand, nominal);
        let load = if stand.self_stress.is_none() {
            mechanism.load(stand, output)
        } else {
            None
        };
        let Some(load) = load else {
            // The self-stress is the load that the equations balance without any on the output.
            let found = [-1.0, 1.0].map(|side| {
                let lambda = stand
                    .self_stress
                    .clone()
                    .filter(|stress| !stress.is_empty())?;
                mechanism.reach(stand, output, Load { lambda, size: 0.0 }, side)
            });
            pose.take(self.system, found);
            return pose;
        };
        self.first_order(wanted, stand, &load, &mut pose);
        let mechanism = &mut self.mechanism;
        if let Some(slack) = &self.question.slack {
            mechanism.take(&stand.q, stand);
            let inverse = mechanism.inverse();
            pose.certified = mechanism.enclosure(stand, output, &load, &inverse, slack);
        }
        let is_certain = pose.certified.is_some();
        let found = [-1.0, 1.0].map(|side| {
            // Where nothing is certified, only what is reached step by step belongs to this position.
            let near = is_certain.then(|| mechanism.farthest(stand, output, &load, side));
            near.flatten()
                .or_else(|| mechanism.reach(stand, output, load.times(side), side))
        });
        pose.take(self.system, found);
        pose
    }

    /// Influences, shares and spread.
    fn first_order(
        &mut self,
        wanted: &Wanted<Output>,
        stand: &Stand,
        load: &Load,
        pose: &mut PoseAccuracy,
    ) {
        let pins = self.question.pins;
        let influences = self.mechanism.influences(stand, &wanted.output, load);
        let (mut first, mut mean, mut variance) = ([0.0; 2], 0.0, 0.0);
        for (named, g) in self.question.sources.iter().zip(&influences) {
            let reach = named.play.reach(*g);
            let [middle, square] = moments(&named.play, *g, pins);
            first = [first[0] + reach[0], first[1] + reach[1]];
            mean += middle;
            variance += square;
            let sensitivity = match named.play {
                Play::Pin { .. } | Play::Zone { .. } => g[0].hypot(g[1]),
                Play::Sides { .. }
                | Play::Guided { .. }
                | Play::Driver { .. }
                | Play::Parameter { .. } => g[0],
            };
            pose.contributions.push(Contribution {
                sensitivity,
                reach,
                variance: square,
            });
        }
        pose.first = Some(first);
        pose.pressed = self.pressed(stand, &influences);
        if let (Pins::Load, Some(pressed)) = (pins, pose.pressed) {
            mean += pressed;
        }
        let sigma = variance.sqrt();
        pose.moments = Some([mean, sigma]);
        pose.capability = wanted
            .limits
            .and_then(|limits| capability(limits, mean, sigma));
    }

    /// Deviation with the journals where the loads of the motion press them; none without masses or friction's history.
    fn pressed(&mut self, stand: &Stand, influences: &[source::Influence]) -> Option<f64> {
        if !self.system.masses_known {
            return None;
        }
        self.sample.q.copy_from_slice(&stand.q);
        let driven = &mut self.mechanism.driven;
        driven.evaluation.set_position(&stand.q);
        clearance_link::forces(driven, &stand.inputs, &mut self.sample).ok()?;
        let mut deviation = 0.0;
        for (named, g) in self.question.sources.iter().zip(influences) {
            if let Play::Pin { row, clearance } = named.play {
                let (fx, fy) = (self.sample.lambda[row], self.sample.lambda[row + 1]);
                let size = fx.hypot(fy);
                if size > 0.0 {
                    // The journal presses the bearing against the force that it feels.
                    deviation -= clearance[1] * (g[0] * fx + g[1] * fy) / size;
                }
            }
        }
        deviation.is_finite().then_some(deviation)
    }
}

impl Load {
    /// The load times a number.
    fn times(&self, factor: f64) -> Load {
        Load {
            lambda: self.lambda.iter().map(|l| l * factor).collect(),
            size: self.size * factor,
        }
    }
}
