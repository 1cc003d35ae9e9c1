//! Numbers with their derivatives by the parameters, carried along by the chain rule (forward differentiation).
//!
//! Where a function has a kink or a jump there is no derivative, which is said and not guessed.

use std::cmp::Ordering;

use super::number::{Number, Real};

/// Partial derivatives, by the index of a parameter in rising order; those that are left out are zero.
pub type Gradient<T> = Vec<(usize, T)>;

/// A number and its derivatives, or the reason why there are none.
#[derive(Debug, Clone)]
pub struct Dual<T> {
    /// The number.
    pub value: T,
    /// Its derivatives.
    pub slope: Result<Gradient<T>, &'static str>,
}

impl<T: Real> Dual<T> {
    /// A parameter, whose derivative by itself is one.
    pub fn deviating(self, index: usize, by: &T) -> Self {
        let own = Dual {
            value: by.clone(),
            slope: Ok(vec![(index, T::of(1.0))]),
        };
        Number::add(&self, &own)
    }

    /// Whether nothing changes it.
    fn is_constant(&self) -> bool {
        matches!(&self.slope, Ok(gradient) if gradient.is_empty())
    }

    /// A function of it, with its derivative there.
    fn map(&self, value: T, derivative: impl FnOnce() -> Result<T, &'static str>) -> Self {
        let slope = match &self.slope {
            Err(reason) => Err(*reason),
            Ok(gradient) if gradient.is_empty() => Ok(Vec::new()),
            Ok(gradient) => derivative().map(|by| scaled(gradient, &by)),
        };
        Dual { value, slope }
    }

    /// A function of two, with its derivatives by both.
    fn both(
        &self,
        other: &Self,
        value: T,
        derivatives: impl FnOnce() -> Result<[T; 2], &'static str>,
    ) -> Self {
        let slope = match (&self.slope, &other.slope) {
            (Err(reason), _) | (_, Err(reason)) => Err(*reason),
            (Ok(one), Ok(two)) if one.is_empty() && two.is_empty() => Ok(Vec::new()),
            (Ok(one), Ok(two)) => derivatives()
                .map(|[by_one, by_two]| sum(scaled(one, &by_one), scaled(two, &by_two))),
        };
        Dual { value, slope }
    }

    /// One of two, where it is sure which.
    fn choose(&self, other: &Self, value: T, first: bool, reason: &'static str) -> Self {
        let slope = match self.value.order(&other.value) {
            _ if self.is_constant() && other.is_constant() => Ok(Vec::new()),
            Some(Ordering::Less | Ordering::Greater) if first => self.slope.clone(),
            Some(Ordering::Less | Ordering::Greater) => other.slope.clone(),
            Some(Ordering::Equal) | None => Err(reason),
        };
        Dual { value, slope }
    }

    /// A function that is flat but where it jumps.
    fn flat(&self, value: T, jumps: bool, reason: &'static str) -> Self {
        let slope = match &self.slope {
            Err(reason) => Err(*reason),
            Ok(gradient) if jumps && !gradient.is_empty() => Err(reason),
            Ok(_) => Ok(Vec::new()),
        };
        Dual { value, slope }
    }
}

fn scaled<T: Real>(gradient: &Gradient<T>, by: &T) -> Gradient<T> {
    let terms = gradient
        .iter()
        .map(|(index, one)| (*index, one.multiply(by)));
    terms.collect()
}

/// The sum of two gradients.
fn sum<T: Real>(one: Gradient<T>, other: Gradient<T>) -> Gradient<T> {
    if one.is_empty() {
        return other;
    }
    let mut total = Vec::with_capacity(one.len() + other.len());
    let mut rest = other.into_iter().peekable();
    for (index, term) in one {
        while let Some(before) = rest.next_if(|(other, _)| *other < index) {
            total.push(before);
        }
        match rest.next_if(|(other, _)| *other == index) {
            Some((_, same)) => total.push((index, term.add(&same))),
            None => total.push((index, term)),
        }
    }
    total.extend(rest);
    total
}

