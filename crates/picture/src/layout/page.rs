//! The page of a chart.

use super::axes::{backdrop, marks, x_axis, x_tick_marks, y_axis};
use super::labels::{axis_label, fit_runs, legend_labels};
use super::legend::legend;
use super::measures::{
    BETWEEN_PANELS, EDGE, GAP, LEAST_PANEL, LINE, LONGEST_LABEL, MOST_OF_PAGE, MOST_PEAK_ROWS,
    PEAK_GAP, TICK, USUAL_ROWS, Y_TICKS,
};
use super::note::{note, note_height, note_lines};
use super::panel::{Frame, curves};
use super::peaks::Peaks;
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
        Ok(self.draw_scaled()?.0)
    }

    /// Draws the chart, and returns its scales.
    pub(super) fn draw_scaled(&self) -> Result<(Scene, Scales), Fault> {
        self.check()?;
        // Values of peaks are worth a row, but not the figure.
        for most_rows in [MOST_PEAK_ROWS, 3, 1] {
            match self.draw_with(most_rows) {
                Err(Fault::TooSmall) => {}
                drawn => return drawn,
            }
        }
        self.draw_with(0)
    }

    /// What its axes cut off, by curve: `driver.motor.effort: 628.6 N·m at 1.748 s`.
    ///
    /// # Errors
    /// As [`Chart::draw`].
    pub fn cut_off(&self) -> Result<Vec<String>, Fault> {
        let (_, panels) = ranges(self, 0)?;
        Ok(panels
            .iter()
            .flat_map(|ranged| ranged.peaks.words(&ranged.panel.axis.name))
            .collect())
    }

    /// Draws the chart, with values of peaks in so many rows above each panel at most.
    fn draw_with(&self, most_rows: usize) -> Result<(Scene, Scales), Fault> {
        let em = self.font_size;
        let mut scene = Scene::new(self.width(), 0.0);
        scene.title = printable(&self.title);
        scene.about = printable(&self.note);
        let labels = legend_labels(self);
        let (x_range, panels) = ranges(self, most_rows)?;
        let [top, bottom] = margins(self, &labels, &panels, &mut scene)?;

        // Heights of the panels give the ticks, their labels the left margin, and that the x axis.
        let each = panel_height(self, &panels, [top, bottom])?;
        let frames = frames(self, &panels, top, each);
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
            frame.peaks.marks([&x_scale, &frame.scale], em, &mut scene);
            y_axis(self, frame, [left, right], &mut scene);
        }
        let last = frames.len() - 1;
        for (index, frame) in frames.iter().enumerate() {
            let above = match index {
                0 => labels_of_marks(self) + PEAK_GAP * em,
                _ => PEAK_GAP * em,
            };
            let foot = frame.scale.end - above;
            frame.peaks.texts(foot, &x_scale, em, &mut scene);
            x_tick_marks(self, &x_scale, &x_ticks, frame, index == last, &mut scene);
        }
        let text = fit_runs(axis_label(&self.x, x_ticks.exponent), em, right - left);
        let at = [(left + right) / 2.0, bottom + above_foot(em) - 0.25 * em];
        scene.label("x-label", at, text, em, Anchor::Middle);
        let scales = Scales {
            x: x_scale,
            y: frames.iter().map(|frame| frame.scale).collect(),
        };
        Ok((scene, scales))
    }
}

/// Scales of a drawn chart.
#[derive(Debug, Clone)]
pub struct Scales {
    /// Of the x axis.
    pub x: Scale,
    /// Of each panel.
    pub y: Vec<Scale>,
}

/// Height of ticks, numbers and label of the x axis.
fn above_foot(em: f64) -> f64 {
    (LINE + GAP + LINE) * em + TICK * em
}

