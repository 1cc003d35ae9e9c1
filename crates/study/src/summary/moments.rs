//! Mean, standard deviation and skewness in one pass.
//!
//! ```text
//! M_p = Σ (x − mean)^p,  one value more (Welford) or two parts joined (Chan), compensated
//! δ = mean_b − mean_a,  n = n_a + n_b
//! mean ← mean_a + δ n_b/n
//! M₂   ← M₂a + M₂b + δ² n_a n_b/n
//! M₃   ← M₃a + M₃b + δ³ n_a n_b (n_a − n_b)/n² + 3 δ (n_a M₂b − n_b M₂a)/n
//! σ = √(M₂/(n − 1)),  skewness = √n M₃/M₂^1.5
//! ```
//!
//! Sources: Welford 1962; Chan, Golub, LeVeque 1983; Pébay, Formulas for robust, one-pass parallel computation of covariances and
//! arbitrary-order statistical moments, Sandia report SAND2008-6212.

use super::sum::Sum;

/// Moments of the finite values.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Moments {
    count: u64,
    mean: Sum,
    second: Sum,
    third: Sum,
    range: Option<[f64; 2]>,
}

impl Moments {
    /// Takes a finite value.
    pub fn push(&mut self, x: f64) {
        let one = Moments {
            count: 1,
            mean: {
                let mut mean = Sum::default();
                mean.add(x);
                mean
            },
            range: Some([x, x]),
            ..Moments::default()
        };
        self.merge(&one);
    }

    /// Takes the values of another part.
    pub fn merge(&mut self, other: &Moments) {
        if self.count == 0 || other.count == 0 {
            if self.count == 0 {
                *self = other.clone();
            }
            return;
        }
        let (a, b) = (self.count as f64, other.count as f64);
        let n = a + b;
        let delta = self.mean.to(&other.mean);
        let step = delta / n;
        let across = delta * step * a * b;
        self.third.merge(&other.third);
        self.third.add(across * step * (a - b));
        self.third
            .add(3.0 * step * (a * other.second.value() - b * self.second.value()));
        self.second.merge(&other.second);
        self.second.add(across);
        self.mean.add(step * b);
        self.count += other.count;
        self.range = self
            .range
            .zip(other.range)
            .map(|(own, more)| [own[0].min(more[0]), own[1].max(more[1])]);
    }

    /// How many values.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The mean; none without values.
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.mean.value())
    }

    /// The standard deviation of what the values are a sample of; none below two.
    pub fn deviation(&self) -> Option<f64> {
        let free = self.count.checked_sub(1).filter(|&free| free > 0)?;
        Some((self.second.value().max(0.0) / free as f64).sqrt())
    }

    /// The skewness; `None` if nothing scatters.
    pub fn skewness(&self) -> Option<f64> {
        let second = self.second.value();
        (second > 0.0)
            .then(|| (self.count as f64).sqrt() * self.third.value() / (second * second.sqrt()))
    }

    /// Smallest and largest value; none without values.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.range
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Philox, uniform};

    fn of(values: &[f64]) -> Moments {
        let mut all = Moments::default();
        values.iter().for_each(|&x| all.push(x));
        all
    }

    /// numpy and scipy: `y = exp(3 Generator(Philox(key=[7, 0])).random(1000))`, `y.mean()`, `y.std(ddof=1)`, `stats.skew(y)`.
    #[test]
    fn moments_are_those_of_numpy() {
        let philox = Philox::new([7, 0]);
        let values: Vec<f64> = (0..1000)
            .map(|number| libm::exp(3.0 * uniform(philox.word(number))))
            .collect();
        let found = of(&values);
        for (found, expected) in [
            (found.mean(), 6.182164322940036),
            (found.deviation(), 5.079362000371791),
            (found.skewness(), 1.0413534798009354),
        ] {
            let found = found.expect("values");
            assert!((found / expected - 1.0).abs() < 4e-15, "{found} {expected}");
        }
        // The exponential of numpy differs from that of libm by a unit in the last place.
        let [least, most] = found.range().expect("values");
        assert!((least - 1.0050268720321334).abs() < 3e-16, "{least}");
        assert!((most - 20.003776219323015).abs() < 4e-15, "{most}");
    }

    /// A micrometre about a kilometre: one pass without compensation loses half the digits.
    #[test]
    fn small_deviations_of_large_values_keep_their_digits() {
        let values: Vec<f64> = (0..100_000)
            .map(|k| 1024.0 + f64::from(k % 5 - 2) / 1_048_576.0)
            .collect();
        let found = of(&values);
        // mean of the squares of −2 … 2 is 2
        let expected = (2.0 * 100_000.0 / 99_999.0_f64).sqrt() / 1_048_576.0;
        assert_eq!(found.mean(), Some(1024.0));
        let deviation = found.deviation().expect("values");
        assert!((deviation / expected - 1.0).abs() < 1e-12, "{deviation:e}");
    }

    #[test]
    fn few_values_have_few_moments() {
        assert_eq!(Moments::default().mean(), None);
        let one = of(&[3.0]);
        assert_eq!((one.mean(), one.deviation()), (Some(3.0), None));
        let same = of(&[3.0; 4]);
        assert_eq!((same.deviation(), same.skewness()), (Some(0.0), None));
    }

    proptest::proptest! {
        #[test]
        fn parts_make_the_whole(values in proptest::collection::vec(-1e3..1e3_f64, 2..200), at in 0..200_usize) {
            let (first, rest) = values.split_at(at.min(values.len()));
            let mut joined = of(first);
            joined.merge(&of(rest));
            let whole = of(&values);
            let off = |a: Option<f64>, b: Option<f64>| (a.expect("values") - b.expect("values")).abs();
            proptest::prop_assert!(off(joined.mean(), whole.mean()) < 1e-11);
            proptest::prop_assert!(off(joined.deviation(), whole.deviation()) < 1e-10);
            proptest::prop_assert_eq!(joined.range(), whole.range());
        }
    }
}
