//! The paper's own equations, written down a second time in its own coordinates: the angles θ2 … θ6 of its vectors and the
//! vectors r_a … r_g of its clearance links. Nothing of the engine's constraints, Jacobians or multipliers is used here.
//!
//! ```text
//! (11)  Φ₁ = r_a + l2 + r_b + l3 + r_c − l4 − r_g − l1 = 0                              [m]
//! (12)  Φ₂ = r_f + l6 − r_e + l5 − (l3b + r_c + l4b + r_d) = 0                          [m]
//! (10)  Q_p = Σ m (ẍ·∂x/∂p + g ∂y/∂p) + J θ̈ ∂θ/∂p                                      p = θ6 or a component of r
//!       ∂θ/∂p = −(∂Φ/∂θ)⁻¹ ∂Φ/∂p          θ = (θ2 … θ5)
//! ```
//!
//! r is journal centre − bearing centre, the bearing on the joint's first body; so r_e, which leads from link 5 to link 6,
//! is walked backwards in (12). Q of θ6 is the driving torque M_d (eq. 4 for r = 0), Q of the vector r_k is the force that
//! the first body exerts on the second at hinge k, and Q of the angle ψ_k of a clearance link is r_k⊥·Q_k = M_j, zero at
//! the fixed point.

use nalgebra::{SMatrix, SVector};

use super::document::broken;
use super::models::LINKS;
use crate::CaseError;
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_model::Model;

/// Angles θ2 … θ6 \[rad\].
pub type Angles = [f64; 5];
/// Vectors r_a … r_g \[m\].
pub type Offsets = [Vec2; 7];

type Jacobian = SMatrix<f64, 4, 4>;

/// Number of link 6 among the links.
const DRIVEN: usize = 4;
const A: usize = 0;
const B: usize = 1;
const C: usize = 2;
const D: usize = 3;
const E: usize = 4;
const F: usize = 5;
const G: usize = 6;

/// A vector sum: constant + Σ R(θ_j) p_j + Σ s_k r_k.
#[derive(Debug, Clone, Default)]
struct Walk {
    constant: Vec2,
    /// Link, vector in its frame.
    turned: Vec<(usize, Vec2)>,
    /// Hinge, sign.
    offsets: Vec<(usize, f64)>,
}

impl Walk {
    fn turn(mut self, link: usize, vector: Vec2) -> Self {
        self.turned.push((link, vector));
        self
    }

    fn hinge(mut self, hinge: usize, sign: f64) -> Self {
        self.offsets.push((hinge, sign));
        self
    }

    fn start(constant: Vec2) -> Self {
        Walk {
            constant,
            ..Walk::default()
        }
    }

    fn place(&self, theta: &Angles, r: &Offsets) -> Vec2 {
        let turned = self.turned.iter().map(|&(link, p)| turned(theta[link], p));
        let offsets = self.offsets.iter().map(|&(hinge, sign)| r[hinge] * sign);
        turned
            .chain(offsets)
            .fold(self.constant, |sum, part| sum + part)
    }

    /// ∂/∂θ of a link.
    fn by_angle(&self, theta: &Angles, link: usize) -> Vec2 {
        let parts = self.turned.iter().filter(|(of, _)| *of == link);
        parts.fold(Vec2::zeros(), |sum, &(_, p)| {
            sum + perp(turned(theta[link], p))
        })
    }

    /// ∂/∂r of a hinge, a multiple of the unit matrix.
    fn by_offset(&self, hinge: usize) -> f64 {
        self.offsets
            .iter()
            .filter(|(of, _)| *of == hinge)
            .map(|(_, sign)| sign)
            .sum()
    }
}

fn turned(angle: f64, p: Vec2) -> Vec2 {
    let (sin, cos) = angle.sin_cos();
    Vec2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y)
}

/// The lock in the paper's coordinates, hinges d = 4–5, e = 5–6, f = 3–6.
#[derive(Debug, Clone)]
pub struct Lock {
    mass: [f64; 5],
    inertia: [f64; 5],
    gravity: Vec2,
    /// Centres of mass.
    centres: [Walk; 5],
    loops: [Walk; 2],
}

/// Accelerations of the centres of mass and of the angles.
#[derive(Debug, Clone, Copy)]
pub struct Accelerations {
    pub centres: [Vec2; 5],
    pub angles: [f64; 5],
}

/// Generalized forces.
#[derive(Debug, Clone, Copy)]
pub struct Generalized {
    /// Q of θ6: the driving torque M_d [N·m].
    pub torque: f64,
    /// Q of r_a … r_g \[N\].
    pub forces: [Vec2; 7],
}

