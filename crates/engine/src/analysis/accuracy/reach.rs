//! The clearance that a deviation needs, and how far the output reaches where its first order means nothing.
//!
//! Prescribe the drivers *and* the output: one equation too many. What closes the mechanism is a share c of all deviations, each
//! where the self-stress λ of the equations presses it:
//!
//! ```text
//! φ(q) + c e(λ) = 0,  y(q) = y*,  Jᵀ λ + ∂yᵀ μ = 0            unknowns q, c
//! ```
//!
//! The equations with the border (e, ∂y) are regular also at change points, where c grows with the square of y* and the reach
//! with the root of c. From the nominal output y* goes on until c = 1; then c is held at 1 and y* is free.

use super::displaced::{Mechanism, Stand};
use super::output::{Load, Output};
use super::search::SILENT;
use super::worst::Farthest;
use crate::system::System;
use linkdyn_linear::small::SmallLu;

/// First deviations that are tried, in radians or sizes: with too small a one the gaps are round-off.
const FIRST: [f64; 4] = [1e-6, 1e-5, 1e-4, 1e-3];
/// Largest step of the deviation, in radians or sizes.
const LARGEST: f64 = 0.05;
/// A deviation beyond this, in radians or sizes, has no end.
const FARTHEST: f64 = 7.0;
/// Shortest.
const SHORTEST: f64 = 1e-12;
/// Most steps.
const MOST_STEPS: usize = 400;
/// What has hardly an influence flickers from side to side: after so many corrections all keep theirs.
const MOST_AIMS: usize = 12;
/// Most corrections of one step.
const MOST_PASSES: usize = 40;
/// Corrections below this, in radians or sizes, are round-off.
const DONE: f64 = 1e-14;
/// On the way corrections below this are enough.
const NEAR: f64 = 1e-9;
/// Corrections below this that do not shrink any more are round-off, too: gaps of a tiny clearance hardly say where.
const STALLED: f64 = 1e-10;
/// So many of them.
const CALM: usize = 4;
/// A correction longer than this, in radians or sizes, is lost.
const LONGEST: f64 = 0.3;
/// Most turns of the self-stress.
const MOST_FLIPS: usize = 4;

/// A displaced mechanism.
#[derive(Debug, Clone)]
pub(super) struct Displaced {
    pub q: Vec<f64>,
    /// Share of the deviations.
    pub c: f64,
    /// Deviation of the output.
    pub y: f64,
    /// The load that presses the deviations.
    pub load: Load,
}

/// What is held while the rest is solved for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Held {
    /// The deviation of the output.
    Output(f64),
    /// The share of the deviations.
    Share(f64),
}

/// ∂y/∂q (n), scaled, and ∂y/∂c by the shifts of the output's own points.
struct Border {
    gradient: Vec<f64>,
    shift: f64,
}

/// Equations with their border.
pub(super) struct Bordered<'a, 'm> {
    mechanism: &'a mut Mechanism<'m>,
    stand: &'a Stand,
    output: &'a Output,
    side: f64,
    nominal: f64,
    forward: SmallLu,
    lu: SmallLu,
    /// A typical gap, by which the border is measured [–].
    gap: f64,
    /// What the output's deviation is measured by.
    unit: f64,
    /// What gains no more than this part of all stays.
    still: f64,
}

impl Mechanism<'_> {
    /// The reach of the output to a side (±1), from a load that presses to it; none where it can't be found.
    pub fn reach(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: Load,
        side: f64,
    ) -> Option<Farthest> {
        let system = self.driven.system;
        let n = system.n();
        self.take(&stand.q, stand);
        self.shifts.fill(linkdyn_linear::math::Vec2::zeros());
        let nominal = self.value(stand, output, 0.0);
        let unit = if output.is_angle() { 1.0 } else { system.size };
        let mut bordered = Bordered {
            mechanism: self,
            stand,
            output,
            side,
            nominal,
            forward: SmallLu::new(n + 1),
            lu: SmallLu::new(n + 1),
            gap: 1.0,
            unit,
            still: SILENT,
        };
        bordered.run(load)
    }
}

impl Bordered<'_, '_> {
    fn run(&mut self, load: Load) -> Option<Farthest> {
        let start = Displaced {
            q: self.stand.q.clone(),
            c: 0.0,
            y: 0.0,
            load,
        };
        // What has no influence is best left in the middle, but beside a change point it may get one.
        [SILENT, 0.0].into_iter().find_map(|still| {
            self.still = still;
            self.mechanism.chosen.extremes.fill([0.0; 2]);
            let begin = |first: &f64| self.march(start.clone(), first * self.unit);
            FIRST.iter().find_map(begin)
        })
    }

