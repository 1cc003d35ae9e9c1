//! A mechanism whose constraints are linear in what moves: slides on the ground or on each other, and what is driven along them.
//!
//! ```text
//! q = q₀ + S (u − u₀),  v = S u̇ + v_t        J_R q_D = −(φ_R with the old q_D)       D: columns that move and are not independent
//! [M Jᵀ; J 0] (a, λ) = (Q, γ)                in columns that move and rows that do not hold (`system::standing`)
//! ```
//!
//! What stands is left out, so that of masses that slide beside each other only M is left. J_R is square and constant, and so is
//! the matrix of the accelerations: both are factored once for a choice of independent coordinates.

use crate::mechanism::driven::Driven;
use crate::system::{Inputs, Standing};
use linkdyn_linear::lu::SparseLu;
use linkdyn_linear::order::ColumnOrder;
use linkdyn_linear::pattern::square;

/// The matrices of a choice of rows and independent coordinates.
#[derive(Clone)]
pub(super) struct ConstantMatrices {
    /// Columns that move, and among these the place of each independent coordinate (f).
    moving: Vec<u32>,
    own: Vec<u32>,
    /// The others, with their places, and the rows that say what they are.
    dependent: Vec<[u32; 2]>,
    rows: Vec<u32>,
    /// J_R in the columns of independent coordinates: number of the row, of the coordinate, and entry by the row's scale.
    beside: Vec<(u32, u32, f64)>,
    /// J_R, where there is any.
    rest: Option<SparseLu>,
    /// [M Jᵀ; J 0].
    accelerations: SparseLu,
    /// Scales of columns that move, and 1/scale of the rows.
    scales: Vec<f64>,
    weights: Vec<f64>,
    /// The largest scaled mass.
    unit: f64,
    /// Right-hand sides: one of the accelerations, up to four of J_R.
    work: Vec<f64>,
    sides: Vec<f64>,
    /// Of all rows (m).
    all: Vec<f64>,
}

/// A matrix by its entries, factored; `None` if it is singular.
fn factored(size: usize, entries: &[(usize, usize, f64)]) -> Option<SparseLu> {
    let places: Vec<_> = entries
        .iter()
        .map(|(row, column, _)| (*row, *column))
        .collect();
    let (pattern, slots) = square(size, &places);
    let mut values = vec![0.0; pattern.entries()];
    for (slot, (.., value)) in slots.iter().zip(entries) {
        values[*slot as usize] += value;
    }
    let order = ColumnOrder::paired(&pattern, &values).ok()?;
    let mut lu = SparseLu::new(pattern, order);
    lu.factor(&values).ok()?;
    Some(lu)
}

impl ConstantMatrices {
    /// Of a mechanism at a position that satisfies its constraints, with J there; `None` if one of them bends.
    pub fn of(driven: &Driven, standing: &Standing) -> Option<Self> {
        let (system, moving) = (driven.system, standing.moving());
        let rows = standing.rest(driven.active_rows());
        if !rows.iter().all(|row| standing.is_linear(*row as usize)) {
            return None;
        }
        let place = |column: usize| moving.binary_search(&(column as u32)).ok();
        let own = driven
            .independent
            .iter()
            .map(|coordinate| place(coordinate.column));
        let own: Vec<usize> = own.collect::<Option<_>>()?;
        let mut number = vec![None; moving.len()];
        own.iter()
            .enumerate()
            .for_each(|(k, place)| number[*place] = Some(k));
        let dependent = number
            .iter()
            .zip(0..)
            .filter(|(number, _)| number.is_none());
        let dependent: Vec<u32> = dependent.map(|(_, place)| place).collect();
        if dependent.len() != rows.len() {
            return None;
        }
        let scales: Vec<f64> = moving
            .iter()
            .map(|c| system.column_scale(*c as usize))
            .collect();
        let masses = system.mass.entries().filter_map(|(row, column, m)| {
            let (row, column) = (place(row)?, place(column)?);
            Some((row, column, m * scales[row] * scales[column]))
        });
        let mut matrix: Vec<_> = masses.collect();
        let unit = matrix.iter().fold(0.0, |most, (.., m)| f64::max(most, *m));
        let unit = if unit > 0.0 { unit } else { 1.0 };
        matrix.iter_mut().for_each(|(.., m)| *m /= unit);
        let (mut beside, mut rest) = (Vec::new(), Vec::new());
        let values = driven.evaluation.jacobian.iter().zip(driven.scales());
        for (entry, (value, scale)) in system.entries.iter().zip(values) {
            let column = entry.column().and_then(|column| place(column as usize));
            let (Some(column), Ok(row)) = (column, rows.binary_search(&entry.row)) else {
                continue;
            };
            let scaled = value * scale;
            let below = moving.len() + row;
            matrix.extend([(below, column, scaled), (column, below, scaled)]);
            match (number[column], dependent.binary_search(&(column as u32))) {
                (None, Ok(other)) => rest.push((row, other, scaled)),
                (Some(k), _) => beside.push((row as u32, k as u32, scaled / scales[column])),
                (None, Err(_)) => {}
            }
        }
        let weights = rows.iter().map(|row| 1.0 / system.row_scale(*row as usize));
        let size = moving.len() + rows.len();
        Some(ConstantMatrices {
            rest: match dependent.is_empty() {
                true => None,
                false => Some(factored(rows.len(), &rest)?),
            },
            accelerations: factored(size, &matrix)?,
            own: own.iter().map(|place| *place as u32).collect(),
            work: vec![0.0; size],
            sides: vec![0.0; 4 * rows.len()],
            all: vec![0.0; system.m()],
            dependent: dependent
                .iter()
                .map(|at| [*at, moving[*at as usize]])
                .collect(),
            weights: weights.collect(),
            moving,
            rows,
            beside,
            scales,
            unit,
        })
    }

