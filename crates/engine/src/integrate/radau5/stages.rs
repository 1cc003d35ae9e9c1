//! The stages of a step of RADAU5: Jacobian, factors, Newton's iteration and error.

use super::{Age, Converged, ITERATIONS, Radau5};
use crate::integrate::control::{Rejection, finite, fourth_root, rms, weigh};
use crate::integrate::radau5_tableau::{ALPHA, BETA, C, E, GAMMA, T, T_INVERSE};
use crate::integrate::{Ode, Refused};
use linkdyn_linear::math::dot;

impl Radau5 {
    /// Evaluates f at `self.stage` into `self.room`.
    pub(super) fn eval(&mut self, ode: &mut dyn Ode, t: f64) -> Result<(), Rejection> {
        self.counters.evaluations += 1;
        ode.eval(t, &self.stage, &mut self.room)
            .and_then(|()| finite(&self.room))
            .map_err(|Refused| Rejection::Refused)
    }

    /// J by differences, each towards where the step h leads, or to the other side where that is refused.
    pub(super) fn differentiate(&mut self, ode: &mut dyn Ode, h: f64) -> Result<(), Rejection> {
        let (n, m) = (self.n, self.asked);
        self.counters.jacobians += 1;
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
                self.jacobian[i * m + j] = (self.room[i] - self.slope[i]) / delta;
            }
        }
        (self.age, self.factored) = (Age::Fresh, f64::NAN);
        Ok(())
    }

    /// Factors γ/h − J and [α/h − J, β/h; −β/h, α/h − J], of the rows and columns of what f depends on: the others are solved for
    /// one by one.
    pub(super) fn factor(&mut self, h: f64) -> Result<(), Rejection> {
        let n = self.asked;
        self.counters.factorisations += 1;
        let (real, complex) = (self.real.values(), self.complex.values());
        complex.fill(0.0);
        for i in 0..n {
            for j in 0..n {
                let entry = -self.jacobian[i * n + j];
                real[i * n + j] = entry;
                complex[i * 2 * n + j] = entry;
                complex[(i + n) * 2 * n + j + n] = entry;
            }
            real[i * n + i] += GAMMA / h;
            complex[i * 2 * n + i] += ALPHA / h;
            complex[(i + n) * 2 * n + i + n] += ALPHA / h;
            complex[i * 2 * n + i + n] = BETA / h;
            complex[(i + n) * 2 * n + i] = -BETA / h;
        }
        self.factored = f64::NAN;
        if !(self.real.factor() && self.complex.factor()) {
            return Err(Rejection::Error);
        }
        self.factored = h;
        Ok(())
    }

    /// Solves (γ/h − J) x = b.
    fn solve_real(&self, h: f64, b: &mut [f64]) {
        let m = self.asked;
        let (asked, others) = b.split_at_mut(m);
        self.real.solve(asked);
        for (k, b) in others.iter_mut().enumerate() {
            *b = (*b + dot(&self.jacobian[(m + k) * m..][..m], asked)) * h / GAMMA;
        }
    }

    /// Solves [α/h − J, β/h; −β/h, α/h − J] x = b.
    fn solve_complex(&mut self, h: f64, b: &mut [f64]) {
        let m = self.asked;
        let (real, imaginary) = b.split_at_mut(self.n);
        self.pair[..m].copy_from_slice(&real[..m]);
        self.pair[m..].copy_from_slice(&imaginary[..m]);
        self.complex.solve(&mut self.pair);
        real[..m].copy_from_slice(&self.pair[..m]);
        imaginary[..m].copy_from_slice(&self.pair[m..]);
        let part = h / (ALPHA * ALPHA + BETA * BETA);
        let others = real[m..].iter_mut().zip(&mut imaginary[m..]);
        for (k, (real, imaginary)) in others.enumerate() {
            let row = &self.jacobian[(m + k) * m..][..m];
            let a = *real + dot(row, &self.pair[..m]);
            let b = *imaginary + dot(row, &self.pair[m..]);
            *real = (ALPHA * a - BETA * b) * part;
            *imaginary = (ALPHA * b + BETA * a) * part;
        }
    }

    /// Stages from the last step's polynomial, and their transforms.
    pub(super) fn predict(&mut self, h: f64) {
        let n = self.n;
        for i in 0..n {
            for (stage, c) in C.into_iter().enumerate() {
                self.z[stage * n + i] = if self.taken == 0.0 {
                    0.0
                } else {
                    self.polynomial(i, c * h / self.taken)
                };
            }
        }
        transform(&T_INVERSE, &self.z, &mut self.w);
    }

    /// y(s) − y for the last step's component i, where s counts from its end in steps.
    pub(super) fn polynomial(&self, i: usize, s: f64) -> f64 {
        let n = self.n;
        let [first, second, third] = [self.dense[i], self.dense[n + i], self.dense[2 * n + i]];
        s * (first + (s - (C[1] - 1.0)) * (second + (s - (C[0] - 1.0)) * third))
    }

    /// Simplified Newton iteration for the stages of a step by h.
    pub(super) fn iterate(&mut self, ode: &mut dyn Ode, h: f64) -> Result<Converged, Rejection> {
        let n = self.n;
        self.predict(h);
        weigh(&self.tolerance, &self.y, &mut self.weights);
        let eta = self.eta.max(f64::EPSILON);
        self.eta = eta.sqrt() * fourth_root(eta);
        let (mut last, mut rate) = (f64::INFINITY, 0.0);
        for iteration in 1..=ITERATIONS {
            for (stage, c) in C.into_iter().enumerate() {
                let z = &self.z[stage * n..][..n];
                for ((to, y), z) in self.stage.iter_mut().zip(&self.y).zip(z) {
                    *to = y + z;
                }
                self.eval(ode, self.t + c * h)?;
                self.f[stage * n..][..n].copy_from_slice(&self.room);
            }
            // z is free until the correction is known
            transform(&T_INVERSE, &self.f, &mut self.z);
            for i in 0..n {
                let [a, b, c] = [self.w[i], self.w[n + i], self.w[2 * n + i]];
                self.z[i] -= GAMMA / h * a;
                self.z[n + i] -= (ALPHA * b + BETA * c) / h;
                self.z[2 * n + i] -= (ALPHA * c - BETA * b) / h;
            }
            let mut z = std::mem::take(&mut self.z);
            let (real, complex) = z.split_at_mut(n);
            self.solve_real(h, real);
            self.solve_complex(h, complex);
            self.z = z;
            let sum: f64 = self
                .z
                .chunks_exact(n)
                .map(|z| rms(z, &self.weights))
                .map(|norm| norm * norm)
                .sum();
            let norm = (sum / 3.0).sqrt();
            if !norm.is_finite() {
                return Err(Rejection::Error);
            }
            if iteration > 1 {
                rate = norm / last;
                let left = (iteration..ITERATIONS).fold(norm, |norm, _| norm * rate);
                if rate >= 0.99 || left / (1.0 - rate) > self.converged {
                    self.eta = 1.0;
                    return Err(Rejection::Error);
                }
                self.eta = rate / (1.0 - rate);
            }
            for (w, correction) in self.w.iter_mut().zip(&self.z) {
                *w += correction;
            }
            transform(&T, &self.w, &mut self.z);
            if self.eta * norm <= self.converged {
                return Ok(Converged {
                    iterations: iteration,
                    rate,
                });
            }
            last = norm;
        }
        Err(Rejection::Error)
    }

    /// Estimated error over the tolerance, for the stages found; `slope` is f at the start, or near it.
    pub(super) fn estimate(&mut self, h: f64, improved: bool) -> f64 {
        let n = self.n;
        let slope = if improved { &self.room } else { &self.slope };
        let mut f = std::mem::take(&mut self.f);
        let error = &mut f[..n];
        for i in 0..n {
            let stages: f64 = E
                .into_iter()
                .zip(self.z.iter().skip(i).step_by(n))
                .map(|(e, z)| e * z)
                .sum();
            error[i] = slope[i] + stages / h;
            let size = self.y[i].abs().max((self.y[i] + self.z[2 * n + i]).abs());
            self.weights[i] = 1.0 / (self.tolerance.atol[i] + self.tolerance.rtol * size);
        }
        self.solve_real(h, error);
        let size = rms(error, &self.weights);
        self.f = f;
        size
    }
}

/// Combines three vectors of n components by the rows of `matrix`.
fn transform(matrix: &[[f64; 3]; 3], from: &[f64], into: &mut [f64]) {
    let n = from.len() / 3;
    for (row, into) in matrix.iter().zip(into.chunks_exact_mut(n)) {
        for (i, into) in into.iter_mut().enumerate() {
            *into = row[0] * from[i] + row[1] * from[n + i] + row[2] * from[2 * n + i];
        }
    }
}
