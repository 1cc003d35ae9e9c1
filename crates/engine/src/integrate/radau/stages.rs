//! The stages of a step: factors, Newton's iteration, error, and the polynomial through them.

use super::{Age, Converged, ITERATIONS, MOST, Radau};
use crate::integrate::control::{Rejection, finite, fourth_root, rms, weigh};
use crate::integrate::radau_tableau::TABLEAUS;
use crate::integrate::{Ode, Refused};

impl Radau {
    /// Evaluates f at `self.stage` into `self.room`.
    pub(super) fn eval(&mut self, ode: &mut dyn Ode, t: f64) -> Result<(), Rejection> {
        self.counters.evaluations += 1;
        ode.eval(t, &self.stage, &mut self.room)
            .and_then(|()| finite(&self.room))
            .map_err(|Refused| Rejection::Refused)
    }

    /// J at the last accepted point: by the equations, or by differences.
    pub(super) fn linearise(&mut self, ode: &mut dyn Ode, h: f64) -> Result<(), Rejection> {
        self.counters.jacobians += 1;
        match ode.implicit() {
            Some(own) => own.linearise().map_err(|Refused| Rejection::Refused)?,
            None => self.differentiate(ode, h)?,
        }
        (self.age, self.factored) = (Age::Fresh, None);
        Ok(())
    }

    /// J by differences, each towards where the step h leads, or to the other side where that is refused.
    fn differentiate(&mut self, ode: &mut dyn Ode, h: f64) -> Result<(), Rejection> {
        let (n, m) = (self.dense.n, self.dense.m);
        for j in 0..m {
            let moved = h * self.slope[j];
            let size = self.y[j]
                .abs()
                .max(moved.abs())
                .max(self.given.atol[j] / self.given.rtol);
            let delta = (f64::EPSILON.sqrt() * size).copysign(moved);
            self.stage.copy_from_slice(&self.y);
            self.stage[j] = self.y[j] + delta;
            if self.eval(ode, self.t).is_err() {
                self.stage[j] = self.y[j] - delta;
                self.eval(ode, self.t)?;
            }
            let delta = self.stage[j] - self.y[j];
            for i in 0..n {
                self.dense.jacobian[i * m + j] = (self.room[i] - self.slope[i]) / delta;
            }
        }
        Ok(())
    }

    /// Makes ready to solve with s − J, of one real s and of complex ones; false where it can't.
    pub(super) fn factor_systems(
        &mut self,
        ode: &mut dyn Ode,
        real: f64,
        complex: &[[f64; 2]],
    ) -> bool {
        match ode.implicit() {
            Some(own) => own.factor(real, complex),
            None => self.dense.factor(real, complex[0]),
        }
    }

    /// Factors γ/h − J and (α − iβ)/h − J.
    pub(super) fn factor(&mut self, ode: &mut dyn Ode, h: f64) -> Result<(), Rejection> {
        self.counters.factorisations += 1;
        self.factored = None;
        let tableau = self.tableau();
        let mut shifts = [[0.0; 2]; 3];
        let shifts = &mut shifts[..tableau.pairs.len()];
        for (shift, [alpha, beta]) in shifts.iter_mut().zip(tableau.pairs) {
            *shift = [alpha / h, -beta / h];
        }
        if !self.factor_systems(ode, tableau.gamma / h, shifts) {
            return Err(Rejection::Error);
        }
        self.factored = Some((h, self.order));
        Ok(())
    }

    /// Stages from the last step's polynomial, and their transforms.
    fn predict(&mut self, h: f64) {
        let (n, tableau) = (self.n, self.tableau());
        let mut z = std::mem::take(&mut self.z);
        for (z, c) in z.chunks_exact_mut(n.max(1)).zip(tableau.c) {
            if self.taken == 0.0 {
                z.fill(0.0);
            } else {
                self.polynomial(c * h / self.taken, z);
            }
        }
        self.z = z;
        transform(tableau.t_inverse, tableau.stages, &self.z, &mut self.w);
    }

    /// The abscissae of the last step's divided differences, from its end in steps: that, the stages before it, its beginning.
    fn node(&self, k: usize) -> f64 {
        let tableau = &TABLEAUS[self.order_taken];
        match tableau.stages - k {
            0 => -1.0,
            left => tableau.c[left - 1] - 1.0,
        }
    }

