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
//! J are the active rows of joints and drivers. What stands, and the rows that hold it, are left out (`system::standing`): of masses
//! on guides there is neither J nor λ. C and K are put together from blocks of elements: each force and contact gives
//! its own derivatives, each constraint ∂(Jᵀλ)/∂q at its multipliers (`element`). What is left out are terms of the curvature of
//! the constraints with velocities and accelerations, ∂(J v)/∂q against s and ∂(J a)/∂q against s²: in a step by h their part is
//! some h ω of the motion's own frequency ω, whatever is stiff, as is that of the change of J over the step, which a simplified Newton
//! iteration leaves out anyway. Of systems whose J is constant nothing is left out.
//!
//! Rows and columns are measured by their scales; M, C and K stand divided by |s|² and the largest mass.
//!
//! Source: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., Springer 1996, §IV.8 (elimination for
//! equations of second order), §VII.1 (mechanical systems).

mod entries;

use super::sequence::Sequence;
use super::straight::ConstantMatrices;
use crate::mechanism::driven::Driven;
use crate::system::{Inputs, Slopes, Standing};
use entries::Entries;
use linkdyn_linear::lu::{Complex, ComplexLu, SparseLu};
use linkdyn_linear::order::ColumnOrder;
use linkdyn_linear::pattern::{Pattern, square};
use std::sync::Arc;

/// One entry of M, C, K and J on the pattern, each in its own place of the sum.
#[derive(Debug, Clone, Copy, Default)]
struct SaddleParts {
    mass: f64,
    damping: f64,
    stiffness: f64,
    jacobian: f64,
}

/// Where a derivative goes: its slot, the other side's, and by what scale.
#[derive(Debug, Clone, Copy)]
struct EntryTarget {
    slot: u32,
    mirrored: u32,
    scale: f64,
}

