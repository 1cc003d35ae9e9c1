//! The note below the panels.

use super::measures::{EDGE, LINE, NOTE};
use crate::chart::Chart;
use crate::font;
use crate::scene::{Anchor, Run, Scene};
use crate::words::printable;

/// The note, wrapped.
pub fn note_lines(chart: &Chart, width: f64) -> Vec<String> {
    if chart.note.is_empty() {
        return Vec::new();
    }
    let size = NOTE * chart.font_size;
    let room = width - 2.0 * EDGE * chart.font_size;
    let mut lines = vec![String::new()];
    for word in printable(&chart.note).split_whitespace() {
        let line = lines.last_mut().map(std::mem::take).unwrap_or_default();
        let longer = if line.is_empty() {
            word.to_string()
        } else {
            format!("{line} {word}")
        };
        if font::width(&longer, size) <= room || line.is_empty() {
            lines.pop();
            lines.push(longer);
        } else {
            lines.pop();
            lines.extend([line, word.to_string()]);
        }
    }
    lines
        .iter()
        .map(|line| font::fit(line, size, room))
        .collect()
}

/// Height of the note with the gap above it.
pub fn note_height(lines: &[String], em: f64) -> f64 {
    if lines.is_empty() {
        0.0
    } else {
        (lines.len() as f64 * LINE * NOTE + 0.3) * em
    }
}

/// The note, at the foot of the page.
pub fn note(lines: &[String], em: f64, scene: &mut Scene) {
    let size = NOTE * em;
    let start = scene.height - EDGE * em - lines.len() as f64 * LINE * size;
    for (index, line) in lines.iter().enumerate() {
        let at = [EDGE * em, start + (index as f64 + 0.8) * LINE * size];
        scene.label(
            "note",
            at,
            vec![Run::plain(line.as_str())],
            size,
            Anchor::Start,
        );
    }
}
