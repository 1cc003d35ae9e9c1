//! Places the parts of a chart on the page, from the outside inwards: title, legend, note, labels; the axes get the rest.
//!
//! Nothing can overlap the curves, since only they, and small marks where a peak leaves the panel, are drawn inside the axes.

mod axes;
mod cursor;
mod labels;
mod legend;
mod measures;
mod note;
mod page;
mod panel;
mod peaks;

pub use cursor::{MovingChart, Side};
