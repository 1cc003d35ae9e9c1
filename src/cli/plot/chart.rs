//! The figure of some columns of some runs.

use super::marks::event_marks;
use super::options::Options;
use super::panels::{Found, panels};
use super::units::Units;
use crate::cli::exit::{BadInput, Failure};
use crate::cli::results::Results;
use linkdyn_output::read::ReadColumn;
use linkdyn_picture::{Axis, Chart, Mark};

/// Most values that are drawn, all curves together.
const MOST_VALUES: usize = 50_000_000;

/// The figure, and units requested in vain.
pub fn chart(options: &Options, runs: &[Results]) -> Result<(Chart, Vec<String>), Failure> {
    let mut units = Units::new(&options.units, options.x_unit.as_deref())?;
    let (found, [x_name, x_unit]) = curves(options, runs, &mut units)?;
    let page = &options.page;
    let chart = Chart {
        title: options.title.clone(),
        note: options.note.clone(),
        marks: marks(options, runs, &x_name, &x_unit),
        x: Axis {
            name: options.x_label.clone().unwrap_or(x_name),
            unit: x_unit,
            log: options.log_x,
            range: options.x_range,
        },
        panels: panels(options, runs, &found)?,
        grid: options.grid,
        whole: options.whole,
        size_mm: page
            .size
            .map_or([page.width, page.height], |size| size.map(Some)),
        font_size: page.font_size,
        line_width: page.line_width,
    };
    Ok((chart, units.unused()))
}

/// The curves, and name and unit of the x axis.
fn curves(
    options: &Options,
    runs: &[Results],
    units: &mut Units,
) -> Result<(Vec<Found>, [String; 2]), Failure> {
    let names = names(options, runs)?;
    let rows = runs.iter().map(|run| run.table.len()).sum::<usize>();
    let values = rows.saturating_mul(names.len());
    if values > MOST_VALUES {
        return Err(BadInput(vec![format!(
            "{values} values are too many for a figure: {MOST_VALUES} at most"
        )]));
    }
    let mut found: Vec<Found> = Vec::new();
    let mut x_axis: Option<[String; 2]> = None;
    for (index, run) in runs.iter().enumerate() {
        let x = *run
            .columns(&options.x)
            .first()
            .ok_or_else(|| BadInput(vec![run.unknown("--x", &options.x)]))?;
        let (x_unit, x_values) = units.x(&run.table, x)?;
        let [_, known] = x_axis.get_or_insert_with(|| [x.name.clone(), x_unit.clone()]);
        if *known != x_unit {
            let path = run.table.path.display();
            return Err(BadInput(vec![format!(
                "{path}: --x {} is in {x_unit} there, and in {known} elsewhere",
                options.x
            )]));
        }
        for name in &names {
            let Some(column) = run.table.columns.iter().find(|column| column.name == *name) else {
                continue;
            };
            let (unit, y) = units.y(&run.table, column)?;
            found.push(Found {
                run: index,
                name: column.name.clone(),
                channel: column.channel,
                unit,
                x: x_values.clone(),
                y,
            });
        }
    }
    Ok((found, x_axis.unwrap_or_default()))
}

/// Marks requested, and events of the runs.
fn marks(options: &Options, runs: &[Results], x_name: &str, x_unit: &str) -> Vec<Mark> {
    let mut marks = options.mark.clone();
    if options.events {
        let events = runs.iter().flat_map(|run| event_marks(run, x_name, x_unit));
        marks.extend(events);
        marks.sort_by(|a, b| a.x.total_cmp(&b.x));
        marks.dedup();
    }
    marks
}

/// Names of the columns to draw, in order, each once.
fn names(options: &Options, runs: &[Results]) -> Result<Vec<String>, Failure> {
    let mut names: Vec<String> = Vec::new();
    for wanted in &options.y {
        let is_pattern = wanted.contains(['*', '?']);
        let mut missing = Vec::new();
        let mut any = false;
        for run in runs {
            let columns: Vec<&ReadColumn> = run.columns(wanted);
            if columns.is_empty() {
                missing.push(run.unknown("--y", wanted));
            }
            any |= !columns.is_empty();
            let new = columns
                .into_iter()
                .filter(|column| !is_pattern || column.name != options.x);
            for column in new {
                if !names.contains(&column.name) {
                    names.push(column.name.clone());
                }
            }
        }
        // A pattern may well match in some of the runs only.
        let may_miss = any && is_pattern;
        if !may_miss && !missing.is_empty() {
            return Err(BadInput(missing));
        }
    }
    Ok(names)
}
