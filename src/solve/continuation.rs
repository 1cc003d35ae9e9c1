//! The path of a driven mechanism: q(s), followed branch-safely over a range of its parameter s.
//!
//! s is the driver's value where there is one driver (then the path does not depend on the motion in time at all), else
//! time. From node to node the step is a prediction by the quintic through the last two nodes (error h⁶ q⁽⁶⁾/90) and a
//! Newton correction; it is accepted only if the prediction was good, Newton contracted fast and the tangent is the
//! predicted one, so that by the Newton–Kantorovich theorem the solution found is the one the prediction belongs to. The
//! nodes are the path's own: nobody who asks for values can move them, so the branch does not depend on the outputs.
//! (Allgower and Georg, Introduction to Numerical Continuation Methods, 2003, ch. 6.)
//!
//! A **change point** (J loses rank, motion goes on) is stepped over by the same prediction, found by the sign of det J or
//! of the test function 1/(rᵀ J⁻¹ l) on both sides, located by interpolating that function through regular points, and
//! bridged: near it q, q′, q″ come from an osculating polynomial through regular points on both sides, for there round-off
//! grows as 1/δ, 1/δ², 1/δ³. A **dead centre** (s turns back) is where steps shrink to nothing; it is located as the
//! root of ds/dp with the arc direction p as parameter, where the bordered matrix is regular.

use super::driven::{Driven, Failure};
use super::hermite::{Node, Osculating, interpolate, quintic};
use super::lu::SparseLu;
use super::order::ColumnOrder;
use super::pattern::{Pattern, square};
use crate::math::dot;
use crate::system::{Inputs, System};
use std::f64::consts::TAU;

/// What the path's parameter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// The value of the only driver [rad or m].
    DriverValue,
    /// Time [s].
    Time,
    /// The value of the only pin [rad or m], drivers standing still.
    Pin,
}

impl Parameter {
    /// One driver: its value; several or none: time.
    pub fn of(system: &System) -> Self {
        if system.drivers.len() == 1 { Parameter::DriverValue } else { Parameter::Time }
    }

    /// Inputs at `s`, derivatives with respect to s.
    fn set(self, driven: &mut Driven, s: f64, inputs: &mut Inputs) {
        match self {
            Parameter::DriverValue => inputs.drive[0] = [s, 1.0, 0.0],
            Parameter::Time => inputs.set_time(driven.system, s),
            Parameter::Pin => driven.pins[0].jet = [s, 1.0, 0.0],
        }
    }

    /// Prediction error accepted, in rad or mechanism sizes: far below any distance of branches but at their crossings.
    /// Where an integrator asks for values at its own points, interpolation must do without a second Newton step.
    fn prediction(self) -> f64 {
        match self {
            Parameter::DriverValue | Parameter::Time => 1e-6,
            Parameter::Pin => 1e-7,
        }
    }
}

/// Kinds of singular positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SingularKind {
    /// Constraints lose rank, motion goes on.
    ChangePoint,
    /// The driver turns back.
    DeadCentre,
}

/// A located singular position.
#[derive(Debug, Clone, PartialEq)]
pub struct SingularPosition {
    pub kind: SingularKind,
    pub s: f64,
    /// Left null vector over all rows (m): the self-stress whose multipliers have no bound there.
    pub self_stress: Vec<f64>,
}

/// How a path ended on one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// The range is covered.
    Reached,
    /// A dead centre at s.
    DeadCentre { s: f64 },
    /// No step is small enough at s, and it is no dead centre.
    Stuck { s: f64 },
    /// Somebody asked to stop.
    Interrupted,
}

