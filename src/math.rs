//! Plane vectors.

/// A plane vector (2).
pub type Vec2 = nalgebra::Vector2<f64>;

/// The vector turned by +90°.
pub fn perp(a: Vec2) -> Vec2 {
    Vec2::new(-a.y, a.x)
}

/// Largest magnitude of a slice; NaN where one entry is NaN, so that nothing bad hides.
pub fn max_abs(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, &v| if v.abs() > m || v.is_nan() { v.abs() } else { m })
}

/// Σ aᵢ bᵢ.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
