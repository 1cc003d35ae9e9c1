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
//! Each coordinate is an output whose load is its row of C, so that |C e| is its reach to first order. |J̄ − J₀| is bounded entry by
//! entry (`changes`). The matrix J is regular for all |Δq| ≤ X where the same bound without the mean contracts; so the way from the
//! nominal position never branches within X. Sums are widened by their rounding.
//!
//! (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, 1990, ch. 5.)

use super::changes::Changes;
use super::displaced::{Asked, Mechanism};
use super::output::{Load, Output};
use super::poses::NominalPose;
use super::source::Pair;
use linkdyn_engine::element::Kinematics;
use linkdyn_linear::math::Vec2;

/// Widenings of X that are tried: near a singular position X has to be much wider than what follows from it.
const WIDENINGS: [f64; 5] = [1.001, 1.02, 1.2, 1.6, 2.5];
/// Passes before a wider X is tried, and refinements of one that holds: each coordinate finds its own width.
const PASSES: usize = 4;
/// What widens sums by more than their rounding.
const WIDENED: f64 = 1.0 + 1e-12;
/// Bounds of what rows change: in the mean along the way, and anywhere on it.
const MEAN: usize = 0;
const ANYWHERE: usize = 1;
/// Products and their sums are off by this part of their sizes, before there are many.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// What encloses a mechanism at its poses.
pub(super) struct Enclosure {
    changes: Changes,
    /// C by rows (n × m), and |I − C J₀| by rows (n × n) with its rounding.
    inverse: Vec<f64>,
    residual: Vec<f64>,
    /// |φ| and its rounding at the pose (m).
    off: Vec<f64>,
    /// |C e| and |C||φ₀| (n).
    straight: Vec<f64>,
}

/// Where the mechanism stays under all deviations: |Δq| ≤ X.
pub(super) struct Region {
    /// X (n).
    x: Vec<f64>,
    /// Bounds (m) of what φ, gaps and J Δq are off at the pose, and change on the way.
    rows: Vec<f64>,
}

impl Enclosure {
    pub fn new(mechanism: &Mechanism) -> Enclosure {
        let system = mechanism.driven.system;
        let (n, m) = (system.n(), system.m());
        Enclosure {
            changes: Changes::new(system, mechanism.question),
            inverse: vec![0.0; n * m],
            residual: vec![0.0; n * n],
            off: vec![0.0; m],
            straight: vec![0.0; n],
        }
    }

    /// Where the mechanism stays, or would stay with what is known of how far dimensions are off, about a pose that was taken, and
    /// whose factors are at hand; `None` if no bound contracts.
    pub fn region(&mut self, mechanism: &mut Mechanism, stand: &NominalPose) -> Option<Region> {
        if self.changes.are_unbounded {
            return None;
        }
        self.changes
            .take(&mechanism.here(stand), mechanism.dimensions);
        self.take(mechanism, stand);
        self.contract()
    }

    /// Takes C and what follows from it to first order.
    fn take(&mut self, mechanism: &mut Mechanism, stand: &NominalPose) {
        let system = mechanism.driven.system;
        let (n, m) = (system.n(), system.m());
        let phi = &mechanism.driven.evaluation.phi;
        for (row, (off, phi)) in self.off.iter_mut().zip(phi).enumerate() {
            *off = phi.abs() + 8.0 * f64::EPSILON * system.row_scale(row);
        }
        let mut g: Vec<Pair> = vec![[0.0; 2]; mechanism.sources.len()];
        let mut load = Load {
            lambda: vec![0.0; m],
            size: 0.0,
        };
        self.inverse.fill(0.0);
        mechanism.driven.inverse(&mut self.inverse);
        self.residual.fill(0.0);
        let mut sizes = vec![0.0; n];
        let rounding = ROUNDING + m as f64 * f64::EPSILON;
        for column in 0..n {
            load.lambda
                .copy_from_slice(&self.inverse[column * m..][..m]);
            mechanism.influences_of(stand, &[None, None], &load, &mut g);
            let sources = mechanism.sources.iter().zip(&g);
            let reach = sources.map(|(source, g)| {
                let [down, up] = source.room.reach(*g);
                up.max(-down)
            });
            let off = self.off.iter().zip(&load.lambda);
            let off: f64 = off.map(|(off, c)| off * c.abs()).sum();
            self.straight[column] = (reach.sum::<f64>() + off) * WIDENED;
            sizes.fill(0.0);
            let residual = &mut self.residual[column * n..][..n];
            residual[column] = 1.0;
            let jacobian = &mechanism.driven.evaluation.jacobian;
            for (entry, value) in system.entries.iter().zip(jacobian) {
                if let Some(other) = entry.column() {
                    let product = load.lambda[entry.row as usize] * value;
                    residual[other as usize] -= product;
                    sizes[other as usize] += product.abs();
                }
            }
            for (residual, size) in residual.iter_mut().zip(&sizes) {
                *residual = residual.abs() + rounding * size;
            }
        }
    }

    /// The region that is found, if any is.
    fn contract(&self) -> Option<Region> {
        let mut x = self.straight.clone();
        for widening in WIDENINGS {
            for _ in 0..PASSES {
                x = self.image(&self.changes.rows(&x), MEAN);
            }
            let wide: Vec<f64> = x.iter().map(|x| x * widening).collect();
            let rows = self.changes.rows(&wide);
            let [mut next, mut most] = [MEAN, ANYWHERE].map(|kind| self.image(&rows, kind));
            for (k, left) in self.left(&wide).enumerate() {
                next[k] += left;
                most[k] += left - self.straight[k];
            }
            if is_inside(&next, &wide) && is_inside(&most, &wide) {
                return Some(self.narrowed(next));
            }
        }
        None
    }

