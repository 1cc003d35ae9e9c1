//! Shape and poses → scene: one pose, poses over each other, a strip of poses.
//!
//! A body is the convex hull of its points with rounded corners; the ground is drawn where something is held by it.
//!
//! | file       | does                                                        |
//! | ---------- | ----------------------------------------------------------- |
//! | `moving`   | a mechanism with its motion: extent, paths, slides          |
//! | `places`   | points and directions in global axes                        |
//! | `drivers`  | what drivers stand at                                       |
//! | `instants` | when poses tell most                                        |
//! | `cylinder` | which joints are cylinders                                  |
//! | `view`     | the part of a page that shows it                            |
//! | `pages`    | one pose with its time, several poses over or beside others |
//! | `plain`    | one pose without words                                      |
//! | `cams`     | draws profiles and what touches them                         |
//! | `pose`     | draws bodies and joints of one pose                         |
//! | `actions`  | draws springs, drivers and loads of one pose                |
//! | `values`   | numbers beside arrows                                       |
//! | `sketch`   | what all drawing of one pose needs                          |

mod actions;
mod cams;
mod cylinder;
mod drivers;
mod instants;
mod moving;
mod outlines;
mod pages;
mod places;
mod plain;
mod pose;
mod sketch;
mod stops;

mod values;
mod view;
mod wheels;

pub use moving::Mechanism;
pub use pages::{Layout, MOST_POSES};
pub use plain::Marks;
