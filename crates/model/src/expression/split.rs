//! Where the text of a response is split: what is worked out row by row, and what at the end.

use super::compiled::{Compiled, Constants, From, Input, Over, Reduce, Values};
use super::guess::Guess;
use super::number::{Binary, Number};
use super::parse::EQUATIONS;
use super::program::{Do, Program};
use super::quantity::{Fault, Quantity};
use super::reduction::Reduction;
use super::results::{Known, Place, Results};
use super::steps::{Expression, Misfit, Step, apply};
use crate::response::Item;

/// A part of the text that was worked through.
pub(super) struct Part {
    /// Where its first result stands in the text.
    pub at: usize,
    /// What it has values for; none of one number.
    pub over: Option<Over>,
    /// Whether it needs a number that is known at the end only.
    is_late: bool,
    pub quantity: Quantity<Guess>,
    pub program: Program<From>,
    /// Both sides, where it is an equation.
    sides: Option<[Program<From>; 2]>,
}

/// Works through an expression, and keeps what it reduces.
pub(super) struct Splitter<'a> {
    pub text: &'a str,
    pub parameters: &'a Constants<'a>,
    pub degrees: bool,
    pub reductions: Vec<Reduce>,
}

impl Compiled {
    /// Reads a response and finds its dimension.
    pub(crate) fn read(
        text: &str,
        parameters: &Constants<'_>,
        results: &dyn Results,
        degrees: bool,
    ) -> Result<Compiled, Misfit> {
        let names: Vec<String> = parameters.iter().map(|one| one.0.to_owned()).collect();
        let find = |name: &str| parameters.iter().position(|one| one.0 == name);
        let expression = Expression::response(text, &find, &names, results)?;
        let mut splitter = Splitter {
            text,
            parameters,
            degrees,
            reductions: Vec::new(),
        };
        let whole = splitter.split(&expression)?;
        if whole.over.is_some() {
            let said = Fault::new("this has many values: which one of them?");
            let what = if matches!(whole.over, Some(Over::Rows)) {
                "max( … ), mean( … ), last( … ), or at( … , driver.NAME = value)"
            } else {
                "max( … ), sum( … ) or count( … )"
            };
            return Err(Misfit {
                at: whole.at,
                fault: said.hint(what),
            });
        }
        let total = whole.program.map(|from| match from {
            From::Reduced(index) => Input::Reduced(index),
            From::Place(Place::Fact(fact)) => Input::Fact(fact),
            // a part with these has many values
            From::Place(Place::Row(_) | Place::Item(..)) => Input::Reduced(0),
        });
        Ok(Compiled {
            reductions: splitter.reductions,
            total,
            unit: unit(&whole.quantity),
            quantity: whole.quantity.with_value(0.0),
        })
    }
}

/// The unit of a quantity; impulses are in N·s.
fn unit(quantity: &Quantity<Guess>) -> String {
    match quantity.unit() {
        unit if unit == "kg*m/s" => "N*s".to_owned(),
        unit => unit,
    }
}

