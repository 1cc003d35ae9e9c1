//! A bound that no deviation exceeds: an interval Newton step about the nominal position.
//!
//! With J̄ the mean of J along the way from the nominal position by Δq, any matrix C near J⁻¹ and any λ near J⁻ᵀ∂yᵀ:
//!
//! ```text
//! Δq = −C (φ₀ + e) + (I − C J̄) Δq
//! Δy = −λᵀ(φ₀ + e) + (∂ȳ − λᵀ J̄) Δq
//! X  ≥ |C e| + (|I − C J₀| + |C| |J̄ − J₀|) X      then no |Δq| that goes out from 0 exceeds X
//! |Δy + λᵀ e| ≤ |λ||φ₀| + (|∂y₀ − λᵀJ₀| + |∂ȳ − ∂y₀| + |λ| |J̄ − J₀|) X
//! ```
//!
//! |J̄ − J₀| is bounded entry by entry: an entry that turns with an angle changes by its derivative times the angle, and in
//! the mean along the way by half of that. The matrix J is regular for all |Δq| ≤ X where the same bound without the mean
//! contracts; so the way from the nominal position never branches within X. Sums are widened by their rounding.
//! (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, 1990, ch. 5.)

mod changes;
mod deviations;

use super::displaced::{Mechanism, Stand};
use super::output::{Load, Output};
use changes::{Radii, changes};

/// Widenings of X that are tried.
const WIDENINGS: [f64; 5] = [1.001, 1.02, 1.2, 1.6, 2.5];
/// Refinements of an X that holds.
const REFINEMENTS: usize = 3;

/// The inverse of J at a pose (n, m), by columns of rows of J.
pub(super) struct Inverse {
    n: usize,
    /// Column r stands at r·n: C e_r.
    columns: Vec<f64>,
    /// |I − C J₀| (n, n), by columns.
    residual: Vec<f64>,
}

impl Inverse {
    fn column(&self, row: usize) -> &[f64] {
        &self.columns[row * self.n..][..self.n]
    }
}

