//! Assembly with its diagnosis: what does not close, what is over- or underdetermined, and by whose fault.

use super::in_line::singular_text;
use super::{Stop, overlap};
use crate::graph::Topology;
use crate::mechanism::closing::{Closed, close, close_weighted};
use crate::mechanism::least_velocity::least_velocity;
use crate::system::{Block, Evaluation, Inputs, Origin, System};
use linkdyn_linear::rank::{
    DEPENDENCE_TOLERANCE, RankReport, SparseRows, free_direction, independent_rows,
};
use linkdyn_model::error::Complaint;
use linkdyn_output::{Mobility, Status};

/// An assembled mechanism.
#[derive(Debug, Clone)]
pub struct Assembled {
    pub q: Vec<f64>,
    /// Rank of the joints' rows, and of joints' and drivers' rows together.
    pub joints: RankReport,
    pub all: RankReport,
    pub mobility: Mobility,
    pub iterations: u64,
    pub warnings: Vec<String>,
}

/// Change of the coordinates, in rad or mechanism sizes, by which a singular start is left to see its ranks from outside.
const NUDGE: f64 = 1e-2;
/// Turns of the bodies, largest in rad, by which a drawing is left that is singular itself: there the least gap may be a
/// saddle, from which no way leads to the assembly.
const KICKS: [f64; 6] = [0.02, -0.02, 0.2, -0.2, 0.7, -0.7];
/// A null vector's component below this is round-off of the rank decision.
const MOVES: f64 = 1e-6;

/// Assembles at `inputs` from the model's guess; with `initial` values exact.
///
/// # Errors
/// [`Stop::Failed`] with status `assembly_failed` and the loop or the values that do not fit.
pub fn assemble(system: &System, inputs: &Inputs) -> Result<Assembled, Stop> {
    if let Some(complaint) = too_long(system).or_else(|| too_far(system, inputs)) {
        return Err(Stop::Input(vec![complaint]));
    }
    let all: Vec<&Block> = system.blocks.iter().chain(&system.initial).collect();
    let closed = close(system, &all, &system.guess, inputs);
    let (q, iterations, warnings) = if closed.converged {
        (closed.q, closed.iterations, Vec::new())
    } else {
        diagnose(system, inputs, closed)?
    };
    let (joints, all) = ranks(system, &q, inputs);
    if all
        .dependent
        .iter()
        .any(|dependent| dependent.row >= system.joint_rows())
    {
        overlap::refuse(system, &q, inputs)?;
    }
    let mobility = mobility(system, &joints);
    Ok(Assembled {
        q,
        joints,
        all,
        mobility,
        iterations,
        warnings,
    })
}

/// The same position with the ranks and the mobility of another system of the same bodies.
pub fn ranked(system: &System, assembled: Assembled, inputs: &Inputs) -> Assembled {
    let (joints, all) = ranks(system, &assembled.q, inputs);
    let mobility = mobility(system, &joints);
    Assembled {
        joints,
        all,
        mobility,
        ..assembled
    }
}

/// Ranks of the joints' rows and of all rows at `q`.
pub fn ranks(system: &System, q: &[f64], inputs: &Inputs) -> (RankReport, RankReport) {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_jacobian(system, inputs);
    let of = |rows| {
        independent_rows(
            &scaled_rows(system, &evaluation.jacobian, rows),
            DEPENDENCE_TOLERANCE,
        )
    };
    (of(system.joint_rows()), of(system.m()))
}

/// The first `rows` rows of the scaled Jacobian.
fn scaled_rows(system: &System, values: &[f64], rows: usize) -> SparseRows {
    let entries: Vec<(usize, usize, f64)> = system
        .entries
        .iter()
        .zip(values)
        .filter_map(|(entry, value)| {
            let (row, column) = (entry.row as usize, entry.column? as usize);
            (row < rows).then(|| {
                (
                    row,
                    column,
                    value * system.column_scale(column) / system.row_scale(row),
                )
            })
        })
        .collect();
    match SparseRows::from_triplets(rows, system.n(), &entries) {
        Ok(rows) => rows,
        // `assemble` has seen to it that no number overflows.
        Err(bad) => panic!(
            "the Jacobian's entry at row {}, column {} is not finite",
            bad.row, bad.column
        ),
    }
}

