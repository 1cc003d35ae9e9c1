//! Curves that can be told apart: by colour, and in grey print by dashes, and beyond those by markers.
//!
//! Colours: Okabe and Ito (2008), made for all kinds of colour vision, black first; the yellow is left out, which is too light
//! for lines.

use super::scene::{Ink, Pen};

const COLOURS: [[u8; 3]; 7] = [
    [0, 0, 0],
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
    [230, 159, 0],
];

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
    let ink = Ink::new(COLOURS[number % COLOURS.len()]);
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
