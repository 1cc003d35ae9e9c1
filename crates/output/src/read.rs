//! `results.csv` read back: columns `name[unit]`, an empty cell is a gap.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::mem::{Discriminant, discriminant};
use std::path::{Path, PathBuf};

use super::csv::name_of;
use super::read_error::LARGEST;
pub use super::read_error::ReadError;
use super::{Channel, TIME};

/// A column that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadColumn {
    /// Without its unit.
    pub name: String,
    /// Empty where the header gives none.
    pub unit: String,
    /// What it is, where its name is that of a result; owners are numbered as they come in the file.
    pub channel: Option<Channel>,
    /// Name of its owner; empty where it has none.
    pub owner: String,
    /// NaN where the cell is empty.
    pub values: Vec<f64>,
    /// The first cell that is no number: line and text. Only a fault to who wants the column.
    pub odd: Option<(u64, String)>,
}

impl ReadColumn {
    /// A column of numbers, the first of its kind of owner.
    pub fn new(name: &str, unit: &str, values: Vec<f64>) -> Self {
        let (channel, owner) = Channel::read(name.trim()).unzip();
        ReadColumn {
            name: name.into(),
            unit: unit.into(),
            channel,
            owner: owner.unwrap_or_default().into(),
            values,
            odd: None,
        }
    }

    /// `name[unit]`, as in the header.
    pub fn label(&self) -> String {
        if self.unit.is_empty() {
            self.name.clone()
        } else {
            format!("{}[{}]", self.name, self.unit)
        }
    }
}

/// A table that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// The file that it was read from.
    pub path: PathBuf,
    /// In the order of the file.
    pub columns: Vec<ReadColumn>,
}

/// Bytes of a file, of `name` in it where it is a directory; and the path of the file.
///
/// # Errors
/// When there is no such file, or it can't be read, or is too large.
pub fn read_file(path: &Path, name: &'static str) -> Result<(PathBuf, Vec<u8>), ReadError> {
    let file = if path.is_dir() {
        path.join(name)
    } else {
        path.to_owned()
    };
    if !file.exists() {
        return Err(match path.is_dir() {
            true => ReadError::Without {
                path: path.to_owned(),
                name,
            },
            false => ReadError::Missing(path.to_owned()),
        });
    }
    let mut bytes = Vec::new();
    let read =
        File::open(&file).and_then(|opened| opened.take(LARGEST + 1).read_to_end(&mut bytes));
    match read {
        Err(source) => Err(ReadError::Unreadable { path: file, source }),
        Ok(size) if size as u64 > LARGEST => Err(ReadError::TooLarge(file)),
        Ok(_) => Ok((file, bytes)),
    }
}

impl Table {
    /// Reads a table, of `results.csv` in it where `path` is a directory.
    ///
    /// # Errors
    /// When it is none.
    pub fn read(path: &Path) -> Result<Table, ReadError> {
        let (path, bytes) = read_file(path, "results.csv")?;
        Table::parse(path, &bytes)
    }

    fn parse(path: PathBuf, bytes: &[u8]) -> Result<Table, ReadError> {
        let text = std::str::from_utf8(bytes).map_err(|fault| not_text(&path, fault))?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim().is_empty() {
            return Err(ReadError::Empty(path));
        }
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .from_reader(text.as_bytes());
        let header = reader.headers().map_err(|fault| not_text(&path, fault))?;
        let mut columns: Vec<ReadColumn> = header.iter().map(column).collect();
        number(&mut columns);
        if let [only] = &columns[..]
            && let Some(separator) = [';', '\t']
                .into_iter()
                .find(|separator| only.label().contains(*separator))
        {
            return Err(ReadError::Separator { path, separator });
        }
        if columns.iter().all(|column| column.unit.is_empty()) {
            return Err(ReadError::NoHeader(path));
        }
        for record in reader.records() {
            let record = record.map_err(|fault| not_text(&path, fault))?;
            let line = record.position().map_or(0, csv::Position::line);
            if record.len() != columns.len() {
                return Err(ReadError::Ragged {
                    path,
                    line,
                    cells: record.len(),
                    columns: columns.len(),
                });
            }
            for (column, cell) in columns.iter_mut().zip(&record) {
                column.push(cell.trim(), line);
            }
        }
        Ok(Table { path, columns })
    }

