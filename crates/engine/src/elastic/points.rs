//! The mass points that move as an elastic link does.
//!
//! With complex numbers for vectors, z = R + e^{iθ} (X + Σ Φ_i q_i), the kinetic energy of a link is ½ ẇ* H ẇ with
//! w = (R, e^{iθ}, e^{iθ} q_i) and the Hermitian matrix of the functions 1, X, Φ_i:
//!
//! ```text
//! H = [ m          ∫ρ X          ∫ρ Φ_j              ]        ∫ρ X̄ Φ_j = ∫ρ X·Φ_j + i ∫ρ X × Φ_j
//!     [            ∫ρ |X|²       ∫ρ X̄ Φ_j            ]
//!     [ Hermitian                M_ij + i ∫ρ Φ_i×Φ_j ]
//! ```
//!
//! Every W with W* W = H is one link by n + 2 points: point p of mass μ stands at X_p = W_p1/√μ and moves by Φ_pi = W_pi/√μ, as long as
//! W_p0 = √μ, which a unitary matrix makes of any W. Points of equal mass μ = m/(n + 2) are as good as others.
//! Γ of the points solves W* (√μ Γ) = ∫ρ (1, X̄, Φ̄_k) Γ_ij, so that all integrals with the first-order displacements are exact.

use super::{CarriedPoint, Modal};
use linkdyn_linear::math::Vec2;
use nalgebra::{Complex, DMatrix, DVector};

type Matrix = DMatrix<Complex<f64>>;

/// Mass points that move as a link does: the mass of each \[kg\], and how they move. `None` where the integrals belong to no body.
pub fn points(link: &Modal) -> Option<(f64, Vec<CarriedPoint>)> {
    let n = link.count();
    let count = n + 2;
    let h = gram(link);
    // Of comparable size: kg for all columns.
    let scale: Vec<f64> = (0..count).map(|k| h[(k, k)].re.sqrt()).collect();
    if scale.iter().any(|s| *s <= 0.0 || !s.is_finite()) {
        return None;
    }
    let scaled = Matrix::from_fn(count, count, |i, j| h[(i, j)] / (scale[i] * scale[j]));
    let root = scaled.cholesky()?.l().adjoint();
    // Of a matrix that is not positive a root is imaginary, or nearly none.
    if root.diagonal().iter().any(|d| d.re <= 1e-9 || d.im != 0.0) {
        return None;
    }
    let mass = h[(0, 0)].re / count as f64;
    let mut w = turned(&root);
    for (k, scale) in scale.iter().enumerate() {
        w.column_mut(k).scale_mut(*scale);
    }
    let second = second_order(link, &w)?;
    let by = mass.sqrt();
    let vector = |z: Complex<f64>| Vec2::new(z.re / by, z.im / by);
    let found = (0..count).map(|p| CarriedPoint {
        place: vector(w[(p, 1)]),
        moves: (0..n).map(|i| vector(w[(p, i + 2)])).collect(),
        turns: vec![0.0; n],
        shortens: second
            .iter()
            .map(|row| row.iter().map(|own| vector(own[p])).collect())
            .collect(),
    });
    Some((mass, found.collect()))
}

/// H
fn gram(link: &Modal) -> Matrix {
    let (mass, first, inertia) = link.rigid;
    let [matrix, ..] = &link.matrices;
    let complex = |v: Vec2| Complex::new(v.x, v.y);
    let upper = |i: usize, j: usize| match (i, j) {
        (0, 0) => Complex::from(mass),
        (0, 1) => complex(first),
        (1, 1) => Complex::from(inertia),
        (0, j) => complex(link.momentum[j - 2]),
        (1, j) => Complex::new(link.moments[0][j - 2], link.moments[1][j - 2]),
        (i, j) => Complex::new(matrix[(i - 2, j - 2)], link.gyroscopic[(i - 2, j - 2)]),
    };
    let count = link.count() + 2;
    Matrix::from_fn(count, count, |i, j| match i <= j {
        true => upper(i, j),
        false => upper(j, i).conj(),
    })
}

/// The same W, turned so that the entries of its first column are equal and real: a reflection of that column on the wanted one.
fn turned(w: &Matrix) -> Matrix {
    let count = w.nrows();
    let first = w.column(0).into_owned();
    let wanted = DVector::repeat(count, Complex::from(first.norm() / (count as f64).sqrt()));
    // A reflection keeps first* wanted real; the phase sees to that.
    let product = wanted.dotc(&first);
    let phase = match product.norm() > 0.0 {
        true => product / product.norm(),
        false => Complex::from(1.0),
    };
    let normal = &first - &wanted * phase;
    let square = normal.norm_squared();
    let reflected = match square > 0.0 {
        true => w - (&normal * (normal.adjoint() * w)) * Complex::from(2.0 / square),
        false => w.clone(),
    };
    reflected * phase.conj()
}

