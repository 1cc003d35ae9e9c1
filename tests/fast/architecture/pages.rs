//! The pages for people name files that are there.

use std::fs;

use super::source::root;

/// Where a path of ours begins.
const BEGINNINGS: [&str; 9] = [
    "docs/",
    "crates/",
    "src/",
    "tests/",
    "validation/",
    "benches/",
    "models/",
    "python/",
    ".ci/",
];

/// What stands in backticks and is a path of ours.
fn paths(text: &str) -> impl Iterator<Item = &str> {
    let quoted = text.split('`').skip(1).step_by(2);
    quoted.filter(|word| {
        BEGINNINGS.iter().any(|begin| word.starts_with(begin)) && !word.contains([' ', '*', '<'])
    })
}

#[test]
fn pages_name_what_there_is() {
    for (page, fewest) in [
        ("CONTRIBUTING.md", 40),
        ("README.md", 2),
        ("docs/validation.md", 8),
        ("docs/performance.md", 2),
        ("docs/models.md", 1),
        ("CHANGELOG.md", 0),
    ] {
        let text = fs::read_to_string(root().join(page)).expect(page);
        let mut seen = 0;
        for path in paths(&text) {
            assert!(root().join(path).exists(), "{page}: there is no {path}");
            seen += 1;
        }
        assert!(seen >= fewest, "{page}: only {seen} paths were found");
    }
}
