//! The fastest law of motion along a path: a convex problem.
//!
//! ```text
//! x                 place along the path                            [m or rad]
//! b = ẋ²            square of the speed, straight between nodes     [x²/s²]
//! a = ẍ = b′/2      so constant between nodes
//! minimise          T = Σ 2 Δ/(√b_k + √b_{k+1})                     [s]
//! limits            m a + c b + g ≤ most,   |m a + c b + g| ≤ most  (of two components)
//! ```
//!
//! T is convex in b, and limits are half planes and ellipses in the b of two neighbours (Verscheure, Demeulenaere, Swevers, De
//! Schutter and Diehl, Time-optimal path tracking for robots: a convex optimization approach, IEEE Trans. Autom. Control 54, 2009; the
//! phase plane goes back to Bobrow, Dubowsky and Gibson 1985). They write it with second-order cones for a general solver. Here
//! `interior` solves it for b alone, so that the matrix of a step has three diagonals and a solution costs some thousand operations
//! for each node. From rest b grows from zero in a straight line, which is constant acceleration, so ends at rest are exact.

mod interior;
mod lacking;

/// What is linear in ẍ and ẋ²: m ẍ + c ẋ² + g.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Affine {
    /// m
    pub acceleration: f64,
    /// c
    pub square: f64,
    /// g
    pub rest: f64,
}

impl Affine {
    /// Its value at a square of the speed and an acceleration.
    pub fn at(&self, [b, a]: [f64; 2]) -> f64 {
        self.acceleration * a + self.square * b + self.rest
    }

    /// The opposite.
    #[must_use]
    pub fn negative(&self) -> Affine {
        Affine {
            acceleration: -self.acceleration,
            square: -self.square,
            rest: -self.rest,
        }
    }
}

/// What is limited.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limited {
    /// A number, from above.
    Below(Affine),
    /// The size of two components.
    Within([Affine; 2]),
}

/// A limit at a place of an interval between two nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Number of the interval.
    pub interval: usize,
    /// Part of the interval before the place, 0 to 1.
    pub part: f64,
    /// What is limited.
    pub of: Limited,
    /// The most that is allowed; positive of a size.
    pub most: f64,
    /// What counts as large, positive.
    pub scale: f64,
}

/// A path with its limits.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// Places of the nodes, ascending, at least three.
    pub nodes: &'a [f64],
    /// b at the first and the last node.
    pub ends: [f64; 2],
    /// The limits.
    pub limits: &'a [Limit],
}

/// The fastest law.
#[derive(Debug, Clone, PartialEq)]
pub struct Fastest {
    /// b at the nodes.
    pub squares: Vec<f64>,
    /// T \[s\].
    pub time: f64,
    /// Distance from the dual value, by T \[–\].
    pub gap: f64,
    /// Iterations.
    pub iterations: usize,
    /// −∂T/∂(most by scale) of each limit \[s\].
    pub worth: Vec<f64>,
}

/// Square of the speed and acceleration within an interval, at a part of it.
pub fn motion(nodes: &[f64], squares: &[f64], interval: usize, part: f64) -> [f64; 2] {
    let [from, to] = [squares[interval], squares[interval + 1]];
    let span = nodes[interval + 1] - nodes[interval];
    [from + part * (to - from), (to - from) / (2.0 * span)]
}

/// When each node is reached \[s\].
pub fn times(nodes: &[f64], squares: &[f64]) -> Vec<f64> {
    let mut times = vec![0.0];
    for (x, b) in nodes.windows(2).zip(squares.windows(2)) {
        let span = 2.0 * (x[1] - x[0]) / (b[0].sqrt() + b[1].sqrt());
        times.push(times[times.len() - 1] + span);
    }
    times
}

/// A number u₀ + u₁ b_k + u₂ b_{k+1}, in units in which it is near 1.
type Term = [f64; 3];

