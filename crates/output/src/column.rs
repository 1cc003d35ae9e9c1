//! A column of a table: its heading, the handle it is found by, and its values.

use super::{Channel, Extremes};

/// The heading of a column, written `name[unit]`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// `joint.b.fx`; unique in its table.
    pub name: String,
    /// Name of its owner, `b`; empty where it has none.
    pub owner: String,
    /// SI unit as files write it, `m/s^2`.
    pub unit: &'static str,
    /// What it is; none for a column that is no result of an analysis.
    pub channel: Option<Channel>,
}

impl Column {
    /// A column `name[unit]` that is no result of an analysis.
    pub fn new(name: impl Into<String>, unit: &'static str) -> Self {
        Column {
            name: name.into(),
            owner: String::new(),
            unit,
            channel: None,
        }
    }

    /// The column of a channel, whose owner has this name.
    pub fn of(channel: Channel, owner: &str, unit: &'static str) -> Self {
        Column {
            name: channel.name(owner),
            owner: owner.into(),
            unit,
            channel: Some(channel),
        }
    }

    /// `name[unit]`, as written in results.
    pub fn label(&self) -> String {
        format!("{}[{}]", self.name, self.unit)
    }

    /// Whether `text` is the name of this column, with or without its `[unit]`.
    pub fn is_called(&self, text: &str) -> bool {
        match text.strip_prefix(self.name.as_str()) {
            Some("") => true,
            Some(rest) => {
                rest.strip_prefix('[')
                    .and_then(|unit| unit.strip_suffix(']'))
                    == Some(self.unit)
            }
            None => false,
        }
    }
}

/// Handle of a column in a table, and in every table with the same columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ColumnId(usize);

impl ColumnId {
    /// The column at this place.
    pub const fn at(index: usize) -> Self {
        ColumnId(index)
    }

    /// The place of the column.
    pub const fn index(self) -> usize {
        self.0
    }
}

/// The values of a column, row by row, where they are in the table.
#[derive(Debug, Clone, Copy)]
pub struct ColumnView<'t> {
    /// From the first value on.
    data: &'t [f64],
    stride: usize,
}

impl<'t> ColumnView<'t> {
    /// Every `stride`-th value of `data`, from the first on.
    pub(super) fn new(data: &'t [f64], stride: usize) -> Self {
        ColumnView { data, stride }
    }

    /// Number of rows.
    pub fn len(self) -> usize {
        self.data.len().div_ceil(self.stride)
    }

    /// Whether there is no row.
    pub fn is_empty(self) -> bool {
        self.data.is_empty()
    }

    /// The value of a row; none beyond the last.
    pub fn get(self, row: usize) -> Option<f64> {
        self.data.get(row * self.stride).copied()
    }

    /// The values in order; NaN where there is none.
    pub fn iter(self) -> impl ExactSizeIterator<Item = f64> + DoubleEndedIterator + Clone + 't {
        self.data.iter().step_by(self.stride).copied()
    }

    /// The memory that the values are in, and the distance from each to the next: for whoever wants them without a copy.
    pub fn strided(self) -> (&'t [f64], usize) {
        (self.data, self.stride)
    }

    /// Largest absolute value; NaN where no row has a value.
    pub fn max_abs(self) -> f64 {
        self.iter()
            .fold(f64::NAN, |most: f64, value| most.max(value.abs()))
    }

    /// Smallest and largest value, with the times of their rows.
    pub fn extremes(self, times: ColumnView) -> Option<Extremes> {
        let mut found = None;
        for (value, time) in self.iter().zip(times.iter()) {
            Extremes::note(&mut found, value, time);
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{JointQuantity, Trajectory};

    #[test]
    fn a_view_reads_its_column_in_place() {
        let mut table = Trajectory::new(vec![Column::new("time", "s"), Column::new("a.x", "m")]);
        let id = table.id("a.x").expect("there");
        assert!(table.column(id).is_empty() && table.column(id).max_abs().is_nan());
        for (time, x) in [(0.0, 1.0), (1.0, f64::NAN), (2.0, -3.0)] {
            table.push_row(&[time, x]);
        }
        let view = table.column(id);
        assert_eq!(
            (view.len(), view.get(2), view.get(3)),
            (3, Some(-3.0), None)
        );
        assert_eq!(
            (view.iter().len(), view.iter().next_back()),
            (3, Some(-3.0))
        );
        assert_eq!(view.max_abs(), 3.0);
        let (data, stride) = view.strided();
        assert_eq!((stride, data.as_ptr()), (2, table.data[1..].as_ptr()));
        let extremes = view
            .extremes(table.column(ColumnId::at(0)))
            .expect("values");
        assert_eq!((extremes.max_time, extremes.min_time), (0.0, 2.0));
    }

    #[test]
    fn a_column_is_named_by_its_channel() {
        let channel = Channel::Joint(3, JointQuantity::NormalForce);
        let column = Column::of(channel, "b", "N");
        assert_eq!(column.label(), "joint.b.normal_force[N]");
        assert!(column.is_called("joint.b.normal_force[N]") && column.is_called(&column.name));
        assert!(!column.is_called("joint.b.normal_force[m]") && !column.is_called("joint.b"));
        let table = Trajectory::new(vec![Column::new("time", "s"), column]);
        assert_eq!(table.find(channel), Some(ColumnId::at(1)));
        assert_eq!(
            table.find(Channel::Joint(2, JointQuantity::NormalForce)),
            None
        );
    }
}
