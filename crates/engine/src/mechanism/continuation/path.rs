//! What was followed: nodes, windows around change points, and the turn that repeats itself.

use super::parameter::{End, Parameter, SingularPosition};
use super::six::{Turn, WIDE, around, osculate_six};
use linkdyn_linear::hermite::{Node, Osculating, osculate, quintic};
use std::f64::consts::TAU;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

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
    pub width: f64,
    /// Its polynomial; `None` if the path's nodes tell it.
    pub(super) branch: Option<Osculating>,
}

/// The gap that was requested last, where the next search begins.
pub(super) struct LastGap(AtomicUsize);

impl Default for LastGap {
    fn default() -> Self {
        LastGap(AtomicUsize::new(1))
    }
}

impl Clone for LastGap {
    fn clone(&self) -> Self {
        LastGap(AtomicUsize::new(self.0.load(Relaxed)))
    }
}

/// The path: nodes in ascending s.
#[derive(Clone)]
pub struct Path {
    /// What s is.
    pub parameter: Parameter,
    pub(super) nodes: Vec<Node>,
    /// Error of q″ of the polynomial through the four nodes around the gap after each node [rad or sizes, by the square of the
    /// parameter's unit]; empty where it was not looked for.
    pub(super) errors: Vec<f64>,
    pub(super) last: LastGap,
    /// Where it is no more than this, q, q′ and q″ count as known.
    pub(crate) tolerance: f64,
    /// Nodes are few, and six of them tell what is between them. Where the path repeats itself, the first ones follow on the last, and
    /// there is an error of the gap between them.
    pub(super) is_wide: bool,
    pub(super) windows: Vec<Window>,
    /// Singular positions on the stretch that was followed, by s.
    pub(super) singular: Vec<SingularPosition>,
    /// Where the path repeats itself.
    pub(crate) turn: Option<Turn>,
    /// How it ended below.
    pub low: End,
    /// How it ended above.
    pub high: End,
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
        let Some(turn) = &self.turn else {
            return self.guess_followed(s, q, d, dd);
        };
        let off = s - turn.centre;
        if off.abs() < 0.5 * TAU {
            return self.guess_followed(s, q, d, dd);
        }
        let turns = (off / TAU).round();
        let source = self.guess_followed(s - turns * TAU, q, d, dd)?;
        turn.add(turns, q);
        Some(source)
    }

    /// Singular positions in [low, high], by s; of a path that repeats itself, those of every turn.
    pub(crate) fn singular_between(&self, low: f64, high: f64) -> Vec<SingularPosition> {
        let mut found = Vec::new();
        for position in &self.singular {
            let turns = match &self.turn {
                None => 0..=0,
                Some(turn) if (position.s - turn.centre).abs() > 0.5 * TAU => continue,
                Some(_) => {
                    let (first, last) = (
                        ((low - position.s) / TAU).ceil(),
                        ((high - position.s) / TAU).floor(),
                    );
                    first as i64..=(last as i64).min((first as i64).saturating_add(MOST_TURNS))
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
        let centre = self.turn.as_ref().map(|turn| turn.centre);
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
    pub fn self_stress(&self, window: usize) -> &[f64] {
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
            let (count, turn) = (self.nodes.len(), self.turn.as_ref());
            let six = around(k, count, turn.is_some());
            osculate_six(&self.nodes, six, turn, s, [q, d, dd]);
            let is_known = self.errors[(k + count - 1) % count] <= self.tolerance;
            return Some(if is_known {
                Source::Known
            } else {
                Source::Regular
            });
        }
        let is_known = |error: &f64| *error <= self.tolerance;
        let around = k
            .checked_sub(2)
            .and_then(|from| self.nodes.get(from..from + 4));
        if let Some([first, second, third, last]) = around
            && self.errors.get(k - 1).is_some_and(is_known)
        {
            osculate([first, second, third, last], s, [q, d, dd]);
            return Some(Source::Known);
        }
        quintic(&self.nodes[k - 1], &self.nodes[k], s, q, None);
        Some(Source::Regular)
    }

    /// The nodes tell all of a turn, as they stand for those of others.
    fn comes_round(&self) -> Option<&Turn> {
        self.turn.as_ref().filter(|_| self.is_wide)
    }

    /// The node that ends the gap that holds `s`; one for the end of the list where the path comes round. An integrator's points
    /// mostly lie in the gap of the one before.
    fn gap(&self, s: f64) -> usize {
        let last = self.last.0.load(Relaxed);
        if let Some([from, to]) = self.nodes.get(last.wrapping_sub(1)..=last)
            && (from.s..to.s).contains(&s)
        {
            return last;
        }
        let after = self.nodes.partition_point(|node| node.s <= s);
        let gap = match self.comes_round() {
            Some(_) => after,
            None => after.clamp(1, self.nodes.len() - 1),
        };
        self.last.0.store(gap, Relaxed);
        gap
    }

    /// Whether it comes round, so that it has no ends.
    pub fn is_closed(&self) -> bool {
        self.turn.is_some()
    }

    /// The stretch that was followed.
    pub fn covered(&self) -> (f64, f64) {
        match self.comes_round() {
            Some(turn) => (turn.centre - 0.5 * TAU, turn.centre + 0.5 * TAU),
            None => (self.nodes[0].s, self.nodes[self.nodes.len() - 1].s),
        }
    }

    /// The positions at both of its ends.
    pub(crate) fn ends(&self) -> impl Iterator<Item = &[f64]> {
        [self.nodes.first(), self.nodes.last()]
            .into_iter()
            .flatten()
            .map(|node| &node.q[..])
    }

    /// The window that `s` is in.
    pub(crate) fn window_at(&self, s: f64) -> Option<usize> {
        let s = self.within_turn(s);
        self.windows
            .iter()
            .position(|window| (s - window.s).abs() <= window.radius)
    }

    /// Whether `s` is on the stretch that was followed, or on one that repeats it.
    pub fn holds(&self, s: f64) -> bool {
        let (low, high) = self.covered();
        self.turn.is_some() || (low..=high).contains(&s)
    }

    /// The smooth branch across the change point of a window.
    pub(crate) fn branch(&self, window: usize) -> Branch {
        let Window { s, branch, .. } = &self.windows[window];
        let turn = self.turn.as_ref();
        let osculating = branch.clone().unwrap_or_else(|| {
            let after = self.nodes.partition_point(|node| node.s <= *s);
            let six = around(after, self.nodes.len(), turn.is_some());
            let nodes: [Node; WIDE] = six.map(|(index, turns)| {
                let mut node = self.nodes[index].clone();
                node.s += f64::from(turns) * TAU;
                if let Some(turn) = turn {
                    turn.add(f64::from(turns), &mut node.q);
                }
                node
            });
            Osculating::new(&nodes, *s)
        });
        let shift = turn.map(|turn| {
            let mut shift = vec![0.0; self.nodes[0].q.len()];
            turn.add(1.0, &mut shift);
            shift
        });
        Branch {
            s: *s,
            osculating,
            shift,
        }
    }

    /// The windows around change points.
    pub fn windows(&self) -> &[Window] {
        &self.windows
    }
}
