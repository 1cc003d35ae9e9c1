//! The clearance that a deviation needs, and how far the output reaches where its first order means nothing.
//!
//! Prescribe the drivers *and* the output: one equation too many. What closes the mechanism is a share |c| of all deviations, each
//! where the self-stress λ of the equations presses it:
//!
//! ```text
//! φ(q) + |c| b = 0,  y(q) = y*        b = B e,  e = argmax ±g·e,  ± the sign of c;  Jᵀ λ + ∂yᵀ μ = 0,  g = −Bᵀλ
//!
//! A = | J   ±b |                      A (Δq, Δc) = (−φ − |c| b, y* − y)      A⊤(λ, μ) = (0, −1)      A (q′, c′) = (0, 1)
//!     | ∂y   0 |
//! ```
//!
//! These equations are regular also at change points, where c grows with the square of y* and the reach with the root of c. From
//! the nominal output y* goes on until |c| = 1. Near a change point c rises and falls again, through 0 where the other branch
//! is, and the self-stress presses the other way beyond. A place where c is greatest is a place of its own, so that between two
//! places c only rises or only falls.

use super::ascent::Farthest;
use super::displaced::{Asked, Mechanism};
use super::limits::{DONE, LONGEST, MOST_PASSES, MOST_STEPS, SAME, left};
use super::output::Load;
use super::source::{Pair, Room, dot};
use linkdyn_linear::math::Vec2;
use linkdyn_linear::small::SmallLu;

/// Largest step of the output, in radians or sizes, and the part of a share by which its guess may be off: there tangents still lead.
const LARGEST: f64 = 0.05;
const ASTRAY: f64 = 0.2;
/// In steps shorter than this, in radians or sizes, no other branch can be meant.
const NARROW: f64 = 1e-6;
/// A deviation beyond this, in radians or sizes, has no end: a link turns all around.
const FARTHEST: f64 = 7.0;
/// Passes in which deviations go to where the load presses them; then what has hardly an influence only flickers.
const PRESSES: usize = 12;
/// What is left of a correction is round-off.
const ROUND_OFF: f64 = 1e-15;
/// Where a step of Newton changes the output by less, in radians or sizes, a share is reached: round-off is as much.
const REACHED: f64 = 1e-12;
/// Shares that are reported: round ones, and squares of eighths, since near a change point c is proportional to y².
const SHARES: [f64; 9] = [
    0.015625, 0.0625, 0.1, 0.140625, 0.25, 0.390625, 0.5, 0.5625, 0.765625,
];
/// A reach that is off the straight line by less than this part needs no curve.
const STRAIGHT: f64 = 0.01;

/// A displaced mechanism.
#[derive(Debug, Clone)]
struct Node {
    q: Vec<f64>,
    /// Share of the deviations; below 0 the self-stress presses the other way than at the nominal position.
    c: f64,
    /// Deviation of the output.
    y: f64,
    /// ∂q/∂y and ∂c/∂y (n + 1).
    ahead: Vec<f64>,
    /// The deviations, whole.
    e: Vec<Pair>,
}

impl Node {
    /// By how much |c| rises with the output to a side.
    fn rise(&self, side: f64) -> f64 {
        side * self.c.signum() * self.ahead[self.q.len()]
    }

    /// The deviation of the output at a share on the way to another place: of the cubic y(|c|) with the slopes of both, if |c| only
    /// rises, else of the straight line.
    fn y_at(&self, to: &Node, share: f64) -> f64 {
        let (width, height) = (to.c.abs() - self.c.abs(), to.y - self.y);
        let t = (share - self.c.abs()) / width;
        let straight = self.y + t * height;
        let [first, last] = [self, to].map(|node| width / (node.rise(1.0) * height) - 1.0);
        let is_smooth = |bend: f64| bend > -1.0 && bend < 2.0;
        if !(is_smooth(first) && is_smooth(last)) {
            return straight;
        }
        straight + height * t * (1.0 - t) * (first * (1.0 - t) - last * t)
    }
}

/// Where deviations went.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Pressed {
    Nowhere,
    /// On the rims of discs.
    Turned,
    /// To other ends.
    Jumped,
}

/// Equations with their border.
pub(super) struct Path<'a, 'm> {
    mechanism: &'a mut Mechanism<'m>,
    of: Asked<'a>,
    side: f64,
    nominal: f64,
    lu: SmallLu,
    load: Load,
    /// What the output's deviation is measured by.
    unit: f64,
    /// Influences.
    g: Vec<Pair>,
    /// Corrections, multipliers and the way on (n + 1).
    step: Vec<f64>,
}

