//! The parts of a mechanism that ideal joints hold in loops with ground, with one degree of freedom.

use super::variants::Variants;
use crate::analysis::assembly::ranks;
use crate::element::{BodyColumns, BodyId};
use crate::graph::Topology;
use crate::mechanism::parts::Part;
use crate::system::{Inputs, System};
use linkdyn_model::{JointKind, Model};

/// Those parts of `system`, assembled at `q`, whose joints' equations are independent and which nothing but geometry holds.
pub fn parts<'s>(variants: &'s Variants, system: &System, q: &[f64]) -> Vec<Part<'s>> {
    let ideal: Vec<usize> = (0..system.joints.len())
        .filter(|&joint| is_ideal(variants.model, system, joint))
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
        .filter_map(|joints| part(variants, system, q, &joints))
        .collect()
}

/// Whether the joint is a constraint of geometry alone.
fn is_ideal(model: &Model, system: &System, joint: usize) -> bool {
    let data = &system.joints[joint];
    let gear = matches!(model.joints[joint].kind, JointKind::Gear { .. });
    data.clearance.is_none() && data.contact.is_none() && data.friction.is_none() && !gear
}

fn part<'s>(
    variants: &'s Variants,
    system: &System,
    q: &[f64],
    joints: &[usize],
) -> Option<Part<'s>> {
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
    let names: Vec<&str> = bodies
        .iter()
        .map(|body| system.bodies[body - 1].name.as_str())
        .collect();
    let model = variants.model;
    let mut alone = Model {
        drivers: Default::default(),
        forces: Default::default(),
        initial: Default::default(),
        points: Vec::new(),
        analysis: None,
        ..model.clone()
    };
    let moving = |name: &str| system.bodies.iter().any(|body| body.name == name);
    alone
        .bodies
        .retain(|name, _| names.contains(&name.as_str()) || !moving(name));
    alone.joints.retain(|name, _| {
        joints
            .iter()
            .any(|&joint| system.joints[joint].name == *name)
    });
    let alone = variants.part(&alone)?;
    let positions: Vec<f64> = columns.iter().map(|&column| q[column]).collect();
    let (_, rank) = ranks(alone, &positions, &Inputs::at_time(alone, 0.0));
    let [pin] = rank.free_columns[..] else {
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
        pin,
    })
}
