//! The analysis as resolved, for the summary.

use linkdyn_model::{Accelerations, Analysis, AnalysisKind, OutputsAt};

/// An analysis as the file calls it.
fn kind_word(kind: AnalysisKind) -> &'static str {
    match kind {
        AnalysisKind::Assembly => "assembly",
        AnalysisKind::Kinematics => "kinematics",
        AnalysisKind::InverseDynamics => "inverse_dynamics",
        AnalysisKind::Dynamics => "dynamics",
        AnalysisKind::Statics => "statics",
        AnalysisKind::QuasiStatics => "quasi_statics",
    }
}

/// The analysis as resolved, for the summary.
pub(super) fn settings(analysis: &Analysis) -> serde_json::Value {
    let solver = &analysis.solver;
    let mut json = serde_json::json!({
        "type": kind_word(analysis.kind),
        "end": analysis.end,
        "outputs": analysis.outputs,
        "sample": analysis.sample.as_ref().map(|sample| serde_json::json!({
            "driver": sample.driver, "from": sample.from, "to": sample.to, "step": sample.step,
        })),
        "outputs_at": (analysis.outputs_at == OutputsAt::Events).then_some("events"),
        "solver": {
            "method": solver.method, "rtol": solver.rtol, "atol": solver.atol, "max_step": solver.max_step,
            "initial_step": solver.initial_step, "max_wall_time": solver.max_wall_time,
        },
        "columns": analysis.columns,
        "transmission": analysis.transmission.as_ref().map(|transmission| serde_json::json!({
            "driver": transmission.driver, "output": transmission.output,
        })),
    });
    let accelerations = match solver.accelerations {
        Accelerations::Auto => None,
        Accelerations::Dense => Some("dense"),
        Accelerations::Sparse => Some("sparse"),
    };
    json["solver"]["accelerations"] = accelerations.into();
    // What is left out in the file is left out here.
    if let Some(map) = json.as_object_mut() {
        map.retain(|_, value| !value.is_null());
        if let Some(solver) = map
            .get_mut("solver")
            .and_then(|solver| solver.as_object_mut())
        {
            solver.retain(|_, value| !value.is_null());
        }
    }
    json
}
