//! Why a figure can't be drawn, and the limits that it names.

use thiserror::Error;

use super::style::DISTINCT;

/// Most curves of a panel: more can't be distinguished.
pub const MOST_CURVES: usize = DISTINCT;
/// Most pixels of a picture.
pub const MOST_PIXELS: u64 = 100_000_000;
/// Most pixels of all frames of a film together.
pub const MOST_FILM_PIXELS: u64 = 2_000_000_000;

/// Why a figure can't be drawn.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Fault {
    /// There is nothing to see.
    #[error("nothing to draw: {0}")]
    Nothing(String),
    /// Labels and legend take all the room.
    #[error(
        "the figure is too small: labels and legend leave no room for the axes (make it larger, or the font smaller)"
    )]
    TooSmall,
    /// More curves than styles.
    #[error("{0} curves in one panel: more than {MOST_CURVES} can't be told apart")]
    TooManyCurves(usize),
    /// A range that no axis can have.
    #[error("a range must be finite, begin below its end, and lie above 0 on a logarithmic axis")]
    Range,
    /// Width and height \[pixels\] of a picture that would be too large.
    #[error(
        "{0} × {1} pixels are too many: {MOST_PIXELS} at most (choose fewer dpi, or a smaller figure)"
    )]
    TooManyPixels(u64, u64),
    /// Pixels of a film that would be too large.
    #[error(
        "{0} pixels for all frames are too many: {MOST_FILM_PIXELS} at most (choose a smaller width, a shorter duration or fewer fps)"
    )]
    TooMuchFilm(u64),
    /// The encoder refuses.
    #[error("the picture can't be encoded: {0}")]
    Encoding(String),
    /// A shape or poses that can't be drawn.
    #[error("{0}")]
    Drawing(String),
}
