//! The polynomial through six nodes, also of a path that repeats itself after a turn.

use linkdyn_linear::hermite::{Node, osculate_abreast};
use std::f64::consts::TAU;

/// Nodes around a gap that tell what is in it.
pub(super) const WIDE: usize = 6;

/// The turn that stands for all.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Turn {
    /// Its middle [rad].
    pub centre: f64,
    /// Columns of what turns with it, and by how many turns.
    pub wheels: Vec<(u32, i32)>,
}

impl Turn {
    /// What a turn adds: columns and angles.
    pub(super) fn shifts(&self) -> impl Iterator<Item = (usize, f64)> {
        let wheels = self.wheels.iter();
        wheels.map(|&(column, turns)| (column as usize, f64::from(turns) * TAU))
    }

    /// Adds so many turns.
    pub(super) fn add(&self, turns: f64, q: &mut [f64]) {
        for (column, shift) in self.shifts() {
            q[column] += turns * shift;
        }
    }
}

/// A node by its place in a list, and how many turns on from its own place it counts.
pub(super) type Moved = (usize, i32);

/// The six nodes around the gap before node `k` of `count`. At the ends they are those of the end; where the list comes round, those of
/// the other end.
pub(super) fn around(k: usize, count: usize, comes_round: bool) -> [Moved; WIDE] {
    if comes_round {
        let (first, count) = (k as i32 - WIDE as i32 / 2, count as i32);
        let place = |j| first + j as i32;
        return std::array::from_fn(|j| {
            let (index, turns) = (place(j).rem_euclid(count), place(j).div_euclid(count));
            (index as usize, turns)
        });
    }
    let first = k.saturating_sub(WIDE / 2).min(count - WIDE);
    std::array::from_fn(|j| (first + j, 0))
}

/// The polynomial through six nodes, of a path that repeats itself where there is a turn.
pub(super) fn osculate_six(
    nodes: &[Node],
    six: [Moved; WIDE],
    turn: Option<&Turn>,
    s: f64,
    [q, d, dd]: [&mut [f64]; 3],
) {
    let turns = six.map(|(_, turns)| f64::from(turns));
    let own = six.map(|(index, _)| &nodes[index]);
    let at = std::array::from_fn(|j| own[j].s + turns[j] * TAU);
    let grown = osculate_abreast(own, (at, turns), s, [&mut *q, &mut *d, &mut *dd]);
    if let Some(turn) = turn
        && turns != [0.0; WIDE]
    {
        let each = [q, d, dd].into_iter().zip(grown);
        each.for_each(|(to, grown)| turn.add(grown, to));
    }
}
