//! The mass matrix M (n, n): one block per body, nothing between bodies.
//!
//! ```text
//! rigid body     diag(m, m, I)         coordinates of the centre of mass, inertia about it   [kg, kg, kg·m²]
//! ```
//!
//! Only this file knows that the blocks are diagonal. A body with elastic coordinates has a full one.

use crate::element::{BodyColumns, Layout};

/// M, by the blocks of the bodies.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mass {
    diagonal: Vec<f64>,
}

impl Mass {
    /// Adds a rigid body behind those that are there; unknown masses and inertias are zero [kg, kg·m²].
    pub(crate) fn push_rigid(&mut self, mass: f64, inertia: f64) {
        self.diagonal.extend([mass, mass, inertia]);
    }

    /// Replaces mass and inertia of a rigid body [kg, kg·m²].
    pub(crate) fn set_rigid(&mut self, columns: BodyColumns, mass: f64, inertia: f64) {
        self.diagonal[columns.range()].copy_from_slice(&[mass, mass, inertia]);
    }

    /// Adds the block that a body has in another matrix.
    pub(crate) fn push_block_of(&mut self, other: &Mass, columns: BodyColumns) {
        self.diagonal
            .extend_from_slice(&other.diagonal[columns.range()]);
    }

    /// Replaces each entry.
    pub(super) fn renumber(&mut self, number: &mut dyn FnMut(f64) -> f64) {
        self.diagonal.iter_mut().for_each(|own| *own = number(*own));
    }

    /// Gives back the room into which it has grown.
    pub(super) fn shrink(&mut self) {
        self.diagonal.shrink_to_fit();
    }

    /// Mass of a body \[kg\].
    pub(crate) fn of_body(&self, columns: BodyColumns) -> f64 {
        self.diagonal[columns.x()]
    }

    /// Diagonal of M (n): how heavy each coordinate is.
    pub(crate) fn diagonal(&self) -> &[f64] {
        &self.diagonal
    }

    /// Entries of M, those of bodies without mass included: row, column, value.
    pub(crate) fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let diagonal = self.diagonal.iter().enumerate();
        diagonal.map(|(k, m)| (k, k, *m))
    }

    /// out = x − M y (n).
    pub(crate) fn residual(&self, x: &[f64], y: &[f64], out: &mut [f64]) {
        for (((out, x), y), m) in out.iter_mut().zip(x).zip(y).zip(&self.diagonal) {
            *out = x - m * y;
        }
    }

    /// sᵀ M s, and sᵀ (x − M y): how heavy the motion s is, and what pulls along it, in one pass.
    pub(crate) fn along(&self, s: &[f64], x: &[f64], y: &[f64]) -> [f64; 2] {
        let terms = s.iter().zip(x).zip(y).zip(&self.diagonal);
        terms.fold([0.0; 2], |[own, pull], (((s, x), y), m)| {
            [own + s * m * s, pull + s * (x - m * y)]
        })
    }

    /// sᵀ (x − M y): what pulls along the motion s.
    pub(crate) fn pull(&self, s: &[f64], x: &[f64], y: &[f64]) -> f64 {
        let terms = s.iter().zip(x).zip(y).zip(&self.diagonal);
        terms.map(|(((s, x), y), m)| (x - m * y) * s).sum()
    }

    /// Components of M x that are not zero, with their columns, ascending.
    pub(crate) fn momenta(&self, x: &[f64]) -> impl Iterator<Item = (usize, f64)> {
        x.iter()
            .zip(&self.diagonal)
            .enumerate()
            .filter(|(_, (x, _))| **x != 0.0)
            .map(|(column, (x, m))| (column, x * m))
    }

    /// xᵀ M y.
    pub(crate) fn product(&self, x: &[f64], y: &[f64]) -> f64 {
        x.iter()
            .zip(y)
            .zip(&self.diagonal)
            .map(|((x, y), m)| x * y * m)
            .sum()
    }

    /// Kinetic energy ½ vᵀ M v \[J\].
    pub(crate) fn kinetic_energy(&self, v: &[f64]) -> f64 {
        0.5 * v
            .iter()
            .zip(&self.diagonal)
            .map(|(v, m)| m * v * v)
            .sum::<f64>()
    }

    /// Gravity's force on every body into `force` (n), no torque [N, N·m].
    pub(crate) fn weigh(&self, layout: &Layout, gravity: [f64; 2], force: &mut [f64]) {
        for columns in layout.bodies() {
            let m = self.of_body(columns);
            columns.write(force, [m * gravity[0], m * gravity[1], 0.0]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_agree_with_the_matrix() {
        let mut mass = Mass::default();
        mass.push_rigid(2.0, 0.5);
        mass.push_rigid(0.0, 3.0);
        let m = [2.0, 2.0, 0.5, 0.0, 0.0, 3.0];
        assert_eq!(mass.diagonal(), m);
        let (x, y) = (
            [1.0, -2.0, 3.0, 4.0, 0.0, -1.0],
            [0.5, 0.25, 2.0, 1.0, 7.0, 2.0],
        );
        let expected: f64 = (0..6).map(|k| x[k] * m[k] * y[k]).sum();
        assert_eq!(mass.product(&x, &y), expected);
        assert_eq!(2.0 * mass.kinetic_energy(&x), mass.product(&x, &x));
        let mut out = [0.0; 6];
        mass.residual(&x, &y, &mut out);
        assert!((0..6).all(|k| out[k] == x[k] - m[k] * y[k]), "{out:?}");
        let entries: Vec<_> = mass.entries().collect();
        assert!((0..6).all(|k| entries[k] == (k, k, m[k])));
        assert_eq!(
            mass.along(&x, &y, &x),
            [
                mass.product(&x, &x),
                (0..6).map(|k| x[k] * (y[k] - m[k] * x[k])).sum()
            ]
        );
        assert_eq!(mass.pull(&x, &y, &x), mass.along(&x, &y, &x)[1]);
        let momenta: Vec<_> = mass.momenta(&x).collect();
        assert_eq!(
            momenta,
            [(0, 2.0), (1, -4.0), (2, 1.5), (3, 0.0), (5, -3.0)]
        );
        let layout = Layout::rigid(2);
        mass.weigh(&layout, [1.0, -10.0], &mut out);
        assert_eq!(out, [2.0, -20.0, 0.0, 0.0, 0.0, 0.0]);
    }
}
