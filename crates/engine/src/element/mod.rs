//! Physics of one thing each: small dense blocks in absolute coordinates. **This page is the contract.**
//!
//! Coordinates of a body are q = (x, y, θ) of its centre of mass, [m, m, rad]. With A(θ) the rotation and s a point in
//! the body frame measured from the centre of mass, ρ = A s, the point is at r + ρ, and ρ⊥ = ∂ρ/∂θ.
//!
//! A **constraint** between a *first* and a *second* body is written φ = (first) − (second) = 0, so that with
//!
//! ```text
//! M a + Jᵀ λ = Q          M (n, n) diagonal, J = ∂φ/∂q (m, n), λ (m), Q (n)
//! J v = −φ_t              φ_t = ∂φ/∂t (m)
//! J a = γ                 γ = −(φ_qq[v, v] + 2 φ_qt v + φ_tt)
//! ```
//!
//! λ is what the first body exerts on the second [N, N·m], or the driver on its body.
//! (Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989, ch. 3 and 6; signs ours.)
//!
//! **Recipe.** A new joint: one file here that implements [`Constraint`], one variant in `model::joint`, the arm the
//! compiler asks for in `system::compile`, its entry in `tests::all_constraints` (the shared finite-difference check), a
//! bundled model that uses it, a row in `docs/format.md`.

pub mod actuator;
pub mod belt;
pub mod bushing;
pub mod cable;
pub mod cam;
pub mod clasp;
pub mod coordinate;
pub mod coordinates;
pub mod distance;
pub mod driven;
pub mod edge;
pub mod enclosure;
pub mod fixed;
pub mod following;
pub mod formula;
pub mod gear;
pub mod joint_friction;
pub mod journal;
pub mod load;
pub mod pair;
pub mod prismatic;
pub mod quantity;
pub mod rack;
pub mod revolute;
pub mod rolling;
pub mod sliding;
pub mod slot;
pub(crate) mod span;
pub mod spring;
pub mod stop;
pub mod straight;
pub mod torsion_spring;
pub mod touch;
pub mod yielding;

pub use coordinates::{Axis, BodyColumns, BodyId, Layout};

use crate::motion::Jet;
use linkdyn_linear::math::{Vec2, perp};
use std::sync::Arc;
use touch::Contact;

/// Place of a body at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Centre of mass \[m\].
    pub r: Vec2,
    /// Angle \[rad\].
    pub theta: f64,
    /// cos θ.
    pub cos: f64,
    /// sin θ.
    pub sin: f64,
}

impl Pose {
    /// Where ground stands.
    pub const GROUND: Pose = Pose {
        r: Vec2::new(0.0, 0.0),
        theta: 0.0,
        cos: 1.0,
        sin: 0.0,
    };

    /// From the coordinates [m, m, rad].
    pub fn new(x: f64, y: f64, theta: f64) -> Self {
        let (sin, cos) = theta.sin_cos();
        Pose {
            r: Vec2::new(x, y),
            theta,
            cos,
            sin,
        }
    }

    /// A body-frame vector in the ground frame.
    pub fn turn(&self, s: Vec2) -> Vec2 {
        Vec2::new(
            self.cos * s.x - self.sin * s.y,
            self.sin * s.x + self.cos * s.y,
        )
    }
}

/// Velocity of a body at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Twist {
    /// Of the centre of mass [m/s].
    pub v: Vec2,
    /// Angular velocity [rad/s].
    pub omega: f64,
}

/// Places and velocities of all bodies at one instant, with what is prescribed from outside: all that an element may look
/// at. Index of the slices: body id (0 = ground), driver, offset, contact.
#[derive(Debug, Clone, Copy)]
pub struct Kinematics<'a> {
    /// Places of all bodies.
    pub poses: &'a [Pose],
    /// Velocities of all bodies.
    pub twists: &'a [Twist],
    /// Driver values with two derivatives.
    pub drive: &'a [Jet],
    /// Prescribed offsets of joints with a clearance link, with two derivatives [m, m/s, m/s²].
    pub offset: &'a [[Vec2; 3]],
    /// The sides of kinks that formulas hold, and behind them the stretches of cams; empty where each is on that of its values.
    pub sides: &'a [i32],
    /// Integrated states.
    pub states: &'a [f64],
    /// What contacts remember.
    pub contacts: &'a [Contact],
    /// \[s\]
    pub time: f64,
}

/// A point fixed in a body, from its centre of mass \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marker {
    /// The body.
    pub body: BodyId,
    /// The point in the frame of the body.
    pub s: Vec2,
}

impl Marker {
    /// The same point of a body with another number.
    pub(crate) fn of(self, id: &dyn Fn(BodyId) -> BodyId) -> Marker {
        Marker {
            body: id(self.body),
            s: self.s,
        }
    }

    /// From the centre of mass to the point, in global axes \[m\].
    pub fn rho(&self, at: &Kinematics) -> Vec2 {
        at.poses[self.body.0].turn(self.s)
    }

    pub(crate) fn omega(&self, at: &Kinematics) -> f64 {
        at.twists[self.body.0].omega
    }

    /// Place of the point \[m\].
    pub fn place(&self, at: &Kinematics) -> Vec2 {
        at.poses[self.body.0].r + self.rho(at)
    }

    /// Velocity of the point [m/s].
    pub fn velocity(&self, at: &Kinematics) -> Vec2 {
        at.twists[self.body.0].v + perp(self.rho(at)) * self.omega(at)
    }

    /// Part of the acceleration that is quadratic in ω: −ω² ρ [m/s²].
    pub(crate) fn centripetal(&self, at: &Kinematics) -> Vec2 {
        let omega = self.omega(at);
        self.rho(at) * (-omega * omega)
    }
}

