//! Assembly: the nearest position that meets the constraints, from a rough guess.
//!
//! Damped Newton in the form of Levenberg and Marquardt, lengths scaled by the mechanism's size (tilde):
//!
//! ```text
//! | I   J̃ᵀ | | d |   |  0 |
//! | J̃  −μI | | y | = | −φ̃ |        ⇒   d = −J̃ᵀ (J̃ J̃ᵀ + μ I)⁻¹ φ̃
//! ```
//!
//! so every step is the shortest one, freedom that nothing prescribes stays where the guess has it, redundant rows do no
//! harm, and with μ = ν |φ̃|² convergence is quadratic even where rank is lost (Yamashita and Fukushima 2001). A loop that
//! can't be closed ends in the least-squares compromise, where the sum of a loop's joint gaps is what it lacks.

use crate::element::Constraint;
use crate::system::{Block, Evaluation, Inputs, Origin, System};
use linkdyn_linear::lu::SparseLu;
use linkdyn_linear::order::ColumnOrder;
use linkdyn_linear::pattern::{Pattern, square};

/// A position and how well it meets the constraints.
#[derive(Debug, Clone)]
pub struct Closed {
    pub q: Vec<f64>,
    /// Residual of each block, in the order given (lengths by the mechanism's size, angles plain), as a Euclidean norm.
    pub gaps: Vec<f64>,
    pub converged: bool,
    pub iterations: u64,
}

/// Scaled residual at which a position counts as assembled; the driven solver then polishes to round-off.
const CLOSED: f64 = 1e-13;
/// Smallest damping: it must stay well above round-off, for with redundant rows it is what keeps the matrix regular, and
/// slows convergence no more than 1e-10 a step.
const LEAST_DAMPING: f64 = 1e-10;
/// Longest step, in rad or mechanism sizes: a Newton direction means nothing farther away.
const LONGEST_STEP: f64 = 0.5;
const MAX_ITERATIONS: u64 = 300;

/// Rows and entries of a chosen set of blocks.
struct Rows<'a> {
    blocks: &'a [&'a Block],
    /// (row, column) of every Jacobian entry, ground left out by slot `nnz`.
    slots: Vec<[u32; 2]>,
    diagonal: Vec<u32>,
    starts: Vec<usize>,
    /// Weight of each block's residual.
    weights: Vec<f64>,
    m: usize,
}

/// Moves `guess` onto the constraints of `blocks`.
pub fn close(system: &System, blocks: &[&Block], guess: &[f64], inputs: &Inputs) -> Closed {
    close_weighted(system, blocks, 1.0, guess, inputs)
}

/// As [`close`], with residuals of drivers and initial values weighed: where not everything can be met, a large weight
/// leaves the whole gap to the joints. The gaps returned are unweighed.
pub fn close_weighted(
    system: &System,
    blocks: &[&Block],
    weight: f64,
    guess: &[f64],
    inputs: &Inputs,
) -> Closed {
    let n = system.n();
    let (rows, pattern) = layout(system, blocks, weight);
    let mut evaluation = Evaluation::new(system);
    let mut q = guess.to_vec();
    let mut phi = vec![0.0; rows.m];
    let mut values = vec![0.0; pattern.entries() + 1];
    let mut lu = SparseLu::new(pattern.clone(), ColumnOrder::amd(&pattern));
    let mut norm = residual(system, &rows, &mut evaluation, &q, inputs, &mut phi);
    let (mut nu, mut stalled) = (1.0_f64, 0);
    let mut iterations = 0;
    let mut trial = q.clone();
    let mut trial_phi = phi.clone();
    while iterations < MAX_ITERATIONS
        && linkdyn_linear::math::max_abs(&phi) > CLOSED
        && nu < 1e14
        && stalled < 12
    {
        iterations += 1;
        evaluation.set_position(&q);
        matrix(system, &rows, &evaluation, inputs, &mut values);
        let damping = (nu * norm * norm).max(LEAST_DAMPING);
        for (k, &slot) in rows.diagonal.iter().enumerate() {
            values[slot as usize] = if k < n { 1.0 } else { -damping };
        }
        let mut step: Vec<f64> = std::iter::repeat_n(0.0, n)
            .chain(phi.iter().map(|p| -p))
            .collect();
        if lu.factor(&values[..pattern.entries()]).is_err() {
            nu *= 8.0;
            continue;
        }
        lu.solve(&mut step);
        let size = linkdyn_linear::math::max_abs(&step[..n]);
        let shorten = (LONGEST_STEP / size).min(1.0);
        for (k, t) in trial.iter_mut().enumerate() {
            *t = q[k] + shorten * step[k] * system.column_scale(k);
        }
        let trial_norm = residual(
            system,
            &rows,
            &mut evaluation,
            &trial,
            inputs,
            &mut trial_phi,
        );
        if trial_norm < norm {
            stalled = if trial_norm > (1.0 - 1e-6) * norm {
                stalled + 1
            } else {
                0
            };
            std::mem::swap(&mut q, &mut trial);
            std::mem::swap(&mut phi, &mut trial_phi);
            norm = trial_norm;
            nu = (nu * 0.25).max(1e-8);
        } else {
            // At the last digits no step improves the norm any more.
            if size < 1e-13 {
                break;
            }
            nu *= 8.0;
        }
    }
    let gaps = rows
        .starts
        .iter()
        .zip(blocks)
        .zip(&rows.weights)
        .map(|((&start, block), weight)| {
            phi[start..start + block.rows]
                .iter()
                .map(|p| p * p)
                .sum::<f64>()
                .sqrt()
                / weight
        })
        .collect();
    let converged = linkdyn_linear::math::max_abs(&phi) <= 100.0 * CLOSED;
    Closed {
        q,
        gaps,
        converged,
        iterations,
    }
}

