//! Least and largest value of every column over the whole motion, and the rows where they are.
//!
//! A run with contacts has peaks much shorter than the distance of its outputs. So each step is examined: its two ends cost
//! nothing but a row, since the mechanism has been evaluated there; and where three ends in a line, or two slopes, say that
//! a column may have passed its extreme so far within the step, the step is searched ([`super`]).
//!
//! Rows at the ends are as exact as steps need them, with round-off of some 1e-10 in velocities and forces. They hold an extreme
//! only until the mechanism is evaluated exactly there.

use super::quantities::{Watched, watched};
use linkdyn_output::{Column, Trajectory};

/// An extreme is located to this part of the column's range, and of columns of a joint with contact to less.
const LOCATED: f64 = 1e-7;
const LOCATED_CONTACT: f64 = 1e-10;
/// A column's range counts as no less than this part of the largest range of its unit: below is round-off. Lengths of contacts are
/// small as such.
const ROUND_OFF: f64 = 1e-3;
const ROUND_OFF_CONTACT: f64 = 1e-5;
/// How far beyond its ends, in parts of the step, a parabola's vertex may lie so that the extreme may be within.
const ASIDE: f64 = 0.3;
/// How much larger than a parabola says an extreme may be, in parts of its rise above the chord.
const HIGHER: f64 = 0.3;
/// The same of a first step, of which only the ends are known, in parts of their difference.
const FIRST_RISE: f64 = 0.25;

/// An extreme so far: its value and the row it is in.
#[derive(Debug, Clone, Copy)]
struct Extreme {
    value: f64,
    row: Option<usize>,
    is_exact: bool,
}

/// A row that holds extremes, as long as there are any.
#[derive(Debug, Clone, Default)]
struct HeldRow {
    uses: usize,
    row: Vec<f64>,
}

/// A row, and the quantities in it.
#[derive(Debug, Clone, Default)]
pub struct Node {
    /// All columns.
    pub row: Vec<f64>,
    /// The quantities.
    pub values: Vec<f64>,
}

impl Node {
    /// Its time \[s\], none of an empty node.
    pub fn time(&self) -> f64 {
        self.row.first().copied().unwrap_or(f64::NAN)
    }
}

/// The sides that an extreme can be on: least and largest.
pub const SIDES: [f64; 2] = [-1.0, 1.0];

/// Extremes of a motion.
#[derive(Clone)]
pub struct Watch {
    watched: Vec<Watched>,
    /// Least and largest, by quantity.
    extremes: Vec<[Extreme; 2]>,
    kept: Vec<HeldRow>,
    free: Vec<usize>,
    /// How near an extreme has to be, by quantity.
    pub near: Vec<f64>,
    spans: Vec<f64>,
    /// The end before the last step, where that is of the same smooth piece.
    pub before: Node,
    /// The beginning of the last step.
    pub start: Node,
    /// Its end.
    pub end: Node,
    /// Ends of this piece so far.
    pub ends: usize,
}

impl Watch {
    /// Of the columns that `patterns` keep.
    pub fn new(columns: &[Column], patterns: &[String]) -> Self {
        let (watched, units) = watched(columns, patterns);
        let none = [f64::INFINITY, f64::NEG_INFINITY].map(|value| Extreme {
            value,
            row: None,
            is_exact: false,
        });
        Watch {
            extremes: vec![none; watched.len()],
            near: vec![0.0; watched.len()],
            spans: vec![0.0; units],
            watched,
            kept: Vec::new(),
            free: Vec::new(),
            before: Node::default(),
            start: Node::default(),
            end: Node::default(),
            ends: 0,
        }
    }

    /// Number of quantities.
    pub fn len(&self) -> usize {
        self.watched.len()
    }

    /// The extreme so far of a quantity, on a side.
    pub fn extreme(&self, quantity: usize, side: usize) -> f64 {
        self.extremes[quantity][side].value
    }

    /// Fills a node with a row.
    pub fn fill(&self, node: &mut Node, row: &[f64]) {
        node.row.clear();
        node.row.extend_from_slice(row);
        node.values.clear();
        node.values.extend(
            self.watched
                .iter()
                .map(|watched| watched.quantity.of(&node.row)),
        );
    }