impl Lock {
    /// From the model's numbers.
    ///
    /// # Errors
    /// When a number is missing.
    pub fn new(model: &Model) -> Result<Self, CaseError> {
        let body = |k: usize| {
            model
                .bodies
                .get(LINKS[k])
                .ok_or_else(|| broken(format!("no body {}", LINKS[k])))
        };
        let point = |k: usize, name: &str| -> Result<Vec2, CaseError> {
            let p = body(k)?
                .points
                .get(name)
                .ok_or_else(|| broken(format!("no point {}.{name}", LINKS[k])))?;
            Ok(Vec2::new(p[0], p[1]))
        };
        let (mut mass, mut inertia, mut com) = ([0.0; 5], [0.0; 5], [Vec2::zeros(); 5]);
        for k in 0..5 {
            let body = body(k)?;
            let numbers = body.mass.zip(body.inertia).zip(body.com);
            let ((m, j), c) = numbers.ok_or_else(|| broken(format!("{} has no mass", LINKS[k])))?;
            (mass[k], inertia[k], com[k]) = (m, j, Vec2::new(c[0], c[1]));
        }
        let ground = model
            .bodies
            .get("ground")
            .and_then(|ground| ground.points.get("g"));
        let ground = ground
            .map(|p| Vec2::new(p[0], p[1]))
            .ok_or_else(|| broken("no point ground.g"))?;
        // Frames of binary links and the first joints of ternary ones are at their origins.
        let (b2, c3, f3) = (point(0, "b")?, point(1, "c")?, point(1, "f")?);
        let (c4, d4, d5, e6) = (
            point(2, "c")?,
            point(2, "d")?,
            point(3, "d")?,
            point(4, "e")?,
        );
        let link3 = Walk::default().hinge(A, 1.0).turn(0, b2).hinge(B, 1.0);
        let link4 = Walk::start(ground).hinge(G, 1.0);
        let link6 = link3.clone().turn(1, f3).hinge(F, 1.0);
        let link5 = link6.clone().turn(DRIVEN, e6).hinge(E, -1.0);
        let first = Walk {
            constant: -ground,
            ..link3.clone()
        };
        let first = first.turn(1, c3).hinge(C, 1.0).turn(2, -c4).hinge(G, -1.0);
        let second = Walk::default()
            .hinge(F, 1.0)
            .turn(DRIVEN, e6)
            .hinge(E, -1.0)
            .turn(3, d5);
        let second = second
            .turn(1, f3 - c3)
            .hinge(C, -1.0)
            .turn(2, c4 - d4)
            .hinge(D, -1.0);
        Ok(Lock {
            mass,
            inertia,
            gravity: Vec2::new(model.gravity[0], model.gravity[1]),
            centres: [
                Walk::default().hinge(A, 1.0).turn(0, com[0]),
                link3.turn(1, com[1]),
                link4.turn(2, com[2]),
                link5.turn(3, com[3]),
                link6.turn(DRIVEN, com[4]),
            ],
            loops: [first, second],
        })
    }

    /// Largest component of Φ₁, Φ₂ \[m\].
    pub fn residual(&self, theta: &Angles, r: &Offsets) -> f64 {
        self.loops
            .iter()
            .fold(0.0, |worst, walk| worst.max(walk.place(theta, r).amax()))
    }

    /// ∂Φ/∂(θ2 … θ5).
    fn jacobian(&self, theta: &Angles) -> Jacobian {
        Jacobian::from_fn(|row, link| self.loops[row / 2].by_angle(theta, link)[row % 2])
    }

    /// The seven hinge forces and M_d by virtual work (eqs 4 and 10).
    ///
    /// # Errors
    /// When the loops are singular.
    pub fn generalized(&self, theta: &Angles, a: &Accelerations) -> Result<Generalized, CaseError> {
        let lu = self.jacobian(theta).full_piv_lu();
        let solve = |rhs: SVector<f64, 4>| {
            lu.solve(&rhs)
                .ok_or_else(|| broken("the loops are singular"))
        };
        let inertial = |k: usize| (a.centres[k] - self.gravity) * self.mass[k];
        // By an explicit change of each centre of mass and the angles that follow.
        let work =
            |angles: SVector<f64, 4>, driven: f64, explicit: &dyn Fn(&Walk) -> Vec2| -> f64 {
                let mut sum = 0.0;
                for (k, walk) in self.centres.iter().enumerate() {
                    let mut moved = explicit(walk) + walk.by_angle(theta, DRIVEN) * driven;
                    for link in 0..4 {
                        moved += walk.by_angle(theta, link) * angles[link];
                    }
                    let turned = if k == DRIVEN { driven } else { angles[k] };
                    sum += inertial(k).dot(&moved) + self.inertia[k] * a.angles[k] * turned;
                }
                sum
            };
        let by_driven =
            SVector::from_fn(|row, _| -self.loops[row / 2].by_angle(theta, DRIVEN)[row % 2]);
        let torque = work(solve(by_driven)?, 1.0, &|_| Vec2::zeros());
        let mut forces = [Vec2::zeros(); 7];
        for (hinge, force) in forces.iter_mut().enumerate() {
            for axis in 0..2 {
                let by_offset = |row: usize| {
                    if row % 2 == axis {
                        self.loops[row / 2].by_offset(hinge)
                    } else {
                        0.0
                    }
                };
                let angles = solve(SVector::from_fn(|row, _| -by_offset(row)))?;
                force[axis] = work(angles, 0.0, &|walk| {
                    let mut unit = Vec2::zeros();
                    unit[axis] = walk.by_offset(hinge);
                    unit
                });
            }
        }
        Ok(Generalized { torque, forces })
    }

