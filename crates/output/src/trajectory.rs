//! The output table: building it row by row, finding columns, keeping some of them.

use std::borrow::Cow;

use super::{Column, Trajectory};

/// Name of the column that is always first and always kept.
pub const TIME: &str = "time";

impl Column {
    /// A column `name[unit]`.
    pub fn new(name: impl Into<String>, unit: &'static str) -> Self {
        Column {
            name: name.into(),
            unit,
        }
    }

    /// `name[unit]`, as written in results.
    pub fn label(&self) -> String {
        format!("{}[{}]", self.name, self.unit)
    }
}

/// Which columns some patterns keep, and what to tell about patterns that keep none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Selection {
    /// Column indices, ascending.
    pub columns: Vec<usize>,
    pub warnings: Vec<String>,
}

impl Selection {
    /// Columns whose name, without `[unit]`, matches one of the patterns (`*`: any text, `?`: one character); no
    /// pattern at all keeps every column, `time` is always kept.
    pub fn new(columns: &[Column], patterns: &[String]) -> Self {
        if patterns.is_empty() {
            return Selection {
                columns: (0..columns.len()).collect(),
                warnings: Vec::new(),
            };
        }
        let matches_one = |name: &str| patterns.iter().any(|pattern| matches(pattern, name));
        let kept = |column: &Column| column.name == TIME || matches_one(&column.name);
        let kept = (0..columns.len())
            .filter(|&index| kept(&columns[index]))
            .collect();
        let unmatched = patterns
            .iter()
            .filter(|pattern| !columns.iter().any(|column| matches(pattern, &column.name)));
        Selection {
            columns: kept,
            warnings: unmatched
                .map(|pattern| no_match(pattern, columns))
                .collect(),
        }
    }
}

/// The warning about a pattern that matches no column, with a hint where there is one.
fn no_match(pattern: &str, columns: &[Column]) -> String {
    if pattern.contains('[') {
        return format!(
            "analysis.columns: {pattern:?} matches no column: patterns match names without their [unit]"
        );
    }
    let near = columns
        .iter()
        .map(|column| {
            (
                strsim::normalized_damerau_levenshtein(pattern, &column.name),
                &column.name,
            )
        })
        .filter(|(similarity, _)| *similarity >= 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    match near {
        Some((_, name)) => {
            format!("analysis.columns: {pattern:?} matches no column; the nearest is {name:?}")
        }
        None => format!("analysis.columns: {pattern:?} matches no column"),
    }
}

/// Does `name` match `pattern`, where `*` stands for any text and `?` for one character?
pub fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), name.chars().collect());
    let (mut p, mut n) = (0, 0);
    // Where to go on when a later character fails: behind the last star, one character further in the name.
    let mut retry: Option<(usize, usize)> = None;
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                p += 1;
                retry = Some((p, n));
            }
            Some(&c) if c == '?' || c == name[n] => {
                p += 1;
                n += 1;
            }
            Some(_) | None => match retry {
                Some((after_star, from)) => {
                    p = after_star;
                    n = from + 1;
                    retry = Some((after_star, n));
                }
                None => return false,
            },
        }
    }
    pattern[p..].iter().all(|&c| c == '*')
}

