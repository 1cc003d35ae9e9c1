//! The arithmetic of an expression whose dimensions were checked: numbers in SI on a stack, without allocation.
//!
//! Each step is the same for all numbers: doubles, and those with derivatives. On a motion, functions and
//! tables are on one side of their kinks each.

use std::fmt::Debug;
use std::sync::Arc;

use super::dual::Dual;
use super::number::{Function, Number};
use super::quantity::Quantity;
use crate::dimension::Powers;

/// Numbers that the stack of a motion's expression holds at most.
pub const DEEPEST_STACK: usize = 64;

/// What happens to the stack; `I` says where inputs come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Do<I> {
    Push(Quantity),
    /// Index among the parameters.
    Parameter(usize),
    Input(I),
    /// With how many values.
    Call(Function, usize),
    /// Through the table with this number, with the dimensions of its columns.
    Look(usize, [Powers; 2]),
}

impl<I> Do<I> {
    /// How many values it takes.
    pub fn taken(&self) -> usize {
        match self {
            Do::Push(_) | Do::Parameter(_) | Do::Input(_) => 0,
            Do::Look(..) => 1,
            Do::Call(_, count) => *count,
        }
    }

    /// The same with inputs at other places.
    pub fn map<T>(self, place: impl FnOnce(I) -> T) -> Do<T> {
        match self {
            Do::Input(input) => Do::Input(place(input)),
            Do::Push(value) => Do::Push(value),
            Do::Parameter(index) => Do::Parameter(index),
            Do::Call(function, count) => Do::Call(function, count),
            Do::Look(table, columns) => Do::Look(table, columns),
        }
    }

    /// Whether it has kinks or jumps.
    fn is_kinked(&self) -> bool {
        match self {
            Do::Call(function, _) => function.is_kinked(),
            Do::Look(..) => true,
            Do::Push(_) | Do::Parameter(_) | Do::Input(_) => false,
        }
    }
}

/// Steps that make one number of some inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Program<I = usize>(pub(super) Vec<Do<I>>);

impl<I: Copy> Program<I> {
    /// A step after those that make its values.
    pub(super) fn then(values: Vec<Self>, step: Do<I>) -> Self {
        let before = values.into_iter().flat_map(|one| one.0);
        Program(before.chain([step]).collect())
    }

    /// All inputs, in the order of the text.
    pub fn inputs(&self) -> impl Iterator<Item = I> {
        self.0.iter().filter_map(|step| match step {
            Do::Input(input) => Some(*input),
            Do::Push(_) | Do::Parameter(_) | Do::Call(..) | Do::Look(..) => None,
        })
    }

    /// The same with inputs at other places.
    pub fn map<T>(&self, mut place: impl FnMut(I) -> T) -> Program<T> {
        Program(self.0.iter().map(|step| step.map(&mut place)).collect())
    }

    /// How many numbers its stack holds at most.
    pub fn depth(&self) -> usize {
        let depths = self.0.iter().scan(0_usize, |now, step| {
            *now = (*now + 1).saturating_sub(step.taken());
            Some(*now)
        });
        depths.max().unwrap_or(0)
    }
}

/// A table of a model: a function of one number that is smooth on each side of its kinks.
pub trait Look: Debug + Send + Sync {
    /// The side on which a number is.
    fn side(&self, x: f64) -> i32;
    /// How far a number is beyond a side, not above zero on it.
    fn beyond(&self, x: f64, side: i32) -> f64;
    /// f and f′, of what holds on a side.
    fn jet(&self, x: f64, side: i32) -> [f64; 2];
    /// Whether a number is before or behind all points.
    fn is_outside(&self, x: f64) -> bool;
}

/// What does not change in a motion.
#[derive(Debug, Clone, Copy, Default)]
pub struct Fixed<'a> {
    /// Values of the parameters, in SI.
    pub parameters: &'a [f64],
    /// The tables, by their numbers.
    pub tables: &'a [Arc<dyn Look>],
}

/// A step that has kinks.
enum Kinked<'a> {
    Function(Function),
    Table(usize, &'a dyn Look),
}

impl Kinked<'_> {
    fn side(&self, numbers: &[f64]) -> i32 {
        match self {
            Kinked::Function(function) => function.side(numbers),
            Kinked::Table(_, table) => table.side(numbers[0]),
        }
    }

    fn beyond(&self, numbers: &[f64], side: i32) -> f64 {
        match self {
            Kinked::Function(function) => function.beyond(numbers, side),
            Kinked::Table(_, table) => table.beyond(numbers[0], side),
        }
    }

    fn on_side<N: Number>(&self, values: &[N], numbers: &[f64], side: i32) -> N {
        match self {
            Kinked::Function(function) => function.on_side(values, side),
            Kinked::Table(_, table) => {
                let x = numbers[0];
                let [value, slope] = table.jet(x, side);
                // the tangent has the value and the derivative of the table
                let along = values[0].subtract(&N::of(x)).multiply(&N::of(slope));
                N::of(value).add(&along)
            }
        }
    }
}

