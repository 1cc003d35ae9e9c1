//! Tables and figures: the journal's orbit in the bearing, and the slider's Poincaré map.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use super::long_run::{LongRun, OUTPUTS};
use super::solution::millimetres;
use crate::{CaseError, broken};
use linkdyn_output::Directory;
use linkdyn_picture::{Axis, Chart, Curve, Panel, svg};

/// Turns at the end that the orbit shows.
const SHOWN: usize = 5;
/// Points of the circle that the journal's centre keeps to while it does not touch.
const CIRCLE: usize = 180;

/// `orbit-0.5mm.csv` and `.svg`: eccentricity, and the slider's velocity and acceleration at each output of the last turns.
///
/// # Errors
/// When they can't be drawn or written.
pub fn orbit(directory: &Directory, run: &LongRun) -> Result<(), CaseError> {
    let first = run.time.len() - 1 - SHOWN * OUTPUTS as usize;
    let mut text =
        String::from("time[s],joint.b.ex[m],joint.b.ey[m],slider.vx[m/s],slider.ax[m/s^2]\n");
    for k in first..run.time.len() {
        let _ = writeln!(
            text,
            "{},{},{},{},{}",
            run.time[k], run.ex[k], run.ey[k], run.velocity[k], run.acceleration[k]
        );
    }
    let name = format!("orbit-{:.1}mm", 1e3 * run.clearance);
    directory.write(&format!("{name}.csv"), text.as_bytes())?;
    let part = |values: &[f64]| {
        values[first..]
            .iter()
            .map(|value| value / run.clearance)
            .collect::<Vec<f64>>()
    };
    let circle = |of: fn(f64) -> f64| {
        (0..=CIRCLE)
            .map(|k| of(TAU * k as f64 / CIRCLE as f64))
            .collect::<Vec<f64>>()
    };
    let axis = |name: &str| Axis {
        range: Some([-1.2, 1.2]),
        ..Axis::new(name, "")
    };
    let curves = vec![
        Curve::new(
            format!("journal's centre, {}", millimetres(run.clearance)),
            part(&run.ex),
            part(&run.ey),
        ),
        Curve::new("clearance circle", circle(f64::cos), circle(f64::sin)),
    ];
    let chart = Chart {
        x: axis("e_x/c"),
        panels: vec![Panel {
            axis: axis("e_y/c"),
            curves,
        }],
        note: format!(
            "The last {SHOWN} turns; beyond the circle the journal presses into the bearing."
        ),
        size_mm: [Some(88.0), Some(92.0)],
        ..Chart::default()
    };
    draw(directory, &name, &chart)
}

/// `poincare.csv` and `.svg`: the slider's velocity and acceleration once a turn, at the top dead centre.
///
/// # Errors
/// When they can't be drawn or written.
pub fn poincare(directory: &Directory, runs: &[[LongRun; 2]]) -> Result<(), CaseError> {
    let mut text = String::from(
        "clearance[m],time[s],slider.vx[m/s],slider.ax[m/s^2],joint.b.ex[m],joint.b.ey[m]\n",
    );
    let mut panels = Vec::new();
    for [_, run] in runs {
        for k in run.sections() {
            let [velocity, acceleration] = [run.velocity[k], run.acceleration[k]];
            let _ = writeln!(
                text,
                "{},{},{velocity},{acceleration},{},{}",
                run.clearance, run.time[k], run.ex[k], run.ey[k]
            );
        }
        // A gap on both sides makes a point.
        let dots = |values: &[f64]| {
            run.sections()
                .flat_map(|k| [values[k], f64::NAN])
                .collect::<Vec<f64>>()
        };
        let curve = Curve::new(
            "once a turn, crank at 0°",
            dots(&run.velocity),
            dots(&run.acceleration),
        );
        let name = format!("acceleration, {}", millimetres(run.clearance));
        panels.push(Panel {
            axis: Axis::new(name, "m/s^2"),
            curves: vec![curve],
        });
    }
    directory.write("poincare.csv", text.as_bytes())?;
    let velocities = || {
        runs.iter()
            .flat_map(|[_, run]| run.sections().map(|k| run.velocity[k]))
    };
    let (low, high) = velocities().fold((0.0_f64, 0.0_f64), |(low, high), v| {
        (low.min(v), high.max(v))
    });
    let chart = Chart {
        x: Axis {
            range: Some([1.05 * low, 1.05 * high]),
            ..Axis::new("slider velocity", "m/s")
        },
        panels,
        line_width: 2.0,
        size_mm: [Some(88.0), Some(150.0)],
        ..Chart::default()
    };
    draw(directory, "poincare", &chart)
}

fn draw(directory: &Directory, name: &str, chart: &Chart) -> Result<(), CaseError> {
    let scene = chart
        .draw()
        .map_err(|fault| broken(format!("{name}: {fault}")))?;
    directory.write(&format!("{name}.svg"), svg::write(&scene).as_bytes())?;
    Ok(())
}
