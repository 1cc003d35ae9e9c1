//! Links of PMKS+, files of pylinkage and tables of points: what is written, what is left out, what is refused, and mutants.

mod bad;
mod mutants;
mod written;

use linkdyn_exchange::{Format, Imported, Options, Refused, import};

/// Links of PMKS+ by name.
fn links() -> Vec<(&'static str, &'static str)> {
    let lines = include_str!("pmks-links.txt").lines();
    let links = lines.filter_map(|line| line.split_once('\t'));
    links.filter(|(name, _)| !name.starts_with('#')).collect()
}

fn link(name: &str) -> &'static str {
    let found = links().into_iter().find(|(other, _)| *other == name);
    found.expect("a link of this name").1
}

fn read(text: &str, format: Format) -> Result<Imported, Refused> {
    import("", text.as_bytes(), Some(format), &Options::default())
}

fn done(text: &str, format: Format) -> Imported {
    read(text, format).unwrap_or_else(|refused| panic!("{refused}"))
}

/// What is left out, a line each.
fn lacks(imported: &Imported) -> Vec<String> {
    imported.left_out.iter().map(ToString::to_string).collect()
}

/// A link with its checks; `body` is what they check.
fn checked(body: &str) -> String {
    const DIGITS: &[u8] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    format!(
        "{body}{}",
        char::from(DIGITS[body.encode_utf16().count() % 62])
    )
}
