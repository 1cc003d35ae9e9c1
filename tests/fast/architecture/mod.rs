//! The architecture as tests: who may know whom, and how much code there is. See `CONTRIBUTING.md`.

mod budget;
mod circles;
mod face;
mod items;
mod layers;
mod packages;
mod pages;
mod source;
mod sources;
mod type_names;
