//! How one value scatters between a lower and an upper limit.
//!
//! ```text
//! m = (l + u)/2,  h = (u − l)/2
//! normal      m + h z/s,  z standard normal, cut at ±s:  F = (Φ(z) − Φ(−s))/(1 − 2 Φ(−s))
//! uniform     density 1/(2h)
//! triangular  density falling in straight lines from 1/h at m to zero at both limits
//! deviation   normal (h/s) √(1 − 2 s φ(s)/(1 − 2 Φ(−s))),  uniform h/√3,  triangular h/√6
//! ```
//!
//! The words are those of tolerances: a normal has its limits at so many standard deviations, its middle in the middle of the limits. What
//! lies beyond the limits does not exist here; root sums of squares count the normal as if it were not cut
//! ([`Distribution::uncut_deviation`]), which is wider: by 1/0.98658 at three, by 1/0.87963 at two standard deviations.
//!
//! Quantiles are fixed forever: a study that is repeated in ten years has the same variants.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::normal;

/// The form of a distribution.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// Normal, cut at its limits, which stand at so many standard deviations.
    Normal {
        /// Standard deviations from the middle to a limit.
        sigma: f64,
    },
    /// All values alike.
    Uniform,
    /// Falling from the middle to the limits in straight lines.
    Triangular,
}

/// Why a distribution can't be.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DistributionFault {
    /// A limit is not finite, or the lower one is above the upper one.
    #[error(
        "limits {lower:?} and {upper:?}: both must be finite, and the first not above the second"
    )]
    Limits {
        /// The lower limit.
        lower: f64,
        /// The upper limit.
        upper: f64,
    },
    /// The number of standard deviations is not positive.
    #[error(
        "sigma {0:?}: a normal distribution has its limits at a positive number of standard deviations"
    )]
    Sigma(f64),
}

/// A distribution between two limits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Distribution {
    shape: Shape,
    lower: f64,
    upper: f64,
}

impl Distribution {
    /// A distribution of this shape from `lower` to `upper`.
    ///
    /// # Errors
    /// Where limits or sigma make no sense.
    pub fn new(shape: Shape, lower: f64, upper: f64) -> Result<Self, DistributionFault> {
        if !(lower.is_finite() && upper.is_finite() && lower <= upper) {
            return Err(DistributionFault::Limits { lower, upper });
        }
        match shape {
            Shape::Normal { sigma } if !(sigma > 0.0 && sigma.is_finite()) => {
                Err(DistributionFault::Sigma(sigma))
            }
            Shape::Normal { .. } | Shape::Uniform | Shape::Triangular => Ok(Distribution {
                shape,
                lower,
                upper,
            }),
        }
    }

    /// Lower and upper limit.
    pub fn limits(&self) -> [f64; 2] {
        [self.lower, self.upper]
    }

    fn half(&self) -> f64 {
        0.5 * self.upper - 0.5 * self.lower
    }

    /// The value that the share `u` in \[0, 1\] is below; the limits at 0 and 1.
    pub fn quantile(&self, u: f64) -> f64 {
        if u <= 0.0 {
            return self.lower;
        }
        if u >= 1.0 {
            return self.upper;
        }
        // 1 − u is exact above 1/2, so that both halves are alike.
        let shift = if u > 0.5 {
            self.half() * self.below_middle(1.0 - u)
        } else {
            -self.half() * self.below_middle(u)
        };
        (self.mean() + shift).clamp(self.lower, self.upper)
    }

    /// How far below the middle the share `u` ≤ 1/2 ends, in half widths.
    fn below_middle(&self, u: f64) -> f64 {
        let part = match self.shape {
            Shape::Normal { sigma } => {
                let cut = normal::below(-sigma);
                -normal::quantile(cut + u * (1.0 - 2.0 * cut)) / sigma
            }
            Shape::Uniform => 1.0 - 2.0 * u,
            Shape::Triangular => 1.0 - libm::sqrt(2.0 * u),
        };
        part.clamp(0.0, 1.0)
    }

