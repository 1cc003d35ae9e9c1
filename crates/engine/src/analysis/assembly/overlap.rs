//! Drivers that prescribe the same motion: whether their values agree or not, one of them is too many, or drives nothing.
//!
//! Found by rank: the row of a driver that depends on those of joints and of other drivers, here and beside; the
//! combination tells which of these take part.

use super::beside::beside_by_joints;
use super::ranks::ranks;
use crate::analysis::control::Stop;
use crate::analysis::words::quoted;
use crate::system::{Inputs, Origin, System};
use linkdyn_model::error::Complaint;

/// Complains of drivers that follow from others, at a position `q` that the joints allow.
///
/// # Errors
/// One complaint per such driver.
pub fn refuse(system: &System, q: &[f64], inputs: &Inputs) -> Result<(), Stop> {
    let (joints, all) = ranks(system, q, inputs);
    let first = system.joint_rows();
    // More drivers than freedom are complained of otherwise.
    let many = system.drivers.len() > system.n() - joints.rank;
    if many || all.dependent.iter().all(|dependent| dependent.row < first) {
        return Ok(());
    }
    let Some(beside) = beside_by_joints(system, q, inputs) else {
        return Ok(());
    };
    let there = ranks(system, &beside, inputs).1;
    let complaints: Vec<Complaint> = there
        .dependent
        .iter()
        .filter(|dependent| {
            dependent.row >= first && all.dependent.iter().any(|here| here.row == dependent.row)
        })
        .map(|dependent| {
            let rows = dependent
                .combination
                .iter()
                .map(|(row, _)| *row)
                .chain([dependent.row]);
            complaint(system, dependent.row, rows)
        })
        .collect();
    if complaints.is_empty() {
        Ok(())
    } else {
        Err(Stop::Input(complaints))
    }
}

fn complaint(system: &System, row: usize, rows: impl Iterator<Item = usize>) -> Complaint {
    let driver = |row: usize| match system.block_of_row(row).origin {
        Origin::Driver(id) => Some(system.drivers[id.0].name.as_str()),
        Origin::Joint(_) | Origin::Stop(_) | Origin::Initial(_) => None,
    };
    let name = driver(row).unwrap_or_default();
    let names: Vec<&str> = rows.filter_map(driver).collect();
    let path = format!("drivers.{name}");
    if names.len() < 2 {
        return Complaint::new(
            path,
            format!("the joints leave no room for what driver \"{name}\" prescribes"),
        )
        .hint("take it out, or let it drive something that is free");
    }
    Complaint::new(
        path,
        format!(
            "drivers {} prescribe the same motion: what one of them does follows from the others",
            quoted(names.into_iter())
        ),
    )
    .hint("take one of them out, or let it drive something else")
}