/// Newton's second step by its first at most: Kantorovich's constant stays far below ½.
const CONTRACTION: f64 = 0.1;
/// Predicted tangent against the true one, times the step, by the prediction error: for the quintic it is about 6.
const TANGENT: f64 = 100.0;
/// Largest turn of a body (or move, in sizes) in one step: keeps sign tests between nodes meaningful.
const LARGEST_MOVE: f64 = 0.3;
/// A step this much smaller than the largest taken means that the path can't go on.
const SHORTEST_STEP: f64 = 1e-9;
/// Steps taken beyond the range, to see a singular position that lies just outside.
const BEYOND: usize = 3;
/// Inverse iterations for null vectors from nothing: they are wanted to a few percent.
const FIRST_ITERATIONS: usize = 3;
/// Half width of the window around a change point, in steps of the path there.
const WINDOW: f64 = 2.0;
/// Regular points of a window on each side, in half widths; within the first one the polynomial is used.
const WINDOW_NODES: [f64; 3] = [0.4, 0.7, 1.0];
/// Regular points for locating, on each side, in half widths.
const TEST_NODES: [f64; 4] = [0.4, 0.6, 0.8, 1.0];
/// Largest accepted difference of a window's polynomial from the constraints' solution [rad or sizes].
const WINDOW_ERROR: f64 = 1e-12;
/// Smallest singular value (of the scaled Jacobian) at a located position, by that at the window's edge, to count.
const VANISHES: f64 = 1e-6;

/// Distance from a change point, in half widths, at which its self-stress is read off.
const BESIDE: f64 = 1e-5;

/// Half a turn and a little more: how far a path must be followed to both sides to know whether it comes round.
pub const HALF_TURN: f64 = 1.05 * std::f64::consts::PI;
/// A turn that misses the position by less than this (rad, sizes) closes the path: round-off of its prediction.
const CLOSES: f64 = 1e-7;
/// More turns than anybody reads the events of.
const MOST_TURNS: i64 = 1000;

/// Near a change point: the smooth branch.
#[derive(Debug, Clone)]
pub struct Window {
    pub s: f64,
    /// Within this distance the polynomial is used.
    pub radius: f64,
    /// Half width of the data.
    pub width: f64,
    branch: Osculating,
}

/// The path: nodes in ascending s.
pub struct Path {
    pub parameter: Parameter,
    nodes: Vec<Node>,
    windows: Vec<Window>,
    /// Singular positions on the stretch that was followed, by s.
    singular: Vec<SingularPosition>,
    /// Where the path repeats itself: centre of the stretch that stands for all, and what a turn adds to q (n).
    turn: Option<(f64, Vec<f64>)>,
    pub low: End,
    pub high: End,
    pub steps: u64,
    pub rejected: u64,
}

/// Where a value of the path comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// The guess is good to the prediction error; correct it.
    Regular,
    /// On the smooth branch across a change point, at this distance; do not correct it.
    Bridged { index: usize, distance: f64 },
}

/// A step of the march with the signs that tell singular positions.
struct Mark {
    node: Node,
    /// A singular position lies between this node and the one before.
    crossing: bool,
}

/// Follows the path from (s, q) over [low, high]; what the parameter does not set is as in `inputs`.
///
/// `stop` is asked now and then whether to give up.
///
/// # Errors
/// When the start itself is singular or does not satisfy the constraints.
pub fn follow(
    driven: &mut Driven,
    (parameter, inputs): (Parameter, Inputs),
    start: (f64, &[f64]),
    range: (f64, f64),
    stop: &dyn Fn() -> bool,
) -> Result<Path, Failure> {
    let mut walker = Walker { inputs, parameter, driven, stop, steps: 0, rejected: 0 };
    let mut first = walker.node(start.0, start.1.to_vec())?.0;
    first.s = start.0;
    // A mechanism without moving inputs has a path of one point.
    let still = walker.driven.system.drivers.iter().all(|d| d.law.is_constant()) && range.0 == range.1;
    let (mut up, high) =
        if still { (Vec::new(), End::Reached) } else { walker.march(&first, range.1.max(start.0), 1.0) };
    let (down, low) = if range.0 < start.0 { walker.march(&first, range.0, -1.0) } else { (Vec::new(), End::Reached) };
    // Ascending: the nodes below, the start, the nodes above. A crossing mark belongs to the gap before its node.
    let mut nodes = Vec::with_capacity(up.len() + down.len() + 1);
    let mut crossings = Vec::new();
    let below = down.len();
    for (k, mark) in down.into_iter().rev().enumerate() {
        if mark.crossing {
            crossings.push(k);
        }
        nodes.push(mark.node);
    }
    nodes.push(first);
    for (k, mark) in up.drain(..).enumerate() {
        if mark.crossing {
            crossings.push(below + k);
        }
        nodes.push(mark.node);
    }
    let mut path = Path {
        parameter,
        nodes,
        windows: Vec::new(),
        singular: Vec::new(),
        turn: None,
        low,
        high,
        steps: walker.steps,
        rejected: walker.rejected,
    };
    for end in [low, high] {
        if let End::DeadCentre { s: dead } = end {
            path.singular.push(SingularPosition { kind: SingularKind::DeadCentre, s: dead, self_stress: Vec::new() });
        }
    }
    for gap in crossings {
        path.bridge(&mut walker, gap);
    }
    path.singular.sort_by(|a, b| a.s.total_cmp(&b.s));
    path.windows.sort_by(|a, b| a.s.total_cmp(&b.s));
    Ok(path)
}

