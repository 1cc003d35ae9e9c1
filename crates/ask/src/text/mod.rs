//! Answers in words: labelled rows, tables, numbers of a few digits, and names that can't play tricks on a terminal.

pub mod responses;
pub mod words;

use std::borrow::Cow;
use std::fmt::{self, Write};
use std::ops::Range;

pub use linkdyn_model::display::number;

/// Width of the label column.
const LABEL_WIDTH: usize = 14;
/// Rows of a list before the rest is only counted.
const MOST: usize = 8;
/// What makes a terminal write in red, and as before (ECMA-48, select graphic rendition).
const RED: &str = "\u{1b}[31m";
const PLAIN: &str = "\u{1b}[0m";

/// Lines that belong together.
#[derive(Debug, Default)]
pub struct Page {
    text: String,
    /// Where lines stand that nobody should overlook.
    alarms: Vec<Range<usize>>,
}

impl Page {
    /// Appends a line.
    pub fn line(&mut self, text: impl AsRef<str>) {
        self.text.push_str(&plain(text.as_ref()));
        self.text.push('\n');
    }

    /// Makes the last line one that nobody should overlook.
    pub fn alarm(&mut self) {
        let end = self.text.trim_end_matches('\n').len();
        let start = self.text[..end].rfind('\n').map_or(0, |at| at + 1);
        self.alarms.push(start..end);
    }

    /// Appends a row with a label, or without, to go on with the row above.
    pub fn row(&mut self, label: &str, text: impl AsRef<str>) {
        self.line(format!("  {label:LABEL_WIDTH$}{}", text.as_ref()));
    }

    /// Appends a row per text, the label at the first one.
    pub fn rows<S: AsRef<str>>(&mut self, label: &str, texts: impl IntoIterator<Item = S>) {
        for (index, text) in texts.into_iter().enumerate() {
            self.row(if index == 0 { label } else { "" }, text);
        }
    }

    /// What there is so far.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The same for a terminal with colours.
    pub fn coloured(&self) -> String {
        let mut text = self.text.clone();
        for Range { start, end } in self.alarms.iter().rev() {
            text.insert_str(*end, PLAIN);
            text.insert_str(*start, RED);
        }
        text
    }
}

impl fmt::Display for Page {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// On which side of its column a cell stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// With spaces behind it.
    Left,
    /// With spaces before it.
    Right,
}

/// Rows of cells that stand below each other. A column is as wide as its widest cell, and has a least width.
#[derive(Debug)]
pub struct Table {
    /// Spaces between two columns.
    gap: usize,
    columns: Vec<(Side, usize)>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// Begins with no row; each column has a side and a least width.
    pub fn new(gap: usize, columns: impl Into<Vec<(Side, usize)>>) -> Self {
        Table {
            gap,
            columns: columns.into(),
            rows: Vec::new(),
        }
    }

    /// Appends a row, a cell for each column; a single cell is a heading across them.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        let cells: Vec<String> = cells.into_iter().map(Into::into).collect();
        if cells.len() > 1 {
            for ((_, width), cell) in self.columns.iter_mut().zip(&cells) {
                *width = (*width).max(cell.chars().count());
            }
        }
        self.rows.push(cells);
    }

    /// The rows as lines.
    pub fn lines(&self) -> impl Iterator<Item = String> {
        self.rows.iter().map(|row| {
            let cells = self.columns.iter().zip(row);
            let cells = cells.map(|((side, width), cell)| match side {
                Side::Left => format!("{cell:width$}"),
                Side::Right => format!("{cell:>width$}"),
            });
            let line = cells.collect::<Vec<_>>().join(&" ".repeat(self.gap));
            line.trim_end().to_owned()
        })
    }
}

/// The first rows, and how many there are more.
pub fn shorten(mut rows: Vec<String>) -> Vec<String> {
    if rows.len() > MOST + 1 {
        let more = rows.len() - MOST;
        rows.truncate(MOST);
        rows.push(format!("… and {more} more"));
    }
    rows
}

