//! The normal distribution function Φ and its inverse.
//!
//! ```text
//! Φ(z) = erfc(−z/√2)/2
//! |p − 1/2| ≤ 0.425     z = q P₁(r)/Q₁(r),  q = p − 1/2,  r = 0.425² − q²
//! else                  r = √(−ln p),  z = −P(r − 1.6)/Q(r − 1.6) up to r = 5, −P(r − 5)/Q(r − 5) beyond
//! ```
//!
//! Source: Wichura, Algorithm AS 241: the percentage points of the normal distribution, Applied Statistics 37, 1988, routine PPND16,
//! with a relative error of 1e-16 and the rounding of its evaluation.

use std::f64::consts::SQRT_2;

/// Numerator and denominator by rising powers, in the middle.
const MIDDLE: [[f64; 8]; 2] = [
    [
        3.387_132_872_796_366_5,
        1.331_416_678_917_843_8e2,
        1.971_590_950_306_551_3e3,
        1.373_169_376_550_946e4,
        4.592_195_393_154_987e4,
        6.726_577_092_700_87e4,
        3.343_057_558_358_813e4,
        2.509_080_928_730_122_7e3,
    ],
    [
        1.0,
        4.231_333_070_160_091e1,
        6.871_870_074_920_579e2,
        5.394_196_021_424_751e3,
        2.121_379_430_158_659_7e4,
        3.930_789_580_009_271e4,
        2.872_908_573_572_194_3e4,
        5.226_495_278_852_854e3,
    ],
];

/// The same where p is small.
const TAIL: [[f64; 8]; 2] = [
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        2.417_807_251_774_506e-1,
        2.272_384_498_926_918_4e-2,
        7.745_450_142_783_414e-4,
    ],
    [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        6.897_673_349_851e-1,
        1.481_039_764_274_800_8e-1,
        1.519_866_656_361_645_7e-2,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
];

/// The same where p is below 1e-11.
const FAR: [[f64; 8]; 2] = [
    [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        2.965_605_718_285_048_7e-1,
        2.653_218_952_657_612_4e-2,
        1.242_660_947_388_078_4e-3,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    [
        1.0,
        5.998_322_065_558_88e-1,
        1.369_298_809_227_358e-1,
        1.487_536_129_085_061_5e-2,
        7.868_691_311_456_133e-4,
        1.846_318_317_510_054_8e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_8e-15,
    ],
];

fn ratio([over, under]: &[[f64; 8]; 2], r: f64) -> f64 {
    let value = |c: &[f64; 8]| c.iter().rev().fold(0.0, |sum, c| sum * r + c);
    value(over) / value(under)
}

/// Φ(z): the share below `z`.
pub fn below(z: f64) -> f64 {
    0.5 * libm::erfc(-z / SQRT_2)
}

/// Φ⁻¹(p): what the share `p` is below; infinite at 0 and 1, none outside.
pub fn quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(&MIDDLE, 0.180_625 - q * q);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    let z = if tail == 0.0 {
        f64::INFINITY
    } else {
        let r = libm::sqrt(-libm::log(tail));
        if r <= 5.0 {
            ratio(&TAIL, r - 1.6)
        } else {
            ratio(&FAR, r - 5.0)
        }
    };
    if q < 0.0 { -z } else { z }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// mpmath with 40 digits: the root of ncdf(z) − p at the double p.
    #[test]
    fn quantiles_have_their_digits() {
        for (p, z) in [
            (0.25, -0.674_489_750_196_081_7),
            (0.1, -1.281_551_565_544_600_4),
            (0.075, -1.439_531_470_938_456),
            (0.024, -1.977_368_428_181_946_7),
            (0.001, -3.090_232_306_167_813_5),
            (0.00135, -2.999_976_992_703_393),
            (1e-6, -4.753_424_308_822_899),
            (1e-9, -5.997_807_015_007_687),
            (1e-15, -7.941_345_326_170_997),
            (1.0 / (1_u64 << 53) as f64, -8.209_536_151_601_387),
            (1e-40, -13.310_921_371_425_17),
            (1e-100, -21.273_453_560_965_324),
            (1e-300, -37.047_096_299_361_2),
        ] {
            let off = quantile(p) / z - 1.0;
            assert!(off.abs() <= 1e-15, "{p}: {} off by {off}", quantile(p));
        }
    }

    #[test]
    fn both_sides_are_alike() {
        assert_eq!(quantile(0.5), 0.0);
        for p in [1.0 / 1024.0, 0.0625, 0.25, 0.375] {
            assert_eq!(quantile(p), -quantile(1.0 - p), "{p}");
        }
        assert_eq!(quantile(0.0), f64::NEG_INFINITY);
        assert_eq!(quantile(1.0), f64::INFINITY);
        assert!(quantile(-0.1).is_nan() && quantile(1.1).is_nan());
    }

    proptest::proptest! {
        /// An error of one unit in the last place of z changes p by z φ(z)/Φ(z) ≤ z² + 1 units, at most 70 here.
        #[test]
        fn the_inverse_is_one(exponent in -50.0..-0.31_f64) {
            let p = 10.0_f64.powf(exponent / 3.0);
            let z = quantile(p);
            let off = below(z) / p - 1.0;
            proptest::prop_assert!(off.abs() < (z * z + 2.0) * 4.0 * f64::EPSILON, "{p} {z} {off}");
        }
    }
}
