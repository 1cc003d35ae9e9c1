//! One response over all variants.
//!
//! ```text
//! C_p = (U − L)/(6σ),  C_pk = min(U − mean, mean − L)/(3σ)
//! ```

use serde::{Deserialize, Serialize};

use super::moments::Moments;
use super::quantiles::Quantiles;

/// The shares whose quantiles a summary has: those of a normal at −3, 0 and 3 standard deviations.
pub const TAILS: [f64; 3] = [0.00135, 0.5, 0.99865];

/// What a response must keep to, the limits included.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// The least that is allowed.
    pub lower: Option<f64>,
    /// The most that is allowed.
    pub upper: Option<f64>,
}

impl Limits {
    /// Whether a value keeps to them; one that does not exist does not.
    pub fn hold(&self, x: f64) -> bool {
        !x.is_nan() && !self.is_below(x) && !self.is_above(x)
    }

    fn is_below(&self, x: f64) -> bool {
        self.lower.is_some_and(|lower| x < lower)
    }

    fn is_above(&self, x: f64) -> bool {
        self.upper.is_some_and(|upper| x > upper)
    }
}

/// The values of one response, as far as its summary needs them.
#[derive(Debug, Clone, Default)]
pub struct Response {
    limits: Limits,
    moments: Moments,
    quantiles: Quantiles,
    none: u64,
    below: u64,
    above: u64,
}

/// What the values of one response come to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Values.
    pub count: u64,
    /// Variants without a value.
    pub none: u64,
    /// Mean.
    pub mean: Option<f64>,
    /// Standard deviation.
    pub deviation: Option<f64>,
    /// Skewness.
    pub skewness: Option<f64>,
    /// The smallest value.
    pub min: Option<f64>,
    /// The largest value.
    pub max: Option<f64>,
    /// What 0.135, 50 and 99.865 % of the values are below.
    pub quantiles: Option<Vec<f64>>,
    /// How far the quantiles may be off; 0 where they are exact.
    pub quantile_error: f64,
    /// C_p, where there are two limits.
    pub cp: Option<f64>,
    /// C_pk, where there is a limit.
    pub cpk: Option<f64>,
    /// Values below the lower limit.
    pub below: u64,
    /// Values above the upper limit.
    pub above: u64,
}

impl Response {
    /// A response with its limits, exact in its quantiles up to `exact` values.
    pub fn new(limits: Limits, exact: usize) -> Self {
        Response {
            limits,
            quantiles: Quantiles::new(exact),
            ..Response::default()
        }
    }

    /// Takes the value of one variant; one that is not finite does not exist.
    pub fn push(&mut self, x: f64) {
        if !x.is_finite() {
            self.none += 1;
            return;
        }
        self.moments.push(x);
        self.quantiles.push(x);
        self.below += u64::from(self.limits.is_below(x));
        self.above += u64::from(self.limits.is_above(x));
    }

    /// Takes the values of the variants after these.
    pub fn merge(&mut self, other: &Response) {
        self.moments.merge(&other.moments);
        self.quantiles.merge(&other.quantiles);
        self.none += other.none;
        self.below += other.below;
        self.above += other.above;
    }

    /// The quantiles and histograms of the values.
    pub fn quantiles(&self) -> &Quantiles {
        &self.quantiles
    }

    /// What the values come to.
    pub fn summary(&self) -> Summary {
        let [min, max] = match self.moments.range() {
            Some(range) => range.map(Some),
            None => [None; 2],
        };
        let deviation = self.moments.deviation();
        let (cp, cpk) = self.capability();
        Summary {
            count: self.moments.count(),
            none: self.none,
            mean: self.moments.mean(),
            deviation,
            skewness: self.moments.skewness(),
            min,
            max,
            quantiles: self.quantiles.at(&TAILS),
            quantile_error: self.quantiles.error(),
            cp,
            cpk,
            below: self.below,
            above: self.above,
        }
    }

    /// C_p and C_pk; `None` if nothing scatters or there is no limit.
    fn capability(&self) -> (Option<f64>, Option<f64>) {
        let sigma = self.moments.deviation().filter(|&sigma| sigma > 0.0);
        let Some((mean, sigma)) = self.moments.mean().zip(sigma) else {
            return (None, None);
        };
        let Limits { lower, upper } = self.limits;
        let cp = lower
            .zip(upper)
            .map(|(lower, upper)| (upper - lower) / (6.0 * sigma));
        let sides = [
            upper.map(|upper| upper - mean),
            lower.map(|lower| mean - lower),
        ];
        let least = sides.into_iter().flatten().reduce(f64::min);
        (cp, least.map(|room| room / (3.0 * sigma)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1, 2, 3, 4, 5: mean 3, σ √2.5.
    #[test]
    fn summaries_have_their_numbers() {
        let limits = Limits {
            lower: Some(2.0),
            upper: Some(4.5),
        };
        let (mut all, mut rest) = (Response::new(limits, 10), Response::new(limits, 10));
        [1.0, f64::NAN, 2.0].into_iter().for_each(|x| all.push(x));
        [3.0, 4.0, 5.0, f64::INFINITY]
            .into_iter()
            .for_each(|x| rest.push(x));
        all.merge(&rest);
        let found = all.summary();
        let sigma = 2.5_f64.sqrt();
        assert_eq!(
            (found.count, found.none, found.below, found.above),
            (5, 2, 1, 1)
        );
        assert_eq!(
            [found.mean, found.min, found.max],
            [Some(3.0), Some(1.0), Some(5.0)]
        );
        assert_eq!(found.deviation, Some(sigma));
        assert_eq!(found.cp, Some(2.5 / (6.0 * sigma)));
        assert_eq!(found.cpk, Some(1.0 / (3.0 * sigma)));
        assert!(
            limits.hold(2.0) && limits.hold(4.5) && !limits.hold(4.6) && !limits.hold(f64::NAN)
        );
    }

    #[test]
    fn one_limit_has_no_cp() {
        let limits = Limits {
            upper: Some(7.0),
            ..Limits::default()
        };
        let mut all = Response::new(limits, 10);
        [2.0, 4.0].into_iter().for_each(|x| all.push(x));
        let found = all.summary();
        assert_eq!(
            (found.cp, found.cpk),
            (None, Some(4.0 / (3.0 * 2.0_f64.sqrt())))
        );
        assert_eq!(Response::default().summary().quantiles, None);
    }
}
