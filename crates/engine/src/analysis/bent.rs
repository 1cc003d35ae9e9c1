//! How elastic links look: places of their axes by the columns of results.

use crate::system::{System, compile::compile};
use linkdyn_model::{AnalysisKind, Checked};

/// The axis of an elastic link, by result columns: its places are at `place` + Σ `moves` · amplitude in the frame of the body, to first
/// order.
#[derive(Debug, Clone, PartialEq)]
pub struct BentAxis {
    /// The body, as the file names it.
    pub body: String,
    /// Names of the columns of its amplitudes, `rod.q1`; of a chain none.
    pub amplitudes: Vec<String>,
    /// Its places in the frame of the body \[m\].
    pub places: Vec<[f64; 2]>,
    /// How each place moves by each amplitude [–].
    pub moves: Vec<Vec<[f64; 2]>>,
    /// w″ of each place by each amplitude [1/m²]; empty of modal data.
    pub curvatures: Vec<Vec<f64>>,
}

/// The axes of the elastic links of a model where it may move freely, or at rest; none of a model that can't be run.
pub fn bent_axes(model: &Checked) -> Vec<BentAxis> {
    let kind = match model.analysis.as_ref().map(|analysis| analysis.kind) {
        Some(AnalysisKind::Statics) => AnalysisKind::Statics,
        // Modes move whatever the analysis asks for.
        _ => AnalysisKind::Dynamics,
    };
    compile(model, kind).map_or_else(|_| Vec::new(), |system| axes(&system))
}

fn axes(system: &System) -> Vec<BentAxis> {
    let axis = |axis: &crate::system::ElasticAxis| {
        let body = &system.bodies[axis.body];
        BentAxis {
            body: body.name.clone(),
            amplitudes: (1..=axis.amplitudes.len())
                .map(|k| format!("{}.q{k}", body.name))
                .collect(),
            places: axis
                .stations
                .iter()
                .map(|station| (station.place - body.origin).into())
                .collect(),
            moves: axis
                .stations
                .iter()
                .map(|station| {
                    station
                        .shares
                        .iter()
                        .map(|share| share.moves.into())
                        .collect()
                })
                .collect(),
            curvatures: axis.curvatures.clone(),
        }
    };
    system.axes.iter().map(axis).collect()
}
