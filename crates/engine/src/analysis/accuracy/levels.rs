//! The levels of accuracy at one pose.

use super::displaced::{Mechanism, Stand};
use super::enclosure::Region;
use super::output::Load;
use super::search::Search;
use super::source::{Influence, Play, length};
use super::statistics::{Spread, capability};
use super::worst::Farthest;
use super::{Contribution, Pins, PoseAccuracy, Question};
use crate::analysis::clearance_link::forces_at_factors;
use crate::analysis::sample::Sample;
use crate::system::System;

/// Deviations that differ by less than this part are the same.
const SAME: f64 = 1e-10;

/// How much is asked; each level has those before it, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Levels {
    /// First order, contributions, spread and lost motion.
    First,
    /// And the worst found.
    Worst,
    /// And the certified bound.
    #[default]
    Certified,
}

/// A question on its way through the poses.
pub(super) struct Asked<'a> {
    system: &'a System,
    question: &'a Question<'a>,
    mechanism: Mechanism<'a>,
    sample: Sample,
    /// How the sources scatter.
    spreads: Vec<Spread>,
    /// Of the sources by output, as last asked for.
    influences: Vec<Vec<Influence>>,
    /// For the farthest, by output and side.
    searches: Vec<[Search; 2]>,
}

impl<'a> Asked<'a> {
    pub fn new(
        system: &'a System,
        question: &'a Question<'a>,
        mechanism: Mechanism<'a>,
    ) -> Asked<'a> {
        Asked {
            influences: vec![vec![[0.0; 2]; mechanism.plays.len()]; question.outputs.len()],
            searches: vec![
                [-1.0, 1.0].map(|side| Search::new(&mechanism, side));
                question.outputs.len()
            ],
            spreads: mechanism
                .plays
                .iter()
                .map(|play| Spread::new(play, question.pins))
                .collect(),
            sample: Sample::new(system),
            system,
            question,
            mechanism,
        }
    }

    /// The levels that are asked for, at one pose of the outputs with these numbers.
    pub fn poses(&mut self, outputs: &[usize], stand: &Stand) -> Vec<PoseAccuracy> {
        let is_regular = self.mechanism.stand(stand) && stand.self_stress.is_none();
        let blank = PoseAccuracy::at(self.system, stand, f64::NAN);
        let mut poses = vec![blank; outputs.len()];
        // All that needs the nominal position comes first, for the farthest leaves it.
        let mut loads = Vec::with_capacity(outputs.len());
        for (&index, pose) in outputs.iter().zip(&mut poses) {
            let output = &self.question.outputs[index].output;
            pose.nominal = self.mechanism.value(stand, output, 0.0);
            let load = is_regular.then(|| self.mechanism.load(stand, output));
            let load = load.flatten();
            if let Some(load) = &load {
                self.first_order(index, stand, load, pose);
            }
            loads.push(load);
        }
        let has_loads = loads.iter().any(Option::is_some);
        let begun = if self.question.levels > Levels::First && has_loads {
            self.bounds(stand, outputs, &loads, &mut poses)
        } else {
            vec![[false; 2]; outputs.len()]
        };
        if has_loads {
            self.press(stand, outputs, &loads, &mut poses);
        }
        if self.question.levels == Levels::First {
            return poses;
        }
        let each = outputs.iter().zip(&mut poses).zip(&loads).zip(begun);
        for (((&index, pose), load), begun) in each {
            let (load, nominal) = (load.as_ref(), pose.nominal);
            let found =
                [0, 1].map(|side| self.found(index, stand, load, (side, begun[side]), nominal));
            pose.take(self.system, found);
        }
        poses
    }

    /// The certified bounds; and begins the searches for the worst, where the mechanism stays about the position, which it says.
    fn bounds(
        &mut self,
        stand: &Stand,
        outputs: &[usize],
        loads: &[Option<Load>],
        poses: &mut [PoseAccuracy],
    ) -> Vec<[bool; 2]> {
        let region = self.mechanism.region(stand);
        let mut stays = Vec::with_capacity(outputs.len());
        for ((&index, pose), load) in outputs.iter().zip(&mut *poses).zip(loads) {
            let bound = self.certified(index, stand, load.as_ref(), &region, pose.first);
            // Where the mechanism may leave the position, only what is reached step by step belongs to it.
            stays.push(region.is_some() && (bound.is_some() || !self.mechanism.is_bounded));
            pose.certified = bound.filter(|_| self.question.levels == Levels::Certified);
        }
        let each = outputs.iter().zip(loads).zip(poses).zip(stays);
        let begun = each.map(|(((&index, load), pose), stays)| {
            let (Some(load), Some(first), true) = (load, pose.first, stays) else {
                return [false; 2];
            };
            let nominal = (load, self.influences[index].as_slice());
            let mechanism = &mut self.mechanism;
            let searches = &mut self.searches[index];
            [0, 1].map(|side| {
                let values = [pose.nominal, first[side]];
                mechanism.begin(stand, nominal, values, &mut searches[side])
            })
        });
        begun.collect()
    }

    fn certified(
        &mut self,
        index: usize,
        stand: &Stand,
        load: Option<&Load>,
        region: &Option<Region>,
        first: Option<[f64; 2]>,
    ) -> Option<[f64; 2]> {
        let output = &self.question.outputs[index].output;
        let mechanism = &mut self.mechanism;
        mechanism.bound(stand, output, load?, first?, region.as_ref()?)
    }

    /// The farthest deviation to a side, lower or upper (0 or 1), from a search that was begun, or step by step.
    fn found(
        &mut self,
        index: usize,
        stand: &Stand,
        load: Option<&Load>,
        (side, is_begun): (usize, bool),
        nominal: f64,
    ) -> Option<Farthest> {
        let output = &self.question.outputs[index].output;
        let mechanism = &mut self.mechanism;
        let search = &mut self.searches[index][side];
        let influences = load.map(|_| self.influences[index].as_slice());
        let known = load.zip(influences).filter(|_| is_begun);
        let near = known.and_then(|known| mechanism.farthest(stand, output, known, search));
        if let (Some(near), Some((_, g))) = (&near, known)
            && mechanism.is_plain((stand, output), search, g, near)
        {
            return Some(near.clone());
        }
        let side = search.side;
        // Where sources went to and fro, on from there if nothing is found step by step.
        let last = known.map(|_| search.last());
        let found = near.or_else(|| {
            search.forget();
            // At a change point the self-stress is the load that the equations balance without any on the output.
            let stress = || stand.self_stress.clone().filter(|own| !own.is_empty());
            let load = match load {
                Some(load) => load.times(side),
                None => stress().map(|lambda| Load { lambda, size: 0.0 })?,
            };
            mechanism.reach(stand, output, load, side)
        });
        let from = found.as_ref().or(last.as_ref());
        let asked = (nominal, influences, side);
        let farther = mechanism.climb(stand, output, asked, from);
        let farther = farther.filter(|farther| search.goes(farther.deviation));
        let (found, farther) = match (found, farther) {
            (Some(found), Some(farther)) => (found, farther),
            (found, farther) => return found.or(farther),
        };
        let gained = side * (farther.deviation - found.deviation);
        let same = SAME * found.deviation.abs();
        if gained > same {
            search.forget();
            return Some(farther.beyond(found));
        }
        let lacks = if gained < -same {
            found.lacks
        } else {
            farther.lacks
        };
        Some(Farthest { lacks, ..found })
    }

    /// Influences, shares and spread.
    fn first_order(&mut self, index: usize, stand: &Stand, load: &Load, pose: &mut PoseAccuracy) {
        let output = &self.question.outputs[index].output;
        let influences = &mut self.influences[index];
        self.mechanism.influences(stand, output, load, influences);
        let (mut first, mut mean, mut variance) = ([0.0; 2], 0.0, 0.0);
        let each = self.mechanism.plays.iter().zip(&self.spreads);
        let by = each.zip(&*influences).map(|((play, spread), g)| {
            let reach = play.reach(*g);
            let [middle, square] = spread.moments(*g);
            first = [first[0] + reach[0], first[1] + reach[1]];
            mean += middle;
            variance += square;
            let sensitivity = match play {
                Play::Pin { .. } | Play::Zone { .. } => length(*g),
                Play::Sides { .. }
                | Play::Guided { .. }
                | Play::Driver { .. }
                | Play::Parameter { .. } => g[0],
            };
            Contribution {
                sensitivity,
                reach,
                variance: square,
            }
        });
        pose.contributions = by.collect();
        pose.first = Some(first);
        pose.moments = Some([mean, variance.sqrt()]);
    }

    /// Where the loads of the motion press the journals, and what limits say of the spread, which may follow from it.
    fn press(
        &mut self,
        stand: &Stand,
        outputs: &[usize],
        loads: &[Option<Load>],
        poses: &mut [PoseAccuracy],
    ) {
        let is_known = self.load_of_motion(stand);
        for ((&index, pose), load) in outputs.iter().zip(poses).zip(loads) {
            pose.pressed = load
                .as_ref()
                .filter(|_| is_known)
                .and_then(|load| self.pressed(load));
            let Some([mean, sigma]) = &mut pose.moments else {
                continue;
            };
            if let (Pins::Load, Some(pressed)) = (self.question.pins, pose.pressed) {
                *mean += pressed;
            }
            pose.capability = self.question.outputs[index]
                .limits
                .and_then(|limits| capability(limits, *mean, *sigma));
        }
    }

    /// Forces of the motion, in the sample; whether they are known: not without masses or friction's history.
    fn load_of_motion(&mut self, stand: &Stand) -> bool {
        let mut plays = self.mechanism.plays.iter();
        if !self.system.masses_known || !plays.any(|play| matches!(play, Play::Pin { .. })) {
            return self.system.masses_known;
        }
        self.sample.q.copy_from_slice(&stand.q);
        let driven = &mut self.mechanism.driven;
        forces_at_factors(driven, &stand.inputs, &mut self.sample).is_ok()
    }

    /// Deviation with the journals where the loads of the motion press them.
    fn pressed(&self, load: &Load) -> Option<f64> {
        let mut deviation = 0.0;
        for play in self.mechanism.plays {
            if let Play::Pin { row, clearance } = play {
                let (fx, fy) = (self.sample.lambda[*row], self.sample.lambda[row + 1]);
                let size = fx.hypot(fy);
                if size > 0.0 {
                    // The journal presses the bearing against the force that it feels; g = −λ.
                    let g = [-load.lambda[*row], -load.lambda[row + 1]];
                    deviation -= clearance[1] * (g[0] * fx + g[1] * fy) / size;
                }
            }
        }
        deviation.is_finite().then_some(deviation)
    }
}

impl Load {
    /// The load times a number.
    fn times(&self, factor: f64) -> Load {
        Load {
            lambda: self.lambda.iter().map(|l| l * factor).collect(),
            size: self.size * factor,
        }
    }
}
