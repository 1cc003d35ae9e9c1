//! What derivatives came from, and where something was worked out last.

use linkdyn_optimise::curve::Node;

/// What the derivatives of a start came from: of the objective or path and each constraint, in their order, how many were exact,
/// and how many differences.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Derivatives(pub Vec<[u64; 2]>);

impl Derivatives {
    /// Counts a derivative.
    pub fn count(&mut self, number: usize, is_exact: bool) {
        if self.0.len() <= number {
            self.0.resize(number + 1, [0; 2]);
        }
        self.0[number][usize::from(!is_exact)] += 1;
    }

    /// Both together.
    pub fn and(mut self, other: &Derivatives) -> Self {
        self.0.resize(self.0.len().max(other.0.len()), [0; 2]);
        for (own, other) in self.0.iter_mut().zip(&other.0) {
            *own = [own[0] + other[0], own[1] + other[1]];
        }
        self
    }

    /// How many were exact, and how many differences.
    pub fn sum(&self) -> [u64; 2] {
        let all = self.0.iter();
        all.fold([0; 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]])
    }
}

/// Where something was worked out last.
#[derive(Debug, Default)]
pub struct Last {
    pub numbers: Option<Vec<f64>>,
    pub path: Option<(Vec<f64>, Vec<Node>)>,
}
