//! `variants.csv`: `variant, status`, inputs, responses; numbers in their shortest form that reads back as the same double. A value that
//! is not finite does not exist and becomes an empty cell. The status is `ok`, or the reason why there is no result.
//!
//! Quoting follows RFC 4180, with a line feed alone as line end.

use std::io::{self, Write};

use super::rows::Rows;

/// The line of names.
///
/// # Errors
/// Those of `out`.
pub fn write_header(
    inputs: &[String],
    responses: &[String],
    out: &mut impl Write,
) -> io::Result<()> {
    let mut text = b"variant,status".to_vec();
    for name in inputs.iter().chain(responses) {
        text.push(b',');
        push_field(&mut text, name);
    }
    text.push(b'\n');
    out.write_all(&text)
}

/// One line per row.
///
/// # Errors
/// Those of `out`.
pub fn write_rows(rows: &Rows, out: &mut impl Write) -> io::Result<()> {
    let mut text = Vec::new();
    let mut digits = ryu::Buffer::new();
    for row in rows.iter() {
        text.extend(row.variant.to_string().bytes());
        text.push(b',');
        push_field(&mut text, row.reason.unwrap_or("ok"));
        for &value in row.inputs.iter().chain(row.responses) {
            text.push(b',');
            if value.is_finite() {
                text.extend(digits.format_finite(value).bytes());
            }
        }
        text.push(b'\n');
    }
    out.write_all(&text)
}

/// Appends one field of text: with an apostrophe before it where a spreadsheet would take it for a formula, in quotes where a comma,
/// a quote or a line end in it would break the line up.
fn push_field(text: &mut Vec<u8>, field: &str) {
    let is_formula = |field: &str| {
        field
            .trim_start_matches('\'')
            .starts_with(['=', '+', '-', '@'])
    };
    let escaped = is_formula(field).then(|| format!("'{field}"));
    let field = escaped.as_deref().unwrap_or(field);
    if !field.contains([',', '"', '\n', '\r']) {
        text.extend(field.bytes());
        return;
    }
    text.push(b'"');
    text.extend(field.replace('"', "\"\"").bytes());
    text.push(b'"');
}