impl Mechanism<'_> {
    /// C at the factors of a pose that was taken.
    pub fn inverse(&mut self) -> Inverse {
        let system = self.driven.system;
        let n = system.n();
        let mut columns = vec![0.0; n * n];
        let mut unit = vec![0.0; n];
        for row in 0..n {
            unit.fill(0.0);
            unit[row] = 1.0;
            self.driven.answer(&unit, &mut columns[row * n..][..n]);
        }
        let mut residual = vec![0.0; n * n];
        for k in 0..n {
            residual[k * n + k] = 1.0;
        }
        let mut sizes = vec![0.0; n * n];
        for (entry, value) in system.entries.iter().zip(&self.driven.evaluation.jacobian) {
            if let Some(column) = entry.column {
                let (row, column) = (entry.row as usize, column as usize);
                for k in 0..n {
                    let part = columns[row * n + k] * value;
                    residual[column * n + k] -= part;
                    sizes[column * n + k] += part.abs();
                }
            }
        }
        let rounding = 16.0 * f64::EPSILON;
        for (residual, size) in residual.iter_mut().zip(&sizes) {
            *residual = residual.abs() + rounding * size;
        }
        Inverse {
            n,
            columns,
            residual,
        }
    }

    /// The bound of the output's deviations to both sides, least and greatest; none where none can be certified. The pose was
    /// taken, and its factors are at hand. `slack` (dimensions) bounds what the steps of the parameters leave out.
    pub fn enclosure(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: &Load,
        inverse: &Inverse,
        slack: &[f64],
    ) -> Option<[f64; 2]> {
        self.take(&stand.q, stand);
        let x = self.radii(stand, inverse, slack)?;
        let system = self.driven.system;
        let (n, here) = (system.n(), self.here(stand));
        let changes = changes(system, &here.at, &Radii { system, x: &x });
        // (|∂y₀ − λᵀJ₀| + |∂ȳ − ∂y₀| + |λ||J̄ − J₀|) X
        let (mut gradient, mut change) = (vec![0.0; n], vec![0.0; n]);
        output.gradient(&here.at, &system.layout, &mut gradient);
        output.gradient_change(&here.at, &system.layout, &x, &mut change);
        let mut carried = vec![0.0; n];
        let mut lean = 0.0;
        let entries = system.entries.iter().zip(&self.driven.evaluation.jacobian);
        for ((entry, value), by) in entries.zip(&changes) {
            if let Some(column) = entry.column {
                let lambda = load.lambda[entry.row as usize];
                carried[column as usize] += lambda * value;
                lean += lambda.abs() * by.mean * x[column as usize];
            }
        }
        for k in 0..n {
            let rounding = 8.0 * f64::EPSILON * (gradient[k].abs() + carried[k].abs());
            lean += ((gradient[k] - carried[k]).abs() + rounding + change[k]) * x[k];
        }
        let loose = self.loose(stand, slack, &x);
        for (row, loose) in loose.iter().enumerate() {
            let phi =
                self.driven.evaluation.phi[row].abs() + 8.0 * f64::EPSILON * system.row_scale(row);
            lean += load.lambda[row].abs() * (phi + loose);
        }
        lean += self.own_points(stand, output, slack, &x);
        let influences = self.influences(stand, output, load);
        let (mut low, mut high) = (-lean, lean);
        for (play, g) in self.plays.iter().zip(&influences) {
            let [down, up] = play.reach(*g);
            low += down;
            high += up;
        }
        let widened = 1.0 + 1e-13 + 4.0 * f64::EPSILON * (n + self.plays.len()) as f64;
        (low.is_finite() && high.is_finite()).then_some([low * widened, high * widened])
    }

    /// X (n); none where no bound contracts.
    fn radii(&self, stand: &Stand, inverse: &Inverse, slack: &[f64]) -> Option<Vec<f64>> {
        let system = self.driven.system;
        let n = system.n();
        let here = self.here(stand);
        let straight = self.straight(stand, inverse);
        let step = |x: &[f64], mean: bool| -> Vec<f64> {
            let changes = changes(system, &here.at, &Radii { system, x });
            let mut by_row = self.loose(stand, slack, x);
            for (entry, by) in system.entries.iter().zip(&changes) {
                if let Some(column) = entry.column {
                    let by = if mean { by.mean } else { by.most };
                    by_row[entry.row as usize] += by * x[column as usize];
                }
            }
            let mut out = straight.clone();
            for (row, by) in by_row.iter().enumerate() {
                for (out, c) in out.iter_mut().zip(inverse.column(row)) {
                    *out += c.abs() * by;
                }
            }
            for (column, x) in x.iter().enumerate() {
                for (out, residual) in out.iter_mut().zip(&inverse.residual[column * n..][..n]) {
                    *out += residual * x;
                }
            }
            out.iter_mut().for_each(|out| *out *= 1.0 + 1e-12);
            out
        };
        let inside = |inner: &[f64], outer: &[f64]| {
            inner
                .iter()
                .zip(outer)
                .all(|(inner, outer)| inner < outer || (*inner == 0.0 && *outer == 0.0))
        };
        for widening in WIDENINGS {
            // A few passes let each coordinate find its own width.
            let mut x = straight.clone();
            for _ in 0..4 {
                x = step(&x, true);
            }
            x.iter_mut().for_each(|x| *x *= widening);
            let next = step(&x, true);
            if !inside(&next, &x) {
                continue;
            }
            let most = step(&x, false);
            let contracts = most
                .iter()
                .zip(&straight)
                .zip(&x)
                .all(|((most, straight), x)| most - straight < *x || *x == 0.0);
            if !contracts {
                continue;
            }
            let mut x = next;
            for _ in 0..REFINEMENTS {
                x = step(&x, true);
            }
            return Some(x);
        }
        None
    }
}
