//! Velocities at an assembled position.

use crate::analysis::control::Stop;
use crate::mechanism::least_velocity::least_velocity;
use crate::system::{Inputs, System};
use linkdyn_output::Status;

/// Initial velocities that miss the constraints by more than this part of the fastest velocity conflict with them: values
/// written with eight digits pass.
const CONFLICT: f64 = 1e-7;

/// The same of the mechanism's own rate, 1/T: what is this slow is round-off of a zero.
const STILL: f64 = 1e-12;

/// Velocities at an assembled position: those of least kinetic energy that satisfy constraints, drivers and the given
/// initial velocities; where masses are unknown, of least square (lengths by the mechanism's size).
///
/// # Errors
/// Initial velocities that conflict.
pub fn velocities(system: &System, q: &[f64], inputs: &Inputs) -> Result<Vec<f64>, Stop> {
    velocities_near(system, q, inputs, true, None)
}

/// Whether there are velocities that constraints and all drivers allow.
pub(super) fn agree(system: &System, q: &[f64], inputs: &Inputs) -> bool {
    let (v, residual) = least_velocity(system, q, inputs, false, None);
    let off = linkdyn_linear::math::max_abs(&residual);
    off <= CONFLICT * system.scaled_norm(&v) + STILL / system.scale.time
}

/// As [`velocities`], but nearest to `near` in the sense of the kinetic energy; with or without the given initial ones.
///
/// # Errors
/// Initial velocities that conflict.
pub fn velocities_near(
    system: &System,
    q: &[f64],
    inputs: &Inputs,
    with_initial: bool,
    near: Option<&[f64]>,
) -> Result<Vec<f64>, Stop> {
    let (v, residual) = least_velocity(system, q, inputs, with_initial, near);
    let speed = system.scaled_norm(&v);
    let off = linkdyn_linear::math::max_abs(&residual);
    if !system.initial_rates.is_empty()
        && (off.is_nan() || off > CONFLICT * speed + STILL / system.scale.time)
    {
        let names: Vec<&str> = system
            .initial_rates
            .iter()
            .map(|(name, _)| name.as_str())
            .collect();
        return Err(Stop::failed(
            Status::AssemblyFailed,
            format!(
                "can't assemble: the initial velocities {} can't be met together with the joints and drivers",
                names.join(", ")
            ),
        ));
    }
    Ok(v)
}
