//! The output table: building it row by row, finding columns, keeping some of them.

use std::borrow::Cow;
use std::sync::Arc;

use super::{Channel, Column, ColumnId, ColumnView, Extremes, Selection, TIME};

/// Output rows, row by row; NaN stands for "does not exist at this instant" and is written as an empty cell.
///
/// Rows stand behind each other, as they are computed and written; a column is read in place, with the width of the table as
/// its stride.
#[derive(Debug, Clone, Default)]
pub struct Trajectory {
    /// The headings, shared by all tables with the same columns.
    pub columns: Arc<[Column]>,
    /// (rows × columns), row-major.
    pub data: Vec<f64>,
}

impl Trajectory {
    /// An empty table.
    pub fn new(columns: Vec<Column>) -> Self {
        Trajectory::with_columns(&columns.into())
    }

    /// An empty table with headings that it shares with others.
    pub fn with_columns(columns: &Arc<[Column]>) -> Self {
        Trajectory {
            columns: Arc::clone(columns),
            data: Vec::new(),
        }
    }

    /// Makes room for `rows` more rows, so that pushing them allocates nothing.
    pub fn reserve(&mut self, rows: usize) {
        self.data.reserve(rows * self.columns.len());
    }

    /// Appends one row.
    ///
    /// # Panics
    /// When the row has another length than the table is wide, which would shift all later rows.
    pub fn push_row(&mut self, row: &[f64]) {
        assert_eq!(
            row.len(),
            self.columns.len(),
            "a row must have one value per column"
        );
        self.data.extend_from_slice(row);
    }

    /// Appends a column with a value per row.
    ///
    /// # Panics
    /// When there are more or fewer values than rows.
    pub fn push_column(&mut self, column: Column, values: &[f64]) {
        assert_eq!(
            values.len(),
            self.len(),
            "a column must have one value per row"
        );
        let rows = self.rows().zip(values);
        self.data = rows
            .flat_map(|(row, value)| row.iter().chain(std::iter::once(value)).copied())
            .collect();
        self.columns = self.columns.iter().cloned().chain([column]).collect();
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.data.len().checked_div(self.columns.len()).unwrap_or(0)
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The rows, in order.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.data.chunks_exact(self.width().max(1))
    }

    /// One row.
    pub fn row(&self, index: usize) -> &[f64] {
        &self.data[index * self.width()..(index + 1) * self.width()]
    }

    /// The column of that name, given with or without its `[unit]`.
    pub fn id(&self, name: &str) -> Option<ColumnId> {
        self.column_index(name).map(ColumnId::at)
    }

    /// The column of a channel.
    pub fn find(&self, channel: Channel) -> Option<ColumnId> {
        let is_it = |column: &Column| column.channel == Some(channel);
        self.columns.iter().position(is_it).map(ColumnId::at)
    }

    /// The column with this heading.
    pub fn id_of(&self, heading: &Column) -> Option<ColumnId> {
        let is_it = |column: &Column| column.name == heading.name && column.unit == heading.unit;
        self.columns.iter().position(is_it).map(ColumnId::at)
    }

    /// Index of the column of that name, given with or without its `[unit]`.
    pub fn column_index(&self, name: &str) -> Option<usize> {
        self.columns
            .iter()
            .position(|column| column.is_called(name))
    }

