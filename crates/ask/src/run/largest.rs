//! The largest efforts and forces of a run, and when they are. What has no bound, as reactions at a change point, has no largest
//! value: what rows beside it show depends on where they fall.

use crate::text::words::unit_words;
use crate::text::{number, shorten};
use linkdyn_output::{
    Channel, Column, ColumnId, DriverQuantity, JointQuantity, Report, Trajectory,
};

/// Digits of numbers.
const DIGITS: usize = 4;
/// Joints with the largest forces that are shown.
const FORCES: usize = 3;
/// Joints without bound that are named.
const NAMES: usize = 8;

/// A row per driver: smallest and largest effort, and when.
pub fn efforts(trajectory: &Trajectory, report: &Report) -> Vec<String> {
    let unbounded = report.first_unbounded();
    let rows = trajectory
        .columns
        .iter()
        .enumerate()
        .filter_map(|(index, column)| {
            let Some(Channel::Driver(_, DriverQuantity::Effort)) = column.channel else {
                return None;
            };
            let driver = &column.owner;
            let e = trajectory.extremes_of(ColumnId::at(index))?;
            if let Some(time) = unbounded.get(column.name.as_str()) {
                return Some(format!("{driver}: no bound at {} s", number(*time, DIGITS)));
            }
            let unit = unit_words(column.unit);
            let at = |value: f64, time: f64| {
                format!(
                    "{} {unit} at {} s",
                    number(value, DIGITS),
                    number(time, DIGITS)
                )
            };
            Some(format!(
                "{driver}: {} … {}",
                at(e.min, e.min_time),
                at(e.max, e.max_time)
            ))
        });
    shorten(rows.collect())
}

/// The joints with the largest forces: magnitude and when. Where forces have no bound, there is no largest one.
pub fn forces(trajectory: &Trajectory, report: &Report) -> Vec<String> {
    let unbounded = report.first_unbounded();
    let mut lacking: Vec<(f64, &str)> = Vec::new();
    let time = trajectory.column_index("time");
    let mut peaks: Vec<(f64, f64, &str)> = Vec::new();
    for (fx, column) in trajectory.columns.iter().enumerate() {
        let Some(Channel::Joint(joint, JointQuantity::Fx)) = column.channel else {
            continue;
        };
        // Where there are both, they stand side by side.
        let fy = fx + 1;
        let across = trajectory.columns.get(fy);
        let is_other =
            |other: &&Column| other.channel == Some(Channel::Joint(joint, JointQuantity::Fy));
        let Some(across) = across.filter(is_other) else {
            continue;
        };
        let joint = column.owner.as_str();
        let parts = [column, across].map(|part| unbounded.get(part.name.as_str()));
        if let Some(time) = parts.into_iter().flatten().copied().min_by(f64::total_cmp) {
            lacking.push((time, joint));
            continue;
        }
        let magnitudes = trajectory.rows().map(|row| {
            (
                row[fx].hypot(row[fy]),
                time.map_or(f64::NAN, |time| row[time]),
            )
        });
        let peak = magnitudes
            .filter(|(force, _)| force.is_finite())
            .max_by(|a, b| a.0.total_cmp(&b.0));
        peaks.extend(peak.map(|(force, time)| (force, time, joint)));
    }
    peaks.sort_by(|a, b| b.0.total_cmp(&a.0));
    let words = |&(force, time, joint): &(f64, f64, &str)| {
        format!(
            "{joint}: {} N at {} s",
            number(force, DIGITS),
            number(time, DIGITS)
        )
    };
    let same = lacking.chunk_by(|a, b| a.0 == b.0);
    let lacking = same.map(|one| {
        let names: Vec<&str> = one.iter().map(|(_, joint)| *joint).collect();
        let (shown, rest) = names.split_at(names.len().min(NAMES));
        let more = match rest.len() {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let time = number(one[0].0, DIGITS);
        format!("{}{more}: no bound at {time} s", shown.join(", "))
    });
    let peaks = peaks.iter().take(FORCES).map(words);
    shorten(lacking.chain(peaks).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn results() -> Trajectory {
        let force =
            |joint, quantity, owner| Column::of(Channel::Joint(joint, quantity), owner, "N");
        let mut table = Trajectory::new(vec![
            Column::of(Channel::Time, "", "s"),
            force(0, JointQuantity::Fx, "a"),
            force(0, JointQuantity::Fy, "a"),
            force(1, JointQuantity::Fx, "🔒"),
            force(1, JointQuantity::Fy, "🔒"),
            Column::of(Channel::Driver(0, DriverQuantity::Effort), "motor", "N*m"),
        ]);
        table.push_row(&[0.0, 3.0, -4.0, 6.0, 8.0, -2.0]);
        table.push_row(&[0.5, 0.0, 1.0, f64::NAN, f64::NAN, 12.5]);
        table
    }

    #[test]
    fn efforts_and_forces_are_found_in_the_columns() {
        assert_eq!(
            efforts(&results(), &Report::default()),
            ["motor: -2 N·m at 0 s … 12.5 N·m at 0.5 s"]
        );
        assert_eq!(
            forces(&results(), &Report::default()),
            ["🔒: 10 N at 0 s", "a: 5 N at 0 s"]
        );
    }

    #[test]
    fn what_has_no_bound_has_no_largest_value() {
        let mut report = Report::default();
        report.note_unbounded(&["joint.🔒.fy".into()], 0.25);
        report.note_unbounded(&["driver.motor.effort".into()], 0.125);
        assert_eq!(efforts(&results(), &report), ["motor: no bound at 0.125 s"]);
        assert_eq!(
            forces(&results(), &report),
            ["🔒: no bound at 0.25 s", "a: 5 N at 0 s"]
        );
    }
}
