//! Newton's linear systems of an implicit method, from one sparse matrix on a frozen pattern.
//!
//! With y = (u, u̇) the systems (s − J) (δu, δu̇) = (r₁, r₂) of a real or complex s say δu̇ = s δu − r₁ and s δu̇ − δü = r₂. Along the
//! tangents, δq = S δu, that is one saddle point system in all coordinates:
//!
//! ```text
//! [ s² M − s C − K   Jᵀ ] [ δq ]   [ M S (s r₁ + r₂) − C S r₁ ]       C = ∂Q/∂v,  K = ∂(Q − Jᵀλ)/∂q   (n, n)
//! [ J                0  ] [ δλ ] = [ 0                        ]       δu: the entries of δq in the independent columns
//! ```
//!
//! J are the active rows of joints and drivers. C and K are put together from blocks of elements: each force and contact gives
//! its own derivatives, each constraint ∂(Jᵀλ)/∂q at its multipliers (`element`). What is left out are terms of the curvature of
//! the constraints with velocities and accelerations, ∂(J v)/∂q against s and ∂(J a)/∂q against s²: in a step by h their part is
//! some h ω of the motion's own frequency ω, whatever is stiff, as is that of the change of J over the step, which a simplified Newton
//! iteration leaves out anyway. Of systems whose J is constant nothing is left out.
//!
//! Rows and columns are measured by their scales; M, C and K stand divided by |s|² and the largest mass.
//!
//! Source: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., Springer 1996, §IV.8 (elimination for
//! equations of second order), §VII.1 (mechanical systems).

use crate::mechanism::driven::Driven;
use crate::system::{Inputs, Slopes, System};
use linkdyn_linear::lu::{Complex, ComplexLu, SparseLu};
use linkdyn_linear::order::ColumnOrder;
use linkdyn_linear::pattern::{Pattern, square};
use std::sync::Arc;

/// One entry of M, C, K and J on the pattern, each in its own place of the sum.
#[derive(Debug, Clone, Copy, Default)]
struct Parts {
    mass: f64,
    damping: f64,
    stiffness: f64,
    jacobian: f64,
}

/// Where a derivative goes: its slot, the other side's, and by what scale.
#[derive(Debug, Clone, Copy)]
struct Place {
    slot: u32,
    mirrored: u32,
    scale: f64,
}

/// The matrix of a choice of rows, and its factors.
pub(super) struct Saddle {
    /// Which choice it is of.
    pub revision: u64,
    layout: Slopes,
    pattern: Arc<Pattern>,
    /// By slot, with a last cell for what has none.
    parts: Vec<Parts>,
    /// Where the entries of M, of J (and Jᵀ), of the forces' derivatives and of the constraints' are.
    inertia: Vec<(u32, f64)>,
    jacobian: Vec<[u32; 2]>,
    slopes: Vec<Place>,
    /// Rows and columns of C's entries, for products; the largest number for ground.
    damped: Vec<[u32; 2]>,
    bends: Vec<Place>,
    /// Their values.
    position: Vec<f64>,
    velocity: Vec<f64>,
    bent: Vec<f64>,
    has_damping: bool,
    /// The largest scaled mass.
    unit: f64,
    /// s, and the factors.
    real: f64,
    complex: Vec<Complex>,
    lu: Option<SparseLu>,
    complex_lu: Vec<ComplexLu>,
    values: Vec<f64>,
    complex_values: Vec<Complex>,
    /// Right-hand sides and solutions.
    work: Vec<f64>,
    complex_work: Vec<Complex>,
    /// S of one, two or four vectors (n each).
    motions: Vec<f64>,
}

/// Where entries stand while the pattern is laid out.
struct Entries {
    all: Vec<(usize, usize)>,
    /// By entry that is asked for: its index and the mirrored one's in `all`.
    owned: Vec<Option<[usize; 2]>>,
}

