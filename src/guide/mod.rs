//! Guide for people who design mechanisms. Every model in it is loaded and run by `tests/command_line/guide.rs`, and every command
//! executed, so what it shows is what this version does.
//!
//! | page         | for                                                               |
//! | ------------ | ----------------------------------------------------------------- |
//! | [`tutorial`] | a first model, from an empty file to a study of clearance         |
//! | [`mod@format`]  | how to write what in a model file, each with a piece that runs    |
//! | [`theory`]   | the equations of every element and method, with signs and sources |
//! | [`messages`] | what a message means and what to do                               |

#[doc = include_str!("format.md")]
pub mod format {}

#[doc = include_str!("messages.md")]
pub mod messages {}

#[doc = include_str!("theory.md")]
pub mod theory {}

#[doc = include_str!("tutorial.md")]
pub mod tutorial {}
