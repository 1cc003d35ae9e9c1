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
pub mod algebra;
pub mod beam;
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
pub mod gas_spring;
pub mod gear;
pub mod joint_friction;
pub mod journal;
pub mod linear;
pub mod load;
pub mod modal;
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
pub mod station;
pub mod stop;
pub mod straight;
pub mod torsion_spring;
pub mod touch;
pub mod yielding;

pub use coordinates::{Axis, BodyColumns, BodyId, Layout};

use crate::motion::Jet;
use algebra::{Algebraic, LinearForm};
use linkdyn_linear::math::{Lanes, Real, Vec2, Vector, perp};
use std::sync::Arc;
use touch::Contact;

/// Place of a body at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose<T = f64> {
    /// Centre of mass \[m\].
    pub r: Vector<T>,
    /// Angle \[rad\].
    pub theta: T,
    /// cos θ.
    pub cos: T,
    /// sin θ.
    pub sin: T,
}

impl Pose {
    /// Where ground stands.
    pub const GROUND: Pose = Pose {
        r: Vec2::new(0.0, 0.0),
        theta: 0.0,
        cos: 1.0,
        sin: 0.0,
    };
}

impl<T: Real> Pose<T> {
    /// From the coordinates [m, m, rad].
    pub fn new(x: T, y: T, theta: T) -> Self {
        let (sin, cos) = theta.simd_sin_cos();
        Pose {
            r: Vector::new(x, y),
            theta,
            cos,
            sin,
        }
    }

    /// A body-frame vector in the ground frame.
    pub fn turn(&self, s: Vector<T>) -> Vector<T> {
        Vector::new(
            self.cos * s.x - self.sin * s.y,
            self.sin * s.x + self.cos * s.y,
        )
    }
}

/// Velocity of a body at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist<T = f64> {
    /// Of the centre of mass [m/s].
    pub v: Vector<T>,
    /// Angular velocity [rad/s].
    pub omega: T,
}

impl<T: Real> Default for Twist<T> {
    fn default() -> Self {
        Twist {
            v: Vector::zeros(),
            omega: T::zero(),
        }
    }
}

/// Places and velocities of all bodies at one instant, with what is prescribed from outside: all that an element may look
/// at. Index of the slices: body id (0 = ground), driver, offset, contact.
#[derive(Debug, Clone, Copy)]
pub struct Kinematics<'a, T = f64> {
    /// Places of all bodies.
    pub poses: &'a [Pose<T>],
    /// Velocities of all bodies.
    pub twists: &'a [Twist<T>],
    /// Driver values with two derivatives.
    pub drive: &'a [Jet<T>],
    /// Prescribed offsets of joints with a clearance link, with two derivatives [m, m/s, m/s²].
    pub offset: &'a [[Vector<T>; 3]],
    /// The sides of kinks that formulas hold, and behind them the stretches of cams; empty where each is on that of its values.
    pub sides: &'a [i32],
    /// Numbers from outside, then integrated states.
    pub states: &'a [f64],
    /// What contacts remember.
    pub contacts: &'a [Contact],
    /// \[s\]
    pub time: f64,
}

/// A point fixed in a body, from its centre of mass \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marker<T = f64> {
    /// The body.
    pub body: BodyId,
    /// The point in the frame of the body.
    pub s: Vector<T>,
}

impl Marker {
    /// The vector from this point to another.
    pub(crate) fn form_to(&self, other: &Marker) -> LinearForm {
        LinearForm::point(other.body, other.s).minus(LinearForm::point(self.body, self.s))
    }
}

impl<T: Real> Marker<T> {
    /// The same point of a body with another number.
    pub(crate) fn of(self, id: &dyn Fn(BodyId) -> BodyId) -> Self {
        Marker {
            body: id(self.body),
            s: self.s,
        }
    }

    /// The same with what `number` makes of its numbers.
    pub(crate) fn map<U>(&self, number: &mut dyn FnMut(T) -> U) -> Marker<U> {
        Marker {
            body: self.body,
            s: mapped(&self.s, number),
        }
    }

    /// From the centre of mass to the point, in global axes \[m\].
    pub fn rho(&self, at: &Kinematics<T>) -> Vector<T> {
        at.poses[self.body.0].turn(self.s)
    }

