//! Every symbol of a unit, and the names of units that are written out.

use std::sync::LazyLock;

use super::unit::Unit;
use crate::dimension::powers;

/// Lines of symbols, and of names.
fn rows() -> impl Iterator<Item = Vec<&'static str>> {
    let rows = include_str!("table.txt")
        .lines()
        .filter(|row| !row.starts_with('#'));
    rows.map(|row| row.split_whitespace().collect())
}

/// Every symbol.
pub static SYMBOLS: LazyLock<Vec<(&str, Unit)>> = LazyLock::new(|| {
    let unit = |row: Vec<&'static str>| {
        let [symbol, num, den, ten, pi, length, mass, time, angle] = row[..] else {
            return None;
        };
        let whole = |text: &str| text.parse::<i32>().ok();
        let unit = Unit {
            powers: powers(whole(length)?, whole(mass)?, whole(time)?, whole(angle)?),
            num: num.parse().ok()?,
            den: den.parse().ok()?,
            ten: whole(ten)?,
            pi: whole(pi)?,
        };
        Some((symbol, unit))
    };
    rows().filter_map(unit).collect()
});

/// The symbol of a unit that is written out, or the one most like this one.
pub fn nearest(symbol: &str) -> Option<&'static str> {
    let lower = symbol.to_lowercase();
    let singular = lower.strip_suffix('s').unwrap_or(&lower);
    let named = rows().find_map(|row| match row[..] {
        [name, meant] if name == lower || name == singular => Some(meant),
        _ => None,
    });
    named.or_else(|| crate::suggest::nearest(symbol, SYMBOLS.iter().map(|row| row.0)))
}