    /// The values of a column, without a copy.
    pub fn column(&self, id: ColumnId) -> ColumnView<'_> {
        let data = self.data.get(id.index()..).unwrap_or_default();
        ColumnView::new(data, self.width().max(1))
    }

    /// The values of the named column (with or without its `[unit]`), where there is one.
    pub fn values(&self, name: &str) -> Option<Vec<f64>> {
        Some(self.column(self.id(name)?).iter().collect())
    }

    /// A table of the columns that `patterns` name (see [`Selection::new`]), `None` if that is all of them; and a warning per
    /// pattern that matches nothing.
    pub fn select(&self, patterns: &[String]) -> (Option<Trajectory>, Vec<String>) {
        self.select_beside(patterns, &[])
    }

    /// The same; warnings know the names of these columns, too, which could be there.
    pub fn select_beside(
        &self,
        patterns: &[String],
        others: &[Column],
    ) -> (Option<Trajectory>, Vec<String>) {
        let Selection {
            columns: kept,
            warnings,
        } = Selection::beside(&self.columns, others, patterns);
        let selected = (kept.len() < self.width()).then(|| Trajectory {
            data: self
                .rows()
                .flat_map(|row| kept.iter().map(|id| row[id.index()]))
                .collect(),
            columns: kept
                .iter()
                .map(|id| self.columns[id.index()].clone())
                .collect(),
        });
        (selected, warnings)
    }

    /// This table with the rows of another one, which has at least its columns; both stand by time, and do so together. Of
    /// the same instant the others come last.
    pub fn with_rows(&self, others: &Trajectory) -> Cow<'_, Trajectory> {
        let times = (self.column_index(TIME), others.column_index(TIME));
        let place = |heading| others.id_of(heading).map(ColumnId::index);
        let from: Option<Vec<usize>> = if Arc::ptr_eq(&self.columns, &others.columns) {
            Some((0..self.width()).collect())
        } else {
            self.columns.iter().map(place).collect()
        };
        let ((Some(time), Some(other_time)), Some(from)) = (times, from) else {
            return Cow::Borrowed(self);
        };
        if others.is_empty() {
            return Cow::Borrowed(self);
        }
        let mut together = Trajectory::with_columns(&self.columns);
        together.reserve(self.len() + others.len());
        let mut between = others.rows().peekable();
        for row in self.rows() {
            while let Some(other) = between.next_if(|other| other[other_time] < row[time]) {
                together
                    .data
                    .extend(from.iter().map(|&column| other[column]));
            }
            together.data.extend_from_slice(row);
        }
        between.for_each(|other| {
            together
                .data
                .extend(from.iter().map(|&column| other[column]))
        });
        Cow::Owned(together)
    }

    /// Smallest and largest value of a column.
    pub fn extremes_of(&self, id: ColumnId) -> Option<Extremes> {
        let time = self.id(TIME)?;
        self.column(id).extremes(self.column(time))
    }

    /// Smallest and largest value of every column, in one pass over the table.
    pub fn extremes(&self) -> Vec<Option<Extremes>> {
        let time = self.column_index(TIME);
        let time = |row: usize| time.map_or(f64::NAN, |column| self.row(row)[column]);
        let of_column = |(column, rows): (usize, Option<[usize; 2]>)| {
            let [min, max] = rows?;
            Some(Extremes {
                min: self.row(min)[column],
                min_time: time(min),
                max: self.row(max)[column],
                max_time: time(max),
            })
        };
        let found = self.extreme_rows().into_iter().enumerate();
        found.map(of_column).collect()
    }

    /// The first rows with the smallest and the largest value of every column, in one pass over the table.
    pub fn extreme_rows(&self) -> Vec<Option<[usize; 2]>> {
        let mut rows = vec![None; self.width()];
        let mut ends = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.width()];
        for (row, values) in self.rows().enumerate() {
            for (column, (&value, [min, max])) in values.iter().zip(&mut ends).enumerate() {
                if value >= *min && value <= *max || !value.is_finite() {
                    continue;
                }
                let [first, last] = rows[column].get_or_insert([row; 2]);
                if value < *min {
                    (*min, *first) = (value, row);
                }
                if value > *max {
                    (*max, *last) = (value, row);
                }
            }
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(names: &[&str]) -> Vec<Column> {
        names.iter().map(|&name| Column::new(name, "m")).collect()
    }

    #[test]
    fn columns_are_found_with_and_without_unit() {
        let table = Trajectory::new(columns(&["time", "a.x", "a.x2"]));
        assert_eq!(table.column_index("a.x"), Some(1));
        assert_eq!(table.column_index("a.x[m]"), Some(1));
        assert_eq!(table.column_index("a.x2[m]"), Some(2));
        assert_eq!(table.column_index("a.x[rad]"), None);
        assert_eq!(table.column_index("a"), None);
    }

    #[test]
    fn extremes_skip_empty_cells() {
        let mut table = Trajectory::new(columns(&["time", "a.x", "a.y"]));
        for (time, x) in [(0.0, f64::INFINITY), (1.0, 3.0), (2.0, -1.0), (3.0, 3.0)] {
            table.push_row(&[time, x, f64::NAN]);
        }
        let extremes = table.extremes();
        assert_eq!(
            extremes[1],
            Some(Extremes {
                min: -1.0,
                min_time: 2.0,
                max: 3.0,
                max_time: 1.0
            })
        );
        assert_eq!(extremes[2], None);
    }

    #[test]
    fn rows_of_another_table_go_between_by_time() {
        let mut table = Trajectory::new(columns(&["time", "a.y"]));
        let mut others = Trajectory::new(columns(&["time", "a.x", "a.y"]));
        assert!(matches!(table.with_rows(&others), Cow::Borrowed(_)));
        for time in [0.0, 1.0] {
            table.push_row(&[time, 10.0 * time]);
        }
        for time in [-1.0, 0.0, 0.5, 2.0] {
            others.push_row(&[time, 7.0, time]);
        }
        let together = table.with_rows(&others);
        let expected = [
            [-1.0, -1.0],
            [0.0, 0.0],
            [0.0, 0.0],
            [0.5, 0.5],
            [1.0, 10.0],
            [2.0, 2.0],
        ];
        assert_eq!(together.data, expected.concat());
        let most = together.extremes()[1].expect("values");
        assert_eq!(
            (most.min, most.min_time, most.max, most.max_time),
            (-1.0, -1.0, 10.0, 1.0)
        );
        let strange = Trajectory {
            columns: columns(&["time"]).into(),
            data: vec![0.5],
        };
        assert!(
            matches!(table.with_rows(&strange), Cow::Borrowed(_)),
            "without its columns they are none of its rows"
        );
    }

    #[test]
    fn an_empty_table_has_no_rows() {
        let table = Trajectory::default();
        assert!(table.is_empty() && table.rows().len() == 0 && table.extremes().is_empty());
    }

    #[test]
    fn pushing_after_reserve_does_not_move_the_data() {
        let mut table = Trajectory::new(columns(&["time", "a.x"]));
        table.reserve(100);
        let before = table.data.as_ptr();
        for i in 0..100 {
            table.push_row(&[f64::from(i), 0.0]);
        }
        assert_eq!(before, table.data.as_ptr());
    }
}
