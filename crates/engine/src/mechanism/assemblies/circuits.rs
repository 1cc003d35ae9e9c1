//! Circuits: which assemblies are connected by motion, while one driver goes through its values.
//!
//! All rows but the driver's leave a curve in the space of coordinates. It is followed along its arc, so that dead centres, where the
//! driver turns back, are passed like all else:
//!
//! ```text
//! J′ t = 0, |t| = 1     tangent in scaled coordinates; J′: the rows without the driver's (n−1 × n)
//! q ← q + h t           prediction; Newton's iteration with [J′; tᵀ] corrects it
//! s = s(q)              what the driver measures; ds changes sign at a dead centre, det [J′; tᵀ] at a change point
//! ```
//!
//! (Allgower and Georg, Introduction to Numerical Continuation Methods, 2003, ch. 6.) A step is taken if the correction is small, converges
//! fast and the tangent hardly turns. Whenever s passes a value at which all assemblies are known, the curve is at one of these.

use super::{Assemblies, apart, same};
use crate::mechanism::closing::close;
use crate::system::{Block, DriverId, Evaluation, Inputs, System};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Longest and shortest step, in rad or mechanism sizes.
const LONGEST: f64 = 0.05;
const SHORTEST: f64 = 1e-8;
const MOST_STEPS: usize = 20_000;
/// Cosine between the tangents of two ends of a step, at least.
const STRAIGHT: f64 = 0.995;
/// First correction of a step, as part of the step, and the second, as part of the first.
const NEAR: f64 = 0.05;
const FASTER: f64 = 0.3;
/// Corrections below this are round-off.
const ROUND_OFF: f64 = 1e-13;
/// Halvings that locate a dead centre or change point.
const HALVINGS: usize = 40;

/// What happens to the driver at a point of a circuit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turning {
    /// The driver turns back: it can't go on.
    DeadCentre,
    /// Branches cross.
    ChangePoint,
    /// The values of the driver end.
    End,
    /// The mechanism can't be followed any further.
    Lost,
}

/// A point where a branch ends, or is crossed.
#[derive(Debug, Clone, PartialEq)]
pub struct TurningPoint {
    /// Which kind.
    pub kind: Turning,
    /// The driver's value there, counted on \[rad or m\].
    pub value: f64,
    /// The position (n).
    pub q: Vec<f64>,
}

/// A curve of positions that are connected by motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Circuit {
    /// The driver's value, counted on, and the position, along the curve.
    pub course: Vec<(f64, Vec<f64>)>,
    /// Dead centres, change points and ends, in the order of the course.
    pub turnings: Vec<TurningPoint>,
    /// The assemblies that belong to it: number of the driver's value, and of the assembly there.
    pub members: Vec<[usize; 2]>,
    /// Whether it comes back to its start.
    pub is_closed: bool,
}

/// The driver that goes through its values.
#[derive(Debug, Clone, Copy)]
pub struct DriverValues<'a> {
    /// Its number.
    pub driver: usize,
    /// Its values, rising \[rad or m\].
    pub values: &'a [f64],
    /// Whether they are a full turn, so that the first follows the last.
    pub is_turn: bool,
}

/// The circuits of a mechanism, of which `all` are the assemblies at each value of the driver. Assemblies that a circuit meets, and that
/// are missing, are added.
pub fn circuits(
    system: &System,
    blocks: &[&Block],
    inputs: &Inputs,
    driven: DriverValues,
    dependent: &[usize],
    all: &mut [Assemblies],
    stop: &dyn Fn() -> bool,
) -> Option<Vec<Circuit>> {
    let mut owner: Vec<Vec<bool>> = all.iter().map(|one| vec![false; one.found.len()]).collect();
    let mut found = Vec::new();
    for number in 0..all.len() {
        for index in 0..all[number].found.len() {
            if owner[number][index] || !all[number].found[index].is_proven {
                continue;
            }
            if stop() {
                return None;
            }
            let mut walk = CircuitWalk::new(system, blocks, inputs, driven, dependent);
            walk.held = all[number]
                .held
                .iter()
                .filter_map(|(body, axis)| system.layout.column(*body, *axis))
                .collect();
            let circuit = walk.circuit([number, index], all);
            for [number, index] in &circuit.members {
                let own = &mut owner[*number];
                if own.len() <= *index {
                    own.resize(*index + 1, false);
                }
                own[*index] = true;
            }
            found.push(circuit);
        }
    }
    Some(found)
}

