//! The laws of contact in a joint with clearance: pure functions of numbers, each with its derivatives.
//!
//! ```text
//! δ      penetration of journal into bearing, above zero in contact      [m]
//! δ̇      its rate, above zero while it grows                             [m/s]
//! δ̇₀     rate at which this contact began, above zero                    [m/s]
//! F      normal force, never below zero                                  [N]
//! v      sliding velocity along the tangent                              [m/s]
//! T      friction force along the tangent, against v                     [N]
//! ```
//!
//! | module     | law                                                  |
//! | ---------- | ---------------------------------------------------- |
//! | `normal`   | F(δ, δ̇; δ̇₀)                                          |
//! | `friction` | T(v, F), where it has bristles also of their state   |
//! | `impact`   | velocities after an impact that takes no time        |
//!
//! No law remembers anything: δ̇₀ and the bristles' deflection belong to whoever integrates.

pub(crate) mod friction;
pub(crate) mod impact;
pub mod normal;

/// A normal force with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Value {
    /// F \[N\].
    pub force: f64,
    /// ∂F/∂δ [N/m].
    pub d_penetration: f64,
    /// ∂F/∂δ̇ [N·s/m].
    pub d_rate: f64,
}