struct Walker<'a, 's> {
    driven: &'a mut Driven<'s>,
    inputs: Inputs,
    parameter: Parameter,
    stop: &'a dyn Fn() -> bool,
    steps: u64,
    rejected: u64,
}

/// Sign of the determinant and null vectors at a node, for the independent rows chosen there.
struct Condition {
    sign: f64,
    right: Vec<f64>,
    left: Vec<f64>,
    test: f64,
}

impl Walker<'_, '_> {
    fn set(&mut self, s: f64) {
        self.parameter.set(self.driven, s, &mut self.inputs);
    }

    /// Corrects a guess at `s` and differentiates there.
    fn node(&mut self, s: f64, mut q: Vec<f64>) -> Result<(Node, super::driven::Correction), Failure> {
        self.set(s);
        let correction = self.driven.correct(&mut q, &self.inputs)?;
        self.driven.factor(&self.inputs)?;
        let n = q.len();
        let (mut d, mut dd) = (vec![0.0; n], vec![0.0; n]);
        self.driven.velocity(&self.inputs, &mut d);
        self.driven.acceleration(&self.inputs, &mut dd);
        if !(d.iter().chain(&dd).all(|x| x.is_finite())) {
            return Err(Failure::Singular);
        }
        Ok((Node { s, q, d, dd }, correction))
    }

    /// Condition at the last factors; the one of the node before is a good start where the rows are the same.
    fn condition(&mut self, before: Option<Condition>) -> Condition {
        let n = self.driven.system.n();
        let (iterations, mut right, mut left) = match before.filter(|_| !self.driven.is_redundant()) {
            Some(before) => (1, before.right, before.left),
            None => (FIRST_ITERATIONS, vec![1.0; n], vec![1.0; n]),
        };
        self.driven.smallest_singular(iterations, &mut right, &mut left);
        let test = self.driven.test_function(&right, &left);
        Condition { sign: self.driven.determinant_sign(), right, left, test }
    }

