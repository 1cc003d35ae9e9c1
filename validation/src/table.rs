//! `reference.csv`: a table of numbers with a header line, quoted as RFC 4180 says; an empty cell is no number.

/// The table.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// As in the header, `name[unit]`.
    pub columns: Vec<String>,
    /// NaN where a cell is empty.
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    /// Reads a table; lines that begin with `#` and empty lines are skipped.
    ///
    /// # Errors
    /// When there is no header, a row has another number of cells, or a cell is no finite number.
    pub fn parse(text: &str) -> Result<Self, String> {
        let lines = text
            .lines()
            .enumerate()
            .filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
        let mut records = lines.map(|(index, line)| (index + 1, split(line)));
        let (_, columns) = records.next().ok_or("no header line")?;
        let mut rows = Vec::new();
        for (line, cells) in records {
            if cells.len() != columns.len() {
                return Err(format!(
                    "line {line}: {} cells under {} columns",
                    cells.len(),
                    columns.len()
                ));
            }
            let row: Result<Vec<f64>, String> = cells.iter().map(|cell| number(cell)).collect();
            rows.push(row.map_err(|cell| format!("line {line}: {cell:?} is no number"))?);
        }
        Ok(Table { columns, rows })
    }
}

/// A cell's number; the cell itself where it is none.
fn number(cell: &str) -> Result<f64, String> {
    if cell.trim().is_empty() {
        return Ok(f64::NAN);
    }
    cell.trim()
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite())
        .ok_or_else(|| cell.to_string())
}

/// The fields of a line.
fn split(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    let mut characters = line.chars().peekable();
    while let Some(c) = characters.next() {
        let field = fields.len() - 1;
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                fields[field].push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            _ => fields[field].push(c),
        }
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read() {
        let table = Table::parse("# from a book\ntime[s],\"6\"\" bar.x[m]\"\r\n0,1.5\n\n1e-3, \n")
            .expect("valid");
        assert_eq!(table.columns, ["time[s]", "6\" bar.x[m]"]);
        assert_eq!(table.rows[0], [0.0, 1.5]);
        assert!(table.rows[1][1].is_nan());
    }

    #[test]
    fn faults_have_a_line() {
        for (text, said) in [
            ("", "no header line"),
            ("a,b\n1\n", "line 2: 1 cells under 2 columns"),
            ("a\n1\nx\n", "line 3: \"x\" is no number"),
            ("a\nNaN\n", "line 2: \"NaN\" is no number"),
        ] {
            assert_eq!(Table::parse(text), Err(said.to_string()));
        }
    }
}
