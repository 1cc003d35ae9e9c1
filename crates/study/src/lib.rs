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
//! ```
//! use linkdyn_study::design::{Design, Grid, Layout, Method, Samples};
//! use linkdyn_study::distribution::{Distribution, Shape};
//! use linkdyn_study::summary::{EXACT, Limits, Response};
//!
//! // A stroke of twice a crank of 40 ± 0.05 mm, in 4096 variants.
//! let crank = Distribution::new(Shape::Normal { sigma: 3.0 }, 39.95, 40.05)?;
//! let samples = Samples::new(Method::Sobol { scrambled: true }, Layout::Plain, 4096, 1, 7)?;
//! let design = Design::of_samples(Grid::new(vec![])?, samples, vec![crank])?;
//! let mut stroke = Response::new(Limits { lower: Some(79.9), upper: Some(80.1) }, EXACT);
//! let mut values = [0.0];
//! for variant in 0..design.rows() {
//!     design.row(variant, &mut values);
//!     stroke.push(2.0 * values[0]);
//! }
//! let summary = stroke.summary();
//! let sigma = summary.deviation.ok_or("it scatters")?;
//! assert!((sigma / (2.0 * crank.deviation()) - 1.0).abs() < 1e-3);
//! assert_eq!((summary.below, summary.above), (0, 0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
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
