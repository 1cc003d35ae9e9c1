//! Pages that show a mechanism: one pose with its time, several poses over each other or side by side.

use super::moving::Mechanism;
use super::parts::{Layer, Parts, on_page};
use super::places::place;
use super::values::font_size;
use super::view::View;
use crate::fault::Fault;
use crate::palette;
use crate::poses::Pose;
use crate::scene::POINTS_PER_MM;
use crate::scene::{Anchor, Ink, Pen, Place, Run, Scene};
use crate::{font, style, words};
use std::ops::RangeBounds;

/// Poses of one picture, at most.
pub const MOST_POSES: usize = 64;
/// How much of the first of several poses is left.
const FADED: f64 = 0.3;
/// Letters below the poses of a strip \[pt\].
const CAPTION: f64 = 8.0;
/// Poses in a row of a strip, at most: of mechanisms that are wider than high, and of high ones.
const MOST_COLUMNS: [usize; 2] = [5, 6];
/// A mechanism is high where it is that much higher than wide.
const HIGH: f64 = 1.25;
/// Steps of the fading tail of a point, and the pieces of a step.
const PIECES: usize = 8;
const FINE: usize = 6;
/// How much of a path's colour is left below its tail.
const PALE: f64 = 0.3;

/// How poses share a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Over each other, earlier ones fainter.
    Overlaid,
    /// Side by side, in rows.
    Strip,
}

impl Mechanism {
    /// One pose with its time and the values of its drivers below, on a page of that width \[pt\]. Points leave a tail of
    /// their last places, so long \[s\].
    pub fn frame(&self, time: f64, tail: f64, width: f64) -> Scene {
        let size = font_size(width);
        let height = self.frame.height(width);
        let mut scene = Scene::new(width, height + 2.0 * size);
        let view = View::new(&self.frame, [0.0, 0.0], [width, height]);
        self.draw_paths(&mut scene, &view, PALE);
        self.draw_backdrop(&mut scene, &view, time);
        self.draw_pose(&mut scene, &view, time, None);
        self.draw_tails(&mut scene, &view, [time - tail, time]);
        let pose = self.poses.at(time);
        let mut text = time_words(time, self.span());
        if pose.is_none() {
            text += ": no solution";
        }
        let baseline = height + 1.2 * size;
        let room = width - 3.0 * size - font::width(&text, size);
        let at = [size, baseline];
        scene.label("time", at, vec![Run::plain(text)], size, Anchor::Start);
        let text = pose.map(|pose| self.driver_words(&pose));
        if let Some(text) = text.filter(|text| !text.is_empty()) {
            let text = vec![Run::plain(font::fit(&text, size, room))];
            scene.label("value", [width - size, baseline], text, size, Anchor::End);
        }
        scene
    }

    /// Several poses, spread as [`Mechanism::instants`] says, on a page of that width \[mm\].
    ///
    /// # Errors
    /// When there are none, or too many.
    pub fn picture(&self, count: usize, layout: Layout, width_mm: f64) -> Result<Scene, Fault> {
        if !(1..=MOST_POSES).contains(&count) {
            return Err(Fault::Drawing(format!(
                "{count} poses: from 1 to {MOST_POSES} can be drawn"
            )));
        }
        let width = width_mm * POINTS_PER_MM;
        let times = self.instants(count);
        Ok(match layout {
            Layout::Overlaid => self.overlaid(&times, width),
            Layout::Strip => self.strip(&times, width),
        })
    }

    fn overlaid(&self, times: &[f64], width: f64) -> Scene {
        let mut scene = Scene::new(width, self.frame.height(width));
        let view = View::new(&self.frame, [0.0, 0.0], [width, scene.height]);
        let count = times.len();
        self.draw_paths(&mut scene, &view, 1.0);
        self.draw_backdrop(&mut scene, &view, times[count - 1]);
        for (index, time) in times.iter().enumerate() {
            let part = (index + 1) as f64 / count as f64;
            let faded = 0.75 * (FADED + (1.0 - FADED) * part);
            self.draw_pose(
                &mut scene,
                &view,
                *time,
                (index + 1 < count).then_some(faded),
            );
        }
        scene
    }