/// A limit in units in which unknowns and right sides are near 1.
#[derive(Debug, Clone, Copy)]
struct Row {
    interval: usize,
    of: Terms,
}

#[derive(Debug, Clone, Copy)]
enum Terms {
    /// Such a number, at most zero.
    Below(Term),
    /// Two, of size at most 1.
    Within([Term; 2]),
}

/// A problem in units in which unknowns are near 1.
struct Scaled {
    /// Lengths of the intervals, together 1.
    spans: Vec<f64>,
    ends: [f64; 2],
    rows: Vec<Row>,
    /// Unit of b.
    square: f64,
    /// Unit of T \[s\].
    time: f64,
    /// What b may be about, by node.
    room: Vec<f64>,
}

impl Scaled {
    fn new(problem: &Problem) -> Self {
        let nodes = problem.nodes;
        let length = nodes[nodes.len() - 1] - nodes[0];
        let mut room = vec![f64::INFINITY; nodes.len()];
        for limit in problem.limits {
            let size = |of: &Affine| of.square.abs() + of.acceleration.abs() / (2.0 * length);
            let size = match &limit.of {
                Limited::Below(of) => size(of),
                Limited::Within(of) => size(&of[0]).hypot(size(&of[1])),
            };
            if size > 0.0 {
                for own in &mut room[limit.interval..limit.interval + 2] {
                    *own = own.min(limit.scale / size);
                }
            }
        }
        let finite = room.iter().copied().filter(|own| own.is_finite());
        let square = finite.fold(problem.ends[0].max(problem.ends[1]), f64::max);
        let square = if square > 0.0 { square } else { 1.0 };
        room.iter_mut()
            .for_each(|own| *own = (*own / square).min(1.0));
        let row = |limit: &Limit| {
            let by = square / limit.scale;
            let slope = |of: &Affine| {
                of.acceleration / (2.0 * (nodes[limit.interval + 1] - nodes[limit.interval]))
            };
            let term = |of: &Affine| {
                [
                    of.rest / limit.scale,
                    by * (of.square * (1.0 - limit.part) - slope(of)),
                    by * (of.square * limit.part + slope(of)),
                ]
            };
            let of = match &limit.of {
                Limited::Below(of) => {
                    let [rest, from, to] = term(of);
                    Terms::Below([rest - limit.most / limit.scale, from, to])
                }
                Limited::Within(of) => {
                    let by = limit.scale / limit.most;
                    Terms::Within([0, 1].map(|k| term(&of[k]).map(|value| value * by)))
                }
            };
            Row {
                interval: limit.interval,
                of,
            }
        };
        Scaled {
            spans: nodes.windows(2).map(|x| (x[1] - x[0]) / length).collect(),
            ends: problem.ends.map(|end| end / square),
            rows: problem.limits.iter().map(row).collect(),
            square,
            time: length / square.sqrt(),
            room,
        }
    }
}

impl Problem<'_> {
    /// The fastest law; `None` if there is none, or the limits do not bound the speed.
    pub fn solve(&self) -> Option<Fastest> {
        let scaled = Scaled::new(self);
        let found = interior::solve(&scaled)?;
        let inner = found.inner.iter().map(|b| b * scaled.square);
        let [first, last] = self.ends;
        let squares: Vec<f64> = [first].into_iter().chain(inner).chain([last]).collect();
        let time = *times(self.nodes, &squares).last()?;
        Some(Fastest {
            time,
            gap: found.gap * scaled.time / time,
            iterations: found.iterations,
            worth: found.weights.iter().map(|z| z * scaled.time).collect(),
            squares,
        })
    }

    /// By how much of their scales all limits have to be moved out until some law keeps them, and how much each of them hinders,
    /// together 1; `None` if that can't be found.
    pub fn lacks(&self) -> Option<(f64, Vec<f64>)> {
        lacking::least(&Scaled::new(self))
    }
}

#[cfg(test)]
mod tests;
