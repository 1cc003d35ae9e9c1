//! Pages that show a mechanism: one pose with its time, several poses over each other or side by side.

use super::moving::Mechanism;
use super::sketch::Sketch;
use super::view::View;
use super::{actions, pose};
use crate::fault::Fault;
use crate::palette;
use crate::poses::Pose;
use crate::scene::POINTS_PER_MM;
use crate::scene::{Anchor, Ink, Pen, Place, Run, Scene};
use crate::{font, style, words};

/// Poses of one picture, at most.
pub const MOST_POSES: usize = 64;
/// How much of the first of several poses is left.
const FADED: f64 = 0.3;
/// Letters below the poses of a strip \[pt\].
const CAPTION: f64 = 8.0;
/// Poses in a row of a strip, at most.
const MOST_COLUMNS: usize = 4;

/// How poses share a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Over each other, earlier ones fainter.
    Overlaid,
    /// Side by side, in rows.
    Strip,
}

impl Mechanism {
    /// One pose with its time below, on a page of that width \[pt\].
    pub fn frame(&self, time: f64, width: f64) -> Scene {
        let size = font_size(width);
        let height = self.extent.height(width);
        let mut scene = Scene::new(width, height + 2.0 * size);
        let view = View::new(&self.extent, [0.0, 0.0], [width, height]);
        self.draw_backdrop(&mut scene, &view, time);
        self.draw_pose(&mut scene, &view, time, None);
        let text = if self.poses.at(time).is_some() {
            time_words(time, self.span())
        } else {
            format!("{}: no solution", time_words(time, self.span()))
        };
        let at = [size, height + 1.2 * size];
        scene.label("time", at, vec![Run::plain(text)], size, Anchor::Start);
        scene
    }

    /// Several poses, equally spaced in time, on a page of that width \[mm\].
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
        let [first, last] = self.span();
        let time = |index: usize| first + (last - first) * index as f64 / (count.max(2) - 1) as f64;
        let times: Vec<f64> = (0..count).map(time).collect();
        Ok(match layout {
            Layout::Overlaid => self.overlaid(&times, width),
            Layout::Strip => self.strip(&times, width),
        })
    }

    fn overlaid(&self, times: &[f64], width: f64) -> Scene {
        let mut scene = Scene::new(width, self.extent.height(width));
        let view = View::new(&self.extent, [0.0, 0.0], [width, scene.height]);
        let count = times.len();
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
        let columns = count.div_ceil(count.div_ceil(MOST_COLUMNS));
        let each = width / columns as f64;
        let (size, height) = (CAPTION, self.extent.height(each));
        let step = height + 2.0 * size;
        let mut scene = Scene::new(width, count.div_ceil(columns) as f64 * step);
        for (index, time) in times.iter().enumerate() {
            let [column, row] = [index % columns, index / columns].map(|number| number as f64);
            let corner: Place = [column * each, row * step];
            let view = View::new(&self.extent, corner, [each, height]);
            self.draw_backdrop(&mut scene, &view, *time);
            self.draw_pose(&mut scene, &view, *time, None);
            let at = [corner[0] + each / 2.0, corner[1] + height + 1.1 * size];
            let text = font::fit(&time_words(*time, self.span()), size, each);
            scene.label("time", at, vec![Run::plain(text)], size, Anchor::Middle);
        }
        scene
    }

    /// Paths of points, and what is drawn once for all poses, as it is at a time.
    fn draw_backdrop(&self, scene: &mut Scene, view: &View, time: f64) {
        for (index, path) in self.paths.iter().enumerate() {
            for piece in path {
                let places: Vec<Place> = piece.iter().map(|place| view.place(*place)).collect();
                scene.line("trace", places, Pen::new(trace_ink(index), 0.3 * view.bar));
            }
        }
        if let Some(poses) = self.poses.at(time) {
            pose::draw_backdrop(scene, &self.sketch(view, &poses, 1.0));
        }
    }

    fn sketch<'s>(&'s self, view: &'s View, pose: &'s [Pose], strength: f64) -> Sketch<'s> {
        Sketch {
            mechanism: self,
            view,
            pose,
            strength,
        }
    }

    /// Everything else at a time; nothing in a gap. A pose that stands behind others is faded, and tells no actions.
    fn draw_pose(&self, scene: &mut Scene, view: &View, time: f64, faded: Option<f64>) {
        let Some(poses) = self.poses.at(time) else {
            return;
        };
        let sketch = self.sketch(view, &poses, faded.unwrap_or(1.0));
        pose::draw(scene, &sketch);
        actions::draw_springs(scene, &sketch);
        if faded.is_none() {
            actions::draw_actions(scene, &sketch, time);
        }
        for (index, point) in self.shape.points.iter().enumerate() {
            let ink = trace_ink(index).faded(sketch.strength);
            scene.circle("traced", sketch.at(*point), 0.5 * view.bar, Some(ink), None);
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

/// Letters that can be read beside a picture of that width \[pt\].
fn font_size(width: f64) -> f64 {
    (0.032 * width).clamp(7.0, 14.0)
}

/// `t = 0.52 s`, as many digits as the span asks for.
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
    fn times_have_digits_for_their_span() {
        assert_eq!(time_words(0.5, [0.0, 2.0]), "t = 0.50 s");
        assert_eq!(time_words(0.0123, [0.0, 0.05]), "t = 0.0123 s");
        assert_eq!(time_words(0.0, [0.0, 0.0]), "t = 0.00 s");
    }
}
