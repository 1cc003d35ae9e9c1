//! The worst that can be found: every source at one of its ends, gaps to the sides to which the loads press them there.

use super::loaded::{Carried, Loaded, Offs, Systems, carried_over};
use super::slopes::Slope;
use super::{Posed, extreme, reach};
use crate::analysis::accuracy::source::Play;
use crate::analysis::accuracy::worst::Farthest;
use crate::system::System;
use std::sync::Arc;

/// Most passes until the loads press where the gaps are.
const MOST_PASSES: usize = 50;
/// Coordinates that move by less, in radians or sizes, stand still.
const STILL: f64 = 1e-12;
/// Shortest part of all deviations by which a position is followed.
const SHORTEST: f64 = 1.0 / 256.0;
/// Sources that reach less far than this part of the sum, or than so many times what the first order leaves out, are tried
/// at their other end.
const WEAK: f64 = 0.01;
const REMAINDERS: f64 = 4.0;
/// Most rounds in which sources are turned to their other end.
const MOST_ROUNDS: usize = 4;

/// A force at a pose on its way to the worst.
pub(super) struct Corner<'a, 'f> {
    pub systems: &'a mut Systems<'f>,
    pub posed: &'a Posed,
    /// Number of the force at the pose.
    pub force: usize,
    pub nominal: &'a Carried,
    pub slopes: &'a [[Slope; 2]],
    pub at_rest: bool,
}

/// A balance with sources off, and its system.
struct Met {
    carried: Carried,
    system: Arc<System>,
}

impl Corner<'_, '_> {
    /// The force farthest to a side (±1) among the corners; none where its position is not reached.
    pub fn farthest(&mut self, side: f64) -> Option<Farthest> {
        let plays = self.systems.plays;
        let by: Vec<[f64; 2]> = self
            .slopes
            .iter()
            .map(|slope| slope.map(|s| s.by))
            .collect();
        let ends = plays.iter().zip(&by);
        let mut offs: Offs = ends.map(|(play, g)| extreme(play, *g, side)).collect();
        let mut met = self.met(&offs)?;
        let reached = plays.iter().zip(&by).map(|(play, g)| reach(play, *g));
        let reached: Vec<[f64; 2]> = reached.collect();
        let first: f64 = reached
            .iter()
            .map(|[low, high]| if side > 0.0 { *high } else { *low })
            .sum();
        let total: f64 = reached.iter().map(|[low, high]| high - low).sum();
        for _ in 0..MOST_ROUNDS {
            let left = (self.deviation(&met) - first).abs();
            let mut better = false;
            for source in 0..plays.len() {
                let width = reached[source][1] - reached[source][0];
                if width == 0.0 || width > REMAINDERS * left + WEAK * total {
                    continue;
                }
                let other = match plays[source] {
                    Play::Zone { .. } => self.turned(&offs, source, side),
                    Play::Pin { .. }
                    | Play::Sides { .. }
                    | Play::Guided { .. }
                    | Play::Driver { .. }
                    | Play::Parameter { .. } => {
                        let ends = [-1.0, 1.0].map(|g| extreme(&plays[source], [g, 0.0], side));
                        Some(if offs[source] == ends[0] {
                            ends[1]
                        } else {
                            ends[0]
                        })
                    }
                };
                let Some(other) = other else { continue };
                let own = std::mem::replace(&mut offs[source], other);
                match self.met(&offs) {
                    Some(tried) if side * (self.deviation(&tried) - self.deviation(&met)) > 0.0 => {
                        met = tried;
                        better = true;
                    }
                    Some(_) | None => offs[source] = own,
                }
            }
            if !better {
                break;
            }
        }
        Some(Farthest {
            deviation: self.deviation(&met),
            q: carried_over(&met.system, &self.systems.nominal, &met.carried.q),
            e: offs,
            lacks: f64::NAN,
            needed: Vec::new(),
        })
    }

    fn deviation(&self, met: &Met) -> f64 {
        met.carried.values[self.force] - self.nominal.values[self.force]
    }

    /// Where a zone carries the force farthest, seen from a corner.
    fn turned(&mut self, offs: &Offs, source: usize, side: f64) -> Option<[f64; 2]> {
        let play = &self.systems.plays[source];
        let Play::Zone { radius, .. } = *play else {
            return None;
        };
        let step = 0.5 * radius;
        let mut g = [0.0; 2];
        for (axis, g) in g.iter_mut().enumerate() {
            let mut at = |by: f64| {
                let mut offs = offs.clone();
                offs[source][axis] += by;
                self.met(&offs).map(|met| self.deviation(&met))
            };
            *g = at(step)? - at(-step)?;
        }
        Some(extreme(play, g, side))
    }

    /// The balance with sources off, followed from the nominal position.
    fn met(&mut self, offs: &Offs) -> Option<Met> {
        let nominal = self.systems.nominal.clone();
        let mut last = Met {
            carried: self.nominal.clone(),
            system: nominal.clone(),
        };
        let (mut part, mut step) = (0.0, 1.0);
        while part < 1.0 {
            let next = f64::min(part + step, 1.0);
            let share: Offs = offs.iter().map(|off| off.map(|by| by * next)).collect();
            let system = self.systems.with(&share)?;
            match self.pressed(&nominal, &system, &share, &last) {
                Some(carried) => {
                    last = Met { carried, system };
                    part = next;
                    step *= 2.0;
                }
                None => step *= 0.5,
            }
            if step < SHORTEST {
                return None;
            }
        }
        Some(last)
    }

    /// The balance in which the gaps are where the loads press.
    fn pressed(
        &self,
        nominal: &System,
        system: &System,
        offs: &Offs,
        last: &Met,
    ) -> Option<Carried> {
        let plays = self.systems.plays;
        let mut loaded = Loaded::new([nominal, system], plays, self.posed, self.at_rest)?;
        let mut q = carried_over(&last.system, system, &last.carried.q);
        let mut sides = last.carried.sides.clone();
        for _ in 0..MOST_PASSES {
            let found = loaded.carry(self.posed, Some(&q), offs, &sides).ok()?;
            let moved: Vec<f64> = found.q.iter().zip(&q).map(|(a, b)| a - b).collect();
            if sides == found.sides || system.scaled_norm(&moved) <= STILL {
                return Some(found);
            }
            sides.clone_from(&found.sides);
            q.clone_from(&found.q);
        }
        None
    }
}
