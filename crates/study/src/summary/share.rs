//! A share of variants with its interval.
//!
//! ```text
//! lower = B⁻¹(α/2; k, n − k + 1),  upper = B⁻¹(1 − α/2; k + 1, n − k),  0 for k = 0, 1 for k = n
//! ```
//!
//! B is the regularised incomplete beta function. Source: Clopper and Pearson, The use of confidence or fiducial limits, Biometrika 26,
//! 1934: the interval holds the true share in at least 1 − α of all studies of variants that are independent of each other. For Latin
//! hypercubes and scrambled Sobol points, which spread more evenly, it is as a rule wider than need be. Shares of what is no sample,
//! such as the points of a grid, have none.
//!
//! B(x; a, b) by its continued fraction (Abramowitz and Stegun 26.5.8, in the form of Lentz), with the factor before it by the deviance
//! (Loader, Fast and accurate computation of binomial probabilities, 2000): twelve digits up to 10⁷ variants, nine at 10⁹.

use serde::Serialize;
use std::f64::consts::PI;

/// A share with the interval that holds the true one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Share {
    /// How many are counted.
    pub within: u64,
    /// Of how many.
    pub total: u64,
    /// Their share.
    pub share: f64,
    /// Where the interval begins; none of what is no sample.
    pub lower: Option<f64>,
    /// Where it ends.
    pub upper: Option<f64>,
}

impl Share {
    /// `within` of `total` that are no sample; none of nothing.
    pub fn of(within: u64, total: u64) -> Option<Self> {
        (total > 0 && within <= total).then(|| Share {
            within,
            total,
            share: within as f64 / total as f64,
            lower: None,
            upper: None,
        })
    }

    /// `within` of `total`, with the interval of a confidence such as 0.95; none of nothing.
    pub fn new(within: u64, total: u64, confidence: f64) -> Option<Self> {
        let share = Share::of(within, total)?;
        let tail = 0.5 * (1.0 - confidence);
        let (k, n) = (within as f64, total as f64);
        let lower = match within {
            0 => 0.0,
            _ => share_where(|x| beta(x, k, n - k + 1.0)[0] < tail),
        };
        let upper = match total - within {
            0 => 1.0,
            _ => share_where(|x| beta(x, k + 1.0, n - k)[1] > tail),
        };
        Some(Share {
            lower: Some(lower),
            upper: Some(upper),
            ..share
        })
    }
}

/// The first double in (0, 1) where `is_short` holds no more, by halving the doubles, which are in the order of their bits.
fn share_where(is_short: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0_f64.to_bits(), 1.0_f64.to_bits());
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if is_short(f64::from_bits(middle)) {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::from_bits(high)
}

/// B(x; a, b) and 1 − B(x; a, b) for a, b ≥ 1.
fn beta(x: f64, a: f64, b: f64) -> [f64; 2] {
    let y = 1.0 - x;
    if x * (a + b + 2.0) > a + 1.0 {
        let above = front([y, x], b, a) * fraction([y, x], b, a) / b;
        return [1.0 - above, above];
    }
    let below = front([x, y], a, b) * fraction([x, y], a, b) / a;
    [below, 1.0 - below]
}

/// x^a y^b Γ(a + b)/(Γ(a) Γ(b)), with y = 1 − x.
fn front([x, y]: [f64; 2], a: f64, b: f64) -> f64 {
    let n = a + b;
    let errors = stirling(n) - stirling(a) - stirling(b);
    let exponent = errors - deviance(a, n * x) - deviance(b, n * y);
    libm::exp(exponent) * libm::sqrt(a * b / (2.0 * PI * n))
}

/// ln Γ(x + 1) − ln(√(2πx) (x/e)^x).
fn stirling(x: f64) -> f64 {
    if x < 16.0 {
        return libm::lgamma(x + 1.0) - (x + 0.5) * libm::log(x) + x - 0.5 * libm::log(2.0 * PI);
    }
    let square = 1.0 / (x * x);
    let series = [
        1.0 / 12.0,
        -1.0 / 360.0,
        1.0 / 1260.0,
        -1.0 / 1680.0,
        1.0 / 1188.0,
    ];
    series.iter().rev().fold(0.0, |sum, c| sum * square + c) / x
}

