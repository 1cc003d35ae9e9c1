//! The course of a guard between two times at which it is known, and where it may be above zero.
//!
//! ```text
//! g(x) = p(x) + e(x)             x from 0 to 1, over the time h between the samples
//! cubic      p by values and rates    e = g⁗/24 x² (1 − x)² h⁴        off by at most 1/16 of that, in the middle
//! straight   p by values              e = g″/2  x (1 − x) h²          off by at most 1/4
//! ```
//!
//! How far it is off is the course's **doubt**. p ± e are polynomials of degree four, which their Bernstein coefficients bound.

use crate::analysis::dynamics::flow::{Least, Sample};

/// How often a course is halved until a part in which a guard may rise above zero is taken for one.
const HALVINGS: usize = 10;
/// Room that is more than any.
const FAR: f64 = 1e100;
/// Bernstein coefficients of what a straight is off by, in parts of the largest.
const STRAIGHT: [f64; 5] = [0.0, 1.0, 4.0 / 3.0, 1.0, 0.0];
/// The same of a cubic.
const CUBIC: [f64; 5] = [0.0, 0.0, 8.0 / 3.0, 0.0, 0.0];

/// A polynomial on [0, 1] by its Bernstein coefficients.
#[derive(Debug, Clone, Copy)]
struct Quartic([f64; 5]);

impl Quartic {
    /// The cubic with these values and slopes at its ends.
    fn cubic([from, to]: [f64; 2], slopes: [f64; 2]) -> Self {
        let (leaves, arrives) = (from + slopes[0] / 3.0, to - slopes[1] / 3.0);
        let next = 0.25 * from + 0.75 * leaves;
        Quartic([
            from,
            next,
            0.5 * (leaves + arrives),
            0.75 * arrives + 0.25 * to,
            to,
        ])
    }

    fn straight([from, to]: [f64; 2]) -> Self {
        Quartic::cubic([from, to], [to - from; 2])
    }

    fn plus(self, factor: f64, other: [f64; 5]) -> Self {
        let mut sum = self;
        let each = sum.0.iter_mut().zip(other);
        each.for_each(|(own, other)| *own += factor * other);
        sum
    }

    fn halves(self) -> [Quartic; 2] {
        let (mut low, mut high) = (self.0, self.0);
        for round in 1..5 {
            for k in (round..5).rev() {
                low[k] = 0.5 * (low[k - 1] + low[k]);
            }
            for k in 0..5 - round {
                high[k] = 0.5 * (high[k] + high[k + 1]);
            }
        }
        [Quartic(low), Quartic(high)]
    }

