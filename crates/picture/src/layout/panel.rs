//! A panel with its scale and ticks; its curves.

use super::peaks::Peaks;
use crate::chart::{Chart, Panel};
use crate::scale::{Scale, Ticks};
use crate::scene::Scene;
use crate::style::{Style, style};
use crate::symbols;
use crate::trace::trace;

/// A panel in the making.
pub struct Frame<'r, 'c> {
    /// What it shows.
    pub panel: &'c Panel,
    /// What it cuts off.
    pub peaks: &'r Peaks,
    /// Scale of its y axis.
    pub scale: Scale,
    /// Ticks of its y axis.
    pub ticks: Ticks,
}

/// All curves of a panel.
pub fn curves(chart: &Chart, frame: &Frame, x_scale: &Scale, labels: &[String], scene: &mut Scene) {
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
