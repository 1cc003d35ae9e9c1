//! A fully driven mechanism at one instant: positions by Newton, velocities, accelerations and multipliers from the same
//! factors.
//!
//! ```text
//! position       J_A Δq = −φ_A                     (repeated)
//! velocity       J_A v  = −φ_t
//! acceleration   J_A a  = γ
//! multipliers    J_Aᵀ g = Q − M a ;   λ of least norm when constraints are redundant
//! ```
//!
//! A is a set of n independent rows. Without redundancy it is all rows; else J_R = C J_A for the others, every multiplier
//! vector with λ_A + Cᵀ λ_R = g is in equilibrium, and the one of least Euclidean norm (SI units) has
//! (I + C Cᵀ) λ_R = C g.
//!
//! All matrices are scaled, lengths by the mechanism's size, so that pivots mean the same for every model.
//!
//! A mechanism with freedom left is driven by **pins**: chosen coordinates that are given values, velocities and
//! accelerations. Pin k adds the row m + k, φ = u_k − q_c, so its multiplier is the effort that holds the coordinate.

use super::lu::{Singular, SparseLu};
use super::order::ColumnOrder;
use super::pattern::{Pattern, square};
use super::reactive::ReactiveForces;
use super::redundancy::well_conditioned_rows;
use crate::math::max_abs;
use crate::system::{Evaluation, Inputs, System};

/// Work done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    pub newton_iterations: u64,
    pub evaluations: u64,
    pub factorisations: u64,
}

/// How a position solve went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correction {
    /// Largest step of the first iteration, scaled [–]: how far the guess was off.
    pub first_step: f64,
    /// Largest ratio of successive steps; 0 when one was enough.
    pub contraction: f64,
    /// Scaled residual over all rows [–].
    pub residual: f64,
    /// Largest step of the last iteration, scaled [–]: how far the factors' position is from the solution.
    pub last_step: f64,
}

/// Why there is no solution from a guess.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Failure {
    /// The Jacobian is singular.
    Singular,
    /// Newton does not converge; scaled residual.
    Diverged { residual: f64 },
    /// The independent constraints are met, the redundant ones are not.
    Inconsistent { residual: f64 },
    /// A force that depends on multipliers grows beyond all bounds with them (index into [`System::reactive`]).
    Locked { force: usize },
}

impl From<Singular> for Failure {
    fn from(_: Singular) -> Self {
        Failure::Singular
    }
}

/// A residual of this size (lengths by the mechanism's size) is round-off of evaluating φ: a few ulps of coordinates of
/// the order of the size.
const RESIDUAL_FLOOR: f64 = 4e-15;
/// After a Newton step of this size the next one, its square times the curvature, is below round-off.
pub const LAST_STEP: f64 = 1e-10;
/// Residual above which the redundant rows do not hold (they must, to round-off, when the independent ones do).
const INCONSISTENT: f64 = 1e-9;
const MAX_ITERATIONS: usize = 25;

/// A coordinate that is prescribed: value, velocity, acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pin {
    pub column: usize,
    pub jet: crate::motion::Jet,
}

/// n independent rows, and where their entries go.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Selection {
    active: Vec<usize>,
    redundant: Vec<usize>,
}

/// Solver for one driven mechanism.
pub struct Driven<'s> {
    pub system: &'s System,
    pub evaluation: Evaluation,
    pub pins: Vec<Pin>,
    selection: Selection,
    /// Scale of each active row (n).
    row_scales: Vec<f64>,
    /// Slot of each system entry in `values`; the last cell takes what belongs to ground or to a redundant row.
    slots: Vec<u32>,
    /// Scale of each system entry.
    scales: Vec<f64>,
    values: Vec<f64>,
    nnz: usize,
    lu: SparseLu,
    work: Vec<f64>,
    rows: Vec<f64>,
    /// Newton step after which no further one is made, scaled [–]; by default what leaves nothing above round-off.
    pub last_step: f64,
    pub done: Work,
    pub reactive: ReactiveForces,
}

impl<'s> Driven<'s> {
    /// A solver whose independent rows are chosen at `q`.
    ///
    /// # Errors
    /// When fewer than n rows are independent there.
    pub fn new(system: &'s System, q: &[f64], inputs: &Inputs) -> Result<Self, Failure> {
        Driven::pinned(system, &[], q, inputs)
    }

