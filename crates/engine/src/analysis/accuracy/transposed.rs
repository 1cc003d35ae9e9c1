//! Products with Jᵀ, column by column.

use crate::system::System;

/// Where the entries of J stand that belong to coordinates, by column.
#[derive(Debug, Clone)]
pub(super) struct Transposed {
    /// Where each column begins, and where the last one ends (n + 1).
    begins: Vec<u32>,
    /// Row, and index among the entries of J.
    entries: Vec<[u32; 2]>,
}

impl Transposed {
    pub fn new(system: &System) -> Transposed {
        let mut columns = vec![Vec::new(); system.n()];
        for (index, entry) in system.entries.iter().enumerate() {
            if let Some(column) = entry.column() {
                columns[column as usize].push([entry.row, index as u32]);
            }
        }
        let mut transposed = Transposed {
            begins: vec![0],
            entries: Vec::new(),
        };
        for column in columns {
            transposed.entries.extend(column);
            transposed.begins.push(transposed.entries.len() as u32);
        }
        transposed
    }

    /// Subtracts Jᵀ λ (n).
    pub fn subtract(&self, jacobian: &[f64], lambda: &[f64], out: &mut [f64]) {
        for (out, ends) in out.iter_mut().zip(self.begins.windows(2)) {
            let mut sum = *out;
            for &[row, entry] in &self.entries[ends[0] as usize..ends[1] as usize] {
                sum -= jacobian[entry as usize] * lambda[row as usize];
            }
            *out = sum;
        }
    }
}
