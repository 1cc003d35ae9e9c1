//! Shape and poses → scene: one pose, poses over each other, a strip of poses.
//!
//! A body is the convex hull of its points with rounded corners; the ground is drawn where something is held by it.
//!
//! | file       | does                                                         |
//! | ---------- | ------------------------------------------------------------ |
//! | `moving`   | a mechanism with its motion: extent, paths, slides           |
//! | `places`   | points and directions in global axes                         |
//! | `drivers`  | values of drivers                                            |
//! | `instants` | the instants whose poses show most of the motion             |
//! | `parts`    | a sign, what it stands at, what it turns with                |
//! | `joints`   | how bodies and each kind of joint are drawn                  |
//! | `stops`    | how ends of ways and one-way clutches are drawn              |
//! | `forces`   | how springs, dampers, cables, actuators, drivers are drawn   |
//! | `cylinder` | which joints are cylinders, and how long they are            |
//! | `loads`    | draws the loads of one pose                                  |
//! | `values`   | numbers at arrows                                            |
//! | `view`     | the part of a page that shows it                             |
//! | `pages`    | one pose with its time, several poses overlaid or in a strip |
//! | `plain`    | one pose without words                                       |
//! | `drawing`  | all parts for a page, which moves them                       |

mod cylinder;
mod drawing;
mod drivers;
mod forces;
mod instants;
mod joints;
mod loads;
mod moving;
mod pages;
mod parts;
mod places;
mod plain;
mod stops;
mod values;
mod view;

pub(crate) use drawing::Drawing;
pub use moving::Mechanism;
pub use pages::{Layout, MOST_POSES};
pub use plain::Marks;