    pub(crate) fn omega(&self, at: &Kinematics<T>) -> T {
        at.twists[self.body.0].omega
    }

    /// Place of the point \[m\].
    pub fn place(&self, at: &Kinematics<T>) -> Vector<T> {
        at.poses[self.body.0].r + self.rho(at)
    }

    /// Velocity of the point [m/s].
    pub fn velocity(&self, at: &Kinematics<T>) -> Vector<T> {
        at.twists[self.body.0].v + perp(self.rho(at)) * self.omega(at)
    }

    /// Part of the acceleration that is quadratic in ω: −ω² ρ [m/s²].
    pub(crate) fn centripetal(&self, at: &Kinematics<T>) -> Vector<T> {
        let omega = self.omega(at);
        self.rho(at) * (-omega * omega)
    }
}

/// A vector of what `number` makes of its components.
pub(crate) fn mapped<T: Real, U>(a: &Vector<T>, number: &mut dyn FnMut(T) -> U) -> Vector<U> {
    let [[x, y]] = a.data.0;
    Vector::from_data(nalgebra::ArrayStorage([[number(x), number(y)]]))
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

/// Equations φ = 0 of one joint or driver, of one mechanism or of several side by side. Slices are as long as
/// [`Constraint::rows`] or [`Constraint::entries`] say.
pub trait Equations<T = f64>: Send + Sync {
    /// φ [m or rad].
    fn position(&self, at: &Kinematics<T>, phi: &mut [T]);
    /// Values of the entries of ∂φ/∂q.
    fn jacobian(&self, at: &Kinematics<T>, values: &mut [T]);
    /// φ_t [m/s or rad/s].
    fn rate(&self, at: &Kinematics<T>, phi_t: &mut [T]);
    /// γ [m/s² or rad/s²].
    fn gamma(&self, at: &Kinematics<T>, gamma: &mut [T]);
}

/// What else a joint or driver says of its equations.
pub trait Constraint: Equations {
    /// What each row is measured in; its length is the number of rows.
    fn rows(&self) -> &'static [Measure];
    /// Where the Jacobian can be non-zero, in the order [`Equations::jacobian`] writes (entries of ground included).
    fn entries(&self) -> Vec<Entry>;
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
    /// Whether an entry of the Jacobian is the same at all positions.
    fn is_constant(&self, _entry: usize) -> bool {
        false
    }
    /// Force on the second body (global axes) \[N\] and torque [N·m] that the multipliers mean.
    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64);
    /// The rows as polynomials, where drivers have these values; none if they are none.
    fn algebra(&self, _drive: &[Jet]) -> Vec<Algebraic> {
        Vec::new()
    }
    /// The same equations with other numbers of the two bodies; `None` if they are more than geometry between two bodies
    /// (drivers, gears, journals).
    fn between(&self, _id: &dyn Fn(BodyId) -> BodyId) -> Option<Arc<dyn Constraint>> {
        None
    }
    /// The equations of several mechanisms side by side, with what `number` makes of their numbers, always in the same order;
    /// `None` if they can only be evaluated one by one.
    fn abreast(&self, _number: &mut dyn FnMut(f64) -> Lanes) -> Option<Box<dyn Equations<Lanes>>> {
        None
    }
    /// The same equations with what `number` makes of their numbers, in that order; `None` if they have others as well.
    fn renumbered(&self, _number: &mut dyn FnMut(f64) -> f64) -> Option<Arc<dyn Constraint>> {
        None
    }
}

/// [`Constraint::abreast`] and [`Constraint::renumbered`] of what maps its numbers.
macro_rules! abreast {
    () => {
        fn abreast(
            &self,
            number: &mut dyn FnMut(f64) -> linkdyn_linear::math::Lanes,
        ) -> Option<Box<dyn super::Equations<linkdyn_linear::math::Lanes>>> {
            Some(Box::new(self.map(number)))
        }

        fn renumbered(
            &self,
            number: &mut dyn FnMut(f64) -> f64,
        ) -> Option<std::sync::Arc<dyn super::Constraint>> {
            Some(std::sync::Arc::new(self.map(number)))
        }
    };
}
use abreast;

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
