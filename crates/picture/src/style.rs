//! Curves that can be distinguished: by colour, and in grey print by dashes, and beyond those by markers.

use super::palette;
use super::scene::{Ink, Pen};

const DASHES: [&[f64]; 4] = [&[], &[4.0, 1.8], &[6.0, 1.6, 1.0, 1.6], &[1.2, 1.4]];

/// Sign on a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    None,
    Circle,
    Square,
    Triangle,
    Diamond,
}

const MARKERS: [Marker; 5] = [
    Marker::None,
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
];

/// Number of styles of which no two share both dashes and markers.
pub const DISTINCT: usize = DASHES.len() * MARKERS.len();

/// How a curve looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    pub pen: Pen,
    pub marker: Marker,
}

/// The style of the curve with that number.
pub fn style(number: usize, width: f64) -> Style {
    let ink = Ink::new(palette::curve(number).light);
    let pen = Pen {
        ink,
        width,
        dash: DASHES[number % DASHES.len()],
    };
    Style {
        pen,
        marker: MARKERS[(number / DASHES.len()) % MARKERS.len()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_styles_are_the_same_in_grey() {
        for a in 0..DISTINCT {
            for b in 0..a {
                let (x, y) = (style(a, 1.0), style(b, 1.0));
                assert!(x.pen.dash != y.pen.dash || x.marker != y.marker, "{a} {b}");
            }
        }
    }
}
