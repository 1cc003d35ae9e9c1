//! How the equations of a joint or driver hold on to the points of its two bodies.

use crate::element::{Axis, BodyId};
use crate::system::{Block, System};
use linkdyn_linear::math::Vec2;

/// The entries of J that say how rows change as a point moves: those of its body's place, for ∂φ/∂P = ∂φ/∂r.
#[derive(Debug, Clone)]
pub(super) struct Grip {
    /// 1; −1 of the point on a carrier along which the line of centres of a gear goes.
    sign: f64,
    /// The body whose guide the rows are measured across or along: ∂φ/∂P turns with it.
    pub guide: Option<BodyId>,
    /// Bound of |∂φ/∂P| in a row [1 or 1/m].
    most: f64,
    /// (row, index among the entries of J).
    x: Vec<(usize, usize)>,
    y: Vec<(usize, usize)>,
}

impl Grip {
    /// Of a block on the point that it has on a body.
    pub fn of(block: &Block, body: BodyId) -> Grip {
        let mut grip = Grip {
            sign: 1.0,
            guide: None,
            most: 1.0,
            x: Vec::new(),
            y: Vec::new(),
        };
        let entries = block.constraint.entries();
        for (index, (row, own, axis)) in entries.into_iter().enumerate() {
            let entry = (block.row() + row, block.entries().start + index);
            match axis {
                Axis::X if own == body => grip.x.push(entry),
                Axis::Y if own == body => grip.y.push(entry),
                Axis::X | Axis::Y | Axis::Theta => {}
            }
        }
        grip
    }

    /// Of rows that are measured across or along the guide of a body.
    pub fn along(self, guide: Option<BodyId>) -> Grip {
        Grip { guide, ..self }
    }

    /// Of a gear on the centre of a wheel: on the wheel, or on its carrier, where the line of centres follows it.
    pub fn of_gear(block: &Block, wheel: BodyId, on_carrier: bool, curvature: f64) -> Grip {
        Grip {
            sign: if on_carrier { -1.0 } else { 1.0 },
            most: curvature,
            ..Grip::of(block, wheel)
        }
    }

    pub fn sign(&self) -> f64 {
        self.sign
    }

    /// Rows with the entries of J, along x (0) or y (1).
    pub fn entries(&self, axis: usize) -> &[(usize, usize)] {
        [&self.x, &self.y][axis]
    }

    /// The same of all that hold on to a point, each with its sign.
    pub fn all(grips: &[Grip], axis: usize) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        grips.iter().flat_map(move |grip| {
            let own = grip.entries(axis).iter();
            own.map(move |&(row, entry)| (row, entry, grip.sign))
        })
    }

    /// λᵀ ∂φ/∂P, in global axes.
    pub fn pull(&self, jacobian: &[f64], lambda: &[f64]) -> Vec2 {
        let sum = |entries: &[(usize, usize)]| -> f64 {
            entries
                .iter()
                .map(|&(row, entry)| lambda[row] * jacobian[entry])
                .sum()
        };
        self.sign * Vec2::new(sum(&self.x), sum(&self.y))
    }

    /// Adds ∂φ/∂P·d to the rows.
    pub fn push(&self, jacobian: &[f64], d: Vec2, rows: &mut [f64]) {
        for (entries, d) in [(&self.x, d.x), (&self.y, d.y)] {
            for &(row, entry) in entries {
                rows[row] += self.sign * jacobian[entry] * d;
            }
        }
    }

    /// Adds what a length can do to all rows that hold on to the point.
    pub fn push_size(&self, length: f64, rows: &mut [f64]) {
        for &(row, _) in self.x.iter().chain(&self.y) {
            rows[row] += self.most * length;
        }
    }
}

/// The block of driver `id`.
pub(super) fn driver_block(system: &System, id: usize) -> &Block {
    &system.blocks[system.joints.len() + id]
}
