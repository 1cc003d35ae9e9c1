//! The arithmetic of an expression whose dimensions were checked: numbers in SI on a stack, without allocation.

use super::dual::Dual;
use super::number::Number;
use super::{Function, Step};

/// What happens to the stack; `S` says where inputs come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Do<S> {
    Push(f64),
    Parameter(usize),
    Input(S),
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Call(Function, usize),
    /// Through the table with this number.
    Look(usize),
}

/// Steps that make one number of some inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Program<S = usize>(pub(super) Vec<Do<S>>);

impl<S: Copy> Program<S> {
    /// One input as it is.
    pub(super) fn input(input: S) -> Self {
        Program(vec![Do::Input(input)])
    }

    /// A constant or a parameter; nothing of other steps.
    pub(super) fn leaf(step: Step) -> Self {
        Program(match step {
            Step::Push(quantity) => vec![Do::Push(quantity.value)],
            Step::Parameter(index) => vec![Do::Parameter(index)],
            Step::Result(_) | Step::Reduce(..) | Step::Equal => Vec::new(),
            Step::Negate
            | Step::Add
            | Step::Subtract
            | Step::Multiply
            | Step::Divide
            | Step::Power
            | Step::Look(..)
            | Step::Call(..) => Vec::new(),
        })
    }

    /// A step after those that make its values.
    pub(super) fn then(values: Vec<Self>, step: Step) -> Self {
        let mut all: Vec<Do<S>> = values.into_iter().flat_map(|one| one.0).collect();
        all.extend(match step {
            Step::Negate => Some(Do::Negate),
            Step::Add => Some(Do::Add),
            Step::Subtract => Some(Do::Subtract),
            Step::Multiply => Some(Do::Multiply),
            Step::Divide => Some(Do::Divide),
            Step::Power => Some(Do::Power),
            Step::Call(function, count) => Some(Do::Call(function, count)),
            Step::Look(table, _) => Some(Do::Look(table)),
            Step::Push(_)
            | Step::Parameter(_)
            | Step::Result(_)
            | Step::Reduce(..)
            | Step::Equal => None,
        });
        Program(all)
    }

    /// All inputs, in the order of the text.
    pub fn inputs(&self) -> impl Iterator<Item = S> {
        self.0.iter().filter_map(|step| match step {
            Do::Input(input) => Some(*input),
            Do::Push(_)
            | Do::Parameter(_)
            | Do::Negate
            | Do::Add
            | Do::Subtract
            | Do::Multiply
            | Do::Divide
            | Do::Power
            | Do::Look(_)
            | Do::Call(..) => None,
        })
    }

    /// The same with inputs at other places.
    pub fn map<T>(&self, mut place: impl FnMut(S) -> T) -> Program<T> {
        let steps = self.0.iter().map(|step| match *step {
            Do::Input(input) => Do::Input(place(input)),
            Do::Push(value) => Do::Push(value),
            Do::Parameter(index) => Do::Parameter(index),
            Do::Negate => Do::Negate,
            Do::Add => Do::Add,
            Do::Subtract => Do::Subtract,
            Do::Multiply => Do::Multiply,
            Do::Divide => Do::Divide,
            Do::Power => Do::Power,
            Do::Call(function, count) => Do::Call(function, count),
            Do::Look(table) => Do::Look(table),
        });
        Program(steps.collect())
    }

    /// How many numbers its stack holds at most.
    pub fn depth(&self) -> usize {
        let (mut now, mut most) = (0_usize, 0);
        for step in &self.0 {
            now = match step {
                Do::Push(_) | Do::Parameter(_) | Do::Input(_) => now + 1,
                Do::Negate | Do::Look(_) => now,
                Do::Add | Do::Subtract | Do::Multiply | Do::Divide | Do::Power => {
                    now.saturating_sub(1)
                }
                Do::Call(_, count) => (now + 1).saturating_sub(*count),
            };
            most = most.max(now);
        }
        most
    }
}

