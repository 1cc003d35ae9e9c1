//! Accelerations with their multipliers, from one sparse matrix on a frozen pattern.
//!
//! ```text
//! [ M̃   J̃ᵀ ] [ ã ]   [ D Q/μ ]      M̃ = D M D/μ,  J̃ = R⁻¹ J D,  a = D ã
//! [ J̃   0  ] [ λ̃ ] = [ R⁻¹ γ ]      D, R: scales of coordinates and rows; μ: the largest entry of D M D
//! ```
//!
//! J are the rows of joints and drivers that are active, those of independent coordinates left out. Its entries are the
//! mechanism's own, so that nothing grows faster than the number of bodies but fill-in, of which chains and loops have little.
//! Where all that moves has mass, M is eliminated first (`nearest`).

use super::nearest::Nearest;
use super::sequence::Sequence;
use crate::mechanism::driven::{Driven, Failure};
use crate::mechanism::independent::EXCHANGE;
use crate::system::Inputs;
use linkdyn_linear::lu::SparseLu;
use linkdyn_linear::order::ColumnOrder;
use linkdyn_linear::pattern::{Pattern, square};
use std::sync::Arc;

/// Part of what exchanges a coordinate from which on a probe is looked into: one direction by chance may hide a little.
const PROBED: f64 = 0.75;

/// The matrix of a choice of rows, and its factors.
#[derive(Clone)]
pub(super) struct Sparse {
    /// Which choice it is of.
    revision: u64,
    /// Where the entries of M are, with their values.
    inertia: Vec<(u32, f64)>,
    /// Slots of each entry of J: in J and in Jᵀ; the last cell for what has none.
    slots: Vec<[u32; 2]>,
    values: Vec<f64>,
    pattern: Arc<Pattern>,
    /// None before the first factorisation, whose values say in which order to eliminate.
    lu: Option<SparseLu>,
    /// A smaller matrix that does as well, where all that moves has mass.
    nearest: Option<Nearest>,
    /// It is not wanted.
    is_whole: bool,
    /// Active rows of joints and drivers.
    rows: Vec<u32>,
    /// μ.
    unit: f64,
    /// γ (m).
    gamma: Vec<f64>,
    /// Multipliers of the last accelerations (m).
    lambda: Vec<f64>,
    /// The right-hand side, and the solution.
    work: Vec<f64>,
    /// J_A's factors at the last accepted point, and the choice of rows that they are of.
    kept: Option<SparseLu>,
    kept_revision: u64,
    probe: MotionProbe,
}

/// A cheap look for coordinates that move more than the independent ones: all of these at once, in directions by chance.
#[derive(Clone, Default)]
struct MotionProbe {
    motion: Vec<f64>,
    signs: u64,
    /// What moved most, and what did when none was found to be better.
    most: f64,
    calm: f64,
}

impl Sparse {
    /// Of a mechanism.
    pub fn of(driven: &Driven) -> Self {
        let (system, n) = (driven.system, driven.system.n());
        let scale = |column: usize| system.column_scale(column);
        let masses = system.mass.entries();
        let masses: Vec<_> = masses
            .map(|(i, j, m)| (i, j, m * scale(i) * scale(j)))
            .collect();
        let unit = masses.iter().fold(0.0, |most, (.., m)| f64::max(most, *m));
        let unit = if unit > 0.0 { unit } else { 1.0 };
        let m = system.m();
        let rows = driven.active_rows().iter().filter(|row| **row < m);
        let rows: Vec<u32> = rows.map(|row| *row as u32).collect();
        let mut entries: Vec<_> = masses.iter().map(|(i, j, _)| (*i, *j)).collect();
        let mut owners = Vec::new();
        for (owner, entry) in system.entries.iter().enumerate() {
            if let (Some(column), Ok(row)) = (entry.column(), rows.binary_search(&entry.row)) {
                let (row, column) = (n + row, column as usize);
                entries.extend([(row, column), (column, row)]);
                owners.push(owner);
            }
        }
        let size = n + rows.len();
        let (pattern, places) = square(size, &entries);
        let trash = pattern.entries() as u32;
        let mut slots = vec![[trash; 2]; system.entries.len()];
        let pairs = places[masses.len()..].as_chunks::<2>().0;
        for (&owner, pair) in owners.iter().zip(pairs) {
            slots[owner] = *pair;
        }
        let inertia = places.iter().zip(&masses);
        Sparse {
            revision: driven.revision(),
            inertia: inertia.map(|(slot, (.., m))| (*slot, m / unit)).collect(),
            slots,
            values: vec![0.0; pattern.entries() + 1],
            pattern: Arc::new(pattern),
            lu: None,
            nearest: Nearest::of(driven, &rows),
            is_whole: false,
            rows,
            unit,
            gamma: vec![0.0; m],
            lambda: vec![0.0; m],
            work: vec![0.0; size],
            kept: None,
            kept_revision: 0,
            probe: MotionProbe {
                motion: vec![0.0; n],
                ..MotionProbe::default()
            },
        }
    }