    /// A solver for a mechanism with the coordinates `columns` prescribed besides its drivers.
    ///
    /// # Errors
    /// When fewer than n rows are independent there.
    pub fn pinned(system: &'s System, columns: &[usize], q: &[f64], inputs: &Inputs) -> Result<Self, Failure> {
        let mut evaluation = Evaluation::new(system);
        evaluation.set_position(q);
        evaluation.eval_jacobian(system, inputs);
        let pins: Vec<Pin> = columns.iter().map(|&column| Pin { column, jet: [q[column], 0.0, 0.0] }).collect();
        let selection = Driven::select(system, &pins, &evaluation)?;
        let scales = system
            .entries
            .iter()
            .map(|e| e.column.map_or(0.0, |c| system.column_scale(c as usize) / system.row_scale(e.row as usize)))
            .collect();
        let (n, m) = (system.n(), system.m());
        let (pattern, slots, values) = Driven::layout(system, &pins, &selection);
        let nnz = pattern.entries();
        let rows = m + pins.len();
        let mut driven = Driven {
            system,
            evaluation,
            pins,
            selection,
            row_scales: Vec::with_capacity(n),
            slots,
            scales,
            values,
            nnz,
            lu: SparseLu::new(pattern.clone(), ColumnOrder::natural(n)),
            work: vec![0.0; n],
            rows: vec![0.0; rows],
            last_step: LAST_STEP,
            done: Work::default(),
            reactive: ReactiveForces::new(system, columns.len()),
        };
        driven.scale_rows();
        driven.scatter();
        driven.order(&pattern)?;
        Ok(driven)
    }

    fn select(system: &System, pins: &[Pin], evaluation: &Evaluation) -> Result<Selection, Failure> {
        let n = system.n();
        let m = system.m() + pins.len();
        if m == n {
            return Ok(Selection { active: (0..n).collect(), redundant: Vec::new() });
        }
        // Drivers and pins first: they are what moves the mechanism.
        let mut dense = system.dense_scaled(&evaluation.jacobian);
        dense.resize(m * n, 0.0);
        for (k, pin) in pins.iter().enumerate() {
            dense[(system.m() + k) * n + pin.column] = -1.0;
        }
        let first: Vec<usize> = (system.joint_rows()..m).collect();
        let mut active = well_conditioned_rows(&dense, m, n, &first);
        if active.len() < n {
            return Err(Failure::Singular);
        }
        active.sort_unstable();
        let redundant = (0..m).filter(|row| active.binary_search(row).is_err()).collect();
        Ok(Selection { active, redundant })
    }

    /// Pattern of the active rows, slot of each system entry (the last cell for what has none), and the values with the
    /// pins' constant entries in place.
    fn layout(system: &System, pins: &[Pin], selection: &Selection) -> (Pattern, Vec<u32>, Vec<f64>) {
        let mut entries = Vec::new();
        let mut owners = Vec::new();
        for (k, entry) in system.entries.iter().enumerate() {
            if let (Some(column), Ok(row)) = (entry.column, selection.active.binary_search(&(entry.row as usize))) {
                entries.push((row, column as usize));
                owners.push(k);
            }
        }
        for (k, pin) in pins.iter().enumerate() {
            if let Ok(row) = selection.active.binary_search(&(system.m() + k)) {
                entries.push((row, pin.column));
            }
        }
        let (pattern, inner) = square(system.n(), &entries);
        let mut slots = vec![pattern.entries() as u32; system.entries.len()];
        for (&owner, &slot) in owners.iter().zip(&inner) {
            slots[owner] = slot;
        }
        let mut values = vec![0.0; pattern.entries() + 1];
        inner[owners.len()..].iter().for_each(|&slot| values[slot as usize] = -1.0);
        (pattern, slots, values)
    }

    fn order(&mut self, pattern: &Pattern) -> Result<(), Failure> {
        let order = ColumnOrder::paired(pattern, &self.values[..self.nnz]).map_err(|_| Failure::Singular)?;
        self.lu = SparseLu::new(pattern.clone(), order);
        self.done.factorisations += 1;
        Ok(self.lu.factor(&self.values[..self.nnz])?)
    }

