//! The counterparts of the paper's figures 4 to 8: each quantity over θ6 for e = 0, 10 and 100 µm.
//!
//! Where a clearance link flips from output to output, α2, M_d and F12 change by orders of magnitude, the first two with their
//! sign: on a linear axis a block of ink. So of these three the magnitude is shown, on a logarithmic axis; below its lower end
//! only magnitudes near a change of sign are left out. θ2 and ω2 are shown as they are. The note below each figure says so.

use super::facts::Fact;
use super::files::CURVES;
use super::models::{Found, Quantity, RADII, STEPS, Stroke};
use super::table::Runs;
use crate::CaseError;
use linkdyn_output::Directory;
use linkdyn_picture::{Axis, Chart, Curve, Mark, Panel, svg};

/// Lower end of the logarithmic axes [rad/s², N·m, N].
const LEAST: f64 = 0.1;

/// A figure that was written.
#[derive(Debug)]
pub struct Drawn {
    pub file: String,
    pub about: String,
}

/// Draws and writes them.
///
/// # Errors
/// When they can't be drawn or written.
pub fn write(directory: &Directory, runs: &Runs, facts: &[Fact]) -> Result<Vec<Drawn>, CaseError> {
    let change_point = facts
        .iter()
        .find(|fact| fact.what.starts_with("change_point"))
        .map(|fact| fact.ours);
    let mut drawn = Vec::new();
    for (figure, quantity) in (4..).zip(Quantity::ALL) {
        let (chart, about) = chart(runs, quantity, change_point);
        let scene = chart
            .draw()
            .map_err(|fault| CaseError::Broken(format!("figure {figure}: {fault}")))?;
        let file = format!("figure{figure}.svg");
        directory.write(&file, svg::write(&scene).as_bytes())?;
        drawn.push(Drawn { file, about });
    }
    Ok(drawn)
}

/// The figure of a quantity, and a line about it.
fn chart(runs: &Runs, quantity: Quantity, change_point: Option<f64>) -> (Chart, String) {
    let strokes: Vec<&Stroke> = runs
        .clearance
        .iter()
        .map(|strokes| &strokes[CURVES])
        .collect();
    let (panel, scale) = panel(
        quantity,
        "",
        [&runs.ideal[CURVES]]
            .into_iter()
            .chain(strokes.iter().copied()),
    );
    let gaps: Vec<String> = strokes
        .iter()
        .map(|stroke| stroke.count(Found::Nothing).to_string())
        .collect();
    let note = format!(
        "Massless clearance links in all seven hinges, outputs {}° apart; {scale}. Gaps: no assembly ({} outputs).",
        STEPS[CURVES],
        gaps.join(" and ")
    );
    let chart = Chart {
        x: Axis::new("θ6", "deg"),
        panels: vec![panel],
        marks: marks(change_point),
        note,
        size_mm: [None, Some(72.0)],
        whole: true,
        ..Chart::default()
    };
    (
        chart,
        format!(
            "{} [{}] over theta6: {scale}",
            quantity.symbol(),
            quantity.unit()
        ),
    )
}

/// The line at the change point.
pub fn marks(change_point: Option<f64>) -> Vec<Mark> {
    change_point
        .map(|x| Mark {
            x,
            label: format!("change point {x:.2}°"),
        })
        .into_iter()
        .collect()
}

/// Curves of a quantity for e = 0, 10 and 100 µm in one panel, and a line about their axis, whose name ends with `of`.
pub fn panel<'s>(
    quantity: Quantity,
    of: &str,
    strokes: impl Iterator<Item = &'s Stroke>,
) -> (Panel, String) {
    let Shown { name, is_magnitude } = shown(quantity);
    let name = format!("{name}{of}");
    let labels = ["ideal, e = 0".to_string()]
        .into_iter()
        .chain(RADII.map(|e| format!("e = {e} µm")));
    let curves: Vec<Curve> = labels
        .zip(strokes)
        .map(|(label, stroke)| {
            let values = stroke
                .curve(quantity)
                .iter()
                .map(|value| if is_magnitude { value.abs() } else { *value });
            Curve::new(label, stroke.theta6.clone(), values.collect())
        })
        .collect();
    let values = || {
        curves
            .iter()
            .flat_map(|curve| &curve.y)
            .copied()
            .filter(|value| value.is_finite())
    };
    let unit = quantity.unit();
    let (axis, scale) = if is_magnitude {
        let decades = values().fold(LEAST, f64::max).log10().ceil();
        let below = values().filter(|value| *value < LEAST).count();
        let axis = Axis {
            log: true,
            range: Some([LEAST, 10.0_f64.powf(decades)]),
            ..Axis::new(name, unit)
        };
        let left_out = if below == 0 {
            "all values".into()
        } else {
            format!("{below} of {} values below its end", values().count())
        };
        (axis, format!("magnitude on a logarithmic axis, {left_out}"))
    } else {
        (Axis::new(name, unit), "linear axis, all values".into())
    };
    (Panel { axis, curves }, scale)
}

/// How a quantity is shown.
struct Shown {
    name: &'static str,
    is_magnitude: bool,
}

fn shown(quantity: Quantity) -> Shown {
    let (name, is_magnitude) = match quantity {
        Quantity::Theta2 => ("θ2", false),
        Quantity::Omega2 => ("ω2", false),
        Quantity::Alpha2 => ("|α2|", true),
        Quantity::Torque => ("|M_d|", true),
        Quantity::Force => ("F12", true),
    };
    Shown { name, is_magnitude }
}
