//! Distances on the page of a chart, as parts of the font size, and its greys.

use crate::palette;
use crate::scene::Ink;

/// Distance of everything from the edge of the page.
pub const EDGE: f64 = 0.4;
/// Height of a line of text.
pub const LINE: f64 = 1.3;
/// Length of a tick.
pub const TICK: f64 = 0.35;
/// Between a tick and its number.
pub const GAP: f64 = 0.35;
/// Between a panel and the next.
pub const BETWEEN_PANELS: f64 = 1.1;
/// Length of a curve's sample in the legend.
pub const SAMPLE: f64 = 2.8;
/// Longer labels of y axes are cut rather than given more height.
pub const LONGEST_LABEL: f64 = 22.0;
/// Size of the note.
pub const NOTE: f64 = 0.85;
/// Least distance of ticks on x axes.
pub const X_TICKS: f64 = 4.2;
/// The same on y axes.
pub const Y_TICKS: f64 = 2.2;
/// Least size of a panel.
pub const LEAST_PANEL: f64 = 4.0;
/// Rows of values of peaks above a panel, at most.
pub const MOST_PEAK_ROWS: usize = 8;
/// Between a panel and the values of its peaks.
pub const PEAK_GAP: f64 = 0.15;
/// Rows of the legend that the usual height of a page has room for.
pub const USUAL_ROWS: usize = 2;
/// Largest part of a page of given height that the legend, and the note, may take.
pub const MOST_OF_PAGE: f64 = 0.5;

/// Frames, ticks, texts of marks.
pub const AXIS_INK: Ink = Ink::new(palette::AXIS);
/// Grid lines.
pub const GRID_INK: Ink = Ink::new(palette::GRID);
/// Lines of marks.
pub const MARK_INK: Ink = Ink::new(palette::MARK);