    /// On from the nominal position until c = 1: all that lies before is reached with less.
    fn march(&mut self, start: Displaced, first: f64) -> Option<Farthest> {
        let (mut now, mut trail, mut step) = (start, Vec::new(), first);
        for _ in 0..MOST_STEPS {
            let target = Held::Output(now.y + self.side * step);
            match self.solve(&now, trail.last(), target) {
                Some(next) if next.c >= 1.0 => {
                    let reached = self.close(now.clone(), next)?;
                    trail.extend([now, reached.clone()]);
                    let needed = self.needed(&trail);
                    return Some(Farthest {
                        deviation: reached.y,
                        q: reached.q,
                        needed,
                    });
                }
                // Beside a change point c falls again towards the other branch, which the clearance then lets in.
                Some(next) => {
                    trail.push(std::mem::replace(&mut now, next));
                    step = (2.0 * step).min(LARGEST * self.unit);
                }
                None if now.c == 0.0 => return None,
                None => step *= 0.25,
            }
            if now.y.abs() > FARTHEST * self.unit {
                return None;
            }
            if step < SHORTEST * self.unit {
                return None;
            }
        }
        None
    }

    /// Where c = 1 between two displaced positions.
    fn close(&mut self, mut low: Displaced, mut high: Displaced) -> Option<Displaced> {
        for _ in 0..60 {
            // c is a line or a parabola of y: a root in between by the mean of both.
            let part = (1.0 - low.c) / (high.c - low.c);
            let middle = low.y + part.clamp(0.05, 0.95) * (high.y - low.y);
            let near = if part < 0.5 { &low } else { &high };
            let found = self.solve(&near.clone(), None, Held::Output(middle))?;
            if (found.c - 1.0).abs() < 0.05 {
                return self.solve(&found, None, Held::Share(1.0));
            }
            if found.c < 1.0 {
                low = found;
            } else {
                high = found;
            }
        }
        None
    }

    /// Newton on the equations with their border, from a displaced position, or from the line through it and the one before.
    pub(super) fn solve(
        &mut self,
        from: &Displaced,
        before: Option<&Displaced>,
        held: Held,
    ) -> Option<Displaced> {
        let system = self.mechanism.driven.system;
        let n = system.n();
        let mut at = from.clone();
        if let (Some(before), Held::Output(y)) = (before, held) {
            let along = (y - from.y) / (from.y - before.y);
            for (k, q) in at.q.iter_mut().enumerate() {
                *q += along * (from.q[k] - before.q[k]);
            }
            at.c += along * (from.c - before.c);
        }
        let (mut last, mut calm, mut flips) = (f64::INFINITY, 0, 0);
        let (mut step, mut aimed) = (vec![0.0; n + 1], 0);
        for _ in 0..MOST_PASSES {
            self.mechanism.take(&at.q, self.stand);
            self.aim(&mut at, aimed >= MOST_AIMS)?;
            aimed += 1;
            let border = self.border();
            self.fill(&border, held)?;
            self.right_side(&at, held, &mut step);
            self.forward.solve(&mut step);
            let dc = step[n];
            system.scale_columns(&mut step[..n]);
            let size = system.scaled_norm(&step[..n]);
            if !(size.is_finite() && dc.is_finite())
                || size > LONGEST
                || (size > 4.0 * last && calm == 0)
            {
                return None;
            }
            at.q.iter_mut().zip(&step).for_each(|(q, d)| *q += d);
            at.c += dc;
            if at.c < 0.0 {
                // The self-stress presses the other way.
                at.load.lambda.iter_mut().for_each(|l| *l = -*l);
                at.load.size = -at.load.size;
                (at.c, last, aimed) = (-at.c, f64::INFINITY, 0);
                flips += 1;
                if flips > MOST_FLIPS {
                    return None;
                }
                continue;
            }
            let stalled = size <= STALLED && size > 0.3 * last;
            calm = match size {
                _ if size <= DONE || stalled => calm + 1,
                _ if size <= STALLED => calm,
                _ => 0,
            };
            let is_on_the_way = matches!(held, Held::Output(_)) && size <= NEAR;
            // Corrections that shrink slowly look like round-off at first.
            if calm == CALM || is_on_the_way {
                self.mechanism.take(&at.q, self.stand);
                at.y = self.mechanism.value(self.stand, self.output, at.c) - self.nominal;
                return Some(at);
            }
            last = size;
        }
        None
    }

