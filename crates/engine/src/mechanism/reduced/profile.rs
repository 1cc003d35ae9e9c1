//! What a mechanism under weights alone is along its curve: numbers of one coordinate, whatever it is made of.
//!
//! ```text
//! m ü = w − g u̇²        m = SᵀMS,  g = SᵀM S′ = ½ dm/du,  w = SᵀQ        functions of u alone
//! ```
//!
//! The coordinate's range is cut into stretches. Where the motion first comes to one, it is sampled at the extrema of a Chebyshev
//! polynomial, which is soon less than the evaluations of a step, and the three functions are polynomials there from then on.
//! A stretch whose highest coefficients have not decayed is evaluated point by point (decay as a measure of error: Trefethen,
//! *Approximation Theory and Approximation Practice*, 2013, ch. 8).

use std::f64::consts::{PI, TAU};

/// Number of samples of a stretch, and of coefficients.
pub(super) const SAMPLES: usize = 12;
/// A turn has so many stretches.
const PARTS: f64 = 16.0;
/// Stretches whose coefficients do not decay, after which no other is tried.
const IN_VAIN: u32 = 4;

/// m, g and w at one point, and Σ|Sᵢ Qᵢ|, by which w is measured.
pub(super) type Terms = [f64; 4];

/// What is known of the stretches so far.
#[derive(Clone)]
pub(super) struct Profile {
    stretches: Vec<ProfileStretch>,
    /// The one requested last.
    last: usize,
    /// Stretches per unit of the coordinate.
    density: f64,
    /// What the coordinate is measured in: 1 rad, or the mechanism's size.
    unit: f64,
    in_vain: u32,
}

#[derive(Clone)]
struct ProfileStretch {
    /// Stretches are numbered from the coordinate's zero, and stand by number.
    number: i64,
    /// Coefficients of the powers of the place, from -1 to 1; `None` if no such polynomial tells it.
    powers: Option<[Terms; SAMPLES]>,
}

/// What a stretch says of a point.
pub(super) enum Told {
    /// ü there.
    Acceleration(f64),
    /// It is to be sampled.
    Wanted,
    /// Nothing.
    Nothing,
}

/// The greatest whole number not above x.
#[inline]
fn floor(x: f64) -> i64 {
    let whole = x as i64;
    whole.saturating_sub(i64::from(whole as f64 > x))
}

impl Profile {
    /// Nothing known.
    pub fn new() -> Self {
        Profile {
            stretches: Vec::new(),
            last: 0,
            density: PARTS / TAU,
            unit: 1.0,
            in_vain: 0,
        }
    }

    /// Forgets everything: what follows is of a coordinate that is measured in `unit`, and is in this range. All room is made.
    pub fn restart(&mut self, unit: f64, (low, high): (f64, f64)) {
        self.stretches.clear();
        (self.last, self.unit, self.in_vain) = (0, unit, 0);
        self.density = PARTS / (TAU * unit);
        self.stretches
            .reserve(2 + ((high - low) * self.density) as usize);
    }

    /// What is known at (u, u̇).
    pub fn at(&mut self, u: f64, rate: f64) -> Told {
        let place = u * self.density;
        let number = floor(place);
        if self
            .stretches
            .get(self.last)
            .is_none_or(|own| own.number != number)
        {
            match self
                .stretches
                .binary_search_by_key(&number, |own| own.number)
            {
                Ok(found) => self.last = found,
                Err(_) if self.in_vain < IN_VAIN => return Told::Wanted,
                Err(_) => return Told::Nothing,
            }
        }
        let Some(powers) = &self.stretches[self.last].powers else {
            return Told::Nothing;
        };
        let [mass, bend, weight] = sums_of_powers(powers, 2.0 * (place - number as f64) - 1.0);
        if mass > 0.0 {
            Told::Acceleration((weight - bend * rate * rate) / mass)
        } else {
            Told::Nothing
        }
    }

    /// Where the stretch that `u` is in is to be sampled.
    pub fn places(&self, u: f64) -> [f64; SAMPLES] {
        let middle = floor(u * self.density) as f64 + 0.5;
        std::array::from_fn(|j| (middle + 0.5 * extremum(j)) / self.density)
    }

    /// Takes the samples of the stretch that `u` is in; `None` if there is a point that the curve does not tell. `error` is the
    /// largest that is allowed, by the sizes of the terms.
    pub fn take(&mut self, u: f64, samples: Option<&[Terms; SAMPLES]>, error: f64) {
        let powers = samples.and_then(|samples| powers(samples, self.unit, error));
        self.in_vain += u32::from(powers.is_none());
        let stretch = ProfileStretch {
            number: floor(u * self.density),
            powers,
        };
        let place = self
            .stretches
            .partition_point(|own| own.number < stretch.number);
        self.stretches.insert(place, stretch);
    }
}

/// An extremum of the Chebyshev polynomial, ascending.
fn extremum(j: usize) -> f64 {
    -(PI * j as f64 / (SAMPLES - 1) as f64).cos()
}