/// √μ Γ_ij of the points, by i and j; empty where nothing shortens.
fn second_order(link: &Modal, w: &Matrix) -> Option<Vec<Vec<DVector<Complex<f64>>>>> {
    let n = link.count();
    let Some(second) = &link.second else {
        return Some(Vec::new());
    };
    let solver = w.adjoint().lu();
    (0..n)
        .map(|i| {
            let of = |j: usize| {
                let mut right = DVector::zeros(n + 2);
                right[0] = Complex::from(second.rigid[0][(i, j)]);
                right[1] = Complex::from(second.rigid[1][(i, j)]);
                for (k, [dot, cross]) in second.bent.iter().enumerate() {
                    right[k + 2] = Complex::new(dot[(i, j)], cross[(i, j)]);
                }
                solver.solve(&right)
            };
            (0..n).map(of).collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ of products of two displacement functions, from the points.
    fn products(
        mass: f64,
        points: &[CarriedPoint],
        f: &dyn Fn(&CarriedPoint) -> Vec2,
        g: &dyn Fn(&CarriedPoint) -> Vec2,
    ) -> [f64; 2] {
        let terms = points.iter().map(|p| (f(p), g(p)));
        terms.fold([0.0; 2], |[dot, cross], (f, g)| {
            [dot + mass * f.dot(&g), cross + mass * f.perp(&g)]
        })
    }

    #[test]
    fn points_have_the_integrals_of_the_link() {
        let link = Modal {
            rigid: (2.0, Vec2::new(1.1, -0.2), 1.5),
            matrices: [
                DMatrix::from_row_slice(2, 2, &[1.3, 0.2, 0.2, 0.9]),
                DMatrix::identity(2, 2),
                DMatrix::zeros(2, 2),
            ],
            momentum: vec![Vec2::new(0.1, 1.0), Vec2::new(0.3, -0.1)],
            moments: [vec![0.05, 0.3], vec![0.6, -0.2]],
            gyroscopic: DMatrix::from_row_slice(2, 2, &[0.0, 0.15, -0.15, 0.0]),
            second: Some(SecondOrder {
                rigid: [
                    DMatrix::from_row_slice(2, 2, &[-1.0, 0.2, 0.2, -2.0]),
                    DMatrix::from_row_slice(2, 2, &[-0.7, 0.1, 0.1, -1.2]),
                ],
                bent: vec![
                    [
                        DMatrix::zeros(2, 2),
                        DMatrix::from_row_slice(2, 2, &[0.3, 0.0, 0.0, -0.4]),
                    ],
                    [DMatrix::zeros(2, 2), DMatrix::zeros(2, 2)],
                ],
            }),
        };
        let (mass, points) = points(&link).expect("a body");
        let one = |_: &CarriedPoint| Vec2::x();
        let place = |p: &CarriedPoint| p.place;
        let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
            assert!(
                (a - c).abs() < 1e-12 && (b - d).abs() < 1e-12,
                "{a} {b}, {c} {d}"
            );
        };
        let of = |f: &dyn Fn(&CarriedPoint) -> Vec2, g: &dyn Fn(&CarriedPoint) -> Vec2| {
            products(mass, &points, f, g)
        };
        near(of(&one, &one), [2.0, 0.0]);
        near(of(&one, &place), [1.1, -0.2]);
        near(of(&place, &place), [1.5, 0.0]);
        for i in 0..2 {
            let shape = |p: &CarriedPoint| p.moves[i];
            near(of(&one, &shape), link.momentum[i].into());
            near(of(&place, &shape), [link.moments[0][i], link.moments[1][i]]);
            for j in 0..2 {
                let other = |p: &CarriedPoint| p.moves[j];
                let known = [link.matrices[0][(i, j)], link.gyroscopic[(i, j)]];
                near(of(&shape, &other), known);
                let shortened = |p: &CarriedPoint| p.shortens[i][j];
                let second = link.second.as_ref().expect("second order");
                near(of(&one, &shortened), [second.rigid[0][(i, j)], 0.0]);
                near(of(&place, &shortened), [second.rigid[1][(i, j)], 0.0]);
                let first = |p: &CarriedPoint| p.moves[0];
                near(of(&first, &shortened), [0.0, second.bent[0][1][(i, j)]]);
            }
        }
        // What is not positive belongs to no body.
        let heavier = Modal {
            rigid: (0.1, link.rigid.1, link.rigid.2),
            ..link.clone()
        };
        assert!(super::points(&heavier).is_none());
    }

    use super::super::SecondOrder;
}
