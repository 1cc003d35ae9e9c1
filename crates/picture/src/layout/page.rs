//! The page of a chart.

use super::axes::{backdrop, marks, x_axis, x_tick_marks, y_axis};
use super::labels::{axis_label, fit_runs, legend_labels};
use super::legend::legend;
use super::measures::{
    BETWEEN_PANELS, EDGE, GAP, LEAST_PANEL, LINE, LONGEST_LABEL, MOST_OF_PAGE, TICK, USUAL_ROWS,
    Y_TICKS,
};
use super::note::{note, note_height, note_lines};
use super::panel::{Frame, curves};
use crate::chart::{Chart, Panel};
use crate::fault::Fault;
use crate::font;
use crate::scale::Scale;
use crate::scene::{Anchor, Run, Scene};
use crate::words::printable;

impl Chart {
    /// Draws the chart.
    ///
    /// # Errors
    /// When there is nothing to draw, no room for it, or no such range.
    pub fn draw(&self) -> Result<Scene, Fault> {
        self.check()?;
        let em = self.font_size;
        let mut scene = Scene::new(self.width(), 0.0);
        scene.title = printable(&self.title);
        scene.about = printable(&self.note);
        let labels = legend_labels(self);
        let [top, bottom] = margins(self, &labels, &mut scene)?;

        // Heights of the panels give the ticks, their labels the left margin, and that the x axis.
        let each = panel_height(self, [top, bottom])?;
        let x_range = self.x_range()?;
        let frames = frames(self, x_range, top, each)?;
        let left = left_margin(&frames, em);
        // The last x tick label may stand out by half of its width.
        let right = self.width() - 1.2 * em;
        if right - left < LEAST_PANEL * em {
            return Err(Fault::TooSmall);
        }
        let (x_scale, x_ticks) = x_axis(self, x_range, [left, right]);

        for frame in &frames {
            backdrop(self, frame, &x_scale, &x_ticks, &mut scene);
        }
        marks(self, &x_scale, [top, bottom], &mut scene);
        for frame in &frames {
            curves(self, frame, &x_scale, &labels, &mut scene);
            y_axis(self, frame, [left, right], &mut scene);
        }
        let last = frames.len() - 1;
        for (index, frame) in frames.iter().enumerate() {
            x_tick_marks(self, &x_scale, &x_ticks, frame, index == last, &mut scene);
        }
        let text = fit_runs(axis_label(&self.x, x_ticks.exponent), em, right - left);
        let at = [(left + right) / 2.0, bottom + above_foot(em) - 0.25 * em];
        scene.label("x-label", at, text, em, Anchor::Middle);
        Ok(scene)
    }
}

/// Height of ticks, numbers and label of the x axis.
fn above_foot(em: f64) -> f64 {
    (LINE + GAP + LINE) * em + TICK * em
}

/// Places from above title and legend, from below note and x axis, and gives the page its height; between which heights the
/// panels lie.
fn margins(chart: &Chart, labels: &[String], scene: &mut Scene) -> Result<[f64; 2], Fault> {
    let (em, width) = (chart.font_size, chart.width());
    let mut top = EDGE * em;
    if !chart.title.is_empty() {
        let text = font::fit(&printable(&chart.title), 1.1 * em, width - 2.0 * EDGE * em);
        let at = [width / 2.0, top + 1.1 * em * font::CAPITALS + 0.1 * em];
        let runs = vec![Run::plain(text)];
        scene.label("title", at, runs, 1.1 * em, Anchor::Middle);
        top += 1.1 * em * LINE;
    }
    let rows = legend(chart, labels, scene, top);
    top += rows as f64 * LINE * em;
    if chart.marks.iter().any(|mark| !mark.label.is_empty()) {
        top += LINE * em;
    }
    top += 0.5 * em;
    let lines = note_lines(chart, width);
    let foot = EDGE * em + note_height(&lines, em) + above_foot(em);
    let height = chart
        .height()
        .unwrap_or_else(|| default_height(chart, rows, top + foot));
    let most = MOST_OF_PAGE * height;
    let is_full = rows as f64 * LINE * em > most || note_height(&lines, em) > most;
    if chart.height().is_some() && is_full {
        return Err(Fault::TooSmall);
    }
    scene.height = height;
    note(&lines, em, scene);
    Ok([top, height - foot])
}

/// Height of each panel \[pt\].
fn panel_height(chart: &Chart, [top, bottom]: [f64; 2]) -> Result<f64, Fault> {
    let em = chart.font_size;
    if chart.panels.is_empty() {
        return Err(Fault::Nothing("no curve is given".into()));
    }
    let count = chart.panels.len() as f64;
    let each = (bottom - top - (count - 1.0) * BETWEEN_PANELS * em) / count;
    if each < LEAST_PANEL * em {
        return Err(Fault::TooSmall);
    }
    Ok(each)
}

/// The panels from above, each with that height.
fn frames<'c>(
    chart: &'c Chart,
    x_range: [f64; 2],
    top: f64,
    each: f64,
) -> Result<Vec<Frame<'c>>, Fault> {
    let em = chart.font_size;
    let frame = |(index, panel): (usize, &'c Panel)| {
        let [low, high] = chart.y_range(panel, x_range)?;
        let upper = top + index as f64 * (each + BETWEEN_PANELS * em);
        let scale = Scale {
            low,
            high,
            log: panel.axis.log,
            start: upper + each,
            end: upper,
        };
        let ticks = scale.ticks(Y_TICKS * em, panel.axis.unit == "deg");
        Ok(Frame {
            panel,
            scale,
            ticks,
        })
    };
    chart.panels.iter().enumerate().map(frame).collect()
}

/// Where the axes begin: to the right of labels and numbers.
fn left_margin(frames: &[Frame], em: f64) -> f64 {
    let numbers = frames.iter().flat_map(|frame| &frame.ticks.major);
    let widest = numbers
        .map(|(_, runs)| font::width_of_runs(runs, em))
        .fold(0.0, f64::max);
    let has_label = frames
        .iter()
        .any(|frame| !axis_label(&frame.panel.axis, 0).is_empty());
    let label = if has_label { LINE * em } else { 0.0 };
    EDGE * em + label + widest + (TICK + GAP) * em
}

/// Height of a page that may have any: many rows of a legend do not take theirs from the curves, and labels of y axes are whole.
/// `fixed` is what is above and below the panels.
fn default_height(chart: &Chart, legend_rows: usize, fixed: f64) -> f64 {
    let em = chart.font_size;
    let count = chart.panels.len().max(1) as f64;
    let usual = chart.usual_height() + legend_rows.saturating_sub(USUAL_ROWS) as f64 * LINE * em;
    let rest = fixed + (count - 1.0) * BETWEEN_PANELS * em;
    // A power of ten may come to each.
    let label = |panel: &Panel| font::width_of_runs(&axis_label(&panel.axis, -6), em);
    let longest = chart
        .panels
        .iter()
        .map(label)
        .fold(0.0, f64::max)
        .min(LONGEST_LABEL * em);
    usual.max(rest + count * longest)
}
