//! Scripts that pages share: each stands in the program once.

/// The data of a page, and elements with text.
pub const EMBEDDED: &str = include_str!("report/js/embedded.js");
/// Light or dark.
pub const THEME: &str = include_str!("report/js/theme.js");
/// Numbers as text.
pub const UNITS: &str = include_str!("report/js/units.js");
/// Where things are.
pub const SHAPES: &str = include_str!("report/js/shapes.js");
/// Signs of joints, springs and drivers.
pub const SYMBOLS: &str = include_str!("report/js/symbols.js");
/// The mechanism on a canvas.
pub const DRAWING: &str = include_str!("report/js/drawing.js");
