//! From the text of a file to a checked model.

use std::fs::File;
use std::io;
use std::io::Read;
use std::path::Path;

use super::expression::Parameter;
use super::file;
use super::file_access::FileAccess;
use super::gate::{self, Checked, Holes};
use super::json;
use super::node::{self, Kind, Node};
use super::set;
use super::source::Source;
use super::stale;
use super::walk::{Findings, Undotted, display, walk};
use super::{FORMAT, ForceKind, Model, hold};
use crate::error::{Complaint, Complaints};
use crate::tree::Tree;
use serde::Deserialize;

/// Largest file that is read \[bytes\].
const LARGEST: u64 = 64 * 1024 * 1024;
/// Most complaints about one file; the rest is only counted.
const MOST_COMPLAINTS: usize = 100;

/// A model, and what it was read from.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The model, legal.
    pub model: Checked,
    /// What it was read from.
    pub source: Source,
    /// What is legal, and yet hardly meant.
    pub warnings: Vec<String>,
    /// The parameters as resolved, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// What the user wrote, in that order, after `--set`.
    pub document: serde_json::Value,
}

/// Reads a model file and puts `sets` (`PATH=VALUE`) over it.
///
/// # Errors
/// All faults of the file, in the order of the lines.
pub fn load_file(path: &Path, sets: &[String]) -> Result<Loaded, Complaints> {
    let bytes = read(path).map_err(|complaint| vec![complaint])?;
    load_with_access(&bytes, sets, &FileAccess::of(path))
}

/// The bytes of a model's file; one more than [`load_with_access`] takes where it has no end.
///
/// # Errors
/// Those of the system.
pub fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = File::open(path)?;
    file.take(LARGEST + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn read(path: &Path) -> Result<Vec<u8>, Complaint> {
    let refuse = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => fault(path, "there is no such file"),
        _ => fault(path, &format!("the file cannot be read: {error}")),
    };
    let file = File::open(path).map_err(refuse)?;
    let metadata = file.metadata().map_err(refuse)?;
    if metadata.is_dir() {
        return Err(fault(path, "this is a directory, not a model file"));
    }
    if metadata.len() > LARGEST {
        return Err(too_large(metadata.len()).found(path.display().to_string()));
    }
    // a device or pipe does not tell its length
    read_file(path).map_err(refuse)
}

fn fault(path: &Path, message: &str) -> Complaint {
    Complaint::new("", message).found(path.display().to_string())
}

fn too_large(length: u64) -> Complaint {
    let megabytes = length.div_ceil(1024 * 1024);
    Complaint::new(
        "",
        format!(
            "{megabytes} MB are too much for a model, at most {} MB are read",
            LARGEST >> 20
        ),
    )
}

/// Reads a model's text and puts `sets` (`PATH=VALUE`) over it.
///
/// # Errors
/// All faults of the text, in the order of the lines.
///
/// # Examples
/// ```
/// let text = br#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "bar": { "points": { "A": ["5 mm", 0] } } } }"#;
/// let loaded = linkdyn_model::load(text, &[]).unwrap();
/// assert_eq!(loaded.model.bodies["bar"].points["A"], [0.005, 0.0]);
/// ```
pub fn load(text: &[u8], sets: &[String]) -> Result<Loaded, Complaints> {
    load_with_access(text, sets, &FileAccess::default())
}

/// The same of a text with files beside it.
///
/// # Errors
/// As [`load`].
pub fn load_with_access(
    text: &[u8],
    sets: &[String],
    access: &FileAccess,
) -> Result<Loaded, Complaints> {
    let text = decode(text).map_err(|complaint| vec![complaint])?;
    let mut source = Source::new(text, sets);
    let mut complaints = Vec::new();

    // syntax: the first fault ends it
    let (root, repeats) = json::parse(text).map_err(|fault| vec![syntax(&source, &fault)])?;
    source.root = root;
    if !matches!(source.root.kind, Kind::Object(_)) {
        let message = format!(
            "a model is an object, {{ … }}, not {}",
            source.root.kind_name()
        );
        let complaint = Complaint::new("", message);
        return Err(vec![source.complain(source.root.origin, None, complaint)].into());
    }
    let uncounted = repeats.len().saturating_sub(MOST_COMPLAINTS);
    for repeat in repeats.into_iter().take(MOST_COMPLAINTS) {
        let first = source.place_of(repeat.first);
        let mut complaint = Complaint::new(
            node::join(&repeat.path, &repeat.key),
            "the key is given twice",
        )
        .found(format!("{:?}", repeat.key));
        complaint.place = Some(source.place_of(repeat.second));
        complaints.push(complaint.hint(format!(
            "first on line {}, column {}",
            first.line, first.column
        )));
    }

    // what --set says, then all of it against the schema; of another format nothing else can be said
    set::apply(&mut source, &mut complaints);
    let unread = file::put_in(&mut source, access);
    if !unread.is_empty() {
        complaints.extend(unread);
        return Err(sorted(complaints, uncounted).into());
    }
    let other_format = source
        .root
        .get("format")
        .filter(|node| node.as_str() != Some(FORMAT));
    let findings = walk(&source);
    if other_format.is_some() {
        let of_format = |complaint: &Complaint| complaint.path == "format";
        let said = findings.complaints.into_iter().filter(of_format);
        return Err(Complaints(said.collect()));
    }
    let more = findings.more + uncounted;
    pass(source, sets, findings, complaints, more)
}

