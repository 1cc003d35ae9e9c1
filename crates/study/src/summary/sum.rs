//! Sums that keep what rounding takes from them.

/// A sum with its rounding errors beside it (Neumaier 1974): as if the running sum had about twice as many digits.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Sum {
    high: f64,
    low: f64,
}

impl Sum {
    /// Adds a number.
    pub fn add(&mut self, x: f64) {
        let sum = self.high + x;
        let back = sum - self.high;
        // What the sum lost, exactly (Knuth).
        self.low += (self.high - (sum - back)) + (x - back);
        self.high = sum;
    }

    /// Adds another sum.
    pub fn merge(&mut self, other: &Sum) {
        self.add(other.high);
        self.add(other.low);
    }

    /// How much more another sum is, exact where both are near.
    pub fn to(&self, other: &Sum) -> f64 {
        (other.high - self.high) + (other.low - self.low)
    }

    /// The sum.
    pub fn value(&self) -> f64 {
        self.high + self.low
    }
}
