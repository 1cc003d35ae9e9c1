//! The law of motion: limits at both ends of every interval, and where a number exceeds its limit between them, there, too.

use linkdyn_optimise::fastest::{Affine, Fastest, Limit, Limited, Problem, motion, times};

use super::asked::Stroke;
use super::bounds::{Bound, Of};
use super::coefficients::{Coefficients, Course, quantity};
use crate::Unanswered;

/// Rounds in which limits between nodes are added.
const ROUNDS: usize = 8;
/// By how much a number may exceed its limit between nodes, by the limit \[–\].
const EXCESS: f64 = 1e-7;
/// From here on a limit counts as reached \[–\].
const REACHED: f64 = 1.0 - 1e-6;
/// Squares of the speed so many times the largest are not looked for.
const FAR: f64 = 25.0;
/// Part of a limit's size by which no law misses it, that is round-off \[–\].
const MISSED: f64 = 1e-7;

/// The law on the nodes of the stroke.
pub(super) struct Law {
    /// Places along the stroke, from 0.
    pub nodes: Vec<f64>,
    pub found: Fastest,
    /// Limits of the last problem: the bound of each, and the limit.
    pub limits: Vec<(usize, Limit)>,
    /// How often it was solved.
    pub rounds: usize,
    /// Iterations of all.
    pub iterations: usize,
}

/// Places of coefficients: nodes and middles of intervals.
pub(super) fn places(intervals: usize) -> usize {
    2 * intervals + 1
}

/// What is limited of a bound, with the most that is allowed and its scale.
fn rows(bound: &Bound, course: Course, of: &[Affine]) -> Vec<(Limited, f64, f64)> {
    let [lower, upper] = bound.range;
    let scale = bound.scale();
    match (bound.of, course, of) {
        (Of::Size(_), _, &[x, y]) => vec![(Limited::Within([x, y]), upper, scale)],
        (Of::Speed, _, _) => vec![(Limited::Below(of[0]), upper * upper, upper * upper)],
        (Of::Column(_), Course::Speed, _) => {
            let own = Affine {
                square: of[0].square.abs(),
                ..of[0]
            };
            let end = if of[0].square >= 0.0 {
                upper.max(0.0)
            } else {
                (-lower).max(0.0)
            };
            vec![(Limited::Below(own), end * end, scale * scale)]
        }
        (Of::Column(_) | Of::Acceleration | Of::Size(_), ..) => vec![
            (Limited::Below(of[0]), upper, scale),
            (Limited::Below(of[0].negative()), -lower, scale),
        ],
    }
}

fn limits(
    bound: &Bound,
    course: Course,
    of: &[Affine],
    (interval, part): (usize, f64),
) -> impl Iterator<Item = Limit> {
    let rows = rows(bound, course, of).into_iter();
    rows.map(move |(of, most, scale)| Limit {
        interval,
        part,
        of,
        most,
        scale,
    })
}

/// By how much of its scale a number is beyond its limit; negative within it.
fn excess(limit: &(Limited, f64, f64), at: [f64; 2]) -> f64 {
    let (of, most, scale) = limit;
    let value = match of {
        Limited::Below(of) => of.at(at),
        Limited::Within([x, y]) => x.at(at).hypot(y.at(at)),
    };
    (value - most) / scale
}

/// Accelerations with which a row is kept at a square of the speed, from and to; the wrong way round if there are none.
fn accelerations((of, most, _): &(Limited, f64, f64), b: f64) -> [f64; 2] {
    let all = [f64::NEG_INFINITY, f64::INFINITY];
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    match of {
        Limited::Below(of) => {
            let end = (most - of.at([b, 0.0])) / of.acceleration;
            match of.acceleration {
                m if m > 0.0 => [f64::NEG_INFINITY, end],
                m if m < 0.0 => [end, f64::INFINITY],
                _ if of.at([b, 0.0]) <= *most => all,
                _ => none,
            }
        }
        Limited::Within([x, y]) => {
            // |m a + r|² = most²
            let [p, q] = [x, y].map(|of| of.at([b, 0.0]));
            let [m, n] = [x, y].map(|of| of.acceleration);
            let (square, half) = (m * m + n * n, m * p + n * q);
            let rest = p * p + q * q - most * most;
            let under = half * half - square * rest;
            match square > 0.0 {
                true if under >= 0.0 => {
                    [-1.0, 1.0].map(|sign| (sign * under.sqrt() - half) / square)
                }
                false if rest <= 0.0 => all,
                true | false => none,
            }
        }
    }
}

