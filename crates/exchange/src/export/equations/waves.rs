//! Products of sums of vectors, as sums of c cos(φ_i − φ_j + δ).
//!
//! ```text
//! vector   factors · a exp(iφ)                a complex, factors: slides and rates
//! wave     factors · Re(A exp(i(φ_i − φ_j)))  = factors · |A| cos(φ_i − φ_j + arg A)
//! product  Re(ā b exp(i(φ_b − φ_a)))          of two vectors
//! ```

use super::place::{Place, Plane};

/// Amplitudes below this part of what was summed are round-off \[1\].
const ROUND_OFF: f64 = 1e-13;

/// A coordinate or its rate, as a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Factor {
    /// The coordinate.
    Value(usize),
    /// Its rate.
    Rate(usize),
}

/// A vector that turns with a coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnedVector {
    /// a
    pub amplitude: Plane,
    /// φ
    pub angle: Option<usize>,
    /// Slides and rates.
    pub factors: Vec<Factor>,
}

/// A term c cos(φ_i − φ_j + δ) with factors.
#[derive(Debug, Clone, PartialEq)]
pub struct Wave {
    /// Slides and rates, ascending.
    pub factors: Vec<Factor>,
    /// φ_i
    pub plus: Option<usize>,
    /// φ_j
    pub minus: Option<usize>,
    /// A
    pub amplitude: Plane,
    /// The sum of the magnitudes that were added.
    size: f64,
}

/// A sum of them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Waves(Vec<Wave>);

fn times([a, b]: Plane, [c, d]: Plane) -> Plane {
    [a * c - b * d, a * d + b * c]
}

fn vector(amplitude: Plane, angle: Option<usize>, factors: Vec<Factor>) -> TurnedVector {
    TurnedVector {
        amplitude,
        angle,
        factors,
    }
}

/// A constant vector.
pub fn constant(amplitude: Plane) -> Vec<TurnedVector> {
    vec![vector(amplitude, None, Vec::new())]
}

/// The place itself.
pub fn value(place: &Place) -> Vec<TurnedVector> {
    let vectors = place.0.iter().map(|one| {
        let slide = one.slide.map(Factor::Value);
        let amplitude = times(one.value, [one.sign, 0.0]);
        vector(amplitude, one.angle, slide.into_iter().collect())
    });
    vectors.collect()
}

/// Its derivative by a coordinate.
pub fn slope(place: &Place, by: usize) -> Vec<TurnedVector> {
    let mut vectors = Vec::new();
    for one in &place.0 {
        if one.angle == Some(by) {
            let slide = one.slide.map(Factor::Value);
            let amplitude = times(one.value, [0.0, one.sign]);
            vectors.push(vector(amplitude, one.angle, slide.into_iter().collect()));
        }
        if one.slide == Some(by) {
            let amplitude = times(one.value, [one.sign, 0.0]);
            vectors.push(vector(amplitude, one.angle, Vec::new()));
        }
    }
    vectors
}

/// Its acceleration at constant rates.
pub fn bend(place: &Place) -> Vec<TurnedVector> {
    let mut vectors = Vec::new();
    for one in &place.0 {
        let Some(angle) = one.angle else { continue };
        let turning = Factor::Rate(angle);
        let mut factors = vec![turning, turning];
        if let Some(slide) = one.slide {
            let amplitude = times(one.value, [0.0, 2.0 * one.sign]);
            let both = vec![Factor::Rate(slide), turning];
            vectors.push(vector(amplitude, one.angle, both));
            factors.push(Factor::Value(slide));
        }
        let amplitude = times(one.value, [-one.sign, 0.0]);
        vectors.push(vector(amplitude, one.angle, factors));
    }
    vectors
}

impl Waves {
    /// Adds a constant.
    pub fn add_constant(&mut self, value: f64) {
        self.add_product(value, &constant([1.0, 0.0]), &constant([1.0, 0.0]));
    }

    /// Adds a multiple of the product of two sums.
    pub fn add_product(&mut self, by: f64, one: &[TurnedVector], other: &[TurnedVector]) {
        for a in one {
            for b in other {
                let [x, y] = a.amplitude;
                let product = times([x, -y], b.amplitude);
                let factors = [a.factors.as_slice(), &b.factors].concat();
                self.add(factors, (b.angle, a.angle), times([by, 0.0], product));
            }
        }
    }

