//! C, an inverse of J₀ but for rounding, and what it leaves.

use super::slots::Slots;
use crate::system::System;

/// Of four coordinates, that go through sums together.
pub(super) type Four = [f64; 4];

/// What widens sums by more than their rounding.
pub(super) const WIDENED: f64 = 1.0 + 1e-12;

/// Parts of a product of J₀ are off by this much of it, before there are many.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Rows of C of the coordinates that are enclosed, and J₀ by its columns.
pub(super) struct Inverse {
    /// Four rows of C by columns (m), then the next four.
    pub rows: Vec<Four>,
    /// Number of rows of J.
    m: usize,
    /// Row of each entry of J₀, and its number among all, column by column.
    entries: Vec<[u32; 2]>,
    /// Where those of each column end (n).
    ends: Vec<u32>,
    /// Their values.
    values: Vec<f64>,
    /// How far the sum of a column's products is off by rounding, at most, as a part of the sum of their sizes.
    rounding: f64,
    /// Room for what a row's entries come to (m).
    sizes: Vec<f64>,
}

impl Inverse {
    /// With room for these coordinates.
    pub fn new(system: &System, slots: &Slots) -> Inverse {
        let mut columns: Vec<Vec<[u32; 2]>> = vec![Vec::new(); system.n()];
        for (index, entry) in system.entries.iter().enumerate() {
            if let Some(column) = entry.column() {
                columns[column as usize].push([entry.row, index as u32]);
            }
        }
        let longest = columns.iter().map(Vec::len).max().unwrap_or(0);
        let mut end = 0;
        let ends = columns.iter().map(|column| {
            end += column.len() as u32;
            end
        });
        Inverse {
            rows: vec![[0.0; 4]; slots.len() / 4 * system.m()],
            m: system.m(),
            ends: ends.collect(),
            values: vec![0.0; columns.iter().map(Vec::len).sum()],
            entries: columns.concat(),
            rounding: ROUNDING.max(longest as f64 * f64::EPSILON),
            sizes: vec![0.0; system.m()],
        }
    }

    /// Takes J₀ of the pose.
    pub fn take(&mut self, jacobian: &[f64]) {
        for (value, &[_, index]) in self.values.iter_mut().zip(&self.entries) {
            *value = jacobian[index as usize];
        }
    }

    /// For each four coordinates their rows of C.
    pub fn fours(&self) -> impl Iterator<Item = &[Four]> {
        self.rows.chunks_exact(self.m.max(1))
    }

    /// Row and value of the entries of each column of J₀.
    pub fn columns(&self) -> impl Iterator<Item = impl Iterator<Item = (usize, f64)>> {
        let mut begin = 0;
        self.ends.iter().map(move |&end| {
            let span = begin..end as usize;
            begin = span.end;
            let rows = self.entries[span.clone()].iter();
            let rows = rows.map(|&[row, _]| row as usize);
            rows.zip(self.values[span].iter().copied())
        })
    }

    /// Adds |C| rows to as many images as are asked for, each of its own kind of rows.
    pub fn add_images<const K: usize>(&self, rows: &[[f64; 2]], images: &mut [&mut [f64]; K]) {
        for (g, own) in self.fours().enumerate() {
            let mut sums = [[0.0; 4]; K];
            for (c, by) in own.iter().zip(rows) {
                for (sum, by) in sums.iter_mut().zip(by) {
                    for (sum, c) in sum.iter_mut().zip(c) {
                        *sum += c.abs() * by;
                    }
                }
            }
            for (image, sum) in images.iter_mut().zip(sums) {
                for (x, sum) in image[4 * g..][..4].iter_mut().zip(sum) {
                    *x += sum;
                }
            }
        }
    }

    /// Adds |I − C J₀| x and its rounding to both of two images.
    pub fn add_residual(&mut self, slots: &Slots, x: &[f64], images: [&mut [f64]; 2]) {
        let mut sizes = std::mem::take(&mut self.sizes);
        sizes.fill(0.0);
        for (column, slot) in self.columns().zip(&slots.of) {
            let x = self.rounding * x[*slot as usize];
            for (row, value) in column {
                sizes[row] += value.abs() * x;
            }
        }
        let [first, second] = images;
        for (g, own) in self.fours().enumerate() {
            let mut sum = [0.0; 4];
            for (c, size) in own.iter().zip(&sizes) {
                for (sum, c) in sum.iter_mut().zip(c) {
                    *sum += c.abs() * size;
                }
            }
            for (column, &slot) in self.columns().zip(&slots.of) {
                let mut left = [0.0; 4];
                if slot as usize / 4 == g {
                    left[slot as usize % 4] = 1.0;
                }
                for (row, value) in column {
                    for (left, c) in left.iter_mut().zip(&own[row]) {
                        *left -= c * value;
                    }
                }
                for (sum, left) in sum.iter_mut().zip(left) {
                    *sum += left.abs() * x[slot as usize];
                }
            }
            for image in [&mut *first, &mut *second] {
                for (x, sum) in image[4 * g..][..4].iter_mut().zip(sum) {
                    *x += sum * WIDENED;
                }
            }
        }
        self.sizes = sizes;
    }
}
