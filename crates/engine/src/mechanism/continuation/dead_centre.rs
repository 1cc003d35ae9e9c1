//! Where the parameter turns back: the root of ds/dp along the direction in which the position runs off.

use super::parameter::Parameter;
use super::walk::Walker;
use linkdyn_linear::hermite::Node;
use linkdyn_linear::lu::SparseLu;
use linkdyn_linear::math::dot;
use linkdyn_linear::order::ColumnOrder;
use linkdyn_linear::pattern::{Pattern, square};

impl Walker<'_, '_> {
    /// Root of ds/dp near the end of a path, p the direction in which the position runs off there.
    pub(super) fn dead_centre(
        &mut self,
        last: &Node,
        before: Option<&Node>,
        direction: f64,
    ) -> Option<f64> {
        let (system, unit) = (self.driven.system, self.unit());
        // With an independent coordinate the path is only wanted as far as that is good.
        let before = before.filter(|_| self.parameter != Parameter::Coordinate)?;
        let scaled = |x: &[f64]| -> Vec<f64> {
            x.iter()
                .enumerate()
                .map(|(k, x)| x / system.column_scale(k))
                .collect()
        };
        let mut border = scaled(&last.d);
        let length = dot(&border, &border).sqrt() * direction;
        border.iter_mut().for_each(|b| *b /= length);
        let mut arc = BorderedPath::new(self, border, last);
        // Secant on ds/dp from the last two nodes.
        let offset: Vec<f64> = before.q.iter().zip(&last.q).map(|(a, b)| a - b).collect();
        let g = direction / dot(&arc.border, &scaled(&before.d)).abs();
        let ends = [
            PathPoint {
                p: dot(&arc.border, &scaled(&offset)),
                s: before.s,
                g,
            },
            PathPoint {
                p: 0.0,
                s: last.s,
                g: direction / length.abs(),
            },
        ];
        let [mut earlier, mut here] = ends;
        let (mut q, mut s) = (last.q.clone(), last.s);
        for _ in 0..MOST_SECANTS {
            let step = -here.g * (here.p - earlier.p) / (here.g - earlier.g);
            let limit = LONGEST_SECANT * (here.p - earlier.p).abs().max(LEAST_SECANT);
            let step = if step.is_finite() {
                step.clamp(-limit, limit)
            } else {
                limit
            };
            let p = here.p + step;
            // Where several parts have their dead centres at once the bordered matrix is singular there, too.
            let Some(g) = arc.solve(p, &mut q, &mut s) else {
                break;
            };
            (earlier, here) = (here, PathPoint { p, s, g });
            if (s - last.s).abs() > ASTRAY * (unit + last.s.abs()) {
                break;
            }
            if g.abs() <= LEVEL * (unit + earlier.g.abs()) || step.abs() <= ROUND_OFF {
                if g.abs() >= STEEP * (direction / length).abs().max(unit) {
                    break;
                }
                return Some(if p.abs() > RUNS_OFF {
                    asymptote(earlier, here)
                } else {
                    s
                });
            }
        }
        fold(ends)
    }
}

/// A point of the path with p as its parameter, g = ds/dp.
#[derive(Debug, Clone, Copy)]
struct PathPoint {
    p: f64,
    s: f64,
    g: f64,
}

/// Most steps of the secant method, and of Newton's for each.
const MOST_SECANTS: usize = 60;
const MOST_ITERATIONS: usize = 30;
/// A secant leads no farther than this many times the step before, which counts as no less than the second [rad or sizes].
const LONGEST_SECANT: f64 = 4.0;
const LEAST_SECANT: f64 = 1e-9;
/// The path ends some 1e-9 of a step before its dead centre: one that lies farther away than this is another [units of s].
const ASTRAY: f64 = 1e-3;
/// ds/dp that is none, and a step of p that is round-off [units of s; rad or sizes].
const LEVEL: f64 = 1e-11;
const ROUND_OFF: f64 = 1e-13;
/// ds/dp that is too much for a dead centre where the search comes to rest [units of s].
const STEEP: f64 = 1e-6;
/// Newton's last step: the next one is its square [rad, sizes, units of s].
const LAST_STEP: f64 = 1e-10;
/// A position that has moved by more than this, in rad or sizes, while s hardly did runs off to infinity.
const RUNS_OFF: f64 = 1e3;
/// Largest difference between two extrapolations of a dead centre, by the way to it.
const FOLDS: f64 = 1e-3;

