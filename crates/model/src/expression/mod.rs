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
mod function;
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
mod split;
mod tangent;
mod written;

pub use chain::Given;
pub(super) use chain::{Chain, Room};
pub use compiled::{Compiled, Input, Over, Reduce, Values};
pub(super) use derivatives::Recorded;
pub use derivatives::{Derivatives, Leaf};
pub use dual::Dual;
pub(super) use function::is_function;
pub use interval::Interval;
pub use moving::{DEEPEST_STACK, MOST_ARGUMENTS, Moving};
pub(super) use naming::with_article;
pub use number::Number;
pub(super) use number::{Binary, Real};
pub use parameters::Parameter;
pub(super) use parameters::{Found, Moved, Parameters};
pub use program::{Fixed, Look, Program};
pub(super) use quantity::{Fault, Pure, Quantity};
pub use reduction::Reduction;
pub use results::{Known, Place, Results};
pub use tangent::Tangent;
pub(super) use written::quantity;

use parse::Parser;
use program::Do;
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

/// What happens to the stack.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Step {
    /// Arithmetic; its inputs are what names among the results stand for.
    Do(Do<Known>),
    /// Of a response: one number of many.
    Reduce(Reduction, usize),
    /// Of a response: both sides of an equation.
    Equal,
}

impl Step {
    /// How many values it takes.
    fn taken(self) -> usize {
        match self {
            Step::Do(step) => step.taken(),
            Step::Reduce(_, count) => count,
            Step::Equal => 2,
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
            Step::Do(Do::Parameter(index)) => Some((*at, *index)),
            Step::Do(_) | Step::Reduce(..) | Step::Equal => None,
        });
        let mut places: Vec<_> = named.collect();
        places.sort_unstable();
        places
    }

    /// The parameters that it names.
    pub fn parameters(&self) -> impl Iterator<Item = usize> {
        self.places().into_iter().map(|(_, index)| index)
    }

    /// Its arithmetic alone; none of a response, or of what moves.
    fn program(&self) -> Option<Program> {
        let steps = self.0.iter().map(|(_, step)| match step {
            Step::Do(Do::Input(_) | Do::Look(..)) | Step::Reduce(..) | Step::Equal => None,
            Step::Do(step) => Some(step.map(|_| 0)),
        });
        steps.collect::<Option<_>>().map(Program)
    }

    /// Its value; `None` if a parameter has none, which is complained about there.
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
            // the parser leaves as many as are taken
            let taken = stack.split_off(stack.len().saturating_sub(step.taken()));
            let result = match step {
                Step::Do(Do::Parameter(index)) => match &values[index] {
                    Some(value) => Ok(value.clone()),
                    None => return Ok(None),
                },
                Step::Do(step) => apply(step, &taken, degrees),
                Step::Reduce(..) | Step::Equal => Err(Fault::new("values are missing")),
            };
            stack.push(result.map_err(|fault| Misfit { at, fault })?);
        }
        Ok(stack.pop())
    }
}

/// One step but those of names, with the values that it takes.
fn apply<N: Number>(step: Do<Known>, values: &[Quantity<N>], degrees: bool) -> Outcome<N> {
    match step {
        Do::Push(value) => Ok(value.with_value(N::of(value.value))),
        Do::Call(function, _) => function.of_quantities(values, degrees),
        Do::Parameter(_) | Do::Input(_) | Do::Look(..) => Err(Fault::new("values are missing")),
    }
}

#[cfg(test)]
mod tests;
