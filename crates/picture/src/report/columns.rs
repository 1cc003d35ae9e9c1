//! The columns of a page, and what each is worth when room is short.

use serde_json::{Value, json};

use super::encode::{Source, Worth};
use crate::cut::{self, Cut};
use crate::html::escaped;
use linkdyn_output::{
    BodyQuantity, Channel, Column, ColumnId, ColumnView, DriverQuantity, PointQuantity, Trajectory,
};

/// `[name, unit, wanted]`.
pub fn heading(source: &Source) -> String {
    let Column { name, unit, .. } = source.column;
    escaped(&json!([name, unit, u8::from(source.wanted)]).to_string())
}

/// All columns there are, with what they are worth: those of a table, of which some are shown, and derived ones.
pub fn sources<'a>(
    shown: &Trajectory,
    table: &'a Trajectory,
    derived: Option<&'a Trajectory>,
) -> Vec<Source<'a>> {
    let chosen = shown.width() < table.width();
    // The columns shown are a subsequence of all.
    let mut next = 0;
    let results = table.columns.iter().enumerate().map(|(index, column)| {
        let wanted = shown.columns.get(next) == Some(column);
        next += usize::from(wanted);
        let worth = if chosen && wanted {
            Worth::Asked
        } else {
            worth(column.channel)
        };
        Source {
            column,
            table,
            index,
            worth,
            wanted,
        }
    });
    let derived = derived.into_iter().flat_map(|table| {
        let columns = table.columns.iter().enumerate();
        columns.map(move |(index, column)| Source {
            column,
            table,
            index,
            worth: Worth::Overall,
            wanted: true,
        })
    });
    results.chain(derived).collect()
}

/// Columns with peaks beyond these have no cut of their own: a page of so many is about something else.
const MOST_CUTS: usize = 1000;

/// The values of a column, all rows of it.
fn values<'a>(source: &Source<'a>) -> ColumnView<'a> {
    source.table.column(ColumnId::at(source.index))
}

/// Where the axes of columns are cut, by name: of those that the page offers, and of the magnitudes that it makes of components.
pub fn cuts(sources: &[Source]) -> Value {
    let offered = sources.iter().filter(|source| source.wanted);
    let own = offered.clone().map(|source| {
        let cut = Cut::of(values(source).iter());
        (source.column.name.clone(), cut)
    });
    let pairs = sources.windows(2).filter(|pair| {
        pair.iter().all(|source| source.wanted)
            && pair[0].column.name.strip_suffix("fx") == pair[1].column.name.strip_suffix("fy")
            && pair[0].column.name.ends_with(".fx")
    });
    let magnitudes = pairs.map(|pair| {
        let name = pair[0].column.name.trim_end_matches('x').to_string();
        let [fx, fy] = [&pair[0], &pair[1]].map(values);
        (
            name,
            Cut::of(fx.iter().zip(fy.iter()).map(|(x, y)| x.hypot(y))),
        )
    });
    let found = own
        .chain(magnitudes)
        .filter_map(|(name, cut)| Some((name, cut?)));
    cut::to_json(found.take(MOST_CUTS))
}

/// What a column is worth by what it is.
fn worth(channel: Option<Channel>) -> Worth {
    match channel {
        Some(Channel::Time | Channel::Driver(_, DriverQuantity::Value)) => Worth::Asked,
        Some(Channel::Body(_, BodyQuantity::X | BodyQuantity::Y | BodyQuantity::Angle)) => {
            Worth::Pose
        }
        Some(
            Channel::Body(_, BodyQuantity::Vx | BodyQuantity::Vy | BodyQuantity::Omega)
            | Channel::Point(_, PointQuantity::Vx | PointQuantity::Vy),
        ) => Worth::Velocity,
        Some(
            Channel::Body(_, BodyQuantity::Ax | BodyQuantity::Ay | BodyQuantity::Alpha)
            | Channel::Point(_, PointQuantity::Ax | PointQuantity::Ay),
        ) => Worth::Acceleration,
        Some(Channel::Joint(..) | Channel::Relative(..)) => Worth::Joint,
        Some(
            Channel::Point(_, PointQuantity::X | PointQuantity::Y)
            | Channel::Driver(_, DriverQuantity::Effort)
            | Channel::Energy(_)
            | Channel::Load(..)
            | Channel::Shaking(_)
            | Channel::Transmission(_)
            | Channel::State(..)
            | Channel::Measure(..)
            | Channel::Output(_),
        )
        | None => Worth::Overall,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_output::JointQuantity;

    #[test]
    fn columns_are_worth_what_they_show() {
        for (channel, expected) in [
            (Channel::Time, Worth::Asked),
            (Channel::Body(0, BodyQuantity::X), Worth::Pose),
            (Channel::Point(0, PointQuantity::X), Worth::Overall),
            (Channel::Joint(0, JointQuantity::Fx), Worth::Joint),
            (Channel::Joint(0, JointQuantity::Penetration), Worth::Joint),
            (Channel::Driver(0, DriverQuantity::Value), Worth::Asked),
            (Channel::Body(0, BodyQuantity::Alpha), Worth::Acceleration),
        ] {
            assert_eq!(worth(Some(channel)), expected, "{channel:?}");
        }
    }
}
