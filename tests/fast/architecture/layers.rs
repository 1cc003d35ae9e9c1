//! Who may know whom within the engine: every `crate::` in a layer of `crates/engine/src/` is held against a table.
//! Dependencies point downwards only. Between packages the compiler keeps the order.
//!
//! A layer is a folder of `crates/engine/src/`, or a file there. Tests inside the layers count like the rest.

use std::collections::BTreeSet;

use super::source::{Source, rust_files};

/// Layers from top to bottom, each with the layers it may use; a layer may only use what stands below it.
const LAYERS: &[(&str, &[&str])] = &[
    (
        "analysis",
        &[
            "integrate",
            "mechanism",
            "system",
            "element",
            "graph",
            "motion",
            "contact",
        ],
    ),
    // Steps of y′ = f(t, y), of whatever that is.
    ("integrate", &[]),
    // Constraints as the contract of `element` shows them, no joint; see `mechanism_knows_no_joint`; of `motion` a value
    // with its derivatives.
    ("mechanism", &["system", "element", "graph", "motion"]),
    ("system", &["element", "elastic", "motion", "contact"]),
    ("graph", &[]),
    ("element", &["motion", "contact"]),
    // Shapes and mass points of elastic links: numbers only.
    ("elastic", &[]),
    ("motion", &[]),
    // Laws of contact: pure functions of numbers.
    ("contact", &[]),
    ("lib", &[]),
];

/// Packages with one job: in which layers they may be named.
const PACKAGES: &[(&str, &[&str])] = &[
    ("petgraph", &["graph"]),
    ("sprs", &["system"]),
    // Words: what a user wrote ends at `system/compile`; the analyses know the words of the question.
    ("linkdyn_model", &["analysis", "system"]),
    ("linkdyn_output", &["analysis"]),
];

/// The files of the engine, each with its layer.
fn sources() -> Vec<(String, Source)> {
    let layer = |source: &Source| {
        let below = source.path.trim_start_matches("crates/engine/src/");
        let name = below.split('/').next().expect("a name");
        name.trim_end_matches(".rs").to_string()
    };
    rust_files("crates/engine/src")
        .into_iter()
        .map(|source| (layer(&source), source))
        .collect()
}

/// Layers that a line names by `crate::`.
fn named(line: &str) -> impl Iterator<Item = &str> {
    line.match_indices("crate::").filter_map(|(at, word)| {
        let rest = &line[at + word.len()..];
        let end = rest
            .find(|c: char| !c.is_alphanumeric() && c != '_')
            .unwrap_or(rest.len());
        (end > 0).then(|| &rest[..end])
    })
}

fn layer(name: &str) -> Option<usize> {
    LAYERS.iter().position(|(layer, _)| *layer == name)
}

#[test]
fn the_table_points_downwards() {
    for (place, (name, below)) in LAYERS.iter().enumerate() {
        for other in *below {
            let below = layer(other).unwrap_or_else(|| panic!("{other} is no layer"));
            assert!(
                place < below,
                "{name} may not use {other}, which stands above it"
            );
        }
    }
}

#[test]
fn every_layer_stands_in_the_table() {
    let found: BTreeSet<String> = sources().into_iter().map(|(layer, _)| layer).collect();
    let table: BTreeSet<String> = LAYERS.iter().map(|(name, _)| name.to_string()).collect();
    assert_eq!(found, table);
}

