//! Files of other programs as models.

mod dxf;
mod sketch;
mod svg;
mod xml;

use crate::Draft;
use crate::source::{Format, LONGEST, LeftOut, MOST_PARTS, Options, Refused};

/// A mechanism that was read.
#[derive(Debug, Clone, Default)]
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
    let words = || Format::ALL.map(Format::word).join(", ");
    let Some(format) = format.or_else(|| Format::of(name, bytes)) else {
        return Err(Refused::new(
            "",
            "neither its name nor its first characters say what it is",
            format!("--from says it: {}", words()),
        ));
    };
    let imported: Imported = match format {
        Format::Dxf => sketch::linkage(name, dxf::read(bytes)?, options),
        Format::Svg => {
            let drawn = svg::read(text(bytes)?, options.length.is_none())?;
            sketch::linkage(name, drawn, options)
        }
        Format::Pmks
        | Format::Pylinkage
        | Format::Mjcf
        | Format::Urdf
        | Format::Sdf
        | Format::Csv => {
            let _ = options;
            Err(Refused::new(
                "",
                format!("{} is not read yet", format.word()),
                "later",
            ))
        }
    }?;
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
