//! Velocities to start with: those that the constraints and the initial values allow, of least kinetic energy.
//!
//! ```text
//! ½ (v − v₀)ᵀ M (v − v₀) → min,   J v = −φ_t,   initial velocities as given
//!
//! | W   J̃ᵀ | | d |   |  0 |
//! | J̃  −εI | | y | = | r̃ |        repeated with the rest, so that ε is refined away
//! ```
//!
//! Lengths are scaled by the mechanism's size (tilde). Redundant rows do no harm; W is M, where masses are known.

use crate::element::{Constraint, Equations as _};
use crate::system::{Evaluation, Inputs, System};
use linkdyn_linear::lu::SparseLu;
use linkdyn_linear::math::max_abs;
use linkdyn_linear::order::ColumnOrder;
use linkdyn_linear::pattern::square;

/// ε: well above round-off, for with redundant rows it is what keeps the matrix regular.
const DAMPING: f64 = 1e-10;
/// Solutions until nothing is left of it: each leaves about ε of the one before.
const REFINEMENTS: usize = 4;
/// Weight of a coordinate without mass, relative to the heaviest: enough to keep the matrix regular.
const MASSLESS: f64 = 1e-6;

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
    let equations = VelocityEquations::new(system, q, inputs, with_initial);
    let mut v: Vec<f64> = match near {
        Some(near) => near
            .iter()
            .enumerate()
            .map(|(column, v)| v / system.column_scale(column))
            .collect(),
        None => vec![0.0; n],
    };
    let mut residual = equations.missing(&v);
    if let Some(mut lu) = equations.factors(&weights(system)) {
        for _ in 0..REFINEMENTS {
            let mut step: Vec<f64> = std::iter::repeat_n(0.0, n)
                .chain(residual.iter().copied())
                .collect();
            lu.solve(&mut step);
            v.iter_mut().zip(&step).for_each(|(v, d)| *v += d);
            residual = equations.missing(&v);
        }
    }
    v.iter_mut()
        .enumerate()
        .for_each(|(column, v)| *v *= system.column_scale(column));
    (v, residual)
}

/// What is prescribed of velocities besides the joints: scaled rows (n each) of drivers and initial velocities, and what they
/// are to be.
pub fn prescribed(system: &System, q: &[f64], inputs: &Inputs) -> (Vec<Vec<f64>>, Vec<f64>) {
    let VelocityEquations { rows, rhs } = VelocityEquations::new(system, q, inputs, true);
    let dense = |row: &Vec<(usize, f64)>| {
        let mut dense = vec![0.0; system.n()];
        row.iter()
            .for_each(|&(column, value)| dense[column] += value);
        dense
    };
    let joints = system.joint_rows();
    (
        rows[joints..].iter().map(dense).collect(),
        rhs[joints..].to_vec(),
    )
}

/// J̃ ṽ = r̃: rows of the system, then one per initial velocity.
struct VelocityEquations {
    rows: Vec<Vec<(usize, f64)>>,
    rhs: Vec<f64>,
}

impl VelocityEquations {
    fn new(system: &System, q: &[f64], inputs: &Inputs, with_initial: bool) -> Self {
        let mut evaluation = Evaluation::new(system);
        evaluation.set_position(q);
        evaluation.eval_jacobian(system, inputs);
        let mut rate = vec![0.0; system.m()];
        evaluation.eval_rate(system, inputs, &mut rate);
        let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); system.m()];
        let mut rhs: Vec<f64> = rate
            .iter()
            .enumerate()
            .map(|(row, r)| -r / system.row_scale(row))
            .collect();
        for (entry, value) in system.entries.iter().zip(&evaluation.jacobian) {
            if let Some(column) = entry.column() {
                let (row, column) = (entry.row as usize, column as usize);
                let scaled = value * system.column_scale(column) / system.row_scale(row);
                rows[row].push((column, scaled));
            }
        }
        let at = evaluation.kinematics(inputs);
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
        VelocityEquations { rows, rhs }
    }

    /// r̃ − J̃ ṽ.
    fn missing(&self, v: &[f64]) -> Vec<f64> {
        let product = |row: &Vec<(usize, f64)>| {
            row.iter()
                .map(|&(column, value)| value * v[column])
                .sum::<f64>()
        };
        self.rhs
            .iter()
            .zip(&self.rows)
            .map(|(rhs, row)| rhs - product(row))
            .collect()
    }

    /// Factors of the damped matrix with these weights (n); `None` if there are none.
    fn factors(&self, weights: &[f64]) -> Option<SparseLu> {
        let (n, m) = (weights.len(), self.rows.len());
        let mut entries: Vec<(usize, usize)> = (0..n + m).map(|k| (k, k)).collect();
        let mut values: Vec<f64> = weights
            .iter()
            .copied()
            .chain(std::iter::repeat_n(-DAMPING, m))
            .collect();
        for (row, row_entries) in self.rows.iter().enumerate() {
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
        let order = ColumnOrder::amd(&pattern);
        let mut lu = SparseLu::new(pattern, order);
        lu.factor(&stored).is_ok().then_some(lu)
    }
}

/// Weight of each scaled coordinate's velocity, the largest 1.
pub fn weights(system: &System) -> Vec<f64> {
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
    let largest = max_abs(&scaled);
    if largest > 0.0 {
        scaled.iter().map(|w| (w / largest).max(MASSLESS)).collect()
    } else {
        vec![1.0; system.n()]
    }
}
