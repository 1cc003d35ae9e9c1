//! Elastic links by few amplitudes: u = X + Σ Φ_i q_i + ½ Σ Γ_ij q_i q_j in a frame that goes along.
//!
//! A link is described by its matrices and inertia integrals ([`Modal`]), of a bar by its shapes ([`shapes`]). As far as its inertia goes it
//! is n + 2 mass points ([`points`]), so that mass matrices stay constant and all coupling terms follow from the geometry of the points.
//! (Shabana, Dynamics of Multibody Systems, 2013, ch. 5; Schwertassek and Wallrapp, Dynamik flexibler Mehrkörpersysteme, 1999.)

pub mod points;
pub mod shapes;

use linkdyn_linear::math::Vec2;
use nalgebra::DMatrix;

/// How a point of a link moves by the amplitudes (n), in the axes of its frame.
#[derive(Debug, Clone, PartialEq)]
pub struct CarriedPoint {
    /// X \[m\], from the frame's origin.
    pub place: Vec2,
    /// Φ_i [–].
    pub moves: Vec<Vec2>,
    /// How its section turns [rad/m].
    pub turns: Vec<f64>,
    /// Γ (n × n) [1/m]; empty where it does not shorten.
    pub shortens: Vec<Vec<Vec2>>,
}

/// Inertia integrals of the second-order displacements of a link, by pairs of amplitudes (n × n).
#[derive(Debug, Clone, PartialEq)]
pub struct SecondOrder {
    /// ∫ρ Γ_ij and ∫ρ X·Γ_ij, along the axis.
    pub rigid: [DMatrix<f64>; 2],
    /// ∫ρ Φ_k·Γ_ij and ∫ρ Φ_k × Γ_ij, by k.
    pub bent: Vec<[DMatrix<f64>; 2]>,
}

/// A link by its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Modal {
    /// Mass \[kg\], first moment [kg·m] and moment of inertia about the frame's origin [kg·m²], where it is not deflected.
    pub rigid: (f64, Vec2, f64),
    /// M, K and D (n × n).
    pub matrices: [DMatrix<f64>; 3],
    /// ∫ρ Φ_i.
    pub momentum: Vec<Vec2>,
    /// ∫ρ X·Φ_i and ∫ρ X × Φ_i.
    pub moments: [Vec<f64>; 2],
    /// ∫ρ Φ_i × Φ_j (n × n).
    pub gyroscopic: DMatrix<f64>,
    /// Of bars that bend.
    pub second: Option<SecondOrder>,
}

impl Modal {
    /// Number of amplitudes.
    pub fn count(&self) -> usize {
        self.momentum.len()
    }

    /// Slowest and fastest frequency [rad/s].
    pub fn frequencies(&self) -> [f64; 2] {
        let [mass, stiffness, _] = &self.matrices;
        let all = generalised(stiffness, mass);
        let of = |k: Option<&f64>| k.map_or(0.0, |square| square.max(0.0).sqrt());
        all.map_or([0.0; 2], |(squares, _)| {
            let all = squares.as_slice();
            [of(all.first()), of(all.last())]
        })
    }

    /// Adds damping by a ratio ζ of each mode: D = M V diag(2 ζ ω) Vᵀ M with Vᵀ M V = 1, Vᵀ K V = diag(ω²).
    pub fn damp(&mut self, ratio: f64) {
        let [mass, stiffness, damping] = &mut self.matrices;
        let Some((squares, shapes)) = generalised(stiffness, mass) else {
            return;
        };
        let rates = squares.map(|square| 2.0 * ratio * square.max(0.0).sqrt());
        let heavy = &*mass * shapes;
        *damping += &heavy * DMatrix::from_diagonal(&rates) * heavy.transpose();
    }
}

/// Eigenvalues λ, ascending, and vectors V with Vᵀ M V = 1 of K v = λ M v, K symmetric and M positive definite; by 1/λ where K is
/// positive definite too, for the digits of the small ones.
pub fn generalised(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
) -> Option<(nalgebra::DVector<f64>, DMatrix<f64>)> {
    let by = |root: &DMatrix<f64>, inner: &DMatrix<f64>| {
        let half = root.solve_lower_triangular(inner)?;
        let whole = root.solve_lower_triangular(&half.transpose())?;
        let eigen = ((&whole + whole.transpose()) * 0.5).symmetric_eigen();
        let vectors = root
            .transpose()
            .solve_upper_triangular(&eigen.eigenvectors)?;
        Some((eigen.eigenvalues, vectors))
    };
    let (values, vectors) = match stiffness.clone().cholesky() {
        Some(root) => {
            let (inverse, vectors) = by(&root.l(), mass)?;
            let mut scaled = vectors;
            for (k, value) in inverse.iter().enumerate() {
                scaled.column_mut(k).scale_mut(1.0 / value.sqrt());
            }
            (inverse.map(|value| 1.0 / value), scaled)
        }
        None => by(&mass.clone().cholesky()?.l(), stiffness)?,
    };
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
    let sorted = nalgebra::DVector::from_iterator(order.len(), order.iter().map(|&k| values[k]));
    Some((sorted, vectors.select_columns(&order)))
}