impl Entries {
    fn push(&mut self, row: Option<usize>, column: Option<usize>, mirrored: bool) {
        let place = row.zip(column).map(|(row, column)| {
            let at = self.all.len();
            self.all.push((row, column));
            if mirrored && row != column {
                self.all.push((column, row));
                [at, at + 1]
            } else {
                [at, usize::MAX]
            }
        });
        self.owned.push(place);
    }
}

impl Saddle {
    /// Of a mechanism, with its rows and independent coordinates of the moment.
    pub fn of(driven: &Driven) -> Self {
        let (system, n, m) = (driven.system, driven.system.n(), driven.system.m());
        let scale = |column: usize| system.column_scale(column);
        let rows = driven.active_rows().iter().filter(|row| **row < m);
        let rows: Vec<u32> = rows.map(|row| *row as u32).collect();
        let mut entries = Entries {
            all: Vec::new(),
            owned: Vec::new(),
        };
        let masses: Vec<(usize, usize, f64)> = system.mass.entries().collect();
        for (row, column, _) in &masses {
            entries.push(Some(*row), Some(*column), false);
        }
        for entry in &system.entries {
            let row = rows.binary_search(&entry.row).ok().map(|row| n + row);
            let column = entry.column.map(|column| column as usize);
            entries.push(row, column, true);
        }
        let layout = Slopes::of(system);
        let (slopes, bends) = (&layout.forces, &layout.bends);
        for [row, column] in slopes {
            entries.push(*row, *column, false);
        }
        for [row, column] in bends {
            entries.push(*row, *column, true);
        }
        let size = n + rows.len();
        let (pattern, slots) = square(size, &entries.all);
        let trash = pattern.entries() as u32;
        let slot = |at: usize| slots.get(at).copied().unwrap_or(trash);
        let places: Vec<[u32; 2]> = entries
            .owned
            .iter()
            .map(|owned| owned.map_or([trash; 2], |pair| pair.map(slot)))
            .collect();
        let (of_masses, rest) = places.split_at(masses.len());
        let (of_jacobian, rest) = rest.split_at(system.entries.len());
        let place = |(&[slot, mirrored], [row, column]): (&[u32; 2], &[Option<usize>; 2])| Place {
            slot,
            mirrored,
            scale: row.map_or(0.0, scale) * column.map_or(0.0, scale),
        };
        let scaled = masses.iter().map(|(i, j, m)| m * scale(*i) * scale(*j));
        let unit = scaled.clone().fold(0.0, f64::max);
        let unit = if unit > 0.0 { unit } else { 1.0 };
        let number = |column: Option<usize>| column.map_or(u32::MAX, |column| column as u32);
        Saddle {
            revision: driven.revision(),
            parts: vec![Parts::default(); trash as usize + 1],
            inertia: of_masses.iter().map(|[at, _]| *at).zip(scaled).collect(),
            jacobian: of_jacobian.to_vec(),
            slopes: rest.iter().zip(slopes).map(place).collect(),
            damped: slopes.iter().map(|pair| pair.map(number)).collect(),
            bends: rest[slopes.len()..].iter().zip(bends).map(place).collect(),
            position: vec![0.0; slopes.len()],
            velocity: vec![0.0; slopes.len()],
            bent: vec![0.0; bends.len()],
            has_damping: false,
            layout,
            unit,
            real: 0.0,
            complex: Vec::with_capacity(3),
            lu: None,
            complex_lu: vec![ComplexLu::default(); 3],
            values: vec![0.0; trash as usize],
            complex_values: vec![[0.0; 2]; trash as usize],
            pattern: Arc::new(pattern),
            work: vec![0.0; size],
            complex_work: vec![[0.0; 2]; size],
            motions: vec![0.0; 4 * n],
        }
    }

