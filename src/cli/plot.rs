//! `linkdyn plot`: result columns over each other, as a figure for a paper.

use std::path::PathBuf;

use clap::Args;
use serde_json::Value;

use super::measures::{dpi, line_width, mark, millimetres, points, range, size};
use super::page::{Page, count, number};
use super::plot_units::{Units, convert_one, quantity_words};
use super::results::{Results, extension, write_file};
use super::{BadInput, Exit, print};
use linkdyn_output::TIME;
use linkdyn_output::read::ReadColumn;
use linkdyn_picture::{Axis, Chart, Curve, Mark, POINTS_PER_MM, Panel, raster, svg};

/// Most values that are drawn, all curves together.
const MOST_VALUES: usize = 50_000_000;
/// Events of a run that are marked, at most.
const MOST_EVENTS: usize = 200;
/// Contacts, sticks and slips that are marked with their names; of more only the beginnings of contacts, without.
const MOST_NAMED: usize = 8;

#[derive(Debug, Args)]
#[command(after_help = PLOT_HELP)]
pub struct Options {
    /// A results.csv, or a directory that holds one; several are drawn over each other
    #[arg(value_name = "RESULTS", required = true)]
    results: Vec<PathBuf>,
    /// Column of the x axis, with or without its [unit]
    #[arg(long, value_name = "COLUMN", default_value = "time")]
    x: String,
    /// Columns to draw; * stands for any text, ? for one character
    #[arg(long, value_name = "COLUMN", required = true, num_args = 1..)]
    y: Vec<String>,
    /// File to write, .svg or .png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Units to draw in, each for all columns that it can measure: deg,mm,rpm,kN
    #[arg(long, value_name = "UNIT,…", value_delimiter = ',')]
    units: Vec<String>,
    /// Unit of the x axis alone
    #[arg(long, value_name = "UNIT")]
    x_unit: Option<String>,
    /// Name in the legend: one per RESULTS where there are several, else one per column
    #[arg(long, value_name = "TEXT")]
    label: Vec<String>,
    /// Text above the axes
    #[arg(
        long,
        value_name = "TEXT",
        default_value = "",
        hide_default_value = true
    )]
    title: String,
    /// Small text below the axes
    #[arg(
        long,
        value_name = "TEXT",
        default_value = "",
        hide_default_value = true
    )]
    note: String,
    /// Name of the x axis
    #[arg(long, value_name = "TEXT")]
    x_label: Option<String>,
    /// Name of the y axis; the next one is for the next panel
    #[arg(long, value_name = "TEXT")]
    y_label: Vec<String>,
    /// Range of the x axis, in its unit
    #[arg(long, value_name = "A:B", allow_hyphen_values = true, value_parser = range)]
    x_range: Option<[f64; 2]>,
    /// Range of the y axis, in its unit; the next one is for the next panel
    #[arg(long, value_name = "A:B", allow_hyphen_values = true, value_parser = range)]
    y_range: Vec<[f64; 2]>,
    /// Logarithmic x axis
    #[arg(long)]
    log_x: bool,
    /// Logarithmic y axes
    #[arg(long)]
    log_y: bool,
    /// Grid lines
    #[arg(long)]
    grid: bool,
    /// Thin vertical line at X, with a text; may be given more than once
    #[arg(long, value_name = "X[=TEXT]", allow_hyphen_values = true, value_parser = mark)]
    mark: Vec<Mark>,
    /// Thin vertical lines at change points and other events of the runs, over time or a driver's value
    #[arg(long)]
    events: bool,
    #[command(flatten)]
    page: PageOptions,
}

/// Size and resolution.
#[derive(Debug, Args)]
pub struct PageOptions {
    /// Width \[mm\]; a journal's column is the default, 180 its full width
    #[arg(long, value_name = "MM", value_parser = millimetres)]
    width: Option<f64>,
    /// Height \[mm\]
    #[arg(long, value_name = "MM", value_parser = millimetres)]
    height: Option<f64>,
    /// Width and height at once \[mm\]
    #[arg(long, value_name = "WxH", value_parser = size, conflicts_with_all = ["width", "height"])]
    size: Option<[f64; 2]>,
    /// Size of the letters \[pt\]
    #[arg(long, value_name = "PT", default_value_t = 8.0, value_parser = points)]
    font_size: f64,
    /// Width of the curves \[pt\]
    #[arg(long, value_name = "PT", default_value_t = 1.0, value_parser = line_width)]
    line_width: f64,
    /// Resolution of a PNG [dots per inch]
    #[arg(long, value_name = "DPI", default_value_t = 300.0, value_parser = dpi)]
    dpi: f64,
}

