//! Tables of formulas: places that increase, periods that close.

use super::Rules;
use crate::expression::is_function;
use crate::motion::Interpolation;
use crate::table::{MOST_POINTS, Table, is_end};
use crate::{Formula, Value};

/// All rules of tables.
pub(super) fn tables(rules: &mut Rules<'_>) {
    let model = rules.model;
    for (name, own) in &model.tables {
        let path = format!("tables.{name}");
        if is_function(name) {
            let message = format!("{name:?} is a function already");
            rules.complain(&path, message, "give the table another name");
        } else if !is_word(name) && !rules.holes.has_key(&path) {
            let message = format!("{name:?} can't be called in a formula");
            let hint = "letters, digits and _, a letter first";
            rules.complain(&path, message, hint);
        }
        table(rules, own, &path);
    }
    for (name, force) in &model.forces {
        for (key, value, wanted) in force.kind.values() {
            if let Value::Formula(Formula {
                table: Some(own), ..
            }) = value
                && wanted.is_some()
            {
                table(rules, own, &format!("forces.{name}.{key}"));
            }
        }
    }
}

fn is_word(name: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    name.chars().all(is_part) && name.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

fn table(rules: &mut Rules<'_>, table: &Table, path: &str) {
    if rules.holes.has(path) {
        return;
    }
    if let Err(complaint) = table.columns() {
        let path = format!("{path}.units");
        rules
            .complaints
            .push(crate::error::Complaint { path, ..complaint });
    }
    let count = table.points.len();
    let at = format!("{path}.points");
    if !(2..=MOST_POINTS).contains(&count) {
        let message = format!("a table has 2 to {MOST_POINTS} points, this one has {count}");
        return rules.complain(
            at,
            message,
            "as in [[\"0 deg\", \"30 bar\"], [\"90 deg\", \"5 bar\"]]",
        );
    }
    let place = |index: usize, column: usize| format!("{at}[{index}][{column}]");
    for (index, point) in table.points.iter().enumerate() {
        if let Some(column) = point.iter().position(|number| !number.is_finite()) {
            return rules.complain(place(index, column), "a finite number is expected", "in SI");
        }
    }
    let pairs = table.points.windows(2);
    if let Some(index) = pairs.into_iter().position(|pair| pair[1][0] <= pair[0][0]) {
        let message = "the place is not beyond that of the point before";
        return rules.complain(
            place(index + 1, 0),
            message,
            "the places of a table increase",
        );
    }
    repeats(rules, table, path);
}

/// A table that repeats ends as it begins.
fn repeats(rules: &mut Rules<'_>, table: &Table, path: &str) {
    let last = table.points.len() - 1;
    let ([begin, first], [end, value]) = (table.points[0], table.points[last]);
    if let Some(period) = table.period {
        let at = format!("{path}.period");
        if !(period.is_finite() && period > 0.0) {
            return rules.complain(
                at,
                "must be greater than 0",
                "after which the table repeats",
            );
        }
        if table.interpolation == Interpolation::Natural {
            let message = "a natural spline has ends, and does not repeat";
            let at = format!("{path}.interpolation");
            return rules.complain(at, message, "\"periodic\" is the spline that does");
        }
        if end > begin + period && !is_end(end, begin + period, period) {
            let message = "the points go further than one period";
            return rules.complain(at, message, "leave out those that come again");
        }
    }
    let closes = table
        .repeats()
        .is_some_and(|period| is_end(end, begin + period, period));
    if closes && first != value {
        let message = "the last value of a table that repeats is not its first";
        let hint = "the last point is the first one of the next period";
        rules.complain(format!("{path}.points[{last}][1]"), message, hint);
    }
}