/// Velocities of least kinetic energy ½ vᵀ M v that satisfy J v = −φ_t and the initial velocities; where masses are
/// unknown, of least square. Coordinates without mass weigh next to nothing. Returns v (n) and the scaled residual of
/// every row, the initial velocities last. With `near` the kinetic energy of the difference from it is least.
pub fn least_velocity(
    system: &System,
    q: &[f64],
    inputs: &Inputs,
    with_initial: bool,
    near: Option<&[f64]>,
) -> (Vec<f64>, Vec<f64>) {
    let n = system.n();
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_jacobian(system, inputs);
    let mut rate = vec![0.0; system.m()];
    evaluation.eval_rate(system, inputs, &mut rate);
    // Rows of the system, then one per initial velocity, scaled.
    let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); system.m()];
    let mut rhs: Vec<f64> = rate
        .iter()
        .enumerate()
        .map(|(row, r)| -r / system.row_scale(row))
        .collect();
    for (entry, value) in system.entries.iter().zip(&evaluation.jacobian) {
        if let Some(column) = entry.column {
            let (row, column) = (entry.row as usize, column as usize);
            rows[row].push((
                column,
                value * system.column_scale(column) / system.row_scale(row),
            ));
        }
    }
    let at = evaluation.instant(inputs);
    for (_, rate) in system.initial_rates.iter().filter(|_| with_initial) {
        let entries = rate.entries();
        let mut values = vec![0.0; entries.len()];
        rate.jacobian(&at, &mut values);
        let scale = system.measure_scale(rate.rows()[0]);
        let row = entries
            .iter()
            .zip(&values)
            .filter_map(|(&(_, body, axis), value)| {
                let column = system.layout.column(body, axis)?;
                Some((column, value * system.column_scale(column) / scale))
            });
        rows.push(row.collect());
        rhs.push(-rate.value / scale);
    }
    let weights = weights(system);
    let m = rows.len();
    let mut entries: Vec<(usize, usize)> = (0..n + m).map(|k| (k, k)).collect();
    let mut values: Vec<f64> = weights
        .iter()
        .copied()
        .chain(std::iter::repeat_n(-LEAST_DAMPING, m))
        .collect();
    for (row, row_entries) in rows.iter().enumerate() {
        for &(column, value) in row_entries {
            entries.extend([(n + row, column), (column, n + row)]);
            values.extend([value; 2]);
        }
    }
    let (pattern, slots) = square(n + m, &entries);
    let mut stored = vec![0.0; pattern.entries()];
    slots
        .iter()
        .zip(&values)
        .for_each(|(&slot, value)| stored[slot as usize] = *value);
    let mut v: Vec<f64> = match near {
        Some(near) => near
            .iter()
            .enumerate()
            .map(|(column, v)| v / system.column_scale(column))
            .collect(),
        None => vec![0.0; n],
    };
    let missing = |v: &[f64]| -> Vec<f64> {
        let product = |row: &Vec<(usize, f64)>| {
            row.iter()
                .map(|&(column, value)| value * v[column])
                .sum::<f64>()
        };
        rhs.iter()
            .zip(&rows)
            .map(|(rhs, row)| rhs - product(row))
            .collect()
    };
    let mut residual = missing(&v);
    let mut lu = SparseLu::new(pattern.clone(), ColumnOrder::amd(&pattern));
    if lu.factor(&stored).is_ok() {
        // The damping is refined away.
        for _ in 0..4 {
            let mut step: Vec<f64> = std::iter::repeat_n(0.0, n)
                .chain(residual.iter().copied())
                .collect();
            lu.solve(&mut step);
            v.iter_mut().zip(&step).for_each(|(v, d)| *v += d);
            residual = missing(&v);
        }
    }
    v.iter_mut()
        .enumerate()
        .for_each(|(column, v)| *v *= system.column_scale(column));
    (v, residual)
}

