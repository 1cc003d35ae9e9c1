//! The parts of a mechanism that ideal joints hold in loops, with one degree of freedom beside that of the whole part.

use crate::analysis::assembly::{Assembled, ranks};
use crate::element::{BodyColumns, BodyId};
use crate::graph::Topology;
use crate::mechanism::parts::{Part, Seen};
use crate::mechanism::reduced::is_curve;
use crate::system::{Inputs, System};

/// Those parts of a mechanism whose joints' equations are independent and which nothing but geometry holds; none of one that
/// is a curve as a whole.
///
/// Loops that share joints are one part. Where that has more freedom, single loops of it may be parts.
pub fn parts(system: &System, assembled: &Assembled) -> Vec<Part> {
    let q = &assembled.q;
    if is_curve(system, assembled.all.free_columns.len()) {
        return Vec::new();
    }
    let ideal: Vec<usize> = (0..system.joints.len())
        .filter(|&joint| is_ideal(system, joint))
        .collect();
    let edges: Vec<(usize, usize, usize)> = ideal
        .iter()
        .map(|&joint| {
            let [first, second] = system.joints[joint].bodies();
            (first.0, second.0, system.blocks[joint].rows().len())
        })
        .collect();
    let topology = Topology::new(system.bodies.len() + 1, &edges);
    let named = |edges: &[usize]| edges.iter().map(|&edge| ideal[edge]).collect::<Vec<_>>();
    // What nobody knows to lose rank is not worth being followed.
    let is_worth = |part: &Part| part.has_change_points(q);
    let mut found = Vec::new();
    for edges in topology.parts() {
        let whole = part(system, q, &named(&edges));
        if let Some(whole) = whole {
            if whole.from == BodyId::GROUND || is_worth(&whole) {
                found.push(whole);
            }
            continue;
        }
        let mut taken: Vec<usize> = Vec::new();
        for one in topology.loops() {
            let is_apart = one.joints.iter().all(|joint| !taken.contains(joint));
            if !is_apart || !one.joints.iter().all(|joint| edges.contains(joint)) {
                continue;
            }
            if let Some(part) = part(system, q, &named(&one.joints)).filter(is_worth) {
                taken.extend(&one.joints);
                found.push(part);
            }
        }
    }
    found
}

/// Whether the joint is a constraint of geometry alone.
fn is_ideal(system: &System, joint: usize) -> bool {
    let constraint = &system.blocks[joint].constraint;
    system.joints[joint].extras().friction.is_none() && constraint.between(&|body| body).is_some()
}

fn part(system: &System, q: &[f64], joints: &[usize]) -> Option<Part> {
    let held = |body: usize| {
        joints
            .iter()
            .any(|&joint| system.joints[joint].bodies().contains(&BodyId(body)))
    };
    let first = (0..=system.bodies.len()).find(|&body| held(body))?;
    let from = BodyId(first);
    let bodies: Vec<usize> = (first + 1..=system.bodies.len())
        .filter(|&body| held(body))
        .collect();
    let blocks: Vec<(usize, usize)> = joints
        .iter()
        .map(|&joint| (joint, system.blocks[joint].rows().len()))
        .collect();
    let own: Vec<BodyColumns> = bodies
        .iter()
        .filter_map(|body| system.layout.columns(BodyId(*body)))
        .collect();
    let whole: Vec<usize> = own.iter().flat_map(|columns| columns.range()).collect();
    if blocks.iter().map(|(_, rows)| rows).sum::<usize>() + 1 != whole.len() {
        return None;
    }
    let bodies: Vec<BodyId> = bodies.into_iter().map(BodyId).collect();
    let mut ordered = joints.to_vec();
    ordered.sort_unstable();
    let seen = |&column: &usize| {
        let (body, axis) = system.layout.coordinate(column);
        Seen { body, axis, from }
    };
    let mut part = Part {
        system: system.part(from, &bodies, &ordered)?,
        from,
        frame: system.layout.columns(from),
        columns: own
            .iter()
            .flat_map(|columns| columns.range().map(|_| *columns))
            .collect(),
        coordinates: whole.iter().map(seen).collect(),
        blocks,
        independent: 0,
    };
    let alone = &part.system;
    let (_, rank) = ranks(alone, &part.values(q), &Inputs::at_time(alone, 0.0));
    let [independent] = rank.free_columns[..] else {
        return None;
    };
    part.independent = independent;
    Some(part)
}