/// Where the parabola through three values, evenly spaced from 0 to 1, is greatest within.
fn greatest([first, middle, last]: [f64; 3]) -> (f64, f64) {
    let bend = 2.0 * (first - 2.0 * middle + last);
    let slope = 4.0 * middle - 3.0 * first - last;
    let place = (-slope / (2.0 * bend)).clamp(0.0, 1.0);
    match bend < 0.0 {
        true => (place, first + place * (slope + place * bend)),
        false => (if first > last { 0.0 } else { 1.0 }, first.max(last)),
    }
}

impl Law {
    /// The fastest law.
    pub fn new(stroke: &Stroke, bounds: &[Bound], all: &Coefficients) -> Result<Law, Unanswered> {
        let (count, length) = (stroke.intervals, (stroke.to - stroke.from).abs());
        let nodes: Vec<f64> = (0..=count)
            .map(|k| length * k as f64 / count as f64)
            .collect();
        let mut own = Vec::new();
        for interval in 0..count {
            for (k, bound) in bounds.iter().enumerate() {
                for end in 0..2 {
                    let of = all.at(k, 2 * (interval + end));
                    let place = (interval, end as f64);
                    own.extend(limits(bound, all.courses[k], of, place).map(|limit| (k, limit)));
                }
            }
        }
        let ends = stroke.ends.map(|speed| speed * speed);
        let mut iterations = 0;
        for rounds in 1..=ROUNDS {
            let list: Vec<Limit> = own.iter().map(|(_, limit)| *limit).collect();
            let problem = Problem {
                nodes: &nodes,
                ends,
                limits: &list,
            };
            let Some(found) = problem.solve() else {
                return Err(none(bounds, &own, &problem));
            };
            iterations += found.iterations;
            let more = between(&nodes, &found, bounds, all);
            if more.is_empty() || rounds == ROUNDS {
                return Ok(Law {
                    nodes,
                    found,
                    limits: own,
                    rounds,
                    iterations,
                });
            }
            own.extend(more);
        }
        Err(Unanswered::Failed("no law was found".into()))
    }

