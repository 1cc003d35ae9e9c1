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
//! Which rows are independent changes along a motion: of a doubled bar the row that says its length twice is another one
//! when it lies along x and when it lies along y. With C (redundant by active rows) the choice is good while no |C_ra| is
//! much larger than 1; where one is, rows r and a change places, which multiplies |det J_A| by |C_ra| (the volume of the
//! rows, Goreinov et al. 2010), so that exchanges come to an end.
//!
//! A mechanism with freedom left is driven by **independent coordinates**, which are given values, velocities and
//! accelerations. Coordinate k adds the row m + k, φ = u_k − q_c; its multiplier is the effort that holds it.

mod aside;
mod factors;
mod motions;
mod reactions;
mod rows;
mod scales;

use super::dependent_forces::DependentForces;
pub use super::failure::Failure;
use crate::system::{Evaluation, Inputs, System};
pub(crate) use aside::Aside;
use linkdyn_linear::lu::SparseLu;
use linkdyn_linear::order::ColumnOrder;
pub use motions::TOGETHER;
use scales::Scales;

/// Work done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Steps of Newton's iteration.
    pub newton_iterations: u64,
    /// Evaluations of φ.
    pub evaluations: u64,
    /// Factorisations of J.
    pub factorisations: u64,
}

impl Work {
    /// Counts more.
    pub(crate) fn add(&mut self, more: Work) {
        self.newton_iterations += more.newton_iterations;
        self.evaluations += more.evaluations;
        self.factorisations += more.factorisations;
    }
}

/// How a position solve went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correction {
    /// Largest step of the first iteration, scaled [–]: how far the guess was off.
    pub first_step: f64,
    /// Largest ratio of successive steps; 0 when one was enough.
    pub contraction: f64,
    /// Scaled residual over all rows [–]; where it is not measured, the square of the last step, by which it is bounded but for the
    /// curvature.
    pub residual: f64,
    /// Largest step of the last iteration, scaled [–]: how far the factors' position is from the solution.
    pub last_step: f64,
}

/// A residual of this size (lengths by the mechanism's size) is round-off of evaluating φ: a few ulps of coordinates of
/// the order of the size.
pub(super) const RESIDUAL_FLOOR: f64 = 4e-15;
/// After a Newton step of this size the next one, its square times the curvature, is below round-off.
pub const LAST_STEP: f64 = 1e-10;
/// Residual above which the redundant rows do not hold (they must, to round-off, when the independent ones do).
const INCONSISTENT: f64 = 1e-9;
const MAX_ITERATIONS: usize = 25;

/// A coordinate that is prescribed: value, velocity, acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Independent {
    /// Its column.
    pub column: usize,
    /// What it is given.
    pub jet: crate::motion::Jet,
}

/// n independent rows, and where their entries go.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Selection {
    active: Vec<usize>,
    redundant: Vec<usize>,
}

/// Solver for one driven mechanism.
#[derive(Clone)]
pub struct Driven<'s> {
    /// The mechanism.
    pub system: &'s System,
    /// The point at hand.
    pub evaluation: Evaluation,
    /// Coordinates that are prescribed besides its drivers.
    pub independent: Vec<Independent>,
    selection: Selection,
    /// How often rows or independent coordinates have changed.
    revision: u64,
    /// Scale of each active row (n).
    row_scales: Scales,
    /// Slot of each system entry in `values`; the last cell takes what belongs to ground or to a redundant row.
    slots: Vec<u32>,
    /// Scale of each system entry.
    scales: Scales,
    values: Vec<f64>,
    nnz: usize,
    lu: SparseLu,
    work: Vec<f64>,
    /// A row as a column, or a guess that is still needed; only with redundancy (n).
    spare: Vec<f64>,
    rows: Vec<f64>,
    /// Right-hand sides that are solved for together; none until there are several.
    together: Vec<f64>,
    /// Whether positions are corrected until their residual is known; else a last step is enough where no row is redundant.
    pub measures_residual: bool,
    /// Newton step after which no further one is made, scaled [–]; by default what leaves nothing above round-off.
    pub last_step: f64,
    /// Newton step after which the factors at hand serve once more, scaled \[–\]; none by default.
    pub chord: f64,
    /// Work since it was made.
    pub done: Work,
    /// Forces that depend on multipliers.
    pub dependent_forces: DependentForces,
}

impl<'s> Driven<'s> {
    /// A solver whose independent rows are chosen at `q`.
    ///
    /// # Errors
    /// When fewer than n rows are independent there.
    pub fn new(system: &'s System, q: &[f64], inputs: &Inputs) -> Result<Self, Failure> {
        Driven::with_independent(system, &[], q, inputs)
    }