    fn most(&self) -> f64 {
        self.0.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    fn slopes(&self) -> [f64; 4] {
        [0, 1, 2, 3].map(|k| 4.0 * (self.0[k + 1] - self.0[k]))
    }

    fn steepest(&self) -> f64 {
        self.slopes().into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    /// Value and slope.
    fn at(&self, x: f64) -> [f64; 2] {
        let mut points = self.0;
        for round in 1..4 {
            for k in 0..5 - round {
                points[k] += x * (points[k + 1] - points[k]);
            }
        }
        let step = points[1] - points[0];
        [points[0] + x * step, 4.0 * step]
    }
}

/// How far a course may be off.
#[derive(Debug, Clone, Copy, Default)]
pub struct Doubt {
    /// The value.
    pub value: f64,
    /// The rooms.
    pub rooms: [f64; 2],
    /// Whether the samples at the ends may be off, too.
    pub of_ends: [bool; 2],
}

impl Doubt {
    /// The larger one of each, of the same ends.
    pub fn max(self, other: Doubt) -> Doubt {
        Doubt {
            value: self.value.max(other.value),
            rooms: [0, 1].map(|k| self.rooms[k].max(other.rooms[k])),
            ..self
        }
    }

    /// By a factor.
    pub fn times(self, factor: f64) -> Doubt {
        Doubt {
            value: factor * self.value,
            rooms: self.rooms.map(|room| factor * room),
            ..self
        }
    }

    /// The coefficients of what it is off by, where in the middle it is off so much.
    fn coefficients(&self, inner: [f64; 5]) -> [f64; 5] {
        let [from, to] = self.of_ends.map(f64::from);
        let ends = [from, from, 0.5 * (from + to), to, to];
        [0, 1, 2, 3, 4].map(|k| inner[k] + ends[k])
    }
}

/// A guard between two samples of it.
#[derive(Debug, Clone, Copy)]
pub struct Course {
    value: Quartic,
    /// Both rooms, each at both ends.
    rooms: [[f64; 2]; 2],
    /// The least rise of an event, by the width.
    least: f64,
    /// What its values are rounded by, where that is more than it changes by.
    rounded: f64,
    has_rate: bool,
    width: f64,
}

impl Course {
    /// Of samples that are this far apart, of a guard of which so much makes no event.
    pub fn new([from, to]: [&Sample; 2], least: Least, width: f64) -> Self {
        let mut values = [from.value, to.value];
        let slopes = [from.rate * width, to.rate * width];
        let has_rate = !slopes.iter().any(|slope| slope.is_nan());
        // Where it moves by less than places can tell, the rates tell it.
        let moves = slopes[0].abs().max(slopes[1].abs());
        let is_still = moves.max((values[1] - values[0]).abs()) <= least.change;
        if is_still {
            values[1] = values[0] + 0.5 * (slopes[0] + slopes[1]);
        }
        let rounded = if is_still { least.change } else { 0.0 };
        // One that is not above zero can't be without a rise.
        let least = if from.value > 0.0 {
            least.rate
        } else {
            least.rate.max(0.0)
        };
        Course {
            value: match has_rate {
                true => Quartic::cubic(values, slopes),
                false => Quartic::straight(values),
            },
            rooms: [0, 1].map(|k| [from.rooms[k], to.rooms[k]].map(|room| room.min(FAR))),
            least: least * width,
            rounded,
            has_rate,
            width,
        }
    }

    /// Its value in a part x of it.
    pub fn value_at(&self, x: f64) -> f64 {
        self.value.at(x)[0]
    }

    /// How far it is off by a sample in a part x of it.
    pub fn missed(&self, sample: &Sample, x: f64) -> Doubt {
        let product = x * (1.0 - x);
        let straight = 0.25 / product;
        let rooms = [0, 1].map(|k| {
            let [from, to] = self.rooms[k];
            straight * (sample.rooms[k].min(FAR) - from - x * (to - from)).abs()
        });
        let [value, slope] = self.value.at(x);
        let off = ((sample.value - value).abs() - self.rounded).max(0.0);
        let value = match self.has_rate {
            true => {
                // That of degree five is known by the slopes.
                let slope = (self.width * sample.rate - slope).abs();
                (off + 0.3 * product * slope) / (16.0 * product * product)
            }
            false => straight * off,
        };
        Doubt {
            value,
            rooms,
            ..Doubt::default()
        }
    }

    /// The doubt of a course over so wide a part of it, where its own is known.
    pub fn doubt(&self, own: Doubt, part: f64) -> Doubt {
        let square = part * part;
        let power = if self.has_rate {
            square * square
        } else {
            square
        };
        Doubt {
            value: power * own.value,
            rooms: own.rooms.map(|room| square * room),
            ..own
        }
    }

    /// p − e and p + e.
    fn bounds(&self, doubt: Doubt) -> [Quartic; 2] {
        let off = doubt.coefficients(if self.has_rate { CUBIC } else { STRAIGHT });
        [-doubt.value, doubt.value].map(|factor| self.value.plus(factor, off))
    }

    /// The first part x from which on the guard may be above zero.
    pub fn first(&self, doubt: Doubt) -> Option<f64> {
        let off = doubt.coefficients(STRAIGHT);
        let room = |k: usize| Quartic::straight(self.rooms[k]).plus(doubt.rooms[k], off);
        let [low, high] = self.bounds(doubt);
        first([low, high, room(0), room(1)], self.least, HALVINGS)
    }

    /// Where it is largest, with room, from x on; of a straight, that it is off there is to be measured: in the middle.
    pub fn summit(&self, x: f64) -> f64 {
        if !self.has_rate {
            return 0.5;
        }
        let parts = 1 << 5;
        let places = (0..=parts).map(|part| x + (1.0 - x) * f64::from(part) / f64::from(parts));
        let value = |x: &f64| {
            let rooms = self.rooms.map(|[from, to]| from + x * (to - from));
            self.value.at(*x)[0].min(rooms[0]).min(rooms[1])
        };
        let highest = places.max_by(|a, b| value(a).total_cmp(&value(b)));
        highest.unwrap_or(0.5)
    }

    /// Whether it rises all the way, with room: the guard is above zero from one time on, where it is so at the end.
    pub fn rises(&self, doubt: Doubt) -> bool {
        let mut rooms = self.rooms.iter().zip(doubt.rooms);
        let has_room = rooms.all(|(ends, doubt)| ends.iter().all(|room| *room > 2.0 * doubt));
        let rises = |bound: Quartic| bound.slopes().iter().all(|slope| *slope > 0.0);
        has_room && self.bounds(doubt).into_iter().all(rises)
    }
}

/// The first part of a course, by its bounds and those of its rooms, in which it may come above zero.
fn first(bounds: [Quartic; 4], least: f64, halvings: usize) -> Option<f64> {
    let [low, high, rooms @ ..] = &bounds;
    let is_out = high.most() <= 0.0
        || rooms.iter().any(|room| room.most() <= 0.0)
        || low.steepest().max(high.steepest()) <= least;
    if is_out || halvings == 0 {
        return (!is_out).then_some(0.0);
    }
    let halves = bounds.map(Quartic::halves);
    let half = |index: usize| {
        first(
            halves.map(|halves| halves[index]),
            0.5 * least,
            halvings - 1,
        )
    };
    let early = half(0).map(|x| 0.5 * x);
    early.or_else(|| half(1).map(|x| 0.5 + 0.5 * x))
}
