//! Names of axes and of curves.

use super::options::Options;
use super::units::quantity_words;
use crate::cli::results::Results;
use linkdyn_output::Channel;

/// The column's name, or what the columns have in common.
pub fn axis_name(columns: &[(&str, Option<Channel>)]) -> String {
    let Some(&first) = columns.first() else {
        return String::new();
    };
    if columns.iter().all(|(name, _)| *name == first.0) {
        return first.0.into();
    }
    let word = shared_word(first);
    if columns.iter().all(|&column| shared_word(column) == word) {
        word
    } else {
        String::new()
    }
}

/// What a column shows, in a word that columns of several owners share. A column that is not ours is told by its last word.
fn shared_word((name, channel): (&str, Option<Channel>)) -> String {
    if let Some(channel) = channel {
        return quantity_words(channel).into();
    }
    let last = name.rsplit('.').next().unwrap_or_default();
    let ours = ["joint.any", "driver.any", "energy"]
        .into_iter()
        .find_map(|owner| Channel::read(&format!("{owner}.{last}")).map(|(channel, _)| channel));
    ours.map_or_else(
        || last.to_string(),
        |channel| quantity_words(channel).into(),
    )
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
