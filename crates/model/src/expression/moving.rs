//! Expressions of the motion: what a force is, of parameters, time and quantities that move.
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

use super::compiled::Constants;
use super::guess::Guess;
use super::number::Number;
use super::program::Program;
use super::quantity::{Fault, Outcome, Quantity, whole};
use super::results::Place;
use super::{Expression, Function, Misfit, Step, apply};
use crate::dimension::Powers;
use crate::expression::Results;

/// Numbers that the stack of a motion's expression holds at most.
pub const DEEPEST_STACK: usize = 64;
/// Quantities that it takes at most.
pub const MOST_ARGUMENTS: usize = 16;

/// An expression of the motion that can be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Moving {
    /// Its arithmetic; inputs are indexes of arguments.
    pub program: Program,
    /// Exponents of length, mass, time and angle of what each kink compares, in the order of the steps.
    pub kinks: Vec<[f64; 4]>,
    pub(crate) quantity: Quantity<Guess>,
}

impl Moving {
    /// Reads an expression and finds its dimension.
    pub(crate) fn read(
        text: &str,
        parameters: &Constants<'_>,
        results: &dyn Results,
        degrees: bool,
    ) -> Result<Moving, Misfit> {
        let names: Vec<String> = parameters.iter().map(|one| one.0.to_owned()).collect();
        let find = |name: &str| parameters.iter().position(|one| one.0 == name);
        let expression = Expression::response(text, &find, &names, results)?;
        let mut stack: Vec<(Quantity<Guess>, Program)> = Vec::new();
        let mut kinks = Vec::new();
        for &(at, step) in &expression.0 {
            let misfit = |fault: Fault| Misfit { at, fault };
            // the parser leaves as many as are taken
            let taken = stack.split_off(stack.len().saturating_sub(step.taken()));
            let (quantities, programs): (Vec<_>, Vec<_>) = taken.into_iter().unzip();
            stack.push(match step {
                Step::Push(quantity) => (known(&quantity), Program::leaf(step)),
                Step::Parameter(index) => (known(&parameters[index].1), Program::leaf(step)),
                Step::Result(result) => {
                    let Place::Row(argument) = result.place else {
                        return Err(misfit(at_the_end()));
                    };
                    if argument >= MOST_ARGUMENTS {
                        let message =
                            format!("an expression takes at most {MOST_ARGUMENTS} quantities");
                        return Err(misfit(Fault::new(message)));
                    }
                    let quantity = Quantity::si(0.0, result.powers).with_value(Guess(None));
                    (quantity, Program::input(argument))
                }
                Step::Reduce(..) | Step::Equal => return Err(misfit(at_the_end())),
                Step::Look(_, columns) => {
                    let looked = looked(&quantities[0], columns).map_err(misfit)?;
                    kinks.push(quantities[0].powers_of());
                    (looked, Program::then(programs, step))
                }
                Step::Negate
                | Step::Add
                | Step::Subtract
                | Step::Multiply
                | Step::Divide
                | Step::Power
                | Step::Call(..) => {
                    if let Step::Call(function, _) = step
                        && function.is_kinked()
                    {
                        kinks.extend(quantities.first().map(Quantity::powers_of));
                    }
                    let quantity = match step {
                        Step::Call(Function::Table, _) => table(&quantities),
                        _ => apply(step, &quantities, degrees),
                    };
                    let quantity = quantity.map_err(misfit)?;
                    (quantity, Program::then(programs, step))
                }
            });
        }
        let whole = stack.pop();
        let (quantity, program) = whole.ok_or_else(|| Misfit {
            at: 0,
            fault: Fault::new("values are missing"),
        })?;
        if program.depth() > DEEPEST_STACK {
            let message = format!(
                "more than {DEEPEST_STACK} numbers have to be remembered at a time in this expression"
            );
            let fault = Fault::new(message).hint("nest it less deep, or give parts to parameters");
            return Err(Misfit { at: 0, fault });
        }
        Ok(Moving {
            program,
            kinks,
            quantity,
        })
    }

    /// The same through a table, by its number and the dimensions of its columns.
    pub(crate) fn through(mut self, table: usize, columns: [Powers; 2]) -> Result<Moving, Fault> {
        self.kinks.push(self.quantity.powers_of());
        Ok(Moving {
            quantity: looked(&self.quantity, columns)?,
            program: Program::then(vec![self.program], Step::Look(table, columns)),
            kinks: self.kinks,
        })
    }

