//! The order of designs: fronts of those that no other one beats in everything (Pareto), and within them the angle of transmission.

use super::judged::FoundLinkage;
use super::problem::{Goal, LinkageTask};
use linkdyn_linear::bilinear::Number;
use linkdyn_synthesis::linkage::Joint;
use std::cmp::Ordering;

/// Pins that are nearer to each other than this part of the extent are the same, or much alike.
const SAME: f64 = 1e-6;
const ALIKE: f64 = 0.1;
/// Errors larger than this times the least are too large.
pub const WORSE: f64 = 5.0;
/// Errors below this part of the extent are none.
const NO_ERROR: f64 = 1e-9;

/// What counts, the less the better.
fn costs(design: &FoundLinkage, problem: &LinkageTask) -> Vec<f64> {
    let off = design.off.unwrap_or(0.0) / problem.size + design.off_angle.unwrap_or(0.0);
    let spread = match problem.goal {
        Goal::Function => design.spread[1] * problem.size,
        Goal::Path | Goal::Motion => design.spread[0],
    };
    let mut costs = vec![
        if off < NO_ERROR { 0.0 } else { off },
        design.transmission.map_or(0.0, |angle| -angle),
        design.size,
        spread,
    ];
    costs.extend(design.effort);
    costs
}

/// The best designs, each once, and how many good ones are not among them.
#[derive(Debug, Clone, Default)]
pub struct Ranked {
    /// The best one first.
    pub designs: Vec<FoundLinkage>,
    /// More than [`WORSE`] times as far off as the nearest.
    pub further_off: usize,
    /// More than were asked for.
    pub more: usize,
}

/// The best designs.
pub fn ranked(designs: Vec<FoundLinkage>, problem: &LinkageTask, most: usize) -> Ranked {
    let mut own: Vec<(Vec<f64>, FoundLinkage)> = Vec::new();
    for design in designs {
        if !own
            .iter()
            .any(|(_, other)| same(other, &design, SAME * problem.size))
        {
            own.push((costs(&design, problem), design));
        }
    }
    // Beside what comes near, what does not is no answer.
    let nearest = own
        .iter()
        .map(|(costs, _)| costs[0])
        .fold(f64::INFINITY, f64::min);
    let all = own.len();
    own.retain(|(costs, _)| costs[0] <= WORSE * nearest);
    let further_off = all - own.len();
    let beats = |a: &[f64], b: &[f64]| {
        let mut both = a.iter().zip(b);
        both.clone().all(|(a, b)| a <= b) && both.any(|(a, b)| a < b)
    };
    let mut front = 0;
    while own.iter().any(|(_, design)| design.front == 0) {
        front += 1;
        let open: Vec<usize> = (0..own.len()).filter(|k| own[*k].1.front == 0).collect();
        let best = |k: &&usize| !open.iter().any(|other| beats(&own[*other].0, &own[**k].0));
        let best: Vec<usize> = open.iter().filter(best).copied().collect();
        if best.is_empty() {
            // Costs that are no numbers beat nothing and are beaten by nothing; they don't come here.
            break;
        }
        for k in best {
            own[k].1.front = front;
        }
    }
    own.sort_by(|(a, one), (b, other)| {
        let fronts = one.front.cmp(&other.front);
        // Errors are within a small factor of each other; what a small angle of transmission breaks, no accuracy mends. Where there is a
        // least angle, all of them are large enough.
        let [first, second] = match problem.asked.transmission {
            None => [1, 0],
            Some(_) => [0, 1],
        };
        let by = |k: usize| a[k].total_cmp(&b[k]);
        [fronts, by(first), by(second), by(2)]
            .into_iter()
            .find(|order| *order != Ordering::Equal)
            .unwrap_or(Ordering::Equal)
    });
    let more = own.len().saturating_sub(most);
    let mut kept: Vec<FoundLinkage> = Vec::new();
    let mut alike = Vec::new();
    for (_, design) in own {
        // Of neighbours on a curve of linkages the best one stands for all, as long as there are others.
        let near = ALIKE * problem.size;
        match kept.iter().any(|other| same(other, &design, near)) {
            true => alike.push(design),
            false => kept.push(design),
        }
    }
    kept.truncate(most);
    let left = most - kept.len();
    kept.extend(alike.into_iter().take(left));
    Ranked {
        designs: kept,
        further_off,
        more,
    }
}

/// Whether both are one linkage, driven at one pivot; with its pins in another order too.
fn same(one: &FoundLinkage, other: &FoundLinkage, near: f64) -> bool {
    let pins = |design: &FoundLinkage| -> Vec<Number> {
        let joints = design.candidate.linkage.joints.iter();
        joints.filter_map(Joint::pin).collect()
    };
    let [a, b] = [pins(one), pins(other)];
    one.kind == other.kind
        && a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| (a - b).norm() <= near)
        && one.candidate.linkage.output == other.candidate.linkage.output
        && (one.candidate.linkage.point - other.candidate.linkage.point).norm() <= near
}