    /// A solver for a mechanism with the coordinates `columns` prescribed besides its drivers.
    ///
    /// # Errors
    /// When fewer than n rows are independent there.
    pub fn with_independent(
        system: &'s System,
        columns: &[usize],
        q: &[f64],
        inputs: &Inputs,
    ) -> Result<Self, Failure> {
        let mut evaluation = Evaluation::new(system);
        evaluation.set_position(q);
        evaluation.eval_jacobian(system, inputs);
        let independent: Vec<Independent> = columns
            .iter()
            .map(|&column| Independent {
                column,
                jet: [q[column], 0.0, 0.0],
            })
            .collect();
        let selection = Driven::select(system, &independent, &evaluation)?;
        let (n, m) = (system.n(), system.m());
        let (pattern, slots, values) = Driven::layout(system, &independent, &selection);
        let nnz = pattern.entries();
        let rows = m + independent.len();
        let is_redundant = !selection.redundant.is_empty();
        let mut driven = Driven {
            system,
            evaluation,
            independent,
            selection,
            revision: 0,
            row_scales: Scales::default(),
            slots,
            scales: Scales::default(),
            values,
            nnz,
            lu: SparseLu::new(pattern.clone(), ColumnOrder::natural(n)),
            work: vec![0.0; n],
            spare: vec![0.0; if is_redundant { n } else { 0 }],
            rows: vec![0.0; rows],
            together: Vec::new(),
            measures_residual: true,
            last_step: LAST_STEP,
            chord: 0.0,
            done: Work::default(),
            dependent_forces: DependentForces::new(system),
        };
        driven.scale_entries();
        driven.scale_rows();
        driven.scatter();
        driven.order(&pattern)?;
        Ok(driven)
    }

    /// Whether some constraints are redundant.
    pub fn is_redundant(&self) -> bool {
        !self.selection.redundant.is_empty()
    }

    /// How often rows or independent coordinates have changed.
    pub(super) fn revision(&self) -> u64 {
        self.revision
    }

    /// Scale of each entry of J: that of its column by that of its row.
    pub(super) fn scales(&self) -> impl Iterator<Item = f64> {
        self.scales.iter()
    }

    /// The independent rows.
    pub fn active_rows(&self) -> &[usize] {
        &self.selection.active
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

    fn iterate(
        &mut self,
        q: &mut [f64],
        inputs: &Inputs,
        step: &mut [f64],
    ) -> Result<Correction, Failure> {
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
                    Ok(Correction {
                        first_step: first,
                        contraction,
                        residual,
                        last_step: last,
                    })
                };
            }
            if last > self.chord {
                self.refresh(inputs)?;
            }
            for (r, phi) in self.rows.iter_mut().zip(&self.evaluation.phi) {
                *r = -phi;
            }
            self.independent_rows(|coordinate| q[coordinate.column] - coordinate.jet[0]);
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
            if size <= self.last_step && !self.measures_residual && !self.is_redundant() {
                self.evaluation.set_position(q);
                return Ok(Correction {
                    first_step: first,
                    contraction,
                    residual: size * size,
                    last_step: size,
                });
            }
        }
        Err(Failure::Diverged {
            residual: self.active_residual(q),
        })
    }

    /// Prescribes values and velocities of the independent coordinates.
    pub(super) fn give(&mut self, values: &[f64], rates: &[f64]) {
        let given = values.iter().zip(rates);
        for (coordinate, (value, rate)) in self.independent.iter_mut().zip(given) {
            coordinate.jet = [*value, *rate, 0.0];
        }
    }

    /// Right-hand sides of the independent coordinates' rows.
    fn independent_rows(&mut self, mut value: impl FnMut(&Independent) -> f64) {
        for (row, coordinate) in self.rows[self.system.m()..]
            .iter_mut()
            .zip(&self.independent)
        {
            *row = value(coordinate);
        }
    }

    fn active_residual(&self, q: &[f64]) -> f64 {
        let m = self.system.m();
        let residuals = self.selection.active.iter().map(|&row| {
            let own = |k: usize| self.independent[k].jet[0] - q[self.independent[k].column];
            match row.checked_sub(m) {
                Some(k) => own(k),
                None => self.evaluation.phi[row],
            }
        });
        self.row_scales.largest(residuals)
    }

    /// Velocities at the position last taken; [`Driven::factor`] must have been called there.
    pub fn velocity(&mut self, inputs: &Inputs, v: &mut [f64]) {
        let m = self.system.m();
        self.evaluation
            .eval_rate(self.system, inputs, &mut self.rows[..m]);
        self.rows.iter_mut().for_each(|r| *r = -*r);
        self.independent_rows(|coordinate| -coordinate.jet[1]);
        self.solve_rows(v);
        self.evaluation.set_velocity(v);
    }

    /// Accelerations at the position and velocity last taken.
    pub fn acceleration(&mut self, inputs: &Inputs, a: &mut [f64]) {
        let m = self.system.m();
        self.evaluation
            .eval_gamma(self.system, inputs, &mut self.rows[..m]);
        self.independent_rows(|coordinate| -coordinate.jet[2]);
        self.solve_rows(a);
    }
}