/// Words → types → the gate.
fn pass(
    source: Source,
    sets: &[String],
    findings: Findings,
    mut complaints: Vec<Complaint>,
    more: usize,
) -> Result<Loaded, Complaints> {
    complaints.extend(findings.complaints);
    let (passed, said) = typed(&source, findings.value, findings.holes, &findings.undotted);
    let model = match passed {
        Ok(model) if complaints.is_empty() => model,
        Ok(_) => return Err(sorted(complaints, more).into()),
        Err(said) => {
            complaints.extend(said);
            return Err(sorted(complaints, more).into());
        }
    };
    let mut warnings = findings.warnings;
    warnings.extend(told(said, &source));
    let unsaid = unsaid_lengths(&model, &source.root);
    let said = unsaid
        .chain(hold::unheld(&model))
        .chain(stale::stale(&source.root, sets));
    warnings.extend(told(said, &source));
    Ok(Loaded {
        model,
        document: source.root.to_value(),
        source,
        warnings,
        parameters: findings.parameters,
    })
}

/// A typed model from its value in SI units, passed by the gate; complaints with their places, and warnings.
pub(super) fn typed(
    source: &Source,
    tree: Tree,
    holes: Holes,
    undotted: &[Undotted],
) -> (Result<Checked, Vec<Complaint>>, Vec<Complaint>) {
    // the words are described as these types are, so nothing is left to go wrong
    let mut model = match Model::deserialize(&tree) {
        Ok(model) => model,
        Err(error) => {
            let message = format!("the words allow what the model does not: {error}");
            return (Err(vec![Complaint::new("", message)]), Vec::new());
        }
    };
    model.display = display(source.root.get("units"));
    let undotted = undotted.iter().take(MOST_COMPLAINTS);
    let undotted = undotted.map(|Undotted { path, text }| gate::no_point(&model, path, text));
    let mut complaints: Vec<Complaint> = undotted.collect();
    let (passed, warnings) = gate::pass(model, holes);
    let passed = passed.map_err(|said| {
        complaints.extend(said);
        let placed = complaints.into_iter();
        placed.map(|complaint| source.place(complaint)).collect()
    });
    (passed, warnings)
}

/// Warnings as texts, as many as anybody reads.
fn told(said: impl IntoIterator<Item = Complaint>, source: &Source) -> Vec<String> {
    let said = said.into_iter().take(MOST_COMPLAINTS);
    said.map(|warning| source.place(warning).to_string())
        .collect()
}

/// A warning per spring with a stiffness whose free length the file does not say.
fn unsaid_lengths<'m>(model: &'m Model, root: &'m Node) -> impl Iterator<Item = Complaint> + 'm {
    let unsaid = model.forces.iter().filter(|(name, force)| {
        let is_stiff =
            matches!(force.kind, ForceKind::Spring { stiffness, .. } if stiffness != 0.0);
        let written = root.get("forces").and_then(|forces| forces.get(name));
        is_stiff && written.is_some_and(|written| written.get("free_length").is_none())
    });
    unsaid.map(|(name, _)| {
        let message = "\"free_length\" is left out and taken as 0";
        Complaint::new(format!("forces.{name}"), message).hint("write it, even if it is 0")
    })
}

/// UTF-8 with or without its mark, neither empty nor too large.
fn decode(text: &[u8]) -> Result<&str, Complaint> {
    let length = u64::try_from(text.len()).unwrap_or(u64::MAX);
    if length > LARGEST {
        return Err(too_large(length));
    }
    let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
    if text.iter().all(u8::is_ascii_whitespace) {
        return Err(Complaint::new("", "the file is empty").hint("a model is a JSON object"));
    }
    std::str::from_utf8(text).map_err(|error| {
        let valid = &text[..error.valid_up_to()];
        let good = std::str::from_utf8(valid).unwrap_or_default();
        let mut complaint = Complaint::new("", "the file is not UTF-8 text");
        complaint.place = Some(Source::new(good, &[]).place_of(good.len()));
        complaint.hint("a model is a JSON file; save it as UTF-8")
    })
}

fn syntax(source: &Source, fault: &json::SyntaxFault) -> Complaint {
    let mut complaint = Complaint::new("", format!("not JSON: {}", fault.message));
    complaint.place = Some(source.place_of(fault.at));
    complaint.hint = fault.hint.map(str::to_owned);
    complaint
}

/// In the order of the lines, what has none last; not more than anybody reads.
pub(super) fn sorted(mut complaints: Vec<Complaint>, more: usize) -> Vec<Complaint> {
    complaints.sort_by_key(|complaint| (complaint.place.is_none(), complaint.place));
    let more = more + complaints.len().saturating_sub(MOST_COMPLAINTS);
    if more > 0 {
        complaints.truncate(MOST_COMPLAINTS);
        complaints.push(Complaint::new("", format!("and {more} more faults")));
    }
    complaints
}
