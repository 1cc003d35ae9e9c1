//! Triangular factors under construction, and the search that finds which rows a new column reaches.
//!
//! Solving L x = a for a sparse a touches the rows that can be reached from the entries of a along the entries of L:
//! row r, if it is the pivot of column k, leads to the rows of L(:, k). Visited depth first, the rows come out in an
//! order in which the elimination can go through them (Gilbert & Peierls 1988), in time proportional to the arithmetic.

/// Marks a row without pivot, or a column without partner.
pub(super) const NONE: u32 = u32::MAX;

/// An entry of a triangular factor: 12 bytes, where alignment would make them 16.
#[derive(Debug, Clone, Copy)]
#[repr(Rust, packed(4))]
pub(super) struct Entry {
    pub(super) row: u32,
    pub(super) value: f64,
}

/// A triangular factor by columns, without its diagonal.
#[derive(Debug, Clone)]
pub(super) struct Triangle {
    pub(super) start: Vec<u32>,
    pub(super) entries: Vec<Entry>,
}

impl Triangle {
    pub(super) fn new() -> Self {
        Triangle {
            start: vec![0],
            entries: Vec::new(),
        }
    }

    pub(super) fn column(&self, column: u32) -> &[Entry] {
        &self.entries
            [self.start[column as usize] as usize..self.start[column as usize + 1] as usize]
    }

    /// Gives back most of the room that it did not need.
    pub(super) fn shrink(&mut self) {
        let count = self.entries.len();
        self.entries.shrink_to(count + count / 8);
    }

    /// Empties it, for so many columns.
    pub(super) fn restart(&mut self, columns: usize) {
        self.entries.clear();
        self.start.truncate(1);
        self.start.reserve_exact(columns);
    }

    pub(super) fn close_column(&mut self) {
        self.start.push(self.entries.len() as u32);
    }

    pub(super) fn sort_columns(&mut self) {
        for span in self.start.windows(2) {
            self.entries[span[0] as usize..span[1] as usize]
                .sort_unstable_by_key(|entry| entry.row);
        }
    }
}

/// Depth first search through the columns of L.
#[derive(Debug, Clone)]
pub(super) struct Search {
    /// Step in which a row was last seen.
    mark: Vec<u32>,
    /// Path from the root: row, and next entry of its column of L.
    path: Vec<[u32; 2]>,
    /// Rows found, in post-order: a row stands after all it leads to.
    reach: Vec<u32>,
}

impl Search {
    pub(super) fn new(rows: usize) -> Self {
        Search {
            mark: vec![NONE; rows],
            path: Vec::with_capacity(rows),
            reach: Vec::with_capacity(rows),
        }
    }

    /// Forgets the steps seen.
    pub(super) fn restart(&mut self) {
        self.mark.fill(NONE);
        self.path.clear();
    }

    /// Four words per row, free between factorisations.
    pub(super) fn room(&mut self) -> [&mut [u32]; 4] {
        let n = self.mark.len();
        self.path.resize(n, [0; 2]);
        self.reach.resize(n, 0);
        let (one, two) = self.path.as_flattened_mut().split_at_mut(n);
        [&mut self.mark, &mut self.reach, one, two]
    }

    /// Rows found last, in post-order; the elimination walks them backwards.
    pub(super) fn reach(&self) -> &[u32] {
        &self.reach
    }

    /// One word per row, free between factorisations.
    pub(super) fn marks(&mut self) -> &mut [u32] {
        &mut self.mark
    }

    /// Finds all rows that eliminating a column with entries in `rows` can touch; `position` is the column of L a row
    /// is the pivot of.
    pub(super) fn find(&mut self, step: u32, rows: &[u32], position: &[u32], lower: &Triangle) {
        self.reach.clear();
        let first_child = |row: u32| match position[row as usize] {
            NONE => 0,
            k => lower.start[k as usize],
        };
        for &root in rows {
            if self.mark[root as usize] == step {
                continue;
            }
            self.mark[root as usize] = step;
            self.path.push([root, first_child(root)]);
            while let Some(top) = self.path.last_mut() {
                let k = position[top[0] as usize];
                if k == NONE || top[1] >= lower.start[k as usize + 1] {
                    self.reach.push(top[0]);
                    self.path.pop();
                    continue;
                }
                let child = lower.entries[top[1] as usize].row;
                top[1] += 1;
                if self.mark[child as usize] != step {
                    self.mark[child as usize] = step;
                    self.path.push([child, first_child(child)]);
                }
            }
        }
    }
}
