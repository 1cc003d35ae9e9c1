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

mod proof;

use crate::system::{Block, Evaluation, Inputs, Origin, System};
use linkdyn_linear::lu::SparseLu;
use linkdyn_linear::math::max_abs;
use linkdyn_linear::order::ColumnOrder;
use linkdyn_linear::pattern::{Pattern, square};

/// A position and how well it meets the constraints.
#[derive(Debug, Clone)]
pub struct Closed {
    /// The position (n).
    pub q: Vec<f64>,
    /// Residual of each block, in the order given (lengths by the mechanism's size, angles plain), as a Euclidean norm.
    pub gaps: Vec<f64>,
    /// Whether it meets them.
    pub converged: bool,
    /// Steps tried.
    pub iterations: u64,
    /// Whether it is proven to be where the guess moves to, see [`proof`]. Asked of [`close_proven`] alone.
    pub proven: bool,
}

/// Scaled residual at which a position counts as assembled; the driven solver then polishes to round-off.
const CLOSED: f64 = 1e-13;
/// Round-off of a coordinate, by itself: of a chain whose links are short beside it, that is more than [`CLOSED`].
const ROUND_OFF: f64 = 2.0 * f64::EPSILON;
/// Smallest damping: it must stay well above round-off, for with redundant rows it is what keeps the matrix regular, and
/// slows convergence no more than 1e-10 a step.
const LEAST_DAMPING: f64 = 1e-10;
/// Longest step, in rad or mechanism sizes: a Newton direction means nothing farther away.
const LONGEST_STEP: f64 = 0.5;
const MAX_ITERATIONS: u64 = 300;
/// ν, the damping by the square of the residual: its factors after a good and a bad step, where it stays, and where the
/// search is given up.
const EASED: f64 = 0.25;
const RAISED: f64 = 8.0;
const LEAST_NU: f64 = 1e-8;
const MOST_NU: f64 = 1e14;
/// A step that leaves more than this of the residual gains nothing; after so many of them there is no more to gain.
const GAINS: f64 = 1.0 - 1e-6;
const MOST_STALLED: u32 = 12;
/// Steps below this, in rad or mechanism sizes, are round-off.
const LEAST_STEP: f64 = 1e-13;

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
    let mut search = Search::new(system, blocks, weight, guess, inputs);
    let iterations = search.run();
    search.closed(iterations, false)
}

/// As [`close`], and whether the position found is proven to be the one that the guess moves to.
pub fn close_proven(system: &System, blocks: &[&Block], guess: &[f64], inputs: &Inputs) -> Closed {
    let mut search = Search::new(system, blocks, 1.0, guess, inputs);
    let proof = search.proof();
    let iterations = search.run();
    let proven = proof.is_some_and(|certainty| search.is_within(certainty, guess));
    search.closed(iterations, proven)
}

/// Moves `guess` onto the constraints; whether it is proven that this is the only position at this place.
pub fn close_certified(
    system: &System,
    blocks: &[&Block],
    guess: &[f64],
    inputs: &Inputs,
) -> Closed {
    let mut search = Search::new(system, blocks, 1.0, guess, inputs);
    let iterations = search.run();
    let proven = search.certifies();
    search.closed(iterations, proven)
}

/// What became of one step.
enum Step {
    /// The damped matrix has no factors.
    Singular,
    /// Taken; whether the residual fell by more than round-off.
    Better { gains: bool },
    /// Not taken; its largest component, in rad or mechanism sizes.
    Worse { size: f64 },
}

/// A position on its way to the constraints.
struct Search<'a> {
    system: &'a System,
    inputs: &'a Inputs,
    rows: Rows<'a>,
    evaluation: Evaluation,
    q: Vec<f64>,
    /// Scaled residual at `q` (m), and its norm.
    phi: Vec<f64>,
    norm: f64,
    trial: Vec<f64>,
    trial_phi: Vec<f64>,
    /// Values of the matrix, and one cell that takes what belongs to ground.
    values: Vec<f64>,
    lu: SparseLu,
}

