//! Cam and follower: the profile of the first body touches what the second has at its point, and holds it from both sides.
//!
//! With C the cam's point, F the follower's, w = F − C, n the unit normal of the profile in the contact towards the follower,
//! t = n⊥, and of the profile, in the cam's frame about C, the support function p(α) or the signed distance D(x):
//!
//! ```text
//! flat face     φ = p(α) − n·w            n fixed in the follower, α = θ₂ + angle of n − θ₁        (1)  [m]
//!               J₁ = [nᵀ, n·ρ₁⊥ − p′]     J₂ = [−nᵀ, −n·ρ₂⊥ − t·w + p′]
//!               γ  = n·(ω₁² ρ₁ − ω₂² ρ₂ − ω₂² w) + 2 ω₂ t·ẇ − p″ (ω₂ − ω₁)²
//! roller, edge  φ = r − D(x)              x = Aᵀ(θ₁) w, r the radius of a roller                   (2)  [m]
//!               J₁ = [nᵀ, n·(F − r₁)⊥]    J₂ = [−nᵀ, −n·ρ₂⊥]
//!               γ  = n·(ω₁² ρ₁ − ω₂² ρ₂ − 2 ω₁ ẇ⊥ − ω₁² w) + κ (t·(ẇ − ω₁ w⊥))²
//! ```
//!
//! The face touches at C + p n + p′ t, where the radius of curvature is p + p″. D is measured along the normal to the foot of F
//! on the curve, which is the profile, or, where the motion of F is given, the curve of F itself, with r = 0 in (2). Its
//! gradient is the unit vector n, its second derivative κ t tᵀ, κ = κ_c/(1 + κ_c D) with the curvature κ_c at the foot. So Jᵀλ
//! is the force λ n in the contact, nothing else, and λ is its size: it is negative where the contact would have to pull.
//!
//! (Support functions: Norton, Cam Design and Manufacturing Handbook, 2009, ch. 7, whose law of a flat follower is p; parallel
//! curves: do Carmo, Differential Geometry of Curves and Surfaces, 1976, § 1-7. The form of φ is ours.)

pub mod curve;
mod seen;
mod support;
#[cfg(test)]
pub(crate) mod tests;

pub use curve::Curve;
pub use seen::Meeting;
pub use support::Support;

use super::{Axis, BodyId, Constraint, Entry, Equations, Kinematics, Marker, Measure, Slope};
use linkdyn_linear::math::{Vec2, perp};
use std::sync::Arc;

/// What touches the profile.
#[derive(Debug, Clone)]
pub enum Touch {
    /// A straight face.
    Face {
        /// n in the follower's frame.
        normal: Vec2,
        /// Of the profile.
        support: Arc<Support>,
    },
    /// A roller, or an edge.
    Round {
        /// r \[m\]; 0 of an edge.
        radius: f64,
        /// The profile, or the curve of the follower's point.
        curve: Arc<Curve>,
    },
}

/// How the follower is guided, for its pressure angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Way {
    /// Along an axis fixed in a body.
    Slide(BodyId, Vec2),
    /// About a point, borne by a body.
    Swing(Marker, BodyId),
}

/// A cam and its follower.
#[derive(Debug, Clone)]
pub struct Cam {
    /// C.
    pub cam: Marker,
    /// F.
    pub follower: Marker,
    /// What touches.
    pub touch: Touch,
    /// How the follower is guided, where that is known.
    pub way: Option<Way>,
    /// Index of its law's stretch in [`Kinematics::sides`], from the last one on; `None` if the law has no breaks.
    pub kink: Option<usize>,
}

/// φ and its derivatives at a position: all that the rows are made of.
struct Local {
    n: Vec2,
    w: Vec2,
    phi: f64,
    /// p′ of a face.
    along: f64,
    /// p″ of a face, −κ of what is round.
    bend: f64,
    is_face: bool,
}

