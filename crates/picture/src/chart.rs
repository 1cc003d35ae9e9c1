//! A figure of curves: panels one above the other over a common x axis.
//!
//! # Examples
//!
//! ```
//! use linkdyn_picture::{Axis, Chart, Curve, Panel, svg};
//!
//! let curve = Curve::new("crank", vec![0.0, 0.5, 1.0], vec![0.0, f64::NAN, 2.0]);
//! let panel = Panel { axis: Axis::new("angular velocity", "rad/s"), curves: vec![curve] };
//! let chart = Chart { x: Axis::new("time", "s"), panels: vec![panel], ..Chart::default() };
//! assert!(svg::write(&chart.draw().expect("there are values")).starts_with("<svg"));
//! ```

use super::cut::Cut;
use super::fault::{Fault, MOST_CURVES};
use super::scale;
use super::scene::POINTS_PER_MM;

/// Width of a journal's column \[mm\].
pub const COLUMN_MM: f64 = 88.0;
/// Height of the first panel, and of each further one \[mm\].
const FIRST_MM: f64 = 60.0;
const FURTHER_MM: f64 = 36.0;

/// What an axis shows, and how.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// `crank.omega`, or none.
    pub name: String,
    /// Unit as in results, `rad/s`; none for a number without.
    pub unit: String,
    /// Whether it is logarithmic.
    pub log: bool,
    /// Low and high end; left out: what the values take.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    /// A linear axis that shows all values.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Axis {
            name: name.into(),
            unit: unit.into(),
            log: false,
            range: None,
        }
    }
}

/// Values over x, both in the units of their axes; what is not finite is a gap.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curve {
    /// Its text in the legend; curves of the same text in several panels share a style and an entry.
    pub label: String,
    /// Values along the x axis.
    pub x: Vec<f64>,
    /// Values along the y axis, one for each of `x`.
    pub y: Vec<f64>,
}

impl Curve {
    /// A curve.
    pub fn new(label: impl Into<String>, x: Vec<f64>, y: Vec<f64>) -> Self {
        Curve {
            label: label.into(),
            x,
            y,
        }
    }
}

impl Curve {
    /// Its places inside a range of the x axis.
    pub(super) fn within(&self, [low, high]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        let places = self.x.iter().zip(&self.y);
        let inside = places.filter(move |(x, _)| (low..=high).contains(*x));
        inside.map(|(x, y)| [*x, *y])
    }
}

/// Curves over one y axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Panel {
    /// Its y axis.
    pub axis: Axis,
    /// What is drawn in it.
    pub curves: Vec<Curve>,
}

/// A thin vertical line through all panels.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Where it stands, in the unit of the x axis.
    pub x: f64,
    /// Beside its upper end; may be empty.
    pub label: String,
}

/// A figure of curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What it shows, above it.
    pub title: String,
    /// Small text below, for what a reader of the figure alone should know.
    pub note: String,
    /// The axis that all panels share.
    pub x: Axis,
    /// From above to below.
    pub panels: Vec<Panel>,
    /// Through all panels.
    pub marks: Vec<Mark>,
    /// Whether there are lines at the numbers of the axes.
    pub grid: bool,
    /// Whether linear y axes show peaks whole, however flat the rest becomes; else they are cut by the rule of all pictures.
    pub whole: bool,
    /// Width and height of the page \[mm\]; left out: one column wide, higher with more panels and longer legends.
    pub size_mm: [Option<f64>; 2],
    /// Size of the font \[pt\].
    pub font_size: f64,
    /// Width of the curves \[pt\].
    pub line_width: f64,
}

impl Default for Chart {
    fn default() -> Self {
        Chart {
            title: String::new(),
            note: String::new(),
            x: Axis::default(),
            panels: Vec::new(),
            marks: Vec::new(),
            grid: false,
            whole: false,
            size_mm: [None; 2],
            font_size: 8.0,
            line_width: 1.0,
        }
    }
}

impl Chart {
    /// Width of the page \[pt\].
    pub(super) fn width(&self) -> f64 {
        self.size_mm[0].unwrap_or(COLUMN_MM) * POINTS_PER_MM
    }

    /// Height of the page where it is given \[pt\].
    pub(super) fn height(&self) -> Option<f64> {
        Some(self.size_mm[1]? * POINTS_PER_MM)
    }

    /// Height of a page of so many panels \[pt\].
    pub(super) fn usual_height(&self) -> f64 {
        let further = self.panels.len().saturating_sub(1) as f64;
        (FIRST_MM + FURTHER_MM * further) * POINTS_PER_MM
    }

    /// Refuses what no figure can show.
    ///
    /// # Errors
    /// When a range is none, or there are too many curves.
    pub(super) fn check(&self) -> Result<(), Fault> {
        let axes = self.panels.iter().map(|panel| &panel.axis).chain([&self.x]);
        for [low, high] in axes.clone().filter_map(|axis| axis.range) {
            let is_range = low < high && -scale::LARGEST <= low && high <= scale::LARGEST;
            if !is_range {
                return Err(Fault::Range);
            }
        }
        if axes
            .clone()
            .any(|axis| axis.log && axis.range.is_some_and(|[low, _]| low <= 0.0))
        {
            return Err(Fault::Range);
        }
        let most = self
            .panels
            .iter()
            .map(|panel| panel.curves.len())
            .max()
            .unwrap_or(0);
        if most > MOST_CURVES {
            return Err(Fault::TooManyCurves(most));
        }
        Ok(())
    }

    /// The range of the x axis: given, or what the curves with values take.
    pub(super) fn x_range(&self) -> Result<[f64; 2], Fault> {
        if let Some(range) = self.x.range {
            return Ok(range);
        }
        let curves = self.panels.iter().flat_map(|panel| &panel.curves);
        let values = curves.flat_map(|curve| {
            curve
                .x
                .iter()
                .zip(&curve.y)
                .filter(|(_, y)| y.is_finite())
                .map(|(x, _)| *x)
        });
        scale::range(values, self.x.log, 0.0).ok_or_else(|| {
            Fault::Nothing(format!(
                "{} has no value where a curve has one",
                name(&self.x, "the x axis")
            ))
        })
    }

    /// The range of a panel's y axis, from the values inside the x range.
    pub(super) fn y_range(&self, panel: &Panel, [low, high]: [f64; 2]) -> Result<[f64; 2], Fault> {
        if let Some(range) = panel.axis.range {
            return Ok(range);
        }
        let within =
            |curve: &Curve| -> Vec<f64> { curve.within([low, high]).map(|[_, y]| y).collect() };
        let is_cut = !self.whole && !panel.axis.log;
        if is_cut && let Some(range) = Cut::range(panel.curves.iter().map(within)) {
            return Ok(range);
        }
        let values = panel.curves.iter().flat_map(within);
        scale::range(values, panel.axis.log, 0.05).ok_or_else(|| {
            let positive = if panel.axis.log {
                " above 0, which a logarithmic axis needs,"
            } else {
                ""
            };
            Fault::Nothing(format!(
                "{} has no value{positive} in the range of the x axis",
                name(&panel.axis, "a panel")
            ))
        })
    }
}

fn name(axis: &Axis, otherwise: &str) -> String {
    if axis.name.is_empty() {
        otherwise.to_string()
    } else {
        axis.name.clone()
    }
}
