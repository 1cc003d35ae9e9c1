//! Names of axes and of curves.

use super::options::Options;
use super::panels::Found;
use super::units::quantity_words;
use crate::cli::results::Results;

/// The column's name, or what the columns have in common.
pub fn axis_name(curves: &[&Found]) -> String {
    let Some(first) = curves.first() else {
        return String::new();
    };
    if curves.iter().all(|curve| curve.name == first.name) {
        return first.name.clone();
    }
    let mut words = curves.iter().map(|curve| curve.channel.map(quantity_words));
    match first.channel.map(quantity_words) {
        Some(word) if words.all(|other| other == Some(word)) => word.to_string(),
        Some(_) | None => String::new(),
    }
}

/// What each run is called: as given, else by its directory, its model or its path, the first that tells all apart.
pub fn run_labels(options: &Options, runs: &[Results]) -> Vec<String> {
    if runs.len() > 1 && options.label.len() == runs.len() {
        return options.label.clone();
    }
    let is_distinct = |labels: &Vec<String>| {
        (0..labels.len()).all(|a| !labels[a].is_empty() && (0..a).all(|b| labels[a] != labels[b]))
    };
    let by_file = runs.iter().map(Results::file_name).collect();
    let by_model = runs
        .iter()
        .map(|run| run.model_name().unwrap_or_default().to_string())
        .collect();
    let by_path: Vec<String> = runs
        .iter()
        .map(|run| run.path.display().to_string())
        .collect();
    let numbered = || {
        by_path
            .iter()
            .enumerate()
            .map(|(i, path)| format!("{} {path}", i + 1))
            .collect()
    };
    [by_file, by_model, by_path.clone()]
        .into_iter()
        .find(is_distinct)
        .unwrap_or_else(numbered)
}
