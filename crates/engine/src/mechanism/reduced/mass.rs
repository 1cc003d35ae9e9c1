//! SᵀMS, its factor, and what impulses change.

use super::Reduced;
use crate::mechanism::driven::Failure;
use linkdyn_linear::small::{cholesky, cholesky_solve};

impl Reduced<'_> {
    /// ü in `rhs`, from SᵀMS ü = Sᵀ b by Cholesky.
    pub(super) fn solve_freedom(&mut self) -> Result<(), Failure> {
        let mass = &self.driven.system.mass;
        let (n, f) = (self.q.len(), self.freedom());
        for i in 0..f {
            let si = &self.tangents[i * n..(i + 1) * n];
            self.rhs[i] = linkdyn_linear::math::dot(si, &self.balance);
            // Motions of few bodies have few components.
            self.momenta.clear();
            self.momenta.extend(mass.momenta(si));
            for j in 0..=i {
                let sj = &self.tangents[j * n..(j + 1) * n];
                self.mass[i * f + j] = self
                    .momenta
                    .iter()
                    .map(|&(column, momentum)| momentum * sj[column])
                    .sum();
            }
        }
        if !cholesky(&mut self.mass, f, MASSLESS) {
            return Err(Failure::Singular);
        }
        cholesky_solve(&self.mass, &mut self.rhs);
        Ok(())
    }

    /// What a generalized impulse P (n) changes at the point of the last evaluation: the rates u̇ (f), SᵀMS Δu̇ = Sᵀ P, and
    /// the velocities (n).
    pub fn impulsive_change(&self, impulse: &[f64], rates: &mut [f64], change: &mut [f64]) {
        let n = impulse.len().max(1);
        for (rate, tangent) in rates.iter_mut().zip(self.tangents.chunks_exact(n)) {
            *rate = linkdyn_linear::math::dot(tangent, impulse);
        }
        cholesky_solve(&self.mass, rates);
        change.fill(0.0);
        for (tangent, rate) in self.tangents.chunks_exact(n).zip(rates) {
            change
                .iter_mut()
                .zip(tangent)
                .for_each(|(v, s)| *v += *rate * s);
        }
    }
}

/// A pivot of SᵀMS that loses more than this of its size means freedom without mass.
const MASSLESS: f64 = 1e-13;
