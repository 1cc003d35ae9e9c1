//! Options of `linkdyn plot`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::measures::{dpi, line_width, mark, millimetres, points, range, size};
use linkdyn_picture::Mark;

/// What to draw, from what, and how.
#[derive(Debug, Default, Clone, Args)]
#[command(after_help = PLOT_HELP)]
pub struct Options {
    /// A results.csv, or a directory that holds one, or that of a study; several are drawn over each other
    #[arg(value_name = "RESULTS", required = true)]
    pub results: Vec<PathBuf>,
    /// Column of the x axis, with or without its [unit]
    #[arg(long, value_name = "COLUMN", default_value = "time")]
    pub x: String,
    /// Columns to draw; * stands for any text, ? for one character
    #[arg(long, value_name = "COLUMN", required = true, num_args = 1..)]
    pub y: Vec<String>,
    /// File to write, .svg or .png
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Units to draw in, each for all columns that it can measure: deg,mm,rpm,kN
    #[arg(long, value_name = "UNIT,…", value_delimiter = ',')]
    pub units: Vec<String>,
    /// Unit of the x axis alone
    #[arg(long, value_name = "UNIT")]
    pub x_unit: Option<String>,
    /// Name in the legend: one per RESULTS where there are several, else one per column
    #[arg(long, value_name = "TEXT")]
    pub label: Vec<String>,
    /// Text above the axes
    #[arg(
        long,
        value_name = "TEXT",
        default_value = "",
        hide_default_value = true
    )]
    pub title: String,
    /// Small text below the axes
    #[arg(
        long,
        value_name = "TEXT",
        default_value = "",
        hide_default_value = true
    )]
    pub note: String,
    /// Name of the x axis
    #[arg(long, value_name = "TEXT")]
    pub x_label: Option<String>,
    /// Name of the y axis; the next one is for the next panel
    #[arg(long, value_name = "TEXT")]
    pub y_label: Vec<String>,
    /// Range of the x axis, in its unit
    #[arg(long, value_name = "A:B", allow_hyphen_values = true, value_parser = range)]
    pub x_range: Option<[f64; 2]>,
    /// Range of the y axis, in its unit; the next one is for the next panel
    #[arg(long, value_name = "A:B", allow_hyphen_values = true, value_parser = range)]
    pub y_range: Vec<[f64; 2]>,
    /// Logarithmic x axis
    #[arg(long)]
    pub log_x: bool,
    /// Logarithmic y axes
    #[arg(long)]
    pub log_y: bool,
    /// Draw how often the one column of --y has its values
    #[arg(long, conflicts_with_all = ["x", "events"])]
    pub histogram: bool,
    /// Show peaks whole, however flat the rest becomes; else linear y axes end where a few peaks would flatten everything else
    #[arg(long)]
    pub whole: bool,
    /// Grid lines
    #[arg(long)]
    pub grid: bool,
    /// Thin vertical line at X, with a text; may be given more than once
    #[arg(long, value_name = "X[=TEXT]", allow_hyphen_values = true, value_parser = mark)]
    pub mark: Vec<Mark>,
    /// Thin vertical lines at change points and other events of the runs, over time or a driver's value
    #[arg(long)]
    pub events: bool,
    #[command(flatten)]
    pub page: PageOptions,
}

/// Size and resolution.
#[derive(Debug, Default, Clone, Args)]
pub struct PageOptions {
    /// Width \[mm\]; a journal's column is the default, 180 its full width
    #[arg(long, value_name = "MM", value_parser = millimetres)]
    pub width: Option<f64>,
    /// Height \[mm\]
    #[arg(long, value_name = "MM", value_parser = millimetres)]
    pub height: Option<f64>,
    /// Width and height at once \[mm\]
    #[arg(long, value_name = "WxH", value_parser = size, conflicts_with_all = ["width", "height"])]
    pub size: Option<[f64; 2]>,
    /// Size of the letters \[pt\]
    #[arg(long, value_name = "PT", default_value_t = 8.0, value_parser = points)]
    pub font_size: f64,
    /// Width of the curves \[pt\]
    #[arg(long, value_name = "PT", default_value_t = 1.0, value_parser = line_width)]
    pub line_width: f64,
    /// Resolution of a PNG [dots per inch]
    #[arg(long, value_name = "DPI", default_value_t = 300.0, value_parser = dpi)]
    pub dpi: f64,
}

const PLOT_HELP: &str =
    "Columns of the same unit share a panel; panels stand one above the other. Empty cells are gaps.

  linkdyn plot out --y crank.omega -o omega.svg
  linkdyn plot out --x driver.motor.value --y 'joint.?.fx' --units deg,kN -o forces.png
  linkdyn plot a b --y driver.motor.effort --label ideal --label worn -o effort.svg

Of a study, responses over what was varied, a curve for each value of the others; or how often they have their values.

  linkdyn plot sweep --y stroke -o stroke.svg
  linkdyn plot scatter --y stroke --histogram --units mm -o stroke.svg";
