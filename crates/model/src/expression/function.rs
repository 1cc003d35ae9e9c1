//! The functions of expressions, on quantities and on plain numbers.
//!
//! `abs`, `min`, `max`, `clamp` have kinks, and `step`, `sign`, `floor`, `ceil`, `round`, `mod` jumps. On either **side** of one the
//! function is smooth. A motion is integrated with all sides held, and an event is where an argument goes beyond its side:
//!
//! ```text
//! abs(x) sign(x) step(x)      side −1, 1          x ≤ 0, x ≥ 0
//! min max (x1, x2, …)         side k              xk is the least, the greatest
//! clamp(x, low, high)         side −1, 0, 1       x ≤ low, between, x ≥ high
//! floor ceil round mod        side n              the whole number
//! table(x; x1, y1; …; xn, yn) side k = 0 … n      straight between (xk, yk) and the next point, y1 before all, yn behind all
//! name(x), of a table         side by its points               of the model
//! ```

use super::Reduction;
use super::number::{Binary, FUNCTIONS, Function, Number, Unary};
use super::quantity::{Fault, Outcome, Quantity};

/// How many of them no parameter may be called like; files may have parameters that are called like those that came later.
pub(super) const RESERVED: usize = 17;

/// The one constant.
pub(super) const PI: &str = "pi";

/// Whether a name is that of a function, or of what many values become one by.
pub fn is_function(name: &str) -> bool {
    let functions = FUNCTIONS.iter().map(|row| row.0);
    let reductions = Reduction::ALL.into_iter().map(Reduction::word);
    name == PI || functions.chain(reductions).any(|word| word == name)
}

impl Function {
    /// Its value.
    pub fn of<N: Number>(self, values: &[N]) -> N {
        let first = &values[0];
        let second = values.get(1).unwrap_or(first);
        let fold = |function| {
            let start = first.clone();
            values.iter().fold(start, |found, x| found.two(x, function))
        };
        match self {
            Function::One(function) => first.one(function),
            Function::Two(function) => first.two(second, function),
            Function::Min => fold(Binary::Min),
            Function::Max => fold(Binary::Max),
            Function::Sign => first.sign(),
            Function::Clamp => {
                let above = first.two(second, Binary::Max);
                above.two(values.get(2).unwrap_or(second), Binary::Min)
            }
            Function::Modulo => first.modulo(second),
            Function::Table => {
                let numbers: Vec<f64> = values.iter().map(N::shown).collect();
                self.on_side(values, self.side(&numbers))
            }
        }
    }

    /// Its value with its dimension.
    pub fn of_quantities<N: Number>(self, values: &[Quantity<N>], degrees: bool) -> Outcome<N> {
        let [first, rest @ ..] = values else {
            return Err(Fault::new("values are missing"));
        };
        let second = rest.first().unwrap_or(first);
        let fold = |function| {
            let start = first.clone();
            rest.iter()
                .try_fold(start, |found, x| found.two(x, function))
        };
        match self {
            Function::One(function) => first.one(function, degrees),
            Function::Two(function) => first.two(second, function),
            Function::Min => fold(Binary::Min),
            Function::Max => fold(Binary::Max),
            Function::Sign => Ok(first.sided(first.value.sign())),
            Function::Clamp => {
                let above = first.two(second, Binary::Max)?;
                above.two(rest.get(1).unwrap_or(second), Binary::Min)
            }
            Function::Modulo => first.modulo(second),
            Function::Table => Err(Fault::new(
                "a table stands in a force that depends on what moves",
            )),
        }
    }

    /// Whether it has kinks or jumps.
    pub fn is_kinked(self) -> bool {
        match self {
            Function::One(function) => match function {
                Unary::Abs | Unary::Floor | Unary::Ceil | Unary::Round | Unary::Step => true,
                Unary::Negate
                | Unary::Sqrt
                | Unary::Sin
                | Unary::Cos
                | Unary::Tan
                | Unary::Asin
                | Unary::Acos
                | Unary::Atan
                | Unary::Exp
                | Unary::Ln => false,
            },
            Function::Two(_) => false,
            Function::Min
            | Function::Max
            | Function::Sign
            | Function::Clamp
            | Function::Modulo
            | Function::Table => true,
        }
    }