impl<'a> Search<'a> {
    fn new(
        system: &'a System,
        blocks: &'a [&'a Block],
        weight: f64,
        guess: &[f64],
        inputs: &'a Inputs,
    ) -> Self {
        let (rows, pattern) = layout(system, blocks, weight);
        let mut evaluation = Evaluation::new(system);
        let mut phi = vec![0.0; rows.m];
        let norm = residual(system, &rows, &mut evaluation, guess, inputs, &mut phi);
        Search {
            system,
            inputs,
            rows,
            evaluation,
            q: guess.to_vec(),
            trial: guess.to_vec(),
            trial_phi: phi.clone(),
            phi,
            norm,
            values: vec![0.0; pattern.entries() + 1],
            lu: SparseLu::new(pattern.clone(), ColumnOrder::amd(&pattern)),
        }
    }

    /// Steps until it is closed, or none leads closer; how many.
    fn run(&mut self) -> u64 {
        let (mut nu, mut stalled) = (1.0_f64, 0);
        let mut iterations = 0;
        let round_off = ROUND_OFF * self.system.scaled_norm(&self.q);
        let closed = round_off.clamp(CLOSED, 10.0 * CLOSED);
        while iterations < MAX_ITERATIONS
            && max_abs(&self.phi) > closed
            && nu < MOST_NU
            && stalled < MOST_STALLED
        {
            iterations += 1;
            match self.step(nu) {
                Step::Better { gains } => {
                    stalled = if gains { 0 } else { stalled + 1 };
                    nu = (nu * EASED).max(LEAST_NU);
                }
                // At the last digits no step improves the norm any more.
                Step::Worse { size } if size < LEAST_STEP => break,
                Step::Worse { .. } | Step::Singular => nu *= RAISED,
            }
        }
        iterations
    }

    /// What was found.
    fn closed(self, iterations: u64, proven: bool) -> Closed {
        let converged = max_abs(&self.phi) <= 100.0 * CLOSED;
        Closed {
            gaps: self.gaps(),
            converged,
            q: self.q,
            iterations,
            proven: proven && converged,
        }
    }

    /// Factors the matrix at q with a damping; whether it is regular.
    fn factor(&mut self, damping: f64) -> bool {
        let n = self.q.len();
        self.evaluation.set_position(&self.q);
        matrix(
            self.system,
            &self.rows,
            &self.evaluation,
            self.inputs,
            &mut self.values,
        );
        for (k, &slot) in self.rows.diagonal.iter().enumerate() {
            self.values[slot as usize] = if k < n { 1.0 } else { -damping };
        }
        let entries = self.values.len() - 1;
        self.lu.factor(&self.values[..entries]).is_ok()
    }

    /// One step with the damping ν |φ̃|², taken where it brings the residual down.
    fn step(&mut self, nu: f64) -> Step {
        let n = self.q.len();
        let damping = (nu * self.norm * self.norm).max(LEAST_DAMPING);
        if !self.factor(damping) {
            return Step::Singular;
        }
        let mut step: Vec<f64> = std::iter::repeat_n(0.0, n)
            .chain(self.phi.iter().map(|p| -p))
            .collect();
        self.lu.solve(&mut step);
        let size = max_abs(&step[..n]);
        let shorten = (LONGEST_STEP / size).min(1.0);
        for (k, trial) in self.trial.iter_mut().enumerate() {
            *trial = self.q[k] + shorten * step[k] * self.system.column_scale(k);
        }
        let norm = residual(
            self.system,
            &self.rows,
            &mut self.evaluation,
            &self.trial,
            self.inputs,
            &mut self.trial_phi,
        );
        if norm < self.norm {
            let gains = norm <= GAINS * self.norm;
            std::mem::swap(&mut self.q, &mut self.trial);
            std::mem::swap(&mut self.phi, &mut self.trial_phi);
            self.norm = norm;
            Step::Better { gains }
        } else {
            Step::Worse { size }
        }
    }

    /// Residual of each block, unweighed.
    fn gaps(&self) -> Vec<f64> {
        let rows = &self.rows;
        let of_block = |((&start, block), weight): ((&usize, &&Block), &f64)| {
            let phi = &self.phi[start..start + block.rows().len()];
            phi.iter().map(|p| p * p).sum::<f64>().sqrt() / weight
        };
        let blocks = rows.starts.iter().zip(rows.blocks).zip(&rows.weights);
        blocks.map(of_block).collect()
    }
}

fn layout<'a>(system: &System, blocks: &'a [&'a Block], weight: f64) -> (Rows<'a>, Pattern) {
    let n = system.n();
    let mut starts = Vec::with_capacity(blocks.len());
    let mut m = 0;
    for block in blocks {
        starts.push(m);
        m += block.rows().len();
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
            Origin::Joint(_) | Origin::Stop(_) => 1.0,
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
    let at = evaluation.kinematics(inputs);
    for ((block, &start), weight) in rows.blocks.iter().zip(&rows.starts).zip(&rows.weights) {
        let phi = &mut phi[start..start + block.rows().len()];
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
    let at = evaluation.kinematics(inputs);
    let mut buffer = Vec::new();
    let mut slots = rows.slots.iter();
    for (block, weight) in rows.blocks.iter().zip(&rows.weights) {
        let entries = block.constraint.entries();
        buffer.resize(entries.len(), 0.0);
        block.constraint.jacobian(&at, &mut buffer);
        for ((value, (row, _, axis)), slot) in buffer.iter().zip(entries).zip(&mut slots) {
            let column_scale = system.axis_scale(axis);
            let scaled =
                value * column_scale * weight / system.measure_scale(block.constraint.rows()[row]);
            values[slot[0] as usize] = scaled;
            values[slot[1] as usize] = scaled;
        }
    }
}
