//! Tables in files beside the model: their points are put into the model once, when it is read.
//!
//! A file has a line per point, with numbers between commas, semicolons or tabs. Its first line may name the columns, each with a
//! unit in brackets: `angle [deg],pressure [bar]`. Lines that begin with # are remarks.

use serde_json::Number;

use super::error::Complaint;
use super::file_access::{FileAccess, Refusal, plainly};
use super::node::{Kind, Member, Node, Origin, excerpt, join};
use super::source::Source;
use super::table::{self, MOST_POINTS};

/// Where tables stand.
const MAPS: [&str; 3] = ["tables", "drivers", "forces"];

/// A fault at a place of the model.
struct FileFault {
    origin: Origin,
    found: String,
    complaint: Complaint,
}

/// Puts the points of all files that tables name into the model; what is wrong with files.
pub(super) fn put_in(source: &mut Source, access: &FileAccess) -> Vec<Complaint> {
    let mut faults = Vec::new();
    if let Kind::Object(members) = &mut source.root.kind {
        for map in MAPS {
            if let Some(member) = members.get_mut(map) {
                visit(&mut member.node, map, access, &mut faults);
            }
        }
    }
    let placed = faults.into_iter();
    placed
        .map(|fault| source.complain(fault.origin, Some(fault.found), fault.complaint))
        .collect()
}

fn visit(node: &mut Node, path: &str, access: &FileAccess, faults: &mut Vec<FileFault>) {
    match &mut node.kind {
        Kind::Array(items) => {
            // points are the longest lists, and have no tables inside
            if path.ends_with(".points") {
                return;
            }
            for (index, item) in items.iter_mut().enumerate() {
                visit(item, &format!("{path}[{index}]"), access, faults);
            }
        }
        Kind::Object(members) => {
            let named = members.get("file").and_then(|member| {
                let name = member.node.as_str()?.to_owned();
                Some((name, member.node.origin))
            });
            // a file with both is reported where its other keys are read
            if let Some((name, origin)) = named.filter(|_| !members.contains_key("points")) {
                if let Err((message, hint)) = replace(node, &name, origin, access) {
                    let complaint = Complaint::new(join(path, "file"), message);
                    faults.push(FileFault {
                        origin,
                        found: format!("{:?}", excerpt(&name)),
                        complaint: Complaint { hint, ..complaint },
                    });
                }
                return;
            }
            for (key, member) in members.iter_mut() {
                visit(&mut member.node, &join(path, key), access, faults);
            }
        }
        Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::String(_) => {}
    }
}

/// Puts the points of a file in the place of its name.
fn replace(
    node: &mut Node,
    name: &str,
    origin: Origin,
    access: &FileAccess,
) -> Result<(), Refusal> {
    let Kind::Object(members) = &mut node.kind else {
        return Ok(());
    };
    let columns = pair_of(members.get("columns").map(|member| &member.node));
    let written = pair_of(members.get("units").map(|member| &member.node));
    let text = access.read(name)?;
    let table = FileTable::of(&text, columns)?;
    let units = match (written, table.units) {
        (Some(units), _) => units.map(Some),
        (None, units) => known(units)?,
    };
    let is_motion = members.contains_key("type");
    let of = |kind: Kind| Node { kind, origin };
    let number = |column: usize, value: f64| match (&units[column], is_motion) {
        (Some(unit), true) => of(Kind::String(format!("{value:?} {unit}"))),
        _ => of(Number::from_f64(value).map_or(Kind::Null, Kind::Number)),
    };
    let points = table.points.iter();
    let points =
        points.map(|point| of(Kind::Array(vec![number(0, point[0]), number(1, point[1])])));
    let points = of(Kind::Array(points.collect()));
    let place = members.get_index_of("file").unwrap_or_default();
    members.shift_remove("columns");
    let place = place.min(members.len().saturating_sub(1));
    members.shift_remove("file");
    let member = |node: Node| Member { key: origin, node };
    members.shift_insert(
        place.min(members.len()),
        "points".to_owned(),
        member(points),
    );
    if is_motion {
        members.shift_remove("units");
    } else if units.iter().any(Option::is_some) && !members.contains_key("units") {
        let units = units.map(|unit| of(Kind::String(unit.unwrap_or_default())));
        let units = member(of(Kind::Array(units.to_vec())));
        members.shift_insert((place + 1).min(members.len()), "units".to_owned(), units);
    }
    Ok(())
}