    /// Takes M, C, K and J at the position, velocity and Jacobian last taken, with these multipliers (m).
    pub fn take(&mut self, driven: &Driven, inputs: &Inputs, lambda: &[f64]) {
        let (system, evaluation) = (driven.system, &driven.evaluation);
        let by = (&mut self.position[..], &mut self.velocity[..]);
        self.layout
            .eval_forces(evaluation, (system, inputs), by.0, by.1);
        let bent = &mut self.bent;
        self.layout
            .eval_bends(evaluation, (system, inputs), lambda, bent);
        self.has_damping = self.velocity.iter().any(|c| *c != 0.0);
        self.parts.fill(Parts::default());
        for &(slot, m) in &self.inertia {
            self.parts[slot as usize].mass += m / self.unit;
        }
        let jacobian = evaluation.jacobian.iter().zip(driven.scales());
        for (&[row, column], (value, scale)) in self.jacobian.iter().zip(jacobian) {
            self.parts[row as usize].jacobian = value * scale;
            self.parts[column as usize].jacobian = value * scale;
        }
        let values = self.position.iter().zip(&self.velocity);
        for (place, (k, c)) in self.slopes.iter().zip(values) {
            let part = &mut self.parts[place.slot as usize];
            part.stiffness += k * place.scale / self.unit;
            part.damping += c * place.scale / self.unit;
        }
        for (place, value) in self.bends.iter().zip(&self.bent) {
            let value = value * place.scale / self.unit;
            self.parts[place.slot as usize].stiffness -= value;
            self.parts[place.mirrored as usize].stiffness -= value;
        }
    }

    /// Factors the matrix for a real s and complex ones; false where it can't.
    pub fn factor(&mut self, real: f64, complex: &[Complex]) -> bool {
        self.real = real;
        let over = 1.0 / (real * real);
        for (value, part) in self.values.iter_mut().zip(&self.parts) {
            let block = part.mass - part.damping / real - part.stiffness * over;
            *value = block + part.jacobian;
        }
        let lu = match &mut self.lu {
            Some(lu) => lu,
            None => {
                let Ok(order) = ColumnOrder::paired(&self.pattern, &self.values) else {
                    return false;
                };
                self.lu
                    .insert(SparseLu::new(Arc::clone(&self.pattern), order))
            }
        };
        if lu.refactor(&self.values).is_err() {
            return false;
        }
        // Those of higher orders, too: steps allocate nothing.
        let all = self.complex_lu.iter_mut();
        all.for_each(|factors| factors.reserve(lu));
        self.complex.clear();
        for (s, factors) in complex.iter().zip(&mut self.complex_lu) {
            let over = 1.0 / (s[0] * s[0] + s[1] * s[1]);
            let square = [(s[0] * s[0] - s[1] * s[1]) * over, 2.0 * s[0] * s[1] * over];
            for (value, part) in self.complex_values.iter_mut().zip(&self.parts) {
                let block = part.mass * square[0] - part.damping * s[0] * over;
                *value = [
                    block - part.stiffness * over + part.jacobian,
                    part.mass * square[1] - part.damping * s[1] * over,
                ];
            }
            if !factors.factor(lu, &self.complex_values) {
                return false;
            }
            self.complex.push(*s);
        }
        true
    }