/// The s of a dead centre just ahead of two points, s = s* − c (p − p*)²; `None` if they do not lie so. The path ends some
/// 1e-9 of a step before it, so that higher powers have no part in it.
fn fold([before, last]: [PathPoint; 2]) -> Option<f64> {
    let centre = last.p - last.g * (last.p - before.p) / (last.g - before.g);
    let ahead = |point: PathPoint| 0.5 * point.g * (centre - point.p);
    let s = last.s + ahead(last);
    let agree = (before.s + ahead(before) - s).abs()
        <= FOLDS * ahead(last).abs().max(f64::EPSILON * s.abs() / FOLDS);
    (agree && before.g.abs() > last.g.abs()).then_some(s)
}

/// The s at which a position lies at infinity: there p ≈ c/(s − s*), so that √|g| is linear in s.
fn asymptote(before: PathPoint, last: PathPoint) -> f64 {
    let (root, other) = (last.g.abs().sqrt(), before.g.abs().sqrt());
    last.s + root * (last.s - before.s) / (other - root)
}

/// The path with p = borderᵀ (q̃ − q̃₀) as its parameter: bordered Newton in (q̃, s).
struct BorderedPath<'a, 'b, 's> {
    walker: &'a mut Walker<'b, 's>,
    border: Vec<f64>,
    origin: Vec<f64>,
    entries: Vec<usize>,
    slots: Vec<u32>,
    pattern: Pattern,
    lu: SparseLu,
}

impl<'a, 'b, 's> BorderedPath<'a, 'b, 's> {
    fn new(walker: &'a mut Walker<'b, 's>, border: Vec<f64>, last: &Node) -> Self {
        let system = walker.driven.system;
        let n = system.n();
        let active = walker.driven.active_rows();
        let mut places = Vec::new();
        let mut entries = Vec::new();
        for (k, entry) in system.entries.iter().enumerate() {
            if let (Some(column), Ok(row)) =
                (entry.column(), active.binary_search(&(entry.row as usize)))
            {
                places.push((row, column as usize));
                entries.push(k);
            }
        }
        places.extend((0..n).map(|row| (row, n)));
        places.extend((0..n).map(|column| (n, column)));
        let (pattern, slots) = square(n + 1, &places);
        let lu = SparseLu::new(pattern.clone(), ColumnOrder::amd(&pattern));
        BorderedPath {
            walker,
            border,
            origin: last.q.clone(),
            entries,
            slots,
            pattern,
            lu,
        }
    }

    /// Solves for (q, s) at `p` from the guess in them; returns ds/dp.
    fn solve(&mut self, p: f64, q: &mut [f64], s: &mut f64) -> Option<f64> {
        let system = self.walker.driven.system;
        let (n, m) = (system.n(), system.m());
        let active = self.walker.driven.active_rows().to_vec();
        let unit = self.walker.unit();
        let mut rate = vec![0.0; m];
        let mut values = vec![0.0; self.pattern.entries()];
        for iteration in 0..MOST_ITERATIONS {
            self.walker.set(*s);
            let Walker { driven, inputs, .. } = &mut *self.walker;
            let evaluation = &mut driven.evaluation;
            evaluation.set_position(q);
            evaluation.eval_phi(system, inputs);
            evaluation.eval_jacobian(system, inputs);
            evaluation.eval_rate(system, inputs, &mut rate);
            let entry_values = self.entries.iter().map(|&k| {
                let entry = system.entries[k];
                let column = entry.column().unwrap_or(0) as usize;
                evaluation.jacobian[k] * system.column_scale(column)
                    / system.row_scale(entry.row as usize)
            });
            let last_column = active.iter().map(|&row| rate[row] / system.row_scale(row));
            let all = entry_values
                .chain(last_column)
                .chain(self.border.iter().copied());
            for (&slot, value) in self.slots.iter().zip(all) {
                values[slot as usize] = value;
            }
            self.lu.factor(&values).ok()?;
            let place: f64 = (0..n)
                .map(|k| self.border[k] * (q[k] - self.origin[k]) / system.column_scale(k))
                .sum();
            let mut step: Vec<f64> = active
                .iter()
                .map(|&row| -evaluation.phi[row] / system.row_scale(row))
                .chain([p - place])
                .collect();
            self.lu.solve(&mut step);
            for k in 0..n {
                q[k] += step[k] * system.column_scale(k);
            }
            *s += step[n];
            step[n] /= unit;
            if iteration > 0 && linkdyn_linear::math::max_abs(&step) < LAST_STEP {
                let mut tangent = vec![0.0; n + 1];
                tangent[n] = 1.0;
                self.lu.solve(&mut tangent);
                return Some(tangent[n]);
            }
        }
        None
    }
}