impl Trajectory {
    /// An empty table.
    pub fn new(columns: Vec<Column>) -> Self {
        Trajectory {
            columns,
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
        self.columns.push(column);
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

    /// Index of the column of that name, given with or without its `[unit]`.
    pub fn column_index(&self, name: &str) -> Option<usize> {
        let is_it = |column: &Column| match name.strip_prefix(column.name.as_str()) {
            Some("") => true,
            Some(rest) => {
                rest.strip_prefix('[')
                    .and_then(|unit| unit.strip_suffix(']'))
                    == Some(column.unit)
            }
            None => false,
        };
        self.columns.iter().position(is_it)
    }

    /// The values of one column, row by row.
    pub fn column(&self, index: usize) -> impl Iterator<Item = f64> {
        self.rows().map(move |row| row[index])
    }

    /// The values of the named column (with or without its `[unit]`), where there is one.
    pub fn values(&self, name: &str) -> Option<Vec<f64>> {
        Some(self.column(self.column_index(name)?).collect())
    }

    /// A table of the columns that `patterns` name (see [`Selection::new`]), none where that is all of them; and a warning per
    /// pattern that matches nothing.
    pub fn select(&self, patterns: &[String]) -> (Option<Trajectory>, Vec<String>) {
        let Selection {
            columns: kept,
            warnings,
        } = Selection::new(&self.columns, patterns);
        let selected = (kept.len() < self.width()).then(|| Trajectory {
            data: self
                .rows()
                .flat_map(|row| kept.iter().map(|&column| row[column]))
                .collect(),
            columns: kept
                .iter()
                .map(|&column| self.columns[column].clone())
                .collect(),
        });
        (selected, warnings)
    }

    /// This table with the rows of another one, which has at least its columns; both stand by time, and do so together. Of
    /// the same instant the others come last.
    pub fn with_rows(&self, others: &Trajectory) -> Cow<'_, Trajectory> {
        let times = (self.column_index(TIME), others.column_index(TIME));
        let from: Option<Vec<usize>> = self
            .columns
            .iter()
            .map(|column| others.column_index(&column.label()))
            .collect();
        let ((Some(time), Some(other_time)), Some(from)) = (times, from) else {
            return Cow::Borrowed(self);
        };
        if others.is_empty() {
            return Cow::Borrowed(self);
        }
        let mut together = Trajectory::new(self.columns.clone());
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

    /// Smallest and largest value of one column.
    pub fn extremes_of(&self, column: usize) -> Option<Extremes> {
        let time = self.column_index(TIME);
        let mut found = None;
        for row in self.rows() {
            note(
                &mut found,
                row[column],
                time.map_or(f64::NAN, |time| row[time]),
            );
        }
        found
    }

    /// Smallest and largest value of every column, in one pass over the table.
    pub fn extremes(&self) -> Vec<Option<Extremes>> {
        let time = self.column_index(TIME);
        let mut found: Vec<Option<Extremes>> = vec![None; self.width()];
        for row in self.rows() {
            let time = time.map_or(f64::NAN, |column| row[column]);
            for (extremes, &value) in found.iter_mut().zip(row) {
                note(extremes, value, time);
            }
        }
        found
    }
}

/// Takes a value for an extreme where it is one.
fn note(extremes: &mut Option<Extremes>, value: f64, time: f64) {
    if !value.is_finite() {
        return;
    }
    match extremes {
        None => {
            *extremes = Some(Extremes {
                min: value,
                min_time: time,
                max: value,
                max_time: time,
            })
        }
        Some(known) if value < known.min => (known.min, known.min_time) = (value, time),
        Some(known) if value > known.max => (known.max, known.max_time) = (value, time),
        Some(_) => {}
    }
}

/// Smallest and largest value of a column over its non-empty cells, each with its first instant \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremes {
    pub min: f64,
    pub min_time: f64,
    pub max: f64,
    pub max_time: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(names: &[&str]) -> Vec<Column> {
        names.iter().map(|&name| Column::new(name, "m")).collect()
    }

    fn patterns(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|&text| text.to_string()).collect()
    }

    #[test]
    fn patterns_match_like_the_shell() {
        for (pattern, name, expected) in [
            ("crank.*", "crank.x", true),
            ("crank.*", "crank2.x", false),
            ("*", "", true),
            ("joint.b.f?", "joint.b.fx", true),
            ("joint.b.f?", "joint.b.f", false),
            ("joint.?.f?", "joint.🔒.fy", true),
            ("*.x", "a.x.x", true),
            ("*a*b", "xaxbxab", true),
            ("*a*b", "xaxbxa", false),
            ("**", "anything", true),
            ("x", "xx", false),
        ] {
            assert_eq!(matches(pattern, name), expected, "{pattern} on {name}");
        }
    }

    #[test]
    fn select_keeps_time_and_order_and_warns() {
        let mut table = Trajectory::new(columns(&["time", "a.x", "a.y", "b.x"]));
        table.push_row(&[0.0, 1.0, 2.0, 3.0]);
        table.push_row(&[0.5, 4.0, 5.0, 6.0]);
        let (selected, warnings) = table.select(&patterns(&["b.*", "*.x", "a.z", "c[m]"]));
        let table = selected.expect("fewer columns");
        assert_eq!(table.columns, columns(&["time", "a.x", "b.x"]));
        assert_eq!(table.data, [0.0, 1.0, 3.0, 0.5, 4.0, 6.0]);
        assert_eq!(warnings.len(), 2, "{warnings:?}");
        assert!(
            warnings[0].contains("a.z") && warnings[0].contains("nearest"),
            "{warnings:?}"
        );
        assert!(warnings[1].contains("without their [unit]"), "{warnings:?}");
    }

    #[test]
    fn no_pattern_keeps_all() {
        let mut table = Trajectory::new(columns(&["time", "a.x"]));
        table.push_row(&[0.0, 1.0]);
        let (selected, warnings) = table.select(&[]);
        assert!(selected.is_none() && warnings.is_empty());
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
        for (time, x) in [(0.0, f64::NAN), (1.0, 3.0), (2.0, -1.0), (3.0, 3.0)] {
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
            columns: columns(&["time"]),
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
