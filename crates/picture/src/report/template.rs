//! `page.html`, and what is put into it.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};

use super::encode::base64;
use crate::palette;

const PAGE: &str = include_str!("page.html");
pub(crate) const PLOT_STYLE: &str = include_str!("vendor/uPlot.min.css");
pub(crate) const PAGE_STYLE: &str = include_str!("page.css");
pub(crate) const PLOT_LIBRARY: &str = include_str!("vendor/uPlot.iife.min.js");
/// Its licence asks to stand in every copy.
pub(crate) const LICENCE: &str = include_str!("vendor/uPlot.LICENSE");
/// In the order in which they build on each other.
const SCRIPT: &str = concat!(
    include_str!("js/data.js"),
    include_str!("js/theme.js"),
    include_str!("js/units.js"),
    include_str!("js/player.js"),
    include_str!("js/shapes.js"),
    include_str!("js/symbols.js"),
    include_str!("js/drawing.js"),
    include_str!("js/labels.js"),
    include_str!("js/forces.js"),
    include_str!("js/stage.js"),
    include_str!("js/mini.js"),
    include_str!("js/choices.js"),
    include_str!("js/clearance.js"),
    include_str!("js/plot_marks.js"),
    include_str!("js/plot.js"),
    include_str!("js/plots.js"),
    include_str!("js/hits.js"),
    include_str!("js/headline.js"),
    include_str!("js/tables.js"),
    include_str!("js/diagnosis.js"),
    include_str!("js/head.js"),
    include_str!("js/svg_pen.js"),
    include_str!("js/figure.js"),
    include_str!("js/take.js"),
    include_str!("js/transport.js"),
    include_str!("js/drawer.js"),
    include_str!("js/keys.js"),
);

/// Bytes of a page without data.
pub fn fixed_length() -> usize {
    PAGE.len() + style().len() + LICENCE.len() + PLOT_LIBRARY.len() + SCRIPT.len()
}

/// The page with its data, JSON that is escaped, and its values in base64.
pub fn page(data: &str, values: &str) -> String {
    let style = style();
    fill(&[
        ("policy", &policy(&style)),
        ("style", &style),
        ("data", data),
        ("values", values),
        ("licence", LICENCE),
        ("plot_library", PLOT_LIBRARY),
        ("script", SCRIPT),
    ])
}

/// All styles; the colours come from the palette.
fn style() -> String {
    [PLOT_STYLE, &palette::style_sheet(), PAGE_STYLE].join("\n")
}

/// The template with its `{{words}}` replaced, in one pass: what is put in is not looked at again.
fn fill(parts: &[(&str, &str)]) -> String {
    let mut text =
        String::with_capacity(PAGE.len() + parts.iter().map(|(_, part)| part.len()).sum::<usize>());
    for (index, piece) in PAGE.split("{{").enumerate() {
        let (word, rest) = if index == 0 {
            ("", piece)
        } else {
            piece.split_once("}}").unwrap_or(("", piece))
        };
        text.extend(
            parts
                .iter()
                .find(|(name, _)| *name == word)
                .map(|(_, part)| *part),
        );
        text.push_str(rest);
    }
    text
}

/// Only our own scripts and styles, no network, no forms, no frames.
fn policy(style: &str) -> String {
    let hash = |text: &str| format!("'sha256-{}'", base64(&Sha256::digest(text.as_bytes())));
    format!(
        "default-src 'none'; script-src {} {}; style-src {}; base-uri 'none'; form-action 'none'",
        hash(PLOT_LIBRARY),
        hash(SCRIPT),
        hash(style)
    )
}

/// JSON that can stand in a script element: no tag, comment or line separator in it can end or change anything.
pub fn escaped(json: &str) -> String {
    let mut text = String::with_capacity(json.len() + json.len() / 16);
    for c in json.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                let _ = write!(text, "\\u{:04x}", c as u32);
            }
            _ => text.push(c),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn json_in_a_script_element_can_not_end_it() {
        let text = escaped(&json!("</script><!-- & \u{2028}\u{2029} \" ok").to_string());
        assert!(
            !text.contains(['<', '>', '&', '\u{2028}', '\u{2029}']),
            "{text}"
        );
        let back: String = serde_json::from_str(&text).expect("still JSON");
        assert_eq!(back, "</script><!-- & \u{2028}\u{2029} \" ok");
    }

    #[test]
    fn the_scripts_can_stand_in_a_page() {
        for text in [SCRIPT, PLOT_LIBRARY, &style()] {
            assert!(
                !text.to_lowercase().contains("</script")
                    && !text.contains("<!--")
                    && !text.contains("</style")
            );
        }
    }

    #[test]
    fn every_word_of_the_template_is_filled_in() {
        let words: Vec<&str> = PAGE
            .split("{{")
            .skip(1)
            .filter_map(|piece| Some(piece.split_once("}}")?.0))
            .collect();
        assert_eq!(
            words,
            [
                "policy",
                "style",
                "data",
                "values",
                "licence",
                "plot_library",
                "script"
            ]
        );
        assert!(
            !LICENCE.contains("--"),
            "it would end the comment it stands in"
        );
    }
}