impl<'a, 'm> Path<'a, 'm> {
    /// Of an output to a side, with a load that presses to it: of a unit, or the self-stress at a change point.
    pub fn new(mechanism: &'a mut Mechanism<'m>, of: Asked<'a>, load: Load, side: f64) -> Self {
        let system = mechanism.driven.system;
        mechanism.take(&of.stand.q, of.stand);
        mechanism.shifts.fill(Vec2::zeros());
        Path {
            nominal: mechanism.value(of, 0.0),
            unit: if of.output.is_angle() {
                1.0
            } else {
                system.size
            },
            lu: SmallLu::new(system.n() + 1),
            g: vec![[0.0; 2]; mechanism.sources.len()],
            step: vec![0.0; system.n() + 1],
            mechanism,
            of,
            side,
            load,
        }
    }

    /// The reach of the output, from first steps as short as gaps allow, or `None` if it cannot be found.
    pub fn reach(&mut self) -> Option<Farthest> {
        let load = self.load.clone();
        let firsts = [1e-5, 1e-4, 1e-3, 1e-2];
        firsts.into_iter().find_map(|first| {
            self.load = load.clone();
            let start = self.start()?;
            self.march(start, first * self.unit)
        })
    }

    /// The nominal position, with the deviations that the load presses.
    fn start(&mut self) -> Option<Node> {
        let q = self.of.stand.q.clone();
        let e = self
            .mechanism
            .sources
            .iter()
            .map(|source| source.room.rest());
        let mut start = Node {
            ahead: vec![0.0; q.len() + 1],
            e: e.collect(),
            q,
            c: 0.0,
            y: 0.0,
        };
        self.mechanism.take(&start.q, self.of.stand);
        self.press(&mut start)?;
        for _ in 0..2 {
            self.factor(&start)?;
            self.balance()?;
            self.press(&mut start)?;
        }
        self.lead(&mut start);
        Some(start)
    }

    /// On from the nominal position until |c| = 1: all that lies before is reached with less.
    fn march(&mut self, start: Node, first: f64) -> Option<Farthest> {
        let rise = start.rise(self.side);
        let mut step = if rise > 0.0 {
            first.min(0.1 / rise)
        } else {
            first
        };
        let mut trail = vec![start];
        for _ in 0..MOST_STEPS {
            let now = trail.last()?;
            if step < DONE * (DONE * self.unit + now.y.abs()) || now.y.abs() > FARTHEST * self.unit
            {
                return None;
            }
            let found = self.solve(now, now.y + self.side * step);
            // The share goes by its slope even as deviations follow, for they are stationary; q need not.
            let guessed = now.c + self.side * step * now.ahead[now.q.len()];
            let off = |next: &Node| (next.c - guessed).abs() / next.c.abs().max(now.c.abs());
            let astray = found.as_ref().map_or(f64::INFINITY, off);
            // From a change point the share begins with no slope.
            let leads = astray <= ASTRAY || step <= NARROW * self.unit || trail.len() == 1;
            let Some(next) = found.filter(|_| leads) else {
                if trail.len() == 1 {
                    return None;
                }
                step *= 0.25;
                continue;
            };
            let longer = (0.25 * ASTRAY / astray).sqrt().clamp(0.5, 8.0);
            step = (longer * step).min(LARGEST * self.unit);
            let is_hump = now.rise(self.side) > 0.0 && next.rise(self.side) < 0.0;
            let top = if is_hump && now.c * next.c >= 0.0 {
                Some(self.between(now, &next, |node, side| -node.rise(side))?)
            } else {
                None
            };
            for next in top.into_iter().chain([next]) {
                let now = trail.last()?;
                if next.c.abs() >= 1.0 {
                    let reached = self.at_share(now, &next, 1.0)?;
                    trail.push(reached);
                    return self.farthest(&trail);
                }
                trail.push(next);
            }
        }
        None
    }

    fn farthest(&mut self, trail: &[Node]) -> Option<Farthest> {
        let reached = trail.last()?;
        Some(Farthest {
            deviation: reached.y,
            q: reached.q.clone(),
            e: reached.e.clone(),
            lacks: f64::NAN,
            needed: self.needed(trail),
        })
    }

    /// Deviations of the output, each with the share of all deviations that reaches it first; `None` if the output goes with the
    /// share.
    fn needed(&mut self, trail: &[Node]) -> Vec<[f64; 2]> {
        let [_, first, .., reached] = trail else {
            return Vec::new();
        };
        if (first.y / first.c.abs() / reached.y - 1.0).abs() < STRAIGHT {
            return Vec::new();
        }
        let curve = SHARES.into_iter().filter_map(|share| {
            let to = trail.iter().position(|node| node.c.abs() >= share)?;
            let found = self.at_share(&trail[to.checked_sub(1)?], &trail[to], share)?;
            Some([found.y, share])
        });
        let mut curve: Vec<[f64; 2]> = curve.collect();
        curve.push([reached.y, 1.0]);
        curve
    }

