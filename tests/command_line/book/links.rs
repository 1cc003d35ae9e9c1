//! Links and pictures of the pages: what they name is there, and commands of the pages make the pictures.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::blocks::{blocks, prose};
use super::{pages, root};

/// All pictures together [bytes]: a clone stays light.
const MOST_PICTURES: u64 = 3_000_000;
/// README.md is an introduction.
const MOST_LINES: usize = 200;

/// The name that a heading has in links.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase().replace(' ', "-");
    let is_kept = |c: &char| c.is_alphanumeric() || "-_".contains(*c);
    kept.chars().filter(is_kept).collect()
}

fn anchors(text: &str) -> BTreeSet<String> {
    let prose = prose(text);
    let headings = prose.lines().filter(|line| line.starts_with('#'));
    headings
        .map(|line| anchor(line.trim_start_matches('#')))
        .collect()
}

/// What stands between `open` and `close`, wherever it does.
fn between<'a>(text: &'a str, open: &str, close: char) -> Vec<&'a str> {
    let parts = text.split(open).skip(1);
    parts.filter_map(|part| part.split(close).next()).collect()
}

/// Targets of links, pictures and definitions of a page.
fn targets(text: &str) -> Vec<String> {
    let prose = prose(text);
    let inline = between(&prose, "](", ')');
    let pictures = between(&prose, "src=\"", '"');
    let definitions = prose
        .lines()
        .filter_map(|line| line.strip_prefix('[')?.split_once("]: "));
    let definitions = definitions.map(|(_, target)| target);
    let all = inline.into_iter().chain(pictures).chain(definitions);
    all.map(String::from).collect()
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn every_link_leads_somewhere() {
    let mut seen = 0;
    for page in pages() {
        let own = text(&page);
        for target in targets(&own) {
            if target.starts_with("https://") {
                continue;
            }
            let (file, place) = target.split_once('#').unwrap_or((&target, ""));
            let path = if file.is_empty() {
                page.clone()
            } else {
                page.parent().expect("a folder").join(file)
            };
            let name = page.display();
            assert!(path.exists(), "{name}: there is no {target}");
            if !place.is_empty() {
                assert!(
                    anchors(&text(&path)).contains(place),
                    "{name}: {target} has no such heading"
                );
            }
            seen += 1;
        }
    }
    assert!(seen > 80, "only {seen} links were found");
}

/// Pages of the book are part of the library's documentation, where a link to a file leads nowhere: they link by labels, which
/// `src/guide/links.md` gives other targets.
#[test]
fn labels_have_a_target_in_both_places() {
    let guide = text(&root().join("src/guide/links.md"));
    let shown = text(&root().join("src/guide/mod.rs"));
    let mut seen = 0;
    for page in pages() {
        let own = text(&page);
        let prose = prose(&own);
        for label in between(&prose, "][", ']') {
            let definition = format!("[{label}]: ");
            let places = [&own, &guide].map(|text| {
                let defined = text.lines().filter(|line| line.starts_with(&definition));
                defined.count()
            });
            assert_eq!(places, [1, 1], "{}: {label}", page.display());
            seen += 1;
        }
        let name = page.file_name().expect("a name").to_string_lossy();
        if shown.contains(&format!("docs/{name}")) {
            for target in between(&prose, "](", ')') {
                assert!(
                    target.starts_with('#') || target.starts_with("https://"),
                    "{name}: {target} is no label"
                );
            }
        }
    }
    assert!(seen > 20, "only {seen} labels were found");
}

fn pictures(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("readable");
    let paths = entries.map(|entry| entry.expect("readable").path());
    paths
        .flat_map(|path| match path.is_dir() {
            true => pictures(&path),
            false => vec![path],
        })
        .collect()
}

#[test]
fn pictures_are_shown_small_and_made_by_commands() {
    let all = pictures(&root().join("docs/pictures"));
    let size: u64 = all
        .iter()
        .map(|path| fs::metadata(path).expect("readable").len())
        .sum();
    assert!(size <= MOST_PICTURES, "{size} bytes of pictures");
    let texts: Vec<String> = pages().iter().map(|page| text(page)).collect();
    let commands: String = texts
        .iter()
        .flat_map(|text| blocks(text))
        .filter(|block| block.words[0] == "sh")
        .map(|block| block.body)
        .collect();
    for path in &all {
        let name = path.strip_prefix(root()).expect("ours");
        let short = name.strip_prefix("docs").expect("of the book");
        let short = short.display().to_string();
        assert!(
            texts.iter().any(|text| text.contains(&short)),
            "{short} is not shown"
        );
        // A browser made these, of the pages that commands of README.md write.
        if ["pictures/report.png", "pictures/study.png"].contains(&short.as_str()) {
            continue;
        }
        let folder = name.parent().expect("a folder");
        let is_made = [name, folder]
            .iter()
            .any(|name| commands.contains(&format!("-o {}\n", name.display())));
        assert!(is_made, "no command makes {short}");
    }
}

#[test]
fn the_introduction_is_short() {
    let lines = text(&root().join("README.md")).lines().count();
    assert!(lines <= MOST_LINES, "{lines} lines");
}

#[test]
fn headings_have_the_anchors_that_pages_on_the_web_give_them() {
    for (heading, known) in [
        (" `modes.json` and `modes.csv`", "modesjson-and-modescsv"),
        (" 10. From Rust", "10-from-rust"),
        (
            " Clearance: the massless link",
            "clearance-the-massless-link",
        ),
    ] {
        assert_eq!(anchor(heading), known);
    }
}
