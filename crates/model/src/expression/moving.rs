//! Expressions of the motion: what a force is, of parameters, time and quantities that move.

use super::compiled::Constants;
use super::guess::Guess;
use super::number::{Binary, Function, Number};
use super::program::{DEEPEST_STACK, Do, Program};
use super::quantity::{Fault, Outcome, Quantity, whole};
use super::results::{Known, Place};
use super::steps::{Expression, Misfit, Step, apply};
use crate::dimension::Powers;
use crate::expression::Results;

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
            let Step::Do(step) = step else {
                return Err(misfit(at_the_end()));
            };
            let argument = match step {
                Do::Input(result) => argument(result).map_err(misfit)?,
                Do::Push(_) | Do::Parameter(_) | Do::Call(..) | Do::Look(..) => 0,
            };
            let quantity = match step {
                Do::Input(result) => Quantity::si(0.0, result.powers).with_value(Guess(None)),
                Do::Parameter(index) => known(&parameters[index].1),
                Do::Look(_, columns) => {
                    kinks.push(quantities[0].powers_of());
                    looked(&quantities[0], columns).map_err(misfit)?
                }
                Do::Call(Function::Table, _) => {
                    kinks.extend(quantities.first().map(Quantity::powers_of));
                    table(&quantities).map_err(misfit)?
                }
                Do::Push(_) | Do::Call(..) => {
                    if let Do::Call(function, _) = step
                        && function.is_kinked()
                    {
                        kinks.extend(quantities.first().map(Quantity::powers_of));
                    }
                    apply(step, &quantities, degrees).map_err(misfit)?
                }
            };
            stack.push((quantity, Program::then(programs, step.map(|_| argument))));
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
            program: Program::then(vec![self.program], Do::Look(table, columns)),
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
        x.two(&point[0], Binary::Min)?;
        value = value.two(&point[1], Binary::Min)?;
    }
    Ok(value.with_value(Guess(None)))
}

fn known(quantity: &Quantity) -> Quantity<Guess> {
    quantity.with_value(Guess(Some(quantity.value)))
}

/// The index of what moves.
fn argument(result: Known) -> Result<usize, Fault> {
    match result.place {
        Place::Row(argument) if argument < MOST_ARGUMENTS => Ok(argument),
        Place::Row(_) => Err(Fault::new(format!(
            "an expression takes at most {MOST_ARGUMENTS} quantities"
        ))),
        Place::Item(..) | Place::Fact(_) => Err(at_the_end()),
    }
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

#[cfg(test)]
mod tests;
