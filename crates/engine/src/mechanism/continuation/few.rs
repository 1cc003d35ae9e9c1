//! As few nodes as tell the curve of a large mechanism.
//!
//! A node takes 72 bytes of each body, and steps that escape no branch leave more of them than the curve's digits need. The polynomial
//! of degree 17 through six nodes spans gaps of a radian where that of degree 11 through four spans a third of one, and nodes that
//! are farther apart amplify each other's round-off less, beside change points above all. Which may be left out they tell themselves:
//! each must be missed by the polynomial through those that stay by no more than the round-off of the nodes. The smooth branches
//! across change points are points of that polynomial, too, and need none of their own. On a path that repeats itself those of one turn
//! stand for all: at its ends the nodes around a gap are those of the other end, a turn on.

use super::path::Path;
use super::six::{Moved, Turn, WIDE, around, osculate_six};
use crate::system::System;
use linkdyn_linear::hermite::{Node, Osculating};
use std::f64::consts::TAU;
use std::ops::Range;

/// Coordinates from which on nodes are left out: those of a turn take a megabyte, more than stays near a processor.
const LARGE: usize = 1000;
/// Width of gaps that is tried first, by the parameter's unit.
const GAP: f64 = 1.05;
/// Rounds in which gaps are halved, before all nodes of a gap are taken back.
const HALVED: usize = 3;
/// What is left out may be missed by this [rad or sizes].
const KNOWN: f64 = 1e-12;
/// Where round-off is more, by this many times the median of what gaps were reported to be off by: that weighs a node that is left out by
/// what a polynomial leaves, of which the gap has much less, while round-off of the nodes' own q″ is there in full.
const ROUND_OFF: f64 = 40.0;
/// Between nodes that are left out a polynomial is off by no more than this many times what it is off by there.
const BETWEEN: f64 = 2.0;
/// Places of a window where its branch is compared, by its radius.
const PLACES: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];

impl Path {
    /// Leaves out what others tell, of a large mechanism; `unit` is that of the parameter.
    pub(crate) fn leave_out(&mut self, system: &System, unit: f64) {
        if system.n() < LARGE {
            return;
        }
        // Of a turn nothing is wanted beyond its ends.
        let all = match &self.turn {
            Some(turn) => self.of_turn_once(turn.centre),
            None => 0..self.nodes.len(),
        };
        if all.len() <= 2 * WIDE {
            return;
        }
        let mut errors = self.errors[all.start..all.end - 1].to_vec();
        if self.turn.is_some() {
            // Of the gap between its ends, which is narrower than those that the march made there.
            let beside = [errors[0], errors[errors.len() - 1]];
            errors.push(beside[0].max(beside[1]));
        }
        let [q, d, dd] = std::array::from_fn(|_| vec![0.0; system.n()]);
        let mut few = Few {
            system,
            unit,
            turn: self.turn.as_ref(),
            all: &self.nodes[all.clone()],
            missed: KNOWN.max(ROUND_OFF * median(&errors)),
            errors: &errors,
            known: Vec::new(),
            room: [q, d, dd],
        };
        let kept = few.kept();
        if 2 * kept.len() > all.len() {
            return;
        }
        let errors = few.errors_of(&kept);
        let told: Vec<bool> = self
            .windows
            .iter()
            .map(|window| {
                let branch = window.branch.as_ref();
                branch.is_some_and(|branch| few.tells(&kept, branch, (window.s, window.radius)))
            })
            .collect();
        let mut number = 0..;
        self.nodes.retain(|_| {
            let own = number
                .next()
                .and_then(|number: usize| number.checked_sub(all.start));
            own.is_some_and(|own| kept.binary_search(&own).is_ok())
        });
        self.nodes.shrink_to_fit();
        self.errors = errors;
        self.is_wide = true;
        let windows = self.windows.iter_mut().zip(told);
        for (window, _) in windows.filter(|(_, is_told)| *is_told) {
            window.branch = None;
        }
    }
}

impl Path {
    /// The nodes of a turn around `centre`, none of which stands where another one does a turn on.
    fn of_turn_once(&self, centre: f64) -> Range<usize> {
        let mut all = self.of_turn(centre, 0);
        let nodes = &self.nodes[all.clone()];
        if let [first, .., last] = nodes
            && first.s + TAU - last.s < 0.5 * TAU / nodes.len() as f64
        {
            all.end -= 1;
        }
        all
    }
}

/// The median of what is finite, of a list that has such; else zero.
fn median(values: &[f64]) -> f64 {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    let mut finite: Vec<f64> = finite.collect();
    finite.sort_unstable_by(f64::total_cmp);
    finite.get(finite.len() / 2).copied().unwrap_or(0.0)
}

/// A gap: its first node, and the nodes around it.
type Gap = (usize, [Moved; WIDE]);

/// Which nodes stay, while that is tried.
struct Few<'a> {
    system: &'a System,
    unit: f64,
    /// Where the path repeats itself, and all are those of a turn.
    turn: Option<&'a Turn>,
    /// All of them, and what the gaps behind them were reported to be off by.
    all: &'a [Node],
    errors: &'a [f64],
    /// By how much nodes that are left out may be missed [rad or sizes].
    missed: f64,
    /// By how much nodes in gaps are missed, at most.
    known: Vec<(Gap, f64)>,
    room: [Vec<f64>; 3],
}

