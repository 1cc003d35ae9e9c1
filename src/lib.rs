//! Planar multibody engine for linkages: assembly, kinematics and inverse dynamics of driven mechanisms, with ideal
//! joints or joints with clearance.
//!
//! A model file is read into words ([`model`]), compiled into equations (`linkdyn_engine::system`), solved ([`analysis`] by way of
//! `linkdyn_engine::mechanism`) and left as a table and a report ([`output`]).
//!
//! | symbol   | code          | meaning                                                | shape, unit            |
//! | -------- | ------------- | ------------------------------------------------------ | ---------------------- |
//! | q        | `q`           | x, y of the centre of mass and angle, body after body  | (n), m, m, rad         |
//! | v, a     | `v`, `a`      | their derivatives by time                              | (n)                    |
//! | λ        | `lambda`      | multipliers: reactions of joints, efforts of drivers   | (m), N, N·m            |
//! | φ        | `phi`         | constraints, joints before drivers                     | (m), m, rad            |
//! | J        | `jacobian`    | ∂φ/∂q                                                  | (m, n)                 |
//! | φ_t, γ   | `rate`, `gamma` | right-hand sides of J v = −φ_t, J a = γ              | (m)                    |
//! | M        | `mass`        | masses and inertias, diagonal                          | (n), kg, kg, kg·m²     |
//! | Q        | `force`       | gravity, springs, loads                                | (n), N, N, N·m         |
//! | e        | `offset`      | journal centre minus bearing centre of a clearance     | (2), m                 |
//! | s        | `s`           | parameter of the path: the driver's value, or time     | rad, m or s            |
//!
//! # Examples
//!
//! ```
//! use linkdyn::{analysis, bundled, model};
//!
//! let text = bundled::find("four-bar").expect("bundled").text;
//! let loaded = linkdyn_model::load(text.as_bytes(), &["analysis.outputs=3".into()]).expect("a sound model");
//! let outcome = analysis::run(&loaded.model, &analysis::Control::default()).expect("a driven mechanism");
//! let effort = outcome.trajectory.values("driver.motor.effort").expect("inverse dynamics has efforts");
//! assert_eq!(effort.len(), 3);
//! ```

#[cfg(feature = "command")]
#[doc(hidden)]
pub mod cli;
pub mod guide;

pub use linkdyn_engine::analysis;
pub use linkdyn_model as model;
pub use linkdyn_model::bundled;
pub use linkdyn_output as output;
