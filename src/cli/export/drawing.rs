//! `linkdyn export --dxf` and `--svg`: drawings to scale, of a pose or of links on their own.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::exit::{BadInput, Exit, Failure};
use crate::cli::interrupt;
use crate::cli::open::ModelOptions;
use crate::cli::results::{extension, write_file};
use crate::cli::streams::print;
use linkdyn_ask::Question;
use linkdyn_ask::drawing::{Drawing, Plates};
use linkdyn_ask::near::did_you_mean;
use linkdyn_ask::text::{Page, count, number};
use linkdyn_exchange::export::{Sheet, dxf, svg};
use linkdyn_model::Unit;

/// Options of `--dxf` and `--svg`.
#[derive(Debug, Args)]
#[command(next_help_heading = "Options of --dxf and --svg")]
pub struct DrawingOptions {
    /// The pose at this time [default: as assembled]
    #[arg(long, value_name = "TIME", value_parser = time, conflicts_with_all = ["link", "each_link", "fmu"])]
    at: Option<f64>,
    /// One body in its own frame instead of a pose
    #[arg(long, value_name = "BODY", conflicts_with = "fmu")]
    link: Option<String>,
    /// A file for each body, in the folder FILE
    #[arg(long, conflicts_with_all = ["link", "fmu"])]
    each_link: bool,
    /// Width of links [default: by the size of the mechanism]
    #[arg(long, value_name = "LENGTH", value_parser = length, conflicts_with = "fmu")]
    width: Option<f64>,
    /// Diameter of holes [default: 0.3 of the width]
    #[arg(long, value_name = "LENGTH", value_parser = length, conflicts_with = "fmu")]
    hole: Option<f64>,
}

/// Which file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawingFormat {
    Dxf,
    Svg,
}

impl DrawingFormat {
    fn ending(self) -> &'static str {
        match self {
            DrawingFormat::Dxf => "dxf",
            DrawingFormat::Svg => "svg",
        }
    }

    fn text(self, sheet: &Sheet) -> String {
        match self {
            DrawingFormat::Dxf => dxf(sheet),
            DrawingFormat::Svg => svg(sheet),
        }
    }
}

/// A number with a unit, or without in the first of these.
fn quantity(text: &str, units: [&str; 2], most: f64) -> Result<f64, String> {
    let text = text.trim();
    let number = text.trim_end_matches(|letter: char| letter.is_alphabetic());
    let symbol = match &text[number.len()..] {
        "" => units[0],
        symbol => symbol,
    };
    let example = format!("such as 20{}, of {most:e} {} at most", units[0], units[1]);
    let value: f64 = number.trim().parse().map_err(|_| example.clone())?;
    let [unit, si] = [symbol, units[1]].map(|unit| Unit::parse(unit).ok());
    let found = unit.zip(si).and_then(|(unit, si)| unit.convert(value, si));
    found
        .filter(|found| (0.0..=most).contains(found))
        .ok_or(example)
}

fn length(text: &str) -> Result<f64, String> {
    let found = quantity(text, ["mm", "m"], 1e3)?;
    match found > 1e-6 {
        true => Ok(found),
        false => Err("above 0.001 mm".into()),
    }
}

fn time(text: &str) -> Result<f64, String> {
    quantity(text, ["s", "s"], 1e9)
}

/// Writes the drawing, or one for each body.
pub fn export(
    model: &ModelOptions,
    options: &DrawingOptions,
    kind: DrawingFormat,
    file: &Path,
) -> Result<Exit, Failure> {
    let ending = kind.ending();
    if !options.each_link && extension(file) != ending {
        return Err(BadInput(vec![format!(
            "{}: the name of the file must end in .{ending}",
            file.display()
        )]));
    }
    let question = Drawing {
        at: options.at,
        width: options.width,
        hole: options.hole,
    };
    let plates = question
        .answer(&model.open()?, &interrupt::control())
        .map_err(|why| model.refuse(why))?;
    let sheets: Vec<(PathBuf, Sheet)> = match &options.link {
        None if options.each_link => {
            let named = plates.names().map(|name| {
                let path = file.join(format!("{}.{ending}", file_name(name)));
                Some((path, plates.link(name)?))
            });
            named.flatten().collect()
        }
        None => vec![(file.to_owned(), plates.pose())],
        Some(name) => {
            let names: Vec<&str> = plates.names().collect();
            let hint = did_you_mean(name, names.into_iter(), "a body that has points");
            let message = format!("--link {name}: there is no such body to draw ({hint})");
            let sheet = plates.link(name).ok_or(BadInput(vec![message]))?;
            vec![(file.to_owned(), sheet)]
        }
    };
    let is_drawn = |(_, sheet): &(PathBuf, Sheet)| sheet.size() != [0.0; 2];
    if !sheets.iter().any(is_drawn) {
        let message = "there is nothing to draw: no body has points (give them \"points\")";
        return Err(BadInput(vec![format!("{}: {message}", model.label())]));
    }
    let mut page = Page::default();
    for (path, sheet) in sheets {
        write_file(&path, kind.text(&sheet).as_bytes())?;
        page.line(said(&path, &sheet, &plates));
    }
    print(page.text())?;
    Ok(Exit::Done)
}

fn said(file: &Path, sheet: &Sheet, plates: &Plates) -> String {
    let [wide, tall] = sheet.size().map(|size| number(size * 1e3, 4));
    let [width, hole] = [plates.width, plates.hole].map(|length| number(length * 1e3, 3));
    let layers = count(sheet.layers.len(), "layer");
    let file = file.display();
    format!("{file}: {layers}, {wide} × {tall} mm, links {width} mm wide, holes {hole} mm")
}

/// The name of a body as that of a file.
fn file_name(body: &str) -> String {
    let legal = |letter: char| letter.is_alphanumeric() || "-_ ".contains(letter);
    let letters = body
        .chars()
        .map(|letter| if legal(letter) { letter } else { '_' });
    letters.take(100).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_times_have_units() {
        assert_eq!(length("20mm"), Ok(0.02));
        assert_eq!(length("2 cm"), Ok(0.02));
        assert_eq!(length("20"), Ok(0.02));
        assert_eq!(time("500 ms"), Ok(0.5));
        for bad in ["", "mm", "-1", "0", "2 kg", "nan", "1e9 m"] {
            assert!(length(bad).is_err(), "{bad}");
        }
    }
}