    /// Whether it names anything that moves.
    pub(crate) fn has_arguments(&self) -> bool {
        self.program.inputs().next().is_some()
    }

    /// Whether it may stand where a quantity of these powers is wanted.
    pub(crate) fn fits(&self, wanted: Powers) -> bool {
        let is_zero = self.quantity.value.single() == Some(0.0);
        self.quantity.fits(wanted) || is_zero && self.quantity.exponents == whole(wanted)
    }
}

/// What a table of a model gives, of what is looked up.
fn looked(x: &Quantity<Guess>, [own, gives]: [Powers; 2]) -> Outcome<Guess> {
    if x.fits(own) || x.value.single() == Some(0.0) {
        return Ok(Quantity::si(0.0, gives).with_value(Guess(None)));
    }
    let wanted = Quantity::si(0.0, own).words();
    Err(Fault::new(format!(
        "this table takes {wanted}, not {}",
        x.words()
    )))
}

/// What a table gives, of the quantity that is looked up and the numbers of its points.
fn table(quantities: &[Quantity<Guess>]) -> Outcome<Guess> {
    let [x, points @ ..] = quantities else {
        return Err(Fault::new("values are missing"));
    };
    let such = "as in table(x; x1, y1; x2, y2)";
    if !points.len().is_multiple_of(2) {
        let said = Fault::new("a point of a table has two numbers");
        return Err(said.hint(such));
    }
    let (mut before, mut value) = (None, points[1]);
    for point in points.chunks(2) {
        let [Guess(Some(place)), Guess(Some(_))] = [point[0].value, point[1].value] else {
            let said = Fault::new("the points of a table do not change");
            return Err(said.hint("with numbers and parameters alone"));
        };
        if before.is_some_and(|before| place <= before) {
            return Err(Fault::new("the places of a table increase").hint(such));
        }
        before = Some(place);
        x.min(&point[0])?;
        value = value.min(&point[1])?;
    }
    Ok(value.with_value(Guess(None)))
}

fn known(quantity: &Quantity) -> Quantity<Guess> {
    quantity.with_value(Guess(Some(quantity.value)))
}

fn at_the_end() -> Fault {
    let said = Fault::new("this is known when a run has ended, and not while forces act");
    said.hint("max and min of two values or more are the greater and the smaller one")
}

impl Quantity<Guess> {
    fn powers_of(&self) -> [f64; 4] {
        self.with_value(0.0).powers()
    }
}

/// Functions with kinks and jumps, each on one side of them.
impl Function {
    /// Whether it has any.
    pub(super) fn is_kinked(self) -> bool {
        match self {
            Function::Abs
            | Function::Min
            | Function::Max
            | Function::Floor
            | Function::Ceil
            | Function::Round
            | Function::Step
            | Function::Sign
            | Function::Clamp
            | Function::Modulo
            | Function::Table => true,
            Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Asin
            | Function::Acos
            | Function::Atan
            | Function::Atan2
            | Function::Sqrt
            | Function::Hypot
            | Function::Exp
            | Function::Ln => false,
        }
    }

    /// The side on which these values are.
    pub(super) fn side(self, values: &[f64]) -> i32 {
        let x = values[0];
        // a side that no i32 has is the last one
        let number = |whole: f64| whole as i32;
        match self {
            Function::Min => nearest(values, |one, other| one < other),
            Function::Max => nearest(values, |one, other| one > other),
            Function::Clamp if x < values[1] => -1,
            Function::Clamp => i32::from(x > values[2]),
            Function::Floor => number(x.floor()),
            Function::Ceil => number(x.ceil()),
            Function::Round => number(x.round()),
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
    pub(super) fn beyond(self, values: &[f64], side: i32) -> f64 {
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
            Function::Floor => outside(x, n, n + 1.0),
            Function::Ceil => outside(x, n - 1.0, n),
            Function::Round => outside(x, n - 0.5, n + 0.5),
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
    pub(super) fn on_side<N: Number>(self, values: &[N], side: i32) -> N {
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
            Function::Floor | Function::Ceil | Function::Round | Function::Sign => n,
            Function::Step => N::of(f64::from(i32::from(side > 0))),
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
            Function::Abs if side < 0 => x.negate(),
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

#[cfg(test)]
mod tests;