    /// The side on which these values are.
    pub fn side(self, values: &[f64]) -> i32 {
        let x = values[0];
        // a side that no i32 has is the last one
        let number = |whole: f64| whole as i32;
        match self {
            Function::Min => nearest(values, |one, other| one < other),
            Function::Max => nearest(values, |one, other| one > other),
            Function::Clamp if x < values[1] => -1,
            Function::Clamp => i32::from(x > values[2]),
            Function::One(Unary::Floor) => number(x.floor()),
            Function::One(Unary::Ceil) => number(x.ceil()),
            Function::One(Unary::Round) => number(x.round()),
            Function::Modulo => number((x / values[1]).floor()),
            Function::Table => {
                let behind = values[1..].chunks(2).filter(|point| x >= point[0]);
                i32::try_from(behind.count()).unwrap_or(0)
            }
            // abs, sign and step; the rest has one side
            _ if x >= 0.0 => 1,
            _ => -1,
        }
    }

    /// How far these values are beyond a side, not above zero on it; of whole numbers as a part of one.
    pub fn beyond(self, values: &[f64], side: i32) -> f64 {
        let (x, n) = (values[0], f64::from(side));
        let others = |past: fn(f64, f64) -> f64| {
            let own = usize::try_from(side).unwrap_or(0).min(values.len() - 1);
            let others = values.iter().enumerate().filter(|(other, _)| *other != own);
            let past = others.map(|(_, other)| past(values[own], *other));
            past.fold(f64::NEG_INFINITY, f64::max)
        };
        let outside = |x: f64, low: f64, high: f64| (low - x).max(x - high);
        match self {
            Function::Min => others(|own, other| own - other),
            Function::Max => others(|own, other| other - own),
            Function::Clamp => match side {
                -1 => x - values[1],
                0 => outside(x, values[1], values[2]),
                _ => values[2] - x,
            },
            Function::One(Unary::Floor) => outside(x, n, n + 1.0),
            Function::One(Unary::Ceil) => outside(x, n - 1.0, n),
            Function::One(Unary::Round) => outside(x, n - 0.5, n + 0.5),
            Function::Modulo => {
                let (one, two) = (n * values[1], (n + 1.0) * values[1]);
                outside(x, one.min(two), one.max(two))
            }
            Function::Table => {
                let points = &values[1..];
                let place = |k: i32| points[2 * usize::try_from(k).unwrap_or(0)];
                let last = i32::try_from(points.len() / 2).unwrap_or(0);
                match side {
                    0 => x - place(0),
                    side if side >= last => place(last - 1) - x,
                    side => outside(x, place(side - 1), place(side)),
                }
            }
            _ => -n * x,
        }
    }

    /// Its value on a side.
    pub fn on_side<N: Number>(self, values: &[N], side: i32) -> N {
        let (x, n) = (&values[0], N::of(f64::from(side)));
        match self {
            Function::Min | Function::Max => {
                let index = usize::try_from(side).unwrap_or(0);
                values[index.min(values.len() - 1)].clone()
            }
            Function::Clamp => match side {
                -1 => values[1].clone(),
                0 => x.clone(),
                _ => values[2].clone(),
            },
            Function::One(Unary::Floor | Unary::Ceil | Unary::Round) | Function::Sign => n,
            Function::One(Unary::Step) => N::of(f64::from(i32::from(side > 0))),
            Function::Modulo => x.subtract(&n.multiply(&values[1])),
            Function::Table => {
                let points = &values[1..];
                let point = |k: usize| (&points[2 * k], &points[2 * k + 1]);
                let last = points.len() / 2;
                match usize::try_from(side).unwrap_or(0) {
                    0 => point(0).1.clone(),
                    k if k >= last => point(last - 1).1.clone(),
                    k => {
                        let ((x1, y1), (x2, y2)) = (point(k - 1), point(k));
                        let part = x.subtract(x1).divide(&x2.subtract(x1));
                        y1.add(&y2.subtract(y1).multiply(&part))
                    }
                }
            }
            Function::One(Unary::Abs) if side < 0 => x.negate(),
            _ => x.clone(),
        }
    }
}

/// The index of the value that comes before all others.
fn nearest(values: &[f64], is_before: fn(f64, f64) -> bool) -> i32 {
    let best = (1..values.len()).fold(0, |best, index| {
        match is_before(values[index], values[best]) {
            true => index,
            false => best,
        }
    });
    i32::try_from(best).unwrap_or(0)
}
