//! Dependent coordinates one after the other: open chains and trees of pins and welds whose angles are given.
//!
//! ```text
//! q_c ← q_c − φ_r / J_rc                    J_rc constant
//! v_c = −(φ_t,r + Σ_k J_rk v_k) / J_rc      k: independent coordinates, and those before c
//! ```
//!
//! Row r says what coordinate c is once those before it are known, and is linear in it with a constant entry, so that one step from
//! anywhere is exact: no matrix is factored, no residual looked at again, and there is no branch to miss. Of pins the centres of mass
//! are such coordinates, ever the next one from the ground on; of welds and drivers the angles before these.
//!
//! Coordinates come in rounds, for each of which φ is evaluated once: within a round a row's entries in those that moved before are
//! constant, too, and say what these have changed. Whether an entry is constant is told by where constraints bend
//! (`element::Constraint::bends`) and by what stands (`system::standing`): it is, where nothing that moves bends with its column. This
//! belongs to the choice of rows and independent coordinates. Loops, rails that turn, and lengths that are given have no such order
//! and go the general way.

use crate::mechanism::driven::Driven;
use crate::system::Inputs;

/// More rounds than these cost as much as Newton's iterations.
const MOST_ROUNDS: usize = 4;
/// A constant entry this much smaller than the largest of its row is round-off of a direction [–].
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// What a row says.
#[derive(Debug, Clone, Copy)]
struct RowTurn {
    row: u32,
    /// Of which coordinate.
    column: u32,
    /// −1/J_rc.
    over: f64,
    /// How many other entries it has, and how many of these are in coordinates of the same round.
    beside: u32,
    before: u32,
}

/// The order of a choice of rows and independent coordinates.
#[derive(Clone)]
pub(super) struct Sequence {
    /// Which choice it is of.
    revision: u64,
    turns: Vec<RowTurn>,
    /// How many turns each round has.
    rounds: Vec<u32>,
    /// Number in J and column of the rows' other entries, turn by turn.
    beside: Vec<[u32; 2]>,
    /// Column and value of those in coordinates of the same round.
    before: Vec<(u32, f64)>,
    /// J of the other entries at the last accepted point.
    kept: Vec<f64>,
    /// How far coordinates have moved (n), or φ_t (m).
    work: Vec<f64>,
}

/// An entry of J in a column that moves.
#[derive(Debug, Clone, Copy)]
struct ColumnEntry {
    number: u32,
    column: u32,
    value: f64,
    is_constant: bool,
}

impl Sequence {
    /// Of a mechanism at a position that satisfies its constraints, with J there; `None` if there is no such order.
    pub fn of(driven: &Driven) -> Option<Self> {
        let system = driven.system;
        let (n, m) = (system.n(), system.m());
        if driven.is_redundant() || m + driven.independent.len() != n {
            return None;
        }
        let mut order = Order::of(driven);
        let mut sequence = Sequence {
            revision: driven.revision(),
            turns: Vec::with_capacity(m),
            rounds: Vec::new(),
            beside: Vec::new(),
            before: Vec::new(),
            kept: Vec::new(),
            work: vec![0.0; n.max(m)],
        };
        while sequence.turns.len() < m {
            let count = order.round(&mut sequence);
            if count == 0 || sequence.rounds.len() == MOST_ROUNDS {
                return None;
            }
            sequence.rounds.push(count);
        }
        sequence.beside.shrink_to_fit();
        sequence.before.shrink_to_fit();
        sequence.kept = vec![0.0; sequence.beside.len()];
        Some(sequence)
    }

    /// Whether it is of the choice of the moment.
    pub fn is_of(&self, driven: &Driven) -> bool {
        self.revision == driven.revision()
    }

    /// Brings the independent coordinates to their values and the others onto the constraints.
    pub fn place(&mut self, driven: &mut Driven, inputs: &Inputs, q: &mut [f64]) {
        for coordinate in &driven.independent {
            q[coordinate.column] = coordinate.jet[0];
        }
        let (mut turns, mut before) = (self.turns.as_slice(), self.before.as_slice());
        for &count in &self.rounds {
            driven.evaluation.set_position(q);
            driven.evaluation.eval_phi(driven.system, inputs);
            let round;
            (round, turns) = turns.split_at(count as usize);
            for turn in round {
                let mut off = driven.evaluation.phi[turn.row as usize];
                let entries;
                (entries, before) = before.split_at(turn.before as usize);
                for (column, value) in entries {
                    off += value * self.work[*column as usize];
                }
                let moved = off * turn.over;
                self.work[turn.column as usize] = moved;
                q[turn.column as usize] += moved;
            }
        }
        driven.done.evaluations += self.rounds.len() as u64;
        driven.evaluation.set_position(q);
    }

    /// v (n) at the position and the Jacobian last taken, where the independent coordinates have their rates.
    pub fn velocity(&mut self, driven: &mut Driven, inputs: &Inputs, v: &mut [f64]) {
        for coordinate in &driven.independent {
            v[coordinate.column] = coordinate.jet[1];
        }
        let rates = &mut self.work[..driven.system.m()];
        driven.evaluation.eval_rate(driven.system, inputs, rates);
        let (jacobian, mut beside) = (&driven.evaluation.jacobian, self.beside.as_slice());
        for turn in &self.turns {
            let entries;
            (entries, beside) = beside.split_at(turn.beside as usize);
            let mut rate = rates[turn.row as usize];
            for &[number, column] in entries {
                rate += jacobian[number as usize] * v[column as usize];
            }
            v[turn.column as usize] = rate * turn.over;
        }
        driven.evaluation.set_velocity(v);
    }