/// The matrix of a choice of rows, and its factors.
#[derive(Clone)]
pub(super) struct Saddle {
    layout: Slopes,
    /// Columns that move (w), with their scales and masses, and the place of each independent coordinate among them (f).
    moving: Vec<u32>,
    scales: Vec<f64>,
    masses: Vec<f64>,
    own: Vec<u32>,
    pattern: Arc<Pattern>,
    /// By slot, with a last cell for what has none.
    parts: Vec<SaddleParts>,
    /// Where the entries of M, of J (and Jᵀ), of the forces' derivatives and of the constraints' are.
    inertia: Vec<(u32, f64)>,
    jacobian: Vec<[u32; 2]>,
    slopes: Vec<EntryTarget>,
    /// Places and number of C's entries, for products.
    damped: Vec<[u32; 3]>,
    bends: Vec<EntryTarget>,
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

/// What says how columns follow the independent coordinates: factors of J_A at the accepted point, rows that say them one after the
/// other there, or rows that do not bend.
pub(super) enum By<'a> {
    Factors(&'a mut SparseLu),
    Sequence(&'a Sequence),
    Straight(&'a mut ConstantMatrices),
}

impl By<'_> {
    /// K motions of the columns that move in which independent coordinate k has these rates, at the beginning of `motions` (n).
    fn follow<const K: usize>(
        self,
        (driven, moving): (&Driven, &[u32]),
        rates: impl Fn(usize) -> [f64; K],
        motions: &mut [[f64; K]],
    ) {
        match self {
            By::Straight(straight) => return straight.follow(rates, motions),
            By::Factors(factors) => driven.follow(factors, rates, motions),
            By::Sequence(sequence) => sequence.follow(driven, rates, motions),
        }
        for (place, column) in moving.iter().enumerate() {
            motions[place] = motions[*column as usize];
        }
    }
}

impl Saddle {
    /// Of a mechanism, with its rows and independent coordinates of the moment, and what stands.
    pub fn of(driven: &Driven, standing: &Standing) -> Self {
        let (system, n) = (driven.system, driven.system.n());
        let scale = |column: usize| system.column_scale(column);
        let (moving, rows) = (standing.moving(), standing.rest(driven.active_rows()));
        let mut places = vec![None; n];
        let numbered = moving.iter().enumerate();
        numbered.for_each(|(place, column)| places[*column as usize] = Some(place));
        let at = |column: Option<usize>| column.and_then(|column| places[column]);
        let masses: Vec<(usize, usize, f64)> = system.mass.entries().collect();
        let layout = Slopes::of(system);
        let (slopes, bends) = (&layout.forces, &layout.bends);
        let moves = (moving.len(), &places[..]);
        let entries = Entries::of((system, &layout), &masses, moves, &rows);
        let size = moving.len() + rows.len();
        let (pattern, slots) = square(size, &entries.all);
        let trash = pattern.entries() as u32;
        let slot = |at: usize| slots.get(at).copied().unwrap_or(trash);
        let found: Vec<[u32; 2]> = entries
            .owned
            .iter()
            .map(|owned| owned.map_or([trash; 2], |pair| pair.map(slot)))
            .collect();
        let (of_masses, rest) = found.split_at(masses.len());
        let (of_jacobian, rest) = rest.split_at(system.entries.len());
        let place =
            |(&[slot, mirrored], [row, column]): (&[u32; 2], &[Option<usize>; 2])| EntryTarget {
                slot,
                mirrored,
                scale: row.map_or(0.0, scale) * column.map_or(0.0, scale),
            };
        let scaled = masses.iter().map(|(i, j, m)| m * scale(*i) * scale(*j));
        let unit = scaled.clone().fold(0.0, f64::max);
        let unit = if unit > 0.0 { unit } else { 1.0 };
        let damped = slopes
            .iter()
            .zip(0..)
            .filter_map(|([row, column], number)| {
                Some([at(*row)? as u32, at(*column)? as u32, number])
            });
        let own = driven.independent.iter();
        let own = own.filter_map(|coordinate| places[coordinate.column]);
        let columns = || moving.iter().map(|column| *column as usize);
        Saddle {
            parts: vec![SaddleParts::default(); trash as usize + 1],
            inertia: of_masses.iter().map(|[at, _]| *at).zip(scaled).collect(),
            jacobian: of_jacobian.to_vec(),
            slopes: rest.iter().zip(slopes).map(place).collect(),
            damped: damped.collect(),
            own: own.map(|place| place as u32).collect(),
            scales: columns().map(scale).collect(),
            masses: columns()
                .map(|column| system.mass.diagonal()[column])
                .collect(),
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
            moving,
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
        self.parts.fill(SaddleParts::default());
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

    /// Overwrites (r₁, r₂) with (δu, δu̇), of the real s.
    pub fn solve(&mut self, driven: &Driven, by: By, b: &mut [f64]) {
        let (r1, r2) = b.split_at_mut(self.own.len());
        let (s, n) = (self.real, driven.system.n());
        let (head, tail) = self.work.split_at_mut(self.moving.len());
        let at = (driven, &self.moving[..]);
        if self.has_damping {
            let motions = self.motions[..2 * n].as_chunks_mut::<2>().0;
            by.follow(at, |k| [s * r1[k] + r2[k], r1[k]], motions);
            for ((to, motion), m) in head.iter_mut().zip(&*motions).zip(&self.masses) {
                *to = m * motion[0];
            }
            for &[row, column, number] in &self.damped {
                head[row as usize] -= self.velocity[number as usize] * motions[column as usize][1];
            }
        } else {
            let motions = self.motions[..n].as_chunks_mut::<1>().0;
            by.follow(at, |k| [s * r1[k] + r2[k]], motions);
            for ((to, motion), m) in head.iter_mut().zip(&*motions).zip(&self.masses) {
                *to = m * motion[0];
            }
        }
        let by = 1.0 / (self.unit * s * s);
        let scaled = head.iter_mut().zip(&self.scales);
        scaled.for_each(|(x, scale)| *x *= by * scale);
        tail.fill(0.0);
        if let Some(lu) = &mut self.lu {
            lu.solve(&mut self.work);
        }
        for (place, (r1, r2)) in self.own.iter().zip(r1.iter_mut().zip(r2)) {
            let moved = self.work[*place as usize] * self.scales[*place as usize];
            (*r1, *r2) = (moved, s * moved - *r1);
        }
    }

    /// The same of a complex s; real and imaginary parts.
    pub fn solve_complex(
        &mut self,
        driven: &Driven,
        by: By,
        number: usize,
        [re, im]: [&mut [f64]; 2],
    ) {
        let n = driven.system.n();
        let ((re1, re2), (im1, im2)) = (
            re.split_at_mut(self.own.len()),
            im.split_at_mut(self.own.len()),
        );
        let s = self.complex[number];
        let sum = |k: usize| {
            [
                s[0] * re1[k] - s[1] * im1[k] + re2[k],
                s[0] * im1[k] + s[1] * re1[k] + im2[k],
            ]
        };
        let (head, tail) = self.complex_work.split_at_mut(self.moving.len());
        let at = (driven, &self.moving[..]);
        if self.has_damping {
            let motions = self.motions[..4 * n].as_chunks_mut::<4>().0;
            by.follow(at, |k| [sum(k)[0], sum(k)[1], re1[k], im1[k]], motions);
            for ((to, motion), m) in head.iter_mut().zip(&*motions).zip(&self.masses) {
                *to = [m * motion[0], m * motion[1]];
            }
            for &[row, column, number] in &self.damped {
                let (c, motion) = (self.velocity[number as usize], motions[column as usize]);
                head[row as usize][0] -= c * motion[2];
                head[row as usize][1] -= c * motion[3];
            }
        } else {
            let motions = self.motions[..2 * n].as_chunks_mut::<2>().0;
            by.follow(at, sum, motions);
            for ((to, motion), m) in head.iter_mut().zip(&*motions).zip(&self.masses) {
                *to = [m * motion[0], m * motion[1]];
            }
        }
        let by = 1.0 / (self.unit * (s[0] * s[0] + s[1] * s[1]));
        for (x, scale) in head.iter_mut().zip(&self.scales) {
            *x = x.map(|x| x * (by * scale));
        }
        tail.fill([0.0; 2]);
        if let Some(lu) = &self.lu {
            self.complex_lu[number].solve(lu, &mut self.complex_work);
        }
        let re = re1.iter_mut().zip(re2);
        let im = im1.iter_mut().zip(im2);
        for ((place, (re1, re2)), (im1, im2)) in self.own.iter().zip(re).zip(im) {
            let scale = self.scales[*place as usize];
            let moved = self.complex_work[*place as usize].map(|x| x * scale);
            *re2 = s[0] * moved[0] - s[1] * moved[1] - *re1;
            *im2 = s[0] * moved[1] + s[1] * moved[0] - *im1;
            [*re1, *im1] = moved;
        }
    }
}
