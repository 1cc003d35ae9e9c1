//! A start in a singular position: which branch of the mechanism's motion is taken, and what is said of it.
//!
//! Where constraints lose rank only in the position drawn, as in a parallelogram drawn flat, several motions lead away from
//! it, each with fewer degrees of freedom than J has there. Taken is the branch in which most of the forces' pull lies
//! (angles in rad, lengths by the mechanism's size), that is the one on which the mechanism leaves let go in thick oil; of
//! equally pulled ones that whose bodies turn most alike.

use super::assembly::{Assembled, ranked};
use super::control::Stop;
use super::in_line::singular_text;
use super::words::listed;
use crate::mechanism::branching::{Branch, Singularity};
use crate::mechanism::closing::close;
use crate::system::{Block, Evaluation, Inputs, System};
use linkdyn_output::Status;

/// Remainder of a row above which there is no singular position near [–].
pub(super) const DOUBTFUL: f64 = 1e-6;
/// Largest moves by which a singular position is left, in rad or mechanism sizes, as they are tried.
const MOVES: [f64; 3] = [1e-2, 3e-2, 2e-3];
/// A position is on the branch when it lies in its direction: cosine of the angle between both.
const IN_DIRECTION: f64 = 0.9;
/// Pull along all branches, by the largest force, below which nothing pulls.
const BALANCED: f64 = 1e-10;
/// Rates below this, by the largest, are none that anybody sees.
const SEEN: f64 = 0.05;
/// Branches tried at most.
const MOST: usize = 16;

/// What is singular at an assembled position.
///
/// # Errors
/// Where its Jacobian is not finite.
pub fn singularity<'s>(
    system: &'s System,
    assembled: &Assembled,
    inputs: &Inputs,
) -> Result<Option<Singularity<'s>>, Stop> {
    if assembled.all.dependent.is_empty() && assembled.all.smallest_kept > DOUBTFUL {
        return Ok(None);
    }
    Singularity::at(system, &assembled.q, inputs, system.m())
        .map_err(|fault| Stop::failed(Status::Singular, fault.to_string()))
}

/// Leaves a singular start on one of its branches, with a warning; a regular one stays as it is.
///
/// # Errors
/// Where nothing leads away, or nothing pulls the mechanism away.
pub fn leave(system: &System, assembled: Assembled, inputs: &Inputs) -> Result<Assembled, Stop> {
    let Some(mut singular) = singularity(system, &assembled, inputs)? else {
        return Ok(assembled);
    };
    let pull = pull(system, &assembled.q, inputs);
    let branches = singular.branches(&pull);
    let beside = branches.iter().take(MOST).find_map(|branch| {
        let at = (&assembled.q[..], &branch.direction[..]);
        Some((branch, beside(system, system.m(), at, inputs)?))
    });
    let Some((taken, q)) = beside else {
        return Err(Stop::failed(
            Status::Singular,
            held_fast(system, &assembled),
        ));
    };
    if branches
        .iter()
        .all(|branch| branch.along <= BALANCED * linkdyn_linear::math::max_abs(&pull))
    {
        return Err(Stop::failed(Status::Singular, balanced(system, &branches)));
    }
    let mut warnings = assembled.warnings.clone();
    let other = branches.iter().find(|branch| *branch != taken);
    warnings.push(choice(system, taken, other));
    Ok(ranked(
        system,
        Assembled {
            q,
            warnings,
            ..assembled
        },
        inputs,
    ))
}

/// Scaled forces Q̃ (n) at rest \[J\].
fn pull(system: &System, q: &[f64], inputs: &Inputs) -> Vec<f64> {
    let mut evaluation = Evaluation::new(system);
    let mut force = vec![0.0; system.n()];
    evaluation.set_position(q);
    evaluation.eval_force(system, inputs, &mut force);
    system.scale_columns(&mut force);
    force
}

