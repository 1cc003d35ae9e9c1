//! Newton on the equations with their border.
//!
//! ```text
//! A = | J   e |        A (Δq, Δc) = (−φ − c e, y* − y)        A⊤(λ, μ) = (0, −1)        A (q′, c′) = (0, 1)
//!     | ∂y  0 |
//! ```
//!
//! One factorisation serves the correction, the self-stress that presses the deviations, and the way on with the output. Where
//! the share is held, the correction goes as far along that way as it has to.

use super::super::displaced::{Mechanism, Stand};
use super::super::output::{Load, Output};
use super::super::source::Influence;
use super::super::turn::Turn;
use super::Displaced;
use crate::system::System;
use linkdyn_linear::math::Vec2;
use linkdyn_linear::small::SmallLu;

/// What has hardly an influence flickers from side to side: after so many corrections all keep theirs.
const MOST_AIMS: usize = 12;
/// Most corrections of one step.
const MOST_PASSES: usize = 40;
/// What is left, in radians or sizes, is round-off.
const DONE: f64 = 1e-14;
/// Corrections below this that do not shrink any more are round-off, too: gaps of a tiny clearance hardly say where.
const STALLED: f64 = 1e-10;
/// So many of them.
const CALM: usize = 3;
/// On the way this is enough, in radians or sizes …
const NEAR: f64 = 1e-9;
/// … or in parts of the deviation.
const PART: f64 = 1e-5;
/// A share is found to this part of its deviation.
const FOUND: f64 = 1e-12;
/// A correction longer than this, in radians or sizes, is lost.
const LONGEST: f64 = 0.3;
/// A correction so many times the one before has grown.
const GROWN: f64 = 4.0;
/// Most turns of the self-stress.
const MOST_FLIPS: usize = 4;

/// What is held while the rest is solved for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) enum Held {
    /// The deviation of the output.
    Output(f64),
    /// The share of the deviations.
    Share(f64),
}

/// Equations with their border.
pub(in super::super) struct Bordered<'a, 'm> {
    pub mechanism: &'a mut Mechanism<'m>,
    pub stand: &'a Stand,
    pub output: &'a Output,
    pub side: f64,
    nominal: f64,
    lu: SmallLu,
    /// The load that presses the deviations: the first, and the last.
    first: Load,
    pub load: Load,
    /// What the output's deviation is measured by.
    pub unit: f64,
    /// What gains no more than this part of all stays.
    pub still: f64,
    /// How many corrections of one solution may grow.
    pub growths: usize,
    /// g of the plays.
    pub influences: Vec<Influence>,
    /// How often each guided slider changed its corner.
    pub turned: Vec<u8>,
    /// How the plays give way to their influence.
    pub turns: Vec<Turn>,
    /// ∂y/∂q (n).
    gradient: Vec<f64>,
    /// Corrections, multipliers, and the way on (n + 1).
    step: Vec<f64>,
    stress: Vec<f64>,
    ahead: Vec<f64>,
}

/// How corrections go.
struct Course {
    last: f64,
    calm: usize,
    /// What may be left.
    enough: f64,
    stalls: bool,
    /// How many may grow yet.
    growths: usize,
}

impl Course {
    /// After a correction of a size: none where it is lost, else whether it was the last.
    fn follow(&mut self, size: f64) -> Option<bool> {
        // One that grows may follow from deviations that went to other ends.
        let has_grown = size > GROWN * self.last && size > STALLED;
        if size.is_nan() || size > LONGEST || (has_grown && self.growths == 0) {
            return None;
        }
        self.growths -= usize::from(has_grown);
        // Corrections shrink by a factor, or faster.
        let left = if self.last.is_finite() {
            size * (size / self.last).min(1.0)
        } else {
            size
        };
        let stalled = size <= STALLED && size > 0.3 * self.last;
        self.calm = match size {
            _ if size <= DONE || stalled => self.calm + 1,
            _ if size <= STALLED => self.calm,
            _ => 0,
        };
        self.last = size;
        Some(left <= self.enough || (self.stalls && self.calm >= CALM))
    }
}