    /// Puts another table's rows among its own, both by time, where the two have the same columns and nothing but numbers; of
    /// the same instant the others come last.
    pub fn insert(&mut self, others: &Table) {
        let is_same = self.columns.len() == others.columns.len()
            && self
                .columns
                .iter()
                .zip(&others.columns)
                .all(|(own, other)| {
                    own.name == other.name
                        && own.unit == other.unit
                        && own.odd.is_none()
                        && other.odd.is_none()
                });
        let (Some(times), Some(between)) = (self.column(TIME), others.column(TIME)) else {
            return;
        };
        if !is_same || others.is_empty() {
            return;
        }
        // Rows of this table, and of the other one, in the order of the result.
        let mut order: Vec<(bool, usize)> = Vec::with_capacity(self.len() + others.len());
        let mut next = 0;
        for (row, time) in times.values.iter().enumerate() {
            while between.values.get(next).is_some_and(|other| other < time) {
                order.push((true, next));
                next += 1;
            }
            order.push((false, row));
        }
        order.extend((next..others.len()).map(|row| (true, row)));
        for (column, other) in self.columns.iter_mut().zip(&others.columns) {
            let value = |&(is_other, row): &(bool, usize)| {
                if is_other {
                    other.values[row]
                } else {
                    column.values[row]
                }
            };
            column.values = order.iter().map(value).collect();
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The column of that name, given with or without its `[unit]`; blanks around it count only where they tell two apart.
    pub fn column(&self, name: &str) -> Option<&ReadColumn> {
        let exact = self
            .columns
            .iter()
            .find(|column| column.name == name || column.label() == name);
        let is_near = |column: &&ReadColumn| {
            column.name.trim() == name.trim() || column.label().trim() == name.trim()
        };
        exact.or_else(|| self.columns.iter().find(is_near))
    }

    /// The values of a column.
    ///
    /// # Errors
    /// When it has a cell that is no number.
    pub fn values<'a>(&self, column: &'a ReadColumn) -> Result<&'a [f64], ReadError> {
        match &column.odd {
            None => Ok(&column.values),
            Some((line, cell)) => Err(ReadError::NotANumber {
                path: self.path.clone(),
                line: *line,
                column: column.label(),
                cell: cell.chars().take(40).collect(),
            }),
        }
    }
}

/// The fault of a file that is no text.
fn not_text(path: &Path, fault: impl std::error::Error + Send + Sync + 'static) -> ReadError {
    ReadError::NotText {
        path: path.to_owned(),
        source: Box::new(fault),
    }
}

/// `name[unit]`, split.
fn column(header: &str) -> ReadColumn {
    let header = name_of(header);
    let split = header
        .trim_end()
        .strip_suffix(']')
        .and_then(|rest| rest.rsplit_once('['));
    let (name, unit) = split.unwrap_or((header, ""));
    ReadColumn::new(name, unit, Vec::new())
}

/// Gives owners of one kind their numbers, in the order of the columns.
fn number(columns: &mut [ReadColumn]) {
    let mut known: HashMap<(Discriminant<Channel>, &str), usize> = HashMap::new();
    let mut owners: HashMap<Discriminant<Channel>, usize> = HashMap::new();
    for column in columns {
        let Some(channel) = &mut column.channel else {
            continue;
        };
        let kind = discriminant(channel);
        let next = owners.entry(kind).or_default();
        let number = *known.entry((kind, &column.owner)).or_insert_with(|| {
            *next += 1;
            *next - 1
        });
        *channel = channel.with_owner(number);
    }
}

impl ReadColumn {
    fn push(&mut self, cell: &str, line: u64) {
        let value = if cell.is_empty() {
            Ok(f64::NAN)
        } else {
            cell.parse()
        };
        if value.is_err() && self.odd.is_none() {
            self.odd = Some((line, cell.to_string()));
        }
        self.values.push(value.unwrap_or(f64::NAN));
    }
}

#[cfg(test)]
mod tests {
    use super::super::{BodyQuantity, Column, DriverQuantity, JointQuantity, Trajectory};
    use super::*;

    fn parse(text: &str) -> Result<Table, String> {
        Table::parse("r.csv".into(), text.as_bytes()).map_err(|error| error.to_string())
    }