    /// Keeps J at hand, for motions from there.
    pub fn keep(&mut self, driven: &Driven) {
        let jacobian = &driven.evaluation.jacobian;
        for (kept, [number, _]) in self.kept.iter_mut().zip(&self.beside) {
            *kept = jacobian[*number as usize];
        }
    }

    /// K motions (n) from the last accepted point in which independent coordinate k has these rates.
    pub fn follow<const K: usize>(
        &self,
        driven: &Driven,
        mut rates: impl FnMut(usize) -> [f64; K],
        motions: &mut [[f64; K]],
    ) {
        for (k, coordinate) in driven.independent.iter().enumerate() {
            motions[coordinate.column] = rates(k);
        }
        let mut beside = self.beside.iter().zip(&self.kept);
        for turn in &self.turns {
            let mut sum = [0.0; K];
            for ([_, column], value) in beside.by_ref().take(turn.beside as usize) {
                let motion = motions[*column as usize];
                let both = sum.iter_mut().zip(motion);
                both.for_each(|(sum, motion)| *sum += value * motion);
            }
            motions[turn.column as usize] = sum.map(|sum| sum * turn.over);
        }
    }

    /// The motion that all independent coordinates make together (n) from there, each by its scale to one side or the other.
    pub fn spread(
        &self,
        driven: &Driven,
        mut is_forward: impl FnMut() -> bool,
        motion: &mut [f64],
    ) {
        let scale = |k: usize| driven.system.column_scale(driven.independent[k].column);
        let rates = |k: usize| [if is_forward() { scale(k) } else { -scale(k) }];
        self.follow(driven, rates, motion.as_chunks_mut::<1>().0);
    }
}

/// Rows while their order is looked for.
struct Order {
    /// Entries by row.
    entries: Vec<Vec<ColumnEntry>>,
    /// Rows by column.
    rows: Vec<Vec<u32>>,
    /// By column, the round in which it has become known, counted from one; none of those that are not.
    known: Vec<Option<usize>>,
    /// By row, how many columns are not known.
    unknown: Vec<usize>,
}

impl Order {
    fn of(driven: &Driven) -> Self {
        let system = driven.system;
        let scaled: Vec<f64> = driven.scaled_entries().collect();
        let standing = driven.standing();
        let mut known = vec![None; system.n()];
        for coordinate in &driven.independent {
            known[coordinate.column] = Some(0);
        }
        let mut order = Order {
            entries: vec![Vec::new(); system.m()],
            rows: vec![Vec::new(); system.n()],
            unknown: vec![0; system.m()],
            known,
        };
        for block in &system.blocks {
            let bends = standing.bends(system, block);
            let own = block.entries();
            for number in own {
                let entry = system.entries[number];
                let Some(column) = entry.column() else {
                    continue;
                };
                let row = entry.row as usize;
                let bends = || bends.iter().any(|pair| pair.contains(&(column as usize)));
                order.entries[row].push(ColumnEntry {
                    number: number as u32,
                    column,
                    value: driven.evaluation.jacobian[number],
                    is_constant: block.constraint.is_linear(row - block.row()) || !bends(),
                });
            }
        }
        for (row, entries) in order.entries.iter_mut().enumerate() {
            let size = |entry: &ColumnEntry| scaled[entry.number as usize].abs();
            let largest = entries.iter().map(size).fold(0.0, f64::max);
            // What is constant and zero is so for good.
            entries.retain(|entry| !entry.is_constant || size(entry) > ROUND_OFF * largest);
            let mut columns: Vec<u32> = entries.iter().map(|entry| entry.column).collect();
            columns.sort_unstable();
            columns.dedup();
            for column in columns {
                order.rows[column as usize].push(row as u32);
                order.unknown[row] += usize::from(order.known[column as usize].is_none());
            }
        }
        order
    }

    /// Takes the turns of the next round; how many there are.
    fn round(&mut self, sequence: &mut Sequence) -> u32 {
        let round = sequence.rounds.len() + 1;
        let rows = 0..self.unknown.len() as u32;
        let mut ready: Vec<u32> = rows
            .filter(|row| self.unknown[*row as usize] == 1)
            .collect();
        let (mut next, mut count) = (0, 0);
        while let Some(&row) = ready.get(next) {
            next += 1;
            let Some(column) = self.take(row, round, sequence) else {
                continue;
            };
            count += 1;
            for &other in &self.rows[column as usize] {
                let unknown = &mut self.unknown[other as usize];
                *unknown -= 1;
                if *unknown == 1 {
                    ready.push(other);
                }
            }
        }
        count
    }

    /// The column that a row says, where it can in this round.
    fn take(&mut self, row: u32, round: usize, sequence: &mut Sequence) -> Option<u32> {
        let entries = &self.entries[row as usize];
        let is_unknown = |entry: &&ColumnEntry| self.known[entry.column as usize].is_none();
        let is_new = |entry: &&ColumnEntry| self.known[entry.column as usize] == Some(round);
        let column = entries.iter().find(is_unknown)?.column;
        let own = entries.iter().filter(|entry| entry.column == column);
        let others = || entries.iter().filter(|entry| entry.column != column);
        let mut fixed = own.clone().chain(others().filter(is_new));
        if !fixed.all(|entry| entry.is_constant) {
            return None;
        }
        let value: f64 = own.map(|entry| entry.value).sum();
        let before = others().filter(is_new);
        let before = before.map(|entry| (entry.column, entry.value));
        let begin = sequence.before.len();
        sequence.before.extend(before);
        sequence
            .beside
            .extend(others().map(|entry| [entry.number, entry.column]));
        sequence.turns.push(RowTurn {
            row,
            column,
            over: -1.0 / value,
            beside: others().count() as u32,
            before: (sequence.before.len() - begin) as u32,
        });
        self.known[column as usize] = Some(round);
        Some(column)
    }
}
