//! The book `docs/`, for people who design mechanisms. Every model in it is loaded and run by `tests/command_line/guide.rs`, and every
//! command executed, so what it shows is what this version does.
//!
//! | page            | for                                                           |
//! | --------------- | ------------------------------------------------------------- |
//! | [`tutorial`]    | a first model, from an empty file to a study of clearance     |
//! | [`mod@format`]  | reference of model files, each thing with a piece that runs   |
//! | [`messages`]    | what a message means and what to do                           |
//! | [`theory`]      | the equations of every element and method, with their sources |

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/format.md")]
pub mod format {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/messages.md")]
pub mod messages {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/theory.md")]
pub mod theory {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/tutorial.md")]
pub mod tutorial {}
