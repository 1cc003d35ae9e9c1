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
//! certified        a bound that nothing exceeds, where an interval Newton step contracts          `enclosure`
//! spread           standard deviation, capability                                                 `statistics`
//! least cost       tolerances that keep limits                                                    `allocate`
//! ```

mod allocate;
mod dimensions;
mod displaced;
mod enclosure;
mod grip;
mod output;
mod poses;
mod reach;
mod rooms;
mod source;
mod statistics;
mod words;
mod worst;

pub use allocate::{Room, Sum, Unallocated, allocate};
pub use rooms::Limited;
pub use statistics::{Capability, Pins, Scatter};
pub use words::{Deviating, Parameters, Refusal, accuracy};

use super::clearance_link::forces;
use super::control::Control;
use super::instants::OutputInstant;
use super::sample::Sample;
use crate::element::{BodyColumns, Measure, Pose};
use crate::system::{BodyData, System};
use dimensions::Dimensions;
use displaced::{Corners, Mechanism, Stand};
use output::{Load, Output};
use poses::{Halt, Way};
use source::Play;
use statistics::{capability, moments};
use worst::Farthest;

/// What is asked of a system.
struct Question<'q> {
    pub outputs: Vec<Wanted>,
    pub sources: Vec<Named>,
    pub dimensions: Dimensions,
    pub pins: Pins,
    pub instants: Vec<OutputInstant>,
    /// Bounds of what the steps of parameters leave out (dimensions); none where they are not known.
    pub slack: Option<Vec<f64>>,
    /// Steps of the dimensions for deviations of the parameters.
    pub corners: &'q Corners<'q>,
}

/// An output that is wanted.
struct Wanted {
    pub name: String,
    pub of: String,
    pub output: Output,
    /// Driver and its value [rad or m] at the pose; none: all instants.
    pub at: Option<(usize, f64)>,
    /// Allowed deviations [rad or m].
    pub limits: Option<[f64; 2]>,
}

/// A source and what the file calls it.
struct Named {
    pub name: String,
    pub play: Play,
}

/// What tolerances and clearances do to the outputs.
#[derive(Debug, Clone)]
pub struct Accuracy {
    /// What deviates: joints, points, drivers, parameters.
    pub sources: Vec<String>,
    /// By output.
    pub outputs: Vec<OutputAccuracy>,
}

/// One output at its poses.
#[derive(Debug, Clone)]
pub struct OutputAccuracy {
    /// As the file names it.
    pub name: String,
    /// What it is: a column, or a distance.
    pub of: String,
    /// `rad` or `m`.
    pub unit: &'static str,
    /// Allowed deviations [rad or m].
    pub limits: Option<[f64; 2]>,
    /// One, or one per instant.
    pub poses: Vec<PoseAccuracy>,
}

/// Deviations of an output at a pose [rad or m], to the lower and the upper side.
#[derive(Debug, Clone)]
pub struct PoseAccuracy {
    /// \[s\]
    pub time: f64,
    /// Values of the drivers [rad or m].
    pub drivers: Vec<f64>,
    /// `rad` or `m` of each.
    pub driver_units: Vec<&'static str>,
    /// The output [rad or m].
    pub nominal: f64,
    /// To first order; none where it does not exist.
    pub first: Option<[f64; 2]>,
    /// Worst found; none where none was.
    pub found: [Option<f64>; 2],
    /// Frames of the moving bodies, x, y \[m\] and angle \[rad\], in the order of the file.
    pub position: Vec<[f64; 3]>,
    /// The same where the output is carried farthest, to the lower and the upper side.
    pub displaced: [Option<Vec<[f64; 3]>>; 2],
    /// A bound that nothing exceeds; none where none can be certified.
    pub certified: Option<[f64; 2]>,
    /// Mean and standard deviation.
    pub moments: Option<[f64; 2]>,
    /// Shares within the limits.
    pub capability: Option<Capability>,
    /// Deviation with every pin where the loads press it; twice its size is lost as they reverse.
    pub pressed: Option<f64>,
    /// By source; empty where no first order exists.
    pub contributions: Vec<Contribution>,
}

/// Frames of the moving bodies, x, y \[m\] and angle \[rad\].
fn frames(system: &System, q: &[f64]) -> Vec<[f64; 3]> {
    let bodies = system.bodies.iter().zip(system.layout.bodies());
    let frame = |(body, columns): (&BodyData, BodyColumns)| {
        let [x, y, theta] = columns.read(q);
        let pose = Pose::new(x, y, theta);
        let origin = pose.r + pose.turn(body.origin);
        [origin.x, origin.y, theta]
    };
    bodies.map(frame).collect()
}

impl PoseAccuracy {
    fn take(&mut self, system: &System, found: [Option<Farthest>; 2]) {
        for (side, found) in found.into_iter().enumerate() {
            if let Some(Farthest { deviation, q }) = found {
                self.found[side] = Some(deviation);
                self.displaced[side] = Some(frames(system, &q));
            }
        }
    }

    /// Shares of the contributions in the worst case and in the variance; each sums to 1, or to 0 where nothing contributes.
    pub fn shares(&self) -> Vec<[f64; 2]> {
        let of = |by: &Contribution| [by.reach[1] - by.reach[0], by.variance];
        let mut total = [0.0; 2];
        for by in &self.contributions {
            let [worst, variance] = of(by);
            total = [total[0] + worst, total[1] + variance];
        }
        let part = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let shares = self.contributions.iter().map(|by| {
            let [worst, variance] = of(by);
            [part(worst, total[0]), part(variance, total[1])]
        });
        shares.collect()
    }
}

/// What one source does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contribution {
    /// ∂y/∂(deviation), of a pin its size.
    pub sensitivity: f64,
    /// How far it carries the output down and up.
    pub reach: [f64; 2],
    /// Variance of the output by it.
    pub variance: f64,
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
        &question.dimensions,
        &plays,
        question.corners,
    );
    let (mut stands, mut unreached) = (Vec::new(), Vec::new());
    for (index, wanted) in question.outputs.iter().enumerate() {
        match wanted.at {
            None => stands.push(None),
            Some((driver, value)) => match way.stand_at(driver, value) {
                Ok(stand) => stands.push(Some(stand)),
                Err(outside) => unreached.push((index, outside)),
            },
        }
    }
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
    fn pose(&mut self, wanted: &Wanted, stand: &Stand) -> PoseAccuracy {
        let output = &wanted.output;
        let mechanism = &mut self.mechanism;
        mechanism.shifts.fill(linkdyn_linear::math::Vec2::zeros());
        mechanism.take(&stand.q, stand);
        let mut pose = PoseAccuracy {
            time: stand.inputs.time,
            drivers: stand.inputs.drive.iter().map(|jet| jet[0]).collect(),
            driver_units: self
                .system
                .drivers
                .iter()
                .map(|driver| match driver.measure {
                    Measure::Angle => "rad",
                    Measure::Length => "m",
                })
                .collect(),
            nominal: mechanism.value(stand, output, 0.0),
            first: None,
            found: [None; 2],
            position: frames(self.system, &stand.q),
            displaced: [None, None],
            certified: None,
            moments: None,
            capability: None,
            pressed: None,
            contributions: Vec::new(),
        };
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
        wanted: &Wanted,
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
        forces(driven, &stand.inputs, &mut self.sample).ok()?;
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
