//! The Python package: what `linkdyn` gives to Rust, as the module `linkdyn._linkdyn`. The Python that people meet stands in
//! `python/linkdyn`.
//!
//! ```text
//! model text ──► Mechanism ──► Run ──► Column (memory of the run, which NumPy reads in place)
//!                    ├───────► Simulation ──► states, events
//!                    ├───────► Family ──► Answers
//!                    ├───────► Answer: JSON, words, a page
//!                    └───────► Variants: a study
//! arguments ───► command: the command itself, in this process
//! ```
//!
//! Whatever takes time goes through `work`: without the interpreter's lock, stopped by Ctrl-C, and no panic leaves it.

use pyo3::prelude::*;

mod answers;
mod command;
mod equations;
mod errors;
mod family;
mod mechanism;
mod questions;
mod run;
mod simulation;
mod work;
mod worker;

/// The module.
#[pymodule(gil_used = false)]
mod _linkdyn {
    #[pymodule_export]
    use super::answers::{Answers, Statuses};
    #[pymodule_export]
    use super::command::{Said, command};
    #[pymodule_export]
    use super::equations::{Equations, Numbers};
    #[pymodule_export]
    use super::family::Family;
    #[pymodule_export]
    use super::mechanism::Mechanism;
    #[pymodule_export]
    use super::questions::{
        Variants, accuracy, allocate, assemblies, bundled, check, circuits, compare, imported,
        linearise, modes, optimise, path_time, quantity, synthesise, workspace,
    };
    #[pymodule_export]
    use super::run::{Column, Run};
    #[pymodule_export]
    use super::simulation::{Checkpoint, Simulation};
    #[pymodule_export]
    use super::work::panic;

    use super::*;

    /// Tells the module its version.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
