//! Planar multibody engine for linkages: assembly, kinematics and inverse dynamics of driven mechanisms, with ideal
//! joints or joints with clearance.
//!
//! A model file is read and checked ([`Mechanism::open`]), run ([`Mechanism::run`]) and left as columns, a report and files
//! ([`Run`]). Start with the [`prelude`] and the [`guide`]. What stands in the packages `linkdyn-model`, `linkdyn-engine`,
//! `linkdyn-linear`, `linkdyn-output`, `linkdyn-picture` and `linkdyn-validation` changes without notice.
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
//! use linkdyn::prelude::*;
//!
//! let mechanism = Mechanism::bundled("four-bar")?;
//! let effort = mechanism.column("driver.motor.effort")?;
//! let run = mechanism.run()?;
//! println!("{}", run.column(effort).max_abs());
//! # Ok::<(), linkdyn::Error>(())
//! ```

// Without the command some of what it needs is needed by nobody.
#![cfg_attr(not(feature = "command"), allow(dead_code))]

#[doc(hidden)]
pub mod bridge;
#[cfg(feature = "command")]
#[doc(hidden)]
pub mod cli;
pub mod exchange;
#[doc(hidden)]
pub mod fmu;
pub mod guide;
pub mod prelude;

mod error;
mod family;
mod files;
mod handles;
mod mechanism;
mod profiles;
mod quantity;
mod questions;
mod release;
mod run;
mod simulation;
mod studies;

pub use error::Error;
pub use family::{Family, Member};
pub use handles::{Column, Parameter};
pub use linkdyn_engine::analysis::{Control, LinearSystem, Linearised, Mode, Variable};
pub use linkdyn_model::Model;
pub use linkdyn_model::error::{Complaint, Complaints, Place};
pub use linkdyn_output::{Episode, Event, EventKind, Report, Status};
pub use mechanism::Mechanism;
pub use quantity::{Quantity, deg, kg, m, mm, newton, newton_metre, rad, rpm, s, um};
pub use run::{Run, Values};
pub use simulation::{Checkpoint, Simulation};

/// Figures of curves, as `linkdyn plot` draws them.
///
/// # Examples
/// ```
/// use linkdyn::figure::{Axis, Chart, Curve, Panel, svg};
///
/// let curve = Curve::new("crank", vec![0.0, 0.5, 1.0], vec![0.0, 1.0, 4.0]);
/// let panel = Panel { axis: Axis::new("angle", "rad"), curves: vec![curve] };
/// let chart = Chart { x: Axis::new("time", "s"), panels: vec![panel], ..Chart::default() };
/// assert!(svg::write(&chart.draw()?).starts_with("<svg"));
/// # Ok::<(), linkdyn::figure::Fault>(())
/// ```
pub mod figure {
    pub use linkdyn_picture::{Axis, Chart, Curve, Fault, Mark, Panel, Scene, svg};
}

/// Questions to a [`Mechanism`], and their answers: each answer serialises as the command's JSON, and tells itself in words.
pub mod ask {
    pub use linkdyn_ask::Question;
    pub use linkdyn_ask::accuracy::{Accuracy, Deviations};
    pub use linkdyn_ask::allocate::{Allocate, Allocation};
    pub use linkdyn_ask::assemblies::{
        Assemblies, AssembliesFound, Circuits, CircuitsFound, Workspace, WorkspaceFound,
    };
    pub use linkdyn_ask::check::{Check, Diagnosis};
    pub use linkdyn_ask::compare::{Compare, Compared};
    pub use linkdyn_ask::modes::{Modes, SmallMotions};
    pub use linkdyn_ask::optimise::{Optimise, Optimised};
    pub use linkdyn_ask::path_time::{FastestMotion, PathTime};
    pub use linkdyn_ask::state_space::{FrequencyResponse, Linearisation, StateSpace};
    pub use linkdyn_ask::study::{Studied, Study, Varied};
    pub use linkdyn_ask::synthesise::{Synthesise, Synthesised};
    pub use linkdyn_engine::analysis::Check as Findings;
    pub use linkdyn_study::design::Method;
    pub use linkdyn_variation::Levels;
}

/// Every type of a [`Model`].
pub mod model {
    pub use linkdyn_model::{
        Analysis, AnalysisKind, Body, Checked, Clearance, ClearanceModel, Driver, DriverKind,
        Elastic, FORMAT, Force, ForceKind, Frame, Friction, FrictionLaw, GROUND, Impact,
        ImpactSense, Initial, Joint, JointKind, Material, Model, Motion, Normal, NormalLaw,
        OutputsAt, PointRef, Pose, Sample, Solver, Surface, Transmission, Value, schema,
    };
}
