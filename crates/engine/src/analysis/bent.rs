//! How elastic links look: places of their axes by the columns of results.

use crate::element::Pose;
use crate::system::{BodyPart, System, compile::compile};
use linkdyn_linear::math::Vec2;
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
    let chains = (0..system.bodies.len()).filter_map(|body| chain(system, body));
    system.axes.iter().map(axis).chain(chains).collect()
}

/// The axis of a chain, whose parts behind the first have results of their own, `rod.node1`; as it is drawn it is straight.
fn chain(system: &System, body: usize) -> Option<BentAxis> {
    let own = &system.bodies[body];
    let place = |body: usize| Vec2::new(system.guess[3 * body], system.guess[3 * body + 1]);
    let back = Pose::new(0.0, 0.0, -system.guess[3 * body + 2]);
    let nodes = system.bodies.iter().enumerate();
    let nodes = nodes
        .filter(|(_, node)| matches!(node.part, BodyPart::Node(_)) && node.link == own.name)
        .map(|(node, _)| (back.turn(place(node) - place(body)) - own.origin).into());
    let first: [f64; 2] = (-own.origin).into();
    let places: Vec<[f64; 2]> = std::iter::once(first).chain(nodes).collect();
    (own.part == BodyPart::Own && places.len() > 1).then(|| BentAxis {
        body: own.name.clone(),
        amplitudes: Vec::new(),
        moves: vec![Vec::new(); places.len()],
        places,
        curvatures: Vec::new(),
    })
}
