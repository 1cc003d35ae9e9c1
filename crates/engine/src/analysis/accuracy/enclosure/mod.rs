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
mod extents;

use super::displaced::{Mechanism, Stand};
use super::output::{Load, Output};
use changes::{Change, Radii, changes};
pub(super) use extents::Extents;

/// Widenings of X that are tried.
const WIDENINGS: [f64; 5] = [1.001, 1.02, 1.2, 1.6, 2.5];
/// Passes before a wider X is tried, that let each coordinate find its own width.
const PASSES: usize = 4;
/// Refinements of a wide X that holds.
const REFINEMENTS: usize = 3;
/// Widened by less than this X needs no refinement: what it leaves is of second order in it.
const NARROW: f64 = 1.01;

/// The inverse of J at a pose (n, m), by columns of rows of J.
struct Inverse {
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

    /// q = C·rows times a factor.
    fn carry(&self, rows: &[f64], factor: f64, q: &mut [f64]) {
        q.fill(0.0);
        for (row, e) in rows.iter().enumerate().filter(|(_, e)| **e != 0.0) {
            let e = e * factor;
            for (q, c) in q.iter_mut().zip(self.column(row)) {
                *q += c * e;
            }
        }
    }

    /// X = straight + |C| rows + |I − C J₀| x, widened by its rounding.
    fn widen(&self, straight: &[f64], rows: &[f64], x: &[f64]) -> Vec<f64> {
        let mut out = straight.to_vec();
        for (row, by) in rows.iter().enumerate() {
            for (out, c) in out.iter_mut().zip(self.column(row)) {
                *out += c.abs() * by;
            }
        }
        for (x, column) in x.iter().zip(self.residual.chunks_exact(self.n.max(1))) {
            for (out, residual) in out.iter_mut().zip(column) {
                *out += residual * x;
            }
        }
        out.iter_mut().for_each(|out| *out *= 1.0 + 1e-12);
        out
    }
}

/// Where the mechanism stays under all deviations: |Δq| ≤ X.
pub(super) struct Region {
    /// X (n).
    x: Vec<f64>,
    /// Bounds of the changes of the entries of J on the way.
    changes: Vec<Change>,
    /// Bounds (m) of what φ and gaps are off at the pose, and change on the way.
    rows: Vec<f64>,
}

/// What J and gaps change within |Δq| ≤ X.
struct Loose {
    changes: Vec<Change>,
    /// By gaps alone (m).
    gaps: Vec<f64>,
}

