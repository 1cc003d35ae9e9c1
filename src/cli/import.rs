//! `linkdyn import`: a mechanism from the file of another program.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use linkdyn_ask::text::Page;
use linkdyn_exchange::{Format, Imported, Options as Asked, import};

use super::created::{create, quoted};
use super::exit::{BadInput, Exit, Failure};
use super::open::bad_input;
use super::streams::{print, remark};

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    /// Path of a file, a link that PMKS+ shares, or - for standard input
    #[arg(value_name = "FILE|URL")]
    source: String,
    /// What it is written in, where name and content do not say it
    #[arg(long, value_name = "FORMAT")]
    from: Option<From>,
    /// Unit of its lengths, where the source does not say it: mm, in …
    #[arg(long, value_name = "UNIT")]
    length: Option<String>,
    /// Write the model into this file [default: print it]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file where it exists
    #[arg(long)]
    force: bool,
}

const HELP: &str = "  linkdyn import 'https://app.pmksplus.com/?j=…' -o mine.json
  linkdyn import robot.urdf -o robot.json
  linkdyn import sketch.dxf --length in -o sketch.json

What of the source has no counterpart is listed. linkdyn docs exchange tells what is read of each format.";

#[derive(Debug, Clone, Copy, ValueEnum)]
enum From {
    Pmks,
    Pylinkage,
    Mjcf,
    Urdf,
    Sdf,
    Dxf,
    Svg,
    Csv,
}

impl From {
    fn format(self) -> Format {
        match self {
            From::Pmks => Format::Pmks,
            From::Pylinkage => Format::Pylinkage,
            From::Mjcf => Format::Mjcf,
            From::Urdf => Format::Urdf,
            From::Sdf => Format::Sdf,
            From::Dxf => Format::Dxf,
            From::Svg => Format::Svg,
            From::Csv => Format::Csv,
        }
    }
}

/// Reads the source, writes the model, and lists what it lacks.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let source = options.source.as_str();
    let (name, bytes) = read(source)?;
    let asked = Asked {
        length: options.length.clone(),
    };
    let read = import(&name, &bytes, options.from.map(From::format), &asked);
    let Imported { draft, left_out } =
        read.map_err(|refused| BadInput(vec![format!("{}: {refused}", shown(source))]))?;
    let text = draft.text();
    // What was read must be a model; where it is not, the fault is ours or the source's, and the text says where.
    if let Err(complaints) = linkdyn_model::load(text.as_bytes(), &[]) {
        return Err(bad_input(&shown(source), complaints));
    }
    match &options.output {
        None => print(&text)?,
        Some(path) => {
            create(path, text.as_bytes(), options.force, "model.json")?;
            let file = quoted(&path.display().to_string());
            let mut page = Page::default();
            let (bodies, joints) = (&draft.bodies, draft.joints.len());
            let moving = bodies
                .keys()
                .filter(|name| *name != linkdyn_model::GROUND)
                .count();
            page.line(format!(
                "{}: {moving} moving bodies, {joints} joints. Next:",
                path.display()
            ));
            page.line(format!("  linkdyn check {file}"));
            page.line(format!("  linkdyn edit {file}"));
            print(page.text())?;
        }
    }
    left_out
        .iter()
        .for_each(|what| remark(&format!("left out: {what}")));
    Ok(Exit::Done)
}

/// Name and content of the source: a link is its own content.
fn read(source: &str) -> Result<(String, Vec<u8>), Failure> {
    let limit = linkdyn_exchange::LONGEST as u64 + 1;
    let name = |path: &Path| {
        path.file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    };
    let mut bytes = Vec::new();
    let read = match source {
        "-" => io::stdin().lock().take(limit).read_to_end(&mut bytes),
        link if link.contains("://") => return Ok((String::new(), link.into())),
        path => fs::File::open(path).and_then(|file| file.take(limit).read_to_end(&mut bytes)),
    };
    match read {
        Ok(_) => Ok((name(Path::new(source)), bytes)),
        Err(why) => Err(BadInput(vec![format!("{source}: can't be read: {why}")])),
    }
}

/// The source as it is named in messages: a link by its beginning.
fn shown(source: &str) -> String {
    match source.char_indices().nth(60) {
        Some((end, _)) if source.contains("://") => format!("{}…", &source[..end]),
        _ => source.to_owned(),
    }
}