    /// Steps from `start` to `target` and a little beyond.
    fn march(&mut self, start: &Node, target: f64, direction: f64) -> (Vec<Mark>, End) {
        let system = self.driven.system;
        let parameter = self.parameter;
        let prediction = parameter.prediction();
        let mut marks: Vec<Mark> = Vec::new();
        let mut current = start.clone();
        let mut previous: Option<Node> = None;
        // The factors must be those of the start.
        if self.node(start.s, start.q.clone()).is_err() {
            return (marks, End::Stuck { s: start.s });
        }
        let mut condition = self.condition(None);
        let speed = system.scaled_norm(&start.d);
        let span = (target - start.s).abs();
        let cap = |d: &[f64]| {
            let by_move = LARGEST_MOVE / system.scaled_norm(d);
            match parameter {
                Parameter::DriverValue | Parameter::Pin => by_move,
                Parameter::Time => by_move.min(span.max(f64::MIN_POSITIVE) / 20.0),
            }
        };
        let mut h = cap(&start.d).min(0.02 / speed);
        if !h.is_finite() || h <= 0.0 {
            h = (span / 100.0).max(f64::MIN_POSITIVE);
        }
        let mut largest = h;
        let mut beyond = 0;
        let mut q = vec![0.0; system.n()];
        let mut d = vec![0.0; system.n()];
        loop {
            let covered = (current.s - target) * direction >= 0.0;
            if covered && beyond >= BEYOND {
                return (marks, End::Reached);
            }
            if (self.stop)() {
                return (marks, End::Interrupted);
            }
            if h < SHORTEST_STEP * largest {
                if covered {
                    return (marks, End::Reached);
                }
                let end = self.dead_centre(&current, previous.as_ref(), direction);
                return (marks, end.map_or(End::Stuck { s: current.s }, |s| End::DeadCentre { s }));
            }
            let s = current.s + direction * h;
            match &previous {
                Some(before) => quintic(before, &current, s, &mut q, Some(&mut d)),
                None => {
                    let step = s - current.s;
                    for k in 0..q.len() {
                        q[k] = current.q[k] + step * (current.d[k] + 0.5 * step * current.dd[k]);
                        d[k] = current.d[k] + step * current.dd[k];
                    }
                }
            }
            let outcome = self.node(s, q.clone());
            let accepted = outcome.ok().filter(|(node, correction)| {
                let off: Vec<f64> = node.d.iter().zip(&d).map(|(a, b)| (a - b) * h).collect();
                correction.first_step <= prediction
                    && correction.contraction <= CONTRACTION
                    && system.scaled_norm(&off) <= TANGENT * prediction
            });
            let Some((node, correction)) = accepted else {
                self.rejected += 1;
                h *= 0.5;
                continue;
            };
            self.steps += 1;
            // Signs under the rows chosen at the node before, then rows chosen anew.
            let sign = self.driven.determinant_sign();
            let test = self.driven.test_function(&condition.right, &condition.left);
            let crossing = sign != condition.sign || (test < 0.0) != (condition.test < 0.0);
            if self.driven.is_redundant() && self.driven.reselect(&self.inputs).is_err() {
                // Rank is lost right here: land elsewhere.
                self.rejected += 1;
                h *= 0.7;
                continue;
            }
            condition = self.condition(Some(condition));
            largest = largest.max(h);
            let order = if previous.is_some() { 6.0 } else { 3.0 };
            let grow = 0.8 * (prediction / correction.first_step.max(1e-30)).powf(1.0 / order);
            h = (h * grow.clamp(0.3, 2.0)).min(cap(&node.d));
            if covered {
                beyond += 1;
            }
            marks.push(Mark { node: node.clone(), crossing });
            previous = Some(std::mem::replace(&mut current, node));
        }
    }

    /// Root of ds/dp near the end of a path, p the direction in which the position runs off there.
    fn dead_centre(&mut self, last: &Node, before: Option<&Node>, direction: f64) -> Option<f64> {
        let system = self.driven.system;
        // With a pin the path is only wanted as far as the pin is good.
        let before = before.filter(|_| self.parameter != Parameter::Pin)?;
        let scaled =
            |x: &[f64]| -> Vec<f64> { x.iter().enumerate().map(|(k, x)| x / system.column_scale(k)).collect() };
        let mut border = scaled(&last.d);
        let length = dot(&border, &border).sqrt() * direction;
        border.iter_mut().for_each(|b| *b /= length);
        let mut arc = Arc::new(self, border, last);
        // Secant on ds/dp from the last two nodes.
        let offset: Vec<f64> = before.q.iter().zip(&last.q).map(|(a, b)| a - b).collect();
        let mut p0 = dot(&arc.border, &scaled(&offset));
        let mut g0 = direction / dot(&arc.border, &scaled(&before.d)).abs();
        let (mut p1, mut g1) = (0.0, direction / length.abs());
        let (mut q, mut s) = (last.q.clone(), last.s);
        for _ in 0..60 {
            let step = -g1 * (p1 - p0) / (g1 - g0);
            let limit = 4.0 * (p1 - p0).abs().max(1e-9);
            let step = if step.is_finite() { step.clamp(-limit, limit) } else { limit };
            (p0, g0) = (p1, g1);
            p1 += step;
            g1 = arc.solve(p1, &mut q, &mut s)?;
            if (s - last.s).abs() > 1e-3 * (1.0 + last.s.abs()) {
                return None;
            }
            if g1.abs() <= 1e-11 * (1.0 + g0.abs()) || step.abs() <= 1e-13 {
                return (g1.abs() < 1e-6 * (direction / length).abs().max(1.0)).then_some(s);
            }
        }
        None
    }
}