    /// What follows from |Δq| ≤ X by what rows change, in the mean along the way or anywhere on it; but for what C leaves.
    fn image(&self, rows: &[[f64; 2]], kind: usize) -> Vec<f64> {
        let each = self.straight.iter().zip(self.inverse.chunks(rows.len()));
        let image = each.map(|(straight, c)| {
            let of_row = |sum: f64, (c, row): (&f64, &[f64; 2])| sum + c.abs() * row[kind];
            c.iter().zip(rows).fold(*straight, of_row) * WIDENED
        });
        image.collect()
    }

    /// What C leaves of each coordinate for |Δq| ≤ X.
    fn left(&self, x: &[f64]) -> impl Iterator<Item = f64> {
        self.residual.chunks(x.len()).map(move |residual| {
            let left: f64 = residual.iter().zip(x).map(|(left, x)| left * x).sum();
            left * WIDENED
        })
    }

    /// The region of an X that holds, which what follows from it makes narrower.
    fn narrowed(&self, mut x: Vec<f64>) -> Region {
        for _ in 0..PASSES {
            let mut next = self.image(&self.changes.rows(&x), MEAN);
            next.iter_mut()
                .zip(self.left(&x))
                .for_each(|(next, left)| *next += left);
            x = next;
        }
        let rows = self.changes.rows(&x);
        let rows = rows
            .iter()
            .zip(&self.off)
            .map(|([mean, _], off)| mean + off);
        Region {
            rows: rows.collect(),
            x,
        }
    }

    /// The bound of the output's deviations to both sides, least and greatest, with its load and reach to first order, within a
    /// region of the pose; `None` if it is not finite. The pose was taken.
    pub fn bound(
        &self,
        mechanism: &mut Mechanism,
        of: Asked,
        (load, reach): (&Load, [f64; 2]),
        region: &Region,
    ) -> Option<[f64; 2]> {
        mechanism.question.slack.as_ref()?;
        let system = mechanism.driven.system;
        mechanism.gradient(of);
        let x = &region.x;
        let at = mechanism.driven.evaluation.kinematics(&of.stand.inputs);
        let mut change = vec![0.0; x.len()];
        of.output
            .gradient_change(&at, &system.layout, x, &mut change);
        // (|∂y₀ − λᵀJ₀| + |∂ȳ − ∂y₀|) X
        let mut carried = vec![[0.0; 2]; x.len()];
        let jacobian = &mechanism.driven.evaluation.jacobian;
        for (entry, value) in system.entries.iter().zip(jacobian) {
            if let Some(column) = entry.column() {
                let product = load.lambda[entry.row as usize] * value;
                let [sum, size] = &mut carried[column as usize];
                (*sum, *size) = (*sum + product, *size + product.abs());
            }
        }
        let rounding = ROUNDING + system.m() as f64 * f64::EPSILON;
        let mut lean = 0.0;
        for (column, [carried, size]) in carried.into_iter().enumerate() {
            let slope = mechanism.gradient[column];
            let rounded = rounding * (slope.abs() + size);
            lean += ((slope - carried).abs() + rounded + change[column]) * x[column];
        }
        // |λ|(|φ₀| + |J̄ − J₀| X)
        let rows = load.lambda.iter().zip(&region.rows);
        lean += rows.map(|(lambda, row)| lambda.abs() * row).sum::<f64>();
        lean += self.own_points(&at, of.output, mechanism, x);
        let (low, high) = (reach[0] - lean, reach[1] + lean);
        let sums = (system.n() + mechanism.sources.len()) as f64;
        let widened = 1.0 + 1e-13 + 4.0 * f64::EPSILON * sums;
        (low.is_finite() && high.is_finite()).then_some([low * widened, high * widened])
    }

    /// What the output's own points add to its deviation beyond the first order.
    fn own_points(&self, at: &Kinematics, output: &Output, of: &Mechanism, x: &[f64]) -> f64 {
        let (places, span) = match output {
            Output::Angle(_) => return 0.0,
            Output::Coordinate(place, _) => ([Some(place), None], f64::INFINITY),
            Output::Distance(from, to) => {
                let span = to.marker.place(at) - from.marker.place(at);
                ([Some(from), Some(to)], span.norm())
            }
        };
        let layout = &of.driven.system.layout;
        let (mut own_beyond, mut total, mut turn, mut moved) = (0.0, 0.0, 0.0_f64, 0.0);
        for place in places.into_iter().flatten() {
            if let Some(point) = place.point {
                let [off, beyond] = self.changes.points[point.0];
                total += off + beyond;
                own_beyond += beyond;
            }
            if let Some(columns) = layout.columns(place.marker.body) {
                let angle = x[columns.theta()];
                turn = turn.max(angle);
                moved += Vec2::new(x[columns.x()], x[columns.y()]).norm();
                moved += place.marker.s.norm() * angle;
            }
        }
        own_beyond + total * turn + 2.0 * total * (moved + total) / span
    }
}

/// Whether a bound lies within another one.
fn is_inside(inner: &[f64], outer: &[f64]) -> bool {
    let mut each = inner.iter().zip(outer);
    each.all(|(inner, outer)| inner < outer || (*inner <= 0.0 && *outer == 0.0))
}