impl<'a, 'm> Bordered<'a, 'm> {
    pub fn new(
        mechanism: &'a mut Mechanism<'m>,
        stand: &'a Stand,
        output: &'a Output,
        load: Load,
        side: f64,
    ) -> Self {
        let system = mechanism.driven.system;
        let (n, plays) = (system.n(), mechanism.plays.len());
        mechanism.take(&stand.q, stand);
        mechanism.shifts.fill(Vec2::zeros());
        let nominal = mechanism.value(stand, output, 0.0);
        Bordered {
            mechanism,
            stand,
            output,
            side,
            nominal,
            lu: SmallLu::new(n + 1),
            first: load.clone(),
            load,
            unit: if output.is_angle() { 1.0 } else { system.size },
            still: 0.0,
            growths: 0,
            influences: vec![[0.0; 2]; plays],
            turned: vec![0; plays],
            turns: vec![Turn::default(); plays],
            gradient: vec![0.0; n],
            step: vec![0.0; n + 1],
            stress: vec![0.0; n + 1],
            ahead: vec![0.0; n + 1],
        }
    }

    /// The nominal position, with the deviations that the first load asks for.
    pub fn start(&mut self) -> Option<Displaced> {
        let q = self.stand.q.clone();
        self.mechanism.take(&q, self.stand);
        self.mechanism.chosen.extremes.fill([0.0; 2]);
        self.load.lambda.clone_from(&self.first.lambda);
        self.load.size = self.first.size;
        self.place()?;
        self.turned.fill(0);
        self.turns.fill(Turn::default());
        self.press()?;
        Some(Displaced {
            ahead: vec![0.0; q.len() + 1],
            q,
            c: 0.0,
            y: 0.0,
            is_turned: false,
            extremes: self.mechanism.chosen.extremes.clone(),
            turns: self.turns.clone(),
            off: 0.0,
            is_smooth: true,
        })
    }

    /// How far one position is from another [–].
    pub fn far(&mut self, from: &Displaced, to: &Displaced) -> f64 {
        let n = from.q.len();
        let each = self.step.iter_mut().zip(from.q.iter().zip(&to.q));
        each.for_each(|(step, (from, to))| *step = to - from);
        self.mechanism.driven.system.scaled_norm(&self.step[..n])
    }

    /// Newton on the equations with their border, from a guess.
    pub fn solve(&mut self, mut at: Displaced, held: Held) -> Option<Displaced> {
        self.choose(&at);
        let part = at.y.abs() / self.unit;
        let (enough, stalls) = match held {
            Held::Output(y) => (NEAR.max(PART * y.abs() / self.unit), false),
            Held::Share(_) => (DONE.max(FOUND * part), true),
        };
        let mut course = Course {
            last: f64::INFINITY,
            calm: 0,
            enough,
            stalls,
            growths: self.growths,
        };
        let (mut flips, mut aims, mut has_jumped) = (0, 0, false);
        for pass in 0..MOST_PASSES {
            self.mechanism.take(&at.q, self.stand);
            self.place()?;
            self.factor()?;
            self.balance()?;
            aims += 1;
            if aims <= MOST_AIMS && self.press()? {
                course.last = f64::INFINITY;
                has_jumped = true;
            }
            let size = self.correct(&mut at, held)?;
            if pass == 0 {
                at.off = size;
            }
            if at.c < 0.0 {
                // The self-stress presses the other way.
                self.load.lambda.iter_mut().for_each(|l| *l = -*l);
                self.load.size = -self.load.size;
                self.mechanism.take(&at.q, self.stand);
                self.turned.fill(0);
                self.turns.fill(Turn::default());
                self.press()?;
                at.is_turned = !at.is_turned;
                (at.c, course.last, aims) = (-at.c, f64::INFINITY, 0);
                flips += 1;
                if flips > MOST_FLIPS || size > LONGEST {
                    return None;
                }
                continue;
            }
            if course.follow(size)? {
                at.is_smooth = aims <= MOST_AIMS;
                // Guesses know nothing of ends.
                if has_jumped || !at.is_smooth {
                    at.off = 0.0;
                }
                self.settle(&mut at);
                return Some(at);
            }
        }
        None
    }