    /// Takes the node's values for extremes where they are, and where they stand for inexact ones.
    pub fn offer(&mut self, node: &Node, is_exact: bool) {
        let mut slot = None;
        let mut is_wide = false;
        for (quantity, &value) in node.values.iter().enumerate() {
            for (side, sign) in SIDES.into_iter().enumerate() {
                let known = self.extremes[quantity][side];
                let lack = sign * (known.value - value);
                let beats =
                    lack < 0.0 || (is_exact && !known.is_exact && lack <= self.near[quantity]);
                if beats && value.is_finite() {
                    let row = *slot
                        .get_or_insert_with(|| keep(&mut self.kept, &mut self.free, &node.row));
                    self.extremes[quantity][side] = Extreme {
                        value,
                        row: Some(row),
                        is_exact,
                    };
                    self.kept[row].uses += 1;
                    if let Some(old) = known.row {
                        self.kept[old].uses -= 1;
                        if self.kept[old].uses == 0 {
                            self.free.push(old);
                        }
                    }
                    is_wide |= self.measure(quantity);
                }
            }
        }
        if is_wide {
            (0..self.len()).for_each(|quantity| {
                self.measure(quantity);
            });
        }
    }

    /// How near an extreme has to be, by the ranges so far; whether that of its unit has become much larger.
    fn measure(&mut self, quantity: usize) -> bool {
        let watched = self.watched[quantity];
        let [least, most] = self.extremes[quantity];
        let span = (most.value - least.value).max(0.0);
        let unit = &mut self.spans[watched.unit];
        let is_wide = span > 2.0 * *unit;
        *unit = unit.max(span);
        let (located, round_off) = match watched.of_contact {
            true => (LOCATED_CONTACT, ROUND_OFF_CONTACT),
            false => (LOCATED, ROUND_OFF),
        };
        self.near[quantity] = located * span.max(round_off * *unit);
        is_wide
    }

    /// Whether the beginning of the last step holds an extreme by an inexact row.
    pub fn start_is_inexact(&self) -> bool {
        let time = self.start.time();
        let is_there = |extreme: &Extreme| {
            !extreme.is_exact
                && extreme
                    .row
                    .is_some_and(|row| self.kept[row].row.first() == Some(&time))
        };
        self.extremes.iter().flatten().any(is_there)
    }

    /// The last end becomes the beginning of a new step.
    pub fn advance(&mut self) {
        std::mem::swap(&mut self.before, &mut self.start);
        std::mem::swap(&mut self.start, &mut self.end);
        self.ends += 1;
    }

    /// Whether the end before the last step is of the same piece.
    pub fn has_before(&self) -> bool {
        self.ends > 2
    }

    /// Whether anything may have its extreme within the last step.
    pub fn is_suspicious(&self) -> bool {
        (0..self.len()).any(|quantity| self.may_exceed(quantity))
    }

    /// The same from a point within the step, in the place of the end before it.
    pub fn is_within(&self, middle: &Node) -> bool {
        let times = [self.start.time(), middle.time(), self.end.time()];
        let is_within = |quantity: usize| {
            let values = [&self.start, middle, &self.end].map(|node| node.values[quantity]);
            (0..2).any(|side| {
                let [a, m, b] = values.map(|value| SIDES[side] * value);
                let most = SIDES[side] * self.extreme(quantity, side) + self.near[quantity];
                estimate([times[1], times[0], times[2]], [m, a, b])
                    .is_some_and(|estimate| estimate > most)
            })
        };
        (0..self.len()).any(is_within)
    }

    fn may_exceed(&self, quantity: usize) -> bool {
        let (a, b) = (self.start.values[quantity], self.end.values[quantity]);
        let times = [&self.before, &self.start, &self.end].map(Node::time);
        let [t0, t1, t2] = times;
        let watched = &self.watched[quantity];
        // A value above this, times the side's sign, would be an extreme.
        let bound = |side: usize| SIDES[side] * self.extreme(quantity, side) + self.near[quantity];
        if let Some(rate) = watched.rate {
            let rates = [&self.start, &self.end].map(|node| node.row[rate]);
            let side = usize::from(rates[0] > 0.0);
            let sign = SIDES[side];
            let top = tangents([sign * a, sign * b], rates.map(|rate| sign * rate), t2 - t1);
            return top.is_some_and(|top| top > bound(side));
        }
        if self.has_before() {
            let z = self.before.values[quantity];
            let bend =
                ((b - a) * (t1 - t0) - (a - z) * (t2 - t1)) / ((t2 - t1) * (t1 - t0) * (t2 - t0));
            let side = usize::from(bend < 0.0);
            let sign = SIDES[side];
            let rise = 0.25 * bend.abs() * (t2 - t1) * (t2 - t1);
            // Most are far from it.
            let is_far = (sign * a).max(sign * b) + (1.0 + HIGHER) * rise <= bound(side);
            let top = || estimate(times, [sign * z, sign * a, sign * b]);
            return !is_far && top().is_some_and(|top| top > bound(side));
        }
        let rises = |side: usize| {
            (SIDES[side] * a).max(SIDES[side] * b) + FIRST_RISE * (b - a).abs() > bound(side)
        };
        !watched.steady && (0..2).any(rises)
    }