    /// y(s) − y for the last step, where s counts from its end in steps.
    pub(super) fn polynomial(&self, s: f64, to: &mut [f64]) {
        let (n, stages) = (self.n, TABLEAUS[self.order_taken].stages);
        to.copy_from_slice(&self.differences[(stages - 1) * n..][..n]);
        for k in (0..stages).rev() {
            let by = s - self.node(k);
            if k == 0 {
                to.iter_mut().for_each(|to| *to *= by);
            } else {
                let lower = &self.differences[(k - 1) * n..][..n];
                to.iter_mut()
                    .zip(lower)
                    .for_each(|(to, d)| *to = d + by * *to);
            }
        }
    }

    /// Divided differences of the polynomial through the beginning and the stages.
    pub(super) fn interpolate_stages(&mut self) {
        let (n, stages) = (self.n, self.tableau().stages);
        self.order_taken = self.order;
        // Values from the end backwards, less that at the end, which is zero itself.
        let last = (stages - 1) * n;
        let end = &self.z[last..][..n];
        for k in 1..=stages {
            let dense = self.differences[(k - 1) * n..][..n].iter_mut().zip(end);
            match stages - k {
                0 => dense.for_each(|(d, end)| *d = 0.0 - end),
                left => {
                    let z = &self.z[(left - 1) * n..][..n];
                    dense.zip(z).for_each(|((d, end), z)| *d = z - end);
                }
            }
        }
        for width in 1..=stages {
            for k in (width..=stages).rev() {
                let over = 1.0 / (self.node(k) - self.node(k - width));
                let (before, here) = self.differences.split_at_mut((k - 1) * n);
                let here = &mut here[..n];
                if k > 1 {
                    let lower = here.iter_mut().zip(&before[(k - 2) * n..]);
                    lower.for_each(|(d, low)| *d = (*d - low) * over);
                } else {
                    here.iter_mut().for_each(|d| *d *= over);
                }
            }
        }
    }

    /// Simplified Newton iteration for the stages of a step by h.
    pub(super) fn iterate(&mut self, ode: &mut dyn Ode, h: f64) -> Result<Converged, Rejection> {
        let (tableau, most) = (self.tableau(), ITERATIONS[self.order]);
        self.predict(h);
        weigh(&self.tolerance, &self.y, &mut self.weights);
        let eta = self.eta.max(f64::EPSILON);
        self.eta = eta.sqrt() * fourth_root(eta);
        let (mut last, mut rate, mut mean) = (f64::INFINITY, 0.0_f64, 0.0);
        for iteration in 1..=most {
            self.eval_stages(ode, h, iteration == 1)?;
            let norm = self.correct(ode, h);
            if !norm.is_finite() {
                return Err(Rejection::Error);
            }
            if iteration > 1 {
                let before = rate;
                rate = norm / last;
                mean = if iteration == 2 {
                    rate
                } else {
                    (rate * before).sqrt()
                };
                let left = (iteration..most).fold(norm, |norm, _| norm * rate);
                if rate >= 0.99 || left / (1.0 - rate) > self.converged {
                    self.eta = 1.0;
                    return Err(Rejection::Error);
                }
                self.eta = rate / (1.0 - rate);
            }
            let used = tableau.stages * self.n;
            for (w, correction) in self.w[..used].iter_mut().zip(&self.z) {
                *w += correction;
            }
            transform(tableau.t, tableau.stages, &self.w, &mut self.z);
            if self.eta * norm <= self.converged {
                return Ok(Converged {
                    iterations: iteration,
                    rate,
                    mean,
                });
            }
            last = norm;
        }
        Err(Rejection::Error)
    }

    /// Slopes of the stages at hand.
    fn eval_stages(&mut self, ode: &mut dyn Ode, h: f64, first: bool) -> Result<(), Rejection> {
        let n = self.n;
        for (stage, c) in self.tableau().c.iter().enumerate() {
            let z = &self.z[stage * n..][..n];
            for ((to, y), z) in self.stage.iter_mut().zip(&self.y).zip(z) {
                *to = y + z;
            }
            let slope = &mut self.f[stage * n..][..n];
            self.counters.evaluations += 1;
            let t = self.t + c * h;
            match ode.implicit() {
                Some(own) => own.eval_stage((stage, first), t, &self.stage, slope),
                None => ode.eval(t, &self.stage, slope),
            }
            .and_then(|()| finite(slope))
            .map_err(|Refused| Rejection::Refused)?;
        }
        Ok(())
    }

