//! What the page is made of.

use serde::Serialize;

use crate::accuracy_page::Unit;
use crate::study_page::Motion;

/// What the page is made of.
#[derive(Debug)]
pub struct OptimisePage<'a> {
    /// Name of the model.
    pub model: &'a str,
    /// What the model is about.
    pub about: Option<&'a str>,
    /// What was looked for, and how it ended.
    pub verdict: String,
    /// How it ended, in a word, and whether that is what was looked for.
    pub status: (&'a str, bool),
    /// What the reader should know.
    pub notes: Vec<String>,
    /// What was found.
    pub tables: Vec<Facts>,
    /// The mechanism as it was and as it was found, as far as they move.
    pub motions: Vec<(&'static str, Motion)>,
    /// The path, where one was looked for.
    pub wanted: Option<Wanted>,
    /// How the search went.
    pub history: History,
}

/// A table.
#[derive(Debug, Serialize)]
pub struct Facts {
    /// Its title.
    pub title: &'static str,
    /// Titles of its columns.
    pub heads: Vec<&'static str>,
    /// Its rows, a cell for each column.
    pub rows: Vec<Vec<Cell>>,
}

/// A cell of a table.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// Words, or a value with its unit.
    Text(String),
    /// A word that stands out: `good`, `warn` or `bad`.
    Mark(&'static str, &'static str),
}

/// The path that a point should take.
#[derive(Debug, Serialize)]
pub struct Wanted {
    /// Body and point, by their numbers in the drawing.
    pub point: [usize; 2],
    /// What it is called.
    pub name: String,
    /// Points that its path should pass \[m\].
    pub through: Vec<[f64; 2]>,
}

/// How the search went.
#[derive(Debug)]
pub struct History {
    /// What is shown.
    pub label: String,
    /// Its unit.
    pub unit: Unit,
    /// Whether it goes down to nothing, so that its size counts.
    pub is_rest: bool,
    /// By start: evaluations that were better than all before, with the value \[SI\]; the last one ends the search.
    pub starts: Vec<Vec<[f64; 2]>>,
}