    /// K motions of the columns that move in which independent coordinate k has these rates.
    pub fn follow<const K: usize>(
        &mut self,
        rates: impl Fn(usize) -> [f64; K],
        motions: &mut [[f64; K]],
    ) {
        for (k, place) in self.own.iter().enumerate() {
            motions[*place as usize] = rates(k);
        }
        let Some(rest) = &mut self.rest else { return };
        let sides = self.sides[..K * self.rows.len()].as_chunks_mut::<K>().0;
        sides.fill([0.0; K]);
        for &(row, k, value) in &self.beside {
            let motion = motions[self.own[k as usize] as usize];
            let side = sides[row as usize].iter_mut().zip(motion);
            side.for_each(|(side, rate)| *side -= value * rate);
        }
        rest.solve_together(sides);
        for ([place, _], side) in self.dependent.iter().zip(sides) {
            motions[*place as usize] = side.map(|x| x * self.scales[*place as usize]);
        }
    }

    /// Brings the independent coordinates to their values and the others onto the constraints.
    pub fn place(&mut self, driven: &mut Driven, inputs: &Inputs, q: &mut [f64]) {
        for coordinate in &driven.independent {
            q[coordinate.column] = coordinate.jet[0];
        }
        if let Some(rest) = &mut self.rest {
            driven.evaluation.set_position(q);
            driven.evaluation.eval_phi(driven.system, inputs);
            let sides = &mut self.sides[..self.rows.len()];
            for ((side, row), weight) in sides.iter_mut().zip(&self.rows).zip(&self.weights) {
                *side = -driven.evaluation.phi[*row as usize] * weight;
            }
            rest.solve(sides);
            for ([place, column], side) in self.dependent.iter().zip(sides) {
                q[*column as usize] += *side * self.scales[*place as usize];
            }
        }
        driven.evaluation.set_position(q);
    }

    /// v (n), where the independent coordinates have their rates.
    pub fn velocity(&mut self, driven: &mut Driven, inputs: &Inputs, v: &mut [f64]) {
        v.fill(0.0);
        for coordinate in &driven.independent {
            v[coordinate.column] = coordinate.jet[1];
        }
        if let Some(rest) = &mut self.rest {
            driven
                .evaluation
                .eval_rate(driven.system, inputs, &mut self.all);
            let sides = &mut self.sides[..self.rows.len()];
            for ((side, row), weight) in sides.iter_mut().zip(&self.rows).zip(&self.weights) {
                *side = -self.all[*row as usize] * weight;
            }
            for &(row, k, value) in &self.beside {
                sides[row as usize] -= value * driven.independent[k as usize].jet[1];
            }
            rest.solve(sides);
            for ([place, column], side) in self.dependent.iter().zip(sides) {
                v[*column as usize] = *side * self.scales[*place as usize];
            }
        }
        driven.evaluation.set_velocity(v);
    }

    /// a (n) under forces Q (n).
    pub fn accelerate(&mut self, driven: &Driven, inputs: &Inputs, force: &[f64], a: &mut [f64]) {
        let (head, tail) = self.work.split_at_mut(self.moving.len());
        let by = 1.0 / self.unit;
        for ((to, column), scale) in head.iter_mut().zip(&self.moving).zip(&self.scales) {
            *to = force[*column as usize] * scale * by;
        }
        if !tail.is_empty() {
            let evaluation = &driven.evaluation;
            evaluation.eval_gamma(driven.system, inputs, &mut self.all);
            for ((to, row), weight) in tail.iter_mut().zip(&self.rows).zip(&self.weights) {
                *to = self.all[*row as usize] * weight;
            }
        }
        self.accelerations.solve(&mut self.work);
        a.fill(0.0);
        for ((column, scale), x) in self.moving.iter().zip(&self.scales).zip(&self.work) {
            a[*column as usize] = x * scale;
        }
    }
}