    /// Newton's correction of W into z, and its norm.
    fn correct(&mut self, ode: &mut dyn Ode, h: f64) -> f64 {
        let (n, tableau) = (self.n, self.tableau());
        // z is free until the correction is known
        transform(tableau.t_inverse, tableau.stages, &self.f, &mut self.z);
        let by = tableau.gamma / h;
        let (real, pairs) = self.z[..tableau.stages * n].split_at_mut(n);
        real.iter_mut().zip(&self.w).for_each(|(z, w)| *z -= by * w);
        match ode.implicit() {
            Some(own) => own.solve(real),
            None => self.dense.solve(real),
        }
        for (pair, [alpha, beta]) in tableau.pairs.iter().enumerate() {
            let at = 2 * pair * n;
            let (b, c) = pairs[at..at + 2 * n].split_at_mut(n);
            let (of_b, of_c) = self.w[n + at..n + at + 2 * n].split_at(n);
            for (((b, c), of_b), of_c) in b.iter_mut().zip(&mut *c).zip(of_b).zip(of_c) {
                *b -= (alpha * of_b + beta * of_c) / h;
                *c -= (alpha * of_c - beta * of_b) / h;
            }
            match ode.implicit() {
                Some(own) => own.solve_complex(pair, [b, c]),
                None => self.dense.solve_complex([b, c]),
            }
        }
        let parts = self.z[..tableau.stages * n].chunks_exact(n.max(1));
        let sum: f64 = parts
            .map(|z| rms(z, &self.weights))
            .map(|norm| norm * norm)
            .sum();
        (sum / tableau.stages as f64).sqrt()
    }

    /// Estimated error over the tolerance, for the stages found; `slope` is f at the start, or near it.
    pub(super) fn estimate(&mut self, ode: &mut dyn Ode, h: f64, improved: bool) -> f64 {
        let (n, tableau) = (self.n, self.tableau());
        let error = &mut self.f[..n];
        error.fill(0.0);
        for (e, z) in tableau.e.iter().zip(self.z.chunks_exact(n.max(1))) {
            let by = e / h;
            error.iter_mut().zip(z).for_each(|(to, z)| *to += by * z);
        }
        let slope = if improved { &self.room } else { &self.slope };
        error.iter_mut().zip(slope).for_each(|(to, f)| *to += f);
        let last = &self.z[(tableau.stages - 1) * n..];
        for (i, weight) in self.weights.iter_mut().enumerate() {
            let size = self.y[i].abs().max((self.y[i] + last[i]).abs());
            *weight = 1.0 / self.tolerance.bound(i, size);
        }
        match ode.implicit() {
            Some(own) => own.solve(error),
            None => self.dense.solve(error),
        }
        rms(error, &self.weights)
    }
}

/// Combines vectors of n components, as many as there are rows, by the rows of `matrix`.
fn transform(matrix: &[f64], rows: usize, from: &[f64], into: &mut [f64]) {
    match rows {
        3 => combine::<3>(matrix, from, into),
        5 => combine::<5>(matrix, from, into),
        _ => combine::<MOST>(matrix, from, into),
    }
}

/// The same for S of them: a component is summed up before the next one, so that sums need not be stored in between.
fn combine<const S: usize>(matrix: &[f64], from: &[f64], into: &mut [f64]) {
    let n = from.len() / MOST;
    let from: [&[f64]; S] = std::array::from_fn(|stage| &from[stage * n..][..n]);
    let rows = matrix.as_chunks::<S>().0.iter();
    for (row, into) in rows.zip(into.chunks_exact_mut(n.max(1))) {
        for (i, into) in into.iter_mut().enumerate().take(n) {
            let mut sum = 0.0;
            for (by, from) in row.iter().zip(&from) {
                sum += by * from[i];
            }
            *into = sum;
        }
    }
}
