//! The answer: by output and pose how far it deviates, and what each source does to it.

use super::ascent::Farthest;
use super::poses::NominalPose;
use super::statistics::Capability;
use super::wanted::{Levels, Wanted};
use linkdyn_engine::element::{BodyColumns, Measure, Pose};
use linkdyn_engine::system::{BodyData, DriverData, System};
use linkdyn_linear::math::Vec2;
use std::sync::Arc;

/// What tolerances and clearances do to the outputs.
#[derive(Debug, Clone)]
pub struct Accuracy {
    /// The request.
    pub levels: Levels,
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
    /// `rad` or `m`, of forces `N` or `N*m`.
    pub unit: &'static str,
    /// Allowed deviations, in this unit.
    pub limits: Option<[f64; 2]>,
    /// One, or one per instant.
    pub poses: Vec<PoseAccuracy>,
}

/// Deviations of an output at a pose, in its unit, to the lower and the upper side.
#[derive(Debug, Clone)]
pub struct PoseAccuracy {
    /// \[s\]
    pub time: f64,
    /// Values of the drivers [rad or m].
    pub drivers: Arc<[f64]>,
    /// `rad` or `m` of each.
    pub driver_units: Arc<[&'static str]>,
    /// The output; NaN of a force that does not exist there.
    pub nominal: f64,
    /// To first order; `None` if it does not exist.
    pub first: Option<[f64; 2]>,
    /// Worst found; `None` if none was found or requested.
    pub found: [Option<f64>; 2],
    /// What all sources could still gain there, to first order: nothing where the output is stationary.
    pub lacks: [Option<f64>; 2],
    /// Frames of the moving bodies, x, y \[m\] and angle \[rad\], in the order of the file.
    pub position: Arc<[[f64; 3]]>,
    /// The same where the output is carried farthest, to the lower and the upper side.
    pub displaced: [Option<Vec<[f64; 3]>>; 2],
    /// Deviations to the lower and the upper side, the least first, each with the share of all clearances and tolerances that
    /// it needs; empty where a bound is certified, nothing was found, or the deviation goes with the share.
    pub needed: [Vec<[f64; 2]>; 2],
    /// A bound that nothing exceeds; `None` if none can be certified, or none was requested.
    pub certified: Option<[f64; 2]>,
    /// Mean and standard deviation.
    pub moments: Option<[f64; 2]>,
    /// Shares within the limits.
    pub capability: Option<Capability>,
    /// Deviation with every pin where the loads press it; twice its size is lost as they reverse.
    pub pressed: Option<f64>,
    /// Why a force has no first order, or no value, here.
    pub missing: Option<String>,
    /// By source; empty where no first order exists.
    pub contributions: Vec<Contribution>,
}

/// Frames of the moving bodies at their coordinates (n), x, y \[m\] and angle \[rad\].
pub(super) fn frames(system: &System, q: &[f64]) -> Vec<[f64; 3]> {
    let bodies = system.bodies.iter().zip(system.layout.bodies());
    let frame = |(body, columns): (&BodyData, BodyColumns)| {
        let [x, y, theta] = columns.read(q);
        if body.origin == Vec2::zeros() {
            return [x, y, theta];
        }
        let pose = Pose::new(x, y, theta);
        let origin = pose.r + pose.turn(body.origin);
        [origin.x, origin.y, pose.theta]
    };
    bodies.map(frame).collect()
}

impl OutputAccuracy {
    /// Whether it is a force or a torque.
    pub fn is_force(&self) -> bool {
        self.unit.starts_with('N')
    }
}

impl PoseAccuracy {
    /// Of a pose, with nothing known yet but the nominal value.
    pub(super) fn at(system: &System, stand: &NominalPose, nominal: f64) -> Self {
        let unit = |driver: &DriverData| match driver.measure {
            Measure::Angle => "rad",
            Measure::Length => "m",
        };
        PoseAccuracy {
            time: stand.inputs.time,
            drivers: stand.inputs.drive.iter().map(|jet| jet[0]).collect(),
            driver_units: system.drivers.iter().map(unit).collect(),
            nominal,
            first: None,
            found: [None; 2],
            position: frames(system, &stand.q).into(),
            displaced: [None, None],
            lacks: [None; 2],
            needed: [Vec::new(), Vec::new()],
            certified: None,
            moments: None,
            capability: None,
            pressed: None,
            missing: None,
            contributions: Vec::new(),
        }
    }

    /// Takes what each source contributes, with its mean.
    pub(super) fn contribute(&mut self, by: Vec<(Contribution, f64)>) {
        let (mut first, mut mean, mut variance) = ([0.0; 2], 0.0, 0.0);
        for (by, middle) in &by {
            first = [first[0] + by.reach[0], first[1] + by.reach[1]];
            mean += middle;
            variance += by.variance;
        }
        self.first = Some(first);
        self.moments = Some([mean, variance.sqrt()]);
        self.contributions = by.into_iter().map(|(by, _)| by).collect();
    }

    /// Takes where the output is carried farthest.
    pub(super) fn take(&mut self, system: &System, found: [Option<Farthest>; 2]) {
        for (side, found) in found.into_iter().enumerate() {
            if let Some(found) = found {
                self.found[side] = Some(found.deviation);
                self.displaced[side] = Some(frames(system, &found.q));
                self.needed[side] = found.needed;
                self.lacks[side] = Some(found.lacks).filter(|lacks| lacks.is_finite());
            }
        }
    }

    /// Shares of the contributions in the worst case and in the variance; each sums to 1, or to 0 where nothing contributes.
    pub fn shares(&self) -> Vec<[f64; 2]> {
        // What is pressed to one side goes there from the nominal value.
        let span = |reach: [f64; 2]| reach[1].max(0.0) - reach[0].min(0.0);
        let of = |by: &Contribution| [span(by.reach), by.variance];
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

impl OutputAccuracy {
    /// A wanted output without poses.
    pub(super) fn blank<Of>(wanted: &Wanted<Of>) -> Self {
        OutputAccuracy {
            name: wanted.name.clone(),
            of: wanted.of.clone(),
            unit: wanted.unit,
            limits: wanted.limits,
            poses: Vec::new(),
        }
    }
}