    /// Where |c| rises to a share: by Newton's steps from the cubic through both ends and their slopes, within the ends.
    fn at_share(&mut self, from: &Node, to: &Node, share: f64) -> Option<Node> {
        let [mut below, mut above] = [from.clone(), to.clone()];
        let mut y = from.y_at(to, share);
        for _ in 0..MOST_PASSES {
            if (y - below.y) * (y - above.y) > 0.0 {
                y = 0.5 * (below.y + above.y);
            }
            let is_near_above = (y - above.y).abs() < (y - below.y).abs();
            let (near, other) = match is_near_above {
                true => (&above, &below),
                false => (&below, &above),
            };
            let found = self.solve(near, y);
            let found = found.or_else(|| self.solve(other, y))?;
            let off = found.c.abs() - share;
            let by = off / found.rise(1.0);
            if by.abs() <= REACHED * self.unit {
                return Some(found);
            }
            y -= by;
            if off < 0.0 {
                below = found;
            } else {
                above = found;
            }
        }
        None
    }

    /// Where a value changes its sign between two places: by secants, with the weight of an end that stays halved (Illinois).
    fn between(
        &mut self,
        from: &Node,
        to: &Node,
        value: impl Fn(&Node, f64) -> f64,
    ) -> Option<Node> {
        let ends = [from, to].map(|node| (node.clone(), value(node, self.side)));
        let [mut from, mut to] = ends;
        for _ in 0..MOST_PASSES {
            let part = from.1 / (from.1 - to.1);
            let y = from.0.y + part * (to.0.y - from.0.y);
            let (near, other) = if part < 0.5 {
                (&from.0, &to.0)
            } else {
                (&to.0, &from.0)
            };
            let found = self.solve(near, y);
            let found = found.or_else(|| self.solve(other, y))?;
            let own = value(&found, self.side);
            let width = (to.0.y - from.0.y).abs();
            if own.abs() <= ROUND_OFF || width <= DONE * DONE * y.abs() {
                return Some(found);
            }
            if own.signum() == to.1.signum() {
                (to, from.1) = ((found, own), 0.5 * from.1);
            } else {
                (from, to) = (to, (found, own));
            }
        }
        None
    }

    /// Newton on the equations with their border, from the tangent of a place.
    fn solve(&mut self, from: &Node, y: f64) -> Option<Node> {
        let by = y - from.y;
        let mut at = from.clone();
        let places = at.q.iter_mut().chain([&mut at.c]);
        places
            .zip(&from.ahead)
            .for_each(|(place, ahead)| *place += by * ahead);
        if at.c * from.c < 0.0 {
            self.press(&mut at)?;
        }
        let mut last = f64::INFINITY;
        for pass in 0..MOST_PASSES {
            self.factor(&at)?;
            self.balance()?;
            let pressed = if pass < PRESSES {
                self.press(&mut at)?
            } else {
                Pressed::Nowhere
            };
            let before = at.c;
            let size = self.correct(&mut at, y)?;
            let is_turned = at.c * before < 0.0;
            if size > LONGEST {
                return None;
            }
            if is_turned {
                self.press(&mut at)?;
            }
            let is_stalled = size <= DONE && size > 0.3 * last;
            let is_done = left(size, last) <= ROUND_OFF || is_stalled;
            if is_done && pressed == Pressed::Nowhere && !is_turned {
                self.lead(&mut at);
                return Some(at);
            }
            last = if pressed == Pressed::Jumped || is_turned {
                f64::INFINITY
            } else {
                size
            };
        }
        None
    }

    /// Takes a place, with its deviations and the gaps that they make.
    fn place(&mut self, at: &Node) -> Option<()> {
        self.mechanism.take(&at.q, self.of.stand);
        self.mechanism.e.copy_from_slice(&at.e);
        if !self.mechanism.step_parameters() {
            return None;
        }
        self.mechanism.place(self.of.stand);
        self.mechanism.gap(self.of.stand);
        Some(())
    }