impl Splitter<'_> {
    /// The whole of it.
    pub fn split(&mut self, expression: &Expression) -> Result<Part, Misfit> {
        let mut stack: Vec<Part> = Vec::new();
        for &(at, step) in &expression.0 {
            // the parser leaves as many as are taken
            let taken = stack.split_off(stack.len().saturating_sub(step.taken()));
            let part = self.part(at, step, taken);
            stack.push(part.map_err(|(place, fault)| Misfit {
                at: place.unwrap_or(at),
                fault,
            })?);
        }
        let nothing = || Misfit {
            at: 0,
            fault: Fault::new("values are missing"),
        };
        stack.pop().ok_or_else(nothing)
    }

    fn part(&mut self, at: usize, step: Step, taken: Vec<Part>) -> Result<Part, Placed> {
        match step {
            Step::Reduce(reduction, _) => self.reduce(at, reduction, taken),
            Step::Equal => equation(taken),
            Step::Do(step) => self.arithmetic(at, step, taken),
        }
    }

    fn arithmetic(&self, at: usize, step: Do<Known>, taken: Vec<Part>) -> Result<Part, Placed> {
        let known = |of: &Quantity| of.with_value(Guess(Some(of.value)));
        let own = |quantity| {
            let program = Program(vec![step.map(|known| From::Place(known.place))]);
            Part::one(at, quantity, program)
        };
        match step {
            Do::Push(quantity) => return Ok(own(known(&quantity))),
            Do::Parameter(index) => return Ok(own(known(&self.parameters[index].1))),
            Do::Input(result) => {
                let quantity = Quantity::si(0.0, result.powers).with_value(Guess(None));
                let (over, is_late) = match result.place {
                    Place::Row(_) => (Some(Over::Rows), false),
                    Place::Item(list, _) => (Some(Over::List(list)), false),
                    Place::Fact(_) => (None, true),
                };
                let part = own(quantity);
                return Ok(Part {
                    over,
                    is_late,
                    ..part
                });
            }
            Do::Look(..) => {
                return Err((None, Fault::new("a table stands in a force, or in a state")));
            }
            Do::Call(..) => {}
        }
        let (at, over, is_late) = together(&taken)?;
        let quantities: Vec<Quantity<Guess>> = taken.iter().map(|part| part.quantity).collect();
        let quantity = apply(step, &quantities, self.degrees).map_err(|fault| (None, fault))?;
        let programs = taken.into_iter().map(|part| part.program).collect();
        let step = step.map(|known| From::Place(known.place));
        Ok(Part {
            at,
            over,
            is_late,
            quantity,
            program: Program::then(programs, step),
            sides: None,
        })
    }

    fn reduce(
        &mut self,
        at: usize,
        reduction: Reduction,
        taken: Vec<Part>,
    ) -> Result<Part, Placed> {
        let mut taken = taken.into_iter();
        let Some(first) = taken.next() else {
            return Err(missing());
        };
        let (of, condition) = match (reduction, taken.next()) {
            (Reduction::At, Some(condition)) if condition.sides.is_some() => {
                (first, Some(condition))
            }
            (Reduction::At, _) => {
                let said = Fault::new("at takes an expression and an equation");
                return Err((
                    None,
                    said.hint("as in at(rod.angle, driver.motor = 90 deg)"),
                ));
            }
            (Reduction::Count, _) if first.sides.is_some() => (first.left(), Some(first)),
            (_, _) => (first, None),
        };
        if of.sides.is_some() {
            return Err((Some(of.at), no_equation()));
        }
        let over = of
            .over
            .ok_or_else(|| (None, one_number(reduction.word())))?;
        if let Some(condition) = &condition
            && condition.over != Some(Over::Rows)
        {
            let said = Fault::new("no column is in this equation");
            return Err((Some(condition.at), said.hint("as in driver.motor = 90 deg")));
        }
        fits(reduction, over, condition.is_some())?;
        let equation = condition
            .and_then(|part| part.sides)
            .map(|sides| sides.map(|side| side.map(row)));
        let values = match over {
            Over::Rows => Values::Row(of.program.map(row)),
            Over::List(list) => Values::Item(list, of.program.map(item)),
        };
        self.reductions.push(Reduce {
            reduction,
            values,
            equation,
            text: called(self.text, at),
        });
        let index = self.reductions.len() - 1;
        Ok(Part {
            is_late: true,
            ..Part::one(
                at,
                reduction.quantity(of.quantity),
                Program(vec![Do::Input(From::Reduced(index))]),
            )
        })
    }
}

impl Part {
    /// One number.
    fn one(at: usize, quantity: Quantity<Guess>, program: Program<From>) -> Self {
        Part {
            at,
            over: None,
            is_late: false,
            quantity,
            program,
            sides: None,
        }
    }

    /// The left side of an equation, as a part of its own.
    fn left(&self) -> Part {
        let sides = self.sides.clone();
        Part {
            over: self.over,
            ..Part::one(
                self.at,
                self.quantity,
                sides.map_or_else(|| self.program.clone(), |[left, _]| left),
            )
        }
    }
}

/// A fault, and where it is if not at the step.
type Placed = (Option<usize>, Fault);

fn missing() -> Placed {
    (None, Fault::new("values are missing"))
}

fn no_equation() -> Fault {
    Fault::new("there is no place for an equation here").hint(EQUATIONS)
}