impl Few<'_> {
    /// The nodes that stay.
    fn kept(&mut self) -> Vec<usize> {
        let mut kept = self.spaced();
        for round in 0.. {
            let back = self.wanted_back(&kept, round);
            if back.is_empty() {
                break;
            }
            kept.extend(back);
            kept.sort_unstable();
        }
        kept
    }

    /// Nodes that are about as far apart as the gaps that are tried first, both ends where there are such, and six at least.
    fn spaced(&self) -> Vec<usize> {
        let last = self.all.len() - 1;
        let from = self.all[0].s;
        let length = match self.turn {
            Some(_) => TAU,
            None => self.all[last].s - from,
        };
        let least = match self.turn {
            Some(_) => WIDE,
            None => WIDE - 1,
        };
        let gaps = (length / (GAP * self.unit)).ceil().max(least as f64);
        let mut kept = vec![0];
        for gap in 1..gaps as usize {
            let s = from + length * gap as f64 / gaps;
            let after = self.all.partition_point(|node| node.s < s).min(last);
            let before = after.saturating_sub(1);
            let is_nearer = s - self.all[before].s < self.all[after].s - s;
            kept.push(if is_nearer { before } else { after });
        }
        if self.turn.is_none() {
            kept.push(last);
        }
        kept.sort_unstable();
        kept.dedup();
        // Of nodes that stand unevenly some were the nearest of two places.
        for index in 0..=last {
            if kept.len() >= WIDE {
                break;
            }
            if let Err(at) = kept.binary_search(&index) {
                kept.insert(at, index);
            }
        }
        kept
    }

    /// The nodes that those in the gap before `kept[k]` are told by.
    fn around(&self, kept: &[usize], k: usize) -> [Moved; WIDE] {
        let six = around(k, kept.len(), self.turn.is_some());
        six.map(|(place, turns)| (kept[place], turns))
    }

    /// The gaps between nodes that stay: numbers of the nodes that end them, and where they begin and end. One that comes round ends
    /// behind the last node.
    fn gaps(&self, kept: &[usize]) -> impl Iterator<Item = (usize, Range<usize>)> + use<> {
        let round = self.turn.map(|_| kept[0] + self.all.len());
        let ends = kept[1..].iter().copied().chain(round);
        let gaps: Vec<_> = kept.iter().zip(ends).map(|(a, b)| *a..b).collect();
        (1..).zip(gaps)
    }

    /// By how much the polynomial through some nodes misses a point, in q and by the parameter's unit in q′ and q″ [rad or sizes].
    fn miss(&mut self, six: [Moved; WIDE], s: f64, wanted: [&[f64]; 3]) -> f64 {
        let [q, d, dd] = &mut self.room;
        osculate_six(self.all, six, self.turn, s, [q, d, dd]);
        let powers = [1.0, self.unit, self.unit * self.unit];
        let mut largest = 0.0_f64;
        for ((found, wanted), power) in self.room.iter_mut().zip(wanted).zip(powers) {
            let pairs = found.iter_mut().zip(wanted);
            pairs.for_each(|(found, wanted)| *found = (*found - wanted) * power);
            largest = largest.max(self.system.scaled_norm(found));
        }
        largest
    }

    /// Nodes that are missed by too much: the middle one of each gap that has such, or all of it in a late round.
    fn wanted_back(&mut self, kept: &[usize], round: usize) -> Vec<usize> {
        let (mut back, count) = (Vec::new(), self.all.len());
        for (k, gap) in self.gaps(kept) {
            let own = (gap.start, self.around(kept, k));
            if self.known.iter().any(|(known, _)| *known == own) || gap.len() < 2 {
                continue;
            }
            // What comes round stands at the list's beginning.
            let round_on = self.around(kept, k - k / kept.len() * kept.len());
            let (mut largest, mut is_told) = (0.0_f64, true);
            for index in gap.start + 1..gap.end {
                let node = &self.all[index % count];
                let six = if index < count { own.1 } else { round_on };
                let miss = self.miss(six, node.s, [&node.q, &node.d, &node.dd]);
                largest = largest.max(miss);
                is_told &= miss <= self.missed;
                if !is_told {
                    break;
                }
            }
            match (is_told, round < HALVED) {
                (true, _) => self.known.push((own, largest)),
                (false, true) => back.push((gap.start + gap.len() / 2) % count),
                (false, false) => back.extend((gap.start + 1..gap.end).map(|k| k % count)),
            }
        }
        back
    }

    /// What the gaps between nodes that stay are off by: where nothing was left out, what was not known before.
    fn errors_of(&self, kept: &[usize]) -> Vec<f64> {
        let error = |(k, gap): (usize, Range<usize>)| {
            let own = (gap.start, self.around(kept, k));
            let known = self.known.iter().find(|(known, _)| *known == own);
            // Round-off is reported as it was.
            known.map_or(self.errors[gap.start], |(_, miss)| {
                (BETWEEN * miss).min(KNOWN).max(miss / ROUND_OFF)
            })
        };
        self.gaps(kept).map(error).collect()
    }

    /// Whether the nodes that stay tell the branch of a window about `s`.
    fn tells(&mut self, kept: &[usize], branch: &Osculating, (s, radius): (f64, f64)) -> bool {
        let n = self.system.n();
        let [mut q, mut d, mut dd] = std::array::from_fn(|_| vec![0.0; n]);
        PLACES.iter().all(|place| {
            let s = s + place * radius;
            let after = kept.partition_point(|index| self.all[*index].s <= s);
            let k = match self.turn {
                Some(_) => after,
                None => after.clamp(1, kept.len() - 1),
            };
            let six = self.around(kept, k);
            branch.eval(s, &mut q, &mut d, &mut dd);
            self.miss(six, s, [&q, &d, &dd]) <= self.missed
        })
    }
}
