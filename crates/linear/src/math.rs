//! Numbers and plane vectors.

use nalgebra::SimdRealField;

/// A number, or several side by side.
pub trait Real: SimdRealField<Element = f64, SimdBool: Copy> + Copy {}

impl<T: SimdRealField<Element = f64, SimdBool: Copy> + Copy> Real for T {}

/// Numbers of several mechanisms side by side.
pub use simba::simd::WideF64x4 as Lanes;

/// How many there are.
pub const WIDTH: usize = 4;

/// A plane vector (2).
pub type Vector<T> = nalgebra::Vector2<T>;

/// The same of one mechanism.
pub type Vec2 = Vector<f64>;

/// The vector turned by +90°.
pub fn perp<T: Real>(a: Vector<T>) -> Vector<T> {
    Vector::new(-a.y, a.x)
}

/// The vector by its length, also where the squares of its components overflow or vanish.
pub fn unit(a: Vec2) -> Vec2 {
    let squared = a.norm_squared();
    if squared.is_normal() {
        a.normalize()
    } else {
        (a / a.amax()).normalize()
    }
}

/// Largest magnitude of a slice; NaN where one entry is NaN, so that nothing bad hides.
pub fn max_abs(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, &v| {
        if v.abs() > m || v.is_nan() {
            v.abs()
        } else {
            m
        }
    })
}

/// Σ aᵢ bᵢ.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_of_any_size_have_a_direction() {
        for size in [1e-320, 1e-200, 1e-150, 1.0, 1e150, 1e200, 1e308] {
            let found = unit(Vec2::new(0.6 * size, -0.8 * size));
            // 1e-320 is a multiple of the least double: two digits are left of it
            let digits = if size < 1e-307 { 1e-2 } else { 1e-15 };
            assert!(
                (found - Vec2::new(0.6, -0.8)).norm() < digits,
                "{size:e}: {found}"
            );
        }
    }
}