/// Places from above title and legend, from below note and x axis, and gives the page its height; between which heights the
/// panels lie.
fn margins(
    chart: &Chart,
    labels: &[String],
    panels: &[Ranged],
    scene: &mut Scene,
) -> Result<[f64; 2], Fault> {
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
    top += labels_of_marks(chart) + 0.5 * em;
    top += panels.first().map_or(0.0, |first| first.above);
    let lines = note_lines(chart, width);
    let foot = EDGE * em + note_height(&lines, em) + above_foot(em);
    let height = chart.height().unwrap_or_else(|| {
        let peaks: f64 = panels.iter().map(|panel| panel.above).sum();
        let first = panels.first().map_or(0.0, |first| first.above);
        default_height(chart, rows, [top + foot + peaks - first, peaks])
    });
    let most = MOST_OF_PAGE * height;
    let is_full = rows as f64 * LINE * em > most || note_height(&lines, em) > most;
    if chart.height().is_some() && is_full {
        return Err(Fault::TooSmall);
    }
    scene.height = height;
    note(&lines, em, scene);
    Ok([top, height - foot])
}

/// A panel with the range of its y axis.
struct Ranged<'c> {
    panel: &'c Panel,
    range: [f64; 2],
    peaks: Peaks,
    /// Height of the values of peaks above it \[pt\].
    above: f64,
}

/// The range of the x axis, and those of the panels with their peaks.
fn ranges(chart: &Chart, most_rows: usize) -> Result<([f64; 2], Vec<Ranged<'_>>), Fault> {
    if chart.panels.is_empty() {
        return Err(Fault::Nothing("no curve is given".into()));
    }
    let x_range = chart.x_range()?;
    let ranged = |panel| {
        let range = chart.y_range(panel, x_range)?;
        let peaks = Peaks::of(chart, panel, [x_range, range], most_rows);
        Ok(Ranged {
            panel,
            range,
            above: peaks.height(chart.font_size),
            peaks,
        })
    };
    let panels: Result<Vec<_>, Fault> = chart.panels.iter().map(ranged).collect();
    Ok((x_range, panels?))
}

/// Height of the labels of marks above the first panel \[pt\].
fn labels_of_marks(chart: &Chart) -> f64 {
    let has_labels = chart.marks.iter().any(|mark| !mark.label.is_empty());
    if has_labels {
        LINE * chart.font_size
    } else {
        0.0
    }
}

/// Height of each panel \[pt\].
fn panel_height(chart: &Chart, panels: &[Ranged], [top, bottom]: [f64; 2]) -> Result<f64, Fault> {
    let em = chart.font_size;
    let count = panels.len() as f64;
    let further: f64 = panels.iter().skip(1).map(|panel| panel.above).sum();
    let each = (bottom - top - further - (count - 1.0) * BETWEEN_PANELS * em) / count;
    if each < LEAST_PANEL * em {
        return Err(Fault::TooSmall);
    }
    Ok(each)
}

/// The panels from above, each with that height.
fn frames<'r, 'c>(
    chart: &Chart,
    panels: &'r [Ranged<'c>],
    top: f64,
    each: f64,
) -> Vec<Frame<'r, 'c>> {
    let em = chart.font_size;
    let mut upper = top;
    let mut frames = Vec::new();
    for (index, ranged) in panels.iter().enumerate() {
        if index > 0 {
            upper += ranged.above;
        }
        let [low, high] = ranged.range;
        let axis = &ranged.panel.axis;
        let scale = Scale {
            low,
            high,
            log: axis.log,
            start: upper + each,
            end: upper,
        };
        frames.push(Frame {
            panel: ranged.panel,
            peaks: &ranged.peaks,
            scale,
            ticks: scale.ticks(Y_TICKS * em, axis.unit == "deg"),
        });
        upper += each + BETWEEN_PANELS * em;
    }
    frames
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
/// `fixed` is what is above, between and below the panels, and `peaks` the part of it for the values of peaks.
fn default_height(chart: &Chart, legend_rows: usize, [fixed, peaks]: [f64; 2]) -> f64 {
    let em = chart.font_size;
    let count = chart.panels.len().max(1) as f64;
    let usual =
        chart.usual_height() + legend_rows.saturating_sub(USUAL_ROWS) as f64 * LINE * em + peaks;
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
