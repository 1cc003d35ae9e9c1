//! The parts of a mechanism that ideal joints hold in loops with ground, with one degree of freedom.

use crate::analysis::assembly::ranks;
use crate::element::{BodyColumns, BodyId};
use crate::graph::Topology;
use crate::mechanism::parts::Part;
use crate::system::{Inputs, System};

/// Those parts of `system`, assembled at `q`, whose joints' equations are independent and which nothing but geometry holds.
pub fn parts(system: &System, q: &[f64]) -> Vec<Part> {
    let ideal: Vec<usize> = (0..system.joints.len())
        .filter(|&joint| is_ideal(system, joint))
        .collect();
    let edges: Vec<(usize, usize, usize)> = ideal
        .iter()
        .map(|&joint| {
            let [first, second] = system.joints[joint].bodies;
            (first.0, second.0, system.blocks[joint].rows)
        })
        .collect();
    let topology = Topology::new(system.bodies.len() + 1, &edges);
    let parts = topology.parts().into_iter().map(|edges| {
        edges
            .into_iter()
            .map(|edge| ideal[edge])
            .collect::<Vec<_>>()
    });
    parts
        .filter_map(|joints| part(system, q, &joints))
        .collect()
}

/// Whether the joint is a constraint of geometry alone.
fn is_ideal(system: &System, joint: usize) -> bool {
    let constraint = &system.blocks[joint].constraint;
    system.joints[joint].friction.is_none() && constraint.between(&|body| body).is_some()
}

fn part(system: &System, q: &[f64], joints: &[usize]) -> Option<Part> {
    let held = |body: usize| {
        joints
            .iter()
            .any(|&joint| system.joints[joint].bodies.contains(&BodyId(body)))
    };
    if !held(BodyId::GROUND.0) {
        return None;
    }
    let bodies: Vec<usize> = (1..=system.bodies.len())
        .filter(|&body| held(body))
        .collect();
    let blocks: Vec<(usize, usize)> = joints
        .iter()
        .map(|&joint| (joint, system.blocks[joint].rows))
        .collect();
    let columns: Vec<usize> = bodies
        .iter()
        .filter_map(|body| system.layout.columns(BodyId(*body)))
        .flat_map(BodyColumns::range)
        .collect();
    if blocks.iter().map(|(_, rows)| rows).sum::<usize>() + 1 != columns.len() {
        return None;
    }
    let bodies: Vec<BodyId> = bodies.into_iter().map(BodyId).collect();
    let mut ordered = joints.to_vec();
    ordered.sort_unstable();
    let alone = system.part(&bodies, &ordered)?;
    let positions: Vec<f64> = columns.iter().map(|&column| q[column]).collect();
    let (_, rank) = ranks(&alone, &positions, &Inputs::at_time(&alone, 0.0));
    let [independent] = rank.free_columns[..] else {
        return None;
    };
    Some(Part {
        system: alone,
        coordinates: columns
            .iter()
            .map(|&column| system.layout.coordinate(column))
            .collect(),
        columns,
        blocks,
        independent,
    })
}