/// A regular position of the first `rows` rows on the branch in a scaled direction, a little beside the singular position `q`.
pub(super) fn beside(
    system: &System,
    rows: usize,
    (q, direction): (&[f64], &[f64]),
    inputs: &Inputs,
) -> Option<Vec<f64>> {
    let blocks: Vec<&Block> = system.blocks.iter().filter(|b| b.row() < rows).collect();
    let largest = linkdyn_linear::math::max_abs(direction);
    MOVES.into_iter().find_map(|size| {
        let mut guess = q.to_vec();
        for (k, (guess, d)) in guess.iter_mut().zip(direction).enumerate() {
            *guess += size * d / largest * system.column_scale(k);
        }
        let closed = close(system, &blocks, &guess, inputs);
        let moved: Vec<f64> = closed
            .q
            .iter()
            .zip(q)
            .enumerate()
            .map(|(k, (to, from))| (to - from) / system.column_scale(k))
            .collect();
        let length = linkdyn_linear::math::dot(&moved, &moved).sqrt();
        let along = linkdyn_linear::math::dot(&moved, direction) > IN_DIRECTION * length
            && length * largest > 0.5 * size;
        let regular = || matches!(Singularity::at(system, &closed.q, inputs, rows), Ok(None));
        (closed.converged && along && regular()).then_some(closed.q)
    })
}

/// What to say of the branch that was taken.
fn choice(system: &System, taken: &Branch, other: Option<&Branch>) -> String {
    let start = "the start is a singular position (the constraints lose rank there)";
    match other {
        None => format!(
            "{start}, from which one motion leads away: {}",
            turns(system, &taken.direction)
        ),
        Some(other) => format!(
            "{start}, from which several motions lead away; taken is the one that the forces drive most: {}. Another \
             assembly is reached where {}: for that one start a little beside, turned that way",
            turns(system, &taken.direction),
            turns(system, &other.direction)
        ),
    }
}

/// What to say where a singular position can't be left.
fn held_fast(system: &System, assembled: &Assembled) -> String {
    let what = singular_text(system, &assembled.all.dependent_rows())
        .map_or_else(String::new, |what| format!(", {what}"));
    let (by, driver) = if system.drivers.is_empty() {
        ("joints hold", "")
    } else {
        ("joints and drivers hold", ", or drive another body")
    };
    format!(
        "the start is a singular position: a dead centre{what}, where {by} the mechanism with play and with forces that have \
         no bound; start beside it{driver}"
    )
}

/// What to say of an equilibrium that is singular.
fn balanced(system: &System, branches: &[Branch]) -> String {
    let ways: Vec<String> = branches
        .iter()
        .take(2)
        .map(|branch| turns(system, &branch.direction))
        .collect();
    format!(
        "the equilibrium is itself a singular position (the constraints lose rank there), from which several motions lead \
         away, each with a stiffness of its own: {}; there is no one answer, move something a little to leave it",
        listed(&ways, ", or ")
    )
}

/// `"a" and "b" turn clockwise, "c" turns counter-clockwise`.
pub fn turns(system: &System, direction: &[f64]) -> String {
    let rates: Vec<f64> = system.layout.angles(direction).collect();
    let seen = SEEN
        * linkdyn_linear::math::max_abs(&rates)
            .max(SEEN * linkdyn_linear::math::max_abs(direction));
    let named = |turns: &dyn Fn(usize) -> bool| -> Vec<String> {
        let bodies = system.bodies.iter().enumerate().filter(|(k, _)| turns(*k));
        bodies
            .map(|(_, body)| format!("\"{}\"", body.name))
            .collect()
    };
    let (left, right) = (named(&|k| rates[k] > seen), named(&|k| rates[k] < -seen));
    let mut parts = Vec::new();
    for (names, way) in [(right, "clockwise"), (left, "counter-clockwise")] {
        if !names.is_empty() {
            parts.push(format!(
                "{} {} {way}",
                listed(&names, ", "),
                if names.len() == 1 { "turns" } else { "turn" }
            ));
        }
    }
    if parts.is_empty() {
        let moves = |k: usize| {
            linkdyn_linear::math::max_abs(&direction[system.layout.moving(k).range()]) > seen
        };
        parts.push(format!(
            "{} moves without turning",
            listed(&named(&moves), ", ")
        ));
    }
    parts.join(", ")
}
