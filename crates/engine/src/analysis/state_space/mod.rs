//! A mechanism as a linear system, about rest or along a motion.
//!
//! ```text
//! ẋ = f(x, w),  y = h(x, w)       x = (p, ṗ, z | s, ṡ)     w inputs, y columns of results
//! δẋ = A δx + B δw                A = ∂f/∂x, B = ∂f/∂w
//! δy = C δx + D δw                C = ∂h/∂x, D = ∂h/∂w
//! ```
//!
//! p are minimal coordinates and the values of drivers that are let go (see [`crate::mechanism::released`]), z integrated states, and
//! s the values of drivers whose accelerations are inputs. f and h are evaluated to round-off, with all constraints, at places about
//! the point: the derivatives are those of [`crate::mechanism::ridders`], with their errors. ∂ṗ/∂x and what belongs to s are known.
//! What a motion holds at its point is held: phases of contacts, sides of kinks, time.
//!
//! (Kailath, Linear Systems, Prentice-Hall 1980, ch. 2.)

mod answer;
mod inputs;
mod linear;
mod outputs;
mod points;

use super::control::Control;
pub use answer::{LinearSystem, NoLinearSystem, StateSpaceQuestion, Variable};
use linkdyn_model::Checked;
use points::OperatingPoint;

/// Linearises a model: once about rest, or at each of the instants, in their order.
///
/// # Errors
/// See [`NoLinearSystem`].
pub fn state_space(
    model: &Checked,
    question: &StateSpaceQuestion,
    control: &Control,
) -> Result<Vec<LinearSystem>, NoLinearSystem> {
    let mut found = Vec::new();
    let mut told = |point: OperatingPoint| {
        found.push(linear::about(model, question, point)?);
        Ok(())
    };
    match question.at.is_empty() {
        true => points::at_rest(model, question.pose, control, &mut told)?,
        false => points::along(model, &question.at, control, &mut told)?,
    }
    let wanted = question.at.iter();
    let order = wanted.filter_map(|time| {
        let mut systems = found.iter();
        systems.find(|system| system.time == Some(*time)).cloned()
    });
    Ok(match question.at.is_empty() {
        true => found,
        false => order.collect(),
    })
}
