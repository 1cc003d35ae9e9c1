//! What was followed: nodes, windows around change points, and the turn that repeats itself.

use super::few::{WIDE, first_around};
use super::{End, Parameter, SingularPosition};
use crate::system::System;
use linkdyn_linear::hermite::{Node, Osculating, osculate, osculate_abreast, quintic};
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

/// Half a turn and a little more: how far a path must be followed to both sides to know whether it comes round.
pub const HALF_TURN: f64 = 1.05 * std::f64::consts::PI;
/// A turn that misses the position by less than this (rad, sizes) closes the path: round-off of its prediction.
const CLOSES: f64 = 1e-7;
/// Nodes on each side of a gap that tell what is in it.
const AROUND: usize = 2;
/// More turns than anybody reads the events of.
const MOST_TURNS: i64 = 1000;

/// Near a change point: the smooth branch.
#[derive(Debug, Clone)]
pub struct Window {
    /// Where the change point lies.
    pub(crate) s: f64,
    /// Within this distance the polynomial is used.
    pub(crate) radius: f64,
    /// Half width of the data.
    pub(crate) width: f64,
    /// Its polynomial; none where the path's nodes tell it.
    pub(super) branch: Option<Osculating>,
}

/// The path: nodes in ascending s.
pub struct Path {
    /// What s is.
    pub(crate) parameter: Parameter,
    pub(super) nodes: Vec<Node>,
    /// Error of q″ of the polynomial through the four nodes around the gap after each node [rad or sizes, by the square of the
    /// parameter's unit]; empty where it was not looked for.
    pub(super) errors: Vec<f64>,
    /// The gap that was asked for last.
    pub(super) last: AtomicUsize,
    /// Where it is no more than this, q, q′ and q″ count as known.
    pub(crate) tolerance: f64,
    /// Nodes are few, and six of them tell what is between them.
    pub(super) is_wide: bool,
    pub(super) windows: Vec<Window>,
    /// Singular positions on the stretch that was followed, by s.
    pub(super) singular: Vec<SingularPosition>,
    /// Where the path repeats itself: centre of the stretch that stands for all, and what a turn adds to q (n).
    pub(crate) turn: Option<(f64, Vec<f64>)>,
    /// How it ended below.
    pub(crate) low: End,
    /// How it ended above.
    pub(crate) high: End,
    /// Steps taken.
    pub(crate) steps: u64,
    /// Steps tried in vain.
    pub(crate) rejected: u64,
}

/// The smooth branch across a change point.
#[derive(Debug, Clone)]
pub struct Branch {
    s: f64,
    osculating: Osculating,
    /// What a turn adds to q (n), where the path repeats itself.
    shift: Option<Vec<f64>>,
}

impl Branch {
    /// q_k, q_k′, q_k″ at `s`, of the turn that `s` is in.
    pub(crate) fn jet(&self, k: usize, s: f64) -> [f64; 3] {
        let Some(shift) = &self.shift else {
            return self.osculating.jet(k, s);
        };
        let turns = ((s - self.s) / TAU).round();
        let [q, d, dd] = self.osculating.jet(k, s - turns * TAU);
        [q + turns * shift[k], d, dd]
    }
}

/// Where a value of the path comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// The guess is good to the prediction error; correct it.
    Regular,
    /// Good to the path's tolerance, with q′ and q″.
    Known,
    /// On the smooth branch across a change point, at this distance; do not correct it.
    Bridged {
        /// Number of the window about the change point.
        index: usize,
        /// From the change point, in the path's parameter.
        distance: f64,
    },
}