    fn add(
        &mut self,
        mut factors: Vec<Factor>,
        (plus, minus): (Option<usize>, Option<usize>),
        [x, y]: Plane,
    ) {
        factors.sort();
        // Re(A exp(iψ)) = Re(Ā exp(−iψ)): the first coordinate is positive.
        let flips = plus.map_or(usize::MAX, |k| k) > minus.map_or(usize::MAX, |k| k);
        let (plus, minus, amplitude) = match (plus == minus, flips) {
            (true, _) => (None, None, [x, 0.0]),
            (false, true) => (minus, plus, [x, -y]),
            (false, false) => (plus, minus, [x, y]),
        };
        let size = amplitude[0].hypot(amplitude[1]);
        let mut waves = self.0.iter_mut();
        let same =
            waves.find(|own| own.factors == factors && own.plus == plus && own.minus == minus);
        match same {
            Some(same) => {
                same.amplitude[0] += amplitude[0];
                same.amplitude[1] += amplitude[1];
                same.size += size;
            }
            None => self.0.push(Wave {
                factors,
                plus,
                minus,
                amplitude,
                size,
            }),
        }
    }

    /// The terms but for round-off.
    pub fn terms(&self) -> impl Iterator<Item = &Wave> {
        let is_there = |one: &&Wave| {
            let [x, y] = one.amplitude;
            x.hypot(y) > ROUND_OFF * one.size
        };
        self.0.iter().filter(is_there)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::equations::place::{Summand, dot};

    /// Its value at coordinates and rates.
    fn evaluated(waves: &Waves, p: &[f64], rates: &[f64]) -> f64 {
        let term = |wave: &Wave| {
            let angle = |k: Option<usize>| k.map_or(0.0, |k| p[k]);
            let (sin, cos) = (angle(wave.plus) - angle(wave.minus)).sin_cos();
            let factors = wave.factors.iter().map(|factor| match *factor {
                Factor::Value(k) => p[k],
                Factor::Rate(k) => rates[k],
            });
            let [x, y] = wave.amplitude;
            (x * cos - y * sin) * factors.product::<f64>()
        };
        waves.terms().map(term).sum()
    }

    fn place(summands: &[(f64, Plane, Option<usize>, Option<usize>)]) -> Place {
        let summands = summands.iter().enumerate();
        let summand = |(vector, &(sign, value, angle, slide))| Summand {
            sign,
            vector,
            value,
            angle,
            slide,
        };
        Place(summands.map(summand).collect())
    }

    #[test]
    fn products_of_slopes_are_those_of_vectors() {
        let one = place(&[
            (1.0, [0.3, -0.1], Some(0), None),
            (-1.0, [0.6, 0.8], Some(1), Some(2)),
            (1.0, [1.0, 0.0], None, Some(3)),
        ]);
        let other = place(&[
            (1.0, [0.2, 0.5], Some(1), None),
            (1.0, [0.1, 0.4], Some(0), Some(2)),
        ]);
        let p = [0.7, -1.9, 0.45, 2.0];
        for i in 0..4 {
            for j in 0..4 {
                let mut waves = Waves::default();
                waves.add_product(2.5, &slope(&one, i), &slope(&other, j));
                let expected = 2.5 * dot(one.slopes(&p)[i], other.slopes(&p)[j]);
                let found = evaluated(&waves, &p, &[0.0; 4]);
                assert!(
                    (found - expected).abs() < 1e-15,
                    "{i} {j}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn bends_are_second_derivatives_along_a_motion() {
        let one = place(&[
            (1.0, [0.3, -0.1], Some(0), None),
            (-1.0, [0.6, 0.8], Some(1), Some(2)),
        ]);
        let (p, rates) = ([0.7, -1.9, 0.45], [1.3, -0.4, 0.9]);
        let at =
            |t: f64| -> Vec<f64> { p.iter().zip(rates).map(|(p, rate)| p + t * rate).collect() };
        for axis in [[1.0, 0.0], [0.0, 1.0]] {
            let mut place = Waves::default();
            place.add_product(1.0, &constant(axis), &value(&one));
            let mut waves = Waves::default();
            waves.add_product(1.0, &constant(axis), &bend(&one));
            let h = 1e-4;
            let [before, now, after] = [-h, 0.0, h].map(|t| evaluated(&place, &at(t), &rates));
            let expected = (before - 2.0 * now + after) / (h * h);
            let found = evaluated(&waves, &p, &rates);
            assert!((found - expected).abs() < 1e-6, "{found} {expected}");
        }
    }

    #[test]
    fn what_cancels_is_no_term() {
        let mut waves = Waves::default();
        let arm = vec![vector([0.1, 0.2], Some(0), Vec::new())];
        waves.add_product(0.3, &arm, &constant([1.0, 0.0]));
        waves.add_product(-0.1, &arm, &constant([3.0, 0.0]));
        assert_eq!(waves.terms().count(), 0);
    }
}
