//! The shape of a mechanism: bodies with their points, and what connects, drives and loads them.
//!
//! This is the one description that every picture is drawn from. The figures and the film draw it (`mechanism`), the report
//! takes it as JSON, and `run -o` keeps it in `summary.json` under `mechanism`, so that results can be drawn without the
//! model. Poses come from the results.
//!
//! | file       | does                                                              |
//! | ---------- | ----------------------------------------------------------------- |
//! | `parts`    | the types                                                         |
//! | `joint`    | what is seen of each kind of joint, and how it follows from the model |
//! | `of_model` | model → shape                                                     |
//! | `check`    | refuses a shape that can't be drawn                               |
//! | `loads`    | values of the loads over time, from a table                       |
//! | `kept`     | reads and writes the shape in `summary.json`, that of 0.1 as well |

mod check;
mod joint;
mod kept;
mod loads;
mod numbers;
mod of_model;
mod parts;

pub use joint::{Clearance, Joint, JointKind, PitchCircles, PitchLine, Profile, Pulleys};
pub use numbers::PointId;
pub use parts::{Bending, Body, Driver, DriverKind, Load, Shape, Spring, TorsionSpring};
