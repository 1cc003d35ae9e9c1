//! Which poses go in, so that the page stays below 5 MB and opens fast.
//!
//! The band keeps all poses while there is room, then every k-th and those that matter. Contributions and configurations are
//! there at fewer poses: those can be chosen on the page.

use super::parts::{AccuracyPage, Output};
use crate::numbers::evenly;

/// Bytes that numbers may take, before base64 makes a third more of them.
const ROOM: usize = 2_700_000;
/// Poses with contributions and configurations of an output, at most, and whatever there is room for at least.
const MOST_DETAILS: usize = 200;
const LEAST_DETAILS: usize = 8;
/// Poses of a band, at most.
const MOST_ROWS: usize = 4000;
/// Numbers of a row of the band, drivers aside.
pub const WIDTH: usize = 14;
/// Size of a number \[bytes\].
const BYTES: usize = 8;

/// Poses of an output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chosen {
    /// Numbers of the poses in the band, ascending.
    pub rows: Vec<usize>,
    /// Of them those with contributions and configurations, as numbers of `rows`.
    pub details: Vec<usize>,
    /// The pose that is shown first, as a number of `details`.
    pub worst: usize,
}

/// Chooses for all outputs.
pub fn chosen(page: &AccuracyPage) -> Vec<Chosen> {
    let outputs = page.outputs.len().max(1);
    let row = (WIDTH + page.drivers.len()) * BYTES;
    let bodies = page.shape.bodies.len().saturating_sub(1);
    let detail = (4 * page.sources.len() + 9 * bodies) * BYTES;
    let rows = (ROOM / 2 / outputs / row).clamp(LEAST_DETAILS, MOST_ROWS);
    let details = (ROOM / 2 / outputs / detail.max(1)).clamp(LEAST_DETAILS, MOST_DETAILS);
    let outputs = page.outputs.iter();
    outputs
        .map(|output| of_output(output, rows, details))
        .collect()
}

fn of_output(output: &Output, most_rows: usize, most_details: usize) -> Chosen {
    let matter = matter(output);
    let poses = output.poses.len();
    let rows = spread(poses, most_rows, &matter);
    let place = |pose: &usize| rows.binary_search(pose).ok();
    let kept: Vec<usize> = matter.iter().filter_map(place).collect();
    let details = spread(rows.len(), most_details, &kept);
    let worst = farthest(output)
        .and_then(|pose| details.iter().position(|&row| rows[row] == pose))
        .unwrap_or(0);
    Chosen {
        rows,
        details,
        worst,
    }
}

/// The pose at which the output goes farthest.
pub fn farthest(output: &Output) -> Option<usize> {
    let poses = output.poses.iter().enumerate();
    let most = poses.max_by(|(_, a), (_, b)| a.extent().total_cmp(&b.extent()));
    most.map(|(number, _)| number)
}

/// The pose at which the least stays within the limits.
pub fn least_within(output: &Output) -> Option<usize> {
    let poses = output.poses.iter().enumerate();
    let known = poses.filter_map(|(number, pose)| Some((number, pose.capability?[0])));
    let least = known.min_by(|(_, a), (_, b)| a.total_cmp(b));
    least.map(|(number, _)| number)
}

/// Poses that must be seen: the ends, and those where something is largest.
fn matter(output: &Output) -> Vec<usize> {
    let last = output.poses.len().saturating_sub(1);
    let largest = |value: fn(&super::parts::Pose) -> Option<f64>| {
        let poses = output.poses.iter().enumerate();
        let known = poses.filter_map(|(number, pose)| Some((number, value(pose)?)));
        known
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .map(|(number, _)| number)
    };
    let mut matter = vec![0, last];
    matter.extend(farthest(output));
    matter.extend(least_within(output));
    matter.extend(largest(|pose| pose.found[0].map(|by| -by)));
    matter.extend(largest(|pose| pose.found[1]));
    matter.extend(largest(|pose| pose.certified.map(|by| by[1] - by[0])));
    matter.sort_unstable();
    matter.dedup();
    matter
}

/// All numbers below `count`, or so many of them, evenly spread, and those that are kept.
fn spread(count: usize, most: usize, kept: &[usize]) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    let mut numbers = evenly(count, most.saturating_sub(kept.len()));
    numbers.extend(kept);
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_are_spread_evenly_and_what_matters_is_kept() {
        assert_eq!(spread(3, 5, &[1]), [0, 1, 2]);
        let found = spread(10_001, 200, &[777, 9_999]);
        assert!(found.len() <= 200, "{}", found.len());
        assert!(found.contains(&777) && found.contains(&9_999) && found.contains(&10_000));
        let widest = found.windows(2).map(|pair| pair[1] - pair[0]).max();
        assert!(widest <= Some(52), "{widest:?}");
    }
}
