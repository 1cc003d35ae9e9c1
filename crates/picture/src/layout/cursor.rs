//! A chart with a cursor that follows time, for films.

use super::labels::legend_labels;
use super::page::Scales;
use crate::chart::Chart;
use crate::fault::Fault;
use crate::palette;
use crate::scene::{Ink, POINTS_PER_MM, Pen, Scene};
use crate::style::style;

/// Height of the first panel below and next to a mechanism, and of each further one, as parts of the width.
const FIRST: [f64; 2] = [0.47, 0.58];
const FURTHER: f64 = 0.26;
/// Letters, as a part of the width, and their least and greatest size \[pt\].
const LETTERS: f64 = 0.027;
const SIZES: [f64; 2] = [6.0, 12.0];
/// Width of the chart next to a mechanism, as a part of the whole.
const BESIDE: f64 = 0.55;
/// Width of curves, as a part of the font size.
const CURVE: f64 = 0.16;
/// Width of the cursor, and radius of a dot on a curve, as parts of the font size.
const LINE: f64 = 0.12;
const DOT: f64 = 0.32;

/// Where curves stand in a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Below the mechanism.
    Below,
    /// To the right of it.
    Right,
}

/// Curves with a cursor at an instant.
#[derive(Debug)]
pub struct MovingChart {
    chart: Chart,
    /// Instants of the values of all curves \[s\], ascending.
    time: Vec<f64>,
    side: Side,
    scene: Scene,
    scales: Scales,
}

impl MovingChart {
    /// Curves whose values all belong to these instants \[s\], for a film of that width \[pt\].
    ///
    /// # Errors
    /// When there is nothing to draw, or no room for it.
    pub fn new(mut chart: Chart, time: Vec<f64>, side: Side, width: f64) -> Result<Self, Fault> {
        let (own, first) = match side {
            Side::Below => (width, FIRST[0]),
            Side::Right => (BESIDE * width, FIRST[1]),
        };
        let further = chart.panels.len().saturating_sub(1) as f64;
        let height = (first + FURTHER * further) * own;
        chart.font_size = (LETTERS * own).clamp(SIZES[0], SIZES[1]);
        chart.line_width = CURVE * chart.font_size;
        chart.size_mm = [own, height].map(|size| Some(size / POINTS_PER_MM));
        let drawn = match chart.draw_scaled() {
            // Many rows of a legend ask for a higher page.
            Err(Fault::TooSmall) => {
                chart.size_mm[1] = None;
                chart.draw_scaled()
            }
            drawn => drawn,
        };
        let (scene, scales) = drawn?;
        Ok(MovingChart {
            chart,
            time,
            side,
            scene,
            scales,
        })
    }

    /// How wide the mechanism is in a film of that width \[pt\].
    pub fn left_to_mechanism(&self, width: f64) -> f64 {
        match self.side {
            Side::Below => width,
            Side::Right => width - self.scene.width,
        }
    }

    /// A picture of the mechanism with the curves at an instant \[s\].
    pub fn with(&self, mechanism: Scene, time: f64) -> Scene {
        let own = &self.scene;
        let ([wide, high], places) = match self.side {
            Side::Below => {
                let high = mechanism.height + own.height;
                ([own.width, high], [[0.0, 0.0], [0.0, mechanism.height]])
            }
            Side::Right => {
                let high = mechanism.height.max(own.height);
                let middle = |scene: &Scene| (high - scene.height) / 2.0;
                let places = [[0.0, middle(&mechanism)], [mechanism.width, middle(own)]];
                ([mechanism.width + own.width, high], places)
            }
        };
        let mut scene = Scene::new(wide, high);
        scene.take(&mechanism, places[0]);
        scene.take(own, places[1]);
        let mut cursor = Scene::new(own.width, own.height);
        self.draw_cursor(&mut cursor, time);
        scene.take(&cursor, places[1]);
        scene
    }