/// What a row's residual is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Metres.
    Length,
    /// Radians.
    Angle,
}

/// One entry of a constraint's Jacobian block: (row in the block, body, coordinate).
pub type Entry = (usize, BodyId, Axis);

/// One entry of a derivative by coordinates: that of the force on the first, by the second.
pub type Slope = [(BodyId, Axis); 2];

/// Equations φ = 0 of one joint or driver. Slices are as long as [`Constraint::rows`] or [`Constraint::entries`] say.
pub trait Constraint: Send + Sync {
    /// What each row is measured in; its length is the number of rows.
    fn rows(&self) -> &'static [Measure];
    /// Where the Jacobian can be non-zero, in the order [`Constraint::jacobian`] writes (entries of ground included).
    fn entries(&self) -> Vec<Entry>;
    /// φ [m or rad].
    fn position(&self, at: &Kinematics, phi: &mut [f64]);
    /// Values of the entries of ∂φ/∂q.
    fn jacobian(&self, at: &Kinematics, values: &mut [f64]);
    /// φ_t [m/s or rad/s].
    fn rate(&self, at: &Kinematics, phi_t: &mut [f64]);
    /// γ [m/s² or rad/s²].
    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]);
    /// Where ∂(Jᵀλ)/∂q can be non-zero, in the order [`Constraint::bend`] writes; it is symmetric, and of two entries beside the
    /// diagonal one stands here.
    /// `None` if φ is linear in q.
    fn curvature_pattern(&self) -> Vec<Slope> {
        Vec::new()
    }
    /// Values of these entries.
    fn bend(&self, _at: &Kinematics, _lambda: &[f64], _values: &mut [f64]) {}
    /// Whether φ of a row is linear in q, whatever the others are.
    fn is_linear(&self, _row: usize) -> bool {
        self.curvature_pattern().is_empty()
    }
    /// Force on the second body (global axes) \[N\] and torque [N·m] that the multipliers mean.
    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64);
    /// The same equations with other numbers of the two bodies; `None` if they are more than geometry between two bodies
    /// (drivers, gears, journals).
    fn between(&self, _id: &dyn Fn(BodyId) -> BodyId) -> Option<Arc<dyn Constraint>> {
        None
    }
}

/// Generalized forces on all bodies, [N, N, N·m] each; ground's are thrown away.
pub struct Applied<'a> {
    q: &'a mut [f64],
    layout: &'a Layout,
}

impl<'a> Applied<'a> {
    /// Adds to `q` (n).
    pub fn to(q: &'a mut [f64], layout: &'a Layout) -> Self {
        Applied { q, layout }
    }

    /// Adds a force at a marker.
    pub fn add_force(&mut self, at: &Kinematics, marker: &Marker, force: Vec2) {
        self.add_beside(marker.body, marker.rho(at), force);
    }

    /// Adds a force at a point that stands this far from the centre of mass, in the ground frame.
    #[inline]
    pub(crate) fn add_beside(&mut self, body: BodyId, rho: Vec2, force: Vec2) {
        self.add(body, force, rho.x * force.y - rho.y * force.x);
    }

    /// Adds a force at the centre of mass and a torque.
    #[inline]
    pub fn add(&mut self, body: BodyId, force: Vec2, torque: f64) {
        if let Some(columns) = self.layout.columns(body) {
            let own = self.q[columns.range()].iter_mut();
            own.zip([force.x, force.y, torque])
                .for_each(|(own, more)| *own += more);
        }
    }
}

/// A force element.
pub trait Force: Send + Sync {
    /// Adds its generalized forces.
    fn apply(&self, at: &Kinematics, to: &mut Applied);
    /// Where the derivatives of these by coordinates and velocities can be non-zero, in the order [`Force::slope`] writes.
    fn slopes(&self) -> Vec<Slope>;
    /// Values of ∂Q/∂q and ∂Q/∂v there.
    fn slope(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]);
    /// Potential energy \[J\]; zero for what has none.
    fn potential(&self, at: &Kinematics) -> f64;
    /// Whether its work is the change of its potential energy.
    fn is_conservative(&self) -> bool;
    /// Power that enters the mechanism beside the potential, Q·v + dV/dt \[W\]; negative in dampers.
    fn supplied(&self, at: &Kinematics) -> f64;
}

/// A force in one direction whose size depends on the multipliers of a constraint: friction.
///
/// Its size is found in `mechanism::dependent_forces`.
pub trait ConstraintDependentForce: Send + Sync {
    /// Adds the generalized forces of size 1.
    fn apply_unit(&self, at: &Kinematics, to: &mut Applied);
    /// Size [N or N·m] at the constraint's multipliers, with its derivatives by them, which are as many.
    fn size(&self, at: &Kinematics, memory: f64, lambda: &[f64], slope: &mut [f64]) -> f64;
    /// Whether its size is proportional to the multipliers, whatever they are.
    fn is_straight(&self) -> bool;
    /// Force on the second body (global axes) \[N\], at its point, and torque [N·m] that a size means.
    fn reaction(&self, at: &Kinematics, size: f64) -> (Vec2, f64);
    /// Typical size of what the force remembers where that changes with time (bristles' deflection \[m\]).
    fn memory_scale(&self) -> Option<f64>;
    /// Its rate [m/s].
    fn memory_rate(&self, at: &Kinematics, memory: f64) -> f64;
}

/// Unit vector along `a`, and its length; none for a (numerically) zero vector.
pub fn direction(a: Vec2) -> Option<(Vec2, f64)> {
    let length = a.norm();
    (length > f64::MIN_POSITIVE).then(|| (a / length, length))
}

#[cfg(test)]
mod slope_tests;
#[cfg(test)]
pub(crate) mod tests;
