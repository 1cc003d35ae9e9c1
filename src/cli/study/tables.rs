//! The rows of a study that is done: `variants.csv`, and `variants.parquet` where it is wanted.

use super::super::exit::Failure;
use super::fault;
use linkdyn_output::Directory;
use linkdyn_study::chunks::{ChunkFault, Store};
use std::fs::File;
use std::io;
use std::path::PathBuf;

const TABLE: &str = "variants.csv";
const COLUMNS: &str = "variants.parquet";

/// Writes all rows; an older file by columns goes where none is wanted.
pub fn write(
    directory: &Directory,
    store: &Store,
    by_columns: bool,
) -> Result<Vec<PathBuf>, Failure> {
    let mut written = vec![table(directory, TABLE, |out| store.write_csv(out))?];
    match by_columns {
        true => written.push(table(directory, COLUMNS, |out| parquet(store, out))?),
        false => directory.remove(COLUMNS)?,
    }
    Ok(written)
}

/// A file of all rows.
fn table(
    directory: &Directory,
    name: &str,
    write: impl FnOnce(&mut File) -> Result<(), ChunkFault>,
) -> Result<PathBuf, Failure> {
    let mut failed = None;
    let written = directory.write_with(name, |out| {
        write(out).map_err(|why| {
            let error = io::Error::other(why.to_string());
            failed = Some(why);
            error
        })
    });
    match (written, failed) {
        (_, Some(why)) => Err(fault(why)),
        (written, None) => Ok(written?),
    }
}

#[cfg(feature = "parquet")]
fn parquet(store: &Store, out: &mut File) -> Result<(), ChunkFault> {
    store.write_parquet(out)
}

#[cfg(not(feature = "parquet"))]
fn parquet(_: &Store, _: &mut File) -> Result<(), ChunkFault> {
    let why = "this linkdyn was built without the feature \"parquet\"";
    Err(io::Error::other(why).into())
}
