//! Rows of variants in files that are the same bytes whoever computes them, however often and in whatever order.
//!
//! ```text
//! plan      variants 0 … n − 1 in chunks of so many rows; chunk c belongs to shard (c mod k) + 1 of k
//! file      "linkdyn chunk/1\n", length of the header (u64), header (JSON), rows, SHA-256 of all that
//! header    study, engine, from, to, inputs, responses, reasons
//! row       status (u32: 0 or 1 + number of the reason), inputs and responses (f64, NaN where there is none); little-endian
//! ```
//!
//! A chunk is written under another name, synced and renamed: at any moment its file is whole or not there. A process that is killed leaves
//! a part, which nobody reads and the next writer of that chunk removes. Two writers of one chunk write the same bytes, so that it does not
//! matter who is last. What is computed twice is so computed at least once, and counts once.

#[cfg(feature = "parquet")]
mod columns;
mod csv;
mod fault;
mod format;
mod plan;
mod rows;
mod store;

pub use csv::{write_header, write_rows};
pub use fault::ChunkFault;
pub use plan::{Plan, Shard, ShardFault};
pub use rows::{Row, Rows};
pub use store::{Identity, Store};

#[cfg(test)]
mod tests;
