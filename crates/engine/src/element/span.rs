//! Two points and the vector between them, with derivatives: what springs and contacts share.
//!
//! ```text
//! d = P₂ − P₁          ∂d/∂q = ∂ḋ/∂v = B = [−I, −ρ₁⊥ | I, ρ₂⊥]       (2, 6)
//! ḋ = B v              ∂ḋ/∂q = D = [0, ω₁ ρ₁ | 0, −ω₂ ρ₂]            (2, 6)
//! Q = Bᵀ F             ∂Q/∂q = Bᵀ ∂F/∂q + diag(0, 0, ρ₁·F | 0, 0, −ρ₂·F)      of a force F on the second point, −F on the first
//! ```

use super::{Axis, BodyId, Kinematics, Marker, Slope};
use linkdyn_linear::math::{Vec2, perp};

/// Coordinates of two bodies.
pub const BOTH: usize = 6;

/// The points of two bodies.
pub struct Span {
    rho: [Vec2; 2],
    omega: [f64; 2],
}

/// The coordinates of two bodies.
pub fn both_bodies(first: &Marker, second: &Marker) -> Vec<(BodyId, Axis)> {
    let of = |marker: &Marker| Axis::ALL.map(|axis| (marker.body, axis));
    [of(first), of(second)].concat()
}

/// The pairs of these with a second one that does not stand before the first.
pub fn upper_pairs(first: &Marker, second: &Marker) -> Vec<Slope> {
    let both = both_bodies(first, second);
    let pairs = (0..BOTH).flat_map(|row| (row..BOTH).map(move |column| (row, column)));
    pairs
        .map(|(row, column)| [both[row], both[column]])
        .collect()
}

/// All pairs of the coordinates of two bodies, row by row.
pub fn all_pairs(first: &Marker, second: &Marker) -> Vec<Slope> {
    let both = both_bodies(first, second);
    let row = |row: &_| both.iter().map(|column| [*row, *column]).collect();
    both.iter().flat_map::<Vec<Slope>, _>(row).collect()
}

impl Span {
    /// At an instant.
    pub fn at(at: &Kinematics, first: &Marker, second: &Marker) -> Self {
        Span {
            rho: [first.rho(at), second.rho(at)],
            omega: [first.omega(at), second.omega(at)],
        }
    }

    /// A column of B.
    pub fn spread(&self, column: usize) -> Vec2 {
        let sign = if column < 3 { -1.0 } else { 1.0 };
        match column % 3 {
            0 => Vec2::new(sign, 0.0),
            1 => Vec2::new(0.0, sign),
            _ => perp(self.rho[column / 3]) * sign,
        }
    }

    /// A column of D.
    pub fn turn(&self, column: usize) -> Vec2 {
        match column {
            2 => self.rho[0] * self.omega[0],
            5 => self.rho[1] * -self.omega[1],
            _ => Vec2::zeros(),
        }
    }

    /// Second derivatives by the coordinates of a function of d: of its gradient, and of its second derivatives, applied to a vector.
    pub fn bent(&self, gradient: Vec2, second: impl Fn(Vec2) -> Vec2) -> [[f64; BOTH]; BOTH] {
        let mut bent = [[0.0; BOTH]; BOTH];
        for column in 0..BOTH {
            let change = second(self.spread(column));
            for (row, of_row) in bent.iter_mut().enumerate() {
                of_row[column] = self.spread(row).dot(&change);
            }
        }
        // d has −ρ₁ and ρ₂, which turn.
        bent[2][2] += gradient.dot(&self.rho[0]);
        bent[5][5] -= gradient.dot(&self.rho[1]);
        bent
    }

    /// Adds a column of Bᵀ ∂F to a matrix by rows (6 × 6).
    pub fn add_force(&self, change: Vec2, column: usize, to: &mut [f64]) {
        for row in 0..BOTH {
            to[row * BOTH + column] += self.spread(row).dot(&change);
        }
    }

    /// Adds what F does because the points turn with their bodies.
    pub fn add_turned(&self, force: Vec2, to: &mut [f64]) {
        to[2 * BOTH + 2] += self.rho[0].dot(&force);
        to[5 * BOTH + 5] -= self.rho[1].dot(&force);
    }
}
