//! The model with the law of motion as a table of position, velocity and time, and what a run of it shows.

use linkdyn_engine::analysis::Control;
use linkdyn_optimise::fastest::times;
use linkdyn_output::{Status, Trajectory};
use serde_json::{Value, json};

use super::asked::Stroke;
use super::bounds::{Bound, Of};
use super::law::Law;
use crate::put::{Put, read};
use crate::run::unplaced;
use crate::{ModelFile, Unanswered};

/// Outputs of a run in each interval, on average.
const OUTPUTS: usize = 4;

/// The model whose driver moves by the law.
pub(super) fn model(
    file: &ModelFile,
    stroke: &Stroke,
    unit: &str,
    law: &Law,
) -> Result<ModelFile, Unanswered> {
    let direction = (stroke.to - stroke.from).signum();
    let times = times(&law.nodes, &law.found.squares);
    let last = law.nodes.len() - 1;
    let place = |k: usize| match k {
        _ if k == last => stroke.to,
        k => stroke.from + direction * law.nodes[k],
    };
    let points = times.iter().enumerate();
    let points: Vec<Value> = points
        .map(|(k, time)| json!([format!("{time:?} s"), format!("{:?} {unit}", place(k))]))
        .collect();
    let speeds = law.found.squares.iter().map(|b| direction * b.sqrt());
    let speeds: Vec<Value> = speeds.map(|v| json!(format!("{v:?} {unit}/s"))).collect();
    let motion = json!({ "type": "table", "points": points, "velocities": speeds });
    let analysis = json!({
        "type": "inverse_dynamics", "end": format!("{:?} s", times[last]), "outputs": OUTPUTS * last + 1
    });
    let label = "the law of motion";
    let puts = [
        Put::new(
            format!("drivers.{}.motion", stroke.driver),
            motion,
            label.into(),
        ),
        Put::new("analysis".into(), analysis, label.into()),
    ];
    Ok(read(&file.text, &file.sets, &puts)?)
}

/// A run of it, and the largest excess over a limit, by the limit, with its bound and instant.
pub(super) fn check(
    written: &ModelFile,
    bounds: &[Bound],
    law: &Law,
    control: &Control,
) -> Result<(Trajectory, (f64, usize, f64)), Unanswered> {
    let outcome = unplaced(written, control).map_err(|why| written.refused(why))?;
    if outcome.report.status != Status::Completed {
        let why = outcome.report.message.unwrap_or_default();
        return Err(Unanswered::Failed(format!(
            "a run of the law ends early: {why}"
        )));
    }
    let run = outcome.trajectory;
    let mut most = (f64::NEG_INFINITY, 0, 0.0);
    for (k, bound) in bounds.iter().enumerate() {
        let [lower, upper] = bound.range;
        let mut note = |value: f64, time: f64| {
            let over = (value - upper).max(lower - value) / bound.scale();
            if over > most.0 || over.is_nan() {
                most = (over, k, time);
            }
        };
        match bound.of {
            Of::Column(x) => run.rows().for_each(|row| note(row[x], row[0])),
            Of::Size([x, y]) => run
                .rows()
                .for_each(|row| note(row[x].hypot(row[y]), row[0])),
            // These are the law's own.
            Of::Speed => law
                .instants()
                .for_each(|(time, [b, _])| note(b.sqrt(), time)),
            Of::Acceleration => law.instants().for_each(|(time, [_, a])| note(a, time)),
        }
    }
    Ok((run, most))
}
