//! Degrees of freedom, counted and by rank.

use super::assembled::Assembled;
use super::beside::nearby_guess;
use super::ranks::ranks;
use crate::graph::Topology;
use crate::system::{Inputs, Origin, System};
use linkdyn_linear::rank::RankReport;
use linkdyn_output::Mobility;

/// Grübler's count and the count by rank, with the joints that are redundant.
pub(super) fn mobility(system: &System, joints: &RankReport) -> Mobility {
    let n = system.n() as i64;
    let mut redundant: Vec<usize> = joints
        .dependent
        .iter()
        .filter_map(|d| joint_of(system, d.row))
        .collect();
    redundant.dedup();
    let mut shared: Vec<usize> = joints
        .dependent
        .iter()
        .flat_map(|d| d.combination.iter().map(|(row, _)| *row).chain([d.row]))
        .filter_map(|row| joint_of(system, row))
        .collect();
    shared.sort_unstable();
    shared.dedup();
    let names = |joints: Vec<usize>| {
        joints
            .into_iter()
            .map(|k| system.joints[k].name.clone())
            .collect()
    };
    Mobility {
        grubler: n - system.joint_rows() as i64,
        rank: n - joints.rank as i64,
        drivers: system.drivers.len(),
        redundant: names(redundant),
        reactions_not_unique: names(shared),
    }
}

/// Mobility of a mechanism that does not assemble or can't start: by rank near its guess, which may be singular itself.
pub fn counted(system: &System) -> Mobility {
    let inputs = Inputs::at_time(system, 0.0);
    mobility(system, &ranks(system, &nearby_guess(system), &inputs).0)
}

/// The graph of bodies and joints.
pub fn topology(system: &System) -> Topology {
    let joints: Vec<(usize, usize, usize)> = system
        .joints
        .iter()
        .zip(&system.blocks)
        .map(|(joint, block)| (joint.bodies()[0].0, joint.bodies()[1].0, block.rows().len()))
        .collect();
    Topology::new(system.bodies.len() + 1, &joints)
}

fn joint_of(system: &System, row: usize) -> Option<usize> {
    match system.block_of_row(row).origin {
        Origin::Joint(id) => Some(id.0),
        Origin::Driver(_) | Origin::Stop(_) | Origin::Initial(_) => None,
    }
}

/// The same position with the ranks and the mobility of another system of the same bodies.
pub fn ranked(system: &System, assembled: Assembled, inputs: &Inputs) -> Assembled {
    let (joints, all) = ranks(system, &assembled.q, inputs);
    let mobility = mobility(system, &joints);
    Assembled {
        joints,
        all,
        mobility,
        ..assembled
    }
}
