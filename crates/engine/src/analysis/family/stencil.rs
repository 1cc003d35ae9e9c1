//! Derivatives of smooth functions from eight places around one: the formula of order eight, and that of order six beside it.
//!
//! ```text
//! f′ = Σ w_k (f(k h) − f(−k h))/h      order 8: 4/5, −1/5, 4/105, −1/280, error h⁸ f⁽⁹⁾/630
//!                                      order 6: 3/4, −3/20, 1/60,         error h⁶ f⁽⁷⁾/140
//! ```
//!
//! (Fornberg, Generation of finite difference formulas on arbitrarily spaced grids, 1988.) It is meant for functions that are
//! evaluated to round-off, such as the equations of a mechanism at a given position: with h a hundredth of the length over which
//! they change, the error is round-off. Where the two formulas part, the function is not smooth there, or not on this length.

/// Places, by steps.
pub const PLACES: [f64; 8] = [-4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0];
const EIGHTH: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
const SIXTH: [f64; 4] = [3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0];
/// A step, by the length over which functions change: a power of two, so that places are exact.
pub const STEP: f64 = 1.0 / 128.0;
/// Formulas that differ by less, by the size of what changes over that length, say the same: the one of order eight is then off by
/// 1e-11 at most.
const SAME: f64 = 1e-8;

/// Derivatives of some values, while the places come.
#[derive(Debug, Clone, Default)]
pub struct StencilSums {
    /// Of order eight.
    pub slopes: Vec<f64>,
    sixth: Vec<f64>,
    largest: Vec<f64>,
    step: f64,
}

impl StencilSums {
    /// Of so many values.
    pub fn new(count: usize) -> Self {
        StencilSums {
            slopes: vec![0.0; count],
            sixth: vec![0.0; count],
            largest: vec![0.0; count],
            step: 1.0,
        }
    }

    /// Begins, with a step.
    pub fn begin(&mut self, step: f64) {
        self.slopes.fill(0.0);
        self.sixth.fill(0.0);
        self.largest.fill(0.0);
        self.step = step;
    }

    /// Takes the values at a place.
    pub fn take(&mut self, place: f64, values: &[f64]) {
        let k = place.abs() as usize - 1;
        let by = place.signum() / self.step;
        let (slope, sixth) = (EIGHTH[k] * by, SIXTH[k] * by);
        for (index, value) in values.iter().enumerate() {
            self.slopes[index] += slope * value;
            self.sixth[index] += sixth * value;
            self.largest[index] = self.largest[index].max(value.abs());
        }
    }

    /// Whether both formulas say the same of one value.
    pub fn is_smooth(&self, index: usize) -> bool {
        let (slopes, sixth) = (self.slopes[index], self.sixth[index]);
        let over = STEP * self.largest[index] / self.step;
        (slopes - sixth).abs() <= SAME * (slopes.abs() + over)
    }

    /// The same of all values together, each measured by its scale, of sizes around `typical` besides.
    pub fn are_smooth(&self, scale: impl Fn(usize) -> f64, typical: f64) -> bool {
        let most = |of: &dyn Fn(usize) -> f64| {
            let all = (0..self.slopes.len()).map(|index| (of(index) / scale(index)).abs());
            all.fold(0.0, |most: f64, own| {
                if own > most || own.is_nan() {
                    own
                } else {
                    most
                }
            })
        };
        let apart = most(&|index| self.slopes[index] - self.sixth[index]);
        let slope = most(&|index| self.slopes[index]);
        let largest = most(&|index| self.largest[index]).max(typical);
        apart <= SAME * (slope + STEP * largest / self.step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sums(f: impl Fn(f64) -> f64, length: f64) -> StencilSums {
        let mut sums = StencilSums::new(1);
        sums.begin(STEP * length);
        for place in PLACES {
            sums.take(place, &[f(place * STEP * length)]);
        }
        sums
    }

    #[test]
    fn smooth_functions_have_all_digits() {
        for (at, rate) in [(0.3_f64, 1.0), (1.1, 3.0), (-2.0, 0.1)] {
            let sums = sums(|h| (at + rate * h).sin(), 1.0);
            let off = (sums.slopes[0] - rate * at.cos()).abs();
            assert!(off <= 5e-14 && sums.is_smooth(0), "{at} {rate}: {off:e}");
        }
    }

    #[test]
    fn kinks_and_wild_functions_are_told() {
        assert!(!sums(|h| (h - 0.01).abs(), 1.0).is_smooth(0));
        assert!(!sums(|h| (40.0 * h).sin(), 1.0).is_smooth(0));
        assert!(!sums(|h| (h - 0.02).sqrt(), 1.0).is_smooth(0));
        let wild = sums(|h| (40.0 * h).sin(), 1.0);
        assert!(!wild.are_smooth(|_| 1.0, 1.0));
    }
}