fn one_number(word: &str) -> Fault {
    Fault::new(format!(
        "{word} takes what changes along the run, this is one number"
    ))
    .hint("such as a column: rod.angle, driver.motor.effort")
}

/// What several parts have values for, and where the first of them stands.
fn together(parts: &[Part]) -> Result<(usize, Option<Over>, bool), Placed> {
    let (mut over, mut at, mut late) = (None, None, None);
    for part in parts {
        if part.sides.is_some() {
            return Err((Some(part.at), no_equation()));
        }
        match (over, part.over) {
            (_, None) => {}
            (None, found) => (over, at) = (found, Some(part.at)),
            (Some(one), Some(other)) if one == other => {}
            (Some(_), Some(_)) => {
                let said = Fault::new("this has not as many values as what stands before it");
                return Err((
                    Some(part.at),
                    said.hint("reduce each of them on its own, as in max( … )"),
                ));
            }
        }
        late = late.or_else(|| part.is_late.then_some(part.at));
    }
    if let Some(late) = late.filter(|_| over.is_some()) {
        let said =
            Fault::new("this is known at the end only, and can't be taken into account row by row");
        return Err((
            Some(late),
            said.hint("a number of the run stands outside of max( … ) and the like"),
        ));
    }
    let first = parts.first().map_or(0, |part| part.at);
    Ok((at.unwrap_or(first), over, late.is_some()))
}

/// An equation of two parts.
fn equation(taken: Vec<Part>) -> Result<Part, Placed> {
    let (at, over, is_late) = together(&taken)?;
    let Ok([left, right]) = <[Part; 2]>::try_from(taken) else {
        return Err(missing());
    };
    // nothing is nothing in every unit
    let is_zero = |part: &Part| {
        part.over.is_none() && part.quantity.is_pure() && part.quantity.value.is_zero()
    };
    let compared = match (is_zero(&left), is_zero(&right)) {
        (_, true) => Ok(left.quantity),
        (true, false) => Ok(right.quantity),
        (false, false) => left.quantity.two(&right.quantity, Binary::Min),
    };
    let compared = compared.map_err(|fault| (None, fault))?;
    Ok(Part {
        at,
        over,
        is_late,
        quantity: compared,
        program: Program(Vec::new()),
        sides: Some([left.program, right.program]),
    })
}

/// Whether a reduction can be taken over what there is.
fn fits(reduction: Reduction, over: Over, has_equation: bool) -> Result<(), Placed> {
    let word = reduction.word();
    match (over, reduction) {
        (Over::List(_), one) if !one.is_of_lists() => {
            let said = Fault::new(format!("{word} takes columns, not contacts or events"));
            Err((
                None,
                said.hint("of these there are max, min, mean, range, first, last, count and sum"),
            ))
        }
        (Over::Rows, Reduction::Sum) => {
            let said = Fault::new(
                "sum takes contacts or events; a sum of rows would depend on how many there are",
            );
            Err((None, said.hint("over time write integral( … )")))
        }
        (Over::Rows, Reduction::Count) if !has_equation => {
            let said = Fault::new("count takes contacts, events or an equation");
            Err((
                None,
                said.hint("as in count(events.contact) or count(piston.x = 20 mm)"),
            ))
        }
        (Over::Rows | Over::List(_), _) => Ok(()),
    }
}

fn row(from: From) -> usize {
    match from {
        From::Place(Place::Row(column)) => column,
        // parts of rows have nothing else
        From::Place(Place::Item(..) | Place::Fact(_)) | From::Reduced(_) => 0,
    }
}

fn item(from: From) -> Item {
    match from {
        From::Place(Place::Item(_, item)) => item,
        // parts of lists have nothing else
        From::Place(Place::Row(_) | Place::Fact(_)) | From::Reduced(_) => Item::Time,
    }
}

/// The call that begins at a byte, as the text writes it.
fn called(text: &str, at: usize) -> String {
    let rest = &text[at..];
    let mut depth = 0_usize;
    for (index, c) in rest.char_indices() {
        match c {
            '(' => depth += 1,
            ')' if depth <= 1 => return rest[..=index].to_owned(),
            ')' => depth -= 1,
            _ => {}
        }
    }
    rest.to_owned()
}