    /// a (n) under forces Q (n), at the position, the velocity and the Jacobian last taken.
    ///
    /// # Errors
    /// Where freedom has no mass.
    pub fn accelerate(
        &mut self,
        driven: &mut Driven,
        inputs: &Inputs,
        force: &[f64],
        a: &mut [f64],
    ) -> Result<(), Failure> {
        if self.revision != driven.revision() {
            let (kept, revision) = (self.kept.take(), self.kept_revision);
            let is_whole = self.is_whole;
            *self = Sparse::of(driven);
            (self.kept, self.kept_revision) = (kept, revision);
            if is_whole {
                self.take_whole();
            }
        }
        let system = driven.system;
        driven
            .evaluation
            .eval_gamma(system, inputs, &mut self.gamma);
        self.factor(driven)?;
        driven.done.factorisations += 1;
        self.solve(driven, force, true, a);
        let multipliers = self.rows.iter().zip(&self.work[a.len()..]);
        for (&row, multiplier) in multipliers {
            self.lambda[row as usize] = multiplier * self.unit / system.row_scale(row as usize);
        }
        Ok(())
    }

    /// Solves the whole matrix from now on, for those who want multipliers and factors.
    pub fn take_whole(&mut self) {
        self.is_whole = true;
        self.nearest = None;
    }

    /// Multipliers of the last accelerations (m), where the whole matrix is solved: those of the active rows, the others are zero.
    pub fn multipliers(&self) -> &[f64] {
        &self.lambda
    }

    /// J_A's factors at the last accepted point, where they are of the rows of the moment.
    pub fn kept(&mut self, driven: &Driven) -> Option<&mut SparseLu> {
        let is_current = self.kept_revision == driven.revision();
        let kept = self.kept.as_mut();
        kept.filter(|kept| is_current && kept.is_factored())
    }

    /// Keeps J_A's factors, for positions beside the point at hand.
    pub fn keep(&mut self, driven: &Driven) {
        driven.keep_factors(&mut self.kept);
        self.kept_revision = driven.revision();
    }

    /// Brings independent coordinates to their values, and the others along as they move at the accepted point, so that a position
    /// depends on nothing but that and them.
    pub fn slide(&mut self, driven: &mut Driven, q: &mut [f64]) {
        match &mut self.kept {
            Some(kept) if self.kept_revision == driven.revision() && kept.is_factored() => {
                driven.slide(kept, q);
            }
            Some(_) | None => {
                for coordinate in &driven.independent {
                    q[coordinate.column] = coordinate.jet[0];
                }
            }
        }
    }

    /// What a force or an impulse (n) changes, at the last factors.
    pub fn respond(&mut self, driven: &Driven, force: &[f64], change: &mut [f64]) {
        self.solve(driven, force, false, change);
    }

    fn factor(&mut self, driven: &Driven) -> Result<(), Failure> {
        if let Some(nearest) = &mut self.nearest
            && nearest.factor(driven)
        {
            return Ok(());
        }
        for &(slot, m) in &self.inertia {
            self.values[slot as usize] = m;
        }
        let jacobian = driven.evaluation.jacobian.iter().zip(driven.scales());
        for (&[row, column], (value, scale)) in self.slots.iter().zip(jacobian) {
            let value = value * scale;
            self.values[row as usize] = value;
            self.values[column as usize] = value;
        }
        let values = &self.values[..self.pattern.entries()];
        match &mut self.lu {
            Some(lu) => lu.refactor(values)?,
            None => {
                let order = ColumnOrder::paired(&self.pattern, values);
                let order = order.map_err(|_| Failure::Singular)?;
                let lu = self
                    .lu
                    .insert(SparseLu::new(Arc::clone(&self.pattern), order));
                lu.factor(values)?;
            }
        }
        Ok(())
    }

    /// x (n) of (force, γ) or (force, 0).
    fn solve(&mut self, driven: &Driven, force: &[f64], with_gamma: bool, x: &mut [f64]) {
        if let Some(nearest) = self.nearest.as_mut().filter(|nearest| nearest.is_sound) {
            let rows = self.rows.iter().map(|row| match with_gamma {
                true => self.gamma[*row as usize],
                false => 0.0,
            });
            return nearest.solve(force, rows, x);
        }
        let system = driven.system;
        let (head, tail) = self.work.split_at_mut(force.len());
        for (to, force) in head.iter_mut().zip(force) {
            *to = force / self.unit;
        }
        system.scale_columns(head);
        if with_gamma {
            for (to, &row) in tail.iter_mut().zip(&self.rows) {
                *to = self.gamma[row as usize] / system.row_scale(row as usize);
            }
        } else {
            tail.fill(0.0);
        }
        if let Some(lu) = &mut self.lu {
            lu.solve(&mut self.work);
        }
        x.copy_from_slice(&self.work[..force.len()]);
        system.scale_columns(x);
    }

    /// Whether a coordinate may move more than twice as much as an independent one that determines it, at the accepted point.
    pub fn may_be_better(&mut self, driven: &mut Driven, sequence: Option<&Sequence>) -> bool {
        let MotionProbe {
            motion,
            signs,
            calm,
            most,
        } = &mut self.probe;
        let is_current = self.kept_revision == driven.revision();
        let kept = self
            .kept
            .as_mut()
            .filter(|kept| is_current && kept.is_factored());
        let toss = || {
            *signs = signs
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            *signs >> 63 == 0
        };
        match (sequence.filter(|own| own.is_of(driven)), kept) {
            (Some(sequence), _) => sequence.spread(driven, toss, motion),
            (None, Some(kept)) => driven.spread(kept, toss, motion),
            (None, None) => return true,
        }
        *most = driven.system.scaled_norm(motion);
        *most > f64::max(PROBED * EXCHANGE, 2.0 * *calm)
    }

    /// Notes whether what was suspected was found.
    pub fn note(&mut self, found: bool) {
        self.probe.calm = if found { 0.0 } else { self.probe.most };
    }
}