    #[test]
    fn what_is_written_is_read() {
        let mut table = Trajectory::new(vec![
            Column::new("time", "s"),
            Column::new("6\" bar, \"x\"\n🔒.x", "m"),
        ]);
        table.push_row(&[0.0, f64::NAN]);
        table.push_row(&[1.0 / 3.0, -5e-324]);
        let mut text = Vec::new();
        super::super::csv::write(&table, &mut text).expect("memory takes it");
        let read = Table::parse("r.csv".into(), &text).expect("sound");
        for (column, written) in read.columns.iter().zip(table.columns.iter()) {
            assert_eq!(
                (column.name.as_str(), column.unit.as_str()),
                (written.name.as_str(), written.unit)
            );
        }
        assert!(read.columns[1].values[0].is_nan());
        assert_eq!(
            (read.columns[0].values[1], read.columns[1].values[1]),
            (1.0 / 3.0, -5e-324)
        );
        assert!(
            read.column("time").is_some()
                && read.column("time[s]").is_some()
                && read.column("time[ms]").is_none()
        );
    }

    #[test]
    fn names_are_read_once_with_their_owners() {
        let header = "time[s],b.x[m],b.y[m],a.x[m],joint.b.fx[N],driver.m.value[rad],else[m]\n";
        let table = parse(&format!("{header}0,0,0,0,0,0,0\n")).expect("sound");
        let of = |index: usize| {
            let column = &table.columns[index];
            (column.channel, column.owner.as_str())
        };
        assert_eq!(of(0), (Some(Channel::Time), ""));
        assert_eq!(of(2), (Some(Channel::Body(0, BodyQuantity::Y)), "b"));
        assert_eq!(of(3), (Some(Channel::Body(1, BodyQuantity::X)), "a"));
        assert_eq!(of(4), (Some(Channel::Joint(0, JointQuantity::Fx)), "b"));
        assert_eq!(
            of(5),
            (Some(Channel::Driver(0, DriverQuantity::Value)), "m")
        );
        assert_eq!(of(6), (None, ""));
    }

    #[test]
    fn rows_of_another_table_go_between_by_time() {
        let mut table = parse("time[s],a.x[m]\n0,1\n1,2\n").expect("sound");
        table.insert(&parse("time[s],a.x[m]\n0,3\n0.5,\n2,4\n").expect("sound"));
        assert_eq!(table.columns[0].values, [0.0, 0.0, 0.5, 1.0, 2.0]);
        assert_eq!(table.columns[1].values[..2], [1.0, 3.0]);
        assert!(table.columns[1].values[2].is_nan() && table.columns[1].values[3..] == [2.0, 4.0]);
        for strange in [
            "time[s],a.x[mm]\n0.5,3\n",
            "time[s]\n0.5\n",
            "time[s],a.x[m]\n0.5,word\n",
        ] {
            table.insert(&parse(strange).expect("a table"));
            assert_eq!(table.len(), 5, "{strange}");
        }
    }

    #[test]
    fn what_is_no_table_is_refused_with_the_reason() {
        for (text, said) in [
            ("", "r.csv: the file is empty"),
            ("\n \n", "r.csv: the file is empty"),
            (
                "a,b\n1,2\n",
                "r.csv: not a table of results: its first line names no column as name[unit]",
            ),
            (
                "time[s];x[m]\n0,5;1\n",
                "r.csv: its columns are separated by ';': commas are wanted, and points in numbers",
            ),
            (
                "time[s]\tx[m]\n0\t1\n",
                "r.csv: its columns are separated by '\\t': commas are wanted, and points in numbers",
            ),
            (
                "a[m],b\n1,2\n1\n",
                "r.csv: line 3 has 1 cells, the header has 2",
            ),
        ] {
            assert_eq!(parse(text), Err(said.to_string()));
        }
        let spaced = parse("time[s], x [m] , y\n0,1,2\n").expect("blanks do no harm");
        assert!(
            ["x", " x", "x [m]", "y"]
                .iter()
                .all(|name| spaced.column(name).is_some()),
            "{spaced:?}"
        );
        assert_eq!(
            (spaced.columns[1].unit.as_str(), spaced.column("z")),
            ("m", None)
        );
        let fault = Table::parse("r.csv".into(), &[0xff]).expect_err("no text");
        let cause = std::error::Error::source(&fault).expect("a cause");
        assert!(cause.to_string().contains("utf-8"), "{cause}");
        let table = parse("t[s],what[m]\n0,1\n1,none\n").expect("only one column is odd");
        assert!(table.values(&table.columns[0]).is_ok());
        let said = table
            .values(&table.columns[1])
            .expect_err("a word")
            .to_string();
        assert_eq!(
            said,
            "r.csv: line 3: \"none\" in column \"what[m]\" is not a number"
        );
    }
}