    /// The load that the deviations balance at the position taken, and gaps and shifts that it asks for; where all keep theirs,
    /// for the same deviations.
    fn aim(&mut self, at: &mut Displaced, is_kept: bool) -> Option<()> {
        let mut g = vec![[0.0; 2]; self.mechanism.plays.len()];
        for pass in 0..if is_kept { 1 } else { 2 } {
            if is_kept {
                self.mechanism.place(self.stand);
                self.mechanism.gap(self.stand);
            } else {
                self.mechanism
                    .influences(self.stand, self.output, &at.load, &mut g);
                if !self.mechanism.deviate(self.stand, &g, self.still) {
                    return None;
                }
            }
            let gaps = self.mechanism.rows.iter().enumerate();
            let system = self.mechanism.driven.system;
            let scaled = gaps.map(|(row, gap)| (gap / system.row_scale(row)).abs());
            self.gap = scaled.fold(0.0, f64::max);
            if self.gap == 0.0 {
                return None;
            }
            if pass == 0 {
                let border = self.border();
                at.load = self.balance(&border)?;
            }
        }
        Some(())
    }

    /// Border of the equations at the position taken.
    fn border(&self) -> Border {
        let system = self.mechanism.driven.system;
        let mut gradient = vec![0.0; system.n()];
        self.mechanism
            .gradient(self.stand, self.output, &mut gradient);
        let kinematics = self.mechanism.here(self.stand).at;
        let pulls = self
            .output
            .pulls(&kinematics, &self.mechanism.shifts)
            .into_iter()
            .flatten();
        let shift = pulls.filter_map(|(place, pull)| {
            let shift = self.mechanism.shifts[place.point?.0];
            Some(pull.dot(&kinematics.poses[place.marker.body.0].turn(shift)))
        });
        Border {
            shift: shift.sum::<f64>() / self.unit,
            gradient: gradient
                .iter()
                .enumerate()
                .map(|(column, g)| g * system.column_scale(column) / self.unit)
                .collect(),
        }
    }

    /// λ and μ that balance each other, pressed together by the gaps.
    fn balance(&mut self, border: &Border) -> Option<Load> {
        let system = self.mechanism.driven.system;
        let n = system.n();
        let width = n + 1;
        let values = self.lu.values();
        let jacobian = &self.mechanism.driven.evaluation.jacobian;
        scatter(system, jacobian, values, |row, column| column * width + row);
        for row in 0..n {
            values[n * width + row] = self.mechanism.rows[row] / system.row_scale(row) / self.gap;
            values[row * width + n] = border.gradient[row];
        }
        values[n * width + n] = border.shift / self.gap;
        if !self.lu.factor() {
            return None;
        }
        let mut found = vec![0.0; width];
        // g·e > 0, and g = −λ.
        found[n] = -1.0;
        self.lu.solve(&mut found);
        let size = -found[n] / self.unit;
        found.truncate(n);
        for (row, l) in found.iter_mut().enumerate() {
            *l /= system.row_scale(row);
        }
        found.iter().all(|l| l.is_finite()).then_some(Load {
            lambda: found,
            size,
        })
    }

    /// Factors of the equations with their border.
    fn fill(&mut self, border: &Border, held: Held) -> Option<()> {
        let system = self.mechanism.driven.system;
        let n = system.n();
        let width = n + 1;
        let values = self.forward.values();
        let jacobian = &self.mechanism.driven.evaluation.jacobian;
        scatter(system, jacobian, values, |row, column| row * width + column);
        for row in 0..n {
            values[row * width + n] = self.mechanism.rows[row] / system.row_scale(row);
        }
        match held {
            Held::Output(_) => {
                values[n * width..n * width + n].copy_from_slice(&border.gradient);
                values[n * width + n] = border.shift;
            }
            Held::Share(_) => values[n * width + n] = 1.0,
        }
        self.forward.factor().then_some(())
    }

    /// What the equations lack, scaled.
    fn right_side(&self, at: &Displaced, held: Held, step: &mut [f64]) {
        let system = self.mechanism.driven.system;
        let n = system.n();
        let phi = &self.mechanism.driven.evaluation.phi;
        for row in 0..n {
            step[row] = -(phi[row] + at.c * self.mechanism.rows[row]) / system.row_scale(row);
        }
        step[n] = match held {
            Held::Output(y) => {
                let now = self.mechanism.value(self.stand, self.output, at.c) - self.nominal;
                (y - now) / self.unit
            }
            Held::Share(c) => c - at.c,
        };
    }
}

/// Writes J, scaled, into a matrix of zeros; `place` says where an entry stands.
fn scatter(
    system: &System,
    jacobian: &[f64],
    values: &mut [f64],
    place: impl Fn(usize, usize) -> usize,
) {
    values.fill(0.0);
    for (entry, value) in system.entries.iter().zip(jacobian) {
        if let Some(column) = entry.column() {
            let (row, column) = (entry.row as usize, column as usize);
            values[place(row, column)] += system.scaled_entry(*value, row, column);
        }
    }
}