    fn strip(&self, times: &[f64], width: f64) -> Scene {
        let count = times.len();
        let columns = columns(count, self.frame.height(1.0));
        let each = width / columns as f64;
        let (size, height) = (CAPTION, self.frame.height(each));
        let lines = 1 + usize::from(!self.shape.drivers.is_empty());
        let step = height + (lines as f64 + 1.0) * size;
        let mut scene = Scene::new(width, count.div_ceil(columns) as f64 * step);
        for (index, time) in times.iter().enumerate() {
            let [column, row] = [index % columns, index / columns];
            // A last row that is not full stands in the middle.
            let missing = columns - (count - row * columns).min(columns);
            let left = (column as f64 + missing as f64 / 2.0) * each;
            let corner: Place = [left, row as f64 * step];
            let view = View::new(&self.frame, corner, [each, height]);
            self.draw_paths(&mut scene, &view, 1.0);
            self.draw_backdrop(&mut scene, &view, *time);
            self.draw_pose(&mut scene, &view, *time, None);
            let value = self.poses.at(*time).map(|pose| self.driver_words(&pose));
            let value = value.filter(|text| !text.is_empty());
            let texts = [
                value.map(|text| ("value", text)),
                Some(("time", time_words(*time, self.span()))),
            ];
            for (line, (class, text)) in texts.into_iter().flatten().enumerate() {
                let below = height + (1.1 + 1.2 * line as f64) * size;
                let at = [corner[0] + each / 2.0, corner[1] + below];
                let text = vec![Run::plain(font::fit(&text, size, each - size))];
                scene.label(class, at, text, size, Anchor::Middle);
            }
        }
        scene
    }

    /// How far signs reach beyond the points of the mechanism at a time, in bars: left, top, right, bottom.
    pub(super) fn overhang(&self, time: f64) -> [f64; 4] {
        // That of a film: letters do not shrink with the page.
        let side = 360.0;
        let view = View::new(&self.frame, [0.0, 0.0], [side, side]);
        let mut scene = Scene::new(side, side);
        self.draw_backdrop(&mut scene, &view, time);
        self.draw_pose(&mut scene, &view, time, None);
        view.overhang(&self.frame.extent, &scene)
    }

    /// Whole paths of points.
    fn draw_paths(&self, scene: &mut Scene, view: &View, strength: f64) {
        for (index, path) in self.paths.iter().enumerate() {
            let pen = Pen::new(trace_ink(index).faded(strength), 0.3 * view.bar);
            for piece in path {
                let places: Vec<Place> = piece.iter().map(|place| view.place(*place)).collect();
                scene.line("trace", places, pen);
            }
        }
    }

    /// The last parts of the paths of points, the older the fainter.
    fn draw_tails(&self, scene: &mut Scene, view: &View, [from, to]: [f64; 2]) {
        if self.shape.points.is_empty() {
            return;
        }
        let [first, last] = self.span();
        let poses: Vec<Option<Vec<Pose>>> = (0..=PIECES * FINE)
            .map(|k| to - (to - from) * k as f64 / (PIECES * FINE) as f64)
            .map(|time| match time >= first {
                true => self.poses.at(time),
                false if self.returns => self.poses.at(time + (last - first)),
                false => None,
            })
            .collect();
        for (index, point) in self.shape.points.iter().enumerate() {
            for piece in (0..PIECES).rev() {
                let known = poses[piece * FINE..=(piece + 1) * FINE].iter();
                let places: Option<Vec<Place>> = known
                    .map(|pose| Some(view.place(place(&self.shape, pose.as_ref()?, *point))))
                    .collect();
                let left = 1.0 - piece as f64 / PIECES as f64;
                let ink = trace_ink(index).faded(left);
                let pen = Pen::new(ink, (0.25 + 0.35 * left) * view.bar);
                if let Some(places) = places {
                    scene.line("tail", places, pen);
                }
            }
        }
    }

