//! Optimisation of functions that may have no value: goal seek, least squares, constraints, global search. It knows no mechanism.
//!
//! Part of linkdyn; its items change without notice. Use the package `linkdyn`.
//!
//! ```text
//! outcome        what a function gives at a point, the box of points
//! seek           goal seek: one variable, one equation
//! least_squares  Levenberg and Marquardt within bounds
//! constrained    a sequence of quadratic programs within a trust region
//! quadratic      one of them
//! differences    derivatives
//! curve          distance of points from a curve
//! fastest        the fastest law of motion along a path, under limits
//! start          global search over the box, then a local one; many starts are many of them
//! ```
//!
//! ```
//! use linkdyn_optimise::quadratic::Kind;
//! use linkdyn_optimise::start::{Start, optimise};
//! use linkdyn_optimise::{Bounds, Outcome};
//!
//! // The can with the least sheet that holds a litre: as high as it is wide.
//! let mut can = |x: &[f64]| {
//!     let (radius, height) = (x[0], x[1]);
//!     let area = std::f64::consts::TAU * radius * (radius + height);
//!     let volume = std::f64::consts::PI * radius * radius * height;
//!     Outcome::of(vec![area, volume - 1.0])
//! };
//! let bounds = Bounds::new(&[[0.1, 3.0], [0.1, 3.0]]);
//! let start = Start { seed: 1, number: 0, points: 32, descents: 1 };
//! let found = optimise(&mut can, &[Kind::Equal], &bounds, &start, None, &Default::default())?;
//! assert!((found.x[1] / found.x[0] - 2.0).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod constrained;
pub mod curve;
pub mod differences;
pub mod fastest;
pub mod least_squares;
pub mod outcome;
pub mod quadratic;
pub mod seek;
pub mod start;

pub use outcome::{Bounds, End, Evaluate, Function, Outcome};
