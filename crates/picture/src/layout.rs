//! Places the parts of a chart on the page, from the outside inwards: title, legend, note, labels; the axes get the rest.
//!
//! Nothing can overlap the curves, since only they are drawn inside the axes.

use super::chart::{Axis, Chart, Panel};
use super::font;
use super::scale::{Scale, Ticks};
use super::scene::{Anchor, Ink, Item, Pen, Run, Scene};
use super::style::{Style, style};
use super::symbols;
use super::trace::trace;
use super::words::{printable, unit};
use super::{Fault, scene::Place};

/// Distances, as parts of the font size.
const EDGE: f64 = 0.4;
const LINE: f64 = 1.3;
const TICK: f64 = 0.35;
const GAP: f64 = 0.35;
const BETWEEN_PANELS: f64 = 1.1;
const SAMPLE: f64 = 2.8;
/// Longer labels of y axes are cut rather than given more height.
const LONGEST_LABEL: f64 = 22.0;
/// Size of the note.
const NOTE: f64 = 0.85;
/// Least distance of ticks on the axes.
const X_TICKS: f64 = 4.2;
const Y_TICKS: f64 = 2.2;
/// Least size of a panel.
const LEAST_PANEL: f64 = 4.0;
/// Rows of the legend that the usual height of a page has room for.
const USUAL_ROWS: usize = 2;
/// Largest part of a page of given height that the legend, and the note, may take.
const MOST_OF_PAGE: f64 = 0.5;

const AXIS_INK: Ink = Ink::grey(60);
const GRID_INK: Ink = Ink::grey(215);
const MARK_INK: Ink = Ink::grey(120);

/// A panel in the making.
struct Frame<'a> {
    panel: &'a Panel,
    scale: Scale,
    ticks: Ticks,
}

/// Draws the chart.
pub fn draw(chart: &Chart) -> Result<Scene, Fault> {
    let width = chart.width();
    let em = chart.font_size;
    let mut scene = Scene::new(width, 0.0);
    scene.title = printable(&chart.title);
    scene.about = printable(&chart.note);

    // From above: title, legend. From below: note, x label, x tick labels.
    let labels = legend_labels(chart);
    let mut top = EDGE * em;
    if !chart.title.is_empty() {
        let text = font::fit(&printable(&chart.title), 1.1 * em, width - 2.0 * EDGE * em);
        let at = [width / 2.0, top + 1.1 * em * font::CAPITALS + 0.1 * em];
        scene.label(
            "title",
            at,
            vec![Run::plain(text)],
            1.1 * em,
            Anchor::Middle,
        );
        top += 1.1 * em * LINE;
    }
    let rows = legend(chart, &labels, &mut scene, top);
    top += rows as f64 * LINE * em;
    if chart.marks.iter().any(|mark| !mark.label.is_empty()) {
        top += LINE * em;
    }
    top += 0.5 * em;
    let lines = note_lines(chart, width);
    let above_foot = (LINE + GAP + LINE) * em + TICK * em;
    let foot = EDGE * em + note_height(&lines, em) + above_foot;
    let height = chart
        .height()
        .unwrap_or_else(|| default_height(chart, rows, top + foot));
    let most = MOST_OF_PAGE * height;
    if chart.height().is_some()
        && (rows as f64 * LINE * em > most || note_height(&lines, em) > most)
    {
        return Err(Fault::TooSmall);
    }
    scene.height = height;
    let bottom = height - foot;
    let x_label_at = bottom + above_foot - 0.25 * em;
    note(&lines, em, &mut scene);

    // Heights of the panels give the ticks, their labels the left margin, and that the x axis.
    let count = chart.panels.len() as f64;
    let each = (bottom - top - (count - 1.0) * BETWEEN_PANELS * em) / count;
    if chart.panels.is_empty() || each < LEAST_PANEL * em {
        return Err(if chart.panels.is_empty() {
            Fault::Nothing("no curve is given".into())
        } else {
            Fault::TooSmall
        });
    }
    let x_range = chart.x_range()?;
    let mut frames = Vec::new();
    for (index, panel) in chart.panels.iter().enumerate() {
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
        frames.push(Frame {
            panel,
            scale,
            ticks,
        });
    }
    let widest = frames
        .iter()
        .flat_map(|frame| &frame.ticks.major)
        .map(|(_, runs)| font::width_of_runs(runs, em));
    let has_y_label = frames
        .iter()
        .any(|frame| !axis_label(&frame.panel.axis, 0).is_empty());
    let y_label = if has_y_label { LINE * em } else { 0.0 };
    let left = EDGE * em + y_label + widest.fold(0.0, f64::max) + (TICK + GAP) * em;
    // The last x tick label may stand out by half of its width.
    let right = width - 1.2 * em;
    if right - left < LEAST_PANEL * em {
        return Err(Fault::TooSmall);
    }
    let (x_scale, x_ticks) = x_axis(chart, x_range, [left, right]);

    for frame in &frames {
        backdrop(chart, frame, &x_scale, &x_ticks, &mut scene);
    }
    marks(chart, &x_scale, [top, bottom], &mut scene);
    for frame in &frames {
        curves(chart, frame, &x_scale, &labels, &mut scene);
        y_axis(chart, frame, [left, right], &mut scene);
    }
    let last = frames.len() - 1;
    for (index, frame) in frames.iter().enumerate() {
        x_tick_marks(chart, &x_scale, &x_ticks, frame, index == last, &mut scene);
    }
    let text = axis_label(&chart.x, x_ticks.exponent);
    let middle = (left + right) / 2.0;
    scene.label(
        "x-label",
        [middle, x_label_at],
        fit_runs(text, em, right - left),
        em,
        Anchor::Middle,
    );
    Ok(scene)
}

