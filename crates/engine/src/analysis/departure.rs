//! Starts of motions in singular positions: the branch on which a mechanism leaves, and a regular position of it.
//!
//! ```text
//! v = T x                       T (n, f): tangents of a branch in the singular position, see [`crate::mechanism::branching`]
//! A T x = b,  ½ xᵀTᵀM T x → min   A, b: rates of drivers, and initial velocities
//! ```
//!
//! Taken is the branch that these velocities lie on. Where several have them (at rest all do) `branch` of the initial values
//! says how bodies turn by each other on the one that is meant. The motion is not begun in the singular position, where the
//! equations have no factors, but followed from a position of the branch away from it, back through it.

mod pace;
mod words;

use super::assembly::Assembled;
use super::branch::{DOUBTFUL, beside};
use super::control::Stop;
use crate::mechanism::branching::{Branch, Singularity};
use crate::mechanism::closing::close;
use crate::mechanism::least_velocity::{prescribed, weights};
use crate::system::{Block, DriverId, Evaluation, Inputs, System};
use linkdyn_linear::dense::{Dense, least_norm_solve};
use linkdyn_linear::math::{dot, max_abs};
use linkdyn_linear::small::{cholesky, cholesky_solve};
use pace::{NEARER, Pace, RANK, failed, miss};
use words::{arrived, off, undecided};

/// Velocities that miss a branch by less than this part of the fastest lie on it: the position itself is good to the root of
/// round-off only.
const ON: f64 = 1e-5;
/// The same of the mechanism's own rate, 1/T.
const STILL: f64 = 1e-12;
/// Turns that a branch misses by more than this part of them do not mean it.
const NEAR: f64 = 0.9;
/// How far away a regular position is looked for, in rad or mechanism sizes: far enough that round-off does not matter.
const FAR: f64 = 0.1;
/// A position found this much off its guess, by the way to it, may be on another branch.
const ASTRAY: f64 = 0.25;
/// How a motion leaves a singular position.
pub struct Departure {
    /// That position (n).
    pub q: Vec<f64>,
    /// The velocities there (n).
    pub v: Vec<f64>,
    /// A regular position of the branch (n).
    pub away: Vec<f64>,
    /// Time and drivers for that.
    pub inputs: Inputs,
    /// What is said of the choice, where the way from the drawing made it.
    pub warning: Option<String>,
}

/// Of a mechanism that is free to move; `None` if it starts regularly, or nothing is known to lead away.
///
/// # Errors
/// Velocities that lie on no branch, and branches that nothing decides between.
pub fn free(system: &System, assembled: &Assembled) -> Result<Option<Departure>, Stop> {
    let inputs = Inputs::at_time(system, 0.0);
    let q = &assembled.q;
    let Some(taken) = taken(system, assembled, &inputs)? else {
        return Ok(None);
    };
    let Taken { branch, v, warning } = taken;
    let direction = match system.drivers.is_empty() {
        true => Some(branch.direction),
        false => held(system, q, &inputs, &branch)?,
    };
    let found = direction.and_then(|direction| away(system, system.m(), (q, &direction), &inputs));
    Ok(found.map(|away| Departure {
        q: q.clone(),
        v,
        away,
        inputs,
        warning,
    }))
}

/// Of a mechanism that one driver moves; `None` if that can't leave the position.
///
/// # Errors
/// As [`free`].
pub fn driven(system: &System, assembled: &Assembled) -> Result<Option<Departure>, Stop> {
    let mut inputs = Inputs::at_time(system, 0.0);
    let q = &assembled.q;
    if system.drivers.len() != 1 {
        return Ok(None);
    }
    let Some(taken) = taken(system, assembled, &inputs)? else {
        return Ok(None);
    };
    let Taken { branch, v, warning } = taken;
    if branch.freedom != 1 {
        return Ok(None);
    }
    let at = (&q[..], &branch.direction[..]);
    let Some(away) = away(system, system.joint_rows(), at, &inputs) else {
        return Ok(None);
    };
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(&away);
    evaluation.eval_phi(system, &inputs);
    // All drivers' equations say: what is wanted less what is.
    inputs.drive[0][0] -= evaluation.phi[system.driver_row(DriverId(0))];
    Ok(Some(Departure {
        q: q.clone(),
        v,
        away,
        inputs,
        warning,
    }))
}