impl Mechanism<'_> {
    /// C at the factors of a pose that was taken.
    fn inverse(&mut self) -> Inverse {
        let system = self.driven.system;
        let n = system.n();
        let columns = self.driven.inverse();
        let mut residual = vec![0.0; n * n];
        for k in 0..n {
            residual[k * n + k] = 1.0;
        }
        let mut sizes = vec![0.0; n * n];
        for (entry, value) in system.entries.iter().zip(&self.driven.evaluation.jacobian) {
            if let Some(column) = entry.column() {
                let (row, column) = (entry.row as usize, column as usize);
                let residual = residual[column * n..][..n].iter_mut();
                let sizes = sizes[column * n..][..n].iter_mut();
                for ((residual, size), c) in residual.zip(sizes).zip(&columns[row * n..][..n]) {
                    let part = c * value;
                    *residual -= part;
                    *size += part.abs();
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

    /// The bound of the output's deviations to both sides, least and greatest, within a region of the pose; none where it is
    /// not finite. The pose was taken.
    pub fn bound(
        &self,
        stand: &Stand,
        output: &Output,
        load: &Load,
        reach: [f64; 2],
        region: &Region,
    ) -> Option<[f64; 2]> {
        if !self.is_bounded {
            return None;
        }
        let extents = &self.extents;
        let Region { x, changes, rows } = region;
        let system = self.driven.system;
        let (n, here) = (system.n(), self.here(stand));
        // (|∂y₀ − λᵀJ₀| + |∂ȳ − ∂y₀| + |λ||J̄ − J₀|) X
        let (mut gradient, mut change) = (vec![0.0; n], vec![0.0; n]);
        let own = output.pulls(&here.at, here.shifts);
        output.gradient(&here.at, &own, &system.layout, &mut gradient);
        output.gradient_change(&here.at, &system.layout, x, &mut change);
        let mut carried = vec![0.0; n];
        let mut lean = 0.0;
        let entries = system.entries.iter().zip(&self.driven.evaluation.jacobian);
        for ((entry, value), by) in entries.zip(changes) {
            if let Some(column) = entry.column() {
                let lambda = load.lambda[entry.row as usize];
                carried[column as usize] += lambda * value;
                lean += lambda.abs() * by.mean * x[column as usize];
            }
        }
        for k in 0..n {
            let rounding = 8.0 * f64::EPSILON * (gradient[k].abs() + carried[k].abs());
            lean += ((gradient[k] - carried[k]).abs() + rounding + change[k]) * x[k];
        }
        for (lambda, row) in load.lambda.iter().zip(rows) {
            lean += lambda.abs() * row;
        }
        lean += self.own_points(stand, output, extents, x);
        let (low, high) = (reach[0] - lean, reach[1] + lean);
        let widened = 1.0 + 1e-13 + 4.0 * f64::EPSILON * (n + self.plays.len()) as f64;
        (low.is_finite() && high.is_finite()).then_some([low * widened, high * widened])
    }

    /// Where the mechanism stays, or would stay with what is known of how far dimensions are off, about a pose that was taken, and whose factors are at hand; none where no bound contracts.
    pub fn region(&mut self, stand: &Stand) -> Option<Region> {
        let inverse = self.inverse();
        let extents = &self.extents;
        let straight = self.straight(stand, &inverse);
        let image = |x: &[f64], loose: &Loose, by: fn(&Change) -> f64| {
            let mut rows = loose.gaps.clone();
            for (entry, change) in self.driven.system.entries.iter().zip(&loose.changes) {
                if let Some(column) = entry.column() {
                    rows[entry.row as usize] += by(change) * x[column as usize];
                }
            }
            inverse.widen(&straight, &rows, x)
        };
        let pass = |x: &[f64]| image(x, &self.within(stand, extents, x), |by| by.mean);
        let mut x = straight.clone();
        for (attempt, widening) in WIDENINGS.into_iter().enumerate() {
            for _ in 0..if attempt == 0 { 1 } else { PASSES } {
                x = pass(&x);
            }
            let wide: Vec<f64> = x.iter().map(|x| x * widening).collect();
            let loose = self.within(stand, extents, &wide);
            let next = image(&wide, &loose, |by| by.mean);
            if !is_inside(&next, &wide) {
                continue;
            }
            let most = image(&wide, &loose, |by| by.most);
            let mut ends = most.iter().zip(&straight).zip(&wide);
            if !ends.all(|((most, straight), x)| most - straight < *x || *x == 0.0) {
                continue;
            }
            if widening < NARROW {
                return Some(self.region_of(next, loose));
            }
            let mut x = next;
            for _ in 0..REFINEMENTS {
                x = pass(&x);
            }
            let loose = self.within(stand, extents, &x);
            return Some(self.region_of(x, loose));
        }
        None
    }

    fn within(&self, stand: &Stand, extents: &Extents, x: &[f64]) -> Loose {
        let system = self.driven.system;
        let mut gaps = vec![0.0; system.m()];
        self.loose(stand, extents, x, &mut gaps);
        Loose {
            changes: changes(system, &self.here(stand).at, &Radii { system, x }),
            gaps,
        }
    }

    fn region_of(&self, x: Vec<f64>, loose: Loose) -> Region {
        let Loose { changes, mut gaps } = loose;
        let phi = &self.driven.evaluation.phi;
        for (row, (gap, phi)) in gaps.iter_mut().zip(phi).enumerate() {
            let scale = self.driven.system.row_scale(row);
            *gap += phi.abs() + 8.0 * f64::EPSILON * scale;
        }
        Region {
            x,
            changes,
            rows: gaps,
        }
    }
}

/// Whether a bound lies within another one.
fn is_inside(inner: &[f64], outer: &[f64]) -> bool {
    inner
        .iter()
        .zip(outer)
        .all(|(inner, outer)| inner < outer || (*inner == 0.0 && *outer == 0.0))
}
