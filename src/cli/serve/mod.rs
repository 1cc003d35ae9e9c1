//! Pages that the command serves to this computer: `run --watch` and `edit`.

pub mod http;
mod server;

pub use server::Server;