/// The path with p = borderᵀ (q̃ − q̃₀) as its parameter: bordered Newton in (q̃, s).
struct Arc<'a, 'b, 's> {
    walker: &'a mut Walker<'b, 's>,
    border: Vec<f64>,
    origin: Vec<f64>,
    entries: Vec<usize>,
    slots: Vec<u32>,
    pattern: Pattern,
    lu: SparseLu,
}

impl<'a, 'b, 's> Arc<'a, 'b, 's> {
    fn new(walker: &'a mut Walker<'b, 's>, border: Vec<f64>, last: &Node) -> Self {
        let system = walker.driven.system;
        let n = system.n();
        let active = walker.driven.active_rows();
        let mut places = Vec::new();
        let mut entries = Vec::new();
        for (k, entry) in system.entries.iter().enumerate() {
            if let (Some(column), Ok(row)) = (entry.column, active.binary_search(&(entry.row as usize))) {
                places.push((row, column as usize));
                entries.push(k);
            }
        }
        places.extend((0..n).map(|row| (row, n)));
        places.extend((0..n).map(|column| (n, column)));
        let (pattern, slots) = square(n + 1, &places);
        let lu = SparseLu::new(pattern.clone(), ColumnOrder::amd(&pattern));
        Arc { walker, border, origin: last.q.clone(), entries, slots, pattern, lu }
    }

    /// Solves for (q, s) at `p` from the guess in them; returns ds/dp.
    fn solve(&mut self, p: f64, q: &mut [f64], s: &mut f64) -> Option<f64> {
        let system = self.walker.driven.system;
        let (n, m) = (system.n(), system.m());
        let active = self.walker.driven.active_rows().to_vec();
        let mut rate = vec![0.0; m];
        let mut values = vec![0.0; self.pattern.entries()];
        for iteration in 0..30 {
            self.walker.set(*s);
            let Walker { driven, inputs, .. } = &mut *self.walker;
            let evaluation = &mut driven.evaluation;
            evaluation.set_position(q);
            evaluation.eval_phi(system, inputs);
            evaluation.eval_jacobian(system, inputs);
            evaluation.eval_rate(system, inputs, &mut rate);
            let entry_values = self.entries.iter().map(|&k| {
                let entry = system.entries[k];
                let column = entry.column.unwrap_or(0) as usize;
                evaluation.jacobian[k] * system.column_scale(column) / system.row_scale(entry.row as usize)
            });
            let last_column = active.iter().map(|&row| rate[row] / system.row_scale(row));
            let all = entry_values.chain(last_column).chain(self.border.iter().copied());
            for (&slot, value) in self.slots.iter().zip(all) {
                values[slot as usize] = value;
            }
            self.lu.factor(&values).ok()?;
            let place: f64 = (0..n).map(|k| self.border[k] * (q[k] - self.origin[k]) / system.column_scale(k)).sum();
            let mut step: Vec<f64> =
                active.iter().map(|&row| -evaluation.phi[row] / system.row_scale(row)).chain([p - place]).collect();
            self.lu.solve(&mut step);
            for k in 0..n {
                q[k] += step[k] * system.column_scale(k);
            }
            *s += step[n];
            if iteration > 0 && crate::math::max_abs(&step) < 1e-10 {
                let mut tangent = vec![0.0; n + 1];
                tangent[n] = 1.0;
                self.lu.solve(&mut tangent);
                return Some(tangent[n]);
            }
        }
        None
    }
}

