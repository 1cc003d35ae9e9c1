//! Which coordinates joints hold where they are, and which rows are linear in those that move.
//!
//! ```text
//! c q_k = const         q_k stands     a row whose only entry in a column that moves is a constant c
//! ∂²φ/∂q_i∂q_j = 0      J stays        a row that bends with no two columns that move
//! ```
//!
//! What stands is as good as ground: rows that bend with it become linear, and may hold something in turn. Of a slide along an axis
//! the angle stands first, then the place across; of one that is carried by it the same again. Both are known for as long as
//! these rows are in force, so that an entry of a linear row which is zero once is zero for good.

use super::{Block, Origin, System};

/// An entry this much smaller than the largest of its row is round-off of a direction [–].
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// What a row says of the columns that move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RowMotion {
    /// It may bend with them.
    Bent,
    /// It is linear in them.
    Linear,
    /// It holds one that would move.
    Holds,
}

/// What stands.
pub(crate) struct Standing {
    /// By column.
    columns: Vec<bool>,
    /// By row of joints and drivers.
    rows: Vec<RowMotion>,
}

/// Where the constraints of a block bend; none of ground.
type Bends = Vec<[Option<usize>; 2]>;

impl Standing {
    /// By these rows of joints and drivers (others may be among them), with the scaled entries of J at a position that satisfies them.
    pub fn of(system: &System, rows: &[usize], scaled: &[f64]) -> Self {
        let mut standing = Standing {
            columns: vec![false; system.n()],
            rows: vec![RowMotion::Bent; system.m()],
        };
        let mut is_active = vec![false; system.m()];
        let own = rows.iter().filter(|row| **row < system.m());
        own.for_each(|row| is_active[*row] = true);
        let column = |(body, axis)| system.layout.column(body, axis);
        let bends = |block: &Block| {
            block
                .constraint
                .curvature_pattern()
                .iter()
                .map(|p| p.map(column))
                .collect()
        };
        let bends: Vec<Bends> = system.blocks.iter().map(bends).collect();
        // There and back, so that it does not matter in which order the file has what is carried.
        let mut is_new = true;
        while is_new {
            is_new = false;
            let there = 0..bends.len();
            for at in there.clone().chain(there.rev()) {
                let block = &system.blocks[at];
                is_new |= standing.look(system, block, &bends[at], (&is_active, scaled));
            }
        }
        standing
    }

    /// What the rows of a block are with what is known to stand; whether one of them holds something more.
    fn look(
        &mut self,
        system: &System,
        block: &Block,
        bends: &Bends,
        (is_active, scaled): (&[bool], &[f64]),
    ) -> bool {
        let moves = |place: &Option<usize>| place.is_some_and(|column| !self.columns[column]);
        let is_bent = bends.iter().any(|pair| pair.iter().all(moves));
        let may_hold = match block.origin {
            // The offset of a clearance link is no constant.
            Origin::Joint(_) => system.links == 0,
            Origin::Driver(driver) => system.drivers[driver.0].is_still(),
            Origin::Stop(_) | Origin::Initial(_) => false,
        };
        let mut is_new = false;
        for (own, is_active) in is_active[block.row()..][..block.rows().len()]
            .iter()
            .enumerate()
        {
            let row = block.row() + own;
            let is_linear = !is_bent || block.constraint.is_linear(own);
            if self.rows[row] == RowMotion::Holds || !is_linear {
                continue;
            }
            self.rows[row] = RowMotion::Linear;
            if let Some(column) = self.only(system, block, row, scaled)
                && may_hold
                && *is_active
            {
                self.columns[column] = true;
                self.rows[row] = RowMotion::Holds;
                is_new = true;
            }
        }
        is_new
    }

    /// The only column that moves in a row.
    fn only(&self, system: &System, block: &Block, row: usize, scaled: &[f64]) -> Option<usize> {
        let own = block.entries();
        let entries = || {
            let entries = system.entries[own.clone()].iter();
            entries
                .zip(&scaled[own.clone()])
                .filter_map(|(entry, value)| {
                    let column = entry.column()? as usize;
                    let is_here = entry.row as usize == row && !self.columns[column];
                    is_here.then_some((column, value.abs()))
                })
        };
        let largest = entries().map(|(_, size)| size).fold(0.0, f64::max);
        let mut there = entries().filter(|(_, size)| *size > ROUND_OFF * largest);
        let (column, _) = there.next()?;
        let others = there.all(|(other, _)| other == column);
        others.then_some(column)
    }

    /// Where a block bends with two columns that move.
    pub fn bends(&self, system: &System, block: &Block) -> Vec<[usize; 2]> {
        let moving = |(body, axis)| {
            let column = system.layout.column(body, axis)?;
            (!self.columns[column]).then_some(column)
        };
        let bends = block.constraint.curvature_pattern();
        let pairs = bends
            .iter()
            .filter_map(|[a, b]| Some([moving(*a)?, moving(*b)?]));
        pairs.collect()
    }

    /// The columns that move, ascending.
    pub fn moving(&self) -> Vec<u32> {
        let columns = self.columns.iter().zip(0..);
        columns
            .filter(|(stands, _)| !**stands)
            .map(|(_, column)| column)
            .collect()
    }

    /// Those of some rows that are rows of joints and drivers, and do not hold what stands.
    pub fn rest(&self, rows: &[usize]) -> Vec<u32> {
        let own = rows.iter().filter(|row| **row < self.rows.len());
        let rest = own.filter(|row| self.rows[**row] != RowMotion::Holds);
        rest.map(|row| *row as u32).collect()
    }

    /// Whether a row is linear in what moves.
    pub fn is_linear(&self, row: usize) -> bool {
        self.rows[row] != RowMotion::Bent
    }
}
