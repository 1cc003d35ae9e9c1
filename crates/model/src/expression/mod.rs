//! Expressions: what stands after `=` in a model.
//!
//! ```text
//! sum      = product { ("+" | "-") product }
//! product  = signed { ("*" | "/") signed }
//! signed   = { "+" | "-" } power                    so −r^2 is −(r²)
//! power    = atom [ "^" signed ]                    so 2^3^2 is 2^9
//! atom     = number [ unit ] | name | function "(" sum { "," sum } ")" | "(" sum ")"
//! ```
//!
//! A unit stands behind a number and holds on to it: `1/2 mm` is 1/(2 mm). The text becomes a list of steps on a stack, so
//! that evaluation neither recurses nor reads the text again; names are known or refused while it is read.

mod chain;
mod compiled;
mod derivatives;
mod dual;
mod guess;
mod interval;
mod moving;
mod naming;
mod number;
mod parameters;
mod parse;
mod program;
mod quantity;
mod reduction;
mod results;
mod sided;
mod split;
mod tangent;
mod written;

pub use chain::Given;
pub(super) use chain::{Chain, Room};
pub use compiled::{Compiled, Input, Over, Reduce, Values};
pub(super) use derivatives::Recorded;
pub use derivatives::{Derivatives, Leaf};
pub use dual::Dual;
pub use interval::Interval;
pub use moving::{DEEPEST_STACK, MOST_ARGUMENTS, Moving};
pub(super) use naming::with_article;
pub use number::Number;
pub(super) use number::Real;
pub use parameters::Parameter;
pub(super) use parameters::{Found, Moved, Parameters};
pub use program::Program;
pub(super) use quantity::{Fault, Pure, Quantity};
pub use reduction::Reduction;
pub use results::{Known, Place, Results};
pub use sided::{Fixed, Look};
pub use tangent::Tangent;
pub(super) use written::quantity;

use crate::dimension::Powers;
use parse::Parser;
use quantity::Outcome;

/// Longest text of an expression in characters.
const LONGEST: usize = 4096;

/// Whether a text is an expression.
pub(super) fn is_expression(text: &str) -> bool {
    text.trim_start().starts_with('=')
}

/// A fault at a byte of the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Misfit {
    pub at: usize,
    pub fault: Fault,
}

/// A function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sqrt,
    Abs,
    Min,
    Max,
    Hypot,
    Exp,
    Ln,
    Floor,
    Ceil,
    Round,
    Step,
    Sign,
    Clamp,
    Modulo,
    Table,
}

/// Name, function, least and most values that it takes.
const FUNCTIONS: [(&str, Function, usize, usize); 22] = [
    ("sin", Function::Sin, 1, 1),
    ("cos", Function::Cos, 1, 1),
    ("tan", Function::Tan, 1, 1),
    ("asin", Function::Asin, 1, 1),
    ("acos", Function::Acos, 1, 1),
    ("atan", Function::Atan, 1, 1),
    ("atan2", Function::Atan2, 2, 2),
    ("sqrt", Function::Sqrt, 1, 1),
    ("abs", Function::Abs, 1, 1),
    ("min", Function::Min, 2, usize::MAX),
    ("max", Function::Max, 2, usize::MAX),
    ("hypot", Function::Hypot, 2, 2),
    ("exp", Function::Exp, 1, 1),
    ("ln", Function::Ln, 1, 1),
    ("floor", Function::Floor, 1, 1),
    ("ceil", Function::Ceil, 1, 1),
    ("round", Function::Round, 1, 1),
    ("step", Function::Step, 1, 1),
    ("sign", Function::Sign, 1, 1),
    ("clamp", Function::Clamp, 3, 3),
    ("mod", Function::Modulo, 2, 2),
    ("table", Function::Table, 5, usize::MAX),
];

/// Whether a name is that of a function, or of what many values become one by.
pub(super) fn is_function(name: &str) -> bool {
    let reductions = Reduction::ALL.into_iter().map(Reduction::word);
    name == PI
        || FUNCTIONS
            .iter()
            .map(|row| row.0)
            .chain(reductions)
            .any(|word| word == name)
}

/// Functions whose names no parameter has; files may have parameters that are called like those that came later.
const RESERVED: [&str; 17] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "abs", "min", "max", "hypot",
    "exp", "ln", "floor", "ceil", "round",
];

/// The one constant.
const PI: &str = "pi";

/// What happens to the stack.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Step {
    Push(Quantity),
    /// Index among the parameters.
    Parameter(usize),
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    /// With how many values.
    Call(Function, usize),
    /// Through the table with this number, with the dimensions of its columns.
    Look(usize, [Powers; 2]),
    /// Of a response: what a name among the results stands for.
    Result(Known),
    /// Of a response: one number of many.
    Reduce(Reduction, usize),
    /// Of a response: both sides of an equation.
    Equal,
}

impl Step {
    /// How many values it takes.
    fn taken(self) -> usize {
        match self {
            Step::Push(_) | Step::Parameter(_) | Step::Result(_) => 0,
            Step::Negate | Step::Look(..) => 1,
            Step::Add
            | Step::Subtract
            | Step::Multiply
            | Step::Divide
            | Step::Power
            | Step::Equal => 2,
            Step::Call(_, count) | Step::Reduce(_, count) => count,
        }
    }
}

