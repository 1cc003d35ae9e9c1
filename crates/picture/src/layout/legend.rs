//! The legend above the panels.

use super::measures::{EDGE, LINE, SAMPLE};
use crate::chart::Chart;
use crate::font;
use crate::scene::{Anchor, Run, Scene};
use crate::style::{Style, style};
use crate::symbols;
use crate::words::printable;

/// The legend in columns; returns the number of its rows. None for a single curve without a label.
pub fn legend(chart: &Chart, labels: &[String], scene: &mut Scene, top: f64) -> usize {
    if labels.iter().all(String::is_empty) {
        return 0;
    }
    let em = chart.font_size;
    let room = scene.width - 2.0 * EDGE * em;
    let before = (SAMPLE + 0.5) * em;
    let texts: Vec<String> = labels
        .iter()
        .map(|label| font::fit(&printable(label), em, room - before))
        .collect();
    let widest = texts
        .iter()
        .map(|text| font::width(text, em))
        .fold(0.0, f64::max)
        + before
        + 1.2 * em;
    let columns = ((room + 1.2 * em) / widest)
        .floor()
        .clamp(1.0, texts.len() as f64) as usize;
    let rows = texts.len().div_ceil(columns);
    let columns = texts.len().div_ceil(rows);
    let start = (scene.width - (columns as f64 * widest - 1.2 * em)) / 2.0;
    for (index, text) in texts.iter().enumerate() {
        let x = start + (index % columns) as f64 * widest;
        let middle = top + ((index / columns) as f64 + 0.5) * LINE * em;
        let Style { pen, marker } = style(index, chart.line_width);
        scene.line("sample", [[x, middle], [x + SAMPLE * em, middle]], pen);
        symbols::marker(scene, marker, [x + SAMPLE * em / 2.0, middle], pen);
        let at = [x + before, middle + font::CAPITALS * em / 2.0];
        scene.label(
            "legend",
            at,
            vec![Run::plain(text.as_str())],
            em,
            Anchor::Start,
        );
    }
    rows
}
