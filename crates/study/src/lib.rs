//! Numerics of studies: random numbers, lists of variants, summaries and chunks. It knows no mechanism.
//!
//! Part of linkdyn; its items change without notice. Use the package `linkdyn`.
//!
//! ```text
//! random        Philox4x64-10: random numbers by their number, the same as those of numpy
//! normal        normal distribution function and its inverse
//! distribution  how one value scatters between its limits: quantiles and moments
//! design        the list of variants as a function of (design, seed): any row by its number
//! summary       moments, quantiles, histograms, capability, yields, Sobol indices, in one pass
//! chunks        rows in files that are the same bytes whoever computes them; resuming, sharing out, joining
//! ```
//!
//! What a design gives for a seed is fixed forever: tests hold the digits. Functions like exp and log come from `libm`, so that they
//! do not depend on the machine.

pub mod chunks;
pub mod design;
pub mod distribution;
pub mod normal;
pub mod random;
pub mod summary;