    /// Chooses independent rows anew at the position of the last solve; needed along a path only with redundancy.
    ///
    /// # Errors
    /// When fewer than n rows are independent there.
    pub fn reselect(&mut self, inputs: &Inputs) -> Result<(), Failure> {
        if self.selection.redundant.is_empty() {
            return Ok(());
        }
        self.evaluation.eval_jacobian(self.system, inputs);
        let selection = Driven::select(self.system, &self.pins, &self.evaluation)?;
        if selection != self.selection { self.adopt(selection) } else { Ok(()) }
    }

    /// With redundancy: chooses the rows for `q`, which may be anywhere on the path; so they depend on the position alone.
    ///
    /// # Errors
    /// When fewer than n rows are independent there.
    pub fn prepare(&mut self, q: &[f64], inputs: &Inputs) -> Result<(), Failure> {
        if !self.is_redundant() {
            return Ok(());
        }
        self.evaluation.set_position(q);
        self.reselect(inputs)
    }

    fn adopt(&mut self, selection: Selection) -> Result<(), Failure> {
        let (pattern, slots, values) = Driven::layout(self.system, &self.pins, &selection);
        self.nnz = pattern.entries();
        self.values = values;
        self.selection = selection;
        self.slots = slots;
        self.scale_rows();
        self.scatter();
        self.order(&pattern)
    }

    /// Prescribes other coordinates from now on, as many as before; rows are chosen anew at the position last taken.
    ///
    /// # Errors
    /// When fewer than n rows are independent there.
    pub fn pin(&mut self, columns: &[usize], inputs: &Inputs) -> Result<(), Failure> {
        for (pin, &column) in self.pins.iter_mut().zip(columns) {
            pin.column = column;
        }
        self.evaluation.eval_jacobian(self.system, inputs);
        let selection = Driven::select(self.system, &self.pins, &self.evaluation)?;
        self.adopt(selection)
    }

    /// Notes the scales of the active rows, pins included.
    fn scale_rows(&mut self) {
        let (system, pins) = (self.system, &self.pins);
        let scale = |&row: &usize| match row.checked_sub(system.m()) {
            Some(pin) => system.column_scale(pins[pin].column),
            None => system.row_scale(row),
        };
        self.row_scales.clear();
        self.row_scales.extend(self.selection.active.iter().map(scale));
    }

    /// Whether some constraints are redundant.
    pub fn is_redundant(&self) -> bool {
        !self.selection.redundant.is_empty()
    }

    /// The independent rows.
    pub fn active_rows(&self) -> &[usize] {
        &self.selection.active
    }

    fn scatter(&mut self) {
        for ((&slot, &scale), &value) in self.slots.iter().zip(&self.scales).zip(&self.evaluation.jacobian) {
            self.values[slot as usize] = value * scale;
        }
    }

    /// J and its factors at the position last taken.
    ///
    /// # Errors
    /// [`Failure::Singular`].
    pub fn factor(&mut self, inputs: &Inputs) -> Result<(), Failure> {
        self.evaluation.eval_jacobian(self.system, inputs);
        self.scatter();
        self.done.factorisations += 1;
        Ok(self.lu.refactor(&self.values[..self.nnz])?)
    }

    /// x = S_q J̃_A⁻¹ S_φ⁻¹ rhs, where `rhs` is in `self.rows`; the result goes to `x`.
    fn solve_rows(&mut self, x: &mut [f64]) {
        for ((w, &row), scale) in x.iter_mut().zip(&self.selection.active).zip(&self.row_scales) {
            *w = self.rows[row] / scale;
        }
        self.lu.solve(x);
        self.system.scale_columns(x);
    }

    /// Moves `q` onto the constraints.
    ///
    /// # Errors
    /// See [`Failure`]; `q` is then wherever the iteration was.
    pub fn correct(&mut self, q: &mut [f64], inputs: &Inputs) -> Result<Correction, Failure> {
        let mut step = std::mem::take(&mut self.work);
        let result = self.iterate(q, inputs, &mut step);
        self.work = step;
        result
    }