/// The first names, and how many there are more.
pub fn names(names: &[String]) -> String {
    let mut text = names
        .iter()
        .take(MOST + 1)
        .map(String::as_str)
        .collect::<Vec<_>>()
        .join(", ");
    if names.len() > MOST + 1 {
        text += &format!(" and {} more", names.len() - MOST - 1);
    }
    text
}

/// The words of `text` in lines of `width` characters, a longer word on a line of its own; one line at least.
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut length = 0;
    for word in text.split_whitespace() {
        let count = word.chars().count();
        if length > 0 && length + 1 + count > width {
            lines.push(String::new());
            length = 0;
        }
        // There is always a last line.
        if let Some(line) = lines.last_mut() {
            if length > 0 {
                line.push(' ');
                length += 1;
            }
            line.push_str(word);
            length += count;
        }
    }
    lines
}

/// `text` with control and direction-changing characters spelt out.
pub fn plain(text: &str) -> Cow<'_, str> {
    let is_trick =
        |c: char| c.is_control() || matches!(c, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    if !text.contains(is_trick) {
        return Cow::Borrowed(text);
    }
    let mut spelt = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_trick(c) {
            // Writing to a String can't fail.
            let _ = write!(spelt, "{}", c.escape_unicode());
        } else {
            spelt.push(c);
        }
    }
    Cow::Owned(spelt)
}

/// A time of day-to-day size: `0.31 ms`, `12 ms`, `3.2 s`.
pub fn seconds(value: f64) -> String {
    if value < 1.0 {
        format!("{} ms", number(value * 1e3, 2))
    } else {
        format!("{} s", number(value, 3))
    }
}

/// `1 driver`, `2 drivers`.
pub fn count(n: usize, what: &str) -> String {
    if n == 1 {
        format!("1 {what}")
    } else {
        format!("{n} {what}s")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tricks_are_spelt_out_and_the_rest_is_kept() {
        assert_eq!(
            plain("\u{1b}[31mred\n\u{202e}🔒"),
            "\\u{1b}[31mred\\u{a}\\u{202e}🔒"
        );
        assert_eq!(plain("Körper \"6\" 🔒"), "Körper \"6\" 🔒");
    }

    #[test]
    fn cells_stand_below_each_other() {
        let mut table = Table::new(2, [(Side::Left, 4), (Side::Right, 0)]);
        table.row(["a", "12"]);
        table.row(["größer", "3"]);
        let lines: Vec<String> = table.lines().collect();
        assert_eq!(lines, ["a       12", "größer   3"]);
    }

    #[test]
    fn long_lists_are_shortened() {
        let rows = |n: usize| (0..n).map(|i| i.to_string()).collect::<Vec<_>>();
        assert_eq!(shorten(rows(9)).len(), 9);
        assert_eq!(
            shorten(rows(20)).last().map(String::as_str),
            Some("… and 12 more")
        );
    }

    #[test]
    fn words_are_wrapped_and_none_is_lost() {
        assert_eq!(wrapped("a bc  def\nghij k", 6), ["a bc", "def", "ghij k"]);
        assert_eq!(wrapped("incomprehensible é", 4), ["incomprehensible", "é"]);
        assert_eq!(wrapped("", 4), [""]);
    }

    #[test]
    fn a_line_that_nobody_should_overlook_is_red_where_there_are_colours() {
        let mut page = Page::default();
        for text in ["a", "\u{1b}[31mb", "c"] {
            page.row("", text);
            if text != "a" {
                page.alarm();
            }
        }
        let coloured = page.coloured();
        let lines: Vec<&str> = coloured.lines().map(str::trim_start).collect();
        assert_eq!(lines[0], "a");
        assert!(
            lines[1].starts_with("\u{1b}[31m  ") && lines[1].ends_with("\\u{1b}[31mb\u{1b}[0m")
        );
        assert!(lines[2].ends_with("c\u{1b}[0m") && !page.text().contains('\u{1b}'));
    }

    #[test]
    fn a_page_can_not_be_broken_by_a_name() {
        let mut page = Page::default();
        page.line("a\nb");
        page.rows("forces", ["b: 1 N", "c: 2 N"]);
        assert_eq!(
            page.text(),
            "a\\u{a}b\n  forces        b: 1 N\n                c: 2 N\n"
        );
    }
}