/// An expression that could be read: steps, each with the byte at which it stands.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Expression(Vec<(usize, Step)>);

impl Expression {
    /// Reads a text that begins with `=`; `find` knows the names of parameters, `names` are all of them for hints.
    ///
    /// # Errors
    /// The first fault, with its place.
    pub fn parse<'a>(
        text: &'a str,
        find: &'a dyn Fn(&str) -> Option<usize>,
        names: &'a [String],
    ) -> Result<Expression, Misfit> {
        Parser::new(text, find, names).read().map(Expression)
    }

    /// Reads the text of a response, which may name results, too.
    ///
    /// # Errors
    /// The first fault, with its place.
    pub fn response<'a>(
        text: &'a str,
        find: &'a dyn Fn(&str) -> Option<usize>,
        names: &'a [String],
        results: &'a dyn Results,
    ) -> Result<Expression, Misfit> {
        let parser = Parser::new(text, find, names);
        parser.with_results(results).read().map(Expression)
    }

    /// Where parameters are named, and which.
    pub fn places(&self) -> Vec<(usize, usize)> {
        let named = self.0.iter().filter_map(|(at, step)| match step {
            Step::Parameter(index) => Some((*at, *index)),
            Step::Push(_)
            | Step::Negate
            | Step::Add
            | Step::Subtract
            | Step::Multiply
            | Step::Divide
            | Step::Power
            | Step::Call(..)
            | Step::Look(..)
            | Step::Result(_)
            | Step::Reduce(..)
            | Step::Equal => None,
        });
        let mut places: Vec<_> = named.collect();
        places.sort_unstable();
        places
    }

    /// The parameters that it names.
    pub fn parameters(&self) -> impl Iterator<Item = usize> {
        self.places().into_iter().map(|(_, index)| index)
    }

    /// Its arithmetic alone; none of a response.
    fn program(&self) -> Option<Program> {
        Program::of_steps(self.0.iter().map(|(_, step)| *step))
    }

    /// Its value; none where a parameter has none, which is complained about there.
    ///
    /// # Errors
    /// Dimensions that do not go together, division by zero, and the like.
    pub fn evaluate<N: Number>(
        &self,
        values: &[Option<Quantity<N>>],
        degrees: bool,
    ) -> Result<Option<Quantity<N>>, Misfit> {
        let mut stack: Vec<Quantity<N>> = Vec::new();
        for &(at, step) in &self.0 {
            if let Step::Parameter(index) = step {
                let Some(value) = &values[index] else {
                    return Ok(None);
                };
                stack.push(value.clone());
                continue;
            }
            // the parser leaves as many as are taken
            let values = stack.split_off(stack.len().saturating_sub(step.taken()));
            let result = apply(step, &values, degrees).map_err(|fault| Misfit { at, fault })?;
            stack.push(result);
        }
        Ok(stack.pop())
    }
}

/// One step but `Parameter`, with the values that it takes.
fn apply<N: Number>(step: Step, values: &[Quantity<N>], degrees: bool) -> Outcome<N> {
    match (step, values) {
        (Step::Push(value), _) => Ok(value.with_value(N::of(value.value))),
        (Step::Negate, [value]) => Ok(value.negate()),
        (Step::Add, [left, right]) => left.add(right),
        (Step::Subtract, [left, right]) => left.subtract(right),
        (Step::Multiply, [left, right]) => left.multiply(right),
        (Step::Divide, [left, right]) => left.divide(right),
        (Step::Power, [left, right]) => left.power(right),
        (Step::Call(function, _), [first, rest @ ..]) => call(function, first, rest, degrees),
        (_, _) => Err(Fault::new("values are missing")),
    }
}

fn call<N: Number>(
    function: Function,
    first: &Quantity<N>,
    rest: &[Quantity<N>],
    degrees: bool,
) -> Outcome<N> {
    let second = rest.first().unwrap_or(first);
    match function {
        Function::Sin => first.circular("sin", degrees, N::sin),
        Function::Cos => first.circular("cos", degrees, N::cos),
        Function::Tan => first.circular("tan", degrees, N::tan),
        Function::Asin => first.inverse_circular("asin", true, N::asin),
        Function::Acos => first.inverse_circular("acos", true, N::acos),
        Function::Atan => first.inverse_circular("atan", false, N::atan),
        Function::Atan2 => first.atan2(second),
        Function::Sqrt => first.sqrt(),
        Function::Abs => Ok(first.abs()),
        Function::Min => rest
            .iter()
            .try_fold(first.clone(), |least, value| least.min(value)),
        Function::Max => rest
            .iter()
            .try_fold(first.clone(), |most, value| most.max(value)),
        Function::Hypot => first.hypot(second),
        Function::Exp => first.function("exp", N::exp),
        Function::Ln => first.ln(),
        Function::Floor => first.function("floor", N::floor),
        Function::Ceil => first.function("ceil", N::ceil),
        Function::Round => first.function("round", N::round),
        Function::Step => Ok(first.sided(N::step)),
        Function::Sign => Ok(first.sided(N::sign)),
        Function::Clamp => first.max(second)?.min(rest.get(1).unwrap_or(second)),
        Function::Modulo => first.modulo(second),
        Function::Table => Err(Fault::new(
            "a table stands in a force that depends on what moves",
        )),
    }
}

#[cfg(test)]
mod tests;