    /// Part of its limit that each bound reaches in an interval, at its ends and in its middle; and its worth.
    pub fn reached(
        &self,
        bounds: &[Bound],
        all: &Coefficients,
        interval: usize,
        bound: usize,
    ) -> f64 {
        let places = (0..3).map(|middle| {
            let at = motion(
                &self.nodes,
                &self.found.squares,
                interval,
                0.5 * middle as f64,
            );
            let of = all.at(bound, 2 * interval + middle);
            let rows = rows(&bounds[bound], all.courses[bound], of);
            rows.iter()
                .map(|row| 1.0 + excess(row, at))
                .fold(f64::NEG_INFINITY, f64::max)
        });
        places.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The bound that an interval has reached; the one that comes nearest to its limit.
    pub fn binding(&self, bounds: &[Bound], all: &Coefficients, interval: usize) -> Option<usize> {
        let parts = (0..bounds.len()).map(|k| (k, self.reached(bounds, all, interval, k)));
        let nearest = parts.max_by(|a, b| a.1.total_cmp(&b.1))?;
        (nearest.1 >= REACHED).then_some(nearest.0)
    }

    /// Times of the nodes \[s\], squares of the speed there, and accelerations of the intervals that begin there; the last node has that
    /// of the last interval.
    pub fn instants(&self) -> impl Iterator<Item = (f64, [f64; 2])> {
        let last = self.nodes.len() - 2;
        let times = times(&self.nodes, &self.found.squares)
            .into_iter()
            .enumerate();
        times.map(move |(k, time)| {
            let part = if k > last { 1.0 } else { 0.0 };
            (
                time,
                motion(&self.nodes, &self.found.squares, k.min(last), part),
            )
        })
    }

    /// The greatest speed at a node with which some acceleration keeps all limits: the limit curve of the phase plane. `None` if there
    /// is none that is near.
    pub fn top(&self, bounds: &[Bound], all: &Coefficients, node: usize) -> Option<f64> {
        let rows = bounds
            .iter()
            .enumerate()
            .flat_map(|(k, bound)| rows(bound, all.courses[k], all.at(k, 2 * node)));
        let rows: Vec<(Limited, f64, f64)> = rows.collect();
        let largest = self
            .found
            .squares
            .iter()
            .fold(0.0, |most: f64, b| most.max(*b));
        let is_kept = |b: f64| {
            let ranges = rows.iter().map(|row| accelerations(row, b));
            let [low, high] = ranges
                .fold([f64::NEG_INFINITY, f64::INFINITY], |own, [low, high]| {
                    [own[0].max(low), own[1].min(high)]
                });
            low <= high
        };
        let (mut low, mut high) = (self.found.squares[node] * (1.0 - 1e-6), FAR * largest);
        if is_kept(high) {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if is_kept(middle) {
                low = middle
            } else {
                high = middle
            }
        }
        Some(low.sqrt())
    }

    /// What a bound that is wider by a small part of its size saves, by that part \[s\].
    pub fn worth(&self, bound: usize) -> f64 {
        let limits = self.limits.iter().zip(&self.found.worth);
        limits
            .filter(|((own, _), _)| *own == bound)
            .map(|(_, worth)| worth)
            .sum()
    }
}

/// Limits where the law exceeds one between nodes.
fn between(
    nodes: &[f64],
    found: &Fastest,
    bounds: &[Bound],
    all: &Coefficients,
) -> Vec<(usize, Limit)> {
    let mut more = Vec::new();
    for interval in 0..nodes.len() - 1 {
        for (k, bound) in bounds.iter().enumerate() {
            let course = all.courses[k];
            let [first, middle, last] = [0, 1, 2].map(|middle| {
                let at = motion(nodes, &found.squares, interval, 0.5 * middle as f64);
                let rows = rows(bound, course, all.at(k, 2 * interval + middle));
                rows.iter().map(|row| excess(row, at)).collect::<Vec<f64>>()
            });
            let values = first.iter().zip(&middle).zip(&last).enumerate();
            for (row, ((first, middle), last)) in values {
                let (part, most) = greatest([*first, *middle, *last]);
                if most > EXCESS && part > 0.0 && part < 1.0 {
                    let of = all.between(k, 2 * interval, part);
                    let new = limits(bound, course, &of, (interval, part)).nth(row);
                    more.extend(new.map(|limit| (k, limit)));
                }
            }
        }
    }
    more
}

/// The mechanism stands at ends at rest: what is limited must be within its limits there without acceleration.
pub(super) fn stands(
    stroke: &Stroke,
    bounds: &[Bound],
    all: &Coefficients,
    place: impl Fn(f64) -> String,
) -> Result<(), Unanswered> {
    let last = 2 * stroke.intervals;
    for (end, at, speed) in [
        (0, stroke.from, stroke.ends[0]),
        (last, stroke.to, stroke.ends[1]),
    ] {
        for (k, bound) in bounds.iter().enumerate() {
            let of = all.at(k, end);
            let motion = [speed * speed, 0.0];
            let rows = rows(bound, all.courses[k], of);
            if rows.iter().all(|row| excess(row, motion) <= MISSED) {
                continue;
            }
            let value = match of {
                [x, y] => x.at(motion).hypot(y.at(motion)),
                _ => of[0].at(motion),
            };
            let how = if speed == 0.0 {
                "at rest"
            } else {
                "without acceleration"
            };
            return Err(Unanswered::Failed(format!(
                "{how} at {} {} is {}, beyond its limit of {}: the motion can't have an end there",
                place(at),
                bound.name,
                quantity(value, bound.unit, 4),
                quantity(nearest_end(bound, value), bound.unit, 4),
            )));
        }
    }
    Ok(())
}

fn nearest_end(bound: &Bound, value: f64) -> f64 {
    let [lower, upper] = bound.range;
    if value > upper { upper } else { lower }
}

/// Why there is no law.
fn none(bounds: &[Bound], own: &[(usize, Limit)], problem: &Problem) -> Unanswered {
    match problem.lacks() {
        Some((wider, weights)) if wider > MISSED => {
            let mut sums = vec![0.0; bounds.len()];
            for ((bound, _), weight) in own.iter().zip(weights) {
                sums[*bound] += weight;
            }
            let most = bounds.iter().zip(sums).max_by(|a, b| a.1.total_cmp(&b.1));
            Unanswered::Failed(format!(
                "no motion along the stroke keeps all limits: they would have to be wider by {} %; what hinders most is {}",
                crate::text::number(100.0 * wider, 3),
                most.map_or("", |(bound, _)| &bound.name),
            ))
        }
        Some(_) | None => Unanswered::Failed(
            "the limits do not bound the speed, so there is no fastest motion; add --speed, or a limit on an effort of what has mass".into(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found() {
        let of = |f: fn(f64) -> f64| greatest([0.0, 0.5, 1.0].map(f));
        let (place, top) = of(|x| 1.0 - 3.0 * (x - 0.3) * (x - 0.3));
        assert!((place - 0.3).abs() < 1e-15 && (top - 1.0).abs() < 1e-15);
        assert_eq!(of(|x| 2.0 * x), (1.0, 2.0));
        assert_eq!(of(|x| 2.0 - x), (0.0, 2.0));
        assert_eq!(of(|x| x * x - x), (1.0, 0.0));
    }
}
