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
mod steps;
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
pub use moving::{MOST_ARGUMENTS, Moving};
pub(super) use naming::with_article;
pub use number::Number;
pub(super) use number::{Binary, Real};
pub use parameters::Parameter;
pub(super) use parameters::{Found, Moved, Parameters};
pub use program::{DEEPEST_STACK, Fixed, Look, Program};
pub(super) use quantity::{Fault, Pure, Quantity};
pub use reduction::Reduction;
pub use results::{Known, Place, Results};
pub(super) use steps::{Expression, Misfit};
pub use tangent::Tangent;
pub(super) use written::quantity;

/// Whether a text is an expression.
pub(super) fn is_expression(text: &str) -> bool {
    text.trim_start().starts_with('=')
}

#[cfg(test)]
mod tests;
