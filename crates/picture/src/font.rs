//! The vendored font, Liberation Sans Regular 2.1.5 (SIL Open Font License, `font/LICENSE.txt`): widths and outlines.
//!
//! Its widths are those of Arial and Helvetica, so a layout made with it holds for an SVG that is shown with one of these.

use std::sync::OnceLock;

use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::scene::{RAISED_SIZE, Run};

static FILE: &[u8] = include_bytes!("font/LiberationSans-Regular.ttf");

/// Families with these widths, then whatever there is.
pub const FAMILIES: &str = "'Liberation Sans', Arimo, Arial, Helvetica, sans-serif";

/// Height of capitals as a part of the size.
pub const CAPITALS: f64 = 0.72;

fn face() -> Option<&'static Face<'static>> {
    static FACE: OnceLock<Option<Face<'static>>> = OnceLock::new();
    FACE.get_or_init(|| Face::parse(FILE, 0).ok()).as_ref()
}

/// The glyph of a character; the empty box where the font has none.
fn glyph(face: &Face, c: char) -> GlyphId {
    face.glyph_index(c).unwrap_or(GlyphId(0))
}

/// Width of a text of that size.
pub fn width(text: &str, size: f64) -> f64 {
    let Some(face) = face() else {
        return 0.5 * size * text.chars().count() as f64;
    };
    let units: u64 = text
        .chars()
        .map(|c| u64::from(face.glyph_hor_advance(glyph(face, c)).unwrap_or(0)))
        .sum();
    units as f64 * size / f64::from(face.units_per_em())
}

/// Width of runs.
pub fn width_of_runs(runs: &[Run], size: f64) -> f64 {
    runs.iter()
        .map(|run| {
            width(
                &run.text,
                if run.raised { size * RAISED_SIZE } else { size },
            )
        })
        .sum()
}

/// The text, cut with an ellipsis where it is wider than `room`.
pub fn fit(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_string();
    }
    let ellipsis = width("…", size);
    let mut used = 0.0;
    let kept = text.chars().take_while(|c| {
        used += width(c.encode_utf8(&mut [0; 4]), size);
        used + ellipsis <= room
    });
    let kept: String = kept.collect();
    format!("{}…", kept.trim_end())
}

/// Draws the outlines of a text into `pen`, in font units with y upwards; `place` gets where each glyph begins.
pub fn outline<P: OutlineBuilder>(text: &str, pen: &mut P, mut place: impl FnMut(&mut P, f64)) {
    let Some(face) = face() else { return };
    let mut at = 0.0;
    for c in text.chars() {
        let glyph = glyph(face, c);
        place(pen, at);
        // A glyph without outline (a blank) draws nothing.
        let _ = face.outline_glyph(glyph, pen);
        at += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
    }
}

/// Font units per size.
pub fn units_per_em() -> f64 {
    face().map_or(1000.0, |face| f64::from(face.units_per_em()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_helvetica() {
        // Adobe's Helvetica.afm: digits 556, "m" 833, "i" 222 thousandths, to the font's rounding to 1/2048.
        for (text, thousandths) in [
            ("0", 556.0),
            ("8", 556.0),
            ("m", 833.0),
            ("i", 222.0),
            ("A", 667.0),
        ] {
            assert!(
                (width(text, 1000.0) - thousandths).abs() < 1.0,
                "{text}: {}",
                width(text, 1000.0)
            );
        }
    }

    #[test]
    fn the_signs_of_labels_are_in_the_font() {
        let face = face().expect("the vendored font is sound");
        for c in "0123456789−·×°²³µθωαφπ…[]".chars() {
            assert!(face.glyph_index(c).is_some(), "{c:?}");
        }
    }

    #[test]
    fn long_texts_are_cut_to_their_room() {
        assert_eq!(fit("crank", 8.0, 100.0), "crank");
        let cut = fit(&"w".repeat(100_000), 8.0, 50.0);
        assert!(cut.ends_with('…') && width(&cut, 8.0) <= 50.0, "{cut}");
        assert_eq!(fit("abc", 8.0, 0.0), "…");
    }
}
