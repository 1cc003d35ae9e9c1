//! Figures for papers and slides: curves over a shared axis, and mechanisms in motion.
//!
//! Everything is laid out once, in points (1/72 inch), as a [`Scene`] of lines, areas and texts; [`svg`] and [`raster`] write
//! the same scene, so that both look alike. Texts are measured with the font that the raster is drawn with (Liberation Sans,
//! whose widths are those of Arial and Helvetica), which makes the layout the same on every machine.
//!
//! | file        | does                                                            |
//! | ----------- | --------------------------------------------------------------- |
//! | `chart`     | what a figure of curves is: panels, curves, axes                |
//! | `layout`    | places its parts on the page                                    |
//! | `scale`     | value → place, ticks, tick labels                               |
//! | `trace`     | values → polylines: gaps, clipping, thinning                    |
//! | `style`     | colours, dashes and markers that differ in grey print too       |
//! | `scene`     | lines, areas, texts                                             |
//! | `font`      | the vendored font: widths and outlines                          |
//! | `svg`       | scene → SVG                                                     |
//! | `raster`    | scene → pixels, PNG                                             |
//! | `film`      | pixels → GIF                                                    |
//! | `drawing`   | the shape of a mechanism, from a model or from `summary.json`   |
//! | `poses`     | where its bodies are, from a table of results                   |
//! | `mechanism` | shape and poses → scene                                         |
//! | `words`     | names and units as printed                                      |

pub mod chart;
pub mod drawing;
pub mod film;
pub mod font;
pub mod mechanism;
pub mod poses;
pub mod raster;
pub mod report;
pub mod scene;
pub mod svg;
pub mod words;

mod layout;
mod scale;
mod style;
mod symbols;
mod trace;

pub use chart::{Axis, Chart, Curve, Mark, Panel};
pub use scene::Scene;

use thiserror::Error;

/// Points per millimetre.
pub const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Why a figure can't be drawn.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Fault {
    #[error("nothing to draw: {0}")]
    Nothing(String),
    #[error(
        "the figure is too small: labels and legend leave no room for the axes (make it larger, or the font smaller)"
    )]
    TooSmall,
    #[error("{0} curves in one panel: more than {most} can't be told apart", most = chart::MOST_CURVES)]
    TooManyCurves(usize),
    #[error("a range must be finite, begin below its end, and lie above 0 on a logarithmic axis")]
    Range,
    #[error("{0} × {1} pixels are too many: {most} at most (choose fewer dpi, or a smaller figure)", most = raster::MOST_PIXELS)]
    TooManyPixels(u64, u64),
    #[error("{0} pixels for all frames are too many: {most} at most (choose a smaller width, a shorter duration or fewer fps)", most = film::MOST_PIXELS)]
    TooMuchFilm(u64),
    #[error("the picture can't be encoded: {0}")]
    Encoding(String),
    #[error("{0}")]
    Drawing(String),
}
