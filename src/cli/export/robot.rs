//! `linkdyn export --mjcf`: the model for MuJoCo, as it is assembled.

use std::path::Path;

use linkdyn_ask::text::{Page, count};
use linkdyn_engine::analysis::check;
use linkdyn_exchange::export::mjcf;
use linkdyn_output::Status;

use crate::cli::exit::{BadInput, Exit, Failure};
use crate::cli::open::ModelOptions;
use crate::cli::results::write_file;
use crate::cli::streams::{print, remark};

/// Writes the file, and lists what it lacks.
pub fn export(options: &ModelOptions, file: &Path) -> Result<Exit, Failure> {
    let read = options.open()?;
    let model = read.model();
    let found = check(model).map_err(|complaints| options.refuse(read.refused(complaints)))?;
    if found.status != Status::Completed {
        let why = found.message.as_deref().unwrap_or(found.status.word());
        return Err(Failure::Stopped(format!("{}: {why}", options.label())));
    }
    let written = mjcf(model, &found.poses)
        .map_err(|refused| BadInput(vec![format!("{}: {refused}", options.label())]))?;
    write_file(file, written.text.as_bytes())?;
    let mut page = Page::default();
    let joints = count(model.joints.len(), "joint");
    page.line(format!("{}: {joints}", file.display()));
    print(page.text())?;
    for what in &written.left_out {
        remark(&format!("left out: {what}"));
    }
    Ok(Exit::Done)
}
