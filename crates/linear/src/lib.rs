//! Linear algebra of linkdyn: matrices on fixed patterns, ranks, small dense problems. It knows no mechanism.
//!
//! Part of linkdyn; its items change without notice. Use the package `linkdyn`.
//!
//! ```text
//! math          plane vectors
//! pattern       where the entries stand, compressed by columns
//! matching      pairing of rows with columns, structural rank
//! order         elimination order and preferred pivots of a square matrix
//! lu            sparse LU with frozen pivots: A x = b, Aᵀ x = b, determinant, smallest singular value
//! gram          B Bᵀ of independent rows: the nearest point that meets conditions
//! rank          which rows of a rectangular matrix depend on earlier ones, and how
//! dense         singular values, null spaces and least norm solutions of small matrices
//! small         LU and Cholesky factors of small dense matrices, without allocation
//! redundancy    free directions, and independent rows chosen for good condition
//! bilinear      all roots of square systems of bilinear equations
//! complementary linear complementarity problems
//! lemke         the same of copositive matrices
//! eigen         eigenvalues of small symmetric matrices, and of M x″ + C x′ + K x = 0
//! state_space   eigenvalues, gains and frequency responses of linear systems
//! hermite       osculating polynomials
//! ```
//!
//! A step loop holds one [`SparseLu`], factors once and then only refactors and solves, without allocating.

pub mod bilinear;
pub mod complementary;
pub mod dense;
pub mod eigen;
pub mod gram;
pub mod hermite;
pub mod lemke;
pub mod lu;
mod matching;
pub mod math;
pub mod order;
pub mod pattern;
pub mod rank;
pub mod redundancy;
pub mod small;
pub mod state_space;
mod triangle;

#[cfg(test)]
#[path = "../../../tests/common/linkage.rs"]
mod linkage;

pub use lu::{Singular, SparseLu};
pub use matching::Unmatched;
pub use order::ColumnOrder;
pub use pattern::{Pattern, PatternFault};