impl Cam {
    /// θ₂ − θ₁ \[rad\].
    fn turned(&self, at: &Kinematics) -> f64 {
        at.poses[self.follower.body.0].theta - at.poses[self.cam.body.0].theta
    }

    /// Whether the motion that makes the profile has breaks: where derivatives of the law jump.
    pub fn has_breaks(&self) -> bool {
        let law = match &self.touch {
            Touch::Face { support, .. } => support.broken(),
            Touch::Round { curve, .. } => curve.broken(),
        };
        law.is_some()
    }

    /// The place of its stretch among the sides that are held.
    fn side(&self, sides: &[i32]) -> Option<usize> {
        sides.len().checked_sub(1 + self.kink?)
    }

    /// The stretch of the law that is held.
    fn held(&self, at: &Kinematics) -> Option<i32> {
        self.side(at.sides).map(|side| at.sides[side])
    }

    /// The stretch between breaks on which it is, and how far beyond the one that is held \[rad\].
    fn stretch(&self, at: &Kinematics) -> (i32, f64) {
        let held = self.held(at);
        match &self.touch {
            Touch::Face { support, .. } => support.stretch(self.turned(at), held),
            Touch::Round { curve, .. } => {
                let w = self.follower.place(at) - self.cam.place(at);
                curve.stretch(self.seen(at, w), held)
            }
        }
    }

    /// Takes the stretch between breaks on which it is.
    pub fn take_side(&self, at: &Kinematics, sides: &mut [i32]) {
        if let Some(side) = self.side(sides) {
            sides[side] = self.stretch(at).0;
        }
    }

    /// How far beyond the stretch that is held it is \[rad\].
    pub fn beyond(&self, at: &Kinematics) -> f64 {
        match self.kink {
            Some(_) => self.stretch(at).1,
            None => f64::NEG_INFINITY,
        }
    }

    /// w in the cam's frame.
    fn seen(&self, at: &Kinematics, w: Vec2) -> Vec2 {
        let pose = &at.poses[self.cam.body.0];
        Vec2::new(
            pose.cos * w.x + pose.sin * w.y,
            pose.cos * w.y - pose.sin * w.x,
        )
    }

    fn local(&self, at: &Kinematics) -> Local {
        let w = self.follower.place(at) - self.cam.place(at);
        match &self.touch {
            Touch::Face { normal, support } => {
                let n = at.poses[self.follower.body.0].turn(*normal);
                let [p, along, bend] = support.jet(self.turned(at), self.held(at));
                Local {
                    n,
                    w,
                    phi: p - n.dot(&w),
                    along,
                    bend,
                    is_face: true,
                }
            }
            Touch::Round { radius, curve } => {
                let foot = curve.foot(self.seen(at, w), self.held(at));
                let reach = if curve.is_pitch() { 0.0 } else { *radius };
                Local {
                    n: at.poses[self.cam.body.0].turn(foot.normal),
                    w,
                    phi: reach - foot.distance,
                    along: 0.0,
                    bend: -foot.bend(),
                    is_face: false,
                }
            }
        }
    }

    /// Whether a face touches: its force acts beside the follower's point.
    pub fn is_face(&self) -> bool {
        matches!(self.touch, Touch::Face { .. })
    }
}

/// 1/x, finite.
fn inverse(x: f64) -> f64 {
    let found = 1.0 / x;
    if found.is_finite() {
        found
    } else {
        f64::MAX.sqrt().copysign(x)
    }
}

/// Coordinates of both bodies, in the order of the entries.
const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Theta];

/// A number of two bodies' coordinates on which the rows depend.
const COORDINATES: usize = 6;

/// Pairs of these.
fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..COORDINATES).flat_map(|i| (i..COORDINATES).map(move |j| (i, j)))
}

impl Cam {
    /// ∂w/∂q, of what is round A ∂x/∂q: for the coordinates of both bodies.
    fn shifts(&self, at: &Kinematics, local: &Local) -> [Vec2; COORDINATES] {
        let (rho1, rho2) = (self.cam.rho(at), self.follower.rho(at));
        let own = if local.is_face { rho1 } else { rho1 + local.w };
        [
            -Vec2::x(),
            -Vec2::y(),
            -perp(own),
            Vec2::x(),
            Vec2::y(),
            perp(rho2),
        ]
    }
}