/// Coefficients of the powers through samples at the extrema; `None` if those of the last Chebyshev polynomials are not small.
///
/// m is measured by the mean of its least and its largest, as the error of SᵀMS grows where S becomes small; g by that over the
/// unit; and w by what would pull were all weights to help each other.
fn powers(samples: &[Terms; SAMPLES], unit: f64, error: f64) -> Option<[Terms; SAMPLES]> {
    let degree = SAMPLES - 1;
    let cosines: [f64; 2 * (SAMPLES - 1)] =
        std::array::from_fn(|i| 2.0 / degree as f64 * (PI * i as f64 / degree as f64).cos());
    let end = |j: usize| if j == 0 || j == degree { 0.5 } else { 1.0 };
    // c_k = 2/N Σ″ f(x_j) T_k(x_j), the first and the last by half
    let chebyshev: [Terms; SAMPLES] = std::array::from_fn(|k| {
        samples
            .iter()
            .enumerate()
            .fold([0.0; 4], |sum, (j, terms)| {
                let weight = end(j) * end(k) * cosines[(degree - j) * k % (2 * degree)];
                std::array::from_fn(|lane| sum[lane] + weight * terms[lane])
            })
    });
    let largest = |lane: usize| {
        samples
            .iter()
            .fold(0.0, |most, terms| f64::max(most, terms[lane]))
    };
    let least = samples
        .iter()
        .fold(f64::INFINITY, |least, terms| f64::min(least, terms[0]));
    let mass = (least.max(0.0) * largest(0)).sqrt();
    let sizes = [mass, mass / unit, largest(3)];
    for (lane, size) in sizes.iter().enumerate() {
        let rest = chebyshev[SAMPLES - 2..].iter().map(|c| c[lane].abs());
        let rest: f64 = rest.sum();
        if rest.is_nan() || rest > error * size {
            return None;
        }
    }
    // T_{k+1} = 2 x T_k − T_{k−1}
    let mut powers = [[0.0; 4]; SAMPLES];
    let (mut before, mut here) = ([0.0; SAMPLES], [0.0; SAMPLES]);
    here[0] = 1.0;
    for (k, coefficient) in chebyshev.iter().enumerate() {
        for (power, t) in powers.iter_mut().zip(&here) {
            power
                .iter_mut()
                .zip(coefficient)
                .for_each(|(power, c)| *power += t * c);
        }
        let double = if k == 0 { 1.0 } else { 2.0 };
        let next = std::array::from_fn(|i| {
            let raised = if i == 0 { 0.0 } else { double * here[i - 1] };
            raised - before[i]
        });
        (before, here) = (here, next);
    }
    Some(powers)
}

/// Σ cₖ xᵏ of the three functions, even and odd powers beside each other.
fn sums_of_powers(powers: &[Terms; SAMPLES], x: f64) -> [f64; 3] {
    let square = x * x;
    let (mut even, mut odd) = ([0.0; 4], [0.0; 4]);
    let (pairs, _) = powers.as_chunks::<2>();
    for [of_even, of_odd] in pairs.iter().rev() {
        for lane in 0..4 {
            even[lane] = even[lane] * square + of_even[lane];
            odd[lane] = odd[lane] * square + of_odd[lane];
        }
    }
    [0, 1, 2].map(|lane| even[lane] + x * odd[lane])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ü where the stretch of `u` has been sampled from these terms.
    fn told(profile: &mut Profile, terms: fn(f64) -> Terms, u: f64, rate: f64) -> Told {
        if let Told::Wanted = profile.at(u, rate) {
            let samples = profile.places(u).map(terms);
            profile.take(u, Some(&samples), 1e-12);
        }
        profile.at(u, rate)
    }

    #[test]
    fn smooth_terms_are_told() {
        // An eccentric disc that swings: m = 2 + cos u, g = m′/2, w = -9 sin u.
        let terms = |u: f64| [2.0 + u.cos(), -0.5 * u.sin(), -9.0 * u.sin(), 9.0];
        let mut profile = Profile::new();
        profile.restart(1.0, (-7.0, 7.0));
        for k in -700..700 {
            let (u, rate) = (0.01 * f64::from(k), 0.3 * f64::from(k % 11));
            let [m, g, w, _] = terms(u);
            let exact = (w - g * rate * rate) / m;
            match told(&mut profile, terms, u, rate) {
                Told::Acceleration(found) => {
                    assert!((found - exact).abs() < 1e-12, "{u} {found} {exact}")
                }
                Told::Wanted | Told::Nothing => panic!("nothing told at {u}"),
            }
        }
    }

    #[test]
    fn kinks_are_not_told_and_end_the_trying() {
        let terms = |u: f64| {
            [
                1.0,
                0.0,
                if u < 2.0 { (3.0 * u).sin().abs() } else { 0.0 },
                1.0,
            ]
        };
        let mut profile = Profile::new();
        profile.restart(1.0, (-7.0, 7.0));
        assert!(matches!(
            told(&mut profile, terms, 2.5, 1.0),
            Told::Acceleration(_)
        ));
        // A kink at each multiple of π/3.
        for k in 0..IN_VAIN {
            let u = f64::from(k) * -PI / 3.0 + 0.05;
            assert!(matches!(profile.at(u, 1.0), Told::Wanted), "{u}");
            assert!(
                matches!(told(&mut profile, terms, u, 1.0), Told::Nothing),
                "{u}"
            );
        }
        assert!(
            matches!(profile.at(3.5, 1.0), Told::Nothing),
            "tried in vain often enough"
        );
    }

    #[test]
    fn what_the_curve_does_not_tell_is_not_sampled() {
        let mut profile = Profile::new();
        profile.restart(0.1, (0.0, 1.0));
        assert!(matches!(profile.at(0.3, 0.0), Told::Wanted));
        profile.take(0.3, None, 1e-12);
        assert!(matches!(profile.at(0.3, 0.0), Told::Nothing));
    }
}