/// Units that a file names: one that is none is not told, as the rest of the file is not.
fn known(units: [Option<String>; 2]) -> Result<[Option<String>; 2], Refusal> {
    let is_bad =
        |unit: &Option<String>| unit.as_ref().is_some_and(|unit| table::unit(unit).is_err());
    match units.iter().position(is_bad) {
        Some(place) => {
            let which = ["first", "second"][place];
            let hint = "say both with \"units\"".to_owned();
            let message =
                format!("the first line of the file has no known unit for the {which} column");
            Err((message, Some(hint)))
        }
        None => Ok(units),
    }
}

/// Two texts.
fn pair_of(node: Option<&Node>) -> Option<[String; 2]> {
    let Kind::Array(items) = &node?.kind else {
        return None;
    };
    let [first, second] = items.as_slice() else {
        return None;
    };
    Some([first.as_str()?.to_owned(), second.as_str()?.to_owned()])
}

/// What a file holds.
#[derive(Debug, PartialEq)]
struct FileTable {
    points: Vec<[f64; 2]>,
    units: [Option<String>; 2],
}

impl FileTable {
    /// Of a text, by the names of its columns.
    fn of(text: &str, columns: Option<[String; 2]>) -> Result<FileTable, Refusal> {
        let lines = text
            .lines()
            .enumerate()
            .map(|(index, line)| (index + 1, line));
        let mut lines = lines
            .filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'))
            .peekable();
        let Some(&(_, first)) = lines.peek() else {
            return Err(plainly("the file is empty"));
        };
        let sign = ['\t', ';'].into_iter().find(|sign| first.contains(*sign));
        let sign = sign.unwrap_or(',');
        let head: Vec<Head> = first.split(sign).map(Head::of).collect();
        let is_head = first.split(sign).any(|cell| number(cell).is_none());
        let ((x, y), units) = match (is_head, columns) {
            (true, Some(names)) => {
                lines.next();
                let [x, y] = [find(&head, &names[0])?, find(&head, &names[1])?];
                ((x, y), [x, y].map(|index| head[index].unit.clone()))
            }
            (true, None) => {
                lines.next();
                let unit = |index: usize| head.get(index).and_then(|head| head.unit.clone());
                ((0, 1), [unit(0), unit(1)])
            }
            (false, None) => ((0, 1), [None, None]),
            (false, Some(_)) => {
                let hint = "leave out \"columns\": then the first two count";
                let message = "the first line of the file does not name its columns";
                return Err((message.to_owned(), Some(hint.to_owned())));
            }
        };
        let mut points: Vec<[f64; 2]> = Vec::new();
        for (line, text) in lines {
            let cells: Vec<&str> = text.split(sign).collect();
            let cell = |index: usize| {
                let Some(cell) = cells.get(index) else {
                    let message = format!("line {line} has no column {}", index + 1);
                    return Err(plainly(message));
                };
                number(cell).ok_or_else(|| {
                    let column = index + 1;
                    let message = format!("line {line}, column {column}: this is no number");
                    let hint = cell
                        .contains(',')
                        .then(|| "a decimal point is a point".to_owned());
                    (message, hint)
                })
            };
            let point = [cell(x)?, cell(y)?];
            if points.last().is_some_and(|before| point[0] <= before[0]) {
                let message = format!("line {line}: its place is not beyond the one before it");
                let hint = "the places of a table increase";
                return Err((message, Some(hint.to_owned())));
            }
            points.push(point);
            if points.len() > MOST_POINTS {
                return Err(plainly(format!("a table has at most {MOST_POINTS} points")));
            }
        }
        match points.len() {
            0 | 1 => {
                let message = format!(
                    "a table has at least 2 points, this file has {}",
                    points.len()
                );
                Err(plainly(message))
            }
            _ => Ok(FileTable { points, units }),
        }
    }
}

/// The name of a column, and its unit.
struct Head {
    whole: String,
    name: String,
    unit: Option<String>,
}

impl Head {
    fn of(cell: &str) -> Head {
        let whole = cell.trim().trim_matches('"').trim().to_owned();
        let parts = whole
            .strip_suffix(']')
            .and_then(|rest| rest.rsplit_once('['));
        let parts = parts.map(|(name, unit)| (name.trim().to_owned(), unit.trim().to_owned()));
        let (name, unit) = match parts {
            Some((name, unit)) => (name, Some(unit)),
            None => (whole.clone(), None),
        };
        Head { whole, name, unit }
    }
}

fn find(head: &[Head], name: &str) -> Result<usize, Refusal> {
    let is_it = |head: &Head| head.whole == name.trim() || head.name == name.trim();
    head.iter().position(is_it).ok_or_else(|| {
        let hint = format!("its first line names {} columns", head.len());
        (format!("the file has no column {name:?}"), Some(hint))
    })
}

fn number(cell: &str) -> Option<f64> {
    let value: f64 = cell.trim().trim_matches('"').trim().parse().ok()?;
    value.is_finite().then_some(value)
}
