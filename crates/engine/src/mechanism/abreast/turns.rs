//! Sines and cosines side by side.
//!
//! ```text
//! x = n π/2 + r,  |r| ≤ π/4       n π/2 in three parts, of which the first two are exact products (Cody and Waite 1980)
//! sin r, cos r                    minimax polynomials of degree 13 and 14 (Moshier, Cephes Mathematical Library)
//! ```

use crate::element::Pose;
use linkdyn_linear::math::{Lanes, Real};
use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};
use std::f64::consts::FRAC_2_PI;

const HALF_PI: [f64; 3] = [
    1.570_796_310_901_641_8,
    1.589_325_471_229_585_7e-8,
    6.123_233_995_736_766e-17,
];
const SINE: [f64; 6] = [
    -0.166_666_666_666_666_3,
    0.008_333_333_333_322_118,
    -0.000_198_412_698_295_895_4,
    2.755_731_362_138_572_2e-6,
    -2.505_074_776_285_780_7e-8,
    1.589_623_015_765_465_6e-10,
];
const COSINE: [f64; 6] = [
    0.041_666_666_666_666_595,
    -0.001_388_888_888_887_305_6,
    2.480_158_728_885_170_4e-5,
    -2.755_731_417_929_674e-7,
    2.087_570_084_197_473e-9,
    -1.135_853_652_138_768_2e-11,
];
/// Added and taken away again, it rounds to a whole number.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// Beyond this \[rad\] the products are not exact.
const FAR: f64 = 1e6;
/// Largest turn of [`turned`] \[rad\].
pub const SMALL: f64 = 0.01;

fn polynomial<T: Real>(x: T, coefficients: &[f64]) -> T {
    let from_last = coefficients.iter().rev();
    from_last.fold(T::zero(), |sum, c| sum * x + T::splat(*c))
}

/// sin x and cos x.
#[inline]
pub fn sin_cos(x: Lanes) -> (Lanes, Lanes) {
    let splat = Lanes::splat;
    let whole = |x: Lanes| (x + splat(ROUND)) - splat(ROUND);
    let n = whole(x * splat(FRAC_2_PI));
    let r = HALF_PI.iter().fold(x, |x, part| x - n * splat(*part));
    let square = r * r;
    let sin = r + r * square * polynomial(square, &SINE);
    let cos = square * square * polynomial(square, &COSINE) - square * splat(0.5) + splat(1.0);
    // n by its quadrant, from −2 to 2
    let quadrant = n - splat(4.0) * whole(n * splat(0.25));
    let odd = quadrant.simd_abs().simd_eq(splat(1.0));
    let sign = splat(-0.0);
    let negative = |of: <Lanes as SimdValue>::SimdBool| sign.select(of, Lanes::ZERO);
    let of_sin = negative(quadrant.simd_lt(Lanes::ZERO) | quadrant.simd_eq(splat(2.0)));
    let of_cos = negative(quadrant.simd_gt(splat(0.5)) | quadrant.simd_eq(splat(-2.0)));
    let mut both = [
        Lanes(cos.select(odd, sin).0 ^ of_sin.0),
        Lanes(sin.select(odd, cos).0 ^ of_cos.0),
    ];
    let is_far = !x.simd_abs().simd_le(splat(FAR));
    if is_far.any() {
        for lane in 0..Lanes::LANES {
            let own = x.extract(lane);
            if own.is_nan() || own.abs() > FAR {
                let (sin, cos) = own.sin_cos();
                both[0].replace(lane, sin);
                both[1].replace(lane, cos);
            }
        }
    }
    (both[0], both[1])
}

/// A pose turned by a small angle: sin δ and cos δ by their series up to δ⁵ and δ⁶.
#[inline]
pub fn turned(pose: &Pose<Lanes>, angle: Lanes) -> Pose<Lanes> {
    let square = angle * angle;
    let sin = angle + angle * square * polynomial(square, &[-1.0 / 6.0, 1.0 / 120.0]);
    let less = square * polynomial(square, &[-0.5, 1.0 / 24.0, -1.0 / 720.0]);
    Pose {
        r: pose.r,
        theta: pose.theta + angle,
        cos: pose.cos + (pose.cos * less - pose.sin * sin),
        sin: pose.sin + (pose.sin * less + pose.cos * sin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_linear::math::Vector;

    fn each() -> impl Iterator<Item = f64> {
        let near = (-4000..4000).map(|k| f64::from(k) * 0.003_9);
        let wide = (-300..300).map(|k| f64::from(k) * 7_919.3);
        let quarters = (-40..40).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_4);
        near.chain(wide).chain(quarters)
    }

    #[test]
    fn sines_are_those_of_one_number() {
        for x in each().chain([0.0, 1e-300, 1e9]) {
            let (sin, cos) = sin_cos(Lanes::from_arr([x, -x, x + 1.0, 0.5 * x]));
            for (lane, x) in [x, -x, x + 1.0, 0.5 * x].into_iter().enumerate() {
                let (exact_sin, exact_cos) = x.sin_cos();
                let off = (sin.extract(lane) - exact_sin)
                    .abs()
                    .max((cos.extract(lane) - exact_cos).abs());
                assert!(off <= 3e-16, "{x}: {off:e}");
            }
        }
        let (sin, _) = sin_cos(Lanes::splat(f64::INFINITY));
        assert!(sin.extract(0).is_nan());
    }

    #[test]
    fn a_turned_pose_is_the_pose_there() {
        for (k, x) in each().enumerate() {
            let angle = SMALL * ((k % 201) as f64 / 100.0 - 1.0);
            let (sin, cos) = sin_cos(Lanes::splat(x));
            let pose = Pose {
                r: Vector::new(Lanes::ZERO, Lanes::ZERO),
                theta: Lanes::splat(x),
                cos,
                sin,
            };
            let found = turned(&pose, Lanes::splat(angle));
            let (sin, cos) = found.theta.extract(0).sin_cos();
            // the angle itself is rounded
            let round_off = 3e-16 + 2.0 * f64::EPSILON * x.abs();
            assert!(
                (found.sin.extract(0) - sin).abs() <= round_off,
                "{x} {angle}"
            );
            assert!(
                (found.cos.extract(0) - cos).abs() <= round_off,
                "{x} {angle}"
            );
        }
    }
}