impl Path {
    /// q, and q′, q″ on a bridged stretch, at `s`; none outside what the path covers.
    pub fn guess(&self, s: f64, q: &mut [f64], d: &mut [f64], dd: &mut [f64]) -> Option<Source> {
        let Some((centre, shift)) = &self.turn else { return self.guess_followed(s, q, d, dd) };
        let turns = ((s - centre) / TAU).round();
        let source = self.guess_followed(s - turns * TAU, q, d, dd)?;
        q.iter_mut().zip(shift).for_each(|(q, shift)| *q += turns * shift);
        Some(source)
    }

    /// Takes the stretch of a turn around `centre` for all turns, if the parameter is an angle that comes round: after a
    /// whole turn every body is back in its place. Whether it is so.
    pub fn close_turn(&mut self, system: &System, centre: f64) -> bool {
        let n = system.n();
        let (mut from, mut to) = (vec![0.0; n], vec![0.0; n]);
        let (mut d, mut dd) = (vec![0.0; n], vec![0.0; n]);
        let ends = [(centre - 0.5 * TAU, &mut from), (centre + 0.5 * TAU, &mut to)];
        if ends.into_iter().any(|(s, q)| self.guess_followed(s, q, &mut d, &mut dd).is_none()) {
            return false;
        }
        let mut shift = Vec::with_capacity(n);
        for (column, (to, from)) in to.iter().zip(&from).enumerate() {
            let whole = if column % 3 == 2 { ((to - from) / TAU).round() * TAU } else { 0.0 };
            if ((to - from - whole) / system.column_scale(column)).abs() > CLOSES {
                return false;
            }
            shift.push(whole);
        }
        self.turn = Some((centre, shift));
        true
    }

    /// Singular positions in [low, high], by s; of a path that repeats itself, those of every turn.
    pub fn singular_between(&self, low: f64, high: f64) -> Vec<SingularPosition> {
        let mut found = Vec::new();
        for position in &self.singular {
            let turns = match &self.turn {
                None => 0..=0,
                Some((centre, _)) if (position.s - centre).abs() > 0.5 * TAU => continue,
                Some(_) => {
                    let (first, last) = (((low - position.s) / TAU).ceil(), ((high - position.s) / TAU).floor());
                    first as i64..=(last as i64).min(first as i64 + MOST_TURNS)
                }
            };
            for turn in turns {
                let s = position.s + turn as f64 * TAU;
                if s >= low && s <= high {
                    found.push(SingularPosition { s, ..position.clone() });
                }
            }
        }
        found.sort_by(|a, b| a.s.total_cmp(&b.s));
        found
    }

    /// The self-stress of the change point that a window bridges.
    pub fn self_stress(&self, window: usize) -> &[f64] {
        let s = self.windows[window].s;
        let nearest = self.singular.iter().min_by(|a, b| (a.s - s).abs().total_cmp(&(b.s - s).abs()));
        nearest.map_or(&[], |position| &position.self_stress)
    }

    fn guess_followed(&self, s: f64, q: &mut [f64], d: &mut [f64], dd: &mut [f64]) -> Option<Source> {
        for (index, window) in self.windows.iter().enumerate() {
            let distance = s - window.s;
            if distance.abs() <= window.radius {
                window.branch.eval(s, q, d, dd);
                return Some(Source::Bridged { index, distance });
            }
        }
        self.regular(s, q).then_some(Source::Regular)
    }

    /// The quintic between the neighbouring nodes.
    fn regular(&self, s: f64, q: &mut [f64]) -> bool {
        if self.nodes.len() == 1 {
            q.copy_from_slice(&self.nodes[0].q);
            return s == self.nodes[0].s;
        }
        let (low, high) = self.covered();
        if s < low || s > high {
            return false;
        }
        let k = self.nodes.partition_point(|node| node.s <= s).clamp(1, self.nodes.len() - 1);
        quintic(&self.nodes[k - 1], &self.nodes[k], s, q, None);
        true
    }