/// x ln(x/m) + m − x, without loss where both are near.
fn deviance(x: f64, m: f64) -> f64 {
    let v = (x - m) / (x + m);
    if v.abs() >= 0.1 {
        return x * libm::log(x / m) + m - x;
    }
    // 2 x (v³/3 + v⁵/5 + …) + (x − m) v
    let (mut power, mut sum) = (2.0 * x * v, (x - m) * v);
    for odd in (3..40).step_by(2) {
        power *= v * v;
        sum += power / f64::from(odd);
    }
    sum
}

/// The continued fraction of B, which converges fast below (a + 1)/(a + b + 2).
fn fraction([x, y]: [f64; 2], a: f64, b: f64) -> f64 {
    // As many steps as the larger root of a and b; the sum of both bounds what a count can need.
    let most = 1000 + 20 * libm::sqrt(a + b) as u64;
    let tiny = 1e-300;
    let off_zero = |x: f64| if x.abs() < tiny { tiny } else { x };
    // 1 − (a + b) x/(a + 1), from the smaller of x and 1 − x, which has the digits.
    let first = if x < 0.5 {
        1.0 - (a + b) * x / (a + 1.0)
    } else {
        (1.0 - b + (a + b) * y) / (a + 1.0)
    };
    let mut c = 1.0;
    let mut d = 1.0 / off_zero(first);
    let mut value = d;
    for m in 1..most {
        let m = m as f64;
        let place = a + 2.0 * m;
        let even = m * (b - m) * x / ((place - 1.0) * place);
        d = 1.0 / off_zero(1.0 + even * d);
        c = off_zero(1.0 + even / c);
        value *= c * d;
        let odd = -(a + m) * (a + b + m) * x / (place * (place + 1.0));
        d = 1.0 / off_zero(1.0 + odd * d);
        c = off_zero(1.0 + odd / c);
        value *= c * d;
        if (c * d - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    /// scipy 1.17: `betaincinv(k, n − k + 1, α/2)` and `betaincinv(k + 1, n − k, 1 − α/2)`; the upper end of the last, where scipy
    /// has eight digits, is the root of (1 − x)^n + n x (1 − x)^(n − 1) = α/2 by mpmath.
    #[test]
    fn intervals_are_those_of_scipy() {
        for (within, total, confidence, lower, upper) in [
            (0, 10, 0.95, 0.0, 0.3084971078187607),
            (10, 10, 0.95, 0.6915028921812392, 1.0),
            (3, 20, 0.95, 0.032070937185463715, 0.37892682654531396),
            (500, 1000, 0.95, 0.468549172971792, 0.531450827028208),
            (997, 1000, 0.95, 0.9912579767615217, 0.9993809000683505),
            (
                99_985,
                100_000,
                0.99,
                0.9997183779627116,
                0.9999310639511193,
            ),
            (
                9_999_000,
                10_000_000,
                0.95,
                0.9998936051266161,
                0.9999061024164972,
            ),
            (
                1,
                1_000_000_000,
                0.95,
                2.53178079839694e-11,
                5.571643378203115e-9,
            ),
        ] {
            let found = Share::new(within, total, confidence).expect("a share");
            for (found, expected) in [(found.lower, lower), (found.upper, upper)] {
                let found = found.expect("an interval");
                // α/2 = (1 − 0.95)/2 is known to 2e-15; at 10⁹, 1 − x keeps eight digits of x, most of which cancel.
                let digits = if total > 10_000_000 { 1e-9 } else { 1e-12 };
                let off = (found - expected).abs();
                assert!(
                    off <= digits * expected,
                    "{within} of {total}: {found} {expected}"
                );
            }
        }
        assert_eq!(Share::new(0, 0, 0.95), None);
    }

    proptest::proptest! {
        #[test]
        fn the_share_is_within_its_interval(total in 1..3000_u64, part in 0.0..=1.0_f64) {
            let within = (part * total as f64) as u64;
            let found = Share::new(within, total, 0.95).expect("a share");
            let [lower, upper] = [found.lower, found.upper].map(|end| end.expect("an interval"));
            proptest::prop_assert!(lower <= found.share && found.share <= upper);
            let other = Share::new(total - within, total, 0.95).expect("a share");
            proptest::prop_assert!((lower - (1.0 - other.upper.expect("an interval"))).abs() < 1e-12);
        }
    }
}
