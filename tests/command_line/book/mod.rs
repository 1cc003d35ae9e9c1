//! README.md and the book (`docs/*.md`): their models load and run, their commands do what they show.
//!
//! In each page, in order: a `json` block with `format` is a model, kept as `file:…` where that is said; one without is a
//! piece that is put into the last model that is not `apart`. A `text` may be kept as a file, too. Of a `console` block each
//! line `$ …` is run, and the lines below it must be found, in that order, in what it tells; `…` stands for anything.
//! `exit:…` is the exit status wanted. The lines of a `sh` block are commands that end well; a `python` block is run where
//! there is a Python with pandas.

mod blocks;
mod facts;
mod links;
mod runner;

use std::fs;
use std::path::{Path, PathBuf};
use std::thread;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All pages, README.md first.
fn pages() -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join("docs")).expect("docs");
    let entries = entries.map(|entry| entry.expect("readable").path());
    let mut pages: Vec<_> = entries
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .collect();
    pages.sort();
    pages.insert(0, root().join("README.md"));
    pages
}

/// A page of the repository, such as `docs/format.md`.
fn page(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn what_the_pages_show_is_so() {
    let pages = pages();
    let tallies = thread::scope(|scope| {
        let running: Vec<_> = pages
            .iter()
            .map(|page| scope.spawn(|| runner::run_page(page)))
            .collect();
        let ended = running.into_iter().map(|page| page.join());
        ended.collect::<Vec<_>>()
    });
    let (mut models, mut pieces, mut commands) = (0, 0, 0);
    for (page, tally) in pages.iter().zip(tallies) {
        // What it lacks stands above.
        let tally = tally.unwrap_or_else(|_| panic!("{} shows what is not so", page.display()));
        models += tally.models;
        pieces += tally.pieces;
        commands += tally.commands;
    }
    assert!(
        models >= 8 && pieces >= 28 && commands >= 70,
        "{models} models, {pieces} pieces, {commands} commands"
    );
}
