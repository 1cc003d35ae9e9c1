//! Axes, ticks, grid and marks.

use super::labels::{axis_label, fit_runs};
use super::measures::{AXIS_INK, BETWEEN_PANELS, EDGE, GAP, GRID_INK, MARK_INK, TICK, X_TICKS};
use super::panel::Frame;
use crate::chart::Chart;
use crate::font;
use crate::scale::{Scale, Ticks};
use crate::scene::Run;
use crate::scene::{Anchor, Ink, Item, Pen, Place, Scene};
use crate::words::printable;

/// Scale and ticks of the x axis, labels with room between them.
pub fn x_axis(chart: &Chart, [low, high]: [f64; 2], [left, right]: [f64; 2]) -> (Scale, Ticks) {
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
pub fn backdrop(chart: &Chart, frame: &Frame, x_scale: &Scale, x_ticks: &Ticks, scene: &mut Scene) {
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
pub fn marks(chart: &Chart, x_scale: &Scale, [top, bottom]: [f64; 2], scene: &mut Scene) {
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

/// Frame, ticks, tick labels and label of a panel.
pub fn y_axis(chart: &Chart, frame: &Frame, [left, right]: [f64; 2], scene: &mut Scene) {
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
pub fn x_tick_marks(
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
