//! The rows of a chunk in memory.

use indexmap::IndexSet;

/// The one NaN that is written, so that bytes do not depend on how it came about.
const NONE: f64 = f64::from_bits(0x7FF8_0000_0000_0000);

/// Consecutive variants with their status, inputs and responses.
#[derive(Debug, Clone)]
pub struct Rows {
    from: u64,
    inputs: usize,
    responses: usize,
    reasons: IndexSet<String>,
    status: Vec<u32>,
    values: Vec<f64>,
}

/// One variant.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a> {
    /// Its number, counted from 0.
    pub variant: u64,
    /// Why it has no result; `None` if all went well.
    pub reason: Option<&'a str>,
    /// What was varied.
    pub inputs: &'a [f64],
    /// What came out; NaN where there is none.
    pub responses: &'a [f64],
}

impl Rows {
    /// No rows yet, the first of which will be variant `from`.
    pub fn new(from: u64, inputs: usize, responses: usize) -> Self {
        Rows {
            from,
            inputs,
            responses,
            reasons: IndexSet::new(),
            status: Vec::new(),
            values: Vec::new(),
        }
    }

    /// Appends the next variant; responses that are missing do not exist.
    pub fn push(&mut self, reason: Option<&str>, inputs: &[f64], responses: &[f64]) {
        let status = reason.map_or(0, |reason| match self.reasons.get_index_of(reason) {
            Some(known) => known as u32 + 1,
            None => self.reasons.insert_full(reason.to_string()).0 as u32 + 1,
        });
        self.push_row(status, inputs, responses);
    }

    fn push_row(&mut self, status: u32, inputs: &[f64], responses: &[f64]) {
        let of = |values: &[f64], place: usize| match values.get(place) {
            Some(x) if !x.is_nan() => *x,
            Some(_) | None => NONE,
        };
        self.status.push(status);
        self.values
            .extend((0..self.inputs).map(|place| of(inputs, place)));
        self.values
            .extend((0..self.responses).map(|place| of(responses, place)));
    }

    /// Takes reasons and rows as they stand in a file; false where they do not fit together.
    pub(super) fn fill(&mut self, reasons: Vec<String>, rows: &[u8]) -> bool {
        let width = self.row_bytes();
        let count = reasons.len();
        self.reasons = reasons.into_iter().collect();
        let mut values = vec![0.0; self.columns()];
        for row in rows.chunks_exact(width) {
            let (status, rest) = row.split_at(4);
            let status = status
                .iter()
                .rev()
                .fold(0, |sum, &byte| sum << 8 | u32::from(byte));
            for (value, bytes) in values.iter_mut().zip(rest.chunks_exact(8)) {
                let bits = bytes
                    .iter()
                    .rev()
                    .fold(0, |sum, &byte| sum << 8 | u64::from(byte));
                *value = f64::from_bits(bits);
            }
            if status as usize > count {
                return false;
            }
            let (inputs, responses) = values.split_at(self.inputs);
            self.push_row(status, inputs, responses);
        }
        self.reasons.len() == count
    }

    /// The rows as they stand in a file.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.status.len() * self.row_bytes());
        for (place, status) in self.status.iter().enumerate() {
            bytes.extend(status.to_le_bytes());
            let start = place * self.columns();
            for value in &self.values[start..start + self.columns()] {
                bytes.extend(value.to_le_bytes());
            }
        }
        bytes
    }

    /// Length of a row in a file \[bytes\].
    pub(super) fn row_bytes(&self) -> usize {
        4 + 8 * self.columns()
    }

    pub(super) fn reasons(&self) -> Vec<String> {
        self.reasons.iter().cloned().collect()
    }

    /// How many inputs and responses a row has.
    pub fn columns(&self) -> usize {
        self.inputs + self.responses
    }

    /// The first variant.
    pub fn from(&self) -> u64 {
        self.from
    }

    /// The variant after the last one.
    pub fn end(&self) -> u64 {
        self.from + self.len() as u64
    }

    /// How many rows.
    pub fn len(&self) -> usize {
        self.status.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.status.is_empty()
    }

    /// The rows in the order of their variants.
    pub fn iter(&self) -> impl Iterator<Item = Row<'_>> {
        self.status.iter().enumerate().map(|(place, &status)| {
            let start = place * self.columns();
            let values = &self.values[start..start + self.columns()];
            let (inputs, responses) = values.split_at(self.inputs);
            let reason = (status as usize).checked_sub(1);
            Row {
                variant: self.from + place as u64,
                reason: reason
                    .and_then(|reason| self.reasons.get_index(reason))
                    .map(String::as_str),
                inputs,
                responses,
            }
        })
    }
}