impl Path {
    /// q, and q′, q″ where they are known or on a bridged stretch, at `s`; none outside what the path covers.
    pub fn guess(&self, s: f64, q: &mut [f64], d: &mut [f64], dd: &mut [f64]) -> Option<Source> {
        let Some((centre, shift)) = &self.turn else {
            return self.guess_followed(s, q, d, dd);
        };
        let off = s - centre;
        if off.abs() < 0.5 * TAU {
            return self.guess_followed(s, q, d, dd);
        }
        let turns = (off / TAU).round();
        let source = self.guess_followed(s - turns * TAU, q, d, dd)?;
        q.iter_mut()
            .zip(shift)
            .for_each(|(q, shift)| *q += turns * shift);
        Some(source)
    }

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
        let mut shift = Vec::with_capacity(n);
        for (column, (to, from)) in to.iter().zip(&from).enumerate() {
            let whole = if system.layout.is_angle(column) {
                ((to - from) / TAU).round() * TAU
            } else {
                0.0
            };
            if ((to - from - whole) / system.column_scale(column)).abs() > CLOSES {
                return false;
            }
            shift.push(whole);
        }
        self.turn = Some((centre, shift));
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

    /// Singular positions in [low, high], by s; of a path that repeats itself, those of every turn.
    pub(crate) fn singular_between(&self, low: f64, high: f64) -> Vec<SingularPosition> {
        let mut found = Vec::new();
        for position in &self.singular {
            let turns = match &self.turn {
                None => 0..=0,
                Some((centre, _)) if (position.s - centre).abs() > 0.5 * TAU => continue,
                Some(_) => {
                    let (first, last) = (
                        ((low - position.s) / TAU).ceil(),
                        ((high - position.s) / TAU).floor(),
                    );
                    first as i64..=(last as i64).min(first as i64 + MOST_TURNS)
                }
            };
            for turn in turns {
                let s = position.s + turn as f64 * TAU;
                if s >= low && s <= high {
                    found.push(SingularPosition {
                        s,
                        ..position.clone()
                    });
                }
            }
        }
        found.sort_by(|a, b| a.s.total_cmp(&b.s));
        found
    }

    /// Change points that are bridged, from `low` to `high`: numbers of their windows, and the parameter; of a path that repeats itself
    /// those of every turn.
    pub(crate) fn change_points_between(
        &self,
        low: f64,
        high: f64,
    ) -> impl Iterator<Item = (usize, f64)> {
        let centre = self.turn.as_ref().map(|(centre, _)| *centre);
        let windows = self.windows.iter().enumerate();
        // Of a turn that stands for all each is there once.
        let own = windows.filter(move |(_, window)| {
            centre.is_none_or(|centre| (window.s - centre).abs() <= 0.5 * TAU)
        });
        own.flat_map(move |(index, window)| {
            let turns = match centre {
                None => 0..=0,
                Some(_) => {
                    let turns = [(low - window.s) / TAU, (high - window.s) / TAU];
                    turns[0].ceil() as i64..=turns[1].floor() as i64
                }
            };
            let each = turns.map(move |turn| (index, window.s + turn as f64 * TAU));
            each.filter(move |(_, s)| (low..=high).contains(s))
        })
    }

    /// The singular position at `s` on the stretch that was followed.
    pub(crate) fn singular_at(&self, s: f64) -> Option<&SingularPosition> {
        self.singular.iter().find(|position| position.s == s)
    }

    /// The self-stress of the change point that a window bridges.
    pub(crate) fn self_stress(&self, window: usize) -> &[f64] {
        let s = self.windows[window].s;
        let nearest = self
            .singular
            .iter()
            .min_by(|a, b| (a.s - s).abs().total_cmp(&(b.s - s).abs()));
        nearest.map_or(&[], |position| &position.self_stress)
    }

    pub(super) fn guess_followed(
        &self,
        s: f64,
        q: &mut [f64],
        d: &mut [f64],
        dd: &mut [f64],
    ) -> Option<Source> {
        for (index, window) in self.windows.iter().enumerate() {
            let distance = s - window.s;
            if distance.abs() <= window.radius {
                match &window.branch {
                    Some(branch) => branch.eval(s, q, d, dd),
                    None => self.regular(s, [q, d, dd]).map(|_| ())?,
                }
                return Some(Source::Bridged { index, distance });
            }
        }
        self.regular(s, [q, d, dd])
    }