    /// What is drawn once for all poses, as it is at a time.
    pub(super) fn draw_backdrop(&self, scene: &mut Scene, view: &View, time: f64) {
        if let Some(pose) = self.poses.at(time) {
            self.draw_parts(scene, view, &pose, (..=Layer::Backdrop, 1.0));
        }
    }

    /// Everything else at a time; nothing in a gap. A pose behind others is faded, without coils, drivers and loads.
    pub(super) fn draw_pose(&self, scene: &mut Scene, view: &View, time: f64, faded: Option<f64>) {
        let Some(pose) = self.poses.at(time) else {
            return;
        };
        let strength = faded.unwrap_or(1.0);
        let last = match faded {
            Some(_) => Layer::Springs,
            None => Layer::Drivers,
        };
        self.draw_parts(scene, view, &pose, (Layer::Guides..=last, strength));
        if faded.is_none() {
            self.draw_loads(scene, view, &pose, time);
        }
        for (index, point) in self.shape.points.iter().enumerate() {
            let (ink, at) = (
                trace_ink(index).faded(strength),
                on_page(self, view, &pose, *point),
            );
            scene.circle("traced", at, 0.5 * view.bar, Some(ink), None);
        }
    }

    fn draw_parts(
        &self,
        scene: &mut Scene,
        view: &View,
        pose: &[Pose],
        (layers, strength): (impl RangeBounds<Layer>, f64),
    ) {
        let parts = Parts::of(self, pose, view.bar / view.scale, false);
        for part in parts.iter().filter(|part| layers.contains(&part.layer)) {
            part.draw(scene, self, view, pose, strength);
        }
    }
}

/// Colour of a path: the first is that of what is chosen on the page, others follow the curves.
fn trace_ink(index: usize) -> Ink {
    if index == 0 {
        Ink::new(palette::ACCENT.light)
    } else {
        style::style(index + 1, 1.0).pen.ink
    }
}

/// Columns of a strip: full rows where that is possible, else of about one length; `height` is that of a pose by its width.
fn columns(count: usize, height: f64) -> usize {
    let most = MOST_COLUMNS[usize::from(height > HIGH)];
    let full = (3..=most)
        .rev()
        .find(|columns| count.is_multiple_of(*columns));
    match full {
        _ if count <= most => count.max(1),
        Some(columns) => columns,
        None => count.div_ceil(count.div_ceil(most)),
    }
}

/// `t = 0.52 s`, with digits for the span.
fn time_words(time: f64, [first, last]: [f64; 2]) -> String {
    let decimals = if last > first {
        (2.0 - (last - first).log10().floor()).clamp(0.0, 12.0) as usize
    } else {
        2
    };
    format!("t = {} s", words::minus(&format!("{time:.decimals$}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_have_full_rows_where_they_can() {
        for (count, flat, high) in [
            (1, 1, 1),
            (5, 5, 5),
            (6, 3, 6),
            (7, 4, 4),
            (8, 4, 4),
            (9, 3, 3),
            (10, 5, 5),
            (11, 4, 6),
            (12, 4, 6),
        ] {
            assert_eq!(
                [columns(count, 0.8), columns(count, 1.3)],
                [flat, high],
                "{count}"
            );
        }
    }

    #[test]
    fn times_have_digits_for_their_span() {
        assert_eq!(time_words(0.5, [0.0, 2.0]), "t = 0.50 s");
        assert_eq!(time_words(0.0123, [0.0, 0.05]), "t = 0.0123 s");
        assert_eq!(time_words(0.0, [0.0, 0.0]), "t = 0.00 s");
    }
}