/// Lengths up to which squares, and what is made of them, do not overflow \[m\].
const LONGEST: f64 = 1e60;

/// Complains of lengths that can't be computed with.
fn too_long(system: &System) -> Option<Complaint> {
    let far = system
        .guess
        .iter()
        .chain([&system.size, &system.reach])
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    (far > LONGEST).then(|| {
        Complaint::new(
            "bodies",
            format!(
                "the mechanism is larger than {}, where numbers overflow",
                system.display.length(LONGEST)
            ),
        )
        .hint("look for a length with a wrong exponent or unit")
    })
}

/// Complains of a joint, driver or initial value that is further from the drawing than can be computed with.
fn too_far(system: &System, inputs: &Inputs) -> Option<Complaint> {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(&system.guess);
    let at = evaluation.kinematics(inputs);
    let is_far = |block: &&Block| {
        let mut phi = vec![0.0; block.rows];
        block.constraint.position(&at, &mut phi);
        phi.iter().any(|x| x.is_nan() || x.abs() > LONGEST)
    };
    let block = system.blocks.iter().chain(&system.initial).find(is_far)?;
    let path = match &block.origin {
        Origin::Joint(id) => format!("joints.{}", system.joints[id.0].name),
        Origin::Driver(id) => format!("drivers.{}", system.drivers[id.0].name),
        Origin::Initial(name) => format!("initial.{name}"),
    };
    Some(
        Complaint::new(
            path,
            format!("it wants bodies further than {LONGEST:e} m or rad from the drawing, where numbers overflow"),
        )
        .hint("look for an angle or a length with a wrong exponent or unit"),
    )
}

/// A direction in which nothing holds the mechanism at `q`, scaled; see [`free_direction`].
fn free(system: &System, q: &[f64], inputs: &Inputs) -> Option<Vec<f64>> {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_jacobian(system, inputs);
    free_direction(
        &scaled_rows(system, &evaluation.jacobian, system.m()),
        DEPENDENCE_TOLERANCE,
    )
}

/// Grübler's count and the count by rank, with the joints that are redundant.
fn mobility(system: &System, joints: &RankReport) -> Mobility {
    let n = system.n() as i64;
    let mut redundant: Vec<usize> = joints
        .dependent
        .iter()
        .filter_map(|d| joint_of(system, d.row))
        .collect();
    redundant.dedup();
    let mut shared: Vec<usize> = joints
        .dependent
        .iter()
        .flat_map(|d| d.combination.iter().map(|(row, _)| *row).chain([d.row]))
        .filter_map(|row| joint_of(system, row))
        .collect();
    shared.sort_unstable();
    shared.dedup();
    let names = |joints: Vec<usize>| {
        joints
            .into_iter()
            .map(|k| system.joints[k].name.clone())
            .collect()
    };
    Mobility {
        grubler: n - system.joint_rows() as i64,
        rank: n - joints.rank as i64,
        drivers: system.drivers.len(),
        redundant: names(redundant),
        reactions_not_unique: names(shared),
    }
}

/// Mobility of a mechanism that does not assemble or can't start: by rank near its guess, which may be singular itself.
pub fn counted(system: &System) -> Mobility {
    let inputs = Inputs::at_time(system, 0.0);
    mobility(system, &ranks(system, &kicked(system, KICKS[0]), &inputs).0)
}

/// The guess with its bodies turned by parts of `largest`, each by another.
fn kicked(system: &System, largest: f64) -> Vec<f64> {
    kicked_from(system, &system.guess, largest)
}

fn kicked_from(system: &System, q: &[f64], largest: f64) -> Vec<f64> {
    let mut q = q.to_vec();
    for (k, body) in system.layout.bodies().enumerate() {
        // Multiples of the golden ratio are spread evenly, and never alike.
        let part = (0.618_033_988_749_895 * (k + 1) as f64).fract();
        q[body.theta()] += largest * (0.2 + 0.8 * part) * if k % 2 == 0 { 1.0 } else { -1.0 };
    }
    q
}