impl Equations for Cam {
    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        phi[0] = self.local(at).phi;
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        let local = self.local(at);
        let shifts = self.shifts(at, &local);
        for (value, shift) in values.iter_mut().zip(shifts) {
            *value = -local.n.dot(&shift);
        }
        if local.is_face {
            values[2] -= local.along;
            values[5] += local.along - perp(local.n).dot(&local.w);
        }
    }

    fn rate(&self, _at: &Kinematics, phi_t: &mut [f64]) {
        phi_t.fill(0.0);
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let local = self.local(at);
        let (n, t) = (local.n, perp(local.n));
        let [first, second] = [self.cam.omega(at), self.follower.omega(at)];
        let rate = self.follower.velocity(at) - self.cam.velocity(at);
        let drift = self.follower.centripetal(at) - self.cam.centripetal(at);
        gamma[0] = if local.is_face {
            let turning = second - first;
            n.dot(&drift) - second * second * n.dot(&local.w) + 2.0 * second * t.dot(&rate)
                - local.bend * turning * turning
        } else {
            let slip = t.dot(&(rate - perp(local.w) * first));
            n.dot(&drift)
                - 2.0 * first * n.dot(&perp(rate))
                - first * first * n.dot(&local.w)
                - local.bend * slip * slip
        };
    }
}

impl Constraint for Cam {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        let of = |body: BodyId| AXES.map(|axis| (0, body, axis));
        [of(self.cam.body), of(self.follower.body)].concat()
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        let coordinate = |k: usize| {
            let marker = if k < AXES.len() {
                self.cam
            } else {
                self.follower
            };
            (marker.body, AXES[k % AXES.len()])
        };
        pairs()
            .map(|(i, j)| [coordinate(i), coordinate(j)])
            .collect()
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let local = self.local(at);
        let shifts = self.shifts(at, &local);
        let (n, t) = (local.n, perp(local.n));
        let (rho1, rho2) = (self.cam.rho(at), self.follower.rho(at));
        for (value, (i, j)) in values.iter_mut().zip(pairs()) {
            // ∂²w of a face, A ∂²x of what is round: only angles bend
            let mut second = match (i, j) {
                (5, 5) => -n.dot(&rho2),
                (2, 2) if local.is_face => n.dot(&rho1),
                (2, 2) => -n.dot(&(rho1 + local.w)),
                _ => 0.0,
            };
            if local.is_face {
                let turn = |k: usize| f64::from(u8::from(k == 5));
                let alpha = |k: usize| turn(k) - f64::from(u8::from(k == 2));
                second += turn(i) * t.dot(&shifts[j]) + turn(j) * t.dot(&shifts[i])
                    - turn(i) * turn(j) * n.dot(&local.w)
                    - local.bend * alpha(i) * alpha(j);
            } else {
                // x turns back with the cam
                for (own, other) in [(i, j), (j, i)] {
                    if own == 2 && other != 2 {
                        second -= n.dot(&perp(shifts[other]));
                    }
                }
                second -= local.bend * t.dot(&shifts[i]) * t.dot(&shifts[j]);
            }
            *value = -lambda[0] * second;
        }
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        let local = self.local(at);
        let torque = if local.is_face {
            perp(local.n).dot(&local.w) - local.along
        } else {
            0.0
        };
        (local.n * lambda[0], torque * lambda[0])
    }

    fn between(&self, id: &dyn Fn(BodyId) -> BodyId) -> Option<Arc<dyn Constraint>> {
        Some(Arc::new(Cam {
            cam: self.cam.of(id),
            follower: self.follower.of(id),
            touch: self.touch.clone(),
            // of columns alone, and of whole mechanisms
            way: None,
            kink: None,
        }))
    }
}