    /// Factors of the equations with their border, scaled, at a place.
    fn factor(&mut self, at: &Node) -> Option<()> {
        self.place(at)?;
        self.mechanism.gradient(self.of);
        let system = self.mechanism.driven.system;
        let n = system.n();
        let (width, sign) = (n + 1, at.c.signum());
        let shift = sign * self.shift() / self.unit;
        let values = self.lu.values();
        values.fill(0.0);
        let jacobian = &self.mechanism.driven.evaluation.jacobian;
        for (entry, value) in system.entries.iter().zip(jacobian) {
            if let Some(column) = entry.column() {
                let (row, column) = (entry.row as usize, column as usize);
                values[row * width + column] += system.scaled_entry(*value, row, column);
            }
        }
        for (row, gap) in self.mechanism.rows.iter().enumerate() {
            values[row * width + n] = sign * gap / system.row_scale(row);
        }
        let border = values[n * width..].iter_mut().zip(&self.mechanism.gradient);
        for (column, (value, gradient)) in border.enumerate() {
            *value = gradient * system.column_scale(column) / self.unit;
        }
        values[n * width + n] = shift;
        self.lu.factor().then_some(())
    }

    /// ∂y/∂|c| by the shifts of the output's own points.
    fn shift(&self) -> f64 {
        let at = self.mechanism.here(self.of.stand).at;
        let shifts = &self.mechanism.shifts;
        let pulls = self.of.output.pulls(&at, shifts).into_iter().flatten();
        let shift = pulls.filter_map(|(place, pull)| {
            let shift = shifts[place.point?.0];
            Some(pull.dot(&at.poses[place.marker.body.0].turn(shift)))
        });
        shift.sum()
    }

    /// λ and μ that balance each other, pressed together by the gaps.
    fn balance(&mut self) -> Option<()> {
        let system = self.mechanism.driven.system;
        let n = system.n();
        self.step.fill(0.0);
        self.step[n] = -1.0;
        self.lu.solve_transposed(&mut self.step);
        self.load.size = -self.step[n] / self.unit;
        for (row, (lambda, stress)) in self.load.lambda.iter_mut().zip(&self.step).enumerate() {
            *lambda = stress / system.row_scale(row);
        }
        self.load.lambda.iter().all(|l| l.is_finite()).then_some(())
    }

    /// Chooses the deviations that the load presses, at the position taken, and what follows from them.
    fn press(&mut self, at: &mut Node) -> Option<Pressed> {
        self.mechanism.influences(self.of, &self.load, &mut self.g);
        let sign = at.c.signum();
        let sources = self.mechanism.sources;
        let all: f64 = sources
            .iter()
            .zip(&self.g)
            .map(|(source, g)| source.room.span(*g))
            .sum();
        let mut pressed = Pressed::Nowhere;
        for ((source, g), e) in sources.iter().zip(&self.g).zip(&mut at.e) {
            let g = g.map(|g| sign * g);
            let Some(end) = source.room.extreme(g) else {
                continue;
            };
            if dot(g, [end[0] - e[0], end[1] - e[1]]) > SAME * all {
                let is_disc = matches!(source.room, Room::Disc(_));
                if !is_disc {
                    pressed = Pressed::Jumped;
                } else if pressed == Pressed::Nowhere {
                    pressed = Pressed::Turned;
                }
                *e = end;
            }
        }
        if pressed != Pressed::Nowhere {
            self.place(at)?;
        }
        Some(pressed)
    }

    /// Says where q and c go with the output, and how far it is off, at a place that was found.
    fn lead(&mut self, at: &mut Node) {
        let n = at.q.len();
        at.ahead.fill(0.0);
        at.ahead[n] = 1.0 / self.unit;
        self.lu.solve(&mut at.ahead);
        let system = self.mechanism.driven.system;
        system.scale_columns(&mut at.ahead[..n]);
        self.mechanism.driven.evaluation.set_position(&at.q);
        at.y = self.mechanism.value(self.of, at.c.abs()) - self.nominal;
    }

    /// Corrects a place that was taken, for a deviation of the output. Returns the size of the correction, if there is one.
    fn correct(&mut self, at: &mut Node, y: f64) -> Option<f64> {
        let system = self.mechanism.driven.system;
        let n = system.n();
        let share = at.c.abs();
        let rows = self
            .mechanism
            .driven
            .evaluation
            .phi
            .iter()
            .zip(&self.mechanism.rows);
        for ((row, (phi, gap)), step) in rows.enumerate().zip(&mut self.step) {
            *step = -(phi + share * gap) / system.row_scale(row);
        }
        let now = self.mechanism.value(self.of, share) - self.nominal;
        self.step[n] = (y - now) / self.unit;
        self.lu.solve(&mut self.step);
        system.scale_columns(&mut self.step[..n]);
        let places = at.q.iter_mut().chain([&mut at.c]);
        places.zip(&self.step).for_each(|(place, by)| *place += by);
        let size = system.scaled_norm(&self.step[..n]);
        (size.is_finite() && at.c.is_finite()).then_some(size)
    }
}
