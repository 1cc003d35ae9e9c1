//! The worst that can be found: every source at one of its ends, gaps to the sides to which the loads press them there.

use super::loaded::{Carried, Loaded, Systems, carried_over};
use super::question::{Posed, extreme, room};
use super::slopes::Slope;
use crate::ascent::Farthest;
use crate::limits::MOST_PASSES;
use crate::source::{Pair, Room};
use linkdyn_engine::system::System;
use std::sync::Arc;

/// Coordinates that move by less, in radians or sizes, stand still.
const STILL: f64 = 1e-12;
/// Sources that span less than this part of all, or than so many times what the first order leaves out, are tried at their other
/// end.
const WEAK: f64 = 0.01;
const REMAINDERS: f64 = 4.0;

/// A force at a pose on its way to the worst.
pub(super) struct Corner<'a, 'f> {
    pub systems: &'a mut Systems<'f>,
    pub posed: &'a Posed,
    /// Number of the force at the pose.
    pub force: usize,
    pub nominal: &'a Carried,
    pub slopes: &'a [[Slope; 2]],
}

/// A balance with sources off, and its system.
struct Met {
    carried: Carried,
    system: Arc<System>,
}

impl Corner<'_, '_> {
    /// The force farthest to a side (±1) among the corners; `None` if its position is not reached.
    pub fn farthest(&mut self, side: f64) -> Option<Farthest> {
        let sources = self.systems.sources;
        let by: Vec<Pair> = self
            .slopes
            .iter()
            .map(|own| own.map(|slope| side * slope.by))
            .collect();
        let ends = sources
            .iter()
            .zip(&by)
            .map(|(source, g)| extreme(source, *g));
        let mut e: Vec<Pair> = ends.collect();
        let mut met = self.met(&e)?;
        let reach: Vec<[f64; 2]> = sources
            .iter()
            .zip(&by)
            .map(|(own, g)| room(own).reach(*g))
            .collect();
        let first: f64 = reach.iter().map(|[_, up]| up).sum();
        let all: f64 = reach.iter().map(|[down, up]| up - down).sum();
        let mut is_better = true;
        while std::mem::take(&mut is_better) {
            let left = (side * self.deviation(&met) - first).abs();
            for source in 0..sources.len() {
                let span = reach[source][1] - reach[source][0];
                if span == 0.0 || span > REMAINDERS * left + WEAK * all {
                    continue;
                }
                for other in self.others(&e, source, side) {
                    let own = std::mem::replace(&mut e[source], other);
                    let tried = self.met(&e);
                    let gained = tried
                        .as_ref()
                        .map(|tried| side * (self.deviation(tried) - self.deviation(&met)));
                    match tried {
                        Some(tried) if gained > Some(STILL * all) => {
                            (met, is_better) = (tried, true)
                        }
                        Some(_) | None => e[source] = own,
                    }
                }
            }
        }
        Some(Farthest {
            deviation: self.deviation(&met),
            q: carried_over(&met.system, &self.systems.nominal, &met.carried.q),
            e,
            lacks: f64::NAN,
            needed: Vec::new(),
        })
    }

    fn deviation(&self, met: &Met) -> f64 {
        met.carried.values[self.force] - self.nominal.values[self.force]
    }

    /// Other places of a source than the one where it is: its other end, of a zone where it carries the force farthest as seen from
    /// the corner.
    fn others(&mut self, e: &[Pair], source: usize, side: f64) -> Vec<Pair> {
        let room = room(&self.systems.sources[source]);
        let Room::Disc(radius) = room else {
            return room.others(e[source]);
        };
        let mut g = [0.0; 2];
        for (axis, g) in g.iter_mut().enumerate() {
            for end in [-1.0, 1.0] {
                let mut off = e.to_vec();
                off[source][axis] += 0.5 * end * radius;
                let met = self.met(&off).map_or(f64::NAN, |met| self.deviation(&met));
                *g += side * end * met;
            }
        }
        let is_known = g.iter().all(|g| g.is_finite());
        room.extreme(g).filter(|_| is_known).into_iter().collect()
    }

    /// The balance with sources off, followed from the nominal position.
    fn met(&mut self, e: &[Pair]) -> Option<Met> {
        let mut last = Met {
            carried: self.nominal.clone(),
            system: self.systems.nominal.clone(),
        };
        let (mut part, mut step) = (0.0, 1.0);
        while part < 1.0 {
            let next = f64::min(part + step, 1.0);
            let share: Vec<Pair> = e.iter().map(|e| e.map(|by| by * next)).collect();
            let system = self.systems.with(&share)?;
            match self.pressed(&system, &share, &last) {
                Some(carried) => {
                    last = Met { carried, system };
                    (part, step) = (next, 2.0 * step);
                }
                None => step *= 0.5,
            }
            // Beyond that is no way.
            if step < 1.0 / 256.0 {
                return None;
            }
        }
        Some(last)
    }

    /// The balance in which the gaps are where the loads press.
    fn pressed(&self, system: &System, e: &[Pair], last: &Met) -> Option<Carried> {
        let mut loaded = Loaded::new(self.systems, system, self.posed)?;
        let mut q = carried_over(&last.system, system, &last.carried.q);
        let mut sides = last.carried.sides.clone();
        for _ in 0..MOST_PASSES {
            let found = loaded.carry(self.posed, &q, e, &sides).ok()?;
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
