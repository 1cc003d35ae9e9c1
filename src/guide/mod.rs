//! The book `docs/`, for people who design mechanisms. Every model in it is loaded and run by `tests/command_line/book`, and every
//! command executed, so what it shows is what this version does.
//!
//! | page            | for                                                           |
//! | --------------- | ------------------------------------------------------------- |
//! | [`tutorial`]    | a first model, from an empty file to a study of clearance     |
//! | [`recipes`]     | models and numbers that are often wanted                      |
//! | [`accuracy`]    | what tolerances and clearances do                             |
//! | [`studies`]     | many variants: sweeps, samples, clusters                      |
//! | [`synthesis`]   | linkages for a wanted path, motion or function                |
//! | [`optimise`]    | parameters that meet a goal, are best, or draw a path         |
//! | [`assemblies`]  | all assemblies and circuits                                   |
//! | [`path_time`]   | the fastest motion along a stroke                             |
//! | [`python`]      | runs, variants, studies and notebooks in Python               |
//! | [`cluster`]     | studies on many machines, and what it costs                   |
//! | [`fmu`]         | mechanisms in programs that know FMI                          |
//! | [`editor`]      | a mechanism that moves while you draw it, in a browser        |
//! | [`coming_from`] | the words of other programs, and how they are said here       |
//! | [`commands`]    | what each command does, exit statuses, figures                |
//! | [`mod@format`]  | reference of model files, each thing with a piece that runs   |
//! | [`exchange`]    | mechanisms of other programs, read by `linkdyn import`        |
//! | [`results`]     | reference of columns, summary, events, the report             |
//! | [`messages`]    | what a message means and what to do                           |
//! | [`theory`]      | the equations of every element and method, with their sources |
//! | [`validation`]  | answers that are not ours, and how far we are from them       |
//! | [`performance`] | how long things take                                          |

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/accuracy.md")]
pub mod accuracy {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/cluster.md")]
pub mod cluster {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/coming-from.md")]
pub mod coming_from {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/commands.md")]
pub mod commands {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/editor.md")]
pub mod editor {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/exchange.md")]
pub mod exchange {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/fmu.md")]
pub mod fmu {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/format.md")]
pub mod format {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/messages.md")]
pub mod messages {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/synthesis.md")]
pub mod synthesis {}

#[doc = include_str!("../../docs/optimise.md")]
pub mod optimise {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/assemblies.md")]
pub mod assemblies {}
#[doc = include_str!("../../docs/path-time.md")]
pub mod path_time {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/performance.md")]
pub mod performance {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/python.md")]
pub mod python {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/recipes.md")]
pub mod recipes {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/results.md")]
pub mod results {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/studies.md")]
pub mod studies {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/theory.md")]
pub mod theory {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/tutorial.md")]
pub mod tutorial {}

#[doc = include_str!("links.md")]
#[doc = include_str!("../../docs/validation.md")]
pub mod validation {}