const PLOT_HELP: &str =
    "Columns of the same unit share a panel; panels stand one above the other. Empty cells are gaps.

  linkdyn plot out --y crank.omega -o omega.svg
  linkdyn plot out --x driver.motor.value --y 'joint.?.fx' --units deg,kN -o forces.png
  linkdyn plot a b --y driver.motor.effort --label ideal --label worn -o effort.svg";

/// Reads, draws, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, BadInput> {
    let format = extension(&options.output);
    if !["svg", "png"].contains(&format.as_str()) {
        let file = options.output.display();
        return Err(BadInput(vec![format!(
            "{file}: the name of the file must end in .svg or .png"
        )]));
    }
    let mut runs = options
        .results
        .iter()
        .map(|path| Results::open(path))
        .collect::<Result<Vec<_>, _>>()?;
    runs.iter_mut().for_each(Results::take_peaks);
    let (chart, unused) = chart(options, &runs)?;
    let fault = |fault: linkdyn_picture::Fault| {
        BadInput(vec![format!("{}: {fault}", options.output.display())])
    };
    let scene = chart.draw().map_err(fault)?;
    let content = match format.as_str() {
        "svg" => svg::write(&scene).into_bytes(),
        _ => raster::png(&scene, options.page.dpi).map_err(fault)?,
    };
    let written = write_file(&options.output, &content)?;
    let mut page = Page::default();
    let mm = |points: f64| number(points / POINTS_PER_MM, 4);
    let curves = chart.panels.iter().map(|panel| panel.curves.len()).sum();
    page.line(format!(
        "{}: {} × {} mm, {} in {}",
        written.display(),
        mm(scene.width),
        mm(scene.height),
        count(curves, "curve"),
        count(chart.panels.len(), "panel")
    ));
    page.rows("left out", left_out(&chart));
    page.rows("units unused", unused);
    print(page.text())?;
    Ok(Exit::Done)
}

/// What the figure can't show.
fn left_out(chart: &Chart) -> Vec<String> {
    let mut rows: Vec<String> = Vec::new();
    for (panel, curve) in chart
        .panels
        .iter()
        .flat_map(|panel| panel.curves.iter().map(move |curve| (panel, curve)))
    {
        let name = if curve.label.is_empty() {
            &panel.axis.name
        } else {
            &curve.label
        };
        let rows_where =
            |is: fn(f64) -> bool| count(curve.y.iter().filter(|y| is(**y)).count(), "row");
        let gaps = rows_where(|y| !y.is_finite());
        let negative = rows_where(|y| y <= 0.0);
        let told = [
            (gaps.as_str() != "0 rows").then(|| format!("{name}: {gaps} without a value")),
            (panel.axis.log && negative != "0 rows")
                .then(|| format!("{name}: {negative} at or below 0, on a logarithmic axis")),
        ];
        for row in told.into_iter().flatten() {
            if !rows.contains(&row) {
                rows.push(row);
            }
        }
    }
    rows
}

/// A curve before it has a label.
struct Found {
    run: usize,
    /// Name of the column.
    name: String,
    unit: String,
    x: Vec<f64>,
    y: Vec<f64>,
}

