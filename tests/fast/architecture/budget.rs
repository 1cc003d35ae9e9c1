//! How much code there is, by part: lines without comments, blank lines and tests. Printed by
//! `cargo test --test fast -- --nocapture budget`.
//!
//! A line of the table is lowered with the code. Who raises one says in the commit what the lines are worth.

use std::fs;
use std::path::Path;

use super::source::root;

/// A part of the house: its name, its folders, what its files end with, and how many lines of code it may have.
struct Part {
    name: &'static str,
    folders: &'static [&'static str],
    ending: &'static str,
    at_most: usize,
}

const fn part(
    name: &'static str,
    folders: &'static [&'static str],
    ending: &'static str,
    at_most: usize,
) -> Part {
    Part {
        name,
        folders,
        ending,
        at_most,
    }
}

const PARTS: &[Part] = &[
    part("model", &["crates/model/src"], "rs", 18_630),
    part("engine", &["crates/engine/src"], "rs", 49_850),
    part("variation", &["crates/variation/src"], "rs", 5_070),
    part("linear", &["crates/linear/src"], "rs", 4_090),
    part(
        "study and optimise",
        &["crates/study/src", "crates/optimise/src"],
        "rs",
        4_445,
    ),
    part("ask", &["crates/ask/src"], "rs", 14_360),
    part("synthesis", &["crates/synthesis/src"], "rs", 1_700),
    part("exchange", &["crates/exchange/src"], "rs", 11_420),
    part("fmi", &["crates/fmi/src"], "rs", 1_845),
    part("output", &["crates/output/src"], "rs", 2_180),
    part("picture", &["crates/picture/src"], "rs", 9_700),
    part("pages", &["crates/picture/src"], "js", 4_690),
    part("library", &["src"], "rs", 7_780),
    part("of it the command", &["src/cli"], "rs", 5_870),
    part("web", &["crates/web/src", "web/bind/src"], "rs", 475),
    part("editor", &["web/src"], "ts", 2_215),
    part("validation", &["validation/src"], "rs", 8_580),
    part("python", &["python/src"], "rs", 1_505),
    part("python package", &["python/linkdyn"], "py", 2_330),
    part("tests", &["tests"], "rs", 52_400),
];

/// Whether a file or folder holds tests only, or what others wrote.
fn is_left_out(path: &Path) -> bool {
    let stem = path
        .file_stem()
        .and_then(|stem| stem.to_str())
        .unwrap_or_default();
    stem.ends_with("tests") || stem == "vendor"
}

/// Lines of code of a text: of Rust, without modules of tests.
fn code(text: &str) -> usize {
    let mut count = 0;
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let code = line.trim();
        if code.starts_with("#[cfg(test)]") {
            let item = lines.find(|line| !line.trim().starts_with("#["));
            let item = item.unwrap_or_default();
            if item.ends_with('{') {
                let indent = &item[..item.len() - item.trim_start().len()];
                let end = format!("{indent}}}");
                lines.find(|line| **line == end);
            }
        } else if !code.is_empty()
            && !["//", "/*", "*", "#!"]
                .iter()
                .any(|mark| code.starts_with(mark))
        {
            count += 1;
        }
    }
    count
}

/// Lines of code below a folder.
fn count(folder: &Path, ending: &str, is_outside: bool) -> usize {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{folder:?}: {error}"));
    let of = |path: &Path| match path.extension() {
        _ if !is_outside && is_left_out(path) => 0,
        _ if path.is_dir() => count(path, ending, is_outside),
        Some(own) if own == ending => code(&fs::read_to_string(path).expect("readable")),
        _ => 0,
    };
    entries
        .map(|entry| of(&entry.expect("a readable entry").path()))
        .sum()
}

#[test]
fn the_code_keeps_to_its_budget() {
    let mut faults = Vec::new();
    for part in PARTS {
        let folders = part.folders.iter();
        let lines: usize = folders
            .map(|folder| count(&root().join(folder), part.ending, part.name == "tests"))
            .sum();
        println!("{:>7} of {:>7} {}", lines, part.at_most, part.name);
        if lines > part.at_most {
            faults.push(format!(
                "{}: {lines} lines, {} at most",
                part.name, part.at_most
            ));
        }
        assert!(
            lines > 0,
            "{}: nothing was found, this test is blind",
            part.name
        );
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn comments_and_tests_do_not_count() {
    let text = "//! Page.\n\n/// One.\nfn one() {\n    // why\n    two();\n}\n\n#[cfg(test)]\nmod tests {\n    fn three() {}\n}\nuse four;\n";
    assert_eq!(code(text), 4);
}