impl Program {
    /// The same steps; none where one is of a response.
    pub(super) fn of_steps(steps: impl Iterator<Item = Step>) -> Option<Self> {
        let steps = steps.map(|step| {
            Some(match step {
                Step::Push(quantity) => Do::Push(quantity.value),
                Step::Parameter(index) => Do::Parameter(index),
                Step::Negate => Do::Negate,
                Step::Add => Do::Add,
                Step::Subtract => Do::Subtract,
                Step::Multiply => Do::Multiply,
                Step::Divide => Do::Divide,
                Step::Power => Do::Power,
                Step::Call(function, count) => Do::Call(function, count),
                Step::Look(..) | Step::Result(_) | Step::Reduce(..) | Step::Equal => return None,
            })
        });
        steps.collect::<Option<_>>().map(Program)
    }

    /// Its value in SI; not finite where the arithmetic has none. A stack with room for [`Program::depth`] numbers does
    /// not grow.
    pub fn value(&self, inputs: &[f64], parameters: &[f64], stack: &mut Vec<f64>) -> f64 {
        self.run(inputs, parameters, stack, |_| true)
    }

    /// Its value without inputs; NaN where any step on the way has none.
    pub fn sound_value(&self, parameters: &[f64], stack: &mut Vec<f64>) -> f64 {
        self.run(&[], parameters, stack, |value| value.is_finite())
    }

    /// Its value with the derivatives that follow from those of inputs and parameters.
    pub fn dual(&self, inputs: &[Dual<f64>], parameters: &[Dual<f64>]) -> Dual<f64> {
        self.run(inputs, parameters, &mut Vec::new(), |_| true)
    }

    fn run<N: Number>(
        &self,
        inputs: &[N],
        parameters: &[N],
        stack: &mut Vec<N>,
        goes_on: impl Fn(&N) -> bool,
    ) -> N {
        if let [Do::Input(input)] = self.0[..] {
            return inputs[input].clone();
        }
        stack.clear();
        for step in &self.0 {
            match *step {
                Do::Push(value) => stack.push(N::of(value)),
                Do::Parameter(index) => stack.push(parameters[index].clone()),
                Do::Input(input) => stack.push(inputs[input].clone()),
                Do::Negate => take(stack, 1, |values| values[0].negate()),
                Do::Add => take(stack, 2, |values| values[0].add(&values[1])),
                Do::Subtract => take(stack, 2, |values| values[0].subtract(&values[1])),
                Do::Multiply => take(stack, 2, |values| values[0].multiply(&values[1])),
                Do::Divide => take(stack, 2, |values| values[0].divide(&values[1])),
                Do::Power => take(stack, 2, |values| values[0].power(&values[1])),
                Do::Call(function, count) => take(stack, count, |values| call(function, values)),
                // a table is of a motion alone
                Do::Look(_) => take(stack, 1, |_| N::of(f64::NAN)),
            }
            if !stack.last().is_some_and(&goes_on) {
                return N::of(f64::NAN);
            }
        }
        stack.pop().unwrap_or_else(|| N::of(f64::NAN))
    }
}

/// Puts a result in the place of the values that it takes, as many as the reader made sure are there.
fn take<N>(stack: &mut Vec<N>, count: usize, result: impl FnOnce(&[N]) -> N) {
    let from = stack.len().saturating_sub(count);
    let result = result(&stack[from..]);
    stack.truncate(from);
    stack.push(result);
}

pub(super) fn call<N: Number>(function: Function, values: &[N]) -> N {
    let first = &values[0];
    let second = values.get(1).unwrap_or(first);
    match function {
        Function::Sin => first.sin(),
        Function::Cos => first.cos(),
        Function::Tan => first.tan(),
        Function::Asin => first.asin(),
        Function::Acos => first.acos(),
        Function::Atan => first.atan(),
        Function::Atan2 => first.atan2(second),
        Function::Sqrt => first.sqrt(),
        Function::Abs => first.abs(),
        Function::Min => values
            .iter()
            .fold(first.clone(), |least, value| least.min(value)),
        Function::Max => values
            .iter()
            .fold(first.clone(), |most, value| most.max(value)),
        Function::Hypot => first.hypot(second),
        Function::Exp => first.exp(),
        Function::Ln => first.ln(),
        Function::Floor => first.floor(),
        Function::Ceil => first.ceil(),
        Function::Round => first.round(),
        Function::Step => first.step(),
        Function::Sign => first.sign(),
        Function::Clamp => first.max(second).min(values.get(2).unwrap_or(second)),
        Function::Modulo => first.modulo(second),
        Function::Table => {
            let numbers: Vec<f64> = values.iter().map(N::shown).collect();
            function.on_side(values, function.side(&numbers))
        }
    }
}
