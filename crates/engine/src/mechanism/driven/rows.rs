//! Which rows are independent, and where their entries go in the matrix.

use super::{Correction, Driven, Failure, Independent, Selection};
use crate::system::{Evaluation, Inputs, System};
use linkdyn_linear::lu::SparseLu;
use linkdyn_linear::order::ColumnOrder;
use linkdyn_linear::pattern::{Pattern, square};
use linkdyn_linear::redundancy::well_conditioned_rows;

/// Contraction of Newton from which other rows are tried.
const CONTRACTION: f64 = 0.1;
/// A row that is redundant takes the place of one that it holds more than this part of.
const OUTGROWN: f64 = 2.0;

impl Driven<'_> {
    pub(super) fn select(
        system: &System,
        independent: &[Independent],
        evaluation: &Evaluation,
    ) -> Result<Selection, Failure> {
        let n = system.n();
        let m = system.m() + independent.len();
        if m == n {
            return Ok(Selection {
                active: (0..n).collect(),
                redundant: Vec::new(),
            });
        }
        // Drivers and independent coordinates first: they are what moves the mechanism.
        let mut dense = system.dense_scaled(&evaluation.jacobian);
        dense.resize(m * n, 0.0);
        for (k, coordinate) in independent.iter().enumerate() {
            dense[(system.m() + k) * n + coordinate.column] = -1.0;
        }
        let first: Vec<usize> = (system.joint_rows()..m).collect();
        let mut active = well_conditioned_rows(&dense, m, n, &first);
        if active.len() < n {
            return Err(Failure::Singular);
        }
        active.sort_unstable();
        let redundant = (0..m)
            .filter(|row| active.binary_search(row).is_err())
            .collect();
        Ok(Selection { active, redundant })
    }

    /// Pattern of the active rows, slot of each system entry (the last cell for what has none), and the values with the
    /// independent coordinates' constant entries in place.
    pub(super) fn layout(
        system: &System,
        independent: &[Independent],
        selection: &Selection,
    ) -> (Pattern, Vec<u32>, Vec<f64>) {
        let mut entries = Vec::new();
        let mut owners = Vec::new();
        for (k, entry) in system.entries.iter().enumerate() {
            if let (Some(column), Ok(row)) = (
                entry.column(),
                selection.active.binary_search(&(entry.row as usize)),
            ) {
                entries.push((row, column as usize));
                owners.push(k);
            }
        }
        for (k, coordinate) in independent.iter().enumerate() {
            if let Ok(row) = selection.active.binary_search(&(system.m() + k)) {
                entries.push((row, coordinate.column));
            }
        }
        let (pattern, inner) = square(system.n(), &entries);
        let mut slots = vec![pattern.entries() as u32; system.entries.len()];
        for (&owner, &slot) in owners.iter().zip(&inner) {
            slots[owner] = slot;
        }
        let mut values = vec![0.0; pattern.entries() + 1];
        inner[owners.len()..]
            .iter()
            .for_each(|&slot| values[slot as usize] = -1.0);
        (pattern, slots, values)
    }

    pub(super) fn order(&mut self, pattern: &Pattern) -> Result<(), Failure> {
        let order = ColumnOrder::paired(pattern, &self.values[..self.nnz])
            .map_err(|_| Failure::Singular)?;
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
        let selection = Driven::select(self.system, &self.independent, &self.evaluation)?;
        if selection != self.selection {
            self.adopt(selection)
        } else {
            Ok(())
        }
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

    /// As [`Driven::correct`], with rows chosen anew at the guess where those at hand fail.
    ///
    /// # Errors
    /// See [`Failure`]; `q` is then wherever the iteration was.
    pub fn correct_by_any_rows(
        &mut self,
        q: &mut [f64],
        inputs: &Inputs,
    ) -> Result<Correction, Failure> {
        if !self.is_redundant() {
            return self.correct(q, inputs);
        }
        self.spare.copy_from_slice(q);
        let corrected = self.correct(q, inputs);
        if corrected.is_ok_and(|correction| correction.contraction <= CONTRACTION) {
            return corrected;
        }
        q.copy_from_slice(&self.spare);
        self.evaluation.set_position(q);
        self.evaluation.eval_jacobian(self.system, inputs);
        let selection = Driven::select(self.system, &self.independent, &self.evaluation)?;
        self.adopt(selection)?;
        self.correct(q, inputs)
    }

    /// Exchanges independent rows for redundant ones until none of those is more than twice one of these, with others
    /// added; at the position of the last factors.
    ///
    /// # Errors
    /// When fewer than n rows are independent there.
    pub fn exchange_rows(&mut self) -> Result<(), Failure> {
        for _ in 0..10 * (self.selection.redundant.len() + 1) {
            let Some((redundant, active)) = self.outgrown() else {
                break;
            };
            let mut selection = self.selection.clone();
            std::mem::swap(
                &mut selection.redundant[redundant],
                &mut selection.active[active],
            );
            selection.active.sort_unstable();
            selection.redundant.sort_unstable();
            self.adopt(selection)?;
        }
        Ok(())
    }

    /// Places of the redundant row that depends most on one active row, and of that, where it does so too much.
    fn outgrown(&mut self) -> Option<(usize, usize)> {
        let (system, m) = (self.system, self.system.m());
        let mut most: (f64, Option<(usize, usize)>) = (OUTGROWN, None);
        let (mut pull, mut shares) = (
            std::mem::take(&mut self.spare),
            std::mem::take(&mut self.work),
        );
        for (k, &row) in self.selection.redundant.iter().enumerate() {
            pull.fill(0.0);
            for (entry, value) in system.entries.iter().zip(&self.evaluation.jacobian) {
                if let (true, Some(column)) = (entry.row as usize == row, entry.column()) {
                    pull[column as usize] += value / system.row_scale(row);
                }
            }
            shares.copy_from_slice(&pull);
            system.scale_columns(&mut shares);
            self.lu.solve_transposed(&mut shares);
            for (at, share) in shares.iter().enumerate() {
                // Pins stay: nothing redundant depends on them but by round-off.
                if share.abs() > most.0 && self.selection.active[at] < m {
                    most = (share.abs(), Some((k, at)));
                }
            }
        }
        (self.spare, self.work) = (pull, shares);
        most.1
    }

    fn adopt(&mut self, selection: Selection) -> Result<(), Failure> {
        let (pattern, slots, values) = Driven::layout(self.system, &self.independent, &selection);
        self.revision += 1;
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
    pub fn choose(&mut self, columns: &[usize], inputs: &Inputs) -> Result<(), Failure> {
        for (coordinate, &column) in self.independent.iter_mut().zip(columns) {
            coordinate.column = column;
        }
        self.evaluation.eval_jacobian(self.system, inputs);
        let selection = Driven::select(self.system, &self.independent, &self.evaluation)?;
        self.adopt(selection)
    }

    /// Notes the scale of each entry.
    pub(super) fn scale_entries(&mut self) {
        self.scales.set_entries(self.system);
    }

    /// Notes the scales of the active rows, those of independent coordinates included.
    pub(super) fn scale_rows(&mut self) {
        let (system, independent) = (self.system, &self.independent);
        let measure = |&row: &usize| match row.checked_sub(system.m()) {
            Some(k) => system.column_measure(independent[k].column),
            None => system.measures[row],
        };
        let rows = self.selection.active.iter().map(measure);
        self.row_scales.set_rows(system, rows);
    }
}
