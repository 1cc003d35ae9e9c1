//! `linkdyn plot`: result columns over each other, as a figure for a paper.

mod chart;
mod labels;
mod marks;
mod options;
mod panels;
mod study;
mod units;

use super::exit::{BadInput, Exit, Failure};
use super::results::{Results, extension, write_file};
use super::streams::print;
use chart::chart;
use linkdyn_ask::text::{Page, count, number};
use linkdyn_picture::{Chart, Mark, POINTS_PER_MM, raster, svg};
pub use options::Options;

/// Reads, draws, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
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
    let (unfolded, runs) = study::unfold(options.clone(), runs)?;
    let (chart, unused) = chart(&unfolded, &runs)?;
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
    page.rows("cut off", chart.cut_off().map_err(fault)?);
    page.rows("units unused", unused);
    print(page.text())?;
    Ok(Exit::Done)
}

/// What curves a film shows.
#[derive(Debug)]
pub struct FilmCurves<'a> {
    /// Column of the x axis.
    pub x: &'a str,
    /// Columns to draw.
    pub y: &'a [String],
    /// Units to draw in.
    pub units: &'a [String],
    /// Thin vertical lines.
    pub marks: &'a [Mark],
}

/// The chart of a film's curves.
///
/// # Errors
/// When a column or a unit is unknown.
pub fn film_chart(run: &Results, curves: &FilmCurves) -> Result<Chart, Failure> {
    let options = Options {
        x: curves.x.to_string(),
        y: curves.y.to_vec(),
        units: curves.units.to_vec(),
        mark: curves.marks.to_vec(),
        ..Options::default()
    };
    let (chart, unused) = chart(&options, std::slice::from_ref(run))?;
    if unused.is_empty() {
        Ok(chart)
    } else {
        Err(BadInput(
            unused
                .iter()
                .map(|unit| format!("--units {unit}"))
                .collect(),
        ))
    }
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
