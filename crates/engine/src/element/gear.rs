//! Gear pair: two wheels on a carrier roll on each other at their pitch point.
//!
//! With r the ratio (negative for an external mesh), e the unit vector from the first wheel's centre to the second's, fixed
//! in the carrier, t = e⊥, ℓ the centre distance, d = P₂ − P₁ and β = (θ₂ − θ_c) − r (θ₁ − θ_c) of the meshed wheels:
//!
//! ```text
//! φ  = β + r θ₁ + (1 − r) (θ_c + t·d/ℓ) − θ₂                                             (1)  [rad]
//! J₁ = [−(1 − r) tᵀ/ℓ, r − (1 − r) e·ρ₁/ℓ]    J₂ = [(1 − r) tᵀ/ℓ, (1 − r) e·ρ₂/ℓ − 1]
//! J_c = [0, 0, (1 − r) (1 − e·d/ℓ)]
//! γ  = (1 − r)/ℓ · (ω_c² t·d + 2 ω_c e·ḋ + t·(ω₂² ρ₂ − ω₁² ρ₁))
//! ```
//!
//! Where revolute joints hold both centres on the carrier, d = ℓ e: the term t·d vanishes, what remains is
//! θ₂ − θ_c = r (θ₁ − θ_c) + β, and the carrier's entry is zero. The term is there for its derivatives: θ_c + t·d/ℓ is
//! the angle of the line of centres, so that J v = 0 says that the wheels have the same velocity along t in the pitch point
//! P₂ − R₂ e, R₂ = ℓ/(1 − r), R₁ = −r R₂ (signed: outside the line of centres where the mesh is internal), and Jᵀλ is the
//! pair of tangential forces there, nothing else. (Pitch point and Willis'
//! equation of planetary trains: Uicker, Pennock and Shigley, Theory of Machines and Mechanisms; the form of φ is ours.)
//!
//! With a clearance in a wheel's bearing the term follows the line of centres to first order in (eccentricity)/ℓ.
//!
//! λ is the moment of that force on the second wheel about its point, F = −λ/R₂ t the force. Teeth with pressure angle ψ
//! press the wheels apart by |F| tan ψ besides, along e: no motion or torque depends on it, and it is left out.

use super::algebra::Algebraic;
use super::{
    Axis, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope, abreast, mapped,
};
use crate::motion::Jet;
use linkdyn_linear::math::{Real, Vec2, Vector, perp};

/// Two wheels that mesh.
#[derive(Debug, Clone)]
pub struct Gear<T = f64> {
    /// Centres of the wheels.
    pub first: Marker<T>,
    /// The second wheel's centre.
    pub second: Marker<T>,
    /// The body that bears both.
    pub carrier: BodyId,
    /// e in the carrier's frame.
    pub axis: Vector<T>,
    /// ℓ \[m\].
    pub distance: T,
    /// r [–].
    pub ratio: T,
    /// β \[rad\].
    pub angle: T,
}

impl<T: Real> Gear<T> {
    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Gear<U> {
        Gear {
            first: self.first.map(number),
            second: self.second.map(number),
            carrier: self.carrier,
            axis: mapped(&self.axis, number),
            distance: number(self.distance),
            ratio: number(self.ratio),
            angle: number(self.angle),
        }
    }

    /// e and t.
    fn directions(&self, at: &Kinematics<T>) -> (Vector<T>, Vector<T>) {
        let e = at.poses[self.carrier.0].turn(self.axis);
        (e, perp(e))
    }

    /// d.
    fn span(&self, at: &Kinematics<T>) -> Vector<T> {
        self.second.place(at) - self.first.place(at)
    }

    /// (1 − r)/ℓ = 1/R₂ [1/m].
    fn curvature(&self) -> T {
        (T::one() - self.ratio) / self.distance
    }
}

impl<T: Real> Equations<T> for Gear<T> {
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]) {
        let theta = |body: BodyId| at.poses[body.0].theta;
        let (_, t) = self.directions(at);
        let line = theta(self.carrier) + t.dot(&self.span(at)) / self.distance;
        phi[0] = self.angle + self.ratio * theta(self.first.body) + (T::one() - self.ratio) * line
            - theta(self.second.body);
    }

    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]) {
        let (e, t) = self.directions(at);
        let k = self.curvature();
        let (rho1, rho2) = (self.first.rho(at), self.second.rho(at));
        values.copy_from_slice(&[
            -k * t.x,
            -k * t.y,
            self.ratio - k * e.dot(&rho1),
            k * t.x,
            k * t.y,
            k * e.dot(&rho2) - T::one(),
            T::one() - self.ratio - k * e.dot(&self.span(at)),
        ]);
    }

    fn rate(&self, _at: &Kinematics<T>, phi_t: &mut [T]) {
        phi_t.fill(T::zero());
    }

    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]) {
        let (e, t) = self.directions(at);
        let omega = at.twists[self.carrier.0].omega;
        let d_rate = self.second.velocity(at) - self.first.velocity(at);
        let turn = self.second.centripetal(at) - self.first.centripetal(at);
        let quadratic = omega * omega * t.dot(&self.span(at))
            + T::splat(2.0) * omega * e.dot(&d_rate)
            - t.dot(&turn);
        gamma[0] = self.curvature() * quadratic;
    }
}

impl Constraint for Gear {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Angle]
    }

    fn entries(&self) -> Vec<Entry> {
        let all = [Axis::X, Axis::Y, Axis::Theta];
        let of = |body: BodyId| all.map(|axis| (0, body, axis));
        let mut entries = [of(self.first.body), of(self.second.body)].concat();
        entries.push((0, self.carrier, Axis::Theta));
        entries
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        let turn = |body: BodyId| (body, Axis::Theta);
        let (a, b, c) = (
            turn(self.first.body),
            turn(self.second.body),
            turn(self.carrier),
        );
        let place = |body: BodyId| [Axis::X, Axis::Y].map(|axis| [(body, axis), c]);
        let mut bends = [place(self.first.body), place(self.second.body)].concat();
        bends.extend([[a, a], [a, c], [b, b], [b, c], [c, c]]);
        bends
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let (e, t) = self.directions(at);
        let k = self.curvature() * lambda[0];
        let (first, second) = (
            k * t.dot(&self.first.rho(at)),
            k * t.dot(&self.second.rho(at)),
        );
        let across = k * t.dot(&self.span(at));
        let e = e * k;
        values.copy_from_slice(&[
            e.x, e.y, -e.x, -e.y, first, -first, -second, second, -across,
        ]);
    }

    abreast!();

    fn algebra(&self, _drive: &[Jet]) -> Vec<Algebraic> {
        vec![Algebraic::Angles {
            first: self.first.body,
            second: self.second.body,
            carrier: self.carrier,
            ratio: self.ratio,
            angle: self.angle,
        }]
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        let (_, t) = self.directions(at);
        (t * (-self.curvature() * lambda[0]), lambda[0])
    }
}
