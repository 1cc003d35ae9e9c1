//! All colours: of figures and films, and of the page, which has a light and a dark theme. Figures are on white paper: light.
//!
//! Curves and bodies have the colours of Okabe and Ito (2008), made for all kinds of colour vision. The three light ones are
//! darkened, so that a thin line has a contrast of 3 to 1 at least, as WCAG 2.2 (1.4.11) requires.

use std::fmt::Write as _;

use serde_json::{Value, json};

/// Red, green, blue.
pub type Rgb = [u8; 3];

const BLACK: Rgb = [0, 0, 0];
const WHITE: Rgb = [255, 255, 255];
const BLUE: Rgb = [0, 114, 178];
const VERMILION: Rgb = [213, 94, 0];
const GREEN: Rgb = [0, 158, 115];
const PURPLE: Rgb = [190, 96, 148];
const SKY: Rgb = [46, 147, 205];
const ORANGE: Rgb = [188, 128, 0];
const SLATE: Rgb = [96, 108, 124];

/// Colours of curves, black first.
pub const CURVES: [Rgb; 7] = [BLACK, BLUE, VERMILION, GREEN, PURPLE, SKY, ORANGE];
/// Hues of bodies; neighbours differ most.
const BODIES: [Rgb; 7] = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, SLATE];

/// A colour on light and on dark ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tone {
    /// What the page's style sheet calls it; empty where that has no name for it.
    pub name: &'static str,
    /// On paper, and in the light theme.
    pub light: Rgb,
    /// In the dark theme.
    pub dark: Rgb,
}

const fn tone(name: &'static str, light: Rgb, dark: Rgb) -> Tone {
    Tone { name, light, dark }
}

/// Ground of drawings and plots.
pub const CARD: Tone = tone("card", WHITE, [0x16, 0x1c, 0x23]);
/// Text, springs.
pub const INK: Tone = tone("ink", [0x16, 0x20, 0x2b], [0xe4, 0xe9, 0xef]);
/// Inside of pins.
pub const PIN: Tone = tone("pin", WHITE, [0x0e, 0x13, 0x18]);
/// Edges of pins, and welds.
pub const STEEL: Tone = tone("steel", [0x3d, 0x48, 0x54], [0xc3, 0xcc, 0xd6]);
/// What does not move.
pub const GROUND: Tone = tone("ground", [0x6d, 0x77, 0x82], [0x88, 0x94, 0xa1]);
/// Drivers; what can be clicked.
pub const ACCENT: Tone = tone("accent", [0x0b, 0x5c, 0xad], [0x79, 0xb8, 0xff]);
/// Applied forces and torques.
pub const LOAD: Tone = tone("load", [0x6b, 0x2f, 0xa0], [0xc9, 0xa0, 0xff]);
/// Forces in joints, clearances.
pub const FORCE: Tone = tone("force", [0xb3, 0x26, 0x1e], [0xff, 0x8a, 0x80]);

/// What is less important.
pub const MUTED: Tone = tone("muted", [0x56, 0x62, 0x70], [0x9b, 0xa8, 0xb6]);
/// What is to be doubted.
pub const WARN: Tone = tone("warn", [0x8a, 0x4b, 0x00], [0xf0, 0xb4, 0x5c]);
/// What is wrong.
pub const BAD: Tone = tone("bad", [0xa3, 0x20, 0x1a], [0xff, 0x8f, 0x85]);

/// Axes of a chart.
pub const AXIS: Rgb = [60; 3];
/// Grid lines of a chart.
pub const GRID: Rgb = [215; 3];
/// Marks of a chart.
pub const MARK: Rgb = [120; 3];

/// The colours that the page's style sheet and scripts know by name.
const NAMED: [Tone; 15] = [
    tone("bg", [0xf3, 0xf5, 0xf8], [0x0e, 0x13, 0x18]),
    CARD,
    INK,
    MUTED,
    tone("line", [0xd5, 0xdb, 0xe3], [0x2d, 0x37, 0x42]),
    tone("grid", [0xe6, 0xea, 0xef], [0x23, 0x2c, 0x35]),
    ACCENT,
    tone("good", [0x17, 0x69, 0x3a], [0x63, 0xcf, 0x8f]),
    WARN,
    BAD,
    LOAD,
    FORCE,
    PIN,
    STEEL,
    GROUND,
];

