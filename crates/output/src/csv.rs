//! `results.csv`: one header line, one line per output instant, every number in its shortest form that reads back as
//! the same double. A value that is not finite does not exist and becomes an empty cell.
//!
//! Quoting follows RFC 4180, with a line feed alone as line end.

use std::io::{self, Write};

use super::Trajectory;

/// Size of the pieces that are handed on \[bytes\]; small enough to stay in a cache.
const PIECE: usize = 1 << 16;

/// Writes the whole table, in pieces; `out` needs no buffer of its own.
///
/// # Errors
/// Those of `out`.
pub fn write(trajectory: &Trajectory, out: &mut impl Write) -> io::Result<()> {
    let mut text = Vec::with_capacity(PIECE + PIECE / 4);
    for (index, column) in trajectory.columns.iter().enumerate() {
        if index > 0 {
            text.push(b',');
        }
        push_field(&mut text, &column.label());
    }
    text.push(b'\n');
    let mut digits = ryu::Buffer::new();
    for row in trajectory.rows() {
        for (index, &value) in row.iter().enumerate() {
            if index > 0 {
                text.push(b',');
            }
            push_digits(&mut text, &mut digits, value);
        }
        text.push(b'\n');
        if text.len() >= PIECE {
            out.write_all(&text)?;
            text.clear();
        }
    }
    out.write_all(&text)
}

fn push_digits(text: &mut Vec<u8>, digits: &mut ryu::Buffer, value: f64) {
    if value.is_finite() {
        text.extend_from_slice(digits.format_finite(value).as_bytes());
    }
}

/// Appends a number, or nothing where it does not exist.
pub fn push_number(text: &mut Vec<u8>, value: Option<f64>) {
    push_digits(text, &mut ryu::Buffer::new(), value.unwrap_or(f64::NAN));
}

/// A spreadsheet takes a cell that begins with one of these for a formula.
const FORMULA: [char; 4] = ['=', '+', '-', '@'];

/// Whether a text, behind apostrophes, begins as a formula does.
fn is_formula(field: &str) -> bool {
    field.trim_start_matches('\'').starts_with(FORMULA)
}

/// The name that [`push_field`] has written as this field.
pub fn name_of(field: &str) -> &str {
    let name = field.strip_prefix('\'').filter(|name| is_formula(name));
    name.unwrap_or(field)
}

/// Appends one field of text: with an apostrophe before it where a spreadsheet would take it for a formula, in quotes where a comma,
/// a quote or a line end in it would break the line up.
pub fn push_field(text: &mut Vec<u8>, field: &str) {
    let escaped = is_formula(field).then(|| format!("'{field}"));
    let field = escaped.as_deref().unwrap_or(field);
    if !field.contains([',', '"', '\n', '\r']) {
        text.extend_from_slice(field.as_bytes());
        return;
    }
    text.push(b'"');
    text.extend_from_slice(field.replace('"', "\"\"").as_bytes());
    text.push(b'"');
}

#[cfg(test)]
mod tests {
    use super::super::Column;
    use super::*;

    fn text(trajectory: &Trajectory) -> String {
        let mut text = Vec::new();
        write(trajectory, &mut text).expect("memory takes it");
        String::from_utf8(text).expect("CSV is UTF-8")
    }

    #[test]
    fn cells_without_value_are_empty() {
        let mut table = Trajectory::new(vec![
            Column::new("time", "s"),
            Column::new("a.x", "m"),
            Column::new("b", "N"),
        ]);
        table.push_row(&[0.0, f64::NAN, 1.5]);
        table.push_row(&[1e-7, f64::INFINITY, f64::NEG_INFINITY]);
        assert_eq!(text(&table), "time[s],a.x[m],b[N]\n0.0,,1.5\n1e-7,,\n");
    }

    #[test]
    fn hostile_names_are_quoted() {
        let names = ["time", "6\" bar.x", "🔒.x", "a\nb", "ordinary name"];
        let table = Trajectory::new(names.iter().map(|&name| Column::new(name, "m")).collect());
        assert_eq!(
            text(&table),
            "time[m],\"6\"\" bar.x[m]\",🔒.x[m],\"a\nb[m]\",ordinary name[m]\n"
        );
    }

    #[test]
    fn names_are_no_formulas() {
        for (name, cell) in [
            ("=1+1", "'=1+1"),
            ("-a", "'-a"),
            ("+a", "'+a"),
            ("@sum(a,b)", "\"'@sum(a,b)\""),
            ("'=a", "''=a"),
            ("a=b", "a=b"),
            ("'a", "'a"),
            ("", ""),
        ] {
            let mut text = Vec::new();
            push_field(&mut text, name);
            assert_eq!(text, cell.as_bytes(), "{name}");
            assert_eq!(name_of(cell.trim_matches('"')), name, "{cell}");
        }
        let mut table = Trajectory::new(vec![Column::new("-a.x", "m")]);
        table.push_row(&[-1.5]);
        assert_eq!(text(&table), "'-a.x[m]\n-1.5\n", "numbers stay");
    }

    #[test]
    fn numbers_read_back_as_the_same_double() {
        let values = [
            0.1,
            1.0 / 3.0,
            f64::MAX,
            f64::MIN_POSITIVE,
            5e-324,
            1e16,
            -123_456_789.0,
            1e21,
            2.5e-5,
        ];
        let mut table = Trajectory::new(
            (0..values.len())
                .map(|i| Column::new(format!("c{i}"), "m"))
                .collect(),
        );
        table.push_row(&values);
        let text = text(&table);
        let read: Vec<f64> = text
            .lines()
            .nth(1)
            .unwrap_or("")
            .split(',')
            .map(|cell| cell.parse().unwrap_or(f64::NAN))
            .collect();
        assert_eq!(read, values, "{text}");
    }

    #[test]
    fn a_table_without_rows_is_its_header() {
        assert_eq!(
            text(&Trajectory::new(vec![Column::new("time", "s")])),
            "time[s]\n"
        );
    }

    /// The lock case with everything kept: 1751 rows, 110 columns. Prints its time; the bound leaves room for a busy machine.
    #[test]
    fn a_large_table_is_written_fast() {
        let mut table = Trajectory::new(
            (0..110)
                .map(|i| Column::new(format!("c{i}"), "m"))
                .collect(),
        );
        table.reserve(1751);
        for row in 0..1751 {
            let values: Vec<f64> = (0..110)
                .map(|column| (f64::from(row) * 0.37 + f64::from(column)).sin())
                .collect();
            table.push_row(&values);
        }
        let fastest = (0..20).map(|_| {
            let start = web_time::Instant::now();
            write(&table, &mut io::sink()).expect("a sink takes it");
            start.elapsed()
        });
        let fastest = fastest.min().unwrap_or_default();
        println!("1751 x 110 cells as CSV: {fastest:?}");
        assert!(
            cfg!(debug_assertions) || fastest.as_millis() < 40,
            "{fastest:?}"
        );
    }
}