    /// The stretch that was followed.
    pub fn covered(&self) -> (f64, f64) {
        (self.nodes[0].s, self.nodes[self.nodes.len() - 1].s)
    }

    /// The windows around change points.
    pub fn windows(&self) -> &[Window] {
        &self.windows
    }

    /// Locates the change point in the gap after node `gap` and builds its window; a sign that proves to be no loss of
    /// rank (a pole of the test function) is passed over.
    fn bridge(&mut self, walker: &mut Walker, gap: usize) {
        let (a, b) = (self.nodes[gap].s, self.nodes[gap + 1].s);
        let (low, high) = self.covered();
        let around = |k: usize| self.nodes[k.min(self.nodes.len() - 1)].s;
        let step = (b - a).max(around(gap + 2) - b).max(a - around(gap.saturating_sub(1)));
        let width = WINDOW * step;
        let mut centre = 0.5 * (a + b);
        // One choice of rows for the whole window, so that the test function is one function.
        walker.set(b);
        if walker.driven.prepare(&self.nodes[gap + 1].q, &walker.inputs).is_err() {
            return;
        }
        // Vectors of the test function: the null vectors seen from one side.
        let Some(vectors) = self.null_vectors(walker, b) else { return };
        let mut edge = 0.0_f64;
        for (pass, width) in [width, 0.25 * width, 0.0625 * width].into_iter().enumerate() {
            let mut x = Vec::new();
            let mut f = Vec::new();
            for side in [-1.0, 1.0] {
                for node in TEST_NODES {
                    let s = centre + side * node * width;
                    if s < low || s > high {
                        continue;
                    }
                    if let Some(value) = self.test_at(walker, s, &vectors) {
                        x.push(s);
                        f.push(value);
                    }
                }
            }
            if x.len() < 4 {
                break;
            }
            if pass == 0 {
                edge = crate::math::max_abs(&f);
            }
            let root = root_of(&x, &f, centre, width);
            match root {
                Some(root) if root >= a - 0.01 * (b - a) && root <= b + 0.01 * (b - a) => centre = root,
                // No root: the sign changed through a pole.
                _ => return,
            }
        }
        let at_root = self.test_at_guess(walker, centre, &vectors);
        if at_root.is_some_and(|test| test.abs() > VANISHES.sqrt() * edge) {
            return;
        }
        if self.singular.iter().any(|p| (p.s - centre).abs() < 1e-9 * width) {
            return;
        }
        // Placed first: the window keeps its distance from the others.
        let here = self.singular.len();
        self.singular.push(SingularPosition {
            kind: SingularKind::ChangePoint,
            s: centre,
            self_stress: vec![1.0; walker.driven.system.m()],
        });
        if let Some(window) = self.window(walker, centre, width) {
            if let Some(self_stress) = window.self_stress(walker) {
                self.singular[here].self_stress = self_stress;
            }
            self.windows.push(window);
        }
    }

    fn solve_at(&self, walker: &mut Walker, s: f64) -> Option<Node> {
        let mut q = self.nodes[0].q.clone();
        if !self.regular(s, &mut q) {
            return None;
        }
        walker.node(s, q).ok().map(|(node, _)| node)
    }

    fn null_vectors(&self, walker: &mut Walker, s: f64) -> Option<NullVectors> {
        self.solve_at(walker, s)?;
        let condition = walker.condition(None);
        Some(NullVectors { right: condition.right, left: condition.left })
    }

    fn test_at(&self, walker: &mut Walker, s: f64, vectors: &NullVectors) -> Option<f64> {
        self.solve_at(walker, s)?;
        let value = walker.driven.test_function(&vectors.right, &vectors.left);
        value.is_finite().then_some(value)
    }

    /// The test function at an uncorrected position (at the singular position itself nothing can be corrected).
    fn test_at_guess(&self, walker: &mut Walker, s: f64, vectors: &NullVectors) -> Option<f64> {
        let mut q = self.nodes[0].q.clone();
        if !self.regular(s, &mut q) {
            return None;
        }
        walker.set(s);
        walker.driven.evaluation.set_position(&q);
        walker.driven.factor(&walker.inputs).ok()?;
        Some(walker.driven.test_function(&vectors.right, &vectors.left))
    }

