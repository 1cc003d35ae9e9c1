//! Who may know whom among packages: Cargo keeps to the manifests, and these tests keep the manifests.

use std::fs;

use super::source::{root, rust_files};

/// The packages of the workspace from top to bottom, each with those it may depend on.
const PACKAGES: &[(&str, &[&str])] = &[
    // The library in functional mock-up units.
    ("fmi", &["linkdyn"]),
    // Python meets the face and the command, nothing behind them.
    ("python", &[]),
    (
        "linkdyn",
        &[
            "ask",
            "exchange",
            "validation",
            "picture",
            "variation",
            "engine",
            "output",
            "model",
            "linear",
            "study",
        ],
    ),
    // The engine for pages in a browser.
    (
        "web",
        &["ask", "exchange", "picture", "engine", "output", "model"],
    ),
    // Questions and their answers.
    (
        "ask",
        &[
            "exchange",
            "picture",
            "variation",
            "engine",
            "output",
            "model",
            "linear",
            "optimise",
            "study",
            "synthesis",
        ],
    ),
    // The cases: what the engine is held against.
    (
        "validation",
        &[
            "picture",
            "variation",
            "engine",
            "output",
            "model",
            "linear",
        ],
    ),
    // Pictures are drawn from words and results, never from equations.
    ("picture", &["output", "model"]),
    // What tolerances and clearances do, from the equations of the engine.
    ("variation", &["engine", "output", "model", "linear"]),
    ("engine", &["output", "model", "linear"]),
    // Tables and reports of a run.
    ("output", &[]),
    // Files of other programs.
    ("exchange", &["model"]),
    // Words: what the user wrote.
    ("model", &[]),
    // Linkages from a wanted motion: numbers only.
    ("synthesis", &["optimise", "linear"]),
    // Optimisation of functions, whatever they are functions of.
    ("optimise", &["study", "linear"]),
    // Matrices, no mechanism.
    ("linear", &[]),
    // Samples, summaries and files of many variants, whatever they are variants of.
    ("study", &[]),
];

/// Packages that only the command may name.
const OF_THE_COMMAND: [&str; 4] = ["clap", "signal_hook", "strsim", "linkdyn_validation"];

/// The manifest of one of our packages.
fn manifest(package: &str) -> String {
    let folder = match package {
        "linkdyn" => root().to_path_buf(),
        folder @ ("python" | "validation") => root().join(folder),
        other => root().join("crates").join(other),
    };
    fs::read_to_string(folder.join("Cargo.toml"))
        .unwrap_or_else(|error| panic!("{package}: {error}"))
}

/// The packages of ours that a manifest has among its dependencies, of tests too.
fn ours(manifest: &str) -> Vec<&str> {
    let mut is_list = false;
    let mut found = Vec::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            is_list = line.ends_with("dependencies]") && !line.contains("workspace");
        }
        if let Some(rest) = line.strip_prefix("linkdyn-").filter(|_| is_list) {
            let end = rest.find(['.', ' ', '=']).expect("a value");
            found.push(&rest[..end]);
        }
    }
    found
}

#[test]
fn packages_depend_downwards_only() {
    for (place, (package, may)) in PACKAGES.iter().enumerate() {
        for other in ours(&manifest(package)) {
            assert!(may.contains(&other), "{package} may not depend on {other}");
        }
        for other in *may {
            let below = PACKAGES.iter().position(|(name, _)| name == other);
            assert!(
                below.is_some_and(|below| below > place),
                "{other} does not stand below {package}"
            );
        }
    }
    assert_eq!(ours(&manifest("picture")).len(), 2, "the scan sees them");
}

#[test]
fn every_package_stands_in_the_table() {
    let entries = fs::read_dir(root().join("crates")).expect("a folder");
    for entry in entries {
        let name = entry.expect("an entry").file_name();
        let known = |package: &(&str, &[&str])| name == package.0;
        assert!(PACKAGES.iter().any(known), "{name:?} is not in the table");
    }
}

/// The C functions of functional mock-up units take pointers; nothing else does.
#[test]
fn unsafe_code_stands_in_one_module() {
    let mut seen = 0;
    for folder in [
        "src",
        "crates",
        "python/src",
        "validation/src",
        "web/bind/src",
    ] {
        for source in rust_files(folder) {
            let is_entry = source.path.starts_with("crates/fmi/src/entries/");
            for (number, line) in source.code.iter().enumerate() {
                let mut words =
                    line.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
                if words.any(|word| word == "unsafe") {
                    seen += 1;
                    assert!(is_entry, "{}:{}: unsafe code", source.path, number + 1);
                }
            }
        }
    }
    assert!(
        seen > 100,
        "only {seen} uses were found: this test is blind"
    );
}

/// The library has no command line: it can be used where there is none.
#[test]
fn only_the_command_knows_the_command_line() {
    let mut seen = 0;
    for source in rust_files("src") {
        let is_command = source.path.starts_with("src/cli/") || source.path == "src/main.rs";
        for (number, line) in source.code.iter().enumerate() {
            let own = ["crate::cli", "super::cli"];
            let other = OF_THE_COMMAND.map(|package| format!("{package}::"));
            let words = own.iter().copied().chain(other.iter().map(String::as_str));
            for word in words.filter(|word| line.contains(word)) {
                seen += 1;
                assert!(
                    is_command,
                    "{}:{}: {word} belongs to the command",
                    source.path,
                    number + 1
                );
            }
        }
    }
    assert!(seen > 10, "only {seen} uses were found: this test is blind");
}
