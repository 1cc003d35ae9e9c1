//! Parameters as programs, each after those that it names: their values for given ones, without allocation.

use super::parameters::Parameters;
use super::program::Program;
use super::written::Written;

/// How parameters are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Given {
    /// Values in the place of those of the file.
    Values,
    /// Deviations, on top of what they are without.
    Deviations,
}

/// All parameters of a file.
#[derive(Debug, Clone)]
pub struct Chain {
    order: Vec<(usize, ParameterSource)>,
    depth: usize,
}

#[derive(Debug, Clone)]
enum ParameterSource {
    Value(f64),
    Expression(Program),
}

/// Room for one thread's numbers.
#[derive(Debug, Clone, Default)]
pub struct Room {
    /// Values of all parameters \[SI\].
    pub values: Vec<f64>,
    given: Vec<Option<f64>>,
    /// For programs.
    pub stack: Vec<f64>,
}

impl Parameters {
    /// Their chain; `None` if one has no value.
    pub fn chain(&self) -> Option<Chain> {
        let (order, waits) = self.order();
        if waits.iter().any(|waiting| *waiting > 0) {
            return None;
        }
        let origin = |index: usize| match &self.written[index] {
            Written::Value(quantity) => Some(ParameterSource::Value(quantity.value)),
            Written::Expression(expression) => {
                Some(ParameterSource::Expression(expression.program()?))
            }
            Written::Faulty => None,
        };
        let order = order.into_iter().map(|index| Some((index, origin(index)?)));
        let order: Vec<(usize, ParameterSource)> = order.collect::<Option<_>>()?;
        let depths = order.iter().map(|(_, origin)| match origin {
            ParameterSource::Value(_) => 0,
            ParameterSource::Expression(program) => program.depth(),
        });
        Some(Chain {
            depth: depths.max().unwrap_or(0),
            order,
        })
    }

    /// The index of a parameter.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|own| own == name)
    }

    /// The program of an expression; `None` if it names no parameter.
    pub fn program(&self, text: &str) -> Option<Program> {
        let expression = self.parse(text).ok()?;
        expression.parameters().next()?;
        expression.program()
    }
}

impl Chain {
    /// All values where the parameters `inputs` are given; whether all of them exist.
    pub fn evaluate(&self, how: Given, inputs: &[usize], given: &[f64], room: &mut Room) -> bool {
        room.values.clear();
        room.values.resize(self.order.len(), f64::NAN);
        room.given.clear();
        room.given.resize(self.order.len(), None);
        room.stack.reserve(self.depth);
        for (&index, &value) in inputs.iter().zip(given) {
            room.given[index] = Some(value);
        }
        for (index, origin) in &self.order {
            let given = room.given[*index];
            let value = match (how, given, origin) {
                (Given::Values, Some(value), _) => value,
                (_, _, ParameterSource::Value(value)) => value + given.unwrap_or(0.0),
                (_, _, ParameterSource::Expression(program)) => {
                    program.sound_value(&room.values, &mut room.stack) + given.unwrap_or(0.0)
                }
            };
            room.values[*index] = value;
        }
        room.values.iter().all(|value| value.is_finite())
    }
}