    /// Closes the loops with `r`, the vectors growing from zero; `None` if the branch of `ideal` ends before (eqs 11, 12).
    pub fn close(&self, ideal: &Angles, r: &Offsets) -> Option<Angles> {
        let side = self.jacobian(ideal).determinant().signum();
        let (mut part, mut step) = (0.0, 0.1);
        let mut theta = *ideal;
        while part < 1.0 {
            let next = if part + step >= 1.0 { 1.0 } else { part + step };
            let grown = r.map(|r| r * next);
            match self.newton(&theta, &grown) {
                // A determinant of the other sign is the other branch.
                Some(found) if self.jacobian(&found).determinant().signum() == side => {
                    theta = found;
                    part = next;
                    step *= 1.5;
                }
                Some(_) | None => step *= 0.5,
            }
            if step < 1e-9 {
                return None;
            }
        }
        Some(theta)
    }

    /// Newton's iteration on Φ = 0 for θ2 … θ5, from close by.
    fn newton(&self, start: &Angles, r: &Offsets) -> Option<Angles> {
        let mut theta = *start;
        let mut last = f64::INFINITY;
        for _ in 0..30 {
            let phi =
                SVector::<f64, 4>::from_fn(|row, _| -self.loops[row / 2].place(&theta, r)[row % 2]);
            let step = self.jacobian(&theta).full_piv_lu().solve(&phi)?;
            let size = step.amax();
            if size.is_nan() || (size > 0.25 * last && size > 1e-11) {
                return None;
            }
            theta
                .iter_mut()
                .zip(step.iter())
                .for_each(|(theta, step)| *theta += step);
            if size <= 1e-13 {
                break;
            }
            last = size;
        }
        Some(theta)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lock::models::{Request, run};
    use linkdyn_engine::analysis::Control;

    fn lock() -> Lock {
        let document = Request::ideal(5.0).document().expect("a model");
        let (model, _) = run(&document, &Control::default()).expect("runs");
        Lock::new(&model).expect("the lock")
    }

    #[test]
    fn virtual_work_matches_differences_of_the_closed_loops() {
        // Without gravity and acceleration of rotation, with ẍ = 1 everywhere, Q is the derivative of Σ m x.
        let mut lock = lock();
        lock.gravity = Vec2::zeros();
        let a = Accelerations {
            centres: [Vec2::new(1.0, 0.0); 5],
            angles: [0.0; 5],
        };
        let guess = [41.09, -8.01, 25.75, 103.01, -50.0].map(f64::to_radians);
        let mut r = [Vec2::new(1e-4, 2e-4); 7];
        let theta = lock.newton(&guess, &r).expect("closes");
        let found = lock.generalized(&theta, &a).expect("regular");
        let sum = |theta: &Angles, r: &Offsets| -> f64 {
            (0..5)
                .map(|k| lock.mass[k] * lock.centres[k].place(theta, r).x)
                .sum()
        };
        let h = 1e-5;
        let mut shifted = |hinge: usize, axis: usize, by: f64| {
            r[hinge][axis] += by;
            let moved = sum(&lock.newton(&theta, &r).expect("closes"), &r);
            r[hinge][axis] -= by;
            moved
        };
        for hinge in 0..7 {
            for axis in 0..2 {
                let difference = (shifted(hinge, axis, h) - shifted(hinge, axis, -h)) / (2.0 * h);
                let ours = found.forces[hinge][axis];
                assert!(
                    (difference - ours).abs() < 1e-6,
                    "{hinge} {axis}: {difference} {ours}"
                );
            }
        }
        let at = |by: f64| {
            let mut guess = theta;
            guess[DRIVEN] += by;
            sum(&lock.newton(&guess, &r).expect("closes"), &r)
        };
        let difference = (at(h) - at(-h)) / (2.0 * h);
        assert!(
            (difference - found.torque).abs() < 1e-6,
            "{difference} {}",
            found.torque
        );
    }
}
