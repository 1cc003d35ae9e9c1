//! Linear algebra on fixed patterns, and the solves of a driven mechanism.
//!
//! ```text
//! pattern       where the entries stand, compressed by columns
//! matching      pairing of rows with columns, structural rank
//! order         elimination order and preferred pivots of a square matrix
//! lu            sparse LU with frozen pivots: A x = b, Aᵀ x = b, determinant, smallest singular value
//! rank          which rows of a rectangular matrix depend on earlier ones, and how
//! dense         singular values, null spaces and least norm solutions of small matrices
//! redundancy    free directions, and independent rows chosen for good condition
//! closing       assembly from rough guesses (Levenberg–Marquardt)
//! driven        positions, velocities, accelerations, multipliers at one instant
//! reactive      forces that depend on multipliers, which depend on them: friction
//! reduced       equations of motion in minimal coordinates
//! parts         parts with one degree of freedom of a mechanism with more, across their change points
//! held          the mechanism at rest in minimal coordinates: forces, stiffness, damping and mass
//! branching     singular positions, and the branches that cross there
//! equilibrium   where the forces at rest vanish, and whether that is stable
//! eigen         eigenvalues of small symmetric matrices, and of M x″ + C x′ + K x = 0
//! hermite       osculating polynomials
//! continuation  the path of a driven mechanism, branch-safe, with its singular positions
//! ```
//!
//! A step loop holds one [`SparseLu`], factors once and then only refactors and solves, without allocating.

pub mod branching;
pub mod closing;
pub mod complementary;
pub mod continuation;
pub mod dense;
pub mod driven;
pub mod eigen;
pub mod equilibrium;
pub mod held;
pub mod hermite;
pub mod lu;
pub mod matching;
pub mod order;
pub mod parts;
pub mod pattern;
pub mod rank;
pub mod reactive;
pub mod reduced;
pub mod redundancy;
mod triangle;

#[cfg(test)]
#[path = "../../tests/common/linkage.rs"]
mod linkage;

pub use lu::{Singular, SparseLu};
pub use matching::Unmatched;
pub use order::ColumnOrder;
pub use pattern::{Pattern, PatternFault};