/// A position a little beside `q` that the joints allow, drivers or not.
pub fn beside_by_joints(system: &System, q: &[f64], inputs: &Inputs) -> Option<Vec<f64>> {
    let joints: Vec<&Block> = system
        .blocks
        .iter()
        .filter(|b| matches!(b.origin, Origin::Joint(_)))
        .collect();
    let closed = KICKS
        .iter()
        .map(|&kick| close(system, &joints, &kicked_from(system, q, kick), inputs));
    closed
        .into_iter()
        .find(|closed| closed.converged)
        .map(|closed| closed.q)
}

/// An assembly from where the guess is left a little.
fn close_from_beside(system: &System, inputs: &Inputs) -> Option<Closed> {
    let all: Vec<&Block> = system.blocks.iter().chain(&system.initial).collect();
    KICKS
        .iter()
        .map(|&kick| close(system, &all, &kicked(system, kick), inputs))
        .find(|closed| closed.converged)
}

fn joint_of(system: &System, row: usize) -> Option<usize> {
    match system.block_of_row(row).origin {
        Origin::Joint(id) => Some(id.0),
        Origin::Driver(_) | Origin::Initial(_) => None,
    }
}

/// Finds out why everything together does not assemble, or assembles by another way.
fn diagnose(
    system: &System,
    inputs: &Inputs,
    closed: Closed,
) -> Result<(Vec<f64>, u64, Vec<String>), Stop> {
    let joints: Vec<&Block> = system
        .blocks
        .iter()
        .filter(|b| matches!(b.origin, Origin::Joint(_)))
        .collect();
    let undriven = close(system, &joints, &system.guess, inputs);
    if !undriven.converged {
        if let Some(found) = close_from_beside(system, inputs) {
            let warning = "assembled from a drawing with its bodies turned a little, since from the one given no way leads to an \
                           assembly (its bodies lie in a line?); check that this is the assembly you want, or give poses \
                           closer to it"
                .to_string();
            return Ok((found.q, closed.iterations + found.iterations, vec![warning]));
        }
        return Err(Stop::failed(
            Status::AssemblyFailed,
            open_loop(system, &undriven),
        ));
    }
    // The joints alone close: then it is a driver or an initial value.
    let (by_joints, _) = ranks(system, &undriven.q, inputs);
    let freedom = system.n() - by_joints.rank;
    if system.drivers.len() > freedom {
        return Err(Stop::Input(vec![over_driven(system, freedom)]));
    }
    overlap::refuse(system, &undriven.q, inputs)?;
    let driven: Vec<&Block> = system.blocks.iter().collect();
    if !system.initial.is_empty() && close(system, &driven, &system.guess, inputs).converged {
        return Err(Stop::failed(
            Status::AssemblyFailed,
            conflicting(system, inputs),
        ));
    }
    // Drive from where the joints close to where the drivers want it, in small parts.
    if let Some((q, iterations)) = drive_there(system, inputs, &undriven.q) {
        let warning = "assembled by moving the drivers from where the drawing has them to their first values; \
                       check that this is the assembly you want, or give poses closer to it"
            .to_string();
        return Ok((q, closed.iterations + iterations, vec![warning]));
    }
    let held = close_weighted(system, &driven, DRIVERS_FIRST, &system.guess, inputs);
    Err(Stop::failed(
        Status::AssemblyFailed,
        format!(
            "can't assemble: the joints alone close, but with the drivers at their first values {}; change the start of a \
             driver, or the lengths that keep it from there",
            gap_text(system, &held)
        ),
    ))
}

/// Weight of drivers when the gap that they leave is measured: they are met to a millionth of it.
const DRIVERS_FIRST: f64 = 1e3;

/// Homotopy of the drivers from their values in a joints-only assembly to those of `inputs`.
fn drive_there(system: &System, inputs: &Inputs, q: &[f64]) -> Option<(Vec<f64>, u64)> {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_phi(system, inputs);
    let gaps: Vec<f64> = (0..system.drivers.len())
        .map(|k| evaluation.phi[system.joint_rows() + k])
        .collect();
    let all: Vec<&Block> = system.blocks.iter().chain(&system.initial).collect();
    let (mut q, mut part, mut step, mut iterations) = (q.to_vec(), 0.0, 0.05_f64, 0);
    while part < 1.0 {
        let next = (part + step).min(1.0);
        let mut between = inputs.clone();
        for (jet, gap) in between.drive.iter_mut().zip(&gaps) {
            jet[0] -= gap * (1.0 - next);
        }
        let closed = close(system, &all, &q, &between);
        iterations += closed.iterations;
        let moved: Vec<f64> = closed.q.iter().zip(&q).map(|(a, b)| a - b).collect();
        if closed.converged && system.scaled_norm(&moved) < 0.3 {
            q = closed.q;
            part = next;
            step *= 1.5;
        } else {
            step *= 0.5;
            if step < 1e-4 {
                return None;
            }
        }
    }
    Some((q, iterations))
}

