//! Equations as polynomials: what all assemblies are found by.
//!
//! The place of a body is a complex number r = x + iy, its turn Θ = e^{iθ}. A point of it is at r + Θ s, s complex. With forms P, Q, linear in
//! the r and Θ of bodies, the rows of most constraints are one of
//!
//! ```text
//! Re P = 0      Im P = 0      Re(P Q̄) = 0      |P| = ℓ      θ₂ = θ₁ + β      θ₂ = κ θ₁ + (1 − κ) θ_c + β
//! ```

use super::coordinates::BodyId;
use linkdyn_linear::bilinear::Number;
use linkdyn_linear::math::Vec2;

/// What of a body a term of a form has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FormPart {
    /// r \[m\]
    Place,
    /// Θ
    Turn,
}

/// Σ c r or c Θ of bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearForm(pub Vec<(BodyId, FormPart, Number)>);

impl LinearForm {
    /// A constant: a part of the turn of the ground, which is 1.
    pub fn constant(value: Number) -> Self {
        LinearForm(vec![(BodyId::GROUND, FormPart::Turn, value)])
    }

    /// The place of a point of a body.
    pub fn point(body: BodyId, s: Vec2) -> Self {
        LinearForm(vec![
            (body, FormPart::Place, 1.0.into()),
            (body, FormPart::Turn, complex(s)),
        ])
    }

    /// A vector of a body, in the ground's axes.
    pub fn turned(body: BodyId, vector: Vec2) -> Self {
        LinearForm(vec![(body, FormPart::Turn, complex(vector))])
    }

    /// The form times a number.
    pub fn times(mut self, factor: Number) -> Self {
        self.0.iter_mut().for_each(|term| term.2 *= factor);
        self
    }

    /// The difference.
    pub fn minus(mut self, other: LinearForm) -> Self {
        self.0.extend(other.times(Number::from(-1.0)).0);
        self
    }
}

/// One row.
#[derive(Debug, Clone, PartialEq)]
pub enum Algebraic {
    /// Re P = 0.
    Real(LinearForm),
    /// Im P = 0, of the form of the row before.
    Imaginary(LinearForm),
    /// Re(P Q̄) = 0.
    Across(LinearForm, LinearForm),
    /// |P| = ℓ.
    Length(LinearForm, f64),
    /// θ₂ = κ θ₁ + (1 − κ) θ_c + β; of κ = 1 two bodies that turn alike.
    Angles {
        /// The body of θ₁.
        first: BodyId,
        /// The body of θ₂.
        second: BodyId,
        /// The body of θ_c.
        carrier: BodyId,
        /// κ
        ratio: f64,
        /// β \[rad\]
        angle: f64,
    },
}

impl Algebraic {
    /// P = 0, as of two points that coincide.
    pub fn zero(form: LinearForm) -> [Self; 2] {
        [Algebraic::Real(form.clone()), Algebraic::Imaginary(form)]
    }

    /// θ₂ = θ₁ + β.
    pub fn tied(first: BodyId, second: BodyId, angle: f64) -> Self {
        Algebraic::Angles {
            first,
            second,
            carrier: BodyId::GROUND,
            ratio: 1.0,
            angle,
        }
    }

    /// u·d = s for a unit vector u of a body.
    pub fn along(body: BodyId, u: Vec2, d: LinearForm, s: f64) -> Self {
        let u = LinearForm::turned(body, u);
        Algebraic::Across(d.minus(u.clone().times(s.into())), u)
    }
}

fn complex(vector: Vec2) -> Number {
    Number::new(vector.x, vector.y)
}
