//! What limits leave for tolerances that are still to be chosen.

use super::allocate::{Room, Sum};
use super::{Accuracy, OutputAccuracy, PoseAccuracy};

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
    /// others do is taken off, and so is a middle that is off nominal. `part` of a limit may be used.
    pub fn rooms(&self, free: &[usize], sum: Sum, part: &dyn Fn(usize) -> f64) -> Vec<Limited> {
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

fn room(pose: &PoseAccuracy, [low, high]: [f64; 2], free: &[usize], sum: Sum) -> Room {
    let (mut up, mut down, mut squares) = (high, -low, 0.0);
    for (source, by) in pose.contributions.iter().enumerate() {
        let middle = 0.5 * (by.reach[0] + by.reach[1]);
        let half = 0.5 * (by.reach[1] - by.reach[0]);
        up -= middle;
        down += middle;
        if !free.contains(&source) {
            squares += half * half;
            if sum == Sum::Worst {
                up -= half;
                down -= half;
            }
        }
    }
    let room = up.min(down);
    Room {
        room: match sum {
            Sum::Worst => room,
            // √(Σ (s t)² + F²) ≤ T
            Sum::Squares if room > 0.0 => (room * room - squares).max(0.0).sqrt(),
            Sum::Squares => room,
        },
        weights: free
            .iter()
            .map(|&source| pose.contributions[source].sensitivity.abs())
            .collect(),
    }
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
