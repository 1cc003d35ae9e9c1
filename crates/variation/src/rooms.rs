//! What limits leave for tolerances that are still to be chosen.
//!
//! ```text
//! worst case   Σ |g_k| t_k ≤ min(U − m, m − L) − Σ half reach of all that is fixed             m middle of all reaches
//! statistic    3² Σ σ_k² ≤ min(U − μ, μ − L)²,  C_pk ≥ 1;  σ_k = |g_k| t_k σ(1) of a tolerance, as `statistics` has it of the rest
//! ```

use super::allocate::{Room, Sum};
use super::source::Scatter;
use super::{Accuracy, Contribution, OutputAccuracy, PoseAccuracy};

/// Standard deviations from the mean to the nearer limit: 99.73 % of a normal deviation are within both. Of sources with limits of
/// their own, at so many, it is more.
const DEVIATIONS: f64 = 3.0;

/// A source whose half width is to be chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Free {
    /// Its number among the sources.
    pub source: usize,
    /// How it scatters.
    pub scatter: Scatter,
}

/// A limit at a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Limited {
    /// Number of the output.
    pub output: usize,
    /// Number of its pose.
    pub pose: usize,
    /// What the tolerances may use of the limit, and what a unit of each does there.
    pub room: Room,
}

impl Accuracy {
    /// The limits of all outputs at all poses, for sources (`free`, by number) whose half widths are to be chosen; what the
    /// others do is taken off, and so is a mean that is off nominal. `part` of a limit may be used.
    pub fn rooms(&self, free: &[Free], sum: Sum, part: &dyn Fn(usize) -> f64) -> Vec<Limited> {
        let mut all = Vec::new();
        for (number, output) in self.outputs.iter().enumerate() {
            let Some(limits) = output.limits else {
                continue;
            };
            let limits = limits.map(|limit| limit * part(number));
            for (pose, at) in output
                .poses
                .iter()
                .enumerate()
                .filter(|(_, pose)| pose.first.is_some())
            {
                all.push(Limited {
                    output: number,
                    pose,
                    room: room(at, limits, free, sum),
                });
            }
        }
        all
    }
}

fn room(pose: &PoseAccuracy, limits: [f64; 2], free: &[Free], sum: Sum) -> Room {
    let all = pose.contributions.iter().enumerate();
    let fixed = all.filter(|(source, _)| free.iter().all(|own| own.source != *source));
    let fixed = fixed.map(|(_, by)| by);
    let (room, share): (f64, fn(Scatter) -> f64) = match sum {
        Sum::Worst => {
            let middle = |by: &Contribution| 0.5 * (by.reach[0] + by.reach[1]);
            let half = |by: &Contribution| 0.5 * (by.reach[1] - by.reach[0]);
            let middle = pose.contributions.iter().map(middle).sum();
            let fixed: f64 = fixed.map(half).sum();
            (beside(limits, middle) - fixed, |_| 1.0)
        }
        Sum::Squares => {
            let mean = pose.moments.map_or(0.0, |[mean, _]| mean);
            let room = beside(limits, mean);
            let fixed: f64 = fixed.map(|by| DEVIATIONS.powi(2) * by.variance).sum();
            let left = (room * room - fixed).max(0.0).sqrt();
            (left.min(room), |scatter| {
                DEVIATIONS * scatter.variance(1.0).sqrt()
            })
        }
    };
    let weight = |own: &Free| pose.contributions[own.source].sensitivity.abs() * share(own.scatter);
    Room {
        room,
        weights: free.iter().map(weight).collect(),
    }
}

/// What limits leave to either side of a middle.
fn beside([low, high]: [f64; 2], middle: f64) -> f64 {
    (high - middle).min(middle - low)
}

impl OutputAccuracy {
    /// The greatest part of its limits that a worst case uses, over all poses: certified where it is, else as found; infinite
    /// where neither is known.
    pub fn used(&self) -> Option<f64> {
        let [low, high] = self.limits?;
        let part = |[down, up]: [f64; 2]| (up / high).max(down / low).max(0.0);
        let of = |pose: &PoseAccuracy| match (pose.certified, pose.found) {
            (Some(certified), _) => part(certified),
            (None, [Some(down), Some(up)]) => part([down, up]),
            (None, _) => f64::INFINITY,
        };
        Some(self.poses.iter().map(of).fold(0.0, f64::max))
    }
}
