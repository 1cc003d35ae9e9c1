//! What an expression is once it was read: steps on a stack.

use super::number::Number;
use super::program::{Do, Program};
use super::quantity::{Fault, Outcome, Quantity};
use super::reduction::Reduction;
use super::results::Known;

/// A fault at a byte of the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Misfit {
    pub at: usize,
    pub fault: Fault,
}

/// What happens to the stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    /// Arithmetic; its inputs are what names among the results stand for.
    Do(Do<Known>),
    /// Of a response: one number of many.
    Reduce(Reduction, usize),
    /// Of a response: both sides of an equation.
    Equal,
}

impl Step {
    /// How many values it takes.
    pub fn taken(self) -> usize {
        match self {
            Step::Do(step) => step.taken(),
            Step::Reduce(_, count) => count,
            Step::Equal => 2,
        }
    }
}

/// An expression that could be read: steps, each with the byte at which it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression(pub(super) Vec<(usize, Step)>);

impl Expression {
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
    pub(super) fn program(&self) -> Option<Program> {
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
pub(super) fn apply<N: Number>(
    step: Do<Known>,
    values: &[Quantity<N>],
    degrees: bool,
) -> Outcome<N> {
    match step {
        Do::Push(value) => Ok(value.with_value(N::of(value.value))),
        Do::Call(function, _) => function.of_quantities(values, degrees),
        Do::Parameter(_) | Do::Input(_) | Do::Look(..) => Err(Fault::new("values are missing")),
    }
}