/// What to say of joints that do not close by themselves.
fn open_loop(system: &System, closed: &Closed) -> String {
    format!(
        "can't assemble: {}; change a length in it, or draw the guess closer to the assembly",
        gap_text(system, closed)
    )
}

/// Digits of a gap: of a compromise that drivers are met in to a millionth.
const GAP_DIGITS: usize = 4;

/// The loop with the largest gap, and that gap: in the least-squares compromise it is shared out evenly among the loop's
/// joints, so their gaps add up to it.
fn gap_text(system: &System, closed: &Closed) -> String {
    let gap = |joint: usize| closed.gaps[joint];
    let topology = topology(system);
    let widest = topology
        .loops()
        .iter()
        .map(|cycle| {
            (
                cycle,
                cycle.joints.iter().map(|&joint| gap(joint)).sum::<f64>(),
            )
        })
        .max_by(|a, b| a.1.total_cmp(&b.1));
    match widest {
        Some((cycle, gap)) => {
            let names: Vec<&str> = cycle
                .joints
                .iter()
                .map(|&joint| system.joints[joint].name.as_str())
                .collect();
            let gap = system.display.length_to(gap * system.size, GAP_DIGITS);
            format!(
                "the loop {} does not close; it lacks {gap} at the best position found",
                listed(&names, " – ")
            )
        }
        None => {
            let worst = (0..system.joints.len()).max_by(|&a, &b| gap(a).total_cmp(&gap(b)));
            let name = worst.map_or("no joint", |joint| system.joints[joint].name.as_str());
            let gap = system
                .display
                .length_to(worst.map_or(0.0, gap) * system.size, GAP_DIGITS);
            format!("joint \"{name}\" is open by {gap} at the best position found")
        }
    }
}

/// The initial values that can't be met together: each that the others leave no room for.
fn conflicting(system: &System, inputs: &Inputs) -> String {
    let mut names = Vec::new();
    for left_out in 0..system.initial.len() {
        let others: Vec<&Block> = system
            .blocks
            .iter()
            .chain(
                system
                    .initial
                    .iter()
                    .enumerate()
                    .filter(|(k, _)| *k != left_out)
                    .map(|(_, block)| block),
            )
            .collect();
        if close(system, &others, &system.guess, inputs).converged {
            names.push(system.origin_name(&system.initial[left_out].origin));
        }
    }
    if names.is_empty() {
        names = system
            .initial
            .iter()
            .map(|block| system.origin_name(&block.origin))
            .collect();
    }
    let who = listed(&names, " and ");
    format!(
        "can't assemble: {who} can't be met together with the joints and drivers; leave out one, or change it"
    )
}

fn over_driven(system: &System, freedom: usize) -> Complaint {
    let names = quoted(system.drivers.iter().map(|driver| driver.name.as_str()));
    Complaint::new(
        "drivers",
        format!(
            "too many drivers: the joints leave {freedom} degree{} of freedom, and there are {} drivers ({})",
            if freedom == 1 { "" } else { "s" },
            system.drivers.len(),
            names
        ),
    )
    .hint("take drivers out until their number is that of the degrees of freedom")
}

/// The graph of bodies and joints.
pub fn topology(system: &System) -> Topology {
    let joints: Vec<(usize, usize, usize)> = system
        .joints
        .iter()
        .zip(&system.blocks)
        .map(|(joint, block)| (joint.bodies[0].0, joint.bodies[1].0, block.rows))
        .collect();
    Topology::new(system.bodies.len() + 1, &joints)
}

