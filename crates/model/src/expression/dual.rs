//! Numbers with their derivatives by the parameters, carried along by the chain rule (forward differentiation).
//!
//! Where a function has a kink or a jump there is no derivative, which is said and not guessed.

use std::cmp::Ordering;

use super::number::{Binary, Number, Real, Unary};

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
        self.add(&own)
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
    fn one(&self, function: Unary) -> Self {
        let value = self.value.one(function);
        let slope = match &self.slope {
            Err(reason) => Err(*reason),
            Ok(gradient) if gradient.is_empty() => Ok(Vec::new()),
            Ok(gradient) => derivative(function, &self.value, &value)
                .map(|by| by.map_or_else(Vec::new, |by| scaled(gradient, &by))),
        };
        Dual { value, slope }
    }
    fn two(&self, other: &Self, function: Binary) -> Self {
        let (x, y) = (&self.value, &other.value);
        let value = x.two(y, function);
        let both = [&self.slope, &other.slope];
        // one of two, where it is sure which
        let chosen = match function {
            Binary::Min => Some((Ordering::Less, "min has a kink where two are equal")),
            Binary::Max => Some((Ordering::Greater, "max has a kink where two are equal")),
            _ => None,
        };
        let slope = match (both, chosen) {
            ([Ok(one), Ok(two)], _) if one.is_empty() && two.is_empty() => Ok(Vec::new()),
            ([one, two], Some((wanted, reason))) => match x.order(y) {
                Some(Ordering::Equal) | None => Err(reason),
                Some(order) if order == wanted => one.clone(),
                Some(_) => two.clone(),
            },
            ([Err(reason), _] | [_, Err(reason)], None) => Err(*reason),
            ([Ok(one), Ok(two)], None) if function == Binary::Power && two.is_empty() => {
                by_base(x, y).map(|by| scaled(one, &by))
            }
            ([Ok(one), Ok(two)], None) => derivatives(function, [x, y], &value)
                .map(|[by_one, by_two]| sum(scaled(one, &by_one), scaled(two, &by_two))),
        };
        Dual { value, slope }
    }
}

/// The derivative of a function, with its value there; none of one that is flat.
fn derivative<T: Real>(function: Unary, x: &T, value: &T) -> Result<Option<T>, &'static str> {
    let one = T::of(1.0);
    let flat = |jumps: bool, reason| if jumps { Err(reason) } else { Ok(None) };
    let found = match function {
        Unary::Negate => T::of(-1.0),
        Unary::Sqrt if value.is_zero() || x.is_zero() => return Err("a root of zero"),
        Unary::Sqrt => T::of(0.5).divide(value),
        Unary::Abs => match x.order(&T::of(0.0)) {
            Some(Ordering::Less) => T::of(-1.0),
            Some(Ordering::Greater) => one,
            Some(Ordering::Equal) | None => return Err("abs has a kink at zero"),
        },
        Unary::Sin => x.one(Unary::Cos),
        Unary::Cos => x.one(Unary::Sin).negate(),
        Unary::Tan => one.add(&value.square()),
        Unary::Asin => by_inverse_sine(x)?,
        Unary::Acos => by_inverse_sine(x)?.negate(),
        Unary::Atan => one.divide(&one.add(&x.square())),
        Unary::Exp => value.clone(),
        Unary::Ln => one.divide(x),
        Unary::Floor => return flat(x.jumps(0.0), "floor jumps here"),
        Unary::Ceil => return flat(x.jumps(0.0), "ceil jumps here"),
        Unary::Round => return flat(x.jumps(0.5), "round jumps here"),
        Unary::Step => return flat(x.is_zero(), "step jumps here"),
    };
    Ok(Some(found))
}

/// The derivatives of a function by both numbers, with its value there.
fn derivatives<T: Real>(
    function: Binary,
    [x, y]: [&T; 2],
    value: &T,
) -> Result<[T; 2], &'static str> {
    let one = T::of(1.0);
    Ok(match function {
        Binary::Add => [one.clone(), one],
        Binary::Subtract => [one, T::of(-1.0)],
        Binary::Multiply => [y.clone(), x.clone()],
        Binary::Divide => [one.divide(y), value.divide(y).negate()],
        Binary::Power if x.is_negative() || x.is_zero() => {
            return Err("a power of a base that is not above zero, whose exponent changes");
        }
        Binary::Power => {
            let by_base = y.multiply(value).divide(x);
            [by_base, value.multiply(&x.one(Unary::Ln))]
        }
        Binary::Hypot if value.is_zero() => return Err("hypot has a kink at zero"),
        Binary::Hypot => [x.divide(value), y.divide(value)],
        Binary::Atan2 if x.is_zero() && (y.is_negative() || y.is_zero()) => {
            return Err("atan2 jumps where its vector points to the left");
        }
        Binary::Atan2 => {
            let square = x.square().add(&y.square());
            [y.divide(&square), x.divide(&square).negate()]
        }
        // the derivative of the one that is chosen
        Binary::Min | Binary::Max => return Err("this is one of both"),
    })
}

/// The derivative of a power whose exponent does not change.
fn by_base<T: Real>(base: &T, exponent: &T) -> Result<T, &'static str> {
    let less = exponent.subtract(&T::of(1.0));
    let is_steep = less.is_negative() && exponent.single() != Some(0.0);
    if base.is_zero() && is_steep {
        return Err("a root of zero");
    }
    Ok(exponent.multiply(&base.two(&less, Binary::Power)))
}

/// The derivative of the inverse sine.
fn by_inverse_sine<T: Real>(x: &T) -> Result<T, &'static str> {
    // (1 − x)(1 + x) keeps the digits near one
    let one = T::of(1.0);
    let square = one.subtract(x).multiply(&one.add(x));
    if square.is_zero() || square.is_negative() {
        return Err("asin and acos are infinitely steep at -1 and 1");
    }
    Ok(one.divide(&square.one(Unary::Sqrt)))
}