    /// Tells a position that was found how it goes on.
    fn settle(&mut self, at: &mut Displaced) {
        self.mechanism.driven.evaluation.set_position(&at.q);
        at.y = self.mechanism.value(self.stand, self.output, at.c) - self.nominal;
        self.lead();
        at.ahead.copy_from_slice(&self.ahead);
        let n = at.q.len();
        let system = self.mechanism.driven.system;
        system.scale_columns(&mut at.ahead[..n]);
        at.ahead.iter_mut().for_each(|by| *by /= self.unit);
        at.extremes.copy_from_slice(&self.mechanism.chosen.extremes);
        at.turns.copy_from_slice(&self.turns);
    }

    /// Factors of the equations with their border, at the position taken.
    fn factor(&mut self) -> Option<()> {
        let system = self.mechanism.driven.system;
        let n = system.n();
        let width = n + 1;
        self.mechanism
            .gradient(self.stand, self.output, &mut self.gradient);
        let shift = self.shift();
        let values = self.lu.values();
        let jacobian = &self.mechanism.driven.evaluation.jacobian;
        scatter(system, jacobian, values);
        for (row, gap) in self.mechanism.rows.iter().enumerate() {
            values[row * width + n] = gap / system.row_scale(row);
        }
        let border = values[n * width..].iter_mut().zip(&self.gradient);
        for (column, (value, gradient)) in border.enumerate() {
            *value = gradient * system.column_scale(column) / self.unit;
        }
        values[n * width + n] = shift / self.unit;
        self.lu.factor().then_some(())
    }

    /// ∂y/∂c by the shifts of the output's own points.
    fn shift(&self) -> f64 {
        let at = self.mechanism.here(self.stand).at;
        let shifts = &self.mechanism.shifts;
        let pulls = self.output.pulls(&at, shifts).into_iter().flatten();
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
        // g·e > 0, and g = −λ.
        self.stress.fill(0.0);
        self.stress[n] = -1.0;
        self.lu.solve_transposed(&mut self.stress);
        self.load.size = -self.stress[n] / self.unit;
        let mut is_finite = true;
        let each = self.load.lambda.iter_mut().zip(&self.stress).enumerate();
        for (row, (lambda, stress)) in each {
            *lambda = stress / system.row_scale(row);
            is_finite &= lambda.is_finite();
        }
        is_finite.then_some(())
    }

    /// Where q and c go with the output, scaled.
    fn lead(&mut self) {
        let n = self.ahead.len() - 1;
        self.ahead.fill(0.0);
        self.ahead[n] = 1.0;
        self.lu.solve(&mut self.ahead);
    }

    /// Corrects a position that was taken. The size of the correction; none where it has none.
    fn correct(&mut self, at: &mut Displaced, held: Held) -> Option<f64> {
        let system = self.mechanism.driven.system;
        let n = system.n();
        let evaluation = &self.mechanism.driven.evaluation;
        let rows = evaluation.phi.iter().zip(&self.mechanism.rows);
        for ((row, (phi, gap)), step) in rows.enumerate().zip(&mut self.step) {
            *step = -(phi + at.c * gap) / system.row_scale(row);
        }
        self.step[n] = match held {
            Held::Output(y) => {
                let now = self.mechanism.value(self.stand, self.output, at.c) - self.nominal;
                (y - now) / self.unit
            }
            Held::Share(_) => 0.0,
        };
        self.lu.solve(&mut self.step);
        if let Held::Share(c) = held {
            self.lead();
            let along = (c - at.c - self.step[n]) / self.ahead[n];
            let ahead = self.step.iter_mut().zip(&self.ahead);
            ahead.for_each(|(step, ahead)| *step += along * ahead);
            self.step[n] = c - at.c;
        }
        let dc = self.step[n];
        system.scale_columns(&mut self.step[..n]);
        let size = system.scaled_norm(&self.step[..n]);
        if !(size.is_finite() && dc.is_finite()) {
            return None;
        }
        at.q.iter_mut().zip(&self.step).for_each(|(q, d)| *q += d);
        at.c += dc;
        Some(size)
    }
}

/// Writes J, scaled, into a matrix of zeros with a border.
fn scatter(system: &System, jacobian: &[f64], values: &mut [f64]) {
    values.fill(0.0);
    let width = system.n() + 1;
    for (entry, value) in system.entries.iter().zip(jacobian) {
        if let Some(column) = entry.column() {
            let (row, column) = (entry.row as usize, column as usize);
            values[row * width + column] += system.scaled_entry(*value, row, column);
        }
    }
}
