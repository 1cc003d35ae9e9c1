//! The equations of a path, and how their roots move with the points.

use super::unknowns::{Displacements, Unknowns};
use linkdyn_linear::bilinear::Number;
use nalgebra::{SMatrix, SVector};

type Matrix = SMatrix<Number, 8, 8>;
type Column = SVector<Number, 8>;

/// First corrections of steps that are taken, in parts of the size.
const NEAR: f64 = 1e-4;
/// The second correction in parts of the first.
const FASTER: f64 = 0.1;
/// Corrections as small as this need not become smaller: round-off of the equations where they are badly conditioned.
const NOISE: f64 = 1e-8;
/// Corrections after which there is no other: what is left is their square. The slope is that before the last one.
const ENOUGH: f64 = 1e-7;
/// Corrections below this part of the size are round-off.
const ROUND_OFF: f64 = 1e-13;
/// Largest and smallest step.
const LONGEST: f64 = 0.1;
const SHORTEST: f64 = 1e-9;
const MOST_STEPS: usize = 20_000;
/// Larger roots are at infinity.
const LARGEST: f64 = 1e7;
/// What ends nearer than this to the target ended in a singular root.
const AT_END: f64 = 1e-2;

/// Where a path ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// A regular root.
    Root(Unknowns),
    /// At infinity, or where roots meet.
    Singular,
    /// It could not be followed.
    Lost,
}

/// Values, and derivatives by the unknowns and along a change of the points.
struct PathRows {
    values: Column,
    jacobian: Matrix,
    along: Column,
}

/// One row, each of its terms with the derivatives by x, x̄, a, ā, y, ȳ, b, b̄.
fn rows(z: &Column, points: &Displacements, change: Option<&Displacements>) -> PathRows {
    let [x, xx, a, aa] = [z[0], z[1], z[2], z[3]];
    let [y, yy, b, bb] = [z[4], z[5], z[6], z[7]];
    let mut all = PathRows {
        values: Column::zeros(),
        jacobian: Matrix::zeros(),
        along: Column::zeros(),
    };
    for (j, &[d, dd]) in points.iter().enumerate() {
        let (da, dda, db, ddb) = (d - a, dd - aa, d - b, dd - bb);
        let (p, pp) = (x * dda, xx * da);
        let c = d * dd - d * aa - dd * a + x * aa + xx * a;
        let (q, qq) = (y * ddb, yy * db);
        let e = d * dd - d * bb - dd * b + y * bb + yy * b;
        let det = p * qq - pp * q;
        let (m, n) = (e * pp - c * qq, q * c - p * e);
        all.values[j] = m * n - det * det;
        // ∂/∂p, ∂/∂p̄, ∂/∂c, and the same of the other dyad
        let two = det * 2.0;
        let by = [
            -m * e - two * qq,
            n * e + two * q,
            -n * qq + m * q,
            m * c + two * pp,
            -n * c - two * p,
            n * pp - m * p,
        ];
        let [bp, bpp, bc, bq, bqq, be] = by;
        let row = [
            bp * dda + bc * aa,
            bpp * da + bc * a,
            -bpp * xx + bc * (xx - dd),
            -bp * x + bc * (x - d),
            bq * ddb + be * bb,
            bqq * db + be * b,
            -bqq * yy + be * (yy - dd),
            -bq * y + be * (y - d),
        ];
        for (i, own) in row.into_iter().enumerate() {
            all.jacobian[(j, i)] = own;
        }
        if let Some(change) = change {
            let by_d = bpp * xx + bc * dda + bqq * yy + be * ddb;
            let by_dd = bp * x + bc * da + bq * y + be * db;
            all.along[j] = by_d * change[j][0] + by_dd * change[j][1];
        }
    }
    // PathRows differ by the sizes of points: by the fourth power.
    for j in 0..8 {
        let size = all.jacobian.row(j).iter().map(|v| v.norm()).sum::<f64>();
        if size > 0.0 {
            let by = Number::from(1.0 / size);
            all.jacobian.row_mut(j).scale_mut(1.0 / size);
            all.values[j] *= by;
            all.along[j] *= by;
        }
    }
    all
}

/// Newton's correction, its size by that of the unknowns, and how the root moves with the points, dz/ds.
struct Correction {
    step: Column,
    size: f64,
    slope: Column,
}

