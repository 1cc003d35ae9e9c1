//! Programs of a motion, whose functions and tables are on one side of their kinks each. Nothing is allocated.

use std::fmt::Debug;
use std::sync::Arc;

use super::Function;
use super::moving::DEEPEST_STACK;
use super::number::Number;
use super::program::{Do, Program, call};

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
    /// The tables that it looks through.
    pub fn tables(&self) -> impl Iterator<Item = usize> {
        self.0.iter().filter_map(|step| match step {
            Do::Look(table) => Some(*table),
            _ => None,
        })
    }

    /// How many kinks it has.
    pub fn kinks(&self) -> usize {
        let is_kinked = |step: &&Do<usize>| match step {
            Do::Call(function, _) => function.is_kinked(),
            Do::Look(_) => true,
            _ => false,
        };
        self.0.iter().filter(is_kinked).count()
    }

    /// Its value with all kinks on the sides that are held; on those of the values, where none are.
    pub fn value_on<N: Number + Copy>(
        &self,
        inputs: &[N],
        fixed: Fixed<'_>,
        held: Option<&[i32]>,
    ) -> N {
        let mut kink = 0;
        self.walk(inputs, fixed, |kinked, values, numbers| {
            let side = match held {
                Some(held) => held[kink],
                None => kinked.side(numbers),
            };
            kink += 1;
            kinked.on_side(values, numbers, side)
        })
    }

    /// The sides on which its kinks are.
    pub fn take_sides(&self, inputs: &[f64], fixed: Fixed<'_>, sides: &mut [i32]) {
        let mut own = sides.iter_mut();
        self.walk(inputs, fixed, |kinked, values, numbers| {
            let side = kinked.side(numbers);
            own.next().into_iter().for_each(|own: &mut i32| *own = side);
            kinked.on_side(values, numbers, side)
        });
    }

    /// How far the kinks are beyond the sides that are held, each measured by its scale: the largest; below zero where none is.
    pub fn beyond(
        &self,
        inputs: &[f64],
        fixed: Fixed<'_>,
        (held, scales): (&[i32], &[f64]),
    ) -> f64 {
        let (mut kink, mut most) = (0, f64::NEG_INFINITY);
        self.walk(inputs, fixed, |kinked, values, numbers| {
            let side = held[kink];
            most = most.max(kinked.beyond(numbers, side) / scales[kink]);
            kink += 1;
            kinked.on_side(values, numbers, side)
        });
        most
    }

    /// The first of its tables that is looked at before or behind all of its points.
    pub fn outside(&self, inputs: &[f64], fixed: Fixed<'_>) -> Option<usize> {
        let mut found = None;
        self.walk(inputs, fixed, |kinked, values, numbers| {
            if let Kinked::Table(index, table) = &kinked
                && table.is_outside(numbers[0])
            {
                found.get_or_insert(*index);
            }
            let side = kinked.side(numbers);
            kinked.on_side(values, numbers, side)
        });
        found
    }

    fn walk<N: Number + Copy>(
        &self,
        inputs: &[N],
        fixed: Fixed<'_>,
        mut kinked: impl FnMut(Kinked<'_>, &[N], &[f64]) -> N,
    ) -> N {
        let mut stack = [N::of(0.0); DEEPEST_STACK];
        let mut numbers = [0.0; DEEPEST_STACK];
        let mut depth = 0;
        for step in &self.0 {
            let taken = match step {
                Do::Push(_) | Do::Parameter(_) | Do::Input(_) => 0,
                Do::Negate | Do::Look(_) => 1,
                Do::Add | Do::Subtract | Do::Multiply | Do::Divide | Do::Power => 2,
                Do::Call(_, count) => *count,
            };
            let from = depth - taken;
            let values = &stack[from..depth];
            let result = match *step {
                Do::Push(value) => N::of(value),
                Do::Parameter(index) => N::of(fixed.parameters[index]),
                Do::Input(input) => inputs[input],
                Do::Negate => values[0].negate(),
                Do::Add => values[0].add(&values[1]),
                Do::Subtract => values[0].subtract(&values[1]),
                Do::Multiply => values[0].multiply(&values[1]),
                Do::Divide => values[0].divide(&values[1]),
                Do::Power => values[0].power(&values[1]),
                Do::Call(function, _) if function.is_kinked() => {
                    kinked(Kinked::Function(function), values, &numbers[from..depth])
                }
                Do::Call(function, _) => call(function, values),
                Do::Look(table) => {
                    let look = Kinked::Table(table, &*fixed.tables[table]);
                    kinked(look, values, &numbers[from..depth])
                }
            };
            stack[from] = result;
            numbers[from] = result.shown();
            depth = from + 1;
        }
        stack[0]
    }
}
