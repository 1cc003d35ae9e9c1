//! Tables: points whose entries bring their units, or are plain numbers in that of their column.

use crate::tree::Tree;

use super::Walk;
use crate::Formula;
use crate::dimension::{Dimension, Powers};
use crate::error::Complaint;
use crate::expression::{Misfit, Quantity, is_expression};
use crate::motion::Interpolation;
use crate::node::{Kind, Node, join, members};
use crate::shape::Object;
use crate::table::{MOST_POINTS, Table, unit};
use crate::units::{Unit, split_quantity, with_decimal_point};
use crate::words;

/// A column of a table.
#[derive(Debug, Clone, Copy)]
pub(super) struct EntryColumn {
    /// Its dimension.
    pub powers: Powers,
    /// The unit of plain numbers; `None` if these are not known to be anything but zero.
    pub plain: Option<Unit>,
}

impl Walk<'_> {
    /// Reads the tables, which formulas anywhere may call.
    pub(super) fn read_tables(&mut self, node: Option<&Node>) {
        for (name, member) in members(node).filter(|(_, one)| one.node.as_str().is_none()) {
            let path = join("tables", name);
            let table = self.points_of(&member.node, words::object("Table"), &path, [None; 2]);
            if self.parameters.has(name) {
                let message = format!("there is a parameter {name:?}, too");
                let complaint = Complaint::new(path, message);
                self.complain_key(
                    member.key,
                    name,
                    complaint.hint("give one of them another name"),
                );
            }
            self.tables.push((name.clone(), table, false));
        }
    }

    /// Whether a formula can't be read as long as a table, an input or a state has a fault.
    pub(super) fn has_faulty_function(&self) -> bool {
        let states = self.states.iter().any(|one| one.state.is_none());
        let inputs = self.inputs.iter().any(|(_, input)| input.is_none());
        states || inputs || self.tables.iter().any(|(_, table, _)| table.is_none())
    }

    /// A warning per table that no formula calls.
    pub(super) fn idle_tables(&self) -> Vec<String> {
        let idle = self.tables.iter().filter(|(.., is_used)| !is_used);
        let said = idle.map(|(name, ..)| {
            let complaint = Complaint::new(join("tables", name), "no formula calls this table");
            self.source.place(complaint).to_string()
        });
        said.collect()
    }

    /// A table that was read before.
    pub(super) fn curve(&mut self, node: &Node, path: &str) -> Option<Tree> {
        let known = path.strip_prefix("tables.").and_then(|name| {
            let mut tables = self.tables.iter();
            tables.find(|(known, ..)| known == name)
        });
        let table = match known {
            Some((_, table, _)) => table.clone()?,
            // a printer looks at one alone
            None => self.points_of(node, words::object("Table"), path, [None; 2])?,
        };
        Some(Tree::of(&table))
    }

    /// A table over what moves, as a formula; its fault is reported.
    pub(super) fn table_of(&mut self, node: &Node, wanted: Dimension, path: &str) -> Option<Tree> {
        let of = node.get("of")?;
        let before = self.faults();
        let read = match of.as_str() {
            None => None,
            Some(text) => {
                let text = format!("={}", text.trim().trim_start_matches('='));
                match self.moving(&text) {
                    Ok(read) => read.map(|read| (text, read)),
                    Err(_) if self.has_faulty_function() => None,
                    Err(Misfit { fault, .. }) => {
                        self.complain(of, fault.at(join(path, "of")));
                        None
                    }
                }
            }
        };
        let plain = |dimension: Option<Dimension>| {
            dimension.map(|dimension| {
                (
                    dimension.powers(),
                    self.units().derivative(dimension, 0).plain,
                )
            })
        };
        let places = read
            .as_ref()
            .and_then(|(_, (moving, _))| moving.quantity.dimension());
        let plain = [plain(places), plain(Some(wanted))];
        let table = self.points_of(node, words::object("TableOf"), path, plain);
        let ((text, (moving, constants)), table) = read.zip(table)?;
        if !moving.has_arguments() {
            let complaint = Complaint::new(join(path, "of"), "nothing moves here");
            self.complain(of, complaint.hint("as in \"of\": \"crank.angle\""));
            return None;
        }
        let [x, y] = table.columns().ok()?;
        if !moving.fits(x) {
            let places = Quantity::si(0.0, x).words();
            let message = format!(
                "this is {}, where the places of the table are {places}",
                moving.quantity.words()
            );
            self.complain(of, Complaint::new(join(path, "of"), message));
        }
        let gives = Quantity::si(0.0, y);
        if !gives.fits(wanted.powers()) {
            let place = crate::expression::with_article(wanted.name(), wanted.si());
            let message = format!("the table gives {}, where {place} is wanted", gives.words());
            self.complain(node, Complaint::new(path, message));
        }
        if self.faults() > before {
            return None;
        }
        let parameters = self.constants(constants, path);
        Some(Tree::of(&Formula {
            formula: text,
            parameters,
            table: Some(table),
        }))
    }

    /// How many faults there are so far.
    pub(super) fn faults(&self) -> usize {
        self.complaints.len() + self.more
    }

    /// The points of an object; `plain` are dimension and unit of plain numbers where the columns say none.
    fn points_of(
        &mut self,
        node: &Node,
        object: &Object,
        path: &str,
        plain: [Option<(Powers, Unit)>; 2],
    ) -> Option<Table> {
        let before = self.faults();
        self.object(node, object, None, path, super::Driven::Nothing)?;
        let points = node
            .get("points")
            .map(|points| (points, join(path, "points")));
        let (points, at) = points?;
        let Kind::Array(items) = &points.kind else {
            self.complain(points, super::wrong_kind(&at, "a list", points));
            return None;
        };
        if items.len() > MOST_POINTS {
            let message = format!(
                "a table has at most {MOST_POINTS} points, this one has {}",
                items.len()
            );
            self.complain(points, Complaint::new(at, message));
            return None;
        }
        let columns = [0, 1].map(|index| {
            let unit = node.get("units").and_then(|units| units.entry(index));
            self.column(unit, items, index, (path, plain[index]))
        });
        let mut read = Vec::with_capacity(items.len());
        for (index, item) in items.iter().enumerate() {
            let here = format!("{at}[{index}]");
            let Kind::Array(pair) = &item.kind else {
                self.complain(item, super::wrong_kind(&here, "a list", item));
                continue;
            };
            let [x, y] = pair.as_slice() else {
                let message = crate::gate::length_fault(pair.len(), 2, true);
                self.complain(item, Complaint::new(here, message));
                continue;
            };
            let x = self.entry(x, columns[0], &format!("{here}[0]"));
            let y = self.entry(y, columns[1], &format!("{here}[1]"));
            read.extend(x.zip(y).map(|(x, y)| [x, y]));
        }
        let period = node
            .get("period")
            .map(|period| self.entry(period, columns[0], &join(path, "period")));
        let interpolation = match node.get("interpolation").and_then(Node::as_str) {
            None if period.is_some() => Interpolation::Periodic,
            None | Some("natural") => Interpolation::Natural,
            Some("linear") => Interpolation::Linear,
            Some("monotone") => Interpolation::Monotone,
            // others were told of
            Some(_) => Interpolation::Periodic,
        };
        let table = Table {
            points: read,
            units: columns.map(|column| Quantity::si(0.0, column.powers).unit()),
            interpolation,
            period: period.flatten(),
        };
        (self.faults() == before).then_some(table)
    }

    /// What a column is of: what its unit says, else the first entry that has one, else what is around the table.
    fn column(
        &mut self,
        written: Option<&Node>,
        items: &[Node],
        index: usize,
        (path, plain): (&str, Option<(Powers, Unit)>),
    ) -> EntryColumn {
        if let Some(node) = written
            && let Some(text) = node.as_str()
        {
            let read = unit(text).unwrap_or_else(|complaint| {
                let path = format!("{path}.units[{index}]");
                self.complain(node, Complaint { path, ..complaint });
                Unit::si(Powers::default())
            });
            let powers = read.powers;
            return EntryColumn {
                powers,
                plain: Some(read),
            };
        }
        let brought = items.iter().find_map(|item| {
            let text = item.entry(index)?.as_str()?;
            if is_expression(text) {
                let value = self.parameters.evaluate(text).ok()??;
                return value.whole_powers().filter(|_| !value.is_pure());
            }
            let (_, text) = split_quantity(text)?;
            Unit::parse(text).ok().map(|unit| unit.powers)
        });
        match (brought, plain) {
            (Some(powers), _) => EntryColumn {
                powers,
                plain: None,
            },
            (None, Some((powers, unit))) => EntryColumn {
                powers,
                plain: Some(unit),
            },
            (None, None) => {
                let powers = Powers::default();
                EntryColumn {
                    powers,
                    plain: Some(Unit::si(powers)),
                }
            }
        }
    }

    /// A number of a column, in SI.
    pub(super) fn entry(&mut self, node: &Node, column: EntryColumn, path: &str) -> Option<f64> {
        let read = match &node.kind {
            Kind::Number(number) => self.plain_entry(&number.to_string(), column),
            Kind::String(text) if is_expression(text) => {
                let value = self.expression(node, text, path)?;
                let pure = value.is_pure();
                let factor = column
                    .plain
                    .filter(|_| pure)
                    .map_or(1.0, |unit| unit.to_si("1"));
                self.record(text, path, || factor);
                match (pure, value.fits(column.powers)) {
                    (true, _) => self.plain_entry(&value.value.to_string(), column),
                    (false, true) => Ok(value.value),
                    (false, false) => Err(wanted(&value.words(), column)),
                }
            }
            Kind::String(text) => text_entry(text, column),
            Kind::Null | Kind::Bool(_) | Kind::Array(_) | Kind::Object(_) => {
                self.complain(node, super::wrong_kind(path, "a number", node));
                return None;
            }
        };
        let finite = |value: f64| match value.is_finite() {
            true => Ok(value),
            false => Err(Complaint::new("", "the number is too large for a double")),
        };
        read.and_then(finite)
            .map_err(|complaint| {
                let path = path.to_owned();
                self.complain(node, Complaint { path, ..complaint });
            })
            .ok()
    }

    /// A plain number of a column; refused where that has no unit for it.
    fn plain_entry(&self, number: &str, column: EntryColumn) -> Result<f64, Complaint> {
        if let Some(unit) = column.plain {
            return Ok(unit.to_si(number));
        }
        let zero = number.parse().ok().filter(|number: &f64| *number == 0.0);
        zero.ok_or_else(|| {
            let place = Quantity::si(0.0, column.powers).words();
            let message =
                format!("a plain number, where {place} is wanted as in the other entries");
            Complaint::new("", message).hint("give it a unit, or the column one by \"units\"")
        })
    }
}

/// A number with its unit.
fn text_entry(text: &str, column: EntryColumn) -> Result<f64, Complaint> {
    if let Some(meant) = with_decimal_point(text) {
        let hint = format!("a decimal point is a point: {meant:?}");
        return Err(Complaint::new("", "a number has no comma").hint(hint));
    }
    let Some((number, own)) = split_quantity(text) else {
        let said = Complaint::new("", "this does not begin with a number");
        return Err(said.hint("a number, or text such as \"5 bar\""));
    };
    let own = unit(own)?;
    match column.powers.accepts(own.powers) {
        true => Ok(own.to_si(number)),
        false => Err(wanted(&Quantity::si(0.0, own.powers).words(), column)),
    }
}

/// Something else is wanted in a column.
fn wanted(found: &str, column: EntryColumn) -> Complaint {
    let place = Quantity::si(0.0, column.powers).words();
    Complaint::new("", format!("this is {found}, where {place} is wanted"))
}