    /// Overwrites (r₁, r₂) with (δu, δu̇), of the real s; `kept` are the factors of J_A that S comes from.
    pub fn solve(&mut self, driven: &mut Driven, kept: &mut SparseLu, b: &mut [f64]) {
        let (system, n) = (driven.system, driven.system.n());
        let (r1, r2) = b.split_at_mut(driven.independent.len());
        let s = self.real;
        let head = &mut self.work[..n];
        if self.has_damping {
            let motions = self.motions[..2 * n].as_chunks_mut::<2>().0;
            driven.follow(kept, |k| [s * r1[k] + r2[k], r1[k]], motions);
            let momenta = motions.iter().map(|motion| motion[0]);
            multiply(system, momenta, head);
            for (&[row, column], c) in self.damped.iter().zip(&self.velocity) {
                if row != u32::MAX && column != u32::MAX {
                    head[row as usize] -= c * motions[column as usize][1];
                }
            }
        } else {
            let motions = self.motions[..n].as_chunks_mut::<1>().0;
            driven.follow(kept, |k| [s * r1[k] + r2[k]], motions);
            multiply(system, motions.iter().map(|motion| motion[0]), head);
        }
        system.scale_columns(head);
        let by = 1.0 / (self.unit * s * s);
        head.iter_mut().for_each(|x| *x *= by);
        self.work[n..].fill(0.0);
        if let Some(lu) = &mut self.lu {
            lu.solve(&mut self.work);
        }
        let own = driven.independent.iter().zip(r1.iter_mut().zip(r2));
        for (coordinate, (r1, r2)) in own {
            let column = coordinate.column;
            let moved = self.work[column] * system.column_scale(column);
            (*r1, *r2) = (moved, s * moved - *r1);
        }
    }

    /// The same of a complex s; real and imaginary parts.
    pub fn solve_complex(
        &mut self,
        driven: &mut Driven,
        kept: &mut SparseLu,
        number: usize,
        [re, im]: [&mut [f64]; 2],
    ) {
        let (system, n, f) = (driven.system, driven.system.n(), driven.independent.len());
        let s = self.complex[number];
        let sum = |k: usize| {
            let r = [re[k], im[k]];
            [
                s[0] * r[0] - s[1] * r[1] + re[f + k],
                s[0] * r[1] + s[1] * r[0] + im[f + k],
            ]
        };
        let head = &mut self.complex_work[..n];
        let masses = system.mass.diagonal();
        if self.has_damping {
            let motions = self.motions[..4 * n].as_chunks_mut::<4>().0;
            let sides = |k: usize| [sum(k)[0], sum(k)[1], re[k], im[k]];
            driven.follow(kept, sides, motions);
            for ((to, motion), m) in head.iter_mut().zip(&*motions).zip(masses) {
                *to = [m * motion[0], m * motion[1]];
            }
            for (&[row, column], c) in self.damped.iter().zip(&self.velocity) {
                if row != u32::MAX && column != u32::MAX {
                    let motion = motions[column as usize];
                    head[row as usize][0] -= c * motion[2];
                    head[row as usize][1] -= c * motion[3];
                }
            }
        } else {
            let motions = self.motions[..2 * n].as_chunks_mut::<2>().0;
            driven.follow(kept, sum, motions);
            for ((to, motion), m) in head.iter_mut().zip(&*motions).zip(masses) {
                *to = [m * motion[0], m * motion[1]];
            }
        }
        let by = 1.0 / (self.unit * (s[0] * s[0] + s[1] * s[1]));
        for (column, x) in head.iter_mut().enumerate() {
            let by = by * system.column_scale(column);
            *x = [x[0] * by, x[1] * by];
        }
        self.complex_work[n..].fill([0.0; 2]);
        if let Some(lu) = &self.lu {
            self.complex_lu[number].solve(lu, &mut self.complex_work);
        }
        for (k, coordinate) in driven.independent.iter().enumerate() {
            let column = coordinate.column;
            let scale = system.column_scale(column);
            let moved = self.complex_work[column].map(|x| x * scale);
            let rates = [
                s[0] * moved[0] - s[1] * moved[1] - re[k],
                s[0] * moved[1] + s[1] * moved[0] - im[k],
            ];
            ([re[k], re[f + k]], [im[k], im[f + k]]) = ([moved[0], rates[0]], [moved[1], rates[1]]);
        }
    }
}

/// M x.
fn multiply(system: &System, x: impl Iterator<Item = f64>, to: &mut [f64]) {
    for ((to, x), m) in to.iter_mut().zip(x).zip(system.mass.diagonal()) {
        *to = m * x;
    }
}
