//! Files of other programs as models.

mod dxf;
mod mjcf;
mod pins;
mod pmks;
mod pylinkage;
mod sdf;
mod sketch;
mod spatial;
mod svg;
mod table;
mod urdf;
mod xml;

use linkdyn_model::Unit;

use crate::Draft;
use crate::source::{Format, LONGEST, LeftOut, MOST_PARTS, Options, Refused};

/// A mechanism that was read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Imported {
    /// The model.
    pub draft: Draft,
    /// What of the source it lacks, in the source's order.
    pub left_out: Vec<LeftOut>,
}

/// Reads a mechanism; `name` is that of the file, from which the model has its own where the source has none.
///
/// # Errors
/// Where it can't be read.
pub fn import(
    name: &str,
    bytes: &[u8],
    format: Option<Format>,
    options: &Options,
) -> Result<Imported, Refused> {
    if bytes.len() > LONGEST {
        return Err(Refused::new(
            "",
            format!("{} bytes are too many for a mechanism", bytes.len()),
            format!("{LONGEST} at most"),
        ));
    }
    if let Some(unit) = &options.length {
        length("--length", unit)?;
    }
    let words = || Format::ALL.map(Format::word).join(", ");
    let Some(format) = format.or_else(|| Format::of(name, bytes)) else {
        return Err(Refused::new(
            "",
            "neither its name nor its first characters say what it is",
            format!("--from says it: {}", words()),
        ));
    };
    let imported: Imported = match format {
        Format::Pmks => pmks::read(name, text(bytes)?),
        Format::Pylinkage => pylinkage::read(name, text(bytes)?, options),
        Format::Csv => table::read(name, text(bytes)?, options),
        Format::Mjcf => mjcf::read(text(bytes)?),
        Format::Urdf => urdf::read(text(bytes)?),
        Format::Sdf => sdf::read(text(bytes)?),
        Format::Dxf => sketch::linkage(name, dxf::read(bytes)?, options),
        Format::Svg => {
            let drawn = svg::read(text(bytes)?, options.length.is_none())?;
            sketch::linkage(name, drawn, options)
        }
    }?;
    if imported.draft.bodies.is_empty() {
        return Err(Refused::new(
            "",
            "nothing is drawn in it",
            "draw a body first",
        ));
    }
    let parts = imported.draft.bodies.len().max(imported.draft.joints.len());
    if parts > MOST_PARTS {
        return Err(Refused::new(
            "",
            format!("{parts} bodies or joints are too many for a planar linkage"),
            format!("{MOST_PARTS} at most"),
        ));
    }
    Ok(imported)
}

/// A unit of length, which the format knows.
pub(crate) fn length<'t>(place: &str, unit: &'t str) -> Result<&'t str, Refused> {
    let metre = Unit::parse("m").map(|metre| metre.powers);
    match Unit::parse(unit) {
        Ok(found) if metre.is_ok_and(|metre| metre == found.powers) => Ok(unit),
        _ => Err(Refused::new(
            place,
            format!("{unit:?} is no unit of length"),
            "mm, cm, m, in, ft or another that linkdyn docs format lists",
        )),
    }
}

/// The text of a file.
pub(crate) fn text(bytes: &[u8]) -> Result<&str, Refused> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        Refused::new(
            format!("byte {}", error.valid_up_to()),
            "this is no UTF-8 text",
            "save it as UTF-8",
        )
    })?;
    Ok(text.trim_start_matches('\u{feff}'))
}

/// A text of a file for a message: short, and on one line.
pub(crate) fn quoted(text: &str) -> String {
    let mut short: String = text.chars().take(40).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    format!("{short:?}")
}
