//! Quantities that follow from a run's results, row by row, and are no result columns: for the report.

use super::applied::applied;
use super::question;
use super::shaking::shaking;
use super::transmission::transmission;
use crate::system::compile::compile;
use linkdyn_model::Checked;
use linkdyn_output::Trajectory;

/// Applied forces and torques at the instants of a table with the poses of all bodies; none where the model can't be run.
pub fn loads(model: &Checked, results: &Trajectory) -> Option<Trajectory> {
    let system = compile(model, model.analysis.as_ref()?.kind).ok()?;
    Some(applied(&system, results))
}

/// Applied forces, shaking force and moment, velocity ratio, mechanical advantage and transmission angles, where they exist; what there is to say
/// about those that do not.
pub fn derived(model: &Checked, results: &Trajectory) -> (Trajectory, Vec<String>) {
    let mut derived = Trajectory::default();
    let mut notes = Vec::new();
    let Some(analysis) = &model.analysis else {
        return (derived, notes);
    };
    let Ok(system) = compile(model, analysis.kind) else {
        return (derived, notes);
    };
    if results.is_empty() {
        return (derived, notes);
    }
    let mut parts = vec![applied(&system, results)];
    parts.extend(shaking(&system, results));
    match analysis
        .transmission
        .as_ref()
        .map(|wanted| transmission(&system, question::transmission(&system, wanted), results))
    {
        Some(Ok((part, said))) => {
            parts.push(part);
            notes.extend(said);
        }
        Some(Err(note)) => notes.push(format!("analysis.transmission: {note}")),
        None => {}
    }
    derived.columns = parts
        .iter()
        .flat_map(|part| part.columns.iter().cloned())
        .collect();
    for row in 0..results.len() {
        parts
            .iter()
            .for_each(|part| derived.data.extend_from_slice(part.row(row)));
    }
    derived
        .data
        .iter_mut()
        .filter(|value| !value.is_finite())
        .for_each(|value| *value = f64::NAN);
    (derived, notes)
}