    /// The polynomial through the four nodes around `s` where that is good enough, else the quintic between
    /// the neighbouring two, and q alone.
    pub(super) fn regular(&self, s: f64, [q, d, dd]: [&mut [f64]; 3]) -> Option<Source> {
        if self.nodes.len() == 1 {
            q.copy_from_slice(&self.nodes[0].q);
            return (s == self.nodes[0].s).then_some(Source::Regular);
        }
        let (low, high) = self.covered();
        if s < low || s > high {
            return None;
        }
        let k = self.gap(s);
        if self.is_wide {
            let first = first_around(k, self.nodes.len());
            let around: [&Node; WIDE] = std::array::from_fn(|j| &self.nodes[first + j]);
            osculate_abreast(around, s, [q, d, dd]);
            let is_known = self.errors[k - 1] <= self.tolerance;
            return Some(if is_known {
                Source::Known
            } else {
                Source::Regular
            });
        }
        if self
            .errors
            .get(k - 1)
            .is_some_and(|error| *error <= self.tolerance)
        {
            let around: [&Node; 4] = std::array::from_fn(|j| &self.nodes[k - 2 + j]);
            osculate(around, s, [q, d, dd]);
            return Some(Source::Known);
        }
        quintic(&self.nodes[k - 1], &self.nodes[k], s, q, None);
        Some(Source::Regular)
    }

    /// The node that ends the gap that holds `s`. An integrator's points mostly lie in the gap of the one before.
    fn gap(&self, s: f64) -> usize {
        let last = self.last.load(Relaxed);
        if let Some([from, to]) = self.nodes.get(last.wrapping_sub(1)..=last)
            && (from.s..to.s).contains(&s)
        {
            return last;
        }
        let after = self.nodes.partition_point(|node| node.s <= s);
        let gap = after.clamp(1, self.nodes.len() - 1);
        self.last.store(gap, Relaxed);
        gap
    }

    /// The stretch that was followed.
    pub(crate) fn covered(&self) -> (f64, f64) {
        (self.nodes[0].s, self.nodes[self.nodes.len() - 1].s)
    }

    /// The positions at both of its ends.
    pub(crate) fn ends(&self) -> impl Iterator<Item = &[f64]> {
        [self.nodes.first(), self.nodes.last()]
            .into_iter()
            .flatten()
            .map(|node| &node.q[..])
    }

    /// `s` on the turn that stands for all, where the path repeats itself.
    pub(crate) fn within_turn(&self, s: f64) -> f64 {
        match &self.turn {
            Some((centre, _)) if (s - centre).abs() < 0.5 * TAU => s,
            Some((centre, _)) => s - ((s - centre) / TAU).round() * TAU,
            None => s,
        }
    }

    /// The window that `s` is in.
    pub(crate) fn window_at(&self, s: f64) -> Option<usize> {
        let s = self.within_turn(s);
        self.windows
            .iter()
            .position(|window| (s - window.s).abs() <= window.radius)
    }

    /// Whether `s` is on the stretch that was followed, or on one that repeats it.
    pub(crate) fn holds(&self, s: f64) -> bool {
        let (low, high) = self.covered();
        self.turn.is_some() || (low..=high).contains(&s)
    }

    /// The smooth branch across the change point of a window.
    pub(crate) fn branch(&self, window: usize) -> Branch {
        let Window { s, branch, .. } = &self.windows[window];
        let osculating = branch.clone().unwrap_or_else(|| {
            let after = self.nodes.partition_point(|node| node.s <= *s);
            let first = first_around(after, self.nodes.len());
            Osculating::new(&self.nodes[first..first + WIDE], *s)
        });
        Branch {
            s: *s,
            osculating,
            shift: self.turn.as_ref().map(|(_, shift)| shift.clone()),
        }
    }

    /// The windows around change points.
    pub(crate) fn windows(&self) -> &[Window] {
        &self.windows
    }
}