    /// The share below `x`.
    pub fn cumulative(&self, x: f64) -> f64 {
        if x <= self.lower {
            return if x < self.lower || self.lower < self.upper {
                0.0
            } else {
                1.0
            };
        }
        if x >= self.upper {
            return 1.0;
        }
        let part = (x - self.mean()) / self.half();
        let lower = match self.shape {
            Shape::Normal { sigma } => {
                let cut = normal::below(-sigma);
                (normal::below(-part.abs() * sigma) - cut) / (1.0 - 2.0 * cut)
            }
            Shape::Uniform => 0.5 * (1.0 - part.abs()),
            Shape::Triangular => 0.5 * (1.0 - part.abs()).powi(2),
        };
        if part > 0.0 { 1.0 - lower } else { lower }
    }

    /// The mean, which is the middle of the limits.
    pub fn mean(&self) -> f64 {
        0.5 * self.lower + 0.5 * self.upper
    }

    /// The standard deviation of what is drawn.
    pub fn deviation(&self) -> f64 {
        match self.shape {
            Shape::Normal { sigma } => self.half() / sigma * cut_deviation(sigma),
            Shape::Uniform | Shape::Triangular => self.uncut_deviation(),
        }
    }

    /// The standard deviation as root sums of squares count it: of the normal h/sigma, as if it were not cut.
    pub fn uncut_deviation(&self) -> f64 {
        let part = match self.shape {
            Shape::Normal { sigma } => 1.0 / sigma,
            Shape::Uniform => libm::sqrt(1.0 / 3.0),
            Shape::Triangular => libm::sqrt(1.0 / 6.0),
        };
        self.half() * part
    }
}

