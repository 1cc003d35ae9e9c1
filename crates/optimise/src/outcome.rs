//! What a function gives at a point, and the box in which points lie.

/// What a function gives at a point.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// Finite numbers.
    Values(Vec<f64>),
    /// None.
    Missing,
    /// Whoever asked wants no more.
    Stopped,
}

impl Outcome {
    /// These values where all are finite.
    pub fn of(values: Vec<f64>) -> Self {
        match values.iter().all(|value| value.is_finite()) {
            true => Outcome::Values(values),
            false => Outcome::Missing,
        }
    }

    /// The values, where there are some.
    pub fn values(self) -> Option<Vec<f64>> {
        match self {
            Outcome::Values(values) => Some(values),
            Outcome::Missing | Outcome::Stopped => None,
        }
    }
}

/// What gives values at points, and perhaps their derivatives.
pub trait Evaluate {
    /// What it gives at a point.
    fn values(&mut self, x: &[f64]) -> Outcome;
    /// Its derivatives at a point where it has values: a row for each value, by rows, NaN where one is not known. `None` if
    /// none of them is.
    fn slopes(&mut self, _x: &[f64]) -> Option<Vec<f64>> {
        None
    }
}

impl<F: FnMut(&[f64]) -> Outcome> Evaluate for F {
    fn values(&mut self, x: &[f64]) -> Outcome {
        self(x)
    }
}

/// A function of a point.
pub type Function<'f> = dyn Evaluate + 'f;

/// Lower and upper bound of each variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    lower: Vec<f64>,
    upper: Vec<f64>,
}

/// A bound that is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The lower one.
    Lower,
    /// The upper one.
    Upper,
}

/// A variable stands at its bound when it is nearer to it than this part of its range.
const AT_BOUND: f64 = 1e-9;

impl Bounds {
    /// Of each variable the lower and the upper bound, which is above it.
    pub fn new(ranges: &[[f64; 2]]) -> Self {
        Bounds {
            lower: ranges.iter().map(|range| range[0]).collect(),
            upper: ranges.iter().map(|range| range[1]).collect(),
        }
    }

    /// How many variables there are.
    pub fn len(&self) -> usize {
        self.lower.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.lower.is_empty()
    }

    /// Lower and upper bound of a variable.
    pub fn of(&self, k: usize) -> [f64; 2] {
        [self.lower[k], self.upper[k]]
    }

    /// Range of a variable.
    pub fn width(&self, k: usize) -> f64 {
        self.upper[k] - self.lower[k]
    }

    /// The point with these parts of the ranges.
    pub fn point(&self, parts: &[f64]) -> Vec<f64> {
        let all = parts.iter().enumerate();
        all.map(|(k, part)| {
            (self.lower[k] + part * self.width(k)).clamp(self.lower[k], self.upper[k])
        })
        .collect()
    }

    /// Puts a point into the box.
    pub fn clamp(&self, x: &mut [f64]) {
        for (k, x) in x.iter_mut().enumerate() {
            *x = x.clamp(self.lower[k], self.upper[k]);
        }
    }

    /// The bound at which a variable stands, if any.
    pub fn end(&self, k: usize, x: f64) -> Option<End> {
        let near = AT_BOUND * self.width(k);
        match x {
            _ if x - self.lower[k] <= near => Some(End::Lower),
            _ if self.upper[k] - x <= near => Some(End::Upper),
            _ => None,
        }
    }
}