/// The figure, and units that were asked for in vain.
fn chart(options: &Options, runs: &[Results]) -> Result<(Chart, Vec<String>), BadInput> {
    let mut units = Units::new(&options.units, options.x_unit.as_deref())?;
    let names = names(options, runs)?;
    let mut found: Vec<Found> = Vec::new();
    let mut x_column: Option<(String, String)> = None;
    let values = runs
        .iter()
        .map(|run| run.table.len())
        .sum::<usize>()
        .saturating_mul(names.len());
    if values > MOST_VALUES {
        return Err(BadInput(vec![format!(
            "{values} values are too many for a figure: {MOST_VALUES} at most"
        )]));
    }
    for (index, run) in runs.iter().enumerate() {
        let x = *run
            .columns(&options.x)
            .first()
            .ok_or_else(|| BadInput(vec![run.unknown("--x", &options.x)]))?;
        let (x_unit, x_values) = units.x(&run.table, x)?;
        let (_, known) = x_column.get_or_insert_with(|| (x.name.clone(), x_unit.clone()));
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
                unit,
                x: x_values.clone(),
                y,
            });
        }
    }
    let (x_name, x_unit) = x_column.unwrap_or_default();
    let mut marks = options.mark.clone();
    if options.events {
        marks.extend(
            runs.iter()
                .flat_map(|run| event_marks(run, &x_name, &x_unit)),
        );
        marks.sort_by(|a, b| a.x.total_cmp(&b.x));
        marks.dedup();
    }
    let mut chart = Chart {
        title: options.title.clone(),
        note: options.note.clone(),
        x: Axis {
            name: options.x_label.clone().unwrap_or(x_name),
            unit: x_unit,
            log: options.log_x,
            range: options.x_range,
        },
        panels: Vec::new(),
        marks,
        grid: options.grid,
        size_mm: options
            .page
            .size
            .map_or([options.page.width, options.page.height], |[w, h]| {
                [Some(w), Some(h)]
            }),
        font_size: options.page.font_size,
        line_width: options.page.line_width,
    };
    fill_panels(&mut chart, options, runs, found)?;
    Ok((chart, units.unused()))
}

/// Events that a run's summary tells of, where the x axis has a place for them.
fn event_marks(run: &Results, x_name: &str, x_unit: &str) -> Vec<Mark> {
    let events = run
        .summary
        .as_ref()
        .and_then(|summary| summary.get("events")?.as_array());
    let column = run
        .table
        .columns
        .iter()
        .find(|column| column.name == x_name);
    let (Some(events), Some(column)) = (events, column) else {
        return Vec::new();
    };
    let driver = x_name
        .strip_prefix("driver.")
        .and_then(|name| name.strip_suffix(".value"));
    let many = events.iter().filter(|event| is_contact(event)).count() > MOST_NAMED;
    let mark = |event: &Value| -> Option<Mark> {
        let x = match driver {
            None if x_name == TIME => event.get("time")?.as_f64()?,
            Some(driver) if event.get("driver")?.as_str()? == driver => {
                event.get("value")?.as_f64()?
            }
            None | Some(_) => return None,
        };
        let label = if is_contact(event) && many {
            String::new()
        } else {
            event_word(event)?
        };
        Some(Mark {
            x: convert_one(x, &column.unit, x_unit)?,
            label,
        })
    };
    // Others are not crowded out by contacts.
    let others = events.iter().filter(|event| !is_contact(event));
    let contacts = events
        .iter()
        .filter(|event| is_contact(event))
        .filter(|event| !many || event["type"] == "contact");
    others
        .chain(contacts)
        .take(MOST_EVENTS)
        .filter_map(mark)
        .collect()
}

/// Whether an event is one of a journal in its bearing.
fn is_contact(event: &Value) -> bool {
    let kind = event["type"].as_str().unwrap_or_default();
    ["contact", "stick", "slip", "following"].contains(&kind)
}

/// `change point`; a contact that takes no time is an impact.
fn event_word(event: &Value) -> Option<String> {
    let kind = event.get("type")?.as_str()?;
    let is_impact = kind == "contact" && event["duration"].as_f64() == Some(0.0);
    Some(if is_impact {
        "impact".into()
    } else {
        kind.replace('_', " ")
    })
}

