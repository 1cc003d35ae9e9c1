//! How far dimensions and points can be off, the same at every pose.

use super::super::dimensions::{Dimension, Dimensions, PointId};
use super::super::source::Play;

/// What all deviations of parameters and points can do at most.
pub(super) struct Extents {
    /// Dimensions that can be off, and how far with what their steps leave out.
    pub most: Vec<(usize, f64)>,
    /// Dimensions whose steps leave something out, and how much.
    pub slack: Vec<(usize, f64)>,
    /// How far each point can be off by steps and zones \[m\].
    pub off: Vec<f64>,
    /// What the steps of each point leave out \[m\].
    pub beyond: Vec<f64>,
}

impl Extents {
    /// Of sources whose steps leave out `slack` (dimensions).
    pub fn new(plays: &[Play], dimensions: &Dimensions, slack: &[f64]) -> Self {
        let mut steps = vec![0.0; dimensions.all.len()];
        let mut off = vec![0.0; dimensions.points.len()];
        for play in plays {
            match play {
                Play::Parameter {
                    lower,
                    upper,
                    steps: by,
                    ..
                } => {
                    for &(k, by) in by {
                        steps[k] += by.abs() * lower.abs().max(upper.abs());
                    }
                }
                Play::Zone { point, radius } => off[point.0] += radius,
                Play::Pin { .. }
                | Play::Sides { .. }
                | Play::Guided { .. }
                | Play::Driver { .. } => {}
            }
        }
        let mut beyond = vec![0.0; dimensions.points.len()];
        for (k, dimension) in dimensions.all.iter().enumerate() {
            if let Dimension::Point(PointId(point), _) = dimension {
                off[*point] += steps[k];
                beyond[*point] += slack[k];
            }
        }
        let some = |(_, step): &(usize, f64)| *step > 0.0;
        let most = steps.iter().zip(slack).map(|(step, slack)| step + slack);
        Extents {
            most: most.enumerate().filter(some).collect(),
            slack: slack.iter().copied().enumerate().filter(some).collect(),
            off,
            beyond,
        }
    }
}