/// Weight of each scaled coordinate's velocity, the largest 1.
fn weights(system: &System) -> Vec<f64> {
    if !system.masses_known {
        return vec![1.0; system.n()];
    }
    let scaled: Vec<f64> = system
        .mass
        .diagonal()
        .iter()
        .enumerate()
        .map(|(k, m)| m * system.column_scale(k) * system.column_scale(k))
        .collect();
    let largest = linkdyn_linear::math::max_abs(&scaled);
    if largest > 0.0 {
        scaled.iter().map(|w| (w / largest).max(MASSLESS)).collect()
    } else {
        vec![1.0; system.n()]
    }
}

/// Weight of a coordinate without mass, relative to the heaviest: enough to keep the matrix regular.
const MASSLESS: f64 = 1e-6;

fn layout<'a>(system: &System, blocks: &'a [&'a Block], weight: f64) -> (Rows<'a>, Pattern) {
    let n = system.n();
    let mut starts = Vec::with_capacity(blocks.len());
    let mut m = 0;
    for block in blocks {
        starts.push(m);
        m += block.rows;
    }
    let mut entries: Vec<(usize, usize)> = (0..n + m).map(|k| (k, k)).collect();
    let mut owners = Vec::new();
    for (block, start) in blocks.iter().zip(&starts) {
        for (row, body, axis) in block.constraint.entries() {
            let owner = system.layout.column(body, axis).map(|column| {
                let row = n + start + row;
                entries.push((row, column));
                entries.push((column, row));
                entries.len() - 2
            });
            owners.push(owner);
        }
    }
    let (pattern, slots) = square(n + m, &entries);
    let spare = pattern.entries() as u32;
    let owned = owners
        .into_iter()
        .map(|owner| owner.map_or([spare; 2], |k| [slots[k], slots[k + 1]]))
        .collect();
    let weights = blocks
        .iter()
        .map(|block| match block.origin {
            Origin::Joint(_) => 1.0,
            Origin::Driver(_) | Origin::Initial(_) => weight,
        })
        .collect();
    (
        Rows {
            blocks,
            slots: owned,
            diagonal: slots[..n + m].to_vec(),
            starts,
            weights,
            m,
        },
        pattern,
    )
}

/// Scaled residual of every row, and its Euclidean norm.
fn residual(
    system: &System,
    rows: &Rows,
    evaluation: &mut Evaluation,
    q: &[f64],
    inputs: &Inputs,
    phi: &mut [f64],
) -> f64 {
    evaluation.set_position(q);
    let at = evaluation.instant(inputs);
    for ((block, &start), weight) in rows.blocks.iter().zip(&rows.starts).zip(&rows.weights) {
        let phi = &mut phi[start..start + block.rows];
        block.constraint.position(&at, phi);
        for (p, measure) in phi.iter_mut().zip(block.constraint.rows()) {
            *p *= weight / system.measure_scale(*measure);
        }
    }
    phi.iter().map(|p| p * p).sum::<f64>().sqrt()
}

fn matrix(
    system: &System,
    rows: &Rows,
    evaluation: &Evaluation,
    inputs: &Inputs,
    values: &mut [f64],
) {
    let at = evaluation.instant(inputs);
    let mut buffer = [0.0; 16];
    let mut slots = rows.slots.iter();
    for (block, weight) in rows.blocks.iter().zip(&rows.weights) {
        let entries = block.constraint.entries();
        let buffer = &mut buffer[..entries.len()];
        block.constraint.jacobian(&at, buffer);
        for ((value, (row, _, axis)), slot) in buffer.iter().zip(entries).zip(&mut slots) {
            let column_scale = system.axis_scale(axis);
            let scaled =
                value * column_scale * weight / system.measure_scale(block.constraint.rows()[row]);
            values[slot[0] as usize] = scaled;
            values[slot[1] as usize] = scaled;
        }
    }
}