    /// The smooth branch around a change point; the width shrinks until the polynomial meets the constraints.
    fn window(&self, walker: &mut Walker, centre: f64, mut width: f64) -> Option<Window> {
        let (low, high) = self.covered();
        for other in self.singular.iter().filter(|p| p.s != centre) {
            width = width.min(0.45 * (other.s - centre).abs());
        }
        let mut best: Option<(f64, Window)> = None;
        for _ in 0..6 {
            let mut nodes = Vec::new();
            for side in [-1.0, 1.0] {
                for node in WINDOW_NODES {
                    let s = centre + side * node * width;
                    if s >= low && s <= high {
                        nodes.extend(self.solve_at(walker, s));
                    }
                }
            }
            if nodes.len() >= 4 {
                let branch = Osculating::new(&nodes, centre);
                let mut error = 0.0_f64;
                let n = nodes[0].q.len();
                let (mut q, mut d, mut dd) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
                for check in [-0.55, -0.3, 0.3, 0.55] {
                    let s = centre + check * width;
                    if let Some(node) = self.solve_at(walker, s) {
                        branch.eval(s, &mut q, &mut d, &mut dd);
                        let off: Vec<f64> = q.iter().zip(&node.q).map(|(a, b)| a - b).collect();
                        error = error.max(walker.driven.system.scaled_norm(&off));
                    }
                }
                let window = Window { s: centre, radius: WINDOW_NODES[0] * width, width, branch };
                // What is left when a smaller width does not help any more is round-off.
                let better = best.as_ref().is_none_or(|(least, _)| error < 0.5 * least);
                if better {
                    best = Some((error, window));
                }
                if error <= WINDOW_ERROR || !better {
                    break;
                }
            }
            width *= 0.7;
        }
        best.map(|(_, window)| window)
    }
}

struct NullVectors {
    right: Vec<f64>,
    left: Vec<f64>,
}

impl Window {
    /// The self-stress of the change point: the left null vector a hair beside it, where the Jacobian has factors still.
    fn self_stress(&self, walker: &mut Walker) -> Option<Vec<f64>> {
        let system = walker.driven.system;
        let n = system.n();
        let (mut q, mut d, mut dd) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let s = self.s + BESIDE * self.width;
        self.branch.eval(s, &mut q, &mut d, &mut dd);
        walker.set(s);
        walker.driven.evaluation.set_position(&q);
        walker.driven.factor(&walker.inputs).ok()?;
        let condition = walker.condition(None);
        let mut self_stress = vec![0.0; system.m()];
        for (value, &row) in condition.left.iter().zip(walker.driven.active_rows()) {
            if let Some(stress) = self_stress.get_mut(row) {
                *stress = value / system.row_scale(row);
            }
        }
        Some(self_stress)
    }
}

/// Root of the polynomial through (x, f) nearest to `centre`, by the secant method within `width`.
fn root_of(x: &[f64], f: &[f64], centre: f64, width: f64) -> Option<f64> {
    let value = |s: f64| interpolate(x, f, s);
    let (mut s0, mut s1) = (centre - 0.1 * width, centre + 0.1 * width);
    let (mut f0, mut f1) = (value(s0), value(s1));
    for _ in 0..60 {
        let s2 = s1 - f1 * (s1 - s0) / (f1 - f0);
        if !s2.is_finite() || (s2 - centre).abs() > 2.0 * width {
            return None;
        }
        let done = (s2 - s1).abs() <= 4.0 * f64::EPSILON * s2.abs().max(width);
        (s0, f0) = (s1, f1);
        (s1, f1) = (s2, value(s2));
        if done || f1 == 0.0 {
            return Some(s1);
        }
        if f1 == f0 {
            return (f1.abs() < 1e-12 * crate::math::max_abs(f)).then_some(s1);
        }
    }
    Some(s1)
}
