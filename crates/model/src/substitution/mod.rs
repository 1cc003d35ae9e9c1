//! Other values of parameters in a model whose file is not read again.
//!
//! The numbers that follow from parameters are written over those of the model that was read. That this gives the model
//! that reading would is not believed but tried, at the values of the file and beside them; a file that says more than
//! the numbers known here has no substitution, and is read again for each set of values.

mod number;
#[cfg(test)]
mod tests;

use crate::Parameter;
use crate::expression::{Chain, Given, Program, Room};
use crate::gate::Checked;
use crate::source::Source;
use crate::walk::recorded;
use number::{class, number, steps};

/// What puts numbers into a model.
#[derive(Debug, Clone)]
pub struct Substitution {
    given: Given,
    /// The parameters that are given, by their index.
    inputs: Vec<usize>,
    chain: Chain,
    leaves: Vec<Leaf>,
    /// Constants of responses.
    constants: Vec<Constant>,
    nominal: Checked,
}

/// A number of the model.
#[derive(Debug, Clone)]
struct Leaf {
    path: String,
    program: Program,
    /// The SI value of a one there.
    factor: f64,
    /// What it is in the model that was read.
    nominal: f64,
    /// Whether it is a place, on whose sign there is no rule.
    is_place: bool,
}

/// A parameter that a response names, by their indexes.
#[derive(Debug, Clone, Copy)]
struct Constant {
    response: usize,
    constant: usize,
    parameter: usize,
}

/// Whether a path is that of a point of a body, or of where it is drawn.
fn is_place(path: &str) -> bool {
    let mut steps = steps(path);
    steps.next() == Some("bodies") && matches!(steps.nth(1), Some("points" | "pose"))
}

/// A model that numbers are put into, of one thread.
#[derive(Debug, Clone)]
pub struct Substituted {
    model: Checked,
    room: Room,
}

/// Parts by which parameters are changed to see whether the model is the one that reading gives.
const BESIDE: [f64; 2] = [7.3e-4, -1.9e-3];

impl Substitution {
    /// Of a model, its parameters, and the source that both were read from; none where reading again is the only way.
    pub fn new(
        source: &Source,
        nominal: &Checked,
        known: &[Parameter],
        names: &[&str],
        given: Given,
    ) -> Option<Self> {
        let (parameters, recorded) = recorded(source);
        let inputs = names.iter().map(|name| parameters.index(name));
        let mut model = nominal.clone().into_model();
        let mut leaves = Vec::new();
        for one in recorded {
            if let Some(program) = parameters.program(&one.text) {
                let nominal = *number(&mut model, &mut steps(&one.path))?;
                leaves.push(Leaf {
                    nominal,
                    is_place: is_place(&one.path),
                    path: one.path,
                    program,
                    factor: one.factor,
                });
            }
        }
        let mut constants = Vec::new();
        for (response, own) in nominal.responses.values().enumerate() {
            for (constant, name) in own.parameters.keys().enumerate() {
                constants.push(Constant {
                    response,
                    constant,
                    parameter: parameters.index(name)?,
                });
            }
        }
        let substitution = Substitution {
            given,
            inputs: inputs.collect::<Option<_>>()?,
            chain: parameters.chain()?,
            leaves,
            constants,
            nominal: nominal.clone(),
        };
        substitution
            .is_proven(source, known, names)
            .then_some(substitution)
    }

    /// Whether it gives what reading gives, at the values of the file and beside them.
    fn is_proven(&self, source: &Source, known: &[Parameter], names: &[&str]) -> bool {
        let value = |name: &&str| {
            let found = known.iter().find(|parameter| parameter.name == **name);
            found.map(|parameter| parameter.value)
        };
        let Some(values) = names.iter().map(value).collect::<Option<Vec<f64>>>() else {
            return false;
        };
        let mut place = self.begin();
        [0.0].into_iter().chain(BESIDE).all(|part| {
            // a part of its own for each, so that an exchange would be seen
            let given = values.iter().enumerate().map(|(k, value)| {
                let change = part * value * (1.0 + k as f64 / 16.0);
                match self.given {
                    Given::Values => value + change,
                    Given::Deviations => change,
                }
            });
            let given: Vec<f64> = given.collect();
            let pairs = names.iter().copied().zip(given.iter().copied());
            let pairs: Vec<(&str, f64)> = pairs.collect();
            let read = match self.given {
                Given::Values => source.with_parameters(&pairs),
                Given::Deviations => source.with_deviations(&pairs),
            };
            match read {
                Ok(read) => self.put(&given, &mut place) == Some(&read),
                // beside the values of the file there may be no model
                Err(_) => part != 0.0,
            }
        })
    }

    /// A model to put numbers into.
    pub fn begin(&self) -> Substituted {
        Substituted {
            model: self.nominal.clone(),
            room: Room::default(),
        }
    }

    /// Whether the places of a file whose paths begin so have numbers that follow from parameters.
    pub fn changes(&self, beginning: &str) -> bool {
        self.leaves
            .iter()
            .any(|leaf| leaf.path.starts_with(beginning))
    }

    /// The value of a parameter that a response names \[SI\], after [`Substitution::put`].
    pub fn value(&self, name: &str, place: &Substituted) -> Option<f64> {
        let of = |one: &&Constant| {
            let (_, response) = self.nominal.responses.get_index(one.response)?;
            let (known, _) = response.parameters.get_index(one.constant)?;
            Some(known == name)
        };
        let constant = self.constants.iter().find(|one| of(one) == Some(true))?;
        place.room.values.get(constant.parameter).copied()
    }

    /// The model with values, or deviations, in the order of the names; none where only reading can tell what is wrong
    /// with them.
    pub fn put<'p>(&self, given: &[f64], place: &'p mut Substituted) -> Option<&'p Checked> {
        let Substituted { model, room } = place;
        if !self.chain.evaluate(self.given, &self.inputs, given, room) {
            return None;
        }
        let numbers = model.numbers();
        for leaf in &self.leaves {
            let value = leaf.program.sound_value(&room.values, &mut room.stack) * leaf.factor;
            // Rules on a number are on its sign: in the class of the nominal one it keeps them.
            let class = class(value);
            let keeps = match leaf.is_place {
                true => class.is_some(),
                false => class == self::class(leaf.nominal),
            };
            if !keeps {
                return None;
            }
            *number(numbers, &mut steps(&leaf.path))? = value;
        }
        for one in &self.constants {
            numbers.responses[one.response].parameters[one.constant].value =
                room.values[one.parameter];
        }
        Some(model)
    }
}
