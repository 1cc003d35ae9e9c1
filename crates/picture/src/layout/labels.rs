//! Labels of axes, and the distinct labels of curves.

use crate::chart::{Axis, Chart};
use crate::font;
use crate::scene::Run;
use crate::words::{self, printable, unit};

/// The distinct labels of curves, in order.
pub fn legend_labels(chart: &Chart) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    for curve in chart.panels.iter().flat_map(|panel| &panel.curves) {
        if !labels.contains(&curve.label) {
            labels.push(curve.label.clone());
        }
    }
    labels
}

/// `name [10³ unit]`.
pub fn axis_label(axis: &Axis, exponent: i32) -> Vec<Run> {
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
        runs.push(Run::raised(words::minus(&exponent.to_string())));
        runs.push(Run::plain(if unit.is_empty() {
            "]".into()
        } else {
            format!(" {unit}]")
        }));
    }
    runs
}

/// Cuts the first run so that all have room.
pub fn fit_runs(mut runs: Vec<Run>, size: f64, room: f64) -> Vec<Run> {
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