impl<T: Real> Number for Dual<T> {
    fn of(value: f64) -> Self {
        Dual {
            value: T::of(value),
            slope: Ok(Vec::new()),
        }
    }
    fn shown(&self) -> f64 {
        self.value.shown()
    }
    fn is_finite(&self) -> bool {
        self.value.is_finite()
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero()
    }
    fn is_negative(&self) -> bool {
        self.value.is_negative()
    }
    fn exceeds_one(&self) -> bool {
        self.value.exceeds_one()
    }
    fn single(&self) -> Option<f64> {
        self.value.single()
    }
    fn nearly(&self) -> Option<f64> {
        self.value.nearly()
    }
    fn negate(&self) -> Self {
        self.map(self.value.negate(), || Ok(T::of(-1.0)))
    }
    fn add(&self, other: &Self) -> Self {
        let value = self.value.add(&other.value);
        self.both(other, value, || Ok([T::of(1.0), T::of(1.0)]))
    }
    fn subtract(&self, other: &Self) -> Self {
        let value = self.value.subtract(&other.value);
        self.both(other, value, || Ok([T::of(1.0), T::of(-1.0)]))
    }
    fn multiply(&self, other: &Self) -> Self {
        let value = self.value.multiply(&other.value);
        self.both(other, value, || {
            Ok([other.value.clone(), self.value.clone()])
        })
    }
    fn divide(&self, other: &Self) -> Self {
        let value = self.value.divide(&other.value);
        let quotient = value.clone();
        self.both(other, value, || {
            let by = T::of(1.0).divide(&other.value);
            Ok([by, quotient.divide(&other.value).negate()])
        })
    }
    fn power(&self, exponent: &Self) -> Self {
        let value = self.value.power(&exponent.value);
        if !exponent.is_constant() {
            let power = value.clone();
            return self.both(exponent, value, || {
                if self.value.is_negative() || self.value.is_zero() {
                    return Err("a power of a base that is not above zero, whose exponent changes");
                }
                let by_base = exponent.value.multiply(&power).divide(&self.value);
                Ok([by_base, power.multiply(&self.value.ln())])
            });
        }
        self.map(value, || {
            let less = exponent.value.subtract(&T::of(1.0));
            let is_steep = less.is_negative() && exponent.single() != Some(0.0);
            if self.value.is_zero() && is_steep {
                return Err("a root of zero");
            }
            Ok(exponent.value.multiply(&self.value.power(&less)))
        })
    }
    fn sqrt(&self) -> Self {
        let root = self.value.sqrt();
        self.map(root.clone(), || {
            match root.is_zero() || self.value.is_zero() {
                true => Err("a root of zero"),
                false => Ok(T::of(0.5).divide(&root)),
            }
        })
    }
    fn abs(&self) -> Self {
        let sign = self.value.order(&T::of(0.0));
        self.map(self.value.abs(), || match sign {
            Some(Ordering::Less) => Ok(T::of(-1.0)),
            Some(Ordering::Greater) => Ok(T::of(1.0)),
            Some(Ordering::Equal) | None => Err("abs has a kink at zero"),
        })
    }
    fn min(&self, other: &Self) -> Self {
        let first = self.value.order(&other.value) == Some(Ordering::Less);
        let value = self.value.min(&other.value);
        self.choose(other, value, first, "min has a kink where two are equal")
    }
    fn max(&self, other: &Self) -> Self {
        let first = self.value.order(&other.value) == Some(Ordering::Greater);
        let value = self.value.max(&other.value);
        self.choose(other, value, first, "max has a kink where two are equal")
    }
    fn hypot(&self, other: &Self) -> Self {
        let length = self.value.hypot(&other.value);
        self.both(other, length.clone(), || match length.is_zero() {
            true => Err("hypot has a kink at zero"),
            false => Ok([self.value.divide(&length), other.value.divide(&length)]),
        })
    }
    fn atan2(&self, x: &Self) -> Self {
        let value = self.value.atan2(&x.value);
        self.both(x, value, || {
            let is_left = x.value.is_negative() || x.value.is_zero();
            if self.value.is_zero() && is_left {
                return Err("atan2 jumps where its vector points to the left");
            }
            let two = T::of(2.0);
            let square = self.value.power(&two).add(&x.value.power(&two));
            let by_y = x.value.divide(&square);
            Ok([by_y, self.value.divide(&square).negate()])
        })
    }
    fn sin(&self) -> Self {
        self.map(self.value.sin(), || Ok(self.value.cos()))
    }
    fn cos(&self) -> Self {
        self.map(self.value.cos(), || Ok(self.value.sin().negate()))
    }
    fn tan(&self) -> Self {
        let tan = self.value.tan();
        self.map(tan.clone(), || Ok(T::of(1.0).add(&tan.power(&T::of(2.0)))))
    }
    fn asin(&self) -> Self {
        self.map(self.value.asin(), || self.value.by_inverse_sine())
    }
    fn acos(&self) -> Self {
        self.map(self.value.acos(), || {
            self.value.by_inverse_sine().map(|by| by.negate())
        })
    }
    fn atan(&self) -> Self {
        let square = || self.value.power(&T::of(2.0));
        self.map(self.value.atan(), || {
            Ok(T::of(1.0).divide(&T::of(1.0).add(&square())))
        })
    }
    fn exp(&self) -> Self {
        let value = self.value.exp();
        self.map(value.clone(), || Ok(value))
    }
    fn ln(&self) -> Self {
        self.map(self.value.ln(), || Ok(T::of(1.0).divide(&self.value)))
    }
    fn floor(&self) -> Self {
        let jumps = self.value.jumps(0.0);
        self.flat(self.value.floor(), jumps, "floor jumps here")
    }
    fn ceil(&self) -> Self {
        let jumps = self.value.jumps(0.0);
        self.flat(self.value.ceil(), jumps, "ceil jumps here")
    }
    fn round(&self) -> Self {
        let jumps = self.value.jumps(0.5);
        self.flat(self.value.round(), jumps, "round jumps here")
    }
    fn step(&self) -> Self {
        let jumps = self.value.is_zero();
        self.flat(self.value.step(), jumps, "step jumps here")
    }
}

/// The derivative of the inverse sine.
trait InverseSine: Real {
    fn by_inverse_sine(&self) -> Result<Self, &'static str> {
        // (1 − x)(1 + x) keeps the digits near one
        let one = Self::of(1.0);
        let square = one.subtract(self).multiply(&one.add(self));
        if square.is_zero() || square.is_negative() {
            return Err("asin and acos are infinitely steep at -1 and 1");
        }
        Ok(one.divide(&square.sqrt()))
    }
}

impl<T: Real> InverseSine for T {}