impl Program {
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
        stack.clear();
        for step in &self.0 {
            // as many as the reader made sure are there
            let from = stack.len().saturating_sub(step.taken());
            let result = match *step {
                Do::Push(quantity) => N::of(quantity.value),
                Do::Parameter(index) => parameters[index].clone(),
                Do::Input(input) => inputs[input].clone(),
                Do::Call(function, _) => function.of(&stack[from..]),
                // a table is of a motion alone
                Do::Look(..) => N::of(f64::NAN),
            };
            if !goes_on(&result) {
                return N::of(f64::NAN);
            }
            stack.truncate(from);
            stack.push(result);
        }
        stack.pop().unwrap_or_else(|| N::of(f64::NAN))
    }

    /// The tables that it looks through.
    pub fn tables(&self) -> impl Iterator<Item = usize> {
        self.0.iter().filter_map(|step| match step {
            Do::Look(table, _) => Some(*table),
            Do::Push(_) | Do::Parameter(_) | Do::Input(_) | Do::Call(..) => None,
        })
    }

    /// How many kinks it has.
    pub fn kinks(&self) -> usize {
        self.0.iter().filter(|step| step.is_kinked()).count()
    }

    /// Its value with all kinks on the sides that are held; on those of the values, where none are.
    pub fn value_on<N: Number + Copy>(
        &self,
        inputs: &[N],
        fixed: Fixed<'_>,
        held: Option<&[i32]>,
    ) -> N {
        self.walk(inputs, fixed, |kink, kinked, numbers| match held {
            Some(held) => held[kink],
            None => kinked.side(numbers),
        })
    }

    /// The sides on which its kinks are.
    pub fn take_sides(&self, inputs: &[f64], fixed: Fixed<'_>, sides: &mut [i32]) {
        self.walk(inputs, fixed, |kink, kinked, numbers| {
            let side = kinked.side(numbers);
            sides.get_mut(kink).into_iter().for_each(|own| *own = side);
            side
        });
    }

    /// How far the kinks are beyond the sides that are held, each measured by its scale: the largest; below zero where none is.
    pub fn beyond(
        &self,
        inputs: &[f64],
        fixed: Fixed<'_>,
        (held, scales): (&[i32], &[f64]),
    ) -> f64 {
        let mut most = f64::NEG_INFINITY;
        self.walk(inputs, fixed, |kink, kinked, numbers| {
            most = most.max(kinked.beyond(numbers, held[kink]) / scales[kink]);
            held[kink]
        });
        most
    }

    /// The first of its tables that is looked at before or behind all of its points.
    pub fn outside(&self, inputs: &[f64], fixed: Fixed<'_>) -> Option<usize> {
        let mut found = None;
        self.walk(inputs, fixed, |_, kinked, numbers| {
            if let Kinked::Table(index, table) = kinked
                && table.is_outside(numbers[0])
            {
                found.get_or_insert(*index);
            }
            kinked.side(numbers)
        });
        found
    }

    /// Its value, of which `side` says on which side each kink is.
    fn walk<N: Number + Copy>(
        &self,
        inputs: &[N],
        fixed: Fixed<'_>,
        mut side: impl FnMut(usize, &Kinked<'_>, &[f64]) -> i32,
    ) -> N {
        let mut stack = [N::of(0.0); DEEPEST_STACK];
        let mut numbers = [0.0; DEEPEST_STACK];
        let (mut depth, mut kink) = (0, 0);
        for step in &self.0 {
            let from = depth - step.taken();
            let values = &stack[from..depth];
            let kinked = match *step {
                Do::Call(function, _) if function.is_kinked() => Some(Kinked::Function(function)),
                Do::Look(table, _) => Some(Kinked::Table(table, &*fixed.tables[table])),
                Do::Push(_) | Do::Parameter(_) | Do::Input(_) | Do::Call(..) => None,
            };
            let result = match (*step, kinked) {
                (_, Some(kinked)) => {
                    let numbers = &numbers[from..depth];
                    let side = side(kink, &kinked, numbers);
                    kink += 1;
                    kinked.on_side(values, numbers, side)
                }
                (Do::Push(quantity), _) => N::of(quantity.value),
                (Do::Parameter(index), _) => N::of(fixed.parameters[index]),
                (Do::Input(input), _) => inputs[input],
                (Do::Call(function, _), _) => function.of(values),
                (Do::Look(..), None) => N::of(f64::NAN),
            };
            stack[from] = result;
            numbers[from] = result.shown();
            depth = from + 1;
        }
        stack[0]
    }
}