    fn iterate(&mut self, q: &mut [f64], inputs: &Inputs, step: &mut [f64]) -> Result<Correction, Failure> {
        let (mut first, mut last, mut contraction) = (0.0, f64::INFINITY, 0.0_f64);
        for iteration in 0..MAX_ITERATIONS {
            self.evaluation.set_position(q);
            self.evaluation.eval_phi(self.system, inputs);
            self.done.evaluations += 1;
            let residual = self.active_residual(q);
            if !residual.is_finite() {
                break;
            }
            if iteration > 0 && (residual <= RESIDUAL_FLOOR || last <= self.last_step) {
                let residual = self.system.scaled_residual(&self.evaluation.phi);
                return if residual > INCONSISTENT {
                    Err(Failure::Inconsistent { residual })
                } else {
                    Ok(Correction { first_step: first, contraction, residual, last_step: last })
                };
            }
            self.factor(inputs)?;
            for (r, phi) in self.rows.iter_mut().zip(&self.evaluation.phi) {
                *r = -phi;
            }
            self.pin_rows(|pin| q[pin.column] - pin.jet[0]);
            self.solve_rows(step);
            self.done.newton_iterations += 1;
            let size = self.system.scaled_norm(step);
            if iteration == 0 {
                first = size;
            } else if size > self.last_step {
                contraction = contraction.max(size / last);
                // Newton that does not contract is lost, and would wander to another branch if it were let.
                if size > 2.0 * last || size.is_nan() {
                    break;
                }
            }
            last = size;
            q.iter_mut().zip(&*step).for_each(|(q, d)| *q += d);
        }
        Err(Failure::Diverged { residual: self.active_residual(q) })
    }

    /// Right-hand sides of the pins' rows.
    fn pin_rows(&mut self, value: impl Fn(&Pin) -> f64) {
        for (row, pin) in self.rows[self.system.m()..].iter_mut().zip(&self.pins) {
            *row = value(pin);
        }
    }

    fn active_residual(&self, q: &[f64]) -> f64 {
        let m = self.system.m();
        self.selection.active.iter().zip(&self.row_scales).fold(0.0, |largest: f64, (&row, scale)| {
            let phi = match row.checked_sub(m) {
                Some(pin) => self.pins[pin].jet[0] - q[self.pins[pin].column],
                None => self.evaluation.phi[row],
            };
            let r = phi.abs() / scale;
            if r > largest || r.is_nan() { r } else { largest }
        })
    }

    /// Velocities at the position last taken; [`Driven::factor`] must have been called there.
    pub fn velocity(&mut self, inputs: &Inputs, v: &mut [f64]) {
        let m = self.system.m();
        self.evaluation.eval_rate(self.system, inputs, &mut self.rows[..m]);
        self.rows.iter_mut().for_each(|r| *r = -*r);
        self.pin_rows(|pin| -pin.jet[1]);
        self.solve_rows(v);
        self.evaluation.set_velocity(v);
    }

    /// Accelerations at the position and velocity last taken.
    pub fn acceleration(&mut self, inputs: &Inputs, a: &mut [f64]) {
        let m = self.system.m();
        self.evaluation.eval_gamma(self.system, inputs, &mut self.rows[..m]);
        self.pin_rows(|pin| -pin.jet[2]);
        self.solve_rows(a);
    }

    /// ∂q/∂u_k (n): the motion that pin k alone makes, at the last factors.
    pub fn pin_motion(&mut self, k: usize, s: &mut [f64]) {
        self.rows.fill(0.0);
        self.rows[self.system.m() + k] = -1.0;
        self.solve_rows(s);
    }

    /// Multipliers λ (m) with Jᵀ λ = `b` (n), of least norm where not unique; those of pins are left out (they vanish in
    /// free motion).
    pub fn multipliers(&mut self, b: &[f64], lambda: &mut [f64]) {
        let mut g = std::mem::take(&mut self.work);
        self.solve_transposed(b, &mut g);
        lambda.fill(0.0);
        for (g, &row) in g.iter().zip(&self.selection.active) {
            if let Some(l) = lambda.get_mut(row) {
                *l = *g;
            }
        }
        self.work = g;
        if self.is_redundant() {
            let basis = self.self_stress();
            project_out(&basis, lambda);
        }
    }

