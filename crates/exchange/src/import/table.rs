//! Tables of points.
//!
//! ```text
//! body,point,x [mm],y [mm]        joint,x [mm],y [mm],bodies
//! ground,O,0,0                    O,0,0,ground crank
//! crank,O,0,0                     A,30,40,crank rod
//! ```
//!
//! A point that has one name and one place in several bodies is a pin of all of them.

use indexmap::IndexMap;
use linkdyn_model::GROUND;

use super::pins::{self, At};
use super::{Imported, length};
use crate::draft::{Draft, Entry};
use crate::source::{LeftOut, MOST_PARTS, Options, Refused};

/// More rows than that are no linkage that was drawn by hand.
const MOST_ROWS: usize = 5 * MOST_PARTS;

/// Reads a table.
pub(super) fn read(name: &str, text: &str, options: &Options) -> Result<Imported, Refused> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let header = reader.headers().map_err(|error| broken(&error))?.clone();
    let columns = Columns::of(&header)?;
    let unit = columns.unit.clone().or_else(|| options.length.clone());
    let mut imported = Imported::default();
    if unit.is_none() {
        imported.left_out.push(LeftOut {
            place: "line 1".into(),
            what: "a unit of length: m is taken; x [mm] in the header or --length mm says another"
                .into(),
        });
    }
    let draft = &mut imported.draft;
    *draft = Draft {
        name: pins::titled(name, "Points of a table"),
        source: "a table of points".into(),
        ..Draft::default()
    };
    draft
        .units
        .extend(unit.map(|unit| ("length".to_owned(), unit.into())));
    // Where each point stands in which bodies, in the order of the table.
    let mut points: IndexMap<&str, Vec<(String, At)>> = IndexMap::new();
    let mut bodies: IndexMap<&str, String> = IndexMap::new();
    let rows: Vec<csv::StringRecord> = reader
        .records()
        .take(MOST_ROWS + 1)
        .collect::<Result<_, _>>()
        .map_err(|error| broken(&error))?;
    if rows.len() > MOST_ROWS {
        let cause = format!("more than {MOST_ROWS} rows are too many for a linkage");
        return Err(Refused::new("", cause, "points that nothing joins can go"));
    }
    for row in &rows {
        let place = || format!("line {}", row.position().map_or(0, csv::Position::line));
        let at = [
            columns.number(row, columns.x, place)?,
            columns.number(row, columns.y, place)?,
        ];
        let point = &row[columns.point];
        let of: Vec<&str> = match columns.bodies {
            Bodies::One(column) => vec![&row[column]],
            Bodies::All(column) => row[column]
                .split([' ', ';', '|'])
                .filter(|body| !body.is_empty())
                .collect(),
        };
        if point.is_empty() || of.first().is_none_or(|body| body.is_empty()) {
            let cause = "a row needs the name of a point and of a body";
            return Err(Refused::new(place(), cause, "crank,A,30,40"));
        }
        for body in of {
            let named = bodies.entry(body).or_insert_with(|| match body {
                GROUND => GROUND.to_owned(),
                body => pins::body(draft, body, Entry::new()),
            });
            pins::point(draft, named, point, at);
            let there = points.entry(point).or_default();
            if there.iter().any(|(other, _)| other == named) {
                let cause = format!("{body} has two points \"{point}\"");
                return Err(Refused::new(
                    place(),
                    cause,
                    "give each point of a body its own name",
                ));
            }
            there.push((named.clone(), at));
        }
    }
    if bodies.is_empty() {
        return Err(Refused::new("", "the table has no rows", "crank,A,30,40"));
    }
    for (point, there) in points {
        let mut places: Vec<At> = Vec::new();
        for (_, at) in &there {
            if !places.contains(at) {
                places.push(*at);
            }
        }
        for place in &places {
            let mut meet: Vec<String> = there
                .iter()
                .filter(|(_, at)| at == place)
                .map(|(body, _)| body.clone())
                .collect();
            meet.sort_by_key(|body| body != GROUND);
            pins::pin(draft, point, &meet, *place);
        }
        if places.len() > 1 {
            imported.left_out.push(LeftOut {
                place: format!("point {point}"),
                what: "a pin between bodies where it stands at different places".into(),
            });
        }
    }
    pins::analysis(draft, None, false);
    Ok(imported)
}

fn broken(error: &csv::Error) -> Refused {
    let place = error
        .position()
        .map_or_else(String::new, |at| format!("line {}", at.line()));
    let cause = match error.kind() {
        csv::ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => format!("this row has {len} cells, and the header {expected_len}"),
        _ => error.to_string(),
    };
    Refused::new(
        place,
        cause,
        "separate cells by commas, and give each row all of them",
    )
}

/// Where the cells are.
struct Columns {
    point: usize,
    x: usize,
    y: usize,
    bodies: Bodies,
    unit: Option<String>,
}

enum Bodies {
    /// The body of a row's point.
    One(usize),
    /// All bodies that a row's pin joins.
    All(usize),
}

impl Columns {
    fn of(header: &csv::StringRecord) -> Result<Columns, Refused> {
        let parts = |cell: &str| -> (String, Option<String>) {
            match cell.strip_suffix(']').and_then(|cell| cell.split_once('[')) {
                Some((name, unit)) => (name.trim().to_lowercase(), Some(unit.trim().to_owned())),
                None => (cell.to_lowercase(), None),
            }
        };
        let cells: Vec<(String, Option<String>)> = header.iter().map(parts).collect();
        let find = |name: &str| cells.iter().position(|(cell, _)| cell == name);
        let (point, bodies) = match (find("body"), find("point"), find("joint"), find("bodies")) {
            (Some(body), Some(point), None, None) => (point, Bodies::One(body)),
            (None, None, Some(joint), Some(bodies)) => (joint, Bodies::All(bodies)),
            _ => return Err(Columns::unknown(header)),
        };
        let (Some(x), Some(y)) = (find("x"), find("y")) else {
            return Err(Columns::unknown(header));
        };
        if cells.len() != 4 {
            return Err(Columns::unknown(header));
        }
        if cells[x].1 != cells[y].1 {
            let cause = "x and y have different units";
            return Err(Refused::new("line 1", cause, "body,point,x [mm],y [mm]"));
        }
        if let Some(unit) = &cells[x].1 {
            length("line 1", unit)?;
        }
        Ok(Columns {
            point,
            x,
            y,
            bodies,
            unit: cells[x].1.clone(),
        })
    }

    fn unknown(header: &csv::StringRecord) -> Refused {
        let header: Vec<&str> = header.iter().collect();
        Refused::new(
            "line 1",
            format!("{:?} is no header of a table of points", header.join(",")),
            "body,point,x [mm],y [mm] or joint,x [mm],y [mm],bodies",
        )
    }

    fn number(
        &self,
        row: &csv::StringRecord,
        column: usize,
        place: impl Fn() -> String,
    ) -> Result<f64, Refused> {
        let text = &row[column];
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(Refused::new(
                place(),
                format!("{text:?} is no number"),
                "write coordinates as plain numbers, such as 12.5",
            )),
        }
    }
}