/// Standard deviation of a standard normal that is cut at ±s.
fn cut_deviation(s: f64) -> f64 {
    if s > 1.0 {
        let density = libm::exp(-0.5 * s * s) / libm::sqrt(2.0 * std::f64::consts::PI);
        return libm::sqrt(1.0 - 2.0 * s * density / (1.0 - 2.0 * normal::below(-s)));
    }
    // ∫ z² exp(−z²/2) / ∫ exp(−z²/2) by their series, which lose no digits where the cut is narrow.
    let (mut term, mut over, mut under) = (1.0, 0.0, 0.0);
    for k in 0..20 {
        let place = f64::from(2 * k);
        over += term / (place + 3.0);
        under += term / (place + 1.0);
        term *= -s * s / (place + 2.0);
    }
    s * libm::sqrt(over / under)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distribution(shape: Shape, lower: f64, upper: f64) -> Distribution {
        Distribution::new(shape, lower, upper).expect("legal")
    }

    /// mpmath with 40 digits: quantiles and deviation of the cut normal, in standard deviations.
    #[test]
    fn the_cut_normal_has_its_digits() {
        let u = [0.001, 0.125, 0.3, 0.75, 0.99];
        for (sigma, quantiles, deviation) in [
            (
                3.0,
                [
                    -2.827_288_835_871_115,
                    -1.145_445_046_854_700_6,
                    -0.522_848_165_433_788_9,
                    0.672_367_295_063_058_7,
                    2.279_357_877_103_892,
                ],
                0.986_578_392_558_108_6,
            ),
            (
                2.0,
                [
                    -1.982_625_620_502_018,
                    -1.071_098_376_973_208_7,
                    -0.498_402_882_421_938_5,
                    0.639_111_910_871_273,
                    1.848_083_539_591_331,
                ],
                0.879_625_661_034_239_8,
            ),
            (
                0.5,
                [
                    -0.498_912_642_386_956_1,
                    -0.368_089_757_259_287_4,
                    -0.193_164_639_213_823_26,
                    0.242_313_132_446_676_37,
                    0.489_152_725_121_944_7,
                ],
                0.283_882_290_044_327_5,
            ),
        ] {
            let normal = distribution(Shape::Normal { sigma }, -sigma, sigma);
            for (u, expected) in u.into_iter().zip(quantiles) {
                let found = normal.quantile(u);
                let off = (found - expected).abs();
                // p near 1/2 is known to half a unit in its last place, 5.6e-17, and dz/dp is at most 1/φ(0) = 2.5 there.
                assert!(off <= 1e-15, "{sigma} {u}: {found} {expected}");
            }
            let off = normal.deviation() / deviation - 1.0;
            assert!(off.abs() < 1e-15, "{sigma}: {}", normal.deviation());
        }
        let narrow = distribution(Shape::Normal { sigma: 0.01 }, -0.01, 0.01).deviation();
        assert!(
            (narrow / 0.005_773_464_201_933_299 - 1.0).abs() < 1e-15,
            "{narrow}"
        );
    }

    /// Digits of limits that are not symmetric; by hand.
    #[test]
    fn asymmetric_limits_have_their_middle() {
        let triangular = distribution(Shape::Triangular, -1.0, 2.0);
        assert_eq!(triangular.mean(), 0.5);
        assert_eq!(triangular.quantile(0.125), -0.25);
        assert_eq!(triangular.quantile(0.5), 0.5);
        assert_eq!(triangular.cumulative(-0.25), 0.125);
        // scipy.stats: triang(0.5, -1, 3).std()
        assert_eq!(triangular.deviation(), 0.6123724356957945);
        let uniform = distribution(Shape::Uniform, -1.0, 3.0);
        assert_eq!(uniform.quantile(0.75), 2.0);
        assert_eq!(uniform.cumulative(2.0), 0.75);
        let normal = distribution(Shape::Normal { sigma: 3.0 }, 0.0, 6.0);
        assert_eq!(normal.mean(), 3.0);
        assert_eq!(normal.uncut_deviation(), 1.0);
    }

    #[test]
    fn a_value_without_tolerance_stays() {
        for shape in [
            Shape::Normal { sigma: 3.0 },
            Shape::Uniform,
            Shape::Triangular,
        ] {
            let still = distribution(shape, 0.25, 0.25);
            assert_eq!(still.quantile(0.3), 0.25);
            assert_eq!(still.deviation(), 0.0);
            assert_eq!([still.cumulative(0.2), still.cumulative(0.25)], [0.0, 1.0]);
        }
    }

    #[test]
    fn faults_say_what_is_legal() {
        let fault = |shape, lower, upper| {
            Distribution::new(shape, lower, upper)
                .expect_err("a fault")
                .to_string()
        };
        assert_eq!(
            fault(Shape::Uniform, 2.0, 1.0),
            "limits 2.0 and 1.0: both must be finite, and the first not above the second"
        );
        assert_eq!(
            fault(Shape::Normal { sigma: -1.0 }, 0.0, 1.0),
            "sigma -1.0: a normal distribution has its limits at a positive number of standard deviations"
        );
    }

    proptest::proptest! {
        #[test]
        fn quantiles_invert_shares(
            u in 0.0..=1.0_f64, sigma in 0.5..6.0_f64, lower in -3.0..3.0_f64, width in 0.1..4.0_f64, shape in 0..3_usize,
        ) {
            let shape = [Shape::Normal { sigma }, Shape::Uniform, Shape::Triangular][shape];
            let all = distribution(shape, lower, lower + width);
            let x = all.quantile(u);
            proptest::prop_assert!(lower <= x && x <= lower + width, "{x}");
            proptest::prop_assert_eq!([all.quantile(0.0), all.quantile(1.0)], all.limits());
            // The density is at most max(0.4·2·6, 1, 2)/width, and x is rounded twice to the last place of at most 7.
            let off = all.cumulative(x) - u;
            proptest::prop_assert!(off.abs() < 4.8 / width * 14.0 * f64::EPSILON + 1e-15, "{x} {off}");
            proptest::prop_assert!(all.quantile((u + 1e-3).min(1.0)) >= x);
        }
    }
}
