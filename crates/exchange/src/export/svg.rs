//! SVG in millimetres, a group of Inkscape's for each layer.

use std::fmt::Write as _;

use super::outline::Sheet;
use crate::form::{Corner, Form};

/// Room around what is drawn, and width of lines, in parts of its size.
const MARGIN: f64 = 0.04;
const LINE: f64 = 0.002;

/// The file of a drawing; nothing is filled, so that cutters follow the lines alone.
pub fn svg(sheet: &Sheet) -> String {
    let mm = sheet.millimetres();
    let [left, bottom, right, top] = sheet.edges().unwrap_or_default();
    let size = (right - left).max(top - bottom).max(1e-9);
    let margin = round(MARGIN * size);
    let x = round(left - margin);
    let y = round(-top - margin);
    let (wide, tall) = (round(right + margin - x), round(margin - bottom - y));
    let stroke = round(LINE * size);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
         width=\"{wide}mm\" height=\"{tall}mm\" viewBox=\"{x} {y} {wide} {tall}\" fill=\"none\" stroke-width=\"{stroke}\" \
         font-family=\"sans-serif\">\n<title>{}</title>\n",
        escaped(&sheet.title)
    );
    for layer in &sheet.layers {
        let [r, g, b] = layer.colour;
        let name = escaped(&layer.name);
        // Writing to a text does not fail.
        let _ = writeln!(
            text,
            "<g inkscape:groupmode=\"layer\" inkscape:label=\"{name}\" stroke=\"#{r:02x}{g:02x}{b:02x}\">"
        );
        for form in &layer.forms {
            let at = |place: [f64; 2]| [mm(place[0]), -mm(place[1]) + 0.0];
            let drawn = match form {
                Form::Line { corners, closed } => {
                    format!("<path d=\"{}\"/>", path(corners, *closed, at, &mm))
                }
                Form::Circle { centre, radius } => {
                    let [x, y] = at(*centre);
                    format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{}\"/>", mm(*radius))
                }
                // A line without a length, which has round ends, is a dot.
                Form::Point(place) => {
                    let ([x, y], wide) = (at(*place), round(3.0 * stroke));
                    format!(
                        "<path d=\"M{x} {y}h0\" stroke-linecap=\"round\" stroke-width=\"{wide}\"/>"
                    )
                }
                Form::Text {
                    at: place,
                    height,
                    text,
                } => {
                    let [x, y] = at(*place);
                    // Letters are 0.7 of what fonts call their size.
                    let size = round(mm(*height) / 0.7);
                    let text = escaped(text);
                    format!(
                        "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" stroke=\"none\" fill=\"#{r:02x}{g:02x}{b:02x}\">{text}</text>"
                    )
                }
            };
            text.push_str("  ");
            text.push_str(&drawn);
            text.push('\n');
        }
        text.push_str("</g>\n");
    }
    text.push_str("</svg>\n");
    text
}

/// Sizes that nobody measures, with four digits.
fn round(value: f64) -> f64 {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    rounded + 0.0
}

fn path(
    corners: &[Corner],
    closed: bool,
    at: impl Fn([f64; 2]) -> [f64; 2],
    mm: impl Fn(f64) -> f64,
) -> String {
    let mut path = String::new();
    let count = corners.len();
    for (k, corner) in corners.iter().enumerate() {
        let [x, y] = at(corner.place);
        let before = match (k, corners.get(k.wrapping_sub(1))) {
            (0, _) | (_, None) => {
                let _ = write!(path, "M{x} {y}");
                continue;
            }
            (_, Some(before)) => before,
        };
        path.push_str(&piece(before, corner, [x, y], &mm));
    }
    if let (true, [first, .., last]) = (closed, corners) {
        if last.bulge != 0.0 && count > 1 {
            path.push_str(&piece(last, first, at(first.place), &mm));
        }
        path.push('Z');
    }
    path
}

/// The way from one corner to the next.
fn piece(from: &Corner, to: &Corner, [x, y]: [f64; 2], mm: impl Fn(f64) -> f64) -> String {
    let bulge = from.bulge;
    if bulge == 0.0 {
        return format!("L{x} {y}");
    }
    let [dx, dy] = [to.place[0] - from.place[0], to.place[1] - from.place[1]];
    let radius = mm(dx.hypot(dy) * (1.0 + bulge * bulge) / (4.0 * bulge.abs()));
    // With y downwards what turns left has a negative angle.
    let (large, right) = (u8::from(bulge.abs() > 1.0), u8::from(bulge < 0.0));
    format!("A{radius} {radius} 0 {large} {right} {x} {y}")
}

fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            other if other.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}