/// Checks that the drivers determine the motion.
///
/// # Errors
/// Too few or too many drivers (input), or a start in a singular position.
pub fn check_driven(system: &System, assembled: &Assembled, inputs: &Inputs) -> Result<(), Stop> {
    let n = system.n();
    // Consistent or not, drivers beyond the freedom fight each other; beside the position it is not larger.
    if system.drivers.len() > n - assembled.joints.rank {
        return Err(Stop::Input(vec![over_driven(
            system,
            n - assembled.joints.rank,
        )]));
    }
    if assembled.all.rank == n {
        return Ok(());
    }
    // A loss of rank may be the position's alone: look from a little beside it.
    let direction = free(system, &assembled.q, inputs).unwrap_or_default();
    let beside = nudged(system, assembled, &direction, inputs);
    let (joints, all) = beside.map_or((assembled.joints.clone(), assembled.all.clone()), |q| {
        ranks(system, &q, inputs)
    });
    let freedom = n - joints.rank;
    if system.drivers.len() > freedom {
        return Err(Stop::Input(vec![over_driven(system, freedom)]));
    }
    if all.rank < n {
        return Err(Stop::Input(vec![under_driven(system, freedom, &direction)]));
    }
    let what = singular_text(system, &assembled.all.dependent_rows());
    let what = what.map_or_else(String::new, |what| format!(": {what}"));
    Err(Stop::failed(
        Status::Singular,
        format!(
            "the start is a singular position (the constraints lose rank there{what}), so that more than one motion leads away \
             from it, or none; start a little beside it"
        ),
    ))
}

/// A position a little beside, along a null direction of all rows, with the joints closed again.
fn nudged(
    system: &System,
    assembled: &Assembled,
    direction: &[f64],
    inputs: &Inputs,
) -> Option<Vec<f64>> {
    let joints: Vec<&Block> = system
        .blocks
        .iter()
        .filter(|b| matches!(b.origin, Origin::Joint(_)))
        .collect();
    let largest = linkdyn_linear::math::max_abs(direction);
    let mut q = assembled.q.clone();
    for (k, (q, d)) in q.iter_mut().zip(direction).enumerate() {
        *q += NUDGE * d / largest * system.column_scale(k);
    }
    let closed = close(system, &joints, &q, inputs);
    closed.converged.then_some(closed.q)
}

fn under_driven(system: &System, freedom: usize, direction: &[f64]) -> Complaint {
    let moves = |k: usize| {
        direction[system.layout.moving(k).range()]
            .iter()
            .any(|z| z.abs() > MOVES)
    };
    let moving = system
        .bodies
        .iter()
        .enumerate()
        .filter(|(k, _)| moves(*k))
        .map(|(_, body)| body.name.as_str());
    let drivers = system.drivers.len();
    Complaint::new(
        "drivers",
        format!(
            "too few drivers: the joints leave {freedom} degree{} of freedom, {drivers} driven; {} can still move",
            if freedom == 1 { "" } else { "s" },
            quoted(moving)
        ),
    )
    .hint("drive what is free, or hold it by a joint")
}

/// Names that a message lists before it only counts them.
const MOST_NAMES: usize = 12;

/// `"a", "b", "c"`, as many as anybody reads.
pub fn quoted<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.map(|name| format!("\"{name}\"")).collect();
    listed(&names, ", ")
}

/// Names with something between them, as many as anybody reads.
pub fn listed<S: AsRef<str>>(names: &[S], between: &str) -> String {
    let first: Vec<&str> = names.iter().take(MOST_NAMES).map(AsRef::as_ref).collect();
    let text = first.join(between);
    if names.len() > MOST_NAMES {
        format!("{text}{between}and {} more", names.len() - MOST_NAMES)
    } else {
        text
    }
}

/// Initial velocities that miss the constraints by more than this [1/s] conflict with them: values written with eight
/// digits pass.
const CONFLICT: f64 = 1e-7;

/// Velocities at an assembled position: those of least kinetic energy that satisfy constraints, drivers and the given
/// initial velocities; where masses are unknown, of least square (lengths by the mechanism's size).
///
/// # Errors
/// Initial velocities that conflict.
pub fn velocities(system: &System, q: &[f64], inputs: &Inputs) -> Result<Vec<f64>, Stop> {
    velocities_near(system, q, inputs, true, None)
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
    if !system.initial_rates.is_empty() && (off.is_nan() || off > CONFLICT * (1.0 + speed)) {
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
