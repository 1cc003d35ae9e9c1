//! The columns of a page, and what each is worth when room is short.

use serde_json::{Value, json};

use super::encode::{Source, Worth};
use crate::cut::{self, Cut};
use crate::html::escaped;
use crate::numbers::evenly;
use linkdyn_output::{BodyQuantity, Channel, Column, DriverQuantity, PointQuantity, Trajectory};

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
    let columns = |table: &'a Trajectory| {
        let columns = table.columns.iter().enumerate();
        columns.zip(table.extreme_rows())
    };
    let results = columns(table).map(|((index, column), ends)| {
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
            ends,
            worth,
            wanted,
        }
    });
    let derived = derived.into_iter().flat_map(|table| {
        columns(table).map(move |((index, column), ends)| Source {
            column,
            table,
            index,
            ends,
            worth: Worth::Overall,
            wanted: true,
        })
    });
    results.chain(derived).collect()
}

/// Columns with peaks beyond these have no cut of their own: a page of so many is about something else.
const MOST_CUTS: usize = 1000;
/// Rows from which a cut is found, beside those with extremes: a bulk needs no more.
const SAMPLE: usize = 500;

/// Where the axes of columns are cut, by name: of those that the page offers, and of the magnitudes that it makes of components.
pub fn cuts(sources: &[Source]) -> Value {
    let rows = sources.first().map_or(0, |source| source.table.len());
    let sample = evenly(rows, SAMPLE);
    let is_part = sample.len() < rows;
    // Rows to look at of columns: the sample, and the extremes that it may lack.
    let looked_at = |columns: &[Source]| {
        let ends = columns.iter().filter(|_| is_part);
        let ends = ends.flat_map(|source| source.ends.into_iter().flatten());
        [sample.as_slice(), &ends.collect::<Vec<_>>()].concat()
    };
    let offered = sources.iter().filter(|source| source.wanted);
    let own = offered.map(|source| {
        let rows = looked_at(std::slice::from_ref(source));
        let cut = Cut::of(rows.into_iter().map(|row| source.value(row)));
        (source.column.name.clone(), cut)
    });
    let pairs = sources.windows(2).filter(|pair| {
        pair.iter().all(|source| source.wanted)
            && pair[0].column.name.strip_suffix("fx") == pair[1].column.name.strip_suffix("fy")
            && pair[0].column.name.ends_with(".fx")
    });
    let magnitudes = pairs.map(|pair| {
        let name = pair[0].column.name.trim_end_matches('x').to_string();
        let magnitude = |row| pair[0].value(row).hypot(pair[1].value(row));
        (name, Cut::of(looked_at(pair).into_iter().map(magnitude)))
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
            | Channel::Section(..)
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
    fn a_single_peak_among_many_rows_is_cut() {
        let names = ["a.x", "joint.a.fx", "joint.a.fy"];
        let columns = names.iter().map(|&name| Column::new(name, "N"));
        let mut table = Trajectory::new(columns.collect());
        for row in 0..10 * SAMPLE {
            let wave = (0.1 * row as f64).sin();
            // In no row of the sample.
            let peak = if row == 1235 { 1e6 } else { wave };
            table.push_row(&[wave, 1.0, peak]);
        }
        let cuts = cuts(&sources(&table, &table, None));
        assert!(cuts["a.x"].is_null(), "{cuts}");
        for name in ["joint.a.fy", "joint.a.f"] {
            assert!(
                cuts[name][1].as_f64().is_some_and(|high| high < 4.0),
                "{cuts}"
            );
        }
    }

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