    /// Rows with extremes that no row of `table` has, or is near.
    pub fn rows_beyond(&self, table: &Trajectory) -> Vec<&[f64]> {
        let mut known = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.len()];
        for row in table.rows() {
            for (known, watched) in known.iter_mut().zip(&self.watched) {
                let value = watched.quantity.of(row);
                if value.is_finite() {
                    *known = [known[0].min(value), known[1].max(value)];
                }
            }
        }
        let mut wanted = vec![false; self.kept.len()];
        for ((extremes, known), near) in self.extremes.iter().zip(&known).zip(&self.near) {
            for (side, sign) in SIDES.into_iter().enumerate() {
                if let Extreme {
                    value,
                    row: Some(row),
                    ..
                } = extremes[side]
                {
                    wanted[row] |= sign * value > sign * known[side] + near;
                }
            }
        }
        let wanted = self.kept.iter().zip(&wanted).filter(|(_, wanted)| **wanted);
        wanted.map(|(kept, _)| kept.row.as_slice()).collect()
    }
}

/// A row into a free place.
fn keep(kept: &mut Vec<HeldRow>, free: &mut Vec<usize>, row: &[f64]) -> usize {
    let place = free.pop().unwrap_or_else(|| {
        kept.push(HeldRow::default());
        kept.len() - 1
    });
    kept[place].uses = 0;
    kept[place].row.clear();
    kept[place].row.extend_from_slice(row);
    place
}

/// How large the parabola through three ends in a line may become in the last interval, where its vertex is there or near.
fn estimate([t0, t1, t2]: [f64; 3], [z, a, b]: [f64; 3]) -> Option<f64> {
    let h = t2 - t1;
    let slope = (b - a) / h;
    let bend = ((a - z) / (t1 - t0) - slope) / (t0 - t2);
    // Above the chord by at most this.
    let rise = -0.25 * bend * h * h;
    if bend.is_nan() || rise <= 0.0 {
        return None;
    }
    // From the middle, in parts of the step.
    let vertex = -0.5 * slope / (bend * h);
    if vertex.abs() > 0.5 + ASIDE {
        return None;
    }
    let inside = vertex.clamp(-0.5, 0.5);
    let there = 0.5 * (a + b) + slope * h * inside + rise * (1.0 - 4.0 * inside * inside);
    Some(there.max(a).max(b) + HIGHER * rise)
}

/// Where tangents at both ends of a step meet, where the slope changes from rising to falling: no bend within exceeds it.
fn tangents([a, b]: [f64; 2], [up, down]: [f64; 2], h: f64) -> Option<f64> {
    (up > 0.0 && down < 0.0).then(|| {
        let meet = ((b - a - down * h) / (up - down)).clamp(0.0, h);
        (a + up * meet).max(b - down * (h - meet))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_tells_what_lies_between_the_ends() {
        let f = |t: f64| 5.0 - (t - 1.4) * (t - 1.4);
        let top = estimate([0.0, 1.0, 2.0], [f(0.0), f(1.0), f(2.0)]).expect("within");
        assert!((5.0..5.2).contains(&top), "{top}");
        let rising = [0.0, 1.0, 2.0];
        assert_eq!(estimate(rising, rising), None);
        assert_eq!(
            estimate(rising, [2.0, 1.0, 2.0]),
            None,
            "it has its least there"
        );
        assert_eq!(estimate(rising, [f64::NAN, 1.0, 2.0]), None);
    }

    #[test]
    fn tangents_bound_what_lies_between() {
        let top = tangents([0.0, 0.0], [1.0, -1.0], 1.0).expect("within");
        assert!((top - 0.5).abs() < 1e-15, "{top}");
        assert_eq!(tangents([0.0, 1.0], [1.0, 1.0], 1.0), None);
    }
}
