//! The turn that a path repeats.

use super::parameter::Parameter;
use super::path::Path;
use super::six::Turn;
use crate::system::System;
use std::f64::consts::TAU;
use std::ops::Range;

/// Half a turn and a little more: how far a path must be followed to both sides to know whether it comes round.
pub const HALF_TURN: f64 = 1.05 * std::f64::consts::PI;
/// A turn that misses the position by less than this (rad, sizes) closes the path: round-off of its prediction.
const CLOSES: f64 = 1e-7;
/// Nodes on each side of a gap that tell what is in it.
const AROUND: usize = 2;

impl Path {
    /// Takes the stretch of a turn around `centre` for all turns, if the parameter is an angle that comes round: after a
    /// whole turn every body is back in its place. Whether it is so.
    pub(crate) fn close_turn(&mut self, system: &System, centre: f64) -> bool {
        let n = system.n();
        let (mut from, mut to) = (vec![0.0; n], vec![0.0; n]);
        let (mut d, mut dd) = (vec![0.0; n], vec![0.0; n]);
        let ends = [
            (centre - 0.5 * TAU, &mut from),
            (centre + 0.5 * TAU, &mut to),
        ];
        if ends
            .into_iter()
            .any(|(s, q)| self.guess_followed(s, q, &mut d, &mut dd).is_none())
        {
            return false;
        }
        let mut wheels = Vec::new();
        for (column, (to, from)) in to.iter().zip(&from).enumerate() {
            let turns = if system.layout.is_angle(column) {
                ((to - from) / TAU).round()
            } else {
                0.0
            };
            let missed = (to - from - turns * TAU) / system.column_scale(column);
            if missed.abs() > CLOSES {
                return false;
            }
            if turns != 0.0 {
                wheels.push((column as u32, turns as i32));
            }
        }
        wheels.shrink_to_fit();
        self.turn = Some(Turn { centre, wheels });
        if self.parameter == Parameter::Coordinate {
            self.keep_turn(centre);
        }
        true
    }

    /// Leaves out the nodes that no point of a turn around `centre` needs.
    fn keep_turn(&mut self, centre: f64) {
        let kept = self.of_turn(centre, AROUND);
        self.nodes.truncate(kept.end);
        self.nodes.drain(..kept.start);
        self.errors.truncate(kept.end - 1);
        self.errors.drain(..kept.start);
    }

    /// The nodes of a turn around `centre`, with so many beyond each end.
    pub(super) fn of_turn(&self, centre: f64, around: usize) -> Range<usize> {
        let nodes = &self.nodes;
        let first = nodes.partition_point(|node| node.s < centre - 0.5 * TAU);
        let last = nodes.partition_point(|node| node.s <= centre + 0.5 * TAU);
        first.saturating_sub(around)..(last + around).min(nodes.len())
    }

    /// `s` on the turn that stands for all, where the path repeats itself.
    pub(crate) fn within_turn(&self, s: f64) -> f64 {
        match &self.turn {
            Some(turn) if (s - turn.centre).abs() < 0.5 * TAU => s,
            Some(turn) => s - ((s - turn.centre) / TAU).round() * TAU,
            None => s,
        }
    }
}
