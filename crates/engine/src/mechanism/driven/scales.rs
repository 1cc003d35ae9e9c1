//! Scales of rows and of entries of J, of which there are four at most: a byte stands for each.

use crate::element::Measure;
use crate::system::{System, larger};

/// A list of scales.
#[derive(Debug, Clone, Default)]
pub struct Scales {
    kinds: Vec<u8>,
    of: [f64; 4],
}

/// Of what belongs to ground, and of what is measured alike by rows and columns.
const NONE: u8 = 0;
const ONE: u8 = 1;
/// By lengths, and by their inverse.
const LENGTH: u8 = 2;
const INVERSE: u8 = 3;

impl Scales {
    /// Of a mechanism's rows or entries; what was there is forgotten.
    fn restart(&mut self, system: &System) {
        let [length, one] = [Measure::Length, Measure::Angle].map(|of| system.measure_scale(of));
        self.of = [0.0, one, length / one, one / length];
        self.kinds.clear();
    }

    /// Scales of the entries of J: that of the column by that of the row; none of ground's.
    pub(super) fn set_entries(&mut self, system: &System) {
        self.restart(system);
        self.kinds.extend(system.entries.iter().map(|entry| {
            let column = entry
                .column()
                .map(|column| system.column_measure(column as usize));
            match (column, system.measures[entry.row as usize]) {
                (None, _) => NONE,
                (Some(Measure::Length), Measure::Angle) => LENGTH,
                (Some(Measure::Angle), Measure::Length) => INVERSE,
                (Some(Measure::Length), Measure::Length)
                | (Some(Measure::Angle), Measure::Angle) => ONE,
            }
        }));
        self.kinds.shrink_to_fit();
    }

    /// Scales of rows of these measures.
    pub(super) fn set_rows(&mut self, system: &System, rows: impl Iterator<Item = Measure>) {
        self.restart(system);
        self.kinds.extend(rows.map(|measure| match measure {
            Measure::Length => LENGTH,
            Measure::Angle => ONE,
        }));
    }

    /// The largest |x| by its scale; NaN where one is. Of each scale the largest is enough.
    pub fn largest(&self, x: impl Iterator<Item = f64>) -> f64 {
        let mut most = [0.0; 4];
        for (kind, x) in self.kinds.iter().zip(x) {
            let most = &mut most[usize::from(kind & 3)];
            *most = larger(*most, x);
        }
        let of = most.iter().zip(&self.of).filter(|(most, _)| **most != 0.0);
        of.fold(0.0, |largest, (most, scale)| larger(largest, most / scale))
    }

    /// They, in order.
    pub fn iter(&self) -> impl Iterator<Item = f64> {
        self.kinds.iter().map(|kind| self.of[usize::from(kind & 3)])
    }
}