/// Names of the columns to draw, in order, each once.
fn names(options: &Options, runs: &[Results]) -> Result<Vec<String>, BadInput> {
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

/// A panel per unit, with labels, names and ranges.
fn fill_panels(
    chart: &mut Chart,
    options: &Options,
    runs: &[Results],
    found: Vec<Found>,
) -> Result<(), BadInput> {
    let mut units: Vec<String> = Vec::new();
    let mut columns: Vec<String> = Vec::new();
    for curve in &found {
        for (list, word) in [(&mut units, &curve.unit), (&mut columns, &curve.name)] {
            if !list.contains(word) {
                list.push(word.clone());
            }
        }
    }
    // Where each panel shows one column, the axis tells which.
    let one_each = units.iter().all(|unit| {
        let mut names = found
            .iter()
            .filter(|curve| curve.unit == *unit)
            .map(|curve| &curve.name);
        let first = names.next();
        names.all(|name| Some(name) == first)
    });
    let run_labels = run_labels(options, runs);
    let wanted = if runs.len() > 1 {
        runs.len()
    } else {
        columns.len()
    };
    if !options.label.is_empty() && options.label.len() != wanted {
        let what = if runs.len() > 1 { "RESULTS" } else { "columns" };
        let given = options.label.len();
        return Err(BadInput(vec![format!(
            "--label: {given} given for {wanted} {what} (give one for each, or none)"
        )]));
    }
    let label = |curve: &Found| match (runs.len() > 1, one_each) {
        (true, true) => run_labels[curve.run].clone(),
        (true, false) => format!("{}, {}", curve.name, run_labels[curve.run]),
        (false, _) if !options.label.is_empty() => columns
            .iter()
            .position(|name| *name == curve.name)
            .map(|at| options.label[at].clone())
            .unwrap_or_default(),
        (false, true) => String::new(),
        (false, false) => curve.name.clone(),
    };
    for (given, what) in [
        (options.y_label.len(), "--y-label"),
        (options.y_range.len(), "--y-range"),
    ] {
        if given > units.len() {
            let panels = count(units.len(), "panel");
            return Err(BadInput(vec![format!(
                "{what}: {given} given, but there is only {panels}"
            )]));
        }
    }
    for (index, unit) in units.iter().enumerate() {
        let curves: Vec<&Found> = found.iter().filter(|curve| curve.unit == *unit).collect();
        let name = options
            .y_label
            .get(index)
            .cloned()
            .unwrap_or_else(|| axis_name(&curves));
        let axis = Axis {
            name,
            unit: unit.clone(),
            log: options.log_y,
            range: options.y_range.get(index).copied(),
        };
        let curves = curves
            .into_iter()
            .map(|curve| Curve::new(label(curve), curve.x.clone(), curve.y.clone()));
        chart.panels.push(Panel {
            axis,
            curves: curves.collect(),
        });
    }
    Ok(())
}

/// The column's name, or what the columns have in common.
fn axis_name(curves: &[&Found]) -> String {
    let Some(first) = curves.first() else {
        return String::new();
    };
    if curves.iter().all(|curve| curve.name == first.name) {
        return first.name.clone();
    }
    let words: Vec<&str> = curves
        .iter()
        .filter_map(|curve| curve.name.rsplit('.').next())
        .map(quantity_words)
        .collect();
    if words.iter().all(|word| word == &words[0]) {
        words[0].to_string()
    } else {
        String::new()
    }
}

/// What each run is called: as given, else by its directory, its model or its path, the first that tells all apart.
fn run_labels(options: &Options, runs: &[Results]) -> Vec<String> {
    if runs.len() > 1 && options.label.len() == runs.len() {
        return options.label.clone();
    }
    let is_distinct = |labels: &Vec<String>| {
        (0..labels.len()).all(|a| !labels[a].is_empty() && (0..a).all(|b| labels[a] != labels[b]))
    };
    let by_file = runs.iter().map(Results::file_name).collect();
    let by_model = runs
        .iter()
        .map(|run| run.model_name().unwrap_or_default().to_string())
        .collect();
    let by_path: Vec<String> = runs
        .iter()
        .map(|run| run.path.display().to_string())
        .collect();
    let numbered = || {
        by_path
            .iter()
            .enumerate()
            .map(|(i, path)| format!("{} {path}", i + 1))
            .collect()
    };
    [by_file, by_model, by_path.clone()]
        .into_iter()
        .find(is_distinct)
        .unwrap_or_else(numbered)
}
