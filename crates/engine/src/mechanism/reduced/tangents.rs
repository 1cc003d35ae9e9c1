//! Accelerations by the tangents of the independent coordinates: S, SᵀMS and its factor.

use crate::mechanism::driven::{Driven, Failure};
use crate::system::Inputs;
use linkdyn_linear::math::dot;
use linkdyn_linear::small::{cholesky, cholesky_solve};

/// A pivot of SᵀMS that loses more than this of its size means freedom without mass.
const MASSLESS: f64 = 1e-13;

/// S and what is made of it.
#[derive(Clone)]
pub(super) struct Tangents {
    n: usize,
    /// S, one tangent after the other (f × n).
    pub s: Vec<f64>,
    /// SᵀMS (f × f) and its factor.
    mass: Vec<f64>,
    /// Q − M a₀ (n); empty where there is but one tangent.
    balance: Vec<f64>,
    /// Sᵀ of a force, and what it changes (f).
    rates: Vec<f64>,
    /// M S of one tangent, where it is not zero: column and value; empty where there is but one tangent.
    momenta: Vec<(usize, f64)>,
    /// Drivers are at rest, so that all motion is that of the independent coordinates.
    still: bool,
}

impl Tangents {
    /// Of a mechanism.
    pub fn of(driven: &Driven) -> Self {
        let (n, f) = (driven.system.n(), driven.independent.len());
        let mut drivers = driven.system.drivers.iter();
        Tangents {
            n,
            s: vec![0.0; f * n],
            mass: vec![0.0; f * f],
            balance: vec![0.0; if f == 1 { 0 } else { n }],
            rates: vec![0.0; f],
            momenta: Vec::with_capacity(if f > 1 { n } else { 0 }),
            still: drivers.all(|driver| driver.is_still()),
        }
    }

    fn each(&self) -> impl Iterator<Item = &[f64]> {
        self.s.chunks_exact(self.n.max(1))
    }

    /// S, and v = S u̇ + v_t.
    pub fn velocity(&mut self, driven: &mut Driven, inputs: &Inputs, rates: &[f64], v: &mut [f64]) {
        if self.still {
            driven.tangents(&mut self.s);
            v.fill(0.0);
        } else {
            driven.tangents_and_drift(inputs, &mut self.s, v);
        }
        self.add(rates, v);
        driven.evaluation.set_velocity(v);
    }

    /// Adds S of rates.
    fn add(&self, rates: &[f64], to: &mut [f64]) {
        for (tangent, rate) in self.each().zip(rates) {
            to.iter_mut()
                .zip(tangent)
                .for_each(|(to, s)| *to += rate * s);
        }
    }

    /// a = S ü + a₀ from the a₀ that `a` has.
    pub fn accelerate(
        &mut self,
        driven: &Driven,
        force: &[f64],
        [a, accelerations]: [&mut [f64]; 2],
    ) -> Result<(), Failure> {
        let mass = &driven.system.mass;
        if let [rate] = accelerations {
            let [own, pull] = mass.along(&self.s, force, a);
            if own.is_nan() || own <= 0.0 {
                return Err(Failure::Singular);
            }
            self.mass[0] = own.sqrt();
            *rate = pull / own;
            let a = a.iter_mut().zip(&self.s);
            a.for_each(|(a, s)| *a += *rate * s);
            return Ok(());
        }
        mass.residual(force, a, &mut self.balance);
        let (n, f) = (self.n, accelerations.len());
        for (i, rate) in accelerations.iter_mut().enumerate() {
            let si = &self.s[i * n..(i + 1) * n];
            *rate = dot(si, &self.balance);
            // Motions of few bodies have few components.
            self.momenta.clear();
            self.momenta.extend(mass.momenta(si));
            for j in 0..=i {
                let sj = &self.s[j * n..(j + 1) * n];
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
        cholesky_solve(&self.mass, accelerations);
        self.add(accelerations, a);
        Ok(())
    }

    /// S (SᵀMS)⁻¹ Sᵀ of a force.
    pub fn respond(&mut self, force: &[f64], change: &mut [f64]) {
        let mut rates = std::mem::take(&mut self.rates);
        for (rate, tangent) in rates.iter_mut().zip(self.each()) {
            *rate = dot(tangent, force);
        }
        cholesky_solve(&self.mass, &mut rates);
        change.fill(0.0);
        self.add(&rates, change);
        self.rates = rates;
    }
}