    /// A line through all panels, and a dot on each curve that has a value there.
    fn draw_cursor(&self, scene: &mut Scene, time: f64) {
        let em = self.chart.font_size;
        let ink = Ink::new(palette::ACCENT.light);
        let labels = legend_labels(&self.chart);
        let x_scale = &self.scales.x;
        for (panel, y_scale) in self.chart.panels.iter().zip(&self.scales.y) {
            let at = |values: &[f64]| value_at(&self.time, values, time);
            let x = panel.curves.iter().find_map(|curve| at(&curve.x));
            let inside = |x: &f64| (x_scale.start..=x_scale.end).contains(x);
            if let Some(x) = x.and_then(|x| x_scale.place(x)).filter(inside) {
                let line = [[x, y_scale.start], [x, y_scale.end]];
                scene.line("cursor", line, Pen::new(ink, LINE * em));
            }
            for curve in &panel.curves {
                let place = at(&curve.x).and_then(|x| x_scale.place(x));
                let value = at(&curve.y).and_then(|y| y_scale.place(y));
                let (Some(x), Some(y)) = (place.filter(inside), value) else {
                    continue;
                };
                if !(y_scale.end..=y_scale.start).contains(&y) {
                    continue;
                }
                let number = labels.iter().position(|label| *label == curve.label);
                let fill = style(number.unwrap_or(0), 1.0).pen.ink;
                let edge = Pen::new(Ink::grey(255), 0.1 * em);
                scene.circle("cursor-dot", [x, y], DOT * em, Some(fill), Some(edge));
            }
        }
    }
}

/// Value at an instant, straight between rows; none in a gap.
fn value_at(time: &[f64], values: &[f64], at: f64) -> Option<f64> {
    let after = time.partition_point(|t| *t <= at).min(time.len() - 1);
    let before = after.saturating_sub(1);
    let [low, high] = [*time.get(before)?, *time.get(after)?];
    let [from, to] = [*values.get(before)?, *values.get(after)?];
    let part = if high > low {
        ((at - low) / (high - low)).clamp(0.0, 1.0)
    } else {
        1.0
    };
    // A row at a gap has its value.
    let value = match part {
        0.0 => from,
        1.0 => to,
        _ => from + part * (to - from),
    };
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::{Axis, Curve, Panel};

    #[test]
    fn values_lie_between_rows() {
        let time = [0.0, 1.0, 2.0, 3.0];
        let values = [0.0, 10.0, f64::NAN, 5.0];
        for (at, value) in [
            (-1.0, Some(0.0)),
            (0.5, Some(5.0)),
            (1.0, Some(10.0)),
            (1.5, None),
            (9.0, Some(5.0)),
        ] {
            assert_eq!(value_at(&time, &values, at), value, "{at}");
        }
    }

    #[test]
    fn the_cursor_goes_from_one_end_of_the_axis_to_the_other() {
        let time: Vec<f64> = (0..=40).map(|k| 0.1 * f64::from(k)).collect();
        let curve = Curve::new("", time.clone(), time.iter().map(|t| t.sin()).collect());
        let panel = Panel {
            axis: Axis::new("a", "m"),
            curves: vec![curve],
        };
        let chart = Chart {
            x: Axis::new("time", "s"),
            panels: vec![panel],
            ..Chart::default()
        };
        for side in [Side::Below, Side::Right] {
            let moving = MovingChart::new(chart.clone(), time.clone(), side, 360.0).expect("drawn");
            let left = moving.left_to_mechanism(360.0);
            let places = [0.0, 2.0, 4.0].map(|t| {
                let scene = moving.with(Scene::new(left, 100.0), t);
                assert!((scene.width - 360.0).abs() < 1e-9);
                let dots = scene.items.iter().filter_map(|item| match item {
                    crate::scene::Item::Circle {
                        class: "cursor-dot",
                        centre,
                        ..
                    } => Some(centre[0]),
                    _ => None,
                });
                dots.collect::<Vec<f64>>()[0]
            });
            let [first, middle, last] = places;
            assert!((first + last - 2.0 * middle).abs() < 1e-6, "{places:?}");
            assert!(last - first > 0.7 * (360.0 - if side == Side::Right { left } else { 0.0 }));
        }
    }
}
