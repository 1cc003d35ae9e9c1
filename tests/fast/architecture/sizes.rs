//! A function fits on a screen, a file into a head.

use super::source::{Source, rust_files};

/// Lines of a function, and of a file with its documentation and tests, at most.
const FUNCTION: usize = 80;
const FILE: usize = 400;

/// Where the rule holds.
const FOLDERS: [&str; 6] = [
    "benches",
    "crates",
    "python/src",
    "src",
    "tests",
    "validation/src",
];

/// Files that are longer still, or have a longer function. The list only shrinks.
const LONGER: &[&str] = &[];

/// The functions of a file as rustfmt writes it: name, number of the first line, lines. A function ends with the brace that
/// stands under its beginning.
fn functions(lines: &[String]) -> Vec<(String, usize, usize)> {
    let mut found = Vec::new();
    for (start, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let Some(name) = name(code) else { continue };
        let indent = &line[..line.len() - code.len()];
        // `fn f();` of a trait, `fn f() {}`, or a body.
        let is_whole = code.ends_with(';') || code.ends_with('}');
        let close = format!("{indent}}}");
        let paren = format!("{indent})");
        let ends = |line: &String| {
            *line == close || line.starts_with(&paren) && line.ends_with([';', '}'])
        };
        let last = if is_whole {
            start
        } else {
            let more = lines[start..].iter().position(ends);
            more.map_or(lines.len() - 1, |more| start + more)
        };
        found.push((name.to_string(), start + 1, last - start + 1));
    }
    found
}

/// The name of the function that begins with this line.
fn name(code: &str) -> Option<&str> {
    let words = [
        "pub ",
        "pub(crate) ",
        "pub(super) ",
        "const ",
        "async ",
        "unsafe ",
    ];
    let mut rest = code;
    while let Some(less) = words.iter().find_map(|word| rest.strip_prefix(word)) {
        rest = less;
    }
    let rest = rest.strip_prefix("fn ")?;
    rest.split(|c: char| !c.is_alphanumeric() && c != '_')
        .next()
}

/// What is too long in a file.
fn faults(source: &Source) -> Vec<String> {
    let mut faults = Vec::new();
    if source.lines.len() > FILE {
        faults.push(format!("{}: {} lines", source.path, source.lines.len()));
    }
    for (name, line, length) in functions(&source.lines) {
        if length > FUNCTION {
            faults.push(format!("{}:{line}: {name} has {length} lines", source.path));
        }
    }
    faults
}

#[test]
fn functions_and_files_are_short() {
    let mut told = Vec::new();
    let (mut files, mut count) = (0, 0);
    for source in FOLDERS.iter().flat_map(|folder| rust_files(folder)) {
        files += 1;
        count += functions(&source.lines).len();
        if !LONGER.contains(&source.path.as_str()) {
            told.extend(faults(&source));
        }
    }
    assert!(told.is_empty(), "{}", told.join("\n"));
    assert!(
        files > 200 && count > 2000,
        "only {files} files and {count} functions were found: this test is blind"
    );
}

#[test]
fn functions_are_measured() {
    let text = "\
impl Thing {
    fn declared(&self);

    pub(crate) const fn one() -> u8 { 1 }

    fn asked(
        &self,
    ) -> u8;

    fn two(
        a: u8,
    ) -> u8 {
        if a > 0 {
            a
        }
    }
}

fn three() {
    body();
}
";
    let lines: Vec<String> = text.lines().map(String::from).collect();
    let found = functions(&lines);
    let found: Vec<(&str, usize, usize)> = found
        .iter()
        .map(|(name, line, length)| (name.as_str(), *line, *length))
        .collect();
    assert_eq!(
        found,
        [
            ("declared", 2, 1),
            ("one", 4, 1),
            ("asked", 6, 3),
            ("two", 10, 7),
            ("three", 19, 3)
        ]
    );
}
