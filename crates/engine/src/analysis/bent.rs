//! How elastic links look: places of their axes by the columns of results.

use super::assembly::{assemble, velocities};
use crate::element::coordinate::Coordinate;
use crate::element::station::CarriedSection;
use crate::element::{Axis, BodyId, Marker, Pose};
use crate::system::{BodyPart, Inputs, System, compile::compile};
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_model::display::number;
use linkdyn_model::{AnalysisKind, Checked};
use linkdyn_output::Trajectory;
use std::f64::consts::TAU;

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
    let drawn = |body: usize| system.layout.moving(body).read(&system.guess);
    let place = |body: usize| Vec2::new(drawn(body)[0], drawn(body)[1]);
    let back = Pose::new(0.0, 0.0, -drawn(body)[2]);
    let nodes = system.bodies.iter().enumerate();
    let nodes = nodes
        .filter(|(_, node)| matches!(node.part(), BodyPart::Node(_)) && node.link() == own.name)
        .map(|(node, _)| (back.turn(place(node) - place(body)) - own.origin).into());
    let first: [f64; 2] = (-own.origin).into();
    let places: Vec<[f64; 2]> = std::iter::once(first).chain(nodes).collect();
    (own.part() == BodyPart::Own && places.len() > 1).then(|| BentAxis {
        body: own.name.clone(),
        amplitudes: Vec::new(),
        moves: vec![Vec::new(); places.len()],
        places,
        curvatures: Vec::new(),
    })
}

/// Deflection by length beyond which few modes, to second order, are no description of a link.
const FARTHEST: f64 = 0.1;

/// Links that leave the range in which few modes describe them, in some row; and what their axial vibrations cost in a run of so many
/// steps.
pub(super) fn warnings(system: &System, rows: &Trajectory, steps: usize) -> Vec<String> {
    let mut said = Vec::new();
    for axis in &system.axes {
        let name = &system.bodies[axis.body].name;
        let column = |name: String| rows.columns.iter().position(|own| own.name == name);
        let columns: Vec<Option<usize>> = (1..=axis.amplitudes.len())
            .map(|k| column(format!("{name}.q{k}")))
            .collect();
        let reach = |station: &CarriedSection| station.place.norm();
        let length = axis.stations.iter().map(reach).fold(0.0, f64::max);
        let deflected = |row: &[f64]| {
            let of = |station: &CarriedSection| {
                let shares = station.shares.iter().zip(&columns);
                let moved = shares.fold(Vec2::zeros(), |sum, (share, column)| {
                    sum + share.moves * column.map_or(0.0, |column| row[column])
                });
                moved.norm()
            };
            axis.stations.iter().map(of).fold(0.0, f64::max) / length
        };
        let display = &system.display;
        let known = rows.rows().map(|row| (deflected(row), row[0]));
        let known = known.filter(|(share, _)| share.is_finite());
        let worst = known.max_by(|one, other| one.0.total_cmp(&other.0));
        if let Some((share, time)) = worst.filter(|(share, _)| *share > FARTHEST) {
            said.push(format!(
                "elastic link \"{name}\" is deflected by {} of its length at t = {}, where few modes describe it no more (0.1): give \"elements\" instead of \"modes\"",
                number(share, 3),
                display.time(time)
            ));
        }
        let [slowest, fastest] = axis.frequencies;
        let turns = column(format!("{name}.omega")).map(|column| {
            let rates = rows.rows().map(|row| row[column].abs());
            rates.filter(|rate| rate.is_finite()).fold(0.0, f64::max)
        });
        if let Some(rate) = turns.filter(|rate| !axis.shortens && *rate > slowest && slowest > 0.0)
        {
            said.push(format!(
                "elastic link \"{name}\" turns at {} rad/s, faster than its first vibration at {} rad/s, without the foreshortening that stiffens it: leave out \"foreshortening\": false",
                number(rate, 4),
                number(slowest, 4)
            ));
        }
        let times = rows.rows().map(|row| row[0]);
        let duration = times.fold(0.0, f64::max);
        // A vibration takes some ten steps a period, where it is followed.
        let periods = fastest * duration / TAU;
        if axis.stretches && steps > 2000 && (2.0..200.0).contains(&(steps as f64 / periods)) {
            said.push(format!(
                "vibrations along elastic link \"{name}\", {} in the run, take most of its {steps} steps: leave out \"axial\" unless they matter",
                number(periods, 3)
            ));
        }
    }
    said
}

/// The system of a model as it starts: chains of elements are straight and move as the rigid links do, from where the rigid mechanism is.
/// Else closing the loops would bend them in their last element, and a motion would begin with a blow.
pub(super) fn straightened(model: &Checked, mut system: System) -> System {
    let is_node = |part: BodyPart| matches!(part, BodyPart::Node(_));
    if !system.bodies.iter().any(|body| is_node(body.part())) {
        return system;
    }
    // What does not assemble is left to the elastic mechanism, which says so.
    let Ok(rigid) = compile(model, AnalysisKind::Assembly) else {
        return system;
    };
    let inputs = Inputs::at_time(&rigid, 0.0);
    let start = assemble(&rigid, &inputs)
        .and_then(|found| Ok((velocities(&rigid, &found.q, &inputs)?, found.q)));
    let Ok((v, q)) = start else {
        return system;
    };
    let own: Vec<(usize, Pose, Pose)> = rigid
        .bodies
        .iter()
        .enumerate()
        .map(|(k, body)| {
            let place = |system: &System, values: &[f64], origin: Vec2| {
                let [x, y, theta] = system.layout.moving(k).read(values);
                let pose = Pose::new(x, y, theta);
                Pose::new(x + pose.turn(origin).x, y + pose.turn(origin).y, theta)
            };
            let drawn = place(&system, &system.guess, system.bodies[k].origin);
            (k, drawn, place(&rigid, &q, body.origin))
        })
        .collect();
    for (k, drawn, found) in own {
        let [vx, vy, omega] = rigid.layout.moving(k).read(&v);
        let centre = found.r - found.turn(rigid.bodies[k].origin);
        let name = rigid.bodies[k].name.clone();
        for (index, columns) in
            (0..system.bodies.len()).map(|index| (index, system.layout.moving(index)))
        {
            let body = &system.bodies[index];
            if body.link() != name || matches!(body.part(), BodyPart::Amplitudes { .. }) {
                continue;
            }
            let [x, y, theta] = columns.read(&system.guess);
            let off =
                Pose::new(0.0, 0.0, found.theta - drawn.theta).turn(Vec2::new(x, y) - drawn.r);
            let place = found.r + off;
            columns.write(
                &mut system.guess,
                [place.x, place.y, theta + found.theta - drawn.theta],
            );
            if is_node(body.part()) {
                let moved = perp(place - centre) * omega;
                let origin = Marker {
                    body: BodyId::moving(index),
                    s: Vec2::zeros(),
                };
                for (axis, value) in [
                    (Axis::X, vx + moved.x),
                    (Axis::Y, vy + moved.y),
                    (Axis::Theta, omega),
                ] {
                    let rate = Coordinate {
                        origin,
                        axis,
                        value,
                        drive: None,
                    };
                    let name = format!("{}.{axis:?}", body.name);
                    system.initial_rates.push((name, rate));
                }
            }
        }
    }
    system
}