/// Whether joints alone leave as much freedom as there are drivers, on the branches from a singular position.
pub fn is_driven(system: &System, assembled: &Assembled) -> bool {
    if system.drivers.is_empty() || assembled.joints.dependent.is_empty() {
        return false;
    }
    let inputs = Inputs::at_time(system, 0.0);
    let singular = Singularity::at(system, &assembled.q, &inputs, system.joint_rows());
    let Ok(Some(mut singular)) = singular else {
        return false;
    };
    let branches = singular.branches(&vec![0.0; system.n()]);
    !branches.is_empty()
        && branches
            .iter()
            .all(|branch| branch.freedom == system.drivers.len())
}

/// A branch, and the velocities on it.
struct Taken {
    branch: Branch,
    v: Vec<f64>,
    /// What is said of the choice, where the way from the drawing made it.
    warning: Option<String>,
}

/// The branch that is meant.
fn taken(system: &System, assembled: &Assembled, inputs: &Inputs) -> Result<Option<Taken>, Stop> {
    if assembled.joints.dependent.is_empty() && assembled.joints.smallest_kept > DOUBTFUL {
        return Ok(None);
    }
    let q = &assembled.q;
    let singular = Singularity::at(system, q, inputs, system.joint_rows());
    let Some(mut singular) = singular.map_err(|fault| failed(fault.to_string()))? else {
        return Ok(None);
    };
    let mut branches = singular.branches(&vec![0.0; system.n()]);
    let wanted = prescribed(system, q, inputs);
    let paces = branches.iter().map(|branch| pace(system, branch, &wanted));
    let Some(paces) = paces.collect::<Option<Vec<Pace>>>() else {
        return Ok(None);
    };
    let fastest = paces
        .iter()
        .fold(0.0, |most: f64, pace| most.max(max_abs(&pace.v)));
    let slow = ON * fastest + STILL / system.scale.time;
    let fits = |k: usize| max_abs(&paces[k].missing) <= slow;
    let hinted = hinted(system, &branches)?;
    let mut fitting = (0..branches.len()).filter(|&k| fits(k));
    let arrives = |k: &usize| {
        let direction = assembled.arrival.as_ref();
        fits(*k) && direction.is_some_and(|direction| branches[*k].holds(direction))
    };
    let mut warning = None;
    let chosen = match (hinted, fitting.next(), fitting.next()) {
        // Nothing leads away, or nothing as the drivers move.
        (_, None, _) if system.initial_rates.is_empty() => return Ok(None),
        (Some(k), ..) if !fits(k) => return Err(off(system, &paces[k], "that is meant")),
        (Some(k), ..) => k,
        (None, Some(k), None) => k,
        (None, None, _) => {
            let least = |k: &usize| max_abs(&paces[*k].missing);
            let nearest = (0..paces.len()).min_by(|a, b| least(a).total_cmp(&least(b)));
            // there is one: `initial_rates` and branches are not empty
            return Err(nearest.map_or_else(
                || undecided(system, &branches),
                |k| off(system, &paces[k], "nearest to them"),
            ));
        }
        (None, Some(_), Some(_)) => match (0..branches.len()).find(arrives) {
            Some(k) => {
                warning = Some(arrived(system, &branches, k));
                k
            }
            None => return Err(undecided(system, &branches)),
        },
    };
    let mut v = paces[chosen].v.clone();
    system.scale_columns(&mut v);
    let branch = branches.swap_remove(chosen);
    Ok(Some(Taken { branch, v, warning }))
}