/// The distinct labels of curves, in order.
fn legend_labels(chart: &Chart) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    for curve in chart.panels.iter().flat_map(|panel| &panel.curves) {
        if !labels.contains(&curve.label) {
            labels.push(curve.label.clone());
        }
    }
    labels
}

/// `name [10³ unit]`.
fn axis_label(axis: &Axis, exponent: i32) -> Vec<Run> {
    let unit = unit(&axis.unit);
    let name = printable(&axis.name);
    let mut runs = Vec::new();
    let gap = if name.is_empty() { "" } else { " " };
    if exponent == 0 && unit.is_empty() {
        runs.extend((!name.is_empty()).then(|| Run::plain(name)));
    } else if exponent == 0 {
        runs.push(Run::plain(format!("{name}{gap}[{unit}]")));
    } else {
        runs.push(Run::plain(format!("{name}{gap}[10")));
        runs.push(Run::raised(super::words::minus(&exponent.to_string())));
        runs.push(Run::plain(if unit.is_empty() {
            "]".into()
        } else {
            format!(" {unit}]")
        }));
    }
    runs
}

/// Cuts the first run so that all have room.
fn fit_runs(mut runs: Vec<Run>, size: f64, room: f64) -> Vec<Run> {
    let all = font::width_of_runs(&runs, size);
    if let Some(first) = runs.first_mut().filter(|_| all > room) {
        let own = font::width(&first.text, size);
        // The unit at its end is worth more than the end of a name.
        let (name, tail) = match first.text.rfind(" [") {
            Some(at) => (first.text[..at].to_string(), first.text[at..].to_string()),
            None => (first.text.clone(), String::new()),
        };
        let room = room - (all - own) - font::width(&tail, size);
        first.text = font::fit(&name, size, room) + &tail;
    }
    runs
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

/// The legend in columns; returns the number of its rows. None for a single curve without a label.
fn legend(chart: &Chart, labels: &[String], scene: &mut Scene, top: f64) -> usize {
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

/// The note, wrapped.
fn note_lines(chart: &Chart, width: f64) -> Vec<String> {
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
fn note_height(lines: &[String], em: f64) -> f64 {
    if lines.is_empty() {
        0.0
    } else {
        (lines.len() as f64 * LINE * NOTE + 0.3) * em
    }
}

/// The note, at the foot of the page.
fn note(lines: &[String], em: f64, scene: &mut Scene) {
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

/// Scale and ticks of the x axis, labels with room between them.
fn x_axis(chart: &Chart, [low, high]: [f64; 2], [left, right]: [f64; 2]) -> (Scale, Ticks) {
    let em = chart.font_size;
    let scale = Scale {
        low,
        high,
        log: chart.x.log,
        start: left,
        end: right,
    };
    let turns = chart.x.unit == "deg";
    let mut spacing = X_TICKS * em;
    loop {
        let ticks = scale.ticks(spacing, turns);
        let widest = ticks
            .major
            .iter()
            .map(|(_, runs)| font::width_of_runs(runs, em))
            .fold(0.0, f64::max);
        let places: Vec<f64> = ticks
            .major
            .iter()
            .filter_map(|(value, _)| scale.place(*value))
            .collect();
        let nearest = places
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .fold(f64::INFINITY, f64::min);
        if nearest >= widest + 0.7 * em || spacing > right - left {
            return (scale, ticks);
        }
        spacing *= 1.25;
    }
}

/// The grid.
fn backdrop(chart: &Chart, frame: &Frame, x_scale: &Scale, x_ticks: &Ticks, scene: &mut Scene) {
    if !chart.grid {
        return;
    }
    let pen = Pen::new(GRID_INK, 0.4);
    for (value, _) in &x_ticks.major {
        if let Some(x) = x_scale.place(*value) {
            scene.line("grid", [[x, frame.scale.start], [x, frame.scale.end]], pen);
        }
    }
    for (value, _) in &frame.ticks.major {
        if let Some(y) = frame.scale.place(*value) {
            scene.line("grid", [[x_scale.start, y], [x_scale.end, y]], pen);
        }
    }
}

/// Thin vertical lines, labels above the panels.
fn marks(chart: &Chart, x_scale: &Scale, [top, bottom]: [f64; 2], scene: &mut Scene) {
    let em = chart.font_size;
    let size = 0.85 * em;
    let mut free = 0.0;
    for mark in &chart.marks {
        let Some(x) = x_scale
            .place(mark.x)
            .filter(|x| (x_scale.start..=x_scale.end).contains(x))
        else {
            continue;
        };
        let pen = Pen {
            ink: MARK_INK,
            width: 0.5,
            dash: &[2.0, 2.0],
        };
        scene.line("mark", [[x, top], [x, bottom]], pen);
        let text = font::fit(&printable(&mark.label), size, scene.width - 2.0 * EDGE * em);
        let half = font::width(&text, size) / 2.0;
        let at = x.clamp(
            half + EDGE * em,
            (scene.width - half - EDGE * em).max(half + EDGE * em),
        );
        // A label that would run into the one before is left out; its line remains.
        if !text.is_empty() && at - half >= free {
            free = at + half + 0.5 * em;
            let label = Item::Label {
                class: "mark-label",
                at: [at, top - 0.35 * em],
                runs: vec![Run::plain(text)],
                size,
                anchor: Anchor::Middle,
                turned: false,
                ink: AXIS_INK,
            };
            scene.items.push(label);
        }
    }
}

/// All curves of a panel.
fn curves(chart: &Chart, frame: &Frame, x_scale: &Scale, labels: &[String], scene: &mut Scene) {
    let em = chart.font_size;
    for curve in &frame.panel.curves {
        let number = labels
            .iter()
            .position(|label| *label == curve.label)
            .unwrap_or(0);
        let Style { pen, marker } = style(number, chart.line_width);
        let found = trace(&curve.x, &curve.y, x_scale, &frame.scale);
        let spacing = (x_scale.end - x_scale.start) / 6.0;
        for place in found.markers(spacing, (0.3 + 0.17 * (number % 5) as f64) * spacing) {
            symbols::marker(scene, marker, place, pen);
        }
        for dot in &found.dots {
            scene.circle("dot", *dot, (0.12 * em).max(pen.width), Some(pen.ink), None);
        }
        for line in found.lines {
            scene.line("curve", line, pen);
        }
    }
}

/// Frame, ticks, tick labels and label of a panel.
fn y_axis(chart: &Chart, frame: &Frame, [left, right]: [f64; 2], scene: &mut Scene) {
    let em = chart.font_size;
    let pen = Pen::new(AXIS_INK, 0.6);
    let [upper, lower] = [frame.scale.end, frame.scale.start];
    scene.area(
        "frame",
        [[left, upper], [right, upper], [right, lower], [left, lower]],
        None,
        Some(pen),
    );
    for (value, runs) in &frame.ticks.major {
        let Some(y) = frame.scale.place(*value) else {
            continue;
        };
        scene.line("y-tick", [[left, y], [left - TICK * em, y]], pen);
        let at = [left - (TICK + GAP) * em, y + font::CAPITALS * em / 2.0];
        scene.label("y-number", at, runs.clone(), em, Anchor::End);
    }
    for y in frame
        .ticks
        .minor
        .iter()
        .filter_map(|value| frame.scale.place(*value))
    {
        scene.line(
            "y-minor",
            [[left, y], [left - 0.5 * TICK * em, y]],
            Pen::new(AXIS_INK, 0.4),
        );
    }
    let runs = axis_label(&frame.panel.axis, frame.ticks.exponent);
    if !runs.is_empty() {
        let at: Place = [EDGE * em + 0.85 * em, (upper + lower) / 2.0];
        // Labels of neighbouring panels keep a gap; where a unit alone is too long, its letters are smaller.
        let room = lower - upper + (BETWEEN_PANELS - 0.7) * em;
        let runs = fit_runs(runs, em, room);
        let size = em * (room / font::width_of_runs(&runs, em)).min(1.0);
        let (class, ink) = ("y-label", Ink::grey(0));
        scene.items.push(Item::Label {
            class,
            at,
            runs,
            size,
            anchor: Anchor::Middle,
            turned: true,
            ink,
        });
    }
}

/// Ticks below a panel; the last one has the numbers.
fn x_tick_marks(
    chart: &Chart,
    scale: &Scale,
    ticks: &Ticks,
    frame: &Frame,
    numbered: bool,
    scene: &mut Scene,
) {
    let em = chart.font_size;
    let y = frame.scale.start;
    for (value, runs) in &ticks.major {
        let Some(x) = scale.place(*value) else {
            continue;
        };
        scene.line(
            "x-tick",
            [[x, y], [x, y + TICK * em]],
            Pen::new(AXIS_INK, 0.6),
        );
        if numbered {
            let half = font::width_of_runs(runs, em) / 2.0;
            // A number at the very end may not leave the page.
            let at = x.min(scene.width - half - 0.1 * em);
            scene.label(
                "x-number",
                [at, y + (TICK + GAP + font::CAPITALS) * em],
                runs.clone(),
                em,
                Anchor::Middle,
            );
        }
    }
    for x in ticks.minor.iter().filter_map(|value| scale.place(*value)) {
        scene.line(
            "x-minor",
            [[x, y], [x, y + 0.5 * TICK * em]],
            Pen::new(AXIS_INK, 0.4),
        );
    }
}
