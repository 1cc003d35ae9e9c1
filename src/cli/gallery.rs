//! A small picture of each bundled model, in a few poses of its own motion.

use std::path::PathBuf;

use super::exit::{BadInput, Failure};
use super::open::bad_input;
use linkdyn_ask::shape::with_loads;
use linkdyn_engine::analysis::{self, Control};
use linkdyn_model::bundled;
use linkdyn_output::read::{ReadColumn, Table};
use linkdyn_output::{Directory, Trajectory};
use linkdyn_picture::Fault;
use linkdyn_picture::mechanism::{Layout, Mechanism};
use linkdyn_picture::poses::Poses;
use linkdyn_picture::raster;

/// Side of a picture \[mm\], and its resolution: as wide as a column of a table on a screen.
const WIDTH: f64 = 60.0;
const DPI: f64 = 110.0;
/// As many as can be told apart.
const POSES: usize = 4;

/// Draws models into `DIR/NAME.png`; the paths.
///
/// # Errors
/// When a file can't be written.
pub fn draw<'a>(
    names: impl Iterator<Item = &'a str>,
    directory: &Directory,
) -> Result<Vec<PathBuf>, Failure> {
    let mut written = Vec::new();
    for name in names {
        let picture = picture(name)?;
        // The colon of a size is no letter of a file's name everywhere.
        let file = format!("{}.png", name.replace(':', "-"));
        written.push(directory.write(&file, &picture)?);
    }
    Ok(written)
}

/// A model in motion, as PNG.
fn picture(name: &str) -> Result<Vec<u8>, Failure> {
    let bad = |why: &dyn std::fmt::Display| BadInput(vec![format!("{name}: {why}")]);
    let text = bundled::text(name).map_err(|why| bad(&why))?;
    let all = |found| bad_input(name, found);
    let loaded = linkdyn_model::load(text.as_bytes(), &[]).map_err(all)?;
    let model = loaded.model;
    let outcome = analysis::run(&model, &Control::default()).map_err(all)?;
    let results = outcome.all();
    let shape = with_loads(&model, results);
    let fault = |why: Fault| bad(&why);
    let poses = Poses::read(&table(name, results), &shape).map_err(fault)?;
    let mechanism = Mechanism::new(shape, poses).map_err(fault)?;
    // A mechanism at rest has one pose only.
    let [first, last] = mechanism.span();
    let poses = if last > first { POSES } else { 1 };
    let scene = mechanism
        .picture(poses, Layout::Overlaid, WIDTH)
        .map_err(fault)?;
    raster::png(&scene, DPI).map_err(fault)
}

/// Results as if they had been read from a file.
fn table(name: &str, results: &Trajectory) -> Table {
    let columns = results.columns.iter().enumerate();
    let columns = columns.map(|(index, column)| {
        let values = results.rows().map(|row| row[index]);
        ReadColumn::new(&column.name, column.unit, values.collect())
    });
    Table {
        path: PathBuf::from(name),
        columns: columns.collect(),
    }
}