/// The velocities of least kinetic energy on a branch that come nearest to what is prescribed.
pub(super) fn pace(
    system: &System,
    branch: &Branch,
    (rows, wanted): &(Vec<Vec<f64>>, Vec<f64>),
) -> Option<Pace> {
    let (f, r) = (branch.tangents.len(), rows.len());
    let weights = weights(system);
    let product = |a: &[f64], b: &[f64]| {
        let pairs = a.iter().zip(b).zip(&weights);
        pairs.map(|((a, b), w)| a * b * w).sum::<f64>()
    };
    let mut mass: Vec<f64> = (0..f * f)
        .map(|k| product(&branch.tangents[k / f], &branch.tangents[k % f]))
        .collect();
    if !cholesky(&mut mass, f, f64::EPSILON) {
        return None;
    }
    // Columns M⁻¹ (A T)ᵀ, and A T M⁻¹ (A T)ᵀ.
    let seen: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| branch.tangents.iter().map(|t| dot(row, t)).collect())
        .collect();
    let responses: Vec<Vec<f64>> = seen
        .iter()
        .map(|row| {
            let mut response = row.clone();
            cholesky_solve(&mass, &mut response);
            response
        })
        .collect();
    let values = (0..r * r).map(|k| dot(&seen[k / r], &responses[k % r]));
    let forces = least_norm_solve(&Dense::new(r, r, values.collect()), wanted, RANK).ok()?;
    let mut v = vec![0.0; system.n()];
    for (response, force) in responses.iter().zip(&forces.x) {
        for (tangent, share) in branch.tangents.iter().zip(response) {
            let parts = v.iter_mut().zip(tangent);
            parts.for_each(|(v, t)| *v += force * share * t);
        }
    }
    let missing = rows.iter().zip(wanted);
    let missing = missing.map(|(row, wanted)| wanted - dot(row, &v)).collect();
    Some(Pace { v, missing })
}

/// The branch on which bodies turn as the initial values say, where these say anything.
pub(super) fn hinted(system: &System, branches: &[Branch]) -> Result<Option<usize>, Stop> {
    if system.branch.is_empty() || branches.is_empty() {
        return Ok(None);
    }
    let mut misses: Vec<(usize, f64)> = branches
        .iter()
        .map(|branch| miss(system, &system.branch, branch))
        .enumerate()
        .collect();
    misses.sort_by(|(_, a), (_, b)| a.total_cmp(b));
    let (nearest, least) = misses[0];
    let next = misses.get(1).map_or(f64::INFINITY, |(_, next)| *next);
    match least < NEAR && least < NEARER * next {
        true => Ok(Some(nearest)),
        false => Err(undecided(system, branches)),
    }
}

/// A direction in which all rows, those of drivers at rest too, let the position be left on a branch of the joints.
fn held(
    system: &System,
    q: &[f64],
    inputs: &Inputs,
    branch: &Branch,
) -> Result<Option<Vec<f64>>, Stop> {
    let singular = Singularity::at(system, q, inputs, system.m());
    let Some(mut singular) = singular.map_err(|fault| failed(fault.to_string()))? else {
        return Ok(None);
    };
    let branches = singular.branches(&vec![0.0; system.n()]);
    Ok(branches
        .into_iter()
        .map(|branch| branch.direction)
        .find(|direction| branch.holds(direction)))
}

/// A regular position of the first `rows` rows, away from the singular one on the branch that leaves in a direction.
pub(super) fn away(
    system: &System,
    rows: usize,
    (q, direction): (&[f64], &[f64]),
    inputs: &Inputs,
) -> Option<Vec<f64>> {
    let mut here = beside(system, rows, (q, direction), inputs)?;
    let blocks: Vec<&Block> = system.blocks.iter().filter(|b| b.row() < rows).collect();
    let apart = |a: &[f64], b: &[f64]| {
        let between: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
        system.scaled_norm(&between)
    };
    loop {
        let way = apart(&here, q);
        if way >= FAR {
            return Some(here);
        }
        let guess: Vec<f64> = here.iter().zip(q).map(|(h, q)| 2.0 * h - q).collect();
        let closed = close(system, &blocks, &guess, inputs);
        let regular = || matches!(Singularity::at(system, &closed.q, inputs, rows), Ok(None));
        if !closed.converged || apart(&closed.q, &guess) > ASTRAY * way || !regular() {
            return Some(here);
        }
        here = closed.q;
    }
}