    /// Multipliers λ (m) of a fully driven mechanism with Jᵀ λ = `balance` (n), together with the forces that depend on
    /// them, which are added to `force` and `balance`; at the position and velocity last taken and its factors.
    ///
    /// # Errors
    /// [`Failure::Locked`]; λ is then without these forces.
    pub fn react(
        &mut self,
        inputs: &Inputs,
        force: &mut [f64],
        balance: &mut [f64],
        lambda: &mut [f64],
    ) -> Result<(), Failure> {
        self.multipliers(balance, lambda);
        if self.system.reactive.is_empty() {
            return Ok(());
        }
        let mut reactive = std::mem::take(&mut self.reactive);
        reactive.eval_units(self.system, &self.evaluation, inputs);
        for (unit, response) in reactive.units_and_responses() {
            self.multipliers(unit, response);
        }
        let solved = reactive.solve(self.system, &self.evaluation, inputs, lambda);
        if solved.is_ok() {
            reactive.add_forces(force);
            reactive.add_forces(balance);
            reactive.add_responses(lambda);
        }
        self.reactive = reactive;
        solved
    }

    /// g (n) with J_Aᵀ g = b, unscaled.
    fn solve_transposed(&mut self, b: &[f64], g: &mut [f64]) {
        g.copy_from_slice(b);
        self.system.scale_columns(g);
        self.lu.solve_transposed(g);
        g.iter_mut().zip(&self.row_scales).for_each(|(g, scale)| *g /= scale);
    }

    /// Basis of the self-stresses, {z (m): Jᵀ z = 0}, one vector per redundant row, at the last factors.
    pub fn self_stress(&mut self) -> Vec<Vec<f64>> {
        let (n, m) = (self.system.n(), self.system.m());
        let mut basis = Vec::with_capacity(self.selection.redundant.len());
        for k in 0..self.selection.redundant.len() {
            let row = self.selection.redundant[k];
            let mut z = vec![0.0; m];
            z[row] = 1.0;
            let mut pull = vec![0.0; n];
            self.evaluation.transposed_product(self.system, &z, &mut pull);
            let mut g = vec![0.0; n];
            self.solve_transposed(&pull, &mut g);
            for (g, &active) in g.iter().zip(&self.selection.active) {
                if let Some(z) = z.get_mut(active) {
                    *z = -g;
                }
            }
            basis.push(z);
        }
        basis
    }

    /// Sign of det J̃_A at the last factors.
    pub fn determinant_sign(&self) -> f64 {
        self.lu.determinant().0
    }

    /// The smallest singular value with its right (n) and left (n, by active row) vectors at the last factors, by inverse
    /// iterations from the vectors given.
    pub fn smallest_singular(&mut self, iterations: usize, right: &mut [f64], left: &mut [f64]) -> f64 {
        self.lu.smallest_singular(iterations, right, left)
    }

    /// 1 / (rightᵀ J̃_A⁻¹ left): a smooth function of the position that vanishes where J does (Griewank and Reddien 1984).
    pub fn test_function(&mut self, right: &[f64], left: &[f64]) -> f64 {
        self.work.copy_from_slice(left);
        self.lu.solve(&mut self.work);
        1.0 / crate::math::dot(right, &self.work)
    }
}

/// λ minus its part in the span of `basis`: least norm among all λ that differ by self-stresses.
fn project_out(basis: &[Vec<f64>], lambda: &mut [f64]) {
    // Modified Gram–Schmidt, twice for orthogonality to round-off.
    let mut done: Vec<Vec<f64>> = Vec::with_capacity(basis.len());
    for z in basis {
        let mut z = z.clone();
        for _ in 0..2 {
            for e in &done {
                let along = crate::math::dot(e, &z);
                z.iter_mut().zip(e).for_each(|(z, e)| *z -= along * e);
            }
        }
        let norm = crate::math::dot(&z, &z).sqrt();
        if norm > 0.0 && max_abs(&z).is_finite() {
            z.iter_mut().for_each(|z| *z /= norm);
            done.push(z);
        }
    }
    for _ in 0..2 {
        for e in &done {
            let along = crate::math::dot(e, lambda);
            lambda.iter_mut().zip(e).for_each(|(l, e)| *l -= along * e);
        }
    }
}
