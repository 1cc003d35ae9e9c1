//! The architecture as tests: who may know whom, and how long functions and files may be. See `CONTRIBUTING.md`.

mod face;
mod items;
mod layers;
mod packages;
mod pages;
mod sizes;
mod source;
