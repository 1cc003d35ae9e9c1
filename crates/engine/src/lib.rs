//! The numbers of linkdyn: equations of planar mechanisms, and the analyses that solve them.
//!
//! Part of linkdyn; its items change without notice. Use the package `linkdyn`.
//!
//! | module      | does                                                                  |
//! | ----------- | --------------------------------------------------------------------- |
//! | `motion`    | motion laws: value and derivatives over time                          |
//! | `contact`   | laws of contact: normal force, friction, restitution                  |
//! | `element`   | constraints and forces, an element a file                             |
//! | `system`    | a compiled mechanism: rows, columns, patterns, evaluation             |
//! | `graph`     | bodies are nodes, joints edges: freedoms, loops, islands              |
//! | `mechanism` | closing, following a path, reactions, reduction to few coordinates    |
//! | `integrate` | steps of y′ = f(t, y): `dop853`, `radau`                              |
//! | `analysis`  | assembly, driven motion, dynamics, statics, modes                     |

pub mod analysis;
pub mod contact;
pub mod elastic;
pub mod element;
mod graph;
pub mod integrate;
pub mod mechanism;
pub mod motion;
pub mod system;
