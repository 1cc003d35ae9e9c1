//! A panel per unit, with labels, names and ranges.

use super::labels::{axis_name, run_labels};
use super::options::Options;
use crate::cli::exit::{BadInput, Failure};
use crate::cli::results::Results;
use linkdyn_ask::text::count;
use linkdyn_output::Channel;
use linkdyn_picture::{Axis, Curve, Panel};

/// A curve before it has a label.
pub struct Found {
    /// Number of the run.
    pub run: usize,
    /// Name of the column.
    pub name: String,
    /// What it is, where that is known.
    pub channel: Option<Channel>,
    /// Unit that it is drawn in.
    pub unit: String,
    /// Values of the x axis.
    pub x: Vec<f64>,
    /// Its values.
    pub y: Vec<f64>,
}

/// The distinct texts, in order.
fn distinct<'f>(texts: impl Iterator<Item = &'f String>) -> Vec<&'f String> {
    let mut found: Vec<&String> = Vec::new();
    for text in texts {
        if !found.contains(&text) {
            found.push(text);
        }
    }
    found
}

/// The panels of the curves.
///
/// # Errors
/// When there are more labels, names or ranges than what they are for.
pub fn panels(options: &Options, runs: &[Results], found: &[Found]) -> Result<Vec<Panel>, Failure> {
    let units = distinct(found.iter().map(|curve| &curve.unit));
    let columns = distinct(found.iter().map(|curve| &curve.name));
    check_labels(options, runs.len(), columns.len())?;
    check_panels(options, units.len())?;
    // Where each panel shows one column, the axis tells which.
    let one_each = units.iter().all(|unit| {
        let of_unit = found.iter().filter(|curve| curve.unit == **unit);
        distinct(of_unit.map(|curve| &curve.name)).len() < 2
    });
    let run_labels = run_labels(options, runs);
    let label = |curve: &Found| match (runs.len() > 1, one_each) {
        (true, true) => run_labels[curve.run].clone(),
        (true, false) => format!("{}, {}", curve.name, run_labels[curve.run]),
        (false, _) if !options.label.is_empty() => columns
            .iter()
            .position(|name| **name == curve.name)
            .map(|at| options.label[at].clone())
            .unwrap_or_default(),
        (false, true) => String::new(),
        (false, false) => curve.name.clone(),
    };
    let panel = |(index, unit): (usize, &&String)| {
        let curves: Vec<&Found> = found.iter().filter(|curve| curve.unit == **unit).collect();
        let name = options.y_label.get(index).cloned();
        let columns: Vec<(&str, Option<Channel>)> = curves
            .iter()
            .map(|curve| (curve.name.as_str(), curve.channel))
            .collect();
        let axis = Axis {
            name: name.unwrap_or_else(|| axis_name(&columns)),
            unit: (*unit).clone(),
            log: options.log_y,
            range: options.y_range.get(index).copied(),
        };
        let curves = curves
            .into_iter()
            .map(|curve| Curve::new(label(curve), curve.x.clone(), curve.y.clone()));
        Panel {
            axis,
            curves: curves.collect(),
        }
    };
    Ok(units.iter().enumerate().map(panel).collect())
}

/// Refuses labels that are not one for each run, or each column of a single one.
fn check_labels(options: &Options, runs: usize, columns: usize) -> Result<(), Failure> {
    let (wanted, what) = if runs > 1 {
        (runs, "RESULTS")
    } else {
        (columns, "columns")
    };
    let given = options.label.len();
    if given == 0 || given == wanted {
        return Ok(());
    }
    Err(BadInput(vec![format!(
        "--label: {given} given for {wanted} {what} (give one for each, or none)"
    )]))
}

/// Refuses names and ranges for which there is no panel.
fn check_panels(options: &Options, panels: usize) -> Result<(), Failure> {
    let given = [
        (options.y_label.len(), "--y-label"),
        (options.y_range.len(), "--y-range"),
    ];
    match given.into_iter().find(|(given, _)| *given > panels) {
        Some((given, what)) => {
            let panels = count(panels, "panel");
            Err(BadInput(vec![format!(
                "{what}: {given} given, but there is only {panels}"
            )]))
        }
        None => Ok(()),
    }
}
