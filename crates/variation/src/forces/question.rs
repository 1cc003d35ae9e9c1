//! What is asked of forces, and the numbers by which sources act on them.

use super::super::poses::NominalPose;
use super::super::source::{Pair, Room, Source};
use super::super::wanted::Wanted;
use linkdyn_engine::system::System;
use linkdyn_output::{DriverQuantity, JointQuantity};

/// A force that is asked about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Force {
    pub owner: Owner,
    /// `N` or `N*m`.
    pub unit: &'static str,
}

/// Whose force it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Owner {
    /// What a driver exerts.
    Driver(usize, DriverQuantity),
    /// What a joint exerts on its second body.
    Joint(usize, JointQuantity),
}

/// Makes the system with parameters (in the order of their sources) and zones (in theirs) off; `None` if that is no legal
/// model.
pub type Making<'c> = dyn Fn(&[f64], &[[f64; 2]]) -> Option<System> + Sync + 'c;

/// What is asked of forces.
pub struct ForceQuestion<'q> {
    /// Forces with their places among all outputs.
    pub outputs: Vec<(usize, Wanted<Force>)>,
    /// Nothing moves.
    pub at_rest: bool,
    /// What the number of each source is measured by [SI].
    pub scales: Vec<f64>,
    pub making: &'q Making<'q>,
}

/// A pose, and the forces that are asked about there.
pub struct Posed {
    pub stand: NominalPose,
    /// Driver and value that say which pose it is, whatever its motion.
    pub exact: Option<(usize, f64)>,
    /// With the numbers of their outputs.
    pub forces: Vec<(usize, Force)>,
}

/// The numbers of a source: of a clearance one, from its least to its greatest.
pub fn room(source: &Source) -> Room {
    source.clearance().map_or(source.room, Room::Line)
}

/// How many numbers derivatives are taken by.
pub fn numbers(source: &Source) -> usize {
    room(source).numbers()
}

/// Where a source carries a force farthest up.
pub fn extreme(source: &Source, g: Pair) -> Pair {
    let room = room(source);
    room.extreme(g).unwrap_or_else(|| room.rest())
}
