//! Coefficients of Radau IIA with three stages, and the transformation that takes its stages apart.
//!
//! ```text
//! Z = h A F       stages y + Zᵢ with slopes F
//! A⁻¹ T = T Λ     Λ = [γ 0 0; 0 α β; 0 −β α]
//! ```
//!
//! Source: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., Springer 1996, §IV.5 (method)
//! and §IV.8 (transformation, estimate). All are numbers without unit.

/// √6.
const ROOT: f64 = 2.449_489_742_783_178;

/// Abscissae, in steps.
pub(super) const C: [f64; 3] = [(4.0 - ROOT) / 10.0, (4.0 + ROOT) / 10.0, 1.0];

/// Eigenvalues of A⁻¹: γ, α ± iβ.
pub(super) const GAMMA: f64 = 3.637834252744496;
pub(super) const ALPHA: f64 = 2.6810828736277523;
pub(super) const BETA: f64 = 3.0504301992474105;

pub(super) const T: [[f64; 3]; 3] = [
    [
        0.09443876248897524,
        -0.1412552950209542,
        0.03002919410514742,
    ],
    [0.2502131229653333, 0.20412935229379994, -0.3829421127572619],
    [1.0, 1.0, 0.0],
];

pub(super) const T_INVERSE: [[f64; 3]; 3] = [
    [4.178718591551904, 0.32768282076106237, 0.5233764454994495],
    [
        -4.178718591551904,
        -0.32768282076106237,
        0.47662355450055044,
    ],
    [0.5028726349457868, -2.571926949855605, 0.5960392048282249],
];

/// Weights of the stages in the estimate: (γ/h − J) e = f(t, y) + Σ Eᵢ Zᵢ / h.
pub(super) const E: [f64; 3] = [
    (-13.0 - 7.0 * ROOT) / 3.0,
    (-13.0 + 7.0 * ROOT) / 3.0,
    -1.0 / 3.0,
];

#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = [[f64; 3]; 3];

    const A: Matrix = [
        [
            (88.0 - 7.0 * ROOT) / 360.0,
            (296.0 - 169.0 * ROOT) / 1800.0,
            (-2.0 + 3.0 * ROOT) / 225.0,
        ],
        [
            (296.0 + 169.0 * ROOT) / 1800.0,
            (88.0 + 7.0 * ROOT) / 360.0,
            (-2.0 - 3.0 * ROOT) / 225.0,
        ],
        [(16.0 - ROOT) / 36.0, (16.0 + ROOT) / 36.0, 1.0 / 9.0],
    ];

    fn product(a: &Matrix, b: &Matrix) -> Matrix {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
    }

    fn near(a: &Matrix, b: &Matrix) {
        for (a, b) in a.as_flattened().iter().zip(b.as_flattened()) {
            assert!((a - b).abs() < 1e-14, "{a} is not {b}");
        }
    }

    #[test]
    fn transformation_takes_the_stages_apart() {
        near(
            &product(&T, &T_INVERSE),
            &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        );
        let eigen = [[GAMMA, 0.0, 0.0], [0.0, ALPHA, BETA], [0.0, -BETA, ALPHA]];
        near(&product(&A, &product(&T, &eigen)), &T);
    }

    /// Σ aᵢⱼ cⱼᵏ = cᵢ^(k+1) / (k+1) for collocation with three stages, and quadrature of order 5.
    #[test]
    fn order_conditions_hold() {
        for k in 0..5 {
            let sums = A.map(|row| {
                row.iter()
                    .zip(C)
                    .map(|(a, c)| a * f64::powi(c, k))
                    .sum::<f64>()
            });
            for (i, (sum, c)) in sums.into_iter().zip(C).enumerate() {
                if k < 3 || i == 2 {
                    assert!((sum - c.powi(k + 1) / f64::from(k + 1)).abs() < 1e-15);
                }
            }
        }
    }

    /// The estimate vanishes for y′ = tᵏ, k up to 2: f(0) + Σ Eᵢ Zᵢ = 0 with Zᵢ = cᵢ^(k+1) / (k+1).
    #[test]
    fn estimate_is_of_order_3() {
        let estimate = |k: i32| -> f64 {
            E.iter()
                .zip(C)
                .map(|(e, c)| e * c.powi(k + 1) / f64::from(k + 1))
                .sum()
        };
        assert!((1.0 + estimate(0)).abs() < 1e-14);
        assert!(estimate(1).abs() < 1e-14 && estimate(2).abs() < 1e-14);
        assert!(estimate(3).abs() > 1e-3);
    }
}
