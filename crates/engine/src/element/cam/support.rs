//! Support functions: how far from the cam's point the tangent with a normal lies.
//!
//! ```text
//! circle      p = c·n + R            p′ = c·t        p″ = −c·n
//! law         p = r_b + s(u)         p′ = −s′(u)     p″ = s″(u)          u = θ₁ − θ₂, α = angle of n − u
//! curve       p = c·n, c′·n = 0      p′ = c·t        p + p″ = 1/κ
//! ```

use super::curve::{Curve, held};
use crate::motion::{Jet, Pieces};
use linkdyn_linear::math::{Vec2, perp};
use std::f64::consts::TAU;

/// A support function, by the angle θ₂ − θ₁ of the follower in the cam.
#[derive(Debug, Clone)]
pub struct Support {
    form: SupportForm,
    /// Angle of n in the follower's frame \[rad\].
    normal: f64,
}

#[derive(Debug, Clone)]
enum SupportForm {
    Circle {
        centre: Vec2,
        radius: f64,
    },
    Law {
        base: f64,
        law: Pieces,
    },
    /// A convex curve, with parameters at equal steps of the normal's angle from −π on.
    Curve {
        curve: Curve,
        starts: Vec<f64>,
    },
}

/// Samples of the radius of curvature.
const SAMPLES: usize = 1440;
/// Places whose normal is tabulated.
const STARTS: usize = 256;

impl Support {
    /// Of a circle.
    pub fn circle(centre: Vec2, radius: f64, normal: Vec2) -> Self {
        Support::of(SupportForm::Circle { centre, radius }, normal)
    }

    /// Of the motion that a face gets.
    pub fn law(base: f64, law: Pieces, normal: Vec2) -> Self {
        Support::of(SupportForm::Law { base, law }, normal)
    }

    /// Of a curve; `None` if it is not convex: a face does not touch it in hollows.
    pub fn curve(curve: Curve, normal: Vec2) -> Option<Self> {
        let samples: Vec<(f64, f64, f64)> = curve.samples().collect();
        if samples.iter().any(|(.., curvature)| *curvature <= 0.0) {
            return None;
        }
        let nearest = |k: usize| {
            let wanted = TAU * k as f64 / STARTS as f64 - 0.5 * TAU;
            let off = |angle: f64| (angle - wanted - TAU * ((angle - wanted) / TAU).round()).abs();
            let nearest = samples.iter().min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
            nearest.map_or(0.0, |sample| sample.0)
        };
        let starts = (0..STARTS).map(nearest).collect();
        Some(Support::of(SupportForm::Curve { curve, starts }, normal))
    }

    fn of(form: SupportForm, normal: Vec2) -> Self {
        let normal = normal.y.atan2(normal.x);
        Support { form, normal }
    }

    /// n in the cam's frame at the angle θ₂ − θ₁.
    pub fn normal(&self, turned: f64) -> Vec2 {
        let (sin, cos) = (turned + self.normal).sin_cos();
        Vec2::new(cos, sin)
    }

    /// p, p′, p″ at the angle θ₂ − θ₁ of the follower in the cam \[rad\].
    pub fn jet(&self, turned: f64, stretch: Option<i32>) -> Jet {
        let alpha = turned + self.normal;
        match &self.form {
            SupportForm::Circle { centre, radius } => {
                let (sin, cos) = alpha.sin_cos();
                let n = Vec2::new(cos, sin);
                let across = centre.dot(&n);
                [across + radius, centre.dot(&perp(n)), -across]
            }
            SupportForm::Law { base, law } => {
                let [s, s1, s2] = held(law, -turned, stretch).0;
                [base + s, -s1, s2]
            }
            SupportForm::Curve { curve, starts } => {
                let part = alpha / TAU + 0.5;
                let k = ((part - part.floor()) * STARTS as f64).round() as usize;
                curve.support(alpha, starts[k % STARTS])
            }
        }
    }

    /// The law of the follower's motion, where it has breaks.
    pub(super) fn broken(&self) -> Option<&Pieces> {
        match &self.form {
            SupportForm::Law { law, .. } => Some(law).filter(|law| law.has_breaks()),
            SupportForm::Circle { .. } | SupportForm::Curve { .. } => None,
        }
    }

    /// The stretch between breaks at an angle, and how far beyond the one that is held \[rad\].
    pub(super) fn stretch(&self, turned: f64, stretch: Option<i32>) -> (i32, f64) {
        let beyond = |law: &Pieces| (law.stretch(-turned), held(law, -turned, stretch).1);
        self.broken().map_or((0, f64::NEG_INFINITY), beyond)
    }

    /// Where the radius of curvature is least: the angle θ₁ − θ₂, and the radius \[m\].
    pub fn least_radius(&self) -> (f64, f64) {
        let radius = |k: usize| {
            let angle = TAU * k as f64 / SAMPLES as f64;
            let [p, _, bend] = self.jet(-angle, None);
            (angle, p + bend)
        };
        (0..SAMPLES).map(radius).fold(
            (0.0, f64::MAX),
            |least, next| {
                if next.1 < least.1 { next } else { least }
            },
        )
    }
}