/// A way along a circuit.
struct CircuitWalk<'a> {
    system: &'a System,
    blocks: &'a [&'a Block],
    inputs: Inputs,
    driven: DriverValues<'a>,
    dependent: &'a [usize],
    held: Vec<usize>,
    evaluation: Evaluation,
    /// Of the held coordinates.
    start: Vec<f64>,
}

/// A point of the curve.
#[derive(Clone)]
struct CircuitPoint {
    q: Vec<f64>,
    /// Scaled (n).
    tangent: DVector<f64>,
    /// The driver's value, counted on, and its change along the tangent.
    s: f64,
    rate: f64,
    sign: f64,
}

impl<'a> CircuitWalk<'a> {
    fn new(
        system: &'a System,
        blocks: &'a [&'a Block],
        inputs: &Inputs,
        driven: DriverValues<'a>,
        dependent: &'a [usize],
    ) -> Self {
        CircuitWalk {
            system,
            blocks,
            inputs: inputs.clone(),
            driven,
            dependent,
            held: Vec::new(),
            evaluation: Evaluation::new(system),
            start: Vec::new(),
        }
    }

    /// The circuit through an assembly.
    fn circuit(&mut self, start: [usize; 2], all: &mut [Assemblies]) -> Circuit {
        let [number, index] = start;
        let q = all[number].found[index].q.clone();
        self.start.clone_from(&q);
        let value = self.driven.values[number];
        let mut circuit = Circuit {
            course: vec![(value, q.clone())],
            turnings: Vec::new(),
            members: vec![start],
            is_closed: false,
        };
        let Some(first) = self.first(q, value) else {
            circuit.turnings.push(TurningPoint {
                kind: Turning::Lost,
                value,
                q: self.start.clone(),
            });
            return circuit;
        };
        let end = self.march(first.clone(), &mut circuit, all);
        if let Some(end) = end {
            circuit.turnings.push(end);
            // The other way, in front of this one.
            let mut back = Circuit {
                course: vec![],
                turnings: vec![],
                members: vec![],
                is_closed: false,
            };
            let other = CircuitPoint {
                tangent: -first.tangent,
                rate: -first.rate,
                sign: -first.sign,
                ..first
            };
            let end = self.march(other, &mut back, all);
            back.turnings.extend(end);
            back.course.reverse();
            back.turnings.reverse();
            back.members.reverse();
            back.course.append(&mut circuit.course);
            back.turnings.append(&mut circuit.turnings);
            back.members.append(&mut circuit.members);
            circuit = back;
        } else {
            circuit.is_closed = true;
        }
        circuit
    }

    fn first(&mut self, q: Vec<f64>, s: f64) -> Option<CircuitPoint> {
        let n = q.len();
        let matrix = self.matrix(&q);
        if matrix.nrows() + 1 != n {
            // Not one freedom: nothing was known of rows that depend on others.
            return None;
        }
        // The null vector by the smallest singular value.
        let mut square = DMatrix::zeros(n, n);
        square.rows_mut(0, n - 1).copy_from(&matrix);
        let tangent = square.svd(false, true).v_t?.row(n - 1).transpose();
        let mut point = CircuitPoint {
            tangent,
            s,
            rate: 0.0,
            sign: 0.0,
            q,
        };
        self.complete(&mut point)?;
        if point.rate < 0.0 {
            point.tangent = -point.tangent;
            self.complete(&mut point)?;
        }
        Some(point)
    }

    /// Goes on from a point until the start is there again; what ends it otherwise.
    fn march(
        &mut self,
        first: CircuitPoint,
        circuit: &mut Circuit,
        all: &mut [Assemblies],
    ) -> Option<TurningPoint> {
        let (start, forward) = (first.q.clone(), first.rate >= 0.0);
        let mut here = first;
        let mut h = 0.01;
        for _ in 0..MOST_STEPS {
            let Some(next) = self.step(&here, h) else {
                h *= 0.5;
                if h < SHORTEST {
                    return Some(self.turning(Turning::Lost, &here));
                }
                continue;
            };
            if here.rate * next.rate < 0.0 {
                let at = self.locate(&here, h, |point| point.rate);
                circuit
                    .turnings
                    .push(self.turning(Turning::DeadCentre, &at));
            }
            if here.sign * next.sign < 0.0 {
                let at = self.locate(&here, h, |point| point.sign);
                circuit
                    .turnings
                    .push(self.turning(Turning::ChangePoint, &at));
            }
            for (value, number) in self.passed(here.s, next.s) {
                let Some(q) = self.at_value(&here, &next, value) else {
                    continue;
                };
                let index = match all[number]
                    .found
                    .iter()
                    .position(|one| same(self.system, &one.q, &q))
                {
                    Some(index) => index,
                    None => {
                        all[number].found.push(super::Assembly {
                            q: q.clone(),
                            is_proven: false,
                        });
                        all[number].found.len() - 1
                    }
                };
                let is_back = (next.s >= here.s) == forward && circuit.course.len() > 2;
                if is_back && same(self.system, &start, &q) {
                    circuit.course.push((value, q));
                    return None;
                }
                if !circuit.members.contains(&[number, index]) {
                    circuit.members.push([number, index]);
                }
            }
            let [low, high] = self.ends();
            if !self.driven.is_turn && (next.s < low || next.s > high) {
                return Some(self.turning(Turning::End, &next));
            }
            circuit.course.push((next.s, next.q.clone()));
            let turn = here.tangent.dot(&next.tangent);
            h = (h * if turn > 0.999 { 1.5 } else { 1.0 }).min(LONGEST);
            here = next;
        }
        Some(self.turning(Turning::Lost, &here))
    }

    /// The least and the greatest value of the driver.
    fn ends(&self) -> [f64; 2] {
        let values = self.driven.values.iter().copied();
        [
            values.clone().fold(f64::INFINITY, f64::min),
            values.fold(f64::NEG_INFINITY, f64::max),
        ]
    }

    fn turning(&self, kind: Turning, at: &CircuitPoint) -> TurningPoint {
        TurningPoint {
            kind,
            value: at.s,
            q: at.q.clone(),
        }
    }

    /// Values of the driver between two, counted on, and their numbers.
    fn passed(&self, from: f64, to: f64) -> Vec<(f64, usize)> {
        let mut passed = Vec::new();
        for (number, value) in self.driven.values.iter().enumerate() {
            let turns = (to - value) / TAU;
            let turns = match (self.driven.is_turn, to >= from) {
                (false, _) => 0.0,
                (true, true) => turns.floor(),
                (true, false) => turns.ceil(),
            };
            let value = value + TAU * turns;
            // Half open, so that what stands on a value passes it once.
            let is_passed = match to >= from {
                true => value > from && value <= to,
                false => value < from && value >= to,
            };
            if is_passed {
                passed.push((value, number));
            }
        }
        passed.sort_by(|a, b| ((a.0 - from).abs()).total_cmp(&(b.0 - from).abs()));
        passed
    }

    /// The position where the driver has a value between two points.
    fn at_value(&mut self, from: &CircuitPoint, to: &CircuitPoint, value: f64) -> Option<Vec<f64>> {
        let part = (value - from.s) / (to.s - from.s);
        let between: Vec<f64> = from
            .q
            .iter()
            .zip(&to.q)
            .map(|(a, b)| a + part * (b - a))
            .collect();
        self.inputs.drive[self.driven.driver][0] = value;
        let closed = close(self.system, self.blocks, &between, &self.inputs);
        let near =
            apart(self.system, &closed.q, &between) <= apart(self.system, &from.q, &to.q) + 1e-9;
        (closed.converged && near).then_some(closed.q)
    }

    /// Where a function of the point changes its sign within a step.
    fn locate(
        &mut self,
        from: &CircuitPoint,
        h: f64,
        of: fn(&CircuitPoint) -> f64,
    ) -> CircuitPoint {
        let (mut low, mut high) = (0.0, h);
        let mut best = from.clone();
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let Some(point) = self.step(from, middle) else {
                break;
            };
            if of(from) * of(&point) > 0.0 {
                low = middle
            } else {
                high = middle
            }
            best = point;
        }
        best
    }

    /// A step of length h; `None` if it is too long.
    fn step(&mut self, from: &CircuitPoint, h: f64) -> Option<CircuitPoint> {
        let n = from.q.len();
        let mut q: Vec<f64> = (0..n)
            .map(|k| from.q[k] + h * from.tangent[k] * self.system.column_scale(k))
            .collect();
        let mut before = f64::INFINITY;
        let mut point = None;
        for iteration in 0..8 {
            let (matrix, phi) = (self.matrix(&q), self.residual(&q));
            let rows = matrix.nrows();
            let mut bordered = DMatrix::zeros(n, n);
            bordered.rows_mut(0, rows).copy_from(&matrix);
            bordered.row_mut(n - 1).copy_from(&from.tangent.transpose());
            let mut right = DVector::zeros(n);
            right.rows_mut(0, rows).copy_from(&-phi);
            let correction = bordered.lu().solve(&right)?;
            let size = correction.amax();
            if !size.is_finite()
                || (iteration == 0 && size > NEAR * h.max(1e-6))
                || (iteration == 1 && size > FASTER * before && size > ROUND_OFF)
            {
                return None;
            }
            for k in 0..n {
                q[k] += correction[k] * self.system.column_scale(k);
            }
            if size <= ROUND_OFF || (iteration > 1 && size >= before) {
                point = Some(());
                break;
            }
            before = size;
        }
        point?;
        let mut next = CircuitPoint {
            q,
            tangent: from.tangent.clone(),
            s: from.s,
            rate: 0.0,
            sign: 0.0,
        };
        self.complete(&mut next)?;
        (from.tangent.dot(&next.tangent) >= STRAIGHT).then_some(next)
    }

    /// Tangent, value, rate and sign of the determinant at a point whose tangent is nearly that of it.
    fn complete(&mut self, point: &mut CircuitPoint) -> Option<()> {
        let n = point.q.len();
        let matrix = self.matrix(&point.q);
        let mut bordered = DMatrix::zeros(n, n);
        bordered.rows_mut(0, matrix.nrows()).copy_from(&matrix);
        bordered
            .row_mut(n - 1)
            .copy_from(&point.tangent.transpose());
        let lu = bordered.lu();
        let mut unit = DVector::zeros(n);
        unit[n - 1] = 1.0;
        let tangent = lu.solve(&unit)?;
        point.tangent = &tangent / tangent.norm();
        point.sign = lu.determinant().signum();
        // φ of the driver's row is its value less what is measured.
        let row = self.system.driver_row(DriverId(self.driven.driver));
        let block = self.system.block_of_row(row);
        self.inputs.drive[self.driven.driver][0] = 0.0;
        self.evaluation.set_position(&point.q);
        let mut phi = [0.0];
        block
            .constraint
            .position(&self.evaluation.kinematics(&self.inputs), &mut phi);
        let measured = -phi[0];
        point.s = match self.driven.is_turn {
            true => point.s + (measured - point.s) - TAU * ((measured - point.s) / TAU).round(),
            false => measured,
        };
        self.evaluation.eval_jacobian(self.system, &self.inputs);
        let scale = self.system.measure_scale(block.constraint.rows()[0]);
        let own = self.system.entries.iter().zip(&self.evaluation.jacobian);
        let own = own.filter(|(entry, _)| entry.row as usize == row);
        let moved = own.filter_map(|(entry, value)| {
            let column = entry.column()? as usize;
            Some(value * self.system.column_scale(column) * point.tangent[column])
        });
        point.rate = -moved.sum::<f64>() / scale;
        Some(())
    }

    /// Rows that are followed: their numbers in the system.
    fn rows(&self) -> Vec<usize> {
        let own = self.system.driver_row(DriverId(self.driven.driver));
        (0..self.system.m())
            .filter(|row| *row != own && !self.dependent.contains(row))
            .collect()
    }

    /// J′, scaled.
    fn matrix(&mut self, q: &[f64]) -> DMatrix<f64> {
        self.evaluation.set_position(q);
        self.evaluation.eval_jacobian(self.system, &self.inputs);
        let rows = self.rows();
        let mut place = vec![usize::MAX; self.system.m()];
        rows.iter().enumerate().for_each(|(k, row)| place[*row] = k);
        let mut matrix = DMatrix::zeros(rows.len() + self.held.len(), q.len());
        for (entry, value) in self.system.entries.iter().zip(&self.evaluation.jacobian) {
            let (row, Some(column)) = (entry.row as usize, entry.column()) else {
                continue;
            };
            if place[row] != usize::MAX {
                matrix[(place[row], column as usize)] +=
                    self.system.scaled_entry(*value, row, column as usize);
            }
        }
        for (k, column) in self.held.iter().enumerate() {
            matrix[(rows.len() + k, *column)] = 1.0;
        }
        matrix
    }

    /// φ of the same rows, scaled.
    fn residual(&mut self, q: &[f64]) -> DVector<f64> {
        self.evaluation.set_position(q);
        let at = self.evaluation.kinematics(&self.inputs);
        let mut all = vec![0.0; self.system.m()];
        for block in &self.system.blocks {
            let range = block.rows();
            block.constraint.position(&at, &mut all[range.clone()]);
            for (phi, measure) in all[range].iter_mut().zip(block.constraint.rows()) {
                *phi /= self.system.measure_scale(*measure);
            }
        }
        let rows = self.rows();
        let own = rows.iter().map(|row| all[*row]);
        let held = self
            .held
            .iter()
            .map(|column| (q[*column] - self.start[*column]) / self.system.column_scale(*column));
        DVector::from_iterator(rows.len() + self.held.len(), own.chain(held))
    }
}