fn correction(
    z: &Column,
    points: &Displacements,
    change: Option<&Displacements>,
) -> Option<Correction> {
    let rows = rows(z, points, change);
    let factors = rows.jacobian.lu();
    let step = factors.solve(&rows.values)?;
    let size = step.norm() / z.norm();
    let slope = match change {
        Some(_) => -factors.solve(&rows.along)?,
        None => rows.along,
    };
    size.is_finite().then_some(Correction { step, size, slope })
}

/// A root brought to round-off.
pub fn polished(rough: Unknowns, points: &Displacements) -> Option<Unknowns> {
    let mut z = Column::from(rough);
    let mut last = f64::INFINITY;
    for _ in 0..20 {
        let Correction { step, size, .. } = correction(&z, points, None)?;
        z -= step;
        if size <= ROUND_OFF || size >= last && size <= 1e-9 {
            return Some(z.into());
        }
        last = size;
    }
    None
}

fn between(from: &Displacements, to: &Displacements, s: f64) -> Displacements {
    std::array::from_fn(|j| std::array::from_fn(|i| from[j][i] * (1.0 - s) + to[j][i] * s))
}

/// Follows a root as the points move along straight lines.
pub fn follow(root: Unknowns, from: &Displacements, to: &Displacements) -> End {
    let change: Displacements =
        std::array::from_fn(|j| std::array::from_fn(|i| to[j][i] - from[j][i]));
    let (mut s, mut step) = (0.0_f64, 0.01_f64);
    let mut z = Column::from(root);
    let Some(Correction { mut slope, .. }) = correction(&z, from, Some(&change)) else {
        return End::Lost;
    };
    // The point before, its slope, and how far back it is.
    let mut before: Option<(Column, Column, f64)> = None;
    for _ in 0..MOST_STEPS {
        let length = step.min(1.0 - s);
        let guess = match &before {
            None => z + slope * Number::from(length),
            Some((old, bend, back)) => hermite((old, bend), (&z, &slope), *back, length),
        };
        let points = between(from, to, s + length);
        match corrected(guess, &points, &change) {
            Some((next, first, own)) => {
                let is_end = s + length >= 1.0;
                if is_end {
                    return match polished(next.into(), to) {
                        Some(root) if is_regular(&root, to) => End::Root(root),
                        _ => End::Singular,
                    };
                }
                before = Some((z, slope, length));
                (z, slope, s) = (next, own, s + length);
                // The error grows as the fourth power of the step.
                let grow = (0.2 * NEAR / first.max(1e-3 * NEAR)).powf(0.25);
                step = (length * grow.clamp(0.5, 2.0)).min(LONGEST);
            }
            None => step = 0.4 * length,
        }
        if z.norm() > LARGEST || step < SHORTEST {
            return if 1.0 - s < AT_END {
                End::Singular
            } else {
                End::Lost
            };
        }
    }
    End::Lost
}

/// The cubic through two points with their slopes, beyond the second.
fn hermite(old: (&Column, &Column), new: (&Column, &Column), back: f64, ahead: f64) -> Column {
    let t = 1.0 + ahead / back;
    let (t2, t3) = (t * t, t * t * t);
    let weight = |w: f64| Number::from(w);
    old.0 * weight(2.0 * t3 - 3.0 * t2 + 1.0)
        + old.1 * weight((t3 - 2.0 * t2 + t) * back)
        + new.0 * weight(3.0 * t2 - 2.0 * t3)
        + new.1 * weight((t3 - t2) * back)
}

/// Corrected, the size of the first correction, and the slope; `None` if the step was too long.
fn corrected(
    mut z: Column,
    points: &Displacements,
    change: &Displacements,
) -> Option<(Column, f64, Column)> {
    let Correction {
        step,
        size: first,
        mut slope,
    } = correction(&z, points, Some(change))?;
    if first > NEAR {
        return None;
    }
    z -= step;
    let mut last = first;
    for _ in 0..3 {
        if last <= ENOUGH {
            break;
        }
        let next = correction(&z, points, Some(change))?;
        if next.size > (FASTER * last).max(NOISE) {
            return None;
        }
        z -= next.step;
        (last, slope) = (next.size, next.slope);
    }
    Some((z, first, slope))
}

/// Whether the Jacobian is regular, its columns measured by the unknowns.
fn is_regular(root: &Unknowns, points: &Displacements) -> bool {
    let z = Column::from(*root);
    let values = rows(&z, points, None).jacobian.singular_values();
    values.min() > 1e-11 * values.max() && z.norm() < LARGEST
}