/// Fill and outline of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BodyColours {
    /// Fill.
    pub fill: Tone,
    /// Outline.
    pub line: Tone,
}

/// The colours of a body by its number; the ground is 0.
pub fn body(number: usize) -> BodyColours {
    let Some(index) = number.checked_sub(1) else {
        return BodyColours {
            fill: CARD,
            line: GROUND,
        };
    };
    let hue = BODIES[index % BODIES.len()];
    BodyColours {
        fill: tone("", mix(hue, WHITE, 0.62), mix(hue, CARD.dark, 0.55)),
        line: tone("", mix(hue, BLACK, 0.38), mix(hue, WHITE, 0.45)),
    }
}

/// The colour of a curve by its number.
pub fn curve(number: usize) -> Tone {
    let light = CURVES[number % CURVES.len()];
    tone(
        "",
        light,
        mix(light, WHITE, if light == BLACK { 0.85 } else { 0.4 }),
    )
}

/// A colour with so much of another.
fn mix(one: Rgb, other: Rgb, part: f64) -> Rgb {
    let channel = |k: usize| f64::from(one[k]) + part * (f64::from(other[k]) - f64::from(one[k]));
    [0, 1, 2].map(|k| channel(k).round() as u8)
}

/// `#0b5cad`.
fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The named colours as custom properties of a style sheet.
pub fn style_sheet() -> String {
    let mut text = String::from(":root {\n");
    for tone in NAMED {
        let name = tone.name;
        let [light, dark] = [hex(tone.light), hex(tone.dark)];
        // Writing to a String can't fail.
        let _ = writeln!(text, "  --{name}: light-dark({light}, {dark});");
    }
    text + "}\n"
}

/// The colours of bodies and curves for the page's scripts.
pub fn to_json() -> Value {
    let both = |tone: Tone| json!({ "light": hex(tone.light), "dark": hex(tone.dark) });
    let body = |number: usize| {
        let BodyColours { fill, line } = body(number);
        json!({ "fill": both(fill), "line": both(line) })
    };
    json!({
        "bodies": (1..=BODIES.len()).map(body).collect::<Value>(),
        "curves": (0..CURVES.len()).map(|number| both(curve(number))).collect::<Value>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance by WCAG 2.2.
    fn luminance(rgb: Rgb) -> f64 {
        let [r, g, b] = rgb.map(|channel| {
            let c = f64::from(channel) / 255.0;
            if c <= 0.04045 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        });
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    fn contrast(a: Rgb, b: Rgb) -> f64 {
        let [a, b] = [luminance(a), luminance(b)];
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn lines_can_be_seen_on_both_grounds() {
        let curves = (0..CURVES.len()).map(curve);
        let outlines = (0..=BODIES.len()).map(|number| body(number).line);
        let signs = [INK, STEEL, GROUND, ACCENT, LOAD, FORCE];
        for tone in curves.chain(outlines).chain(signs) {
            for (ground, ink) in [(CARD.light, tone.light), (CARD.dark, tone.dark)] {
                let contrast = contrast(ground, ink);
                assert!(contrast >= 3.0, "{ink:?} on {ground:?}: {contrast}");
            }
        }
    }

    #[test]
    fn outlines_can_be_told_from_fills() {
        for number in 0..=BODIES.len() {
            let BodyColours { fill, line } = body(number);
            for (fill, line) in [(fill.light, line.light), (fill.dark, line.dark)] {
                let contrast = contrast(fill, line);
                assert!(contrast >= 3.0, "body {number}: {contrast}");
            }
        }
    }

    #[test]
    fn the_style_sheet_has_both_themes() {
        let text = style_sheet();
        assert!(
            text.contains("--accent: light-dark(#0b5cad, #79b8ff);"),
            "{text}"
        );
        assert_eq!(
            to_json()["bodies"][0]["line"]["light"],
            hex(body(1).line.light)
        );
    }
}
