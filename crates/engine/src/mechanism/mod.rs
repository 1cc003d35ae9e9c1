//! The solves of a mechanism: closing, following a path, reactions, reduction to few coordinates.
//!
//! ```text
//! assemblies        all positions that close
//! closing           assembly from rough guesses (Levenberg–Marquardt)
//! failure           why there is no solution
//! least_velocity    velocities to start with
//! driven            positions, velocities, accelerations, multipliers at one instant
//! dependent_forces  forces that depend on multipliers, which depend on them: friction
//! reduced           equations of motion in minimal coordinates
//! released          one instant with drivers let go: what it does under given states and inputs
//! ridders           derivatives of what can only be evaluated
//! parts             parts with one degree of freedom of a mechanism with more, across their change points
//! independent       which coordinates determine the rest well
//! phases            systems by the rows in force
//! held              the mechanism at rest in minimal coordinates: forces, stiffness, damping and mass
//! branching         singular positions, and the branches that cross there
//! equilibrium       where the forces at rest vanish, and whether that is stable
//! continuation      the path of a driven mechanism, branch-safe, with its singular positions
//! ```

pub(crate) mod abreast;
pub mod assemblies;
pub(crate) mod branching;
pub(crate) mod closing;
pub mod continuation;
pub(crate) mod dependent_forces;
pub mod driven;
pub(crate) mod equilibrium;
pub(crate) mod failure;
mod independent;
pub(crate) mod least_velocity;
pub(crate) mod linearised_system;
pub(crate) mod parts;
pub(crate) mod phases;
pub mod reduced;
pub(crate) mod released;
pub(crate) mod ridders;