#[test]
fn no_layer_looks_where_it_may_not() {
    let mut faults = Vec::new();
    let mut seen = 0;
    for (own, source) in sources() {
        let place = layer(&own).expect("in the table");
        for (number, line) in source.code.iter().enumerate() {
            // A list of layers in braces would escape this test.
            assert!(
                !line.contains("crate::{"),
                "{}:{}: name each layer on its own line",
                source.path,
                number + 1
            );
            for other in named(line).filter(|other| layer(other).is_some() && *other != own) {
                seen += 1;
                if !LAYERS[place].1.contains(&other) {
                    faults.push(format!(
                        "{}:{}: {} may not use {other}",
                        source.path,
                        number + 1,
                        own
                    ));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(seen > 50, "only {seen} uses were found: this test is blind");
}

#[test]
fn every_package_keeps_to_its_place() {
    let mut faults = Vec::new();
    for (own, source) in sources() {
        for (number, line) in source.code.iter().enumerate() {
            for (package, places) in PACKAGES {
                let names_it = line.contains(&format!("{package}::"))
                    || line.contains(&format!("use {package};"));
                if names_it && !places.contains(&own.as_str()) {
                    faults.push(format!(
                        "{}:{}: {package} belongs to {places:?}",
                        source.path,
                        number + 1
                    ));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The solver sees rows and entries, never what kind of joint made them.
#[test]
fn mechanism_knows_no_joint() {
    let words = [
        "revolute",
        "prismatic",
        "JointKind",
        "JointData",
        ".joints",
        "JointId",
    ];
    for (_, source) in sources().iter().filter(|(layer, _)| layer == "mechanism") {
        for (number, line) in source.code.iter().enumerate() {
            let word = words.iter().find(|word| line.contains(**word));
            assert!(word.is_none(), "{}:{}: {word:?}", source.path, number + 1);
        }
    }
}

/// An element writes small blocks; it allocates no matrix and solves nothing.
#[test]
fn element_knows_no_matrix() {
    for (_, source) in sources()
        .iter()
        .filter(|(layer, source)| layer == "element" && !source.path.ends_with("tests.rs"))
    {
        for (number, line) in source.code.iter().enumerate() {
            let word = ["Matrix", "Pattern", "Lu", "System"]
                .iter()
                .find(|word| line.contains(**word));
            assert!(word.is_none(), "{}:{}: {word:?}", source.path, number + 1);
        }
    }
}

/// Where words become numbers, and what speaks of the words themselves. No other file of the engine names the model.
const KNOW_THE_MODEL: &[&str] = &[
    // Compiling it, and its question.
    "system/compile/",
    "analysis/question.rs",
    "analysis/settings.rs",
    // Entries, which compile a model.
    "analysis/bent.rs",
    "analysis/check.rs",
    "analysis/derived.rs",
    "analysis/family/mechanisms.rs",
    "analysis/family/mod.rs",
    "analysis/hand.rs",
    "analysis/hand/",
    "analysis/modes.rs",
    "analysis/state_space/",
    // Named numbers, whose arithmetic is the model's.
    "analysis/responses/",
    "analysis/run.rs",
    // What the words say, and what they leave out.
    "analysis/assemblies.rs",
    "analysis/workspace.rs",
    "analysis/check/",
    "analysis/suspicious/",
];

/// What a user wrote is compiled once. Below that there are numbers, and nothing is compiled again while a motion runs.
#[test]
fn no_file_below_compile_names_the_model() {
    let knows = |path: &str| {
        let path = path.trim_start_matches("crates/engine/src/");
        KNOW_THE_MODEL.iter().any(|known| path.starts_with(known))
    };
    // Of the package of words all know complaints, and how messages speak of quantities.
    let allowed = ["linkdyn_model::error::", "linkdyn_model::display::"];
    let words = ["linkdyn_model", "compile::compile", "&Model", "&Checked"];
    let mut seen = 0;
    for (_, source) in sources().iter().filter(|(_, source)| !knows(&source.path)) {
        seen += 1;
        // Tests may begin with what a user writes.
        let own = source
            .code
            .iter()
            .take_while(|line| !line.contains("#[cfg(test)]"));
        for (number, line) in own.enumerate() {
            let rest = allowed
                .iter()
                .fold(line.clone(), |line, word| line.replace(word, ""));
            let word = words.iter().find(|word| rest.contains(**word));
            assert!(word.is_none(), "{}:{}: {word:?}", source.path, number + 1);
        }
    }
    assert!(
        seen > 100,
        "only {seen} files were found: this test is blind"
    );
}

/// The list only shrinks: each file on it names the model.
#[test]
fn what_knows_the_model_names_it() {
    for known in KNOW_THE_MODEL {
        let path = format!("crates/engine/src/{known}");
        let names_it = sources().iter().any(|(_, source)| {
            source.path.starts_with(&path)
                && source
                    .code
                    .iter()
                    .any(|line| line.contains("linkdyn_model::"))
        });
        assert!(names_it, "{known} does not name the model");
    }
}
